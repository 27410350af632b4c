/* render/cut_edges.c - edges of outlines that lie together: found by a grid of their points. */
#include "render/cut_edges.h"

#include "core/memory.h"

#include <stdlib.h>

static ktg_status append(ktg_cut_edges *edges, uint32_t a, uint32_t b, uint32_t walk) {
    if (a == b)
        return KTG_OK;
    KTG_TRY(ktg_reserve(edges->weld.context, &edges->items, &edges->capacity, edges->count + 1));
    edges->items[edges->count++] = (ktg_cut_edge){a, b, walk, KTG_CUT_LOOP};
    return KTG_OK;
}

ktg_status ktg_cut_edges_enter(ktg_cut_edges *edges, uint32_t walk, const ktg_pattern_placement *at,
                               const ktg_pattern_piece *piece) {
    uint32_t first = 0, last = 0, next;
    for (size_t i = 0; i < piece->outline_count; i++) {
        KTG_TRY(ktg_weld_point(&edges->weld, ktg_plot_point(at, piece->outline[i]), &next));
        if (i == 0)
            first = next;
        else
            KTG_TRY(append(edges, last, next, walk));
        last = next;
    }
    return append(edges, last, first, walk);
}

void ktg_cut_edges_drop(ktg_cut_edges *edges) {
    ktg_weld_drop(&edges->weld);
    ktg_free(edges->items);
    *edges = (ktg_cut_edges){0};
}

/* ---- a grid of the points ------------------------------------------------------------------- */

typedef struct grid {
    ktg_vec2 low;
    double cell;
    int64_t wide, high;
    size_t *first; /* cells + 1: into `points` */
    uint32_t *points;
} grid;

static int64_t column(const grid *g, double x) {
    return (int64_t)fmin(fmax(floor((x - g->low.x) / g->cell), 0), (double)(g->wide - 1));
}

static int64_t row(const grid *g, double y) {
    return (int64_t)fmin(fmax(floor((y - g->low.y) / g->cell), 0), (double)(g->high - 1));
}

static size_t cell_of(const grid *g, ktg_vec2 p) {
    return (size_t)(row(g, p.y) * g->wide + column(g, p.x));
}

/* About one point to a cell. */
static void measure(grid *g, const ktg_weld *weld) {
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < weld->count; i++) {
        low = (ktg_vec2){fmin(low.x, weld->points[i].x), fmin(low.y, weld->points[i].y)};
        high = (ktg_vec2){fmax(high.x, weld->points[i].x), fmax(high.y, weld->points[i].y)};
    }
    ktg_vec2 size = ktg_sub2(high, low);
    double longest = fmax(size.x, size.y);
    g->low = low;
    g->cell = fmax(sqrt(size.x * size.y / (double)weld->count), longest / 4096);
    g->cell = fmax(g->cell, weld->tolerance);
    g->wide = (int64_t)(size.x / g->cell) + 1;
    g->high = (int64_t)(size.y / g->cell) + 1;
}

static ktg_status sort_points(grid *g, const ktg_weld *weld) {
    size_t cells = (size_t)(g->wide * g->high);
    g->first = ktg_new(weld->context, cells + 2, size_t);
    g->points = ktg_new(weld->context, weld->count, uint32_t);
    if (!g->first || !g->points)
        return KTG_MEMORY;
    for (size_t i = 0; i < weld->count; i++)
        g->first[cell_of(g, weld->points[i]) + 2]++;
    for (size_t c = 0; c < cells; c++)
        g->first[c + 2] += g->first[c + 1];
    for (size_t i = 0; i < weld->count; i++)
        g->points[g->first[cell_of(g, weld->points[i]) + 1]++] = (uint32_t)i;
    return KTG_OK;
}

/* ---- splitting ---------------------------------------------------------------------------- */

typedef struct stop {
    double along;
    uint32_t point;
} stop;

typedef struct splitting {
    const ktg_weld *weld;
    grid grid;
    size_t count, capacity;
    stop *stops; /* of the edge at hand */
} splitting;

static int by_along(const void *a, const void *b) {
    const stop *x = a, *y = b;
    if (x->along != y->along)
        return x->along < y->along ? -1 : 1;
    return x->point < y->point ? -1 : x->point > y->point;
}

/* Adds the point where it lies on the edge, and not at its ends. */
static ktg_status consider(splitting *s, const ktg_cut_edge *edge, uint32_t point) {
    ktg_vec2 from = s->weld->points[edge->a], way = ktg_sub2(s->weld->points[edge->b], from);
    ktg_vec2 to = ktg_sub2(s->weld->points[point], from);
    double length = ktg_length2(way), along = ktg_dot2(way, to) / length;
    if (point == edge->a || point == edge->b || along <= 0 || along >= length ||
        fabs(ktg_cross2(way, to)) > s->weld->tolerance * length)
        return KTG_OK;
    KTG_TRY(ktg_reserve(s->weld->context, &s->stops, &s->capacity, s->count + 1));
    s->stops[s->count++] = (stop){along, point};
    return KTG_OK;
}

