/* unfold/regions.c - compact regions of like size. */
#include "unfold/regions.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/crease.h"

#include <string.h>

/* Rounds of growing; in the later ones seeds stay and only sizes are balanced. */
#define ROUNDS      24
#define MOVE_ROUNDS 14

/* A step across a full crease counts as so many. */
#define CREASE_STEPS 5.0

/* Part of a region's radius by which it starts later for being twice as large as it should. */
#define BALANCE 0.35

typedef struct heap_item {
    double far;
    uint32_t face, region;
} heap_item;

typedef struct growth {
    const ktg_dual *dual;
    const double *load;
    uint32_t count;
    double *step;     /* edge_count */
    ktg_vec3 *middle; /* face_count: in space */
    uint32_t *group;  /* face_count: the lowest face that rigid edges join it with */
    uint32_t *owner;  /* face_count: region of a group, at its lowest face */
    uint32_t *region; /* face_count */
    uint32_t *seed;   /* count */
    double *late;     /* count: how much later a region starts */
    double *far;      /* face_count: scratch */
    heap_item *heap;
    size_t heap_count;
    double radius; /* of a round region of mean size */
} growth;

/* ---- a heap of faces by distance, ties by number -------------------------------------------- */

static bool comes_before(const heap_item *a, const heap_item *b) {
    if (a->far != b->far)
        return a->far < b->far;
    return a->face != b->face ? a->face < b->face : a->region < b->region;
}

static void push(growth *g, heap_item item) {
    size_t i = g->heap_count++;
    while (i > 0 && comes_before(&item, &g->heap[(i - 1) / 2])) {
        g->heap[i] = g->heap[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    g->heap[i] = item;
}

static heap_item pop(growth *g) {
    heap_item top = g->heap[0], last = g->heap[--g->heap_count];
    size_t i = 0;
    for (size_t child = 1; child < g->heap_count; child = 2 * i + 1) {
        child += child + 1 < g->heap_count && comes_before(&g->heap[child + 1], &g->heap[child]);
        if (!comes_before(&g->heap[child], &last))
            break;
        g->heap[i] = g->heap[child];
        i = child;
    }
    g->heap[i] = last;
    return top;
}

/* ---- the surface ---------------------------------------------------------------------------- */

static ktg_vec2 flat_middle(const ktg_dual *dual, uint32_t face) {
    const ktg_vec2 *p = dual->flat + 3 * (size_t)face;
    return ktg_mul2(ktg_add2(p[0], ktg_add2(p[1], p[2])), 1.0 / 3);
}

/* From the middle of a face to the middle of one of its edges. */
static double reach(const ktg_dual *dual, uint32_t halfedge) {
    ktg_vec2 on = ktg_madd2(dual->flat[halfedge], 0.5, dual->flat_vectors[halfedge]);
    return ktg_length2(ktg_sub2(on, flat_middle(dual, halfedge / 3)));
}

static void measure_steps(growth *g) {
    for (uint32_t e = 0; e < g->dual->edge_count; e++) {
        const ktg_dual_edge *edge = &g->dual->edges[e];
        double way = reach(g->dual, edge->halfedge[0]) + reach(g->dual, edge->halfedge[1]);
        g->step[e] = edge->rigid ? 0 : way * (1 + CREASE_STEPS * ktg_dual_crease(g->dual, edge));
    }
}

static uint32_t group_of(growth *g, uint32_t face) {
    while (g->group[face] != face)
        face = g->group[face] = g->group[g->group[face]];
    return face;
}

static void find_groups(growth *g) {
    for (uint32_t f = 0; f < g->dual->face_count; f++)
        g->group[f] = f;
    for (uint32_t e = 0; e < g->dual->edge_count; e++) {
        const ktg_dual_edge *edge = &g->dual->edges[e];
        uint32_t a = group_of(g, edge->halfedge[0] / 3), b = group_of(g, edge->halfedge[1] / 3);
        if (edge->rigid)
            g->group[a > b ? a : b] = a > b ? b : a;
    }
    for (uint32_t f = 0; f < g->dual->face_count; f++)
        g->group[f] = group_of(g, f);
}

/* Corner 0 of a face to its middle. */
static ktg_vec3 to_middle(const ktg_dual *dual, uint32_t face) {
    const ktg_vec3 *v = dual->edge_vectors + 3 * (size_t)face;
    return ktg_mul3(ktg_add3(ktg_mul3(v[0], 2), v[1]), 1.0 / 3);
}

/* From corner 0 of a face to corner k. */
static ktg_vec3 to_corner(const ktg_dual *dual, uint32_t face, uint32_t k) {
    const ktg_vec3 *v = dual->edge_vectors + 3 * (size_t)face;
    return k == 0 ? (ktg_vec3){0, 0, 0} : k == 1 ? v[0] : ktg_add3(v[0], v[1]);
}

/* Where the faces lie in space, from edge to edge: the dual has no positions. */
static void place_in_space(growth *g, uint32_t *stack) {
    const ktg_dual *dual = g->dual;
    uint32_t depth = 0;
    memset(g->region, 0xff, dual->face_count * sizeof *g->region);
    stack[depth++] = 0;
    g->region[0] = 0;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t h = 3 * face + k, e = dual->halfedge_edge[h];
            if (e == KTG_NONE)
                continue;
            const uint32_t *pair = dual->edges[e].halfedge;
            uint32_t mate = pair[0] == h ? pair[1] : pair[0], other = mate / 3;
            if (g->region[other] != KTG_NONE)
                continue;
            /* the end of the mate is the start of h */
            ktg_vec3 at = ktg_add3(g->middle[face], to_corner(dual, face, k));
            g->middle[other] = ktg_sub3(at, to_corner(dual, other, (mate % 3 + 1) % 3));
            g->region[other] = 0;
            stack[depth++] = other;
        }
    }
    for (uint32_t f = 0; f < dual->face_count; f++)
        g->middle[f] = ktg_add3(g->middle[f], to_middle(dual, f));
}

