/* flatten/path.c - short paths along the edges of a sheet. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

/* ---- a heap whose keys may fall ------------------------------------------------------------ */

typedef struct heap {
    uint32_t count;
    uint32_t *items; /* by key, as a binary heap */
    uint32_t *place; /* of each item in `items`, or KTG_NONE */
    double *key;     /* of each item */
} heap;

static ktg_status heap_new(ktg_context *context, size_t most, heap *h) {
    *h = (heap){0, ktg_new(context, most, uint32_t), ktg_new(context, most, uint32_t),
                ktg_new(context, most, double)};
    if (!h->items || !h->place || !h->key)
        return KTG_MEMORY;
    for (size_t i = 0; i < most; i++) {
        h->place[i] = KTG_NONE;
        h->key[i] = INFINITY;
    }
    return KTG_OK;
}

static void heap_free(heap *h) {
    ktg_free(h->items);
    ktg_free(h->place);
    ktg_free(h->key);
}

/* Equal keys go by number, so that the order is that of nothing else. */
static bool is_before(const heap *h, uint32_t a, uint32_t b) {
    return h->key[a] < h->key[b] || (h->key[a] == h->key[b] && a < b);
}

static void put(heap *h, uint32_t at, uint32_t item) {
    h->items[at] = item;
    h->place[item] = at;
}

static void rise(heap *h, uint32_t at) {
    uint32_t item = h->items[at];
    while (at > 0 && is_before(h, item, h->items[(at - 1) / 2])) {
        put(h, at, h->items[(at - 1) / 2]);
        at = (at - 1) / 2;
    }
    put(h, at, item);
}

static void sink(heap *h, uint32_t at) {
    uint32_t item = h->items[at];
    for (uint32_t child = 2 * at + 1; child < h->count; child = 2 * at + 1) {
        if (child + 1 < h->count && is_before(h, h->items[child + 1], h->items[child]))
            child++;
        if (!is_before(h, h->items[child], item))
            break;
        put(h, at, h->items[child]);
        at = child;
    }
    put(h, at, item);
}

/* Gives the item this key where that is lower than what it had. */
static bool heap_lower(heap *h, uint32_t item, double key) {
    if (!(key < h->key[item]))
        return false;
    h->key[item] = key;
    if (h->place[item] == KTG_NONE)
        put(h, h->count++, item);
    rise(h, h->place[item]);
    return true;
}

static uint32_t heap_take(heap *h) {
    uint32_t item = h->items[0];
    h->place[item] = KTG_NONE;
    if (--h->count > 0) {
        put(h, 0, h->items[h->count]);
        sink(h, 0);
    }
    return item;
}

/* ---- distances ----------------------------------------------------------------------------- */

static void spread(const ktg_sheet *s, const double *cost, heap *h, uint32_t *via) {
    while (h->count > 0) {
        uint32_t v = heap_take(h);
        for (uint32_t i = s->first[v]; i < s->first[v + 1]; i++) {
            uint32_t e = s->around[i], w = ktg_sheet_other_end(s, e, v);
            if (heap_lower(h, w, h->key[v] + cost[e]) && via)
                via[w] = e;
        }
    }
}

ktg_status ktg_path_distances(ktg_context *context, const ktg_sheet *sheet, const double *cost,
                              const bool *from, double *distance, uint32_t *via) {
    heap h;
    ktg_status status = heap_new(context, sheet->mesh->vertex_count, &h);
    if (status == KTG_OK) {
        for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++) {
            if (via)
                via[v] = KTG_NONE;
            if (from[v])
                (void)heap_lower(&h, v, 0);
        }
        spread(sheet, cost, &h, via);
        for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++)
            distance[v] = h.key[v];
    }
    heap_free(&h);
    return status;
}

/* ---- paths that bend little ---------------------------------------------------------------- */

/* What a turn by one radian costs, as part of the mean edge. */
static const double bend_cost = 0.5;

/* A state is an edge taken in one direction: 2 e towards its second end, 2 e + 1 towards its
 * first. */
typedef struct search {
    const ktg_path_query *query;
    heap heap;
    uint32_t *before; /* of each state the one before it, or KTG_NONE */
} search;

static uint32_t state_head(const ktg_sheet *s, uint32_t state) {
    return s->ends[state ^ 1];
}
static uint32_t state_tail(const ktg_sheet *s, uint32_t state) {
    return s->ends[state];
}

