/* render/view_picture.c - a view in colours, with light and shade and lines. */
#include "render/view.h"

#include "core/memory.h"

#include <string.h>

#define DOTS_PER_MM 7.874 /* 200 in an inch */
#define OVERSAMPLE  3
#define MARGIN      0.01 /* of the picture, so that lines at its edge are whole */
#define STEP_DOTS   4.0  /* a step in depth from dot to dot that tells two faces apart */

/* Light from above, a little from the left; what it does not reach is not dark. */
#define LIGHT_RIGHT  (-0.35)
#define LIGHT_ABOVE  0.55
#define LIGHT_TOWARD 0.76
#define AMBIENT      0.64
#define INSIDE       0.86 /* the back of the paper */

#define NO_INK 255

/* ---- lines -------------------------------------------------------------------------------- */

typedef struct inking {
    const ktg_view *view;
    const ktg_look *look;
    double dots_per_mm;
    uint8_t *ink; /* a grey for each dot of the view */
} inking;

/* How many corners two faces share; *side becomes the side of `face` between two of them. */
static int shared_corners(const ktg_pattern *pattern, uint32_t face, uint32_t other,
                          uint32_t *side) {
    const uint32_t *a = &pattern->faces[3 * (size_t)face], *b = &pattern->faces[3 * (size_t)other];
    bool shared[3];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        shared[k] = a[k] == b[0] || a[k] == b[1] || a[k] == b[2];
        count += shared[k];
    }
    *side = !shared[2] ? 0 : !shared[0] ? 1 : 2;
    return count;
}

/* The line between two neighbouring dots of two faces. */
static ktg_line_look look_between(const inking *in, size_t at, size_t beside) {
    uint32_t face = in->view->faces[at], other = in->view->faces[beside], side;
    ktg_line_look none = {0, 0}, outline = {in->look->outline_mm, 0.25};
    if (face == KTG_NONE || other == KTG_NONE)
        return outline;
    int shared = shared_corners(in->view->pattern, face, other, &side);
    if (shared >= 2)
        return in->look->line ? in->look->line(in->look->user, face, side) : none;
    bool apart = fabs((double)in->view->depths[at] - (double)in->view->depths[beside]) > STEP_DOTS;
    return shared == 0 && apart ? outline : none;
}

/* A disk of ink; a thin line is one dot wide. */
static void put_ink(const inking *in, double x, double y, ktg_line_look look) {
    double radius = ktg_max(look.width_mm * in->dots_per_mm / 2, 0.3);
    uint8_t grey = (uint8_t)(look.grey * 254);
    if (!(look.width_mm > 0))
        return;
    int reach = (int)ceil(radius);
    for (int j = (int)floor(y) - reach; j <= (int)floor(y) + reach; j++)
        for (int i = (int)floor(x) - reach; i <= (int)floor(x) + reach; i++) {
            double dx = i + 0.5 - x, dy = j + 0.5 - y;
            if (i < 0 || j < 0 || i >= in->view->width || j >= in->view->height ||
                dx * dx + dy * dy > radius * radius)
                continue;
            uint8_t *ink = &in->ink[(size_t)j * (size_t)in->view->width + (size_t)i];
            *ink = grey < *ink ? grey : *ink;
        }
}

static void draw_ink(const inking *in) {
    int width = in->view->width, height = in->view->height;
    const uint32_t *faces = in->view->faces;
    memset(in->ink, NO_INK, (size_t)width * (size_t)height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            size_t at = (size_t)y * (size_t)width + (size_t)x;
            if (x + 1 < width && faces[at] != faces[at + 1])
                put_ink(in, x + 0.8, y + 0.5, look_between(in, at, at + 1));
            if (y + 1 < height && faces[at] != faces[at + (size_t)width])
                put_ink(in, x + 0.5, y + 0.8, look_between(in, at, at + (size_t)width));
        }
}

/* ---- colours ------------------------------------------------------------------------------ */