/* ---- growing -------------------------------------------------------------------------------- */

static void push_neighbours(growth *g, const heap_item *from) {
    for (uint32_t h = 3 * from->face; h < 3 * from->face + 3; h++) {
        uint32_t e = g->dual->halfedge_edge[h];
        if (e == KTG_NONE)
            continue;
        const uint32_t *pair = g->dual->edges[e].halfedge;
        uint32_t other = (pair[0] == h ? pair[1] : pair[0]) / 3;
        if (g->region[other] == KTG_NONE)
            push(g, (heap_item){from->far + g->step[e], other, from->region});
    }
}

/* Every face goes to the seed that comes first, whole groups at once. */
static void grow(growth *g, uint32_t seed_count) {
    memset(g->region, 0xff, g->dual->face_count * sizeof *g->region);
    memset(g->owner, 0xff, g->dual->face_count * sizeof *g->owner);
    g->heap_count = 0;
    for (uint32_t r = 0; r < seed_count; r++) { /* a seed is never lost to others */
        g->owner[g->group[g->seed[r]]] = r;
        push(g, (heap_item){g->late[r], g->seed[r], r});
    }
    while (g->heap_count > 0) {
        heap_item item = pop(g);
        uint32_t *owner = &g->owner[g->group[item.face]];
        if (g->region[item.face] != KTG_NONE || (*owner != KTG_NONE && *owner != item.region))
            continue;
        *owner = g->region[item.face] = item.region;
        g->far[item.face] = item.far;
        push_neighbours(g, &item);
    }
}

/* Seeds one after the other, each as far as can be from those before. */
static void choose_seeds(growth *g, ktg_random *random) {
    g->seed[0] = (uint32_t)ktg_random_below(random, g->dual->face_count);
    for (uint32_t count = 0; count < g->count; count++) {
        grow(g, count > 0 ? count : 1);
        uint32_t best = 0;
        for (uint32_t f = 1; f < g->dual->face_count; f++)
            if (g->far[f] > g->far[best])
                best = f;
        if (count > 0 && !(g->far[best] > 0)) { /* every group has a seed */
            g->count = count;
            return;
        }
        g->seed[count] = best; /* the first one is replaced by the face farthest from it */
    }
}

