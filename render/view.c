/* render/view.c - which face is nearest to the eye, dot by dot. */
#include "render/view.h"

#include "core/memory.h"

#include <string.h>

#define MOST_DOTS (1 << 26)

/* ---- the eye ------------------------------------------------------------------------------ */

/* From axes with y up to those of the model. */
static ktg_vec3 to_model(unsigned up, ktg_vec3 v) {
    if (up == 2)
        return (ktg_vec3){v.x, -v.z, v.y};
    if (up == 0)
        return (ktg_vec3){v.y, v.z, v.x};
    return v;
}

ktg_eye ktg_eye_at(unsigned up, double turn, double rise) {
    double c = cos(turn), s = sin(turn);
    ktg_eye eye = {.right = to_model(up, (ktg_vec3){c, 0, -s}),
                   .toward = to_model(up, (ktg_vec3){s * cos(rise), sin(rise), c * cos(rise)})};
    eye.above = ktg_cross3(eye.toward, eye.right);
    return eye;
}

bool ktg_view_extent(const ktg_pattern *pattern, const bool *shown, const ktg_eye *eye,
                     ktg_area *seen) {
    *seen = (ktg_area){INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t h = 0; h < 3 * (size_t)pattern->face_count; h++) {
        if (shown && !shown[h / 3])
            continue;
        ktg_vec2 p = ktg_eye_sees(eye, pattern->vertices[pattern->faces[h]]);
        *seen = (ktg_area){ktg_min(seen->x0, p.x), ktg_min(seen->y0, p.y), ktg_max(seen->x1, p.x),
                           ktg_max(seen->y1, p.y)};
    }
    return seen->x0 <= seen->x1 && isfinite(seen->x1 - seen->x0) && isfinite(seen->y1 - seen->y0);
}

/* ---- dots --------------------------------------------------------------------------------- */

/* A corner of a face in the picture. */
typedef struct seen_corner {
    double x, y, depth;
} seen_corner;

static seen_corner corner_of(const ktg_view *view, uint32_t vertex) {
    ktg_vec3 p = view->pattern->vertices[vertex];
    ktg_vec2 dot = ktg_view_dot(view, p);
    return (seen_corner){dot.x, dot.y, ktg_dot3(p, view->eye.toward) * view->scale};
}

/* Dots whose middles lie between low and high, within the picture. */
static bool dots_between(double low, double high, int count, int *first, int *last) {
    if (!(high >= 0.5) || !(low <= count - 0.5))
        return false;
    *first = low <= 0.5 ? 0 : (int)ceil(low - 0.5);
    *last = high >= count - 0.5 ? count - 1 : (int)floor(high - 0.5);
    return *first <= *last;
}

static void put_dot(ktg_view *view, int x, int y, double depth, uint32_t face) {
    size_t at = (size_t)y * (size_t)view->width + (size_t)x;
    if (view->faces[at] != KTG_NONE && (float)depth <= view->depths[at])
        return; /* on a tie the first face stays */
    view->faces[at] = face;
    view->depths[at] = (float)depth;
}

/* The part of a row within the triangle: where the three lines a x + b stay on the inner side. */
static void put_row(ktg_view *view, const seen_corner c[3], double area, int y, int first, int last,
                    uint32_t face) {
    double from = first + 0.5, to = last + 0.5, middle = y + 0.5;
    for (int k = 0; k < 3; k++) {
        const seen_corner *p = &c[k], *q = &c[(k + 1) % 3];
        double slope = -(q->y - p->y) / area, at = ((q->x - p->x) * (middle - p->y)) / area;
        /* weight(x) = at + slope (x - p.x) >= 0 */
        if (slope > 0)
            from = ktg_max(from, p->x - at / slope);
        else if (slope < 0)
            to = ktg_min(to, p->x - at / slope);
        else if (at < 0)
            return;
    }
    if (!(from <= to + 1e-9))
        return;
    double step[2] = {-(c[2].y - c[1].y) / area, -(c[0].y - c[2].y) / area};
    for (int x = (int)ceil(from - 0.5 - 1e-9); x <= last && x + 0.5 <= to + 1e-9; x++) {
        double px = x + 0.5;
        double u = step[0] * (px - c[1].x) + (c[2].x - c[1].x) * (middle - c[1].y) / area;
        double v = step[1] * (px - c[2].x) + (c[0].x - c[2].x) * (middle - c[2].y) / area;
        put_dot(view, x, y, u * c[0].depth + v * c[1].depth + (1 - u - v) * c[2].depth, face);
    }
}

static void put_face(ktg_view *view, uint32_t face) {
    const uint32_t *v = &view->pattern->faces[3 * (size_t)face];
    seen_corner c[3] = {corner_of(view, v[0]), corner_of(view, v[1]), corner_of(view, v[2])};
    double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
    int x0, x1, y0, y1;
    if (!(fabs(area) > 1e-12) || !isfinite(area))
        return;
    if (!dots_between(ktg_min(c[0].x, ktg_min(c[1].x, c[2].x)),
                      ktg_max(c[0].x, ktg_max(c[1].x, c[2].x)), view->width, &x0, &x1) ||
        !dots_between(ktg_min(c[0].y, ktg_min(c[1].y, c[2].y)),
                      ktg_max(c[0].y, ktg_max(c[1].y, c[2].y)), view->height, &y0, &y1))
        return;
    for (int y = y0; y <= y1; y++)
        put_row(view, c, area, y, x0, x1, face);
}

ktg_status ktg_view_look(ktg_context *context, const ktg_pattern *pattern, const bool *shown,
                         const ktg_eye *eye, ktg_area seen, double scale, ktg_view *view) {
    double wide = ceil((seen.x1 - seen.x0) * scale), high = ceil((seen.y1 - seen.y0) * scale);
    *view =
        (ktg_view){.pattern = pattern, .eye = *eye, .corner = {seen.x0, seen.y0}, .scale = scale};
    wide = fmax(1, wide);
    high = fmax(1, high);
    if (!(wide * high <= MOST_DOTS))
        return ktg_fail(context, KTG_LIMIT, "a picture of %.0f x %.0f dots is too large", wide,
                        high);
    view->width = (int)wide;
    view->height = (int)high;
    size_t dots = (size_t)view->width * (size_t)view->height;
    view->faces = ktg_new(context, dots, uint32_t);
    view->depths = ktg_new(context, dots, float);
    if (!view->faces || !view->depths) {
        ktg_view_drop(view);
        return KTG_MEMORY;
    }
    memset(view->faces, 0xff, dots * sizeof *view->faces); /* KTG_NONE */
    for (uint32_t f = 0; f < pattern->face_count; f++)
        if (!shown || shown[f])
            put_face(view, f);
    return KTG_OK;
}

void ktg_view_drop(ktg_view *view) {
    ktg_free(view->faces);
    ktg_free(view->depths);
    view->faces = NULL;
    view->depths = NULL;
}

bool ktg_view_shows(const ktg_view *view, ktg_vec2 dot, uint32_t a, uint32_t b) {
    if (!(dot.x > -1 && dot.y > -1 && dot.x < view->width + 1 && dot.y < view->height + 1))
        return false;
    int x = (int)floor(dot.x), y = (int)floor(dot.y);
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            if (i < 0 || j < 0 || i >= view->width || j >= view->height)
                continue;
            uint32_t face = view->faces[(size_t)j * (size_t)view->width + (size_t)i];
            if (face != KTG_NONE && (face == a || face == b))
                return true;
        }
    return false;
}
