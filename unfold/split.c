/* unfold/split.c - cutting a net where its overlaps are.
 *
 * Few cuts that part all overlapping pairs are a hitting set of their ways in the tree: the fold
 * that parts most of the pairs left is cut, until there are none (greedily). */
#include "unfold/split.h"
#include "core/memory.h"

typedef struct split {
    const ktg_net *net;
    uint32_t *path;  /* face_count: scratch */
    uint32_t *uses;  /* edge_count: pairs left on whose way the fold lies */
    uint32_t *pairs; /* numbers of conflicts */
    size_t pair_count;
    uint32_t *folds; /* those that may lie on a way; uses only fall */
    uint32_t fold_count;
} split;

/* Counts a pair's way in (+1) or out (-1). */
static void count_path(split *s, uint32_t pair, uint32_t by) {
    const uint32_t *faces = s->net->conflicts[pair].faces;
    uint32_t length = ktg_net_path(s->net, faces[0], faces[1], s->path);
    for (uint32_t k = 0; k < length; k++)
        s->uses[s->path[k]] += by;
}

/* True when fold a is the better cut: rigid ones come last. */
static bool is_better(const split *s, uint32_t a, uint32_t b) {
    bool a_rigid = s->net->dual->edges[a].rigid, b_rigid = s->net->dual->edges[b].rigid;
    return a_rigid == b_rigid ? s->uses[a] > s->uses[b] : b_rigid;
}

/* The best of the folds that part any pairs, never a kept one; forgets the others. */
static uint32_t choose_fold(split *s) {
    uint32_t best = KTG_NONE, kept = 0;
    for (uint32_t k = 0; k < s->fold_count; k++) {
        uint32_t fold = s->folds[k];
        if (s->uses[fold] == 0 || s->net->dual->edges[fold].kept)
            continue;
        s->folds[kept++] = fold;
        if (best == KTG_NONE || is_better(s, fold, best))
            best = fold;
    }
    s->fold_count = kept;
    return best;
}

/* Forgets the pairs that the fold parts. */
static void part_pairs(split *s, uint32_t fold) {
    ktg_body side = ktg_net_side(s->net, fold);
    size_t kept = 0;
    for (size_t i = 0; i < s->pair_count; i++) {
        const uint32_t *faces = s->net->conflicts[s->pairs[i]].faces;
        if (ktg_net_has(s->net, &side, faces[0]) == ktg_net_has(s->net, &side, faces[1]))
            s->pairs[kept++] = s->pairs[i];
        else
            count_path(s, s->pairs[i], (uint32_t)-1);
    }
    s->pair_count = kept;
}

ktg_status ktg_split_conflicts(ktg_context *context, ktg_net *net, bool *joined, uint32_t *pieces) {
    split s = {.net = net,
               .path = ktg_new(context, net->dual->face_count, uint32_t),
               .uses = ktg_new(context, net->dual->edge_count, uint32_t),
               .pairs = ktg_copy_array(context, net->live, net->live_count, sizeof *net->live),
               .pair_count = net->live_count,
               .folds = ktg_new(context, net->dual->edge_count, uint32_t),
               .fold_count = net->dual->edge_count};
    ktg_status status = s.path && s.uses && s.pairs && s.folds ? KTG_OK : KTG_MEMORY;
    *pieces = 1;
    if (status == KTG_OK) {
        for (uint32_t e = 0; e < s.fold_count; e++)
            s.folds[e] = e;
        for (size_t i = 0; i < s.pair_count; i++)
            count_path(&s, s.pairs[i], 1);
        for (; s.pair_count > 0; ++*pieces) {
            uint32_t fold = choose_fold(&s);
            if (fold == KTG_NONE)
                break; /* only kept folds are left, which were checked beforehand */
            joined[fold] = false;
            part_pairs(&s, fold);
        }
    }
    ktg_free(s.path);
    ktg_free(s.uses);
    ktg_free(s.pairs);
    ktg_free(s.folds);
    return status;
}
