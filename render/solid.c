/* render/solid.c - a small picture of the finished model with the names of its pieces: where each
 * of them goes. Faces are painted from the back to the front (Newell and others 1972, without their
 * cutting: single faces may stand wrong in a picture of this size). */
#include "render/draw.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

#define MOST_FACES 5000
#define NAME_MM    1.8
#define DOTS       160 /* of a picture of which piece is seen where */
#define LEAST_DOTS 40
#define NAME_WIDTH 20.0
#define MOST_NAMES 40
#define TURN       0.55 /* radians: the eye is so far to the right of the front ... */
#define RISE       0.4  /* ... and above */

/* What is drawn along a face's side. */
typedef enum side_look { SIDE_PLAIN, SIDE_FOLD, SIDE_CUT, SIDE_PIECE } side_look;

typedef struct painted_face {
    double depth; /* towards the eye */
    uint32_t face;
} painted_face;

/* Where a piece is seen. */
typedef struct sight {
    uint32_t piece, dots;
    double x, y;      /* the middle of its dots, in dots */
    double away;      /* squared, of the dot nearest to that */
    ktg_vec2 nearest; /* and that dot */
} sight;

typedef struct solid {
    const ktg_drawing *drawing;
    ktg_vec3 right, up, toward; /* of the eye, in the model */
    ktg_vec2 middle;            /* of what it sees */
    double extent;
    uint32_t *piece_of;  /* face_count */
    uint8_t *looks;      /* 3 face_count: side_look */
    painted_face *faces; /* face_count, the last one nearest to the eye */
    sight *sights;       /* piece_count */
} solid;

/* ---- the eye ------------------------------------------------------------------------------- */

/* From axes with y up to those of the model. */
static ktg_vec3 to_model(unsigned up, ktg_vec3 v) {
    if (up == 2)
        return (ktg_vec3){v.x, -v.z, v.y};
    if (up == 0)
        return (ktg_vec3){v.y, v.z, v.x};
    return v;
}

void ktg_solid_eye(unsigned up, bool from_behind, ktg_vec3 *right, ktg_vec3 *above) {
    double turn = TURN + (from_behind ? KTG_PI : 0), c = cos(turn), n = sin(turn);
    *right = to_model(up, (ktg_vec3){c, 0, -n});
    *above = ktg_cross3(to_model(up, (ktg_vec3){n * cos(RISE), sin(RISE), c * cos(RISE)}), *right);
}

static void set_eye(solid *s, bool from_behind) {
    ktg_solid_eye(s->drawing->options.up, from_behind, &s->right, &s->up);
    s->toward = ktg_cross3(s->right, s->up);
}

static ktg_vec2 seen(const solid *s, uint32_t vertex) {
    ktg_vec3 p = s->drawing->pattern->vertices[vertex];
    return (ktg_vec2){ktg_dot3(p, s->right), -ktg_dot3(p, s->up)};
}

static int by_depth(const void *left, const void *right) {
    const painted_face *a = left, *b = right;
    if (a->depth != b->depth)
        return a->depth < b->depth ? -1 : 1;
    return (a->face > b->face) - (a->face < b->face);
}

static void look_at(solid *s) {
    const ktg_pattern *pattern = s->drawing->pattern;
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t f = 0; f < pattern->face_count; f++) {
        s->faces[f] = (painted_face){0, f};
        for (size_t k = 0; k < 3; k++) {
            uint32_t v = pattern->faces[3 * (size_t)f + k];
            ktg_vec2 p = seen(s, v);
            low = (ktg_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
            high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
            s->faces[f].depth += ktg_dot3(pattern->vertices[v], s->toward);
        }
    }
    qsort(s->faces, pattern->face_count, sizeof *s->faces, by_depth);
    s->middle = ktg_mul2(ktg_add2(low, high), 0.5);
    s->extent = fmax(high.x - low.x, high.y - low.y);
}

/* ---- painting ------------------------------------------------------------------------------ */

static void path_of(const solid *s, cairo_t *cairo, uint32_t face) {
    for (size_t k = 0; k < 3; k++) {
        ktg_vec2 p = seen(s, s->drawing->pattern->faces[3 * (size_t)face + k]);
        cairo_line_to(cairo, p.x, p.y);
    }
    cairo_close_path(cairo);
}

/* Light comes from the eye and from above. */
static double shade(const solid *s, uint32_t face) {
    const ktg_pattern *pattern = s->drawing->pattern;
    const uint32_t *c = &pattern->faces[3 * (size_t)face];
    ktg_vec3 a = pattern->vertices[c[0]];
    ktg_vec3 n =
        ktg_cross3(ktg_sub3(pattern->vertices[c[1]], a), ktg_sub3(pattern->vertices[c[2]], a));
    double length = ktg_length3(n);
    double light =
        length > 0 ? fabs(0.6 * ktg_dot3(n, s->toward) + 0.6 * ktg_dot3(n, s->up)) / length : 1;
    return 0.72 + 0.27 * fmin(1, light);
}

