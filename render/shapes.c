/* render/shapes.c - surfaces side by side in one picture: a model before and after a change. They
 * become one surface, set apart along what is right in the picture, drawn as a solid is. */
#include "render/draw.h"
#include "render/more_pages.h"

#include "core/memory.h"

#include <string.h>

#define WIDTH      1400.0 /* of the picture, in dots; it is no higher */
#define DOTS_A_MM  6.0    /* lines are drawn in millimetres */
#define FRAME      0.02
#define APART      0.08  /* of the widest shape, left free between two */
#define MOST_EDGED 12000 /* faces: with more, their edges would be all one sees */

typedef struct row {
    ktg_pattern pattern; /* of the vertices and faces of all shapes, without pieces */
    uint32_t *tints;
    ktg_vec3 right, above;
    double wide, high; /* of what is seen */
} row;

typedef struct extent {
    ktg_vec2 low, high;
} extent;

static extent extent_of(const row *r, const ktg_vec3 *vertices, uint32_t count) {
    extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t v = 0; v < count; v++) {
        ktg_vec2 p = {ktg_dot3(vertices[v], r->right), ktg_dot3(vertices[v], r->above)};
        e.low = (ktg_vec2){fmin(e.low.x, p.x), fmin(e.low.y, p.y)};
        e.high = (ktg_vec2){fmax(e.high.x, p.x), fmax(e.high.y, p.y)};
    }
    return e;
}

static ktg_status check_shape(ktg_context *context, const ktg_render_shape *s) {
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        ktg_vec3 p = s->vertices[v];
        if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z))
            return ktg_fail(context, KTG_ARGUMENT, "vertex %u is nowhere: it cannot be drawn",
                            v + 1);
    }
    for (size_t h = 0; h < 3 * (size_t)s->face_count; h++)
        if (s->faces[h] >= s->vertex_count)
            return ktg_fail(context, KTG_ARGUMENT, "face %zu names a vertex that is not there",
                            h / 3 + 1);
    return KTG_OK;
}

/* Appends a shape whose left side comes to `left`, its middle to height 0. */
static void add_shape(row *r, const ktg_render_shape *s, double left) {
    ktg_pattern *p = &r->pattern;
    extent e = extent_of(r, s->vertices, s->vertex_count);
    double across = left - e.low.x, up = -(e.low.y + e.high.y) / 2;
    for (size_t h = 0; h < 3 * (size_t)s->face_count; h++)
        p->faces[3 * (size_t)p->face_count + h] = (uint32_t)p->vertex_count + s->faces[h];
    for (uint32_t f = 0; f < s->face_count; f++)
        r->tints[p->face_count + f] = s->tints ? s->tints[f] : 0xffffff;
    for (uint32_t v = 0; v < s->vertex_count; v++)
        p->vertices[p->vertex_count + v] =
            ktg_madd3(ktg_madd3(s->vertices[v], across, r->right), up, r->above);
    p->vertex_count += s->vertex_count;
    p->face_count += s->face_count;
    r->high = fmax(r->high, e.high.y - e.low.y);
}

static double width_of(const row *r, const ktg_render_shape *s) {
    extent e = extent_of(r, s->vertices, s->vertex_count);
    return s->vertex_count > 0 ? e.high.x - e.low.x : 0;
}

static void add_shapes(row *r, const ktg_render_shape *shapes, size_t count) {
    double widest = 0;
    for (size_t i = 0; i < count; i++)
        widest = fmax(widest, width_of(r, &shapes[i]));
    for (size_t i = 0; i < count; i++) {
        if (i > 0)
            r->wide += APART * widest;
        if (shapes[i].vertex_count > 0)
            add_shape(r, &shapes[i], r->wide);
        r->wide += width_of(r, &shapes[i]);
    }
}

/* Every side of a face as a fold, so that it is drawn. */
static ktg_status add_edges(ktg_context *context, row *r) {
    ktg_pattern *p = &r->pattern;
    if (p->face_count > MOST_EDGED)
        return KTG_OK;
    p->edges = ktg_new(context, 3 * (size_t)p->face_count, ktg_pattern_edge);
    if (!p->edges)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < 3 * p->face_count; h++)
        p->edges[p->edge_count++] = (ktg_pattern_edge){.kind = KTG_EDGE_MOUNTAIN,
                                                       .angle = KTG_PI,
                                                       .side_count = 1,
                                                       .sides = {{0, h / 3, h % 3}}};
    return KTG_OK;
}

static ktg_status draw_row(const ktg_drawing *drawing, cairo_t *cairo, const void *what) {
    const row *r = what;
    double frame = FRAME * WIDTH / DOTS_A_MM, wide = WIDTH / DOTS_A_MM;
    double high = wide * ktg_min(1, r->high / r->wide), y = frame + (high - wide) / 2;
    cairo_scale(cairo, DOTS_A_MM, DOTS_A_MM);
    return ktg_solid_draw(drawing, cairo, (ktg_area){frame, y, frame + wide, y + wide}, false);
}

static ktg_status draw(ktg_context *context, row *r, unsigned up, ktg_output *output) {
    ktg_drawing drawing = {.context = context, .pattern = &r->pattern, .tints = r->tints};
    ktg_render_defaults(&drawing.options);
    drawing.options.up = up;
    double high = fmax(1, WIDTH * ktg_min(1, r->high / r->wide));
    return ktg_png_make(&drawing, (int)ceil(WIDTH * (1 + 2 * FRAME)),
                        (int)ceil(high + 2 * FRAME * WIDTH), draw_row, r, output);
}

static ktg_status make_room(ktg_context *context, const ktg_render_shape *shapes, size_t count,
                            row *r) {
    uint64_t vertices = 0, faces = 0;
    for (size_t i = 0; i < count; i++) {
        KTG_TRY(check_shape(context, &shapes[i]));
        vertices += shapes[i].vertex_count;
        faces += shapes[i].face_count;
    }
    if (vertices > INT32_MAX || 3 * faces > INT32_MAX)
        return ktg_fail(context, KTG_LIMIT, "too many faces for a picture");
    r->pattern.vertices = ktg_new(context, vertices, ktg_vec3);
    r->pattern.faces = ktg_new(context, 3 * faces, uint32_t);
    r->tints = ktg_new(context, faces, uint32_t);
    return r->pattern.vertices && r->pattern.faces && r->tints ? KTG_OK : KTG_MEMORY;
}

ktg_status ktg_render_shapes(ktg_context *context, const ktg_render_shape *shapes, size_t count,
                             unsigned up, ktg_output *output) {
    row r = {.wide = 0};
    if (up > 2)
        return ktg_fail(context, KTG_ARGUMENT, "there is no axis %u: 0, 1 or 2 is up", up);
    ktg_solid_eye(up, false, &r.right, &r.above);
    ktg_status status = make_room(context, shapes, count, &r);
    if (status == KTG_OK) {
        add_shapes(&r, shapes, count);
        status = r.wide > 0 ? add_edges(context, &r)
                            : ktg_fail(context, KTG_ARGUMENT, "there is nothing to draw");
    }
    if (status == KTG_OK)
        status = draw(context, &r, up, output);
    ktg_free(r.pattern.vertices);
    ktg_free(r.pattern.faces);
    ktg_free(r.pattern.edges);
    ktg_free(r.tints);
    return status;
}
