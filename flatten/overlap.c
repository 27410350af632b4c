/* flatten/overlap.c - does the flat panel lie on itself? When no face is flipped, it does exactly
 * when its border crosses itself, or when the faces around a point of the border (where a slit
 * ends) take more than a whole turn: there both sides of the slit cross in the point itself. Where
 * parts of the border lie on each other, as those of boxes do, neither shows; but then a face at
 * the border lies on another face. */
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

/* ---- faces on each other ------------------------------------------------------------------ */

/* A face with its range along x and y, lengthwise first. */
typedef struct flat_face {
    double low, high, low_across, high_across;
    ktg_vec2 corners[3];
    uint32_t vertex; /* its first corner */
    bool at_border;  /* it has an edge there */
} flat_face;

static void turn_lengthwise(double *a, double *b) {
    double kept = *a;
    *a = *b;
    *b = kept;
}

static flat_face flat_face_of(const ktg_panel *panel, const ktg_vec2 *flat, uint32_t f) {
    const uint32_t *c = panel->faces + 3 * (size_t)f,
                   *twin = panel->adjacency->twin + 3 * (size_t)f;
    ktg_vec2 p = flat[c[0]], q = flat[c[1]], r = flat[c[2]];
    return (flat_face){.low = fmin(p.x, fmin(q.x, r.x)),
                       .high = fmax(p.x, fmax(q.x, r.x)),
                       .low_across = fmin(p.y, fmin(q.y, r.y)),
                       .high_across = fmax(p.y, fmax(q.y, r.y)),
                       .corners = {p, q, r},
                       .vertex = c[0],
                       .at_border =
                           twin[0] == KTG_NONE || twin[1] == KTG_NONE || twin[2] == KTG_NONE};
}

/* All faces, so that a sweep goes along the longer side of the panel's box. */
static void list_faces(const ktg_panel *panel, const ktg_vec2 *flat, flat_face *faces) {
    double low = INFINITY, high = -INFINITY, low_across = INFINITY, high_across = -INFINITY;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        faces[f] = flat_face_of(panel, flat, f);
        low = fmin(low, faces[f].low), high = fmax(high, faces[f].high);
        low_across = fmin(low_across, faces[f].low_across);
        high_across = fmax(high_across, faces[f].high_across);
    }
    for (uint32_t f = 0; high - low < high_across - low_across && f < panel->face_count; f++) {
        turn_lengthwise(&faces[f].low, &faces[f].low_across);
        turn_lengthwise(&faces[f].high, &faces[f].high_across);
    }
}

static int by_low_end(const void *a, const void *b) {
    const flat_face *f = a, *g = b;
    if (f->low != g->low)
        return f->low < g->low ? -1 : 1;
    return (f->vertex > g->vertex) - (f->vertex < g->vertex);
}

/* True when an edge of `face` has all of `other` on its outer side, but for a little. */
static bool edge_parts(const ktg_vec2 face[3], const ktg_vec2 other[3]) {
    for (int k = 0; k < 3; k++) {
        ktg_vec2 along = ktg_unit2(ktg_sub2(face[(k + 1) % 3], face[k]));
        double inside = -INFINITY;
        for (int i = 0; i < 3; i++)
            inside = fmax(inside, ktg_cross2(along, ktg_sub2(other[i], face[k])));
        if (inside <= crossing_depth)
            return true;
    }
    return false;
}

static bool lie_on_each_other(const flat_face *a, const flat_face *b) {
    return a->low_across < b->high_across && b->low_across < a->high_across &&
           !edge_parts(a->corners, b->corners) && !edge_parts(b->corners, a->corners);
}

static bool find_double(flat_face *faces, uint32_t count, uint32_t vertices[2]) {
    qsort(faces, count, sizeof *faces, by_low_end);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count && faces[j].low < faces[i].high; j++)
            if ((faces[i].at_border || faces[j].at_border) &&
                lie_on_each_other(&faces[i], &faces[j])) {
                vertices[0] = faces[i].vertex;
                vertices[1] = faces[j].vertex;
                return true;
            }
    return false;
}

/* ---- all ---------------------------------------------------------------------------------- */

ktg_status ktg_panel_find_crossing(ktg_context *context, const ktg_panel *panel,
                                   const ktg_vec2 *flat, bool *crossed, uint32_t vertices[2]) {
    border_segment *segments = ktg_new(context, panel->adjacency->halfedge_count, border_segment);
    flat_face *faces = ktg_new(context, panel->face_count, flat_face);
    ktg_status status = segments && faces ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        list_faces(panel, flat, faces);
        *crossed = find_overfull(panel, flat, vertices) ||
                   find_crossing(segments, list_border(panel, flat, segments), vertices) ||
                   find_double(faces, panel->face_count, vertices);
    }
    ktg_free(segments);
    ktg_free(faces);
    return status;
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
