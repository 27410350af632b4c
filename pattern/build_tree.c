/* pattern/build_tree.c - the seams of a piece with itself, from the leaves of its cuts to the
 * roots. Roots are where the piece meets others, or the model's border, or, of a piece that is
 * closed in itself, the ends of the seams that close it.
 *
 * A depth-first walk, farthest branch first, in which each node hands to its parent what it has
 * gathered; as soon as that is enough it becomes a step. So a step hangs together, and all that
 * lies behind it is done. Seams that close a ring (a torus has such ones) come when all is done
 * that the two ways round have behind their fork. */
#include "pattern/build_order.h"

#include "core/memory.h"

#include <stdlib.h>

/* What hangs at a node: another node by the seam that leads there, or a seam that closes a ring. */
typedef struct child {
    uint32_t parent, node, seam; /* node: KTG_NONE of a ring; seam: KTG_NONE of a root */
    double rank;                 /* the larger first */
} child;

typedef struct tree {
    ktg_build *b;
    uint32_t piece, seam_count, node_count; /* node node_count is above all roots */
    const uint32_t *seams;
    uint32_t *vertices;         /* node_count: of the surface, rising */
    uint32_t *ends;             /* 2 seam_count: the nodes of a seam */
    ktg_groups ends_at;         /* of the nodes: indices into `ends` */
    uint32_t *parent, *seam_to; /* node_count + 1: the next node on the way to the root, and how */
    uint32_t *depth;
    uint32_t *visited; /* in the order in which nodes were reached */
    uint32_t visited_count;
    bool *is_known; /* node_count */
    bool *is_taken; /* seam_count: leads to a node, or closes the model */
    double *reach;  /* node_count + 1: how far away what hangs at it is */
    double *rank;   /* node_count: which child comes first */
    child *children;
    uint32_t child_count;
    uint32_t *next_child, *child_end; /* node_count + 1 */
    ktg_chain *chains;                /* node_count + 1 */
    uint32_t *stack;
} tree;

static int by_number(const void *left, const void *right) {
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/* KTG_NONE where no seam of the piece with itself ends. */
static uint32_t node_of(const tree *t, uint32_t vertex) {
    const uint32_t *found = bsearch(&vertex, t->vertices, t->node_count, sizeof vertex, by_number);
    return found ? (uint32_t)(found - t->vertices) : KTG_NONE;
}

static ktg_status find_nodes(tree *t) {
    ktg_context *context = t->b->context;
    uint32_t ends = 2 * t->seam_count;
    t->vertices = ktg_new(context, ends, uint32_t);
    t->ends = ktg_new(context, ends, uint32_t);
    if (!t->vertices || !t->ends)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < t->seam_count; i++) {
        t->ends[2 * i] = t->vertices[2 * i] = ktg_seam_begin(t->b->pattern, t->seams[i]);
        t->ends[2 * i + 1] = t->vertices[2 * i + 1] = ktg_seam_end(t->b->pattern, t->seams[i]);
    }
    qsort(t->vertices, ends, sizeof *t->vertices, by_number);
    for (uint32_t i = 0; i < ends; i++)
        if (i == 0 || t->vertices[i] != t->vertices[t->node_count - 1])
            t->vertices[t->node_count++] = t->vertices[i];
    for (uint32_t i = 0; i < ends; i++)
        t->ends[i] = node_of(t, t->ends[i]);
    return ktg_groups_fill(context, t->ends, ends, t->node_count, &t->ends_at);
}

static ktg_status make_room(tree *t) {
    ktg_context *context = t->b->context;
    size_t nodes = (size_t)t->node_count + 1, most = nodes + t->seam_count;
    t->parent = ktg_new(context, nodes, uint32_t);
    t->seam_to = ktg_new(context, nodes, uint32_t);
    t->depth = ktg_new(context, nodes, uint32_t);
    t->visited = ktg_new(context, nodes, uint32_t);
    t->is_known = ktg_new(context, nodes, bool);
    t->is_taken = ktg_new(context, t->seam_count, bool);
    t->reach = ktg_new(context, nodes, double);
    t->rank = ktg_new(context, nodes, double);
    t->children = ktg_new(context, most, child);
    t->next_child = ktg_new(context, nodes, uint32_t);
    t->child_end = ktg_new(context, nodes, uint32_t);
    t->chains = ktg_new(context, nodes, ktg_chain);
    t->stack = ktg_new(context, nodes, uint32_t);
    return t->parent && t->seam_to && t->depth && t->visited && t->is_known && t->is_taken &&
                   t->reach && t->rank && t->children && t->next_child && t->child_end &&
                   t->chains && t->stack
               ? KTG_OK
               : KTG_MEMORY;
}