/* Where on its face a point of the picture, in dots, lies; `step` dots make one of the image. */
static ktg_seen_dot find_dot(const ktg_view *view, uint32_t face, ktg_vec2 at, int step) {
    const uint32_t *v = &view->pattern->faces[3 * (size_t)face];
    ktg_vec2 a = ktg_view_dot(view, view->pattern->vertices[v[0]]);
    ktg_vec2 b = ktg_sub2(ktg_view_dot(view, view->pattern->vertices[v[1]]), a);
    ktg_vec2 c = ktg_sub2(ktg_view_dot(view, view->pattern->vertices[v[2]]), a);
    ktg_vec2 p = ktg_sub2(at, a);
    double area = ktg_cross2(b, c);
    ktg_seen_dot dot = {.face = face, .is_inside = area > 0}; /* y is down */
    dot.weights[1] = ktg_cross2(p, c) / area;
    dot.weights[2] = ktg_cross2(b, p) / area;
    dot.weights[0] = 1 - dot.weights[1] - dot.weights[2];
    dot.right[1] = step * c.y / area;
    dot.right[2] = -step * b.y / area;
    dot.down[1] = -step * c.x / area;
    dot.down[2] = step * b.x / area;
    dot.right[0] = -dot.right[1] - dot.right[2];
    dot.down[0] = -dot.down[1] - dot.down[2];
    return dot;
}

/* How bright a face is. */
static double shade_of(const ktg_view *view, uint32_t face) {
    const ktg_pattern *pattern = view->pattern;
    const uint32_t *v = &pattern->faces[3 * (size_t)face];
    ktg_vec3 a = pattern->vertices[v[0]];
    ktg_vec3 n = ktg_unit3(
        ktg_cross3(ktg_sub3(pattern->vertices[v[1]], a), ktg_sub3(pattern->vertices[v[2]], a)));
    bool inside = ktg_dot3(n, view->eye.toward) < 0;
    double light = LIGHT_RIGHT * ktg_dot3(n, view->eye.right) +
                   LIGHT_ABOVE * ktg_dot3(n, view->eye.above) +
                   LIGHT_TOWARD * ktg_dot3(n, view->eye.toward);
    light = ktg_min(1, ktg_max(0, inside ? -light : light));
    return (AMBIENT + (1 - AMBIENT) * light) * (inside ? INSIDE : 1);
}

typedef struct painting {
    const ktg_view *view;
    const ktg_look *look;
    const uint8_t *ink;
    float *shades; /* face_count */
    int oversample;
} painting;

/* A dot of the image while it is mixed. */
typedef struct mixture {
    double sum[4];         /* red, green, blue, and how often something is there */
    uint32_t face, colour; /* the last face, and its colour here */
} mixture;

/* Adds a dot of the view. */
static void add_dot(const painting *p, int x, int y, mixture *m) {
    size_t at = (size_t)y * (size_t)p->view->width + (size_t)x;
    uint32_t face = p->view->faces[at];
    double *sum = m->sum;
    if (p->ink[at] != NO_INK) {
        for (int k = 0; k < 3; k++)
            sum[k] += p->ink[at];
        sum[3]++;
        return;
    }
    if (face == KTG_NONE)
        return;
    if (face != m->face && p->look->colour) {
        ktg_seen_dot dot = find_dot(p->view, face, (ktg_vec2){x + 0.5, y + 0.5}, p->oversample);
        m->colour = p->look->colour(p->look->user, &dot);
    }
    m->face = face;
    for (int k = 0; k < 3; k++)
        sum[k] += (double)(m->colour >> (16 - 8 * k) & 255) * (double)p->shades[face];
    sum[3]++;
}

/* Whether all dots of the view that make the image's dot show one face, or nothing, and no ink. */
static bool is_plain(const painting *p, int x, int y) {
    int n = p->oversample, width = p->view->width;
    if (n * (x + 1) > width || n * (y + 1) > p->view->height)
        return false;
    size_t first = (size_t)(n * y) * (size_t)width + (size_t)(n * x);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            size_t at = first + (size_t)j * (size_t)width + (size_t)i;
            if (p->view->faces[at] != p->view->faces[first] || p->ink[at] != NO_INK)
                return false;
        }
    return true;
}

static void add_block(const painting *p, int x, int y, mixture *m) {
    for (int j = y; j < y + p->oversample && j < p->view->height; j++)
        for (int i = x; i < x + p->oversample && i < p->view->width; i++)
            add_dot(p, i, j, m);
}

/* A dot of the image, its colour multiplied by how much of it is there. */
static uint32_t mix_dot(const painting *p, int x, int y) {
    mixture m = {{0, 0, 0, 0}, KTG_NONE, 0xffffff};
    int n = p->oversample;
    if (is_plain(p, x, y)) { /* as most are */
        add_dot(p, n * x, n * y, &m);
        for (int k = 0; k < 4; k++)
            m.sum[k] *= n * n;
    } else
        add_block(p, n * x, n * y, &m);
    uint32_t dot = (uint32_t)lround(255 * m.sum[3] / (n * n));
    for (int k = 0; k < 3; k++)
        dot = dot << 8 | (uint32_t)lround(m.sum[k] / (n * n));
    return dot;
}