static ktg_vec3 state_direction(const ktg_sheet *s, uint32_t state) {
    const ktg_vec3 *p = s->mesh->positions;
    return ktg_unit3(ktg_sub3(p[state_head(s, state)], p[state_tail(s, state)]));
}

/* A crease may turn as it likes. */
static double bend(const ktg_sheet *s, uint32_t from, uint32_t to) {
    if (ktg_sheet_is_crease(s, from / 2) && ktg_sheet_is_crease(s, to / 2))
        return 0;
    ktg_vec3 a = state_direction(s, from), b = state_direction(s, to);
    double angle = atan2(ktg_length3(ktg_cross3(a, b)), ktg_dot3(a, b));
    return bend_cost * s->mean_edge * angle * angle;
}

static bool may_take(const ktg_path_query *q, uint32_t state) {
    uint32_t head = state_head(q->sheet, state), edge = state / 2;
    if (q->edges_only ? !q->edges_only[edge] : ktg_sheet_is_border(q->sheet, edge))
        return false;
    return q->to[head] || !(q->from[head] || (q->forbidden && q->forbidden[head]));
}

static uint32_t state_leaving(const ktg_sheet *s, uint32_t edge, uint32_t vertex) {
    return 2 * edge + (s->ends[2 * (size_t)edge] == vertex ? 0 : 1);
}

static void reach(search *r, uint32_t vertex, uint32_t before) {
    const ktg_path_query *q = r->query;
    const ktg_sheet *s = q->sheet;
    for (uint32_t i = s->first[vertex]; i < s->first[vertex + 1]; i++) {
        uint32_t state = state_leaving(s, s->around[i], vertex);
        if (!may_take(q, state) || state / 2 == q->straight_on)
            continue;
        double key = q->cost[s->around[i]];
        if (before != KTG_NONE)
            key += r->heap.key[before] + bend(s, before, state);
        else if (q->straight_on != KTG_NONE)
            key += bend(s, state_leaving(s, q->straight_on, vertex) ^ 1, state);
        if (heap_lower(&r->heap, state, key))
            r->before[state] = before;
    }
}

/* The last state of the best path, or KTG_NONE. */
static uint32_t run(search *r) {
    const ktg_sheet *s = r->query->sheet;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        if (r->query->from[v])
            reach(r, v, KTG_NONE);
    while (r->heap.count > 0) {
        uint32_t state = heap_take(&r->heap), head = state_head(s, state);
        if (r->query->to[head])
            return state;
        reach(r, head, state);
    }
    return KTG_NONE;
}

/* Writes the vertices' way back from `state` to the start: of each vertex that the path comes to
 * twice (to turn there) what lies in between is left out, by going on from its first visit. */
static void trace(const search *r, uint32_t state, uint32_t *visit, uint32_t *edges,
                  uint32_t *count) {
    const ktg_sheet *s = r->query->sheet;
    uint32_t n = 0;
    for (uint32_t t = state; t != KTG_NONE; t = r->before[t])
        visit[state_head(s, t)] = t; /* the last to be written is the first on the way */
    for (uint32_t t = state; t != KTG_NONE; t = r->before[t]) {
        t = visit[state_head(s, t)];
        edges[n++] = t / 2;
    }
    for (uint32_t i = 0; i < n / 2; i++) {
        uint32_t swap = edges[i];
        edges[i] = edges[n - 1 - i];
        edges[n - 1 - i] = swap;
    }
    *count = n;
}

ktg_status ktg_path_find(ktg_context *context, const ktg_path_query *query, uint32_t *edges,
                         uint32_t *count) {
    const size_t states = 2 * (size_t)query->sheet->edge_count;
    search r = {.query = query, .before = ktg_new(context, states, uint32_t)};
    uint32_t *visit = ktg_new(context, query->sheet->mesh->vertex_count, uint32_t);
    ktg_status status = heap_new(context, states, &r.heap);
    *count = 0;
    if (status == KTG_OK && !(r.before && visit))
        status = KTG_MEMORY;
    if (status == KTG_OK)
        trace(&r, run(&r), visit, edges, count);
    heap_free(&r.heap);
    ktg_free(r.before);
    ktg_free(visit);
    return status;
}
