/* flatten/overlap.c - does the flat panel lie on itself? When no face is flipped, it does exactly
 * when its border crosses itself, or when the faces around a point of the border (where a slit
 * ends) take more than a whole turn: there both sides of the slit cross in the point itself. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>
#include <stdlib.h>

/* Borders that merely touch (the two sides of a slit) come out crossed by rounding; they count as
 * crossed when each end is further than this from the other segment's line, in normalised units. */
static const double crossing_depth = 1e-9;

typedef struct border_segment {
    double left, right; /* range of x */
    ktg_vec2 a, b;
    uint32_t vertex; /* where it starts */
} border_segment;

static uint32_t list_border(const ktg_panel *panel, const ktg_vec2 *flat,
                            border_segment *segments) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++) {
        if (panel->adjacency->twin[h] != KTG_NONE)
            continue;
        ktg_vec2 a = flat[panel->faces[h]], b = flat[panel->faces[ktg_halfedge_next(h)]];
        segments[count++] = (border_segment){fmin(a.x, b.x), fmax(a.x, b.x), a, b, panel->faces[h]};
    }
    return count;
}

static int from_left_to_right(const void *a, const void *b) {
    const border_segment *s = a, *t = b;
    if (s->left != t->left)
        return s->left < t->left ? -1 : 1;
    return (s->vertex > t->vertex) - (s->vertex < t->vertex);
}

/* Do the ends of `other` lie on different sides of the line through `segment`, clear of it? */
static bool is_split_by(const border_segment *other, const border_segment *segment) {
    ktg_vec2 along = ktg_unit2(ktg_sub2(segment->b, segment->a));
    double start = ktg_cross2(along, ktg_sub2(other->a, segment->a));
    double end = ktg_cross2(along, ktg_sub2(other->b, segment->a));
    return fmin(fabs(start), fabs(end)) > crossing_depth && (start > 0) != (end > 0);
}

/* Sweeps over the segments by x; the first pair that crosses. */
static bool find_crossing(border_segment *segments, uint32_t count, uint32_t vertices[2]) {
    qsort(segments, count, sizeof *segments, from_left_to_right);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count && segments[j].left <= segments[i].right; j++)
            if (is_split_by(&segments[i], &segments[j]) &&
                is_split_by(&segments[j], &segments[i])) {
                vertices[0] = segments[i].vertex;
                vertices[1] = segments[j].vertex;
                return true;
            }
    return false;
}

/* What the faces around vertex v take of a turn there, and the shortest of their edges from v. */
static double angle_around(const ktg_panel *panel, const ktg_vec2 *flat, uint32_t v,
                           double *shortest) {
    uint32_t h = panel->leaving[v];
    double angle = 0;
    *shortest = INFINITY;
    do {
        uint32_t next = ktg_halfedge_next(h), last = ktg_halfedge_next(next);
        ktg_vec2 a = ktg_sub2(flat[panel->faces[next]], flat[v]);
        ktg_vec2 b = ktg_sub2(flat[panel->faces[last]], flat[v]);
        angle += atan2(ktg_cross2(a, b), ktg_dot2(a, b));
        *shortest = fmin(*shortest, fmin(ktg_length2(a), ktg_length2(b)));
        h = ktg_panel_around(panel, h);
    } while (h != panel->leaving[v] && h != KTG_NONE);
    return angle;
}

static bool find_overfull(const ktg_panel *panel, const ktg_vec2 *flat, uint32_t vertices[2]) {
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++) {
        double shortest;
        if (panel->adjacency->twin[h] != KTG_NONE)
            continue;
        double beyond = angle_around(panel, flat, panel->faces[h], &shortest) - 2 * KTG_PI;
        if (beyond * shortest > crossing_depth) {
            vertices[0] = vertices[1] = panel->faces[h];
            return true;
        }
    }
    return false;
}

ktg_status ktg_panel_find_crossing(ktg_context *context, const ktg_panel *panel,
                                   const ktg_vec2 *flat, bool *crossed, uint32_t vertices[2]) {
    border_segment *segments = ktg_new(context, panel->adjacency->halfedge_count, border_segment);
    if (!segments)
        return KTG_MEMORY;
    *crossed = find_overfull(panel, flat, vertices) ||
               find_crossing(segments, list_border(panel, flat, segments), vertices);
    ktg_free(segments);
    return KTG_OK;
}

ktg_status ktg_panel_check_overlap(ktg_context *context, const ktg_panel *panel,
                                   const ktg_vec2 *flat, const uint32_t *names) {
    uint32_t vertices[2];
    bool crossed;
    KTG_TRY(ktg_panel_find_crossing(context, panel, flat, &crossed, vertices));
    if (!crossed)
        return KTG_OK;
    uint32_t a = names[vertices[0]] + 1, b = names[vertices[1]] + 1;
    if (a == b) /* both sides of one slit */
        return ktg_fail(context, KTG_GEOMETRY,
                        "laid flat, the panel lies on itself: both sides of a cut pass each other "
                        "at vertex %u; lead that cut on through the panel by a seam first",
                        a);
    return ktg_fail(context, KTG_GEOMETRY,
                    "laid flat, the panel lies on itself: its border crosses itself near vertices "
                    "%u and %u; cut it in two by a seam between them first",
                    a, b);
}
