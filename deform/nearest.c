/* deform/nearest.c - the nearest of many vertices, edges and faces: a balanced tree of boxes.
 * Closest points after C. Ericson, "Real-Time Collision Detection" (2005), 5.1. */
#include "deform/nearest.h"
#include "core/memory.h"
#include "core/vec.h"

#include <stdlib.h>

#define LEAF 4

typedef struct box {
    ktg_vec3 low, high;
} box;

typedef struct keyed {
    double key;
    uint32_t item;
} keyed;

struct ktg_near {
    const ktg_vec3 *positions;
    const ktg_near_item *items;
    uint32_t count;
    keyed *order; /* count: items as the tree's leaves hold them */
    box *boxes;   /* of node i; its halves are 2 i + 1 and 2 i + 2 */
    size_t box_count;
};

/* ---- building ------------------------------------------------------------------------------- */

static uint32_t corners_of(const ktg_near_item *item) {
    return item->vertices[1] == KTG_NONE ? 1 : item->vertices[2] == KTG_NONE ? 2 : 3;
}

static box box_of(const ktg_near *t, size_t from, size_t to) {
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = from; i < to; i++) {
        const ktg_near_item *item = &t->items[t->order[i].item];
        for (uint32_t k = 0; k < corners_of(item); k++) {
            ktg_vec3 p = t->positions[item->vertices[k]];
            b.low = (ktg_vec3){fmin(b.low.x, p.x), fmin(b.low.y, p.y), fmin(b.low.z, p.z)};
            b.high = (ktg_vec3){fmax(b.high.x, p.x), fmax(b.high.y, p.y), fmax(b.high.z, p.z)};
        }
    }
    return b;
}

static int by_key(const void *left, const void *right) {
    const keyed *a = left, *b = right;
    if (a->key != b->key)
        return a->key < b->key ? -1 : 1;
    return (a->item > b->item) - (a->item < b->item);
}