static void drop(tree *t) {
    ktg_free(t->vertices);
    ktg_free(t->ends);
    ktg_groups_drop(&t->ends_at);
    ktg_free(t->parent);
    ktg_free(t->seam_to);
    ktg_free(t->depth);
    ktg_free(t->visited);
    ktg_free(t->is_known);
    ktg_free(t->is_taken);
    ktg_free(t->reach);
    ktg_free(t->rank);
    ktg_free(t->children);
    ktg_free(t->next_child);
    ktg_free(t->child_end);
    ktg_free(t->chains);
    ktg_free(t->stack);
}

/* ---- the tree ----------------------------------------------------------------------------- */

static void visit(tree *t, uint32_t node, uint32_t parent, uint32_t seam) {
    t->is_known[node] = true;
    t->parent[node] = parent;
    t->seam_to[node] = seam;
    t->depth[node] = parent == t->node_count ? 1 : t->depth[parent] + 1;
    t->visited[t->visited_count++] = node;
}

/* Visits what can be reached from the nodes visited from `from` on. */
static void spread(tree *t, uint32_t from) {
    for (uint32_t i = from; i < t->visited_count; i++) {
        uint32_t node = t->visited[i];
        for (uint32_t k = t->ends_at.first[node]; k < t->ends_at.first[node + 1]; k++) {
            uint32_t end = t->ends_at.items[k], other = t->ends[end ^ 1];
            if (t->is_taken[end / 2] || t->is_known[other])
                continue;
            t->is_taken[end / 2] = true;
            visit(t, other, node, end / 2);
        }
    }
}

/* The ends of the seams that close the piece; else what is on its border. */
static void visit_roots(tree *t) {
    bool closing = false;
    for (uint32_t i = 0; i < t->seam_count; i++)
        if (ktg_build_is_closing(t->b, t->seams[i])) {
            closing = t->is_taken[i] = true;
            for (uint32_t end = 2 * i; end < 2 * i + 2; end++)
                if (!t->is_known[t->ends[end]])
                    visit(t, t->ends[end], t->node_count, KTG_NONE);
        }
    for (uint32_t node = 0; !closing && node < t->node_count; node++)
        if (t->b->is_ground[t->vertices[node]])
            visit(t, node, t->node_count, KTG_NONE);
    spread(t, 0);
}

/* A node that was not reached: on a border, or the one nearest to where the part is closed. */
static uint32_t next_root(const tree *t) {
    uint32_t best = KTG_NONE;
    for (uint32_t node = 0; node < t->node_count; node++) {
        if (t->is_known[node])
            continue;
        if (t->b->is_ground[t->vertices[node]])
            return node;
        if (best == KTG_NONE || t->b->far[t->vertices[node]] < t->b->far[t->vertices[best]])
            best = node;
    }
    return best;
}

static void grow(tree *t) {
    visit_roots(t);
    while (t->visited_count < t->node_count) {
        uint32_t from = t->visited_count;
        visit(t, next_root(t), t->node_count, KTG_NONE);
        spread(t, from);
    }
}

/* ---- children ----------------------------------------------------------------------------- */

static void find_reach(tree *t) {
    for (uint32_t node = 0; node < t->node_count; node++)
        t->reach[node] = t->b->far[t->vertices[node]];
    for (uint32_t i = t->visited_count; i-- > 0;) {
        uint32_t node = t->visited[i];
        t->reach[t->parent[node]] = fmax(t->reach[t->parent[node]], t->reach[node]);
    }
}

/* Where the ways of two nodes to the root meet. */
static uint32_t fork_of(const tree *t, uint32_t a, uint32_t b) {
    while (a != b) {
        uint32_t *deeper = t->depth[a] >= t->depth[b] ? &a : &b;
        *deeper = t->parent[*deeper];
    }
    return a;
}

static int by_parent(const void *left, const void *right) {
    const child *a = left, *b = right;
    if (a->parent != b->parent)
        return a->parent < b->parent ? -1 : 1;
    if (a->rank != b->rank)
        return a->rank > b->rank ? -1 : 1;
    if (a->seam != b->seam)
        return a->seam < b->seam ? -1 : 1;
    return (a->node > b->node) - (a->node < b->node);
}