static void paint(const painting *p, cairo_surface_t *image) {
    int width = cairo_image_surface_get_width(image);
    unsigned char *rows = cairo_image_surface_get_data(image);
    for (int y = 0; y < cairo_image_surface_get_height(image); y++)
        for (int x = 0; x < width; x++) {
            uint32_t dot = mix_dot(p, x, y);
            memcpy(rows + (ptrdiff_t)y * cairo_image_surface_get_stride(image) + 4 * (ptrdiff_t)x,
                   &dot, sizeof dot);
        }
    cairo_surface_mark_dirty(image);
}

static ktg_status make_image(ktg_context *context, const painting *p, cairo_surface_t **picture) {
    int n = p->oversample;
    cairo_surface_t *image = cairo_image_surface_create(
        CAIRO_FORMAT_ARGB32, (p->view->width + n - 1) / n, (p->view->height + n - 1) / n);
    ktg_status status =
        ktg_cairo_status(context, NULL, cairo_surface_status(image), "a picture of the model");
    if (status != KTG_OK) {
        cairo_surface_destroy(image);
        return status;
    }
    cairo_surface_flush(image);
    paint(p, image);
    *picture = image;
    return KTG_OK;
}

ktg_status ktg_view_picture(ktg_context *context, const ktg_view *view, const ktg_look *look,
                            int oversample, double dots_per_mm, cairo_surface_t **picture) {
    uint32_t face_count = view->pattern->face_count;
    uint8_t *ink = ktg_new(context, (size_t)view->width * (size_t)view->height, uint8_t);
    painting p = {view, look, ink, ktg_new(context, face_count, float), oversample};
    ktg_status status = ink && p.shades ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        draw_ink(&(inking){view, look, dots_per_mm, ink});
        for (uint32_t f = 0; f < face_count; f++)
            p.shades[f] = (float)shade_of(view, f);
        status = make_image(context, &p, picture);
    }
    ktg_free(ink);
    ktg_free(p.shades);
    return status;
}

/* ---- on a page ---------------------------------------------------------------------------- */

/* Dots of the target for a millimetre. */
static double dots_of(cairo_t *cairo) {
    double x = 1, y = 0;
    if (cairo_surface_get_type(cairo_get_target(cairo)) != CAIRO_SURFACE_TYPE_IMAGE)
        return DOTS_PER_MM;
    cairo_user_to_device_distance(cairo, &x, &y);
    return fmin(fmax(hypot(x, y), 1), 4 * DOTS_PER_MM);
}

static void place_image(cairo_t *cairo, cairo_surface_t *image, ktg_vec2 corner, double dots) {
    cairo_save(cairo);
    cairo_translate(cairo, corner.x, corner.y);
    cairo_scale(cairo, 1 / dots, 1 / dots);
    cairo_set_source_surface(cairo, image, 0, 0);
    cairo_paint(cairo);
    cairo_restore(cairo);
    cairo_surface_destroy(image);
}

ktg_status ktg_picture_draw(ktg_context *context, const ktg_pattern *pattern, const bool *shown,
                            const ktg_eye *eye, ktg_area frame, const ktg_look *look,
                            cairo_t *cairo, ktg_area area, ktg_picture *picture) {
    double margin = MARGIN * fmax(frame.x1 - frame.x0, frame.y1 - frame.y0);
    frame = (ktg_area){frame.x0 - margin, frame.y0 - margin, frame.x1 + margin, frame.y1 + margin};
    double wide = frame.x1 - frame.x0, high = frame.y1 - frame.y0;
    double mm = fmin((area.x1 - area.x0) / wide, (area.y1 - area.y0) / high); /* for a unit */
    double dots = dots_of(cairo), fine = dots * OVERSAMPLE;
    cairo_surface_t *image = NULL;
    *picture = (ktg_picture){
        .corner = {(area.x0 + area.x1 - mm * wide) / 2, (area.y0 + area.y1 - mm * high) / 2},
        .mm = 1 / fine};
    if (!(wide > 0))
        return KTG_OK; /* all in one point */
    KTG_TRY(ktg_view_look(context, pattern, shown, eye, frame, mm * fine, &picture->view));
    KTG_TRY(ktg_view_picture(context, &picture->view, look, OVERSAMPLE, fine, &image));
    place_image(cairo, image, picture->corner, dots);
    return KTG_OK;
}
