/* unfold/net_tree.c - a tree of faces in preorder. */
#include "unfold/net_tree.h"
#include "core/memory.h"

#include <string.h>

/* Marks an edge as a fold or a cut. */
static void set_fold(ktg_net_tree *tree, uint32_t edge, bool folded) {
    const uint32_t *pair = tree->dual->edges[edge].halfedge;
    tree->folded[edge] = folded;
    tree->neighbour[pair[0]] = folded ? pair[1] / 3 : KTG_NONE;
    tree->neighbour[pair[1]] = folded ? pair[0] / 3 : KTG_NONE;
}

/* Lists what hangs from `root`, whose parent is known, in preorder into `list`, and sets the
 * parents of the others; returns how many there are. A face's last child comes first: the list's
 * end, from `room` down, holds the faces still to be listed. */
static uint32_t list_below(ktg_net_tree *tree, uint32_t root, uint32_t *list, uint32_t room) {
    uint32_t count = 0, waiting = room;
    list[--waiting] = root;
    while (waiting < room) {
        uint32_t face = list[waiting++];
        list[count++] = face;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t other = tree->neighbour[h], edge = tree->dual->halfedge_edge[h];
            if (other == KTG_NONE || edge == tree->parent_edge[face])
                continue;
            tree->parent[other] = face;
            tree->parent_edge[other] = edge;
            list[--waiting] = other;
        }
    }
    return count;
}

static void set_places(ktg_net_tree *tree, uint32_t begin, uint32_t end) {
    for (uint32_t k = begin; k < end; k++)
        tree->place[tree->order[k]] = k;
}

/* The trees that hold face 0, the first of the remaining faces, and so on. */
static void list_all(ktg_net_tree *tree) {
    uint32_t n = tree->dual->face_count, listed = 0;
    memset(tree->place, 0xff, n * sizeof *tree->place);
    for (uint32_t root = 0; root < n; root++) {
        if (tree->place[root] != KTG_NONE)
            continue;
        tree->parent[root] = tree->parent_edge[root] = KTG_NONE;
        uint32_t count = list_below(tree, root, tree->order + listed, n - listed);
        set_places(tree, listed, listed + count);
        listed += count;
    }
    for (uint32_t f = 0; f < n; f++)
        tree->below[f] = 1;
    for (uint32_t k = n; k-- > 0;) {
        uint32_t face = tree->order[k];
        if (tree->parent[face] != KTG_NONE)
            tree->below[tree->parent[face]] += tree->below[face];
    }
}

ktg_status ktg_net_tree_new(ktg_context *context, const ktg_dual *dual, const bool *folded,
                            ktg_net_tree *tree) {
    size_t n = dual->face_count;
    *tree = (ktg_net_tree){.dual = dual};
    tree->folded = ktg_copy_array(context, folded, dual->edge_count, sizeof *folded);
    tree->neighbour = ktg_new(context, 3 * n, uint32_t);
    tree->parent = ktg_new(context, n, uint32_t);
    tree->parent_edge = ktg_new(context, n, uint32_t);
    tree->below = ktg_new(context, n, uint32_t);
    tree->order = ktg_new(context, n, uint32_t);
    tree->place = ktg_new(context, n, uint32_t);
    tree->scratch = ktg_new(context, n, uint32_t);
    if (!tree->folded || !tree->neighbour || !tree->parent || !tree->parent_edge || !tree->below ||
        !tree->order || !tree->place || !tree->scratch) {
        ktg_net_tree_free(tree);
        return KTG_MEMORY;
    }
    memset(tree->neighbour, 0xff, 3 * n * sizeof *tree->neighbour);
    for (uint32_t e = 0; e < dual->edge_count; e++)
        set_fold(tree, e, folded[e]);
    list_all(tree);
    return KTG_OK;
}

void ktg_net_tree_free(ktg_net_tree *tree) {
    ktg_free(tree->folded);
    ktg_free(tree->neighbour);
    ktg_free(tree->parent);
    ktg_free(tree->parent_edge);
    ktg_free(tree->below);
    ktg_free(tree->order);
    ktg_free(tree->place);
    ktg_free(tree->scratch);
    *tree = (ktg_net_tree){0};
}

/* ---- looking ----------------------------------------------------------------------------------
 */

