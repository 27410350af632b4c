/* unfold/sheet_halve.c - cutting pieces in halves of like area. */
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/sheet_start.h"

/* A fold of each piece that divides it best: 0 rigid, 1 free, then by the smaller half's area. */
typedef struct best_fold {
    uint32_t fold;
    bool is_free;
    double smaller;
} best_fold;

/* Areas below each face, from the leaves up; `order` lists parents before children. */
static void add_up(const ktg_dual *dual, const uint32_t *order, const uint32_t *up, double *below) {
    for (uint32_t i = dual->face_count; i-- > 0;) {
        uint32_t face = order[i], e = up[face];
        if (e == KTG_NONE)
            continue;
        const uint32_t *pair = dual->edges[e].halfedge;
        below[pair[0] / 3 == face ? pair[1] / 3 : pair[0] / 3] += below[face];
    }
}

static void root_trees(const ktg_dual *dual, const bool *folded, uint32_t *order, uint32_t *up,
                       bool *seen) {
    uint32_t count = 0;
    for (uint32_t root = 0; root < dual->face_count; root++) {
        if (seen[root])
            continue;
        uint32_t next = count;
        seen[root] = true;
        up[root] = KTG_NONE;
        order[count++] = root;
        for (; next < count; next++)
            for (uint32_t h = 3 * order[next], end = h + 3; h < end; h++) {
                uint32_t e = dual->halfedge_edge[h];
                if (e == KTG_NONE || !folded[e])
                    continue;
                const uint32_t *pair = dual->edges[e].halfedge;
                uint32_t other = (pair[0] == h ? pair[1] : pair[0]) / 3;
                if (seen[other])
                    continue;
                seen[other] = true;
                up[other] = e;
                order[count++] = other;
            }
    }
}

static void choose_folds(const ktg_dual *dual, const uint32_t *piece, const uint32_t *up,
                         const double *below, const double *all, best_fold *best) {
    for (uint32_t f = 0; f < dual->face_count; f++) {
        if (up[f] == KTG_NONE || dual->edges[up[f]].kept)
            continue;
        best_fold here = {up[f], !dual->edges[up[f]].rigid,
                          fmin(below[f], all[piece[f]] - below[f])};
        best_fold *b = &best[piece[f]];
        if (b->fold == KTG_NONE || here.is_free > b->is_free ||
            (here.is_free == b->is_free && here.smaller > b->smaller))
            *b = here;
    }
}

static double area_of(const ktg_dual *dual, uint32_t face) {
    const ktg_vec2 *p = dual->flat + 3 * (size_t)face;
    return 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
}

ktg_status ktg_sheet_halve(ktg_context *context, const ktg_dual *dual, const uint32_t *piece,
                           const bool *cut, uint32_t piece_count, bool *folded, uint32_t *cuts) {
    size_t n = dual->face_count;
    uint32_t *order = ktg_new(context, n, uint32_t), *up = ktg_new(context, n, uint32_t);
    bool *seen = ktg_new(context, n, bool);
    double *below = ktg_new(context, n, double), *all = ktg_new(context, piece_count, double);
    best_fold *best = ktg_new(context, piece_count, best_fold);
    ktg_status status = order && up && seen && below && all && best ? KTG_OK : KTG_MEMORY;
    *cuts = 0;
    if (status == KTG_OK) {
        for (uint32_t f = 0; f < n; f++)
            all[piece[f]] += below[f] = area_of(dual, f);
        for (uint32_t p = 0; p < piece_count; p++)
            best[p].fold = KTG_NONE;
        root_trees(dual, folded, order, up, seen);
        add_up(dual, order, up, below);
        choose_folds(dual, piece, up, below, all, best);
        for (uint32_t p = 0; p < piece_count; p++)
            if (cut[p] && best[p].fold != KTG_NONE) {
                folded[best[p].fold] = false;
                ++*cuts;
            }
    }
    ktg_free(order);
    ktg_free(up);
    ktg_free(seen);
    ktg_free(below);
    ktg_free(all);
    ktg_free(best);
    return status;
}

/* The tree of the largest area with more than one face; marks it in `cut`. False when there is
 * none. */
static bool mark_largest(const ktg_dual *dual, const uint32_t *tree, uint32_t count, double *area,
                         bool *cut) {
    uint32_t best = KTG_NONE;
    for (uint32_t t = 0; t < count; t++) {
        area[t] = 0;
        cut[t] = false;
    }
    for (uint32_t f = 0; f < dual->face_count; f++)
        area[tree[f]] += area_of(dual, f);
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        uint32_t a = tree[dual->edges[e].halfedge[0] / 3], b = tree[dual->edges[e].halfedge[1] / 3];
        if (a == b && !dual->edges[e].rigid && (best == KTG_NONE || area[a] > area[best]))
            best = a;
    }
    if (best != KTG_NONE)
        cut[best] = true;
    return best != KTG_NONE;
}

ktg_status ktg_sheet_halve_largest(ktg_context *context, const ktg_dual *dual, uint32_t wanted,
                                   bool *folded) {
    size_t n = dual->face_count;
    uint32_t *tree = ktg_new(context, n, uint32_t), count = 0, cuts = 1;
    double *area = ktg_new(context, n, double);
    bool *cut = ktg_new(context, n, bool);
    ktg_status status = tree && area && cut ? KTG_OK : KTG_MEMORY;
    while (status == KTG_OK && cuts > 0) {
        status = ktg_sheet_trees(context, dual, folded, tree, &count);
        if (status != KTG_OK || count >= wanted || !mark_largest(dual, tree, count, area, cut))
            break;
        status = ktg_sheet_halve(context, dual, tree, cut, count, folded, &cuts);
    }
    ktg_free(tree);
    ktg_free(area);
    ktg_free(cut);
    return status;
}
