/* unfold/sheet_merge.c - joining pieces of a forest. */
#include "unfold/sheet_merge.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/arrangement.h"

#include <stdlib.h>

typedef struct tree_size {
    uint32_t root, faces;
} tree_size;

static int smaller_first(const void *a, const void *b) {
    const tree_size *x = a, *y = b;
    if (x->faces != y->faces)
        return x->faces < y->faces ? -1 : 1;
    return (x->root > y->root) - (x->root < y->root);
}

static void list_trees(const ktg_arrangement *a, tree_size *trees) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < a->dual->face_count; i += a->size[a->order[i]])
        trees[count++] = (tree_size){a->order[i], a->size[a->order[i]]};
    qsort(trees, count, sizeof *trees, smaller_first);
}

/* The longest edge across which the whole tree can hang at another one. */
static uint32_t find_place(const ktg_arrangement *a, uint32_t root) {
    ktg_branch tree = ktg_branch_at(a, root);
    uint32_t best = KTG_NONE;
    for (uint32_t i = 0; i < tree.count; i++)
        for (uint32_t own = 3 * a->order[tree.first + i], end = own + 3; own < end; own++) {
            uint32_t e = a->dual->halfedge_edge[own];
            if (e == KTG_NONE || a->folded[e])
                continue;
            ktg_graft graft = {.edge = e, .own = own, .other = ktg_arrangement_across(a, e, own)};
            if (ktg_branch_holds(a, &tree, graft.other / 3) ||
                (best != KTG_NONE && a->dual->edges[e].length <= a->dual->edges[best].length))
                continue;
            ktg_graft_motion(a, &graft);
            if (ktg_graft_conflicts(a, &tree, &graft, 0) == 0)
                best = e;
        }
    return best;
}

/* *edge: KTG_NONE when no tree can hang at another, or there are few enough. */
static ktg_status merge_once(ktg_context *context, const ktg_dual *dual, uint32_t count,
                             const bool *folded, uint32_t *edge) {
    ktg_arrangement *a = NULL;
    double reach = sqrt(dual->face_count) * dual->edges[0].length;
    *edge = KTG_NONE;
    KTG_TRY(ktg_arrangement_new(context, dual, folded, (ktg_vec2){reach, reach}, &a));
    tree_size *trees = ktg_new(context, a->piece_count, tree_size);
    if (trees && a->piece_count > count) {
        list_trees(a, trees);
        for (uint32_t i = 0; *edge == KTG_NONE && i < a->piece_count; i++)
            *edge = find_place(a, trees[i].root);
    }
    ktg_status status = trees ? KTG_OK : KTG_MEMORY;
    ktg_free(trees);
    ktg_arrangement_free(&a);
    return status;
}

ktg_status ktg_sheet_merge(ktg_context *context, const ktg_dual *dual, uint32_t count,
                           bool *folded) {
    uint32_t edge = 0;
    while (edge != KTG_NONE && dual->edge_count > 0) {
        KTG_TRY(merge_once(context, dual, count, folded, &edge));
        if (edge != KTG_NONE)
            folded[edge] = true;
    }
    return KTG_OK;
}