static double along(ktg_vec3 p, int axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static void set_keys(ktg_near *t, size_t from, size_t to, box b) {
    ktg_vec3 size = ktg_sub3(b.high, b.low);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    for (size_t i = from; i < to; i++) {
        const ktg_near_item *item = &t->items[t->order[i].item];
        uint32_t n = corners_of(item);
        t->order[i].key = 0;
        for (uint32_t k = 0; k < n; k++)
            t->order[i].key += along(t->positions[item->vertices[k]], axis) / n;
    }
}

static void build(ktg_near *t, size_t node, size_t from, size_t to) {
    t->boxes[node] = box_of(t, from, to);
    if (to - from <= LEAF)
        return;
    set_keys(t, from, to, t->boxes[node]);
    qsort(t->order + from, to - from, sizeof *t->order, by_key);
    size_t middle = from + (to - from) / 2;
    build(t, 2 * node + 1, from, middle);
    build(t, 2 * node + 2, middle, to);
}

ktg_status ktg_near_new(ktg_context *context, const ktg_vec3 *positions, const ktg_near_item *items,
                        uint32_t count, ktg_near **tree) {
    *tree = ktg_new(context, 1, ktg_near);
    if (!*tree)
        return KTG_MEMORY;
    **tree = (ktg_near){.positions = positions, .items = items, .count = count};
    (*tree)->box_count = 1;
    while ((*tree)->box_count * LEAF < count)
        (*tree)->box_count *= 2;
    (*tree)->box_count *= 4; /* halves differ by one, so a branch may be one deeper */
    (*tree)->order = ktg_new(context, count, keyed);
    (*tree)->boxes = ktg_new(context, (*tree)->box_count, box);
    if (!(*tree)->order || !(*tree)->boxes) {
        ktg_near_free(tree);
        return KTG_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++)
        (*tree)->order[i].item = i;
    build(*tree, 0, 0, count);
    return KTG_OK;
}

void ktg_near_free(ktg_near **tree) {
    if (!tree || !*tree)
        return;
    ktg_free((*tree)->order);
    ktg_free((*tree)->boxes);
    ktg_free(*tree);
    *tree = NULL;
}

/* ---- closest points ------------------------------------------------------------------------- */

static void on_edge(ktg_vec3 p, ktg_vec3 a, ktg_vec3 b, double w[3]) {
    ktg_vec3 ab = ktg_sub3(b, a);
    double length = ktg_dot3(ab, ab), t = ktg_dot3(ktg_sub3(p, a), ab);
    t = length > 0 ? ktg_max(0, ktg_min(1, t / length)) : 0;
    w[0] = 1 - t;
    w[1] = t;
    w[2] = 0;
}

static double distance_to(ktg_vec3 p, const ktg_vec3 *c, const double w[3]) {
    ktg_vec3 at = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        if (w[k] > 0)
            at = ktg_madd3(at, w[k], c[k]);
    return ktg_length3(ktg_sub3(p, at));
}

static bool inside_face(ktg_vec3 p, const ktg_vec3 *c, double w[3]) {
    ktg_vec3 a = ktg_sub3(c[1], c[0]), b = ktg_sub3(c[2], c[0]), d = ktg_sub3(p, c[0]);
    double aa = ktg_dot3(a, a), ab = ktg_dot3(a, b), bb = ktg_dot3(b, b);
    double da = ktg_dot3(d, a), db = ktg_dot3(d, b), area = aa * bb - ab * ab;
    if (!(area > 1e-20 * aa * bb))
        return false;
    w[1] = (bb * da - ab * db) / area;
    w[2] = (aa * db - ab * da) / area;
    w[0] = 1 - w[1] - w[2];
    return w[0] >= 0 && w[1] >= 0 && w[2] >= 0;
}

/* Over the face, or else on the nearest of its edges. */
static void on_face(ktg_vec3 p, const ktg_vec3 *c, double w[3]) {
    double best = INFINITY;
    if (inside_face(p, c, w))
        return;
    for (int k = 0; k < 3; k++) {
        double t[3], turned[3];
        int next = (k + 1) % 3;
        on_edge(p, c[k], c[next], t);
        turned[k] = t[0];
        turned[next] = t[1];
        turned[(k + 2) % 3] = 0;
        double distance = distance_to(p, c, turned);
        if (distance >= best)
            continue;
        best = distance;
        for (int i = 0; i < 3; i++)
            w[i] = turned[i];
    }
}

/* ---- searching ------------------------------------------------------------------------------ */

typedef struct search {
    const ktg_near *tree;
    ktg_vec3 at;
    uint32_t vertex, skip;
    double most;
    bool found;
    ktg_near_hit *hit;
} search;

static double box_distance(const box *b, ktg_vec3 p) {
    ktg_vec3 d = {fmax(0, fmax(b->low.x - p.x, p.x - b->high.x)),
                  fmax(0, fmax(b->low.y - p.y, p.y - b->high.y)),
                  fmax(0, fmax(b->low.z - p.z, p.z - b->high.z))};
    return ktg_length3(d);
}

static void try_item(search *s, uint32_t number) {
    const ktg_near_item *item = &s->tree->items[number];
    ktg_vec3 c[3] = {{0, 0, 0}};
    double w[3] = {1, 0, 0};
    uint32_t n = corners_of(item);
    for (uint32_t k = 0; k < n; k++) {
        if (item->vertices[k] == s->vertex)
            return;
        c[k] = s->tree->positions[item->vertices[k]];
    }
    if (n == 2)
        on_edge(s->at, c[0], c[1], w);
    else if (n == 3)
        on_face(s->at, c, w);
    double distance = distance_to(s->at, c, w);
    if (item->part == s->skip && s->skip != KTG_NONE && distance > 0)
        return;
    if (distance > s->most || (s->found && distance == s->most && number > s->hit->item))
        return;
    *s->hit = (ktg_near_hit){number, {w[0], w[1], w[2]}, distance};
    s->most = distance;
    s->found = true;
}

static void walk(search *s, size_t node, size_t from, size_t to) {
    if (box_distance(&s->tree->boxes[node], s->at) > s->most)
        return;
    if (to - from <= LEAF) {
        for (size_t i = from; i < to; i++)
            try_item(s, s->tree->order[i].item);
        return;
    }
    size_t middle = from + (to - from) / 2;
    double left = box_distance(&s->tree->boxes[2 * node + 1], s->at);
    double right = box_distance(&s->tree->boxes[2 * node + 2], s->at);
    if (left <= right)
        walk(s, 2 * node + 1, from, middle);
    walk(s, 2 * node + 2, middle, to);
    if (left > right)
        walk(s, 2 * node + 1, from, middle);
}

bool ktg_near_find(const ktg_near *tree, uint32_t vertex, double most, uint32_t skip,
                   ktg_near_hit *hit) {
    search s = {tree, tree->positions[vertex], vertex, skip, most, false, hit};
    if (tree->count > 0)
        walk(&s, 0, 0, tree->count);
    return s.found;
}
