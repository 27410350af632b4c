/* unfold/arrange_tree.c - the forest of an arrangement in preorder. */
#include "unfold/arrangement.h"

#include <string.h>

/* Lists the faces of the tree that hangs from `root` in preorder from order[first] on and gives
 * them parents and sizes; returns how many. Only folds are followed, and not the edge `up`. */
static uint32_t list_tree(ktg_arrangement *a, uint32_t root, uint32_t up, uint32_t first) {
    const ktg_dual *dual = a->dual;
    uint32_t *stack = a->scratch, depth = 0, count = 0;
    a->parent_edge[root] = up;
    stack[depth++] = root;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        a->place[face] = first + count;
        a->order[first + count++] = face;
        a->size[face] = 1;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = dual->halfedge_edge[h];
            if (e == KTG_NONE || !a->folded[e] || e == a->parent_edge[face])
                continue;
            uint32_t child = ktg_arrangement_across(a, e, h) / 3;
            a->parent_edge[child] = e;
            stack[depth++] = child;
        }
    }
    for (uint32_t i = count; i-- > 1;) {
        uint32_t face = a->order[first + i], e = a->parent_edge[face];
        const uint32_t *pair = dual->edges[e].halfedge;
        uint32_t parent = pair[0] / 3 == face ? pair[1] / 3 : pair[0] / 3;
        a->size[parent] += a->size[face];
    }
    return count;
}

/* From the root down to the face below which nothing holds more than half of the tree. */
static uint32_t middle_of(const ktg_arrangement *a, uint32_t root) {
    uint32_t face = root, all = a->size[root];
    for (;;) {
        uint32_t heavy = KTG_NONE;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = a->dual->halfedge_edge[h];
            if (e == KTG_NONE || !a->folded[e] || e == a->parent_edge[face])
                continue;
            uint32_t child = ktg_arrangement_across(a, e, h) / 3;
            if (2 * a->size[child] > all)
                heavy = child;
        }
        if (heavy == KTG_NONE)
            return face;
        face = heavy;
    }
}

void ktg_arrangement_order(ktg_arrangement *a) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < a->dual->face_count; f++)
        a->place[f] = KTG_NONE;
    for (uint32_t f = 0; f < a->dual->face_count; f++) {
        if (a->place[f] != KTG_NONE)
            continue;
        list_tree(a, f, KTG_NONE, count);
        count += list_tree(a, middle_of(a, f), KTG_NONE, count);
    }
}

void ktg_arrangement_number(ktg_arrangement *a) {
    uint32_t last = KTG_NONE;
    a->piece_count = 0;
    for (uint32_t i = 0; i < a->dual->face_count; i++) {
        uint32_t face = a->order[i];
        if (a->parent_edge[face] == KTG_NONE)
            last = a->piece_count++;
        a->piece[face] = last;
    }
}

static uint32_t parent_of(const ktg_arrangement *a, uint32_t face) {
    uint32_t e = a->parent_edge[face];
    if (e == KTG_NONE)
        return KTG_NONE;
    const uint32_t *pair = a->dual->edges[e].halfedge;
    return pair[0] / 3 == face ? pair[1] / 3 : pair[0] / 3;
}

/* Adds `change` to the sizes of a face and all above it. */
static void resize_upwards(ktg_arrangement *a, uint32_t face, uint32_t change) {
    for (; face != KTG_NONE; face = parent_of(a, face))
        a->size[face] += change;
}

/* Moves `count` faces of `order` from `from` to stand before what stands at `to` now; returns where
 * they begin then. */
static uint32_t move_stretch(ktg_arrangement *a, uint32_t from, uint32_t count, uint32_t to) {
    uint32_t *order = a->order, *held = a->scratch;
    uint32_t low = to < from ? to : from, high = to < from ? from + count : to;
    uint32_t target = to < from ? to : to - count;
    if (to == from)
        return from;
    memcpy(held, order + from, count * sizeof *order);
    if (to < from)
        memmove(order + to + count, order + to, (from - to) * sizeof *order);
    else
        memmove(order + from, order + from + count, (to - from - count) * sizeof *order);
    memcpy(order + target, held, count * sizeof *order);
    for (uint32_t i = low; i < high; i++)
        a->place[order[i]] = i;
    return target;
}

void ktg_arrangement_rehang(ktg_arrangement *a, ktg_branch *branch, uint32_t edge, uint32_t own,
                            uint32_t other) {
    uint32_t above = parent_of(a, branch->top), fold = a->parent_edge[branch->top];
    resize_upwards(a, above, -branch->count);
    a->folded[fold] = false;
    if (own != branch->top) /* the branch hangs from another of its faces now */
        list_tree(a, own, KTG_NONE, branch->first);
    a->parent_edge[own] = edge;
    a->folded[edge] = true;
    resize_upwards(a, other, branch->count);
    branch->first = move_stretch(a, branch->first, branch->count, a->place[other] + 1);
    branch->top = own;
    if (a->piece[own] != a->piece[other])
        for (uint32_t i = 0; i < branch->count; i++)
            a->piece[a->order[branch->first + i]] = a->piece[other];
}
