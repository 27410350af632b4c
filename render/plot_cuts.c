/* render/plot_cuts.c - the cuts of a sheet, each cut once, from the inside out.
 *
 * An outline is one walk around a piece: a slit, or the bridge to a hole, is walked on both sides.
 * Edges of all walks are split where others touch them (cut_edges.c); an edge that a walk comes
 * along twice is a slit, one that another piece's walk has come along is cut already, and what is
 * left of a walk falls into loops: outlines run counter-clockwise, holes clockwise. */
#include "render/cut_edges.h"

#include "core/memory.h"

#include <stdlib.h>

/* A loop, or a part of one whose rest is cut with another piece. */
typedef struct loop {
    size_t first, count; /* of cutting.corners */
    bool closed;
    bool is_hole;
} loop;

typedef struct cutting {
    ktg_plot *plot;
    ktg_cut_edges edges;
    size_t loop_count, loop_capacity;
    loop *loops;
    size_t corner_count, corner_capacity;
    ktg_vec2 *corners;
    int32_t *loose; /* of each point: how many edges begin there less how many end there */
} cutting;

/* ---- slits -------------------------------------------------------------------------------- */

static ktg_status add_slit(void *user, const ktg_vec2 *points, size_t count, bool closed) {
    return ktg_plot_add(user, KTG_LAYER_CUT, KTG_STROKE_CUT, points, count, closed);
}

static ktg_status add_slits(cutting *c) {
    const ktg_cut_edges *edges = &c->edges;
    ktg_segment *slits = ktg_new(edges->weld.context, edges->count, ktg_segment);
    size_t count = 0;
    if (!slits)
        return KTG_MEMORY;
    for (size_t i = 0; i < edges->count; i++)
        if (edges->items[i].state == KTG_CUT_SLIT)
            slits[count++] = (ktg_segment){edges->items[i].a, edges->items[i].b};
    ktg_status status = ktg_trails_join(&edges->weld, slits, count, add_slit, c->plot);
    ktg_free(slits);
    return status;
}

/* ---- loops -------------------------------------------------------------------------------- */

/* The edge of the walk [begin, end) that goes on from edge `i`: the next one, or, where that is no
 * part of a loop, the next that begins at the same point; `end` where there is none. */
static size_t next_edge(const ktg_cut_edges *edges, size_t begin, size_t end, size_t i) {
    for (size_t k = 1; k <= end - begin; k++) {
        size_t j = begin + (i - begin + k) % (end - begin);
        if (edges->items[j].state == KTG_CUT_LOOP && edges->items[j].a == edges->items[i].b)
            return j;
    }
    return end;
}

static ktg_status add_corner(cutting *c, uint32_t point) {
    KTG_TRY(
        ktg_reserve(c->edges.weld.context, &c->corners, &c->corner_capacity, c->corner_count + 1));
    c->corners[c->corner_count++] = c->edges.weld.points[point];
    return KTG_OK;
}

static double twice_area(const ktg_vec2 *points, size_t count) {
    double twice = 0;
    for (size_t i = 1; i + 1 < count; i++)
        twice += ktg_cross2(ktg_sub2(points[i], points[0]), ktg_sub2(points[i + 1], points[0]));
    return twice;
}

static ktg_status trace(cutting *c, size_t begin, size_t end, size_t start) {
    ktg_cut_edges *edges = &c->edges;
    size_t first = c->corner_count, i = start;
    uint32_t origin = edges->items[start].a, last = origin;
    KTG_TRY(add_corner(c, origin));
    while (i != end) {
        edges->items[i].state = KTG_CUT_DONE;
        last = edges->items[i].b;
        c->loose[edges->items[i].a]--;
        c->loose[last]++;
        i = next_edge(edges, begin, end, i);
        if (i != end || last != origin)
            KTG_TRY(add_corner(c, last));
    }
    bool closed = last == origin;
    size_t count = c->corner_count - first;
    KTG_TRY(ktg_reserve(edges->weld.context, &c->loops, &c->loop_capacity, c->loop_count + 1));
    c->loops[c->loop_count++] =
        (loop){first, count, closed, closed && twice_area(c->corners + first, count) < 0};
    return KTG_OK;
}