static void paint_side(const solid *s, cairo_t *cairo, uint32_t face, uint32_t k, double mm) {
    static const double widths[] = {0, 0.06, 0.1, 0.3}, greys[] = {0, 0.6, 0.45, 0};
    side_look look = (side_look)s->looks[3 * (size_t)face + k];
    const uint32_t *c = &s->drawing->pattern->faces[3 * (size_t)face];
    if (look == SIDE_PLAIN)
        return;
    ktg_vec2 a = seen(s, c[k]), b = seen(s, c[(k + 1) % 3]);
    cairo_set_source_rgb(cairo, greys[look], greys[look], greys[look]);
    cairo_set_line_width(cairo, widths[look] * mm);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    cairo_stroke(cairo);
}

/* `mm`: how much of the model is a millimetre of paper. */
static void paint(const solid *s, cairo_t *cairo, double mm) {
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (uint32_t i = 0; i < s->drawing->pattern->face_count; i++) {
        uint32_t face = s->faces[i].face;
        double grey = shade(s, face) / 255;
        uint32_t tint = s->drawing->tints ? s->drawing->tints[face] : 0xffffff;
        path_of(s, cairo, face);
        cairo_set_source_rgb(cairo, grey * (tint >> 16 & 255), grey * (tint >> 8 & 255),
                             grey * (tint & 255));
        cairo_set_line_width(cairo, 0.04 * mm);
        cairo_fill_preserve(cairo);
        cairo_stroke(cairo); /* no hair of white between faces */
        for (uint32_t k = 0; k < 3; k++)
            paint_side(s, cairo, face, k, mm);
    }
}

/* ---- names --------------------------------------------------------------------------------- */

/* Paints which piece is where: a dot's colour is its piece's number, from 1. */
static void paint_numbers(const solid *s, cairo_t *cairo) {
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE);
    cairo_translate(cairo, DOTS / 2.0, DOTS / 2.0);
    cairo_scale(cairo, DOTS / s->extent, DOTS / s->extent);
    cairo_translate(cairo, -s->middle.x, -s->middle.y);
    for (uint32_t i = 0; i < s->drawing->pattern->face_count; i++) {
        uint32_t number = s->piece_of[s->faces[i].face] + 1;
        path_of(s, cairo, s->faces[i].face);
        cairo_set_source_rgb(cairo, (number >> 16 & 255) / 255.0, (number >> 8 & 255) / 255.0,
                             (number & 255) / 255.0);
        cairo_fill(cairo);
    }
}

/* First the middles of the pieces' dots, then the dots nearest to those. */
static void measure_dot(sight *at, int x, int y, bool nearest) {
    if (!nearest) {
        at->dots++;
        at->x += x;
        at->y += y;
        return;
    }
    double dx = x - at->x / at->dots, dy = y - at->y / at->dots, away = dx * dx + dy * dy;
    if (away < at->away) {
        at->away = away;
        at->nearest = (ktg_vec2){x + 0.5, y + 0.5};
    }
}

static void measure_dots(const solid *s, cairo_surface_t *surface) {
    const unsigned char *dots = cairo_image_surface_get_data(surface);
    ptrdiff_t stride = cairo_image_surface_get_stride(surface);
    for (int nearest = 0; nearest < 2; nearest++)
        for (int y = 0; y < DOTS; y++)
            for (int x = 0; x < DOTS; x++) {
                uint32_t number;
                memcpy(&number, dots + y * stride + 4 * (ptrdiff_t)x, sizeof number);
                number &= 0xffffff;
                if (number > 0 && number <= s->drawing->pattern->piece_count)
                    measure_dot(&s->sights[number - 1], x, y, nearest);
            }
}

static int by_dots(const void *left, const void *right) {
    const sight *a = left, *b = right;
    if (a->dots != b->dots)
        return a->dots > b->dots ? -1 : 1;
    return (a->piece > b->piece) - (a->piece < b->piece);
}

/* What is seen of each piece, the most first. */
static ktg_status find_sights(const solid *s) {
    size_t count = s->drawing->pattern->piece_count;
    for (uint32_t p = 0; p < count; p++)
        s->sights[p] = (sight){.piece = p, .away = INFINITY};
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, DOTS, DOTS);
    cairo_t *cairo = cairo_create(surface);
    paint_numbers(s, cairo);
    cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_flush(surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        measure_dots(s, surface);
    cairo_surface_destroy(surface);
    qsort(s->sights, count, sizeof *s->sights, by_dots);
    return ktg_cairo_status(s->drawing->context, NULL, drawn, "the model");
}

