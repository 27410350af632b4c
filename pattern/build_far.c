/* pattern/build_far.c - how far the vertices of a part are from where it is closed, along the edges
 * of the surface (Dijkstra 1959). */
#include "pattern/build_order.h"

#include "core/memory.h"

typedef struct visit {
    double far;
    uint32_t vertex;
} visit;

typedef struct queue {
    ktg_context *context;
    visit *heap; /* the nearest first */
    size_t count, capacity;
} queue;

static bool before(visit a, visit b) {
    return a.far != b.far ? a.far < b.far : a.vertex < b.vertex;
}

static ktg_status push(queue *q, visit v) {
    KTG_TRY(ktg_reserve(q->context, &q->heap, &q->capacity, q->count + 1));
    size_t at = q->count++;
    for (; at > 0 && before(v, q->heap[(at - 1) / 2]); at = (at - 1) / 2)
        q->heap[at] = q->heap[(at - 1) / 2];
    q->heap[at] = v;
    return KTG_OK;
}

static visit pop(queue *q) {
    visit first = q->heap[0], v = q->heap[--q->count];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= q->count)
            break;
        if (child + 1 < q->count && before(q->heap[child + 1], q->heap[child]))
            child++;
        if (!before(q->heap[child], v))
            break;
        q->heap[at] = q->heap[child];
        at = child;
    }
    q->heap[at] = v;
    return first;
}

static ktg_status reach(ktg_build *b, queue *q, uint32_t vertex, double far) {
    if (!(far < b->far[vertex]))
        return KTG_OK;
    b->far[vertex] = far;
    return push(q, (visit){far, vertex});
}

static uint32_t part_of_edge(const ktg_build *b, uint32_t edge) {
    return b->part_of[b->pattern->edges[edge].sides[0].piece];
}

static ktg_status spread(ktg_build *b, uint32_t part, queue *q) {
    while (q->count > 0) {
        visit v = pop(q);
        if (v.far > b->far[v.vertex])
            continue;
        for (uint32_t i = b->edges_at.first[v.vertex]; i < b->edges_at.first[v.vertex + 1]; i++) {
            uint32_t edge = b->edges_at.items[i] / 2;
            if (part_of_edge(b, edge) != part)
                continue;
            uint32_t to = b->pattern->edges[edge].vertices[1 - b->edges_at.items[i] % 2];
            ktg_vec3 step = ktg_sub3(b->pattern->vertices[to], b->pattern->vertices[v.vertex]);
            KTG_TRY(reach(b, q, to, v.far + ktg_length3(step)));
        }
    }
    return KTG_OK;
}

ktg_status ktg_build_find_far(ktg_build *b, uint32_t part) {
    queue q = {.context = b->context};
    ktg_status status = KTG_OK;
    for (uint32_t i = b->edges.first[part]; i < b->edges.first[part + 1]; i++)
        for (int end = 0; end < 2; end++)
            b->far[b->pattern->edges[b->edges.items[i]].vertices[end]] = INFINITY;
    for (uint32_t k = 0; k < b->closing_count; k++) {
        const ktg_pattern_seam *s = &b->pattern->seams[b->closing[k]];
        for (uint32_t e = 0; status == KTG_OK && e < 2 * s->edge_count; e++)
            status = reach(b, &q, b->pattern->edges[s->edges[e / 2]].vertices[e % 2], 0);
    }
    if (status == KTG_OK)
        status = spread(b, part, &q);
    ktg_free(q.heap);
    return status;
}
