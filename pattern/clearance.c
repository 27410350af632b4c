/* pattern/clearance.c - where a piece of cloth comes near itself, its two allowances have to share
 * what lies between them.
 *
 * Beside the end of a slit they are one anyway; that is no concern of anybody's. */
#include "core/memory.h"
#include "pattern/cloth.h"
#include "pattern/grid.h"

/* Two places of the border are neighbours, whatever lies between them, up to so many times both
 * allowances along it. */
#define NEIGHBOURS 3.0

/* The way between them leaves the piece by more than this sine. */
#define OUTSIDE 0.05

/* At a corner the allowance reaches up to so many times further than along the border. */
#define CORNERS 2.0

/* Each leaves a little of its half. */
#define HALF 0.98

/* The border of one piece. */
typedef struct walk {
    const ktg_cloth *cloth;
    uint32_t first, count;
    double *along; /* count + 1: length of the border up to each half-edge; darts are closed */
    ktg_box *boxes;
    ktg_grid grid;
} walk;

static uint32_t halfedge_at(const walk *w, uint32_t k) {
    return w->cloth->topology->border[w->first + k];
}

static double width_at(const walk *w, uint32_t k) {
    return ktg_allowance_at(w->cloth->topology, w->cloth->options, halfedge_at(w, k));
}

static ktg_status open_walk(ktg_context *context, const ktg_cloth *cloth, uint32_t piece, walk *w) {
    const ktg_topology *t = cloth->topology;
    *w = (walk){.cloth = cloth,
                .first = t->border_first[piece],
                .count = t->border_first[piece + 1] - t->border_first[piece]};
    w->along = ktg_new(context, (size_t)w->count + 1, double);
    w->boxes = ktg_new(context, w->count, ktg_box);
    if (!w->along || !w->boxes)
        return KTG_MEMORY;
    for (uint32_t k = 0; k < w->count; k++) {
        ktg_vec2 ends[2] = {ktg_start_of(t, halfedge_at(w, k)), ktg_end_of(t, halfedge_at(w, k))};
        double length = ktg_length2(ktg_sub2(ends[1], ends[0]));
        w->along[k + 1] = w->along[k] + (ktg_is_dart(t, halfedge_at(w, k)) ? 0 : length);
        w->boxes[k] = ktg_box_of(ends, 2);
    }
    return ktg_grid_build(context, w->boxes, w->count, &w->grid);
}

static void close_walk(walk *w) {
    ktg_grid_drop(&w->grid);
    ktg_free(w->along);
    ktg_free(w->boxes);
}

static ktg_vec2 nearest_point(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 ab = ktg_sub2(b, a);
    double square = ktg_dot2(ab, ab);
    double t = square > 0 ? fmax(0, fmin(1, ktg_dot2(ktg_sub2(p, a), ab) / square)) : 0;
    return ktg_madd2(a, t, ab);
}

/* Along the border from the vertex before place i to the nearer end of the half-edge at place k. */
static double apart_along(const walk *w, uint32_t i, uint32_t k) {
    double least = INFINITY, whole = w->along[w->count];
    for (uint32_t end = 0; end < 2; end++) {
        double way = fabs(w->along[i] - w->along[k + end]);
        least = fmin(least, fmin(way, whole - way));
    }
    return least;
}

/* What the half-edge at place k leaves to the vertex before place i, whose way out is `out`. */
static double room_beside(const walk *w, uint32_t i, ktg_vec2 out, uint32_t k) {
    const ktg_topology *t = w->cloth->topology;
    uint32_t g = halfedge_at(w, k);
    double mine = width_at(w, i), its = width_at(w, k);
    if (ktg_is_dart(t, g) || apart_along(w, i, k) < NEIGHBOURS * (mine + its))
        return INFINITY;
    ktg_vec2 p = ktg_start_of(t, halfedge_at(w, i));
    ktg_vec2 d = ktg_sub2(nearest_point(p, ktg_start_of(t, g), ktg_end_of(t, g)), p);
    double distance = ktg_length2(d);
    if (ktg_dot2(d, out) < OUTSIDE * distance || distance >= CORNERS * (mine + its))
        return INFINITY; /* across the piece itself, or far away */
    return HALF * distance * mine / (mine + its);
}

static double room_of(walk *w, uint32_t i) {
    const ktg_topology *t = w->cloth->topology;
    uint32_t h = halfedge_at(w, i), before = ktg_border_previous(t, h);
    double widest = fmax(w->cloth->options->allowance_mm, w->cloth->options->hem_mm);
    double room = INFINITY;
    if (ktg_is_dart(t, h) && ktg_is_dart(t, before))
        return room;
    ktg_vec2 p = ktg_start_of(t, h);
    ktg_vec2 out =
        ktg_unit2(ktg_add2(ktg_outward(ktg_along(t, before)), ktg_outward(ktg_along(t, h))));
    uint32_t found = ktg_grid_query(&w->grid, ktg_box_grown((ktg_box){p, p}, 2 * CORNERS * widest));
    for (uint32_t n = 0; n < found; n++)
        room = fmin(room, room_beside(w, i, out, w->grid.found[n]));
    return room;
}

ktg_status ktg_clearances_find(ktg_context *context, ktg_cloth *cloth) {
    for (uint32_t p = 0; p < cloth->pattern->piece_count; p++) {
        walk w;
        ktg_status status = open_walk(context, cloth, p, &w);
        for (uint32_t i = 0; status == KTG_OK && i < w.count; i++)
            cloth->room[w.first + i] = room_of(&w, i);
        close_walk(&w);
        KTG_TRY(status);
    }
    return KTG_OK;
}