/* Names in the picture at `area`, the pieces one sees most of first; none over another. */
static void write_names(const solid *s, cairo_t *cairo, ktg_area area) {
    ktg_area written[MOST_NAMES];
    size_t count = 0;
    double scale = (area.x1 - area.x0) / DOTS;
    ktg_text_set(cairo, KTG_FACE_PLAIN, NAME_MM);
    for (size_t i = 0; i < s->drawing->pattern->piece_count && count < MOST_NAMES; i++) {
        const sight *at = &s->sights[i];
        char name[KTG_NAME_SIZE];
        if (at->dots < LEAST_DOTS)
            return;
        if (s->drawing->pattern->component_count == 1)
            ktg_drawing_piece_part(s->drawing, at->piece, name);
        else
            ktg_drawing_piece_name(s->drawing, at->piece, name);
        ktg_text_shorten(cairo, NAME_WIDTH, name, sizeof name);
        double width = ktg_text_width(cairo, name);
        double x = area.x0 + at->nearest.x * scale - width / 2, y = area.y0 + at->nearest.y * scale;
        ktg_area box = {x - 0.5, y - NAME_MM, x + width + 0.5, y + NAME_MM};
        bool over = false;
        for (size_t k = 0; k < count; k++)
            over = over || (box.x0 < written[k].x1 && written[k].x0 < box.x1 &&
                            box.y0 < written[k].y1 && written[k].y0 < box.y1);
        if (over)
            continue;
        written[count++] = box;
        ktg_text_ground(cairo, x, y + NAME_MM / 2, name, 0.8);
        cairo_set_source_rgb(cairo, 0, 0, 0);
        ktg_text_draw(cairo, x, y + NAME_MM / 2, name);
    }
}

/* ---- the whole ----------------------------------------------------------------------------- */

static side_look look_of(const ktg_drawing *drawing, const ktg_pattern_edge *edge) {
    if (edge->kind == KTG_EDGE_BORDER)
        return SIDE_CUT;
    if (edge->kind == KTG_EDGE_CUT && edge->side_count == 2)
        return edge->sides[0].piece == edge->sides[1].piece ? SIDE_CUT : SIDE_PIECE;
    return fabs(edge->angle) >= drawing->options.flat_below ? SIDE_FOLD : SIDE_PLAIN;
}

static void fill_tables(solid *s) {
    const ktg_pattern *pattern = s->drawing->pattern;
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        for (size_t f = 0; f < pattern->pieces[p].face_count; f++)
            if (pattern->pieces[p].faces[f] < pattern->face_count)
                s->piece_of[pattern->pieces[p].faces[f]] = p;
    for (size_t e = 0; e < pattern->edge_count; e++)
        for (uint32_t k = 0; k < pattern->edges[e].side_count && k < 2; k++) {
            const ktg_pattern_side *side = &pattern->edges[e].sides[k];
            if (side->face < pattern->face_count && side->corner < 3)
                s->looks[3 * (size_t)side->face + side->corner] =
                    (uint8_t)look_of(s->drawing, &pattern->edges[e]);
        }
}

static ktg_status draw_view(solid *s, cairo_t *cairo, ktg_area area, bool from_behind) {
    set_eye(s, from_behind);
    look_at(s);
    if (!(s->extent > 0))
        return KTG_OK;
    double scale = (area.x1 - area.x0) / s->extent;
    cairo_save(cairo);
    cairo_translate(cairo, (area.x0 + area.x1) / 2, (area.y0 + area.y1) / 2);
    cairo_scale(cairo, scale, scale);
    cairo_translate(cairo, -s->middle.x, -s->middle.y);
    paint(s, cairo, 1 / scale);
    cairo_restore(cairo);
    KTG_TRY(find_sights(s));
    write_names(s, cairo, area);
    return KTG_OK;
}

bool ktg_solid_is_wanted(const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    return pattern->mode == KTG_PAPER && pattern->piece_count > 1 &&
           pattern->face_count <= MOST_FACES;
}

ktg_status ktg_solid_draw(const ktg_drawing *drawing, cairo_t *cairo, ktg_area area,
                          bool from_behind) {
    const ktg_pattern *pattern = drawing->pattern;
    ktg_context *context = drawing->context;
    solid s = {.drawing = drawing};
    s.piece_of = ktg_new(context, pattern->face_count, uint32_t);
    s.looks = ktg_new(context, 3 * (size_t)pattern->face_count, uint8_t);
    s.faces = ktg_new(context, pattern->face_count, painted_face);
    s.sights = ktg_new(context, pattern->piece_count, sight);
    ktg_status status = s.piece_of && s.looks && s.faces && s.sights ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        fill_tables(&s);
        status = draw_view(&s, cairo, area, from_behind);
    }
    ktg_free(s.piece_of);
    ktg_free(s.looks);
    ktg_free(s.faces);
    ktg_free(s.sights);
    return status;
}