/* Of each region, the face that is nearest to the middle of its load. */
static void move_seeds(growth *g, ktg_vec3 *middle, double *load, double *least) {
    for (uint32_t r = 0; r < g->count; r++) {
        middle[r] = (ktg_vec3){0, 0, 0};
        least[r] = INFINITY;
    }
    for (uint32_t f = 0; f < g->dual->face_count; f++)
        middle[g->region[f]] =
            ktg_madd3(middle[g->region[f]], g->load[f] / load[g->region[f]], g->middle[f]);
    for (uint32_t f = 0; f < g->dual->face_count; f++) {
        uint32_t r = g->region[f];
        double away = ktg_length3(ktg_sub3(g->middle[f], middle[r]));
        if (away < least[r]) {
            least[r] = away;
            g->seed[r] = f;
        }
    }
}

static double sum_loads(const growth *g, double *load) {
    double all = 0;
    memset(load, 0, g->count * sizeof *load);
    for (uint32_t f = 0; f < g->dual->face_count; f++) {
        load[g->region[f]] += g->load[f];
        all += g->load[f];
    }
    return all;
}

static double largest(const growth *g, const double *load) {
    double most = 0;
    for (uint32_t r = 0; r < g->count; r++)
        most = fmax(most, load[r]);
    return most;
}

static ktg_status improve(ktg_context *context, growth *g, uint32_t *best) {
    double *load = ktg_new(context, g->count, double), *least = ktg_new(context, g->count, double);
    ktg_vec3 *middle = ktg_new(context, g->count, ktg_vec3);
    bool room = load && least && middle;
    double best_most = INFINITY;
    for (int round = 0; room && round < ROUNDS; round++) {
        grow(g, g->count);
        double mean = sum_loads(g, load) / g->count, most = largest(g, load);
        if (round >= MOVE_ROUNDS / 2 && most < best_most) {
            best_most = most;
            memcpy(best, g->region, g->dual->face_count * sizeof *best);
        }
        if (round < MOVE_ROUNDS)
            move_seeds(g, middle, load, least);
        for (uint32_t r = 0; r < g->count; r++)
            g->late[r] += BALANCE * g->radius * fmin(1, load[r] / mean - 1);
    }
    ktg_free(load);
    ktg_free(least);
    ktg_free(middle);
    return room ? KTG_OK : KTG_MEMORY;
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status allocate(ktg_context *context, growth *g) {
    size_t n = g->dual->face_count;
    g->step = ktg_new(context, g->dual->edge_count, double);
    g->middle = ktg_new(context, n, ktg_vec3);
    g->group = ktg_new(context, n, uint32_t);
    g->owner = ktg_new(context, n, uint32_t);
    g->region = ktg_new(context, n, uint32_t);
    g->seed = ktg_new(context, g->count, uint32_t);
    g->late = ktg_new(context, g->count, double);
    g->far = ktg_new(context, n, double);
    g->heap = ktg_new(context, 3 * n + g->count, heap_item);
    return g->step && g->middle && g->group && g->owner && g->region && g->seed && g->late &&
                   g->far && g->heap
               ? KTG_OK
               : KTG_MEMORY;
}

static void release(growth *g) {
    ktg_free(g->step);
    ktg_free(g->middle);
    ktg_free(g->group);
    ktg_free(g->owner);
    ktg_free(g->region);
    ktg_free(g->seed);
    ktg_free(g->late);
    ktg_free(g->far);
    ktg_free(g->heap);
}

static double radius_of(const growth *g) {
    double area = 0;
    for (uint32_t f = 0; f < g->dual->face_count; f++) {
        const ktg_vec2 *p = g->dual->flat + 3 * (size_t)f;
        area += 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
    }
    return sqrt(area / g->count / KTG_PI);
}

ktg_status ktg_regions_grow(ktg_context *context, const ktg_dual *dual, const double *load,
                            uint32_t count, ktg_random *random, uint32_t *region, uint32_t *made) {
    growth g = {.dual = dual, .load = load, .count = count};
    ktg_status status = allocate(context, &g);
    if (status == KTG_OK) {
        measure_steps(&g);
        find_groups(&g);
        place_in_space(&g, g.owner);
        g.radius = radius_of(&g);
        choose_seeds(&g, random);
        status = improve(context, &g, region);
        *made = g.count;
    }
    release(&g);
    return status;
}