/* The loops of the walk [begin, end): what is open first, from its beginning. */
static ktg_status trace_walk(cutting *c, size_t begin, size_t end) {
    const ktg_cut_edge *items = c->edges.items;
    for (size_t i = begin; i < end; i++)
        if (items[i].state == KTG_CUT_LOOP) {
            c->loose[items[i].a]++;
            c->loose[items[i].b]--;
        }
    for (size_t i = begin; i < end; i++)
        if (items[i].state == KTG_CUT_LOOP && c->loose[items[i].a] > 0)
            KTG_TRY(trace(c, begin, end, i));
    for (size_t i = begin; i < end; i++)
        if (items[i].state == KTG_CUT_LOOP)
            KTG_TRY(trace(c, begin, end, i));
    return KTG_OK;
}

static ktg_status trace_all(cutting *c) {
    c->loose = ktg_new(c->edges.weld.context, c->edges.weld.count, int32_t);
    if (!c->loose)
        return KTG_MEMORY;
    for (size_t begin = 0, end; begin < c->edges.count; begin = end) {
        for (end = begin; end < c->edges.count; end++)
            if (c->edges.items[end].walk != c->edges.items[begin].walk)
                break;
        KTG_TRY(trace_walk(c, begin, end));
    }
    return KTG_OK;
}

static ktg_status add_loops(cutting *c, bool holes) {
    for (size_t i = 0; i < c->loop_count; i++) {
        const loop *l = &c->loops[i];
        if (l->is_hole == holes)
            KTG_TRY(ktg_plot_add(c->plot, KTG_LAYER_CUT, KTG_STROKE_CUT, c->corners + l->first,
                                 l->count, l->closed));
    }
    return KTG_OK;
}

/* ---- the order of pieces -------------------------------------------------------------------- */

typedef struct sized {
    double area;
    size_t index;
} sized;

static int by_area(const void *a, const void *b) {
    const sized *x = a, *y = b;
    if (x->area != y->area)
        return x->area < y->area ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

/* The sheet's outlines from the smallest to the largest: one piece may lie in another's bay. */
static ktg_status enter_walks(cutting *c) {
    const ktg_pattern_sheet *sheet = c->plot->page.sheet;
    const ktg_pattern_piece *pieces = c->plot->page.drawing->pattern->pieces;
    sized *order = ktg_new(c->edges.weld.context, sheet->placement_count, sized);
    ktg_status status = order ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; order && i < sheet->placement_count; i++) {
        const ktg_pattern_piece *piece = &pieces[sheet->placements[i].piece];
        order[i] = (sized){twice_area(piece->outline, piece->outline_count), i};
    }
    if (order)
        qsort(order, sheet->placement_count, sizeof *order, by_area);
    for (size_t i = 0; status == KTG_OK && i < sheet->placement_count; i++) {
        const ktg_pattern_placement *at = &sheet->placements[order[i].index];
        status = ktg_cut_edges_enter(&c->edges, (uint32_t)i, at, &pieces[at->piece]);
    }
    ktg_free(order);
    return status;
}

static ktg_status cut(cutting *c) {
    KTG_TRY(enter_walks(c));
    KTG_TRY(ktg_cut_edges_split(&c->edges));
    KTG_TRY(ktg_cut_edges_match(&c->edges));
    KTG_TRY(add_slits(c));
    KTG_TRY(trace_all(c));
    KTG_TRY(add_loops(c, true));
    return add_loops(c, false);
}

ktg_status ktg_plot_cuts(ktg_plot *plot) {
    cutting c = {.plot = plot};
    c.edges.weld.context = plot->page.drawing->context;
    c.edges.weld.tolerance = KTG_CUT_TOGETHER_MM;
    ktg_status status = cut(&c);
    ktg_cut_edges_drop(&c.edges);
    ktg_free(c.loops);
    ktg_free(c.corners);
    ktg_free(c.loose);
    return status;
}