/* The face of a fold that hangs from the other. */
static uint32_t lower_face(const ktg_net_tree *tree, uint32_t fold) {
    const uint32_t *pair = tree->dual->edges[fold].halfedge;
    return tree->parent_edge[pair[0] / 3] == fold ? pair[0] / 3 : pair[1] / 3;
}

static uint32_t root_of(const ktg_net_tree *tree, uint32_t face) {
    if (tree->below[tree->order[0]] == tree->dual->face_count)
        return tree->order[0]; /* there is one tree only */
    while (tree->parent[face] != KTG_NONE)
        face = tree->parent[face];
    return face;
}

ktg_net_part ktg_net_tree_side(const ktg_net_tree *tree, uint32_t fold) {
    uint32_t lower = lower_face(tree, fold), root = root_of(tree, lower);
    uint32_t below = tree->below[lower], first = tree->place[lower];
    if (below <= tree->below[root] - below)
        return (ktg_net_part){first, below, first + below, 0};
    return (ktg_net_part){tree->place[root], tree->below[root] - below, first, below};
}

uint32_t ktg_net_tree_path(const ktg_net_tree *tree, uint32_t a, uint32_t b, uint32_t *path) {
    uint32_t count = 0;
    for (; tree->place[b] - tree->place[a] >= tree->below[a]; a = tree->parent[a])
        path[count++] = tree->parent_edge[a];
    for (; b != a; b = tree->parent[b])
        path[count++] = tree->parent_edge[b];
    return count;
}

/* ---- hanging a part elsewhere -----------------------------------------------------------------
 */

static void add_below(ktg_net_tree *tree, uint32_t face, uint32_t count) {
    for (; face != KTG_NONE; face = tree->parent[face])
        tree->below[face] += count;
}

/* Makes `face` the root of its tree, which has `all` faces. */
static void turn_round(ktg_net_tree *tree, uint32_t face, uint32_t all) {
    uint32_t above = KTG_NONE, link = KTG_NONE, passed = 0;
    while (face != KTG_NONE) {
        uint32_t next = tree->parent[face], next_link = tree->parent_edge[face];
        uint32_t below = tree->below[face];
        tree->parent[face] = above;
        tree->parent_edge[face] = link;
        tree->below[face] = all - passed;
        passed = below;
        above = face;
        link = next_link;
        face = next;
    }
}

/* Moves the run at `from` to follow the face `after`, in the order that scratch has. */
static void move_run(ktg_net_tree *tree, uint32_t from, uint32_t count, uint32_t after) {
    uint32_t at = tree->place[after] + 1, *order = tree->order;
    uint32_t begin = from, end = at;
    if (at <= from) {
        memmove(order + at + count, order + at, (from - at) * sizeof *order);
        begin = at;
        end = from + count;
    } else {
        memmove(order + from, order + from + count, (at - from - count) * sizeof *order);
        at -= count;
    }
    memcpy(order + at, tree->scratch, count * sizeof *order);
    set_places(tree, begin, end);
}

void ktg_net_tree_hang(ktg_net_tree *tree, const ktg_net_part *part, uint32_t fold, uint32_t edge) {
    const uint32_t *ends = tree->dual->edges[edge].halfedge;
    bool first = ktg_net_part_has(tree, part, ends[0] / 3);
    uint32_t inner = ends[first ? 0 : 1] / 3, outer = ends[first ? 1 : 0] / 3;
    uint32_t lower = lower_face(tree, fold), below = tree->below[lower], from = part->first;
    add_below(tree, tree->parent[lower], 0u - below);
    tree->parent[lower] = tree->parent_edge[lower] = KTG_NONE;
    turn_round(tree, inner, part->count);
    tree->parent[inner] = outer;
    tree->parent_edge[inner] = edge;
    set_fold(tree, fold, false);
    set_fold(tree, edge, true);
    add_below(tree, outer, part->count);
    if (part->gap > 0) { /* the part held the root: what hung below the fold comes first now */
        uint32_t *order = tree->order, before = part->gap_first - from;
        memcpy(tree->scratch, order + from, before * sizeof *order);
        memmove(order + from, order + part->gap_first, part->gap * sizeof *order);
        memcpy(order + from + part->gap, tree->scratch, before * sizeof *order);
        set_places(tree, from, from + part->gap + before);
        from += part->gap;
    }
    list_below(tree, inner, tree->scratch, part->count);
    move_run(tree, from, part->count, outer);
}