/* The columns that the edge, with the tolerance around it, crosses in a row of cells. */
static void columns_in_row(const splitting *s, ktg_vec2 a, ktg_vec2 b, int64_t r, int64_t *from,
                           int64_t *to) {
    const grid *g = &s->grid;
    double bottom = g->low.y + (double)r * g->cell - s->weld->tolerance;
    double top = bottom + g->cell + 2 * s->weld->tolerance, begin = 0, end = 1;
    if (a.y != b.y) {
        double t = (bottom - a.y) / (b.y - a.y), u = (top - a.y) / (b.y - a.y);
        begin = fmin(fmax(fmin(t, u), 0), 1);
        end = fmin(fmax(fmax(t, u), 0), 1);
    }
    double x = a.x + begin * (b.x - a.x), y = a.x + end * (b.x - a.x);
    *from = column(g, fmin(x, y) - s->weld->tolerance);
    *to = column(g, fmax(x, y) + s->weld->tolerance);
}

static ktg_status find_stops(splitting *s, const ktg_cut_edge *edge) {
    const grid *g = &s->grid;
    ktg_vec2 a = s->weld->points[edge->a], b = s->weld->points[edge->b];
    int64_t last = row(g, fmax(a.y, b.y) + s->weld->tolerance), from, to;
    s->count = 0;
    for (int64_t r = row(g, fmin(a.y, b.y) - s->weld->tolerance); r <= last; r++) {
        columns_in_row(s, a, b, r, &from, &to);
        for (size_t k = g->first[r * g->wide + from]; k < g->first[r * g->wide + to + 1]; k++)
            KTG_TRY(consider(s, edge, g->points[k]));
    }
    if (s->count > 1)
        qsort(s->stops, s->count, sizeof *s->stops, by_along);
    return KTG_OK;
}

static ktg_status split_all(splitting *s, const ktg_cut_edges *edges, ktg_cut_edges *split) {
    for (size_t i = 0; i < edges->count; i++) {
        const ktg_cut_edge *edge = &edges->items[i];
        uint32_t from = edge->a;
        KTG_TRY(find_stops(s, edge));
        for (size_t k = 0; k < s->count; k++) {
            KTG_TRY(append(split, from, s->stops[k].point, edge->walk));
            from = s->stops[k].point;
        }
        KTG_TRY(append(split, from, edge->b, edge->walk));
    }
    return KTG_OK;
}

ktg_status ktg_cut_edges_split(ktg_cut_edges *edges) {
    splitting s = {.weld = &edges->weld};
    ktg_cut_edges split = {.weld.context = edges->weld.context};
    if (edges->count == 0)
        return KTG_OK;
    measure(&s.grid, s.weld);
    ktg_status status = sort_points(&s.grid, s.weld);
    if (status == KTG_OK)
        status = split_all(&s, edges, &split);
    if (status == KTG_OK) {
        ktg_free(edges->items);
        edges->items = split.items;
        edges->count = split.count;
        edges->capacity = split.capacity;
        split.items = NULL;
    }
    ktg_free(split.items);
    ktg_free(s.grid.first);
    ktg_free(s.grid.points);
    ktg_free(s.stops);
    return status;
}

/* ---- matching ----------------------------------------------------------------------------- */

typedef struct keyed {
    uint32_t low, high;
    size_t edge;
} keyed;

static int by_key(const void *a, const void *b) {
    const keyed *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->edge < y->edge ? -1 : x->edge > y->edge;
}

/* Edges between the same two points, the earliest first: it is cut, the others are not. */
static void settle(ktg_cut_edges *edges, const keyed *keys, size_t count) {
    ktg_cut_edge *first = &edges->items[keys[0].edge];
    for (size_t k = 1; k < count; k++) {
        ktg_cut_edge *other = &edges->items[keys[k].edge];
        if (k == 1 && other->walk == first->walk)
            first->state = KTG_CUT_SLIT;
        other->state = KTG_CUT_DONE;
    }
}

ktg_status ktg_cut_edges_match(ktg_cut_edges *edges) {
    keyed *keys = ktg_new(edges->weld.context, edges->count, keyed);
    if (!keys)
        return KTG_MEMORY;
    for (size_t i = 0; i < edges->count; i++) {
        uint32_t a = edges->items[i].a, b = edges->items[i].b;
        keys[i] = (keyed){a < b ? a : b, a < b ? b : a, i};
    }
    if (edges->count > 1)
        qsort(keys, edges->count, sizeof *keys, by_key);
    for (size_t begin = 0, end; begin < edges->count; begin = end) {
        for (end = begin + 1; end < edges->count; end++)
            if (keys[end].low != keys[begin].low || keys[end].high != keys[begin].high)
                break;
        settle(edges, keys + begin, end - begin);
    }
    ktg_free(keys);
    return KTG_OK;
}