/* The place in the piece's border of the root with the farthest branch. */
static uint32_t find_start(const tree *t, const uint32_t *border, uint32_t size) {
    uint32_t best = 0;
    double farthest = -1;
    for (uint32_t i = 0; i < size; i++) {
        uint32_t node = node_of(t, t->b->pattern->faces[border[i]]);
        if (node == KTG_NONE || t->seam_to[node] != KTG_NONE || !(t->reach[node] > farthest))
            continue;
        farthest = t->reach[node];
        best = i;
    }
    return best;
}

/* Roots follow each other along the border, from the one with the farthest branch on; of other
 * nodes the one with the farthest branch comes first. */
static void rank_nodes(tree *t) {
    const ktg_topology *top = t->b->topology;
    const uint32_t *border = top->border + top->border_first[t->piece];
    uint32_t size = top->border_first[t->piece + 1] - top->border_first[t->piece];
    uint32_t start = find_start(t, border, size);
    for (uint32_t node = 0; node < t->node_count; node++)
        t->rank[node] = t->seam_to[node] == KTG_NONE ? -(double)size : t->reach[node];
    for (uint32_t i = size; i-- > 0;) { /* the first place of a vertex is what counts */
        uint32_t node = node_of(t, t->b->pattern->faces[border[(start + i) % size]]);
        if (node != KTG_NONE && t->seam_to[node] == KTG_NONE)
            t->rank[node] = -(double)i;
    }
}

static void add_child(tree *t, uint32_t parent, uint32_t node, uint32_t seam, double rank) {
    t->children[t->child_count++] = (child){parent, node, seam, rank};
}

static void sort_children(tree *t) {
    for (uint32_t node = 0; node < t->node_count; node++)
        add_child(t, t->parent[node], node, t->seam_to[node], t->rank[node]);
    for (uint32_t i = 0; i < t->seam_count; i++)
        if (!t->is_taken[i])
            add_child(t, fork_of(t, t->ends[2 * i], t->ends[2 * i + 1]), KTG_NONE, i, -INFINITY);
    qsort(t->children, t->child_count, sizeof *t->children, by_parent);
    for (uint32_t i = t->child_count; i-- > 0;)
        t->next_child[t->children[i].parent] = i;
    for (uint32_t i = 0; i < t->child_count; i++)
        t->child_end[t->children[i].parent] = i + 1;
}

/* ---- the walk ----------------------------------------------------------------------------- */

static void flush_if_enough(tree *t, uint32_t node) {
    if (t->chains[node].weight >= t->b->least)
        ktg_chain_flush(t->b, &t->chains[node]);
}

/* All behind the node is gathered: it goes to the parent, with the seam that leads there. */
static void hand_on(tree *t, uint32_t node) {
    uint32_t parent = t->parent[node];
    if (t->seam_to[node] != KTG_NONE)
        ktg_chain_add(t->b, &t->chains[node], t->seams[t->seam_to[node]]);
    ktg_chain_join(t->b, &t->chains[parent], &t->chains[node]);
    flush_if_enough(t, parent);
}

static void walk(tree *t) {
    uint32_t count = 0;
    for (uint32_t node = 0; node <= t->node_count; node++)
        t->chains[node] = KTG_EMPTY_CHAIN;
    t->stack[count++] = t->node_count;
    while (count > 0) {
        uint32_t node = t->stack[count - 1];
        if (t->next_child[node] < t->child_end[node]) {
            const child *c = &t->children[t->next_child[node]++];
            if (c->node != KTG_NONE) {
                t->stack[count++] = c->node;
                continue;
            }
            ktg_chain_add(t->b, &t->chains[node], t->seams[c->seam]);
            flush_if_enough(t, node);
            continue;
        }
        count--;
        if (node < t->node_count)
            hand_on(t, node);
    }
}

static ktg_status order_piece(tree *t, ktg_chain *rest) {
    KTG_TRY(find_nodes(t));
    KTG_TRY(make_room(t));
    grow(t);
    find_reach(t);
    rank_nodes(t);
    sort_children(t);
    walk(t);
    ktg_chain_join(t->b, rest, &t->chains[t->node_count]);
    return KTG_OK;
}

ktg_status ktg_build_piece(ktg_build *b, uint32_t piece, ktg_chain *rest) {
    tree t = {.b = b,
              .piece = piece,
              .seam_count = b->own.first[piece + 1] - b->own.first[piece],
              .seams = b->own.items + b->own.first[piece]};
    if (t.seam_count == 0)
        return KTG_OK;
    ktg_status status = order_piece(&t, rest);
    drop(&t);
    return status;
}
