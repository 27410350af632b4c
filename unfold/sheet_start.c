/* unfold/sheet_start.c - from regions to pieces without overlaps. */
#include "unfold/sheet_start.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/dual_part.h"
#include "unfold/split.h"
#include "unfold/transplant.h"

#include <string.h>

/* Steps that may end without a new least number of overlaps, besides one for each face. */
#define PATIENCE 1500

/* ---- trees ---------------------------------------------------------------------------------- */

static void flood(const ktg_dual *dual, const bool *folded, uint32_t from, uint32_t number,
                  uint32_t *tree, uint32_t *stack) {
    uint32_t depth = 0;
    stack[depth++] = from;
    tree[from] = number;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = dual->halfedge_edge[h];
            if (e == KTG_NONE || !folded[e])
                continue;
            const uint32_t *pair = dual->edges[e].halfedge;
            uint32_t other = (pair[0] == h ? pair[1] : pair[0]) / 3;
            if (tree[other] == KTG_NONE) {
                tree[other] = number;
                stack[depth++] = other;
            }
        }
    }
}

ktg_status ktg_sheet_trees(ktg_context *context, const ktg_dual *dual, const bool *folded,
                           uint32_t *tree, uint32_t *count) {
    uint32_t *stack = ktg_new(context, dual->face_count, uint32_t);
    if (!stack)
        return KTG_MEMORY;
    memset(tree, 0xff, dual->face_count * sizeof *tree);
    *count = 0;
    for (uint32_t f = 0; f < dual->face_count; f++)
        if (tree[f] == KTG_NONE)
            flood(dual, folded, f, (*count)++, tree, stack);
    ktg_free(stack);
    return KTG_OK;
}

/* ---- one region after the other ------------------------------------------------------------- */

/* What is done with the dual of one region; `edge_of` are its edges' numbers in the whole. */
typedef ktg_status visit_function(ktg_context *context, const ktg_dual *part,
                                  const uint32_t *edge_of, void *user);

static ktg_status visit_region(ktg_context *context, const ktg_dual *dual, const uint32_t *region,
                               uint32_t number, uint32_t *faces, visit_function *visit,
                               void *user) {
    ktg_dual *part = NULL;
    uint32_t *edge_of = NULL, count = 0;
    for (uint32_t f = 0; f < dual->face_count; f++)
        if (region[f] == number)
            faces[count++] = f;
    ktg_status status = ktg_dual_part(context, dual, faces, count, &part, &edge_of);
    if (status == KTG_OK && part->edge_count > 0)
        status = visit(context, part, edge_of, user);
    ktg_dual_free(&part);
    ktg_free(edge_of);
    return status;
}

static ktg_status visit_regions(ktg_context *context, const ktg_dual *dual, const uint32_t *region,
                                uint32_t count, visit_function *visit, void *user) {
    uint32_t *faces = ktg_new(context, dual->face_count, uint32_t);
    ktg_status status = faces ? KTG_OK : KTG_MEMORY;
    for (uint32_t r = 0; status == KTG_OK && r < count; r++)
        status = visit_region(context, dual, region, r, faces, visit, user);
    ktg_free(faces);
    return status;
}

/* ---- starting ------------------------------------------------------------------------------- */

typedef struct starting {
    ktg_search *search;
    bool *folded;
} starting;

static ktg_status unfold_tree(ktg_context *context, const ktg_dual *part, ktg_search *search,
                              bool *folded) {
    ktg_net *net = NULL;
    uint32_t pieces;
    KTG_TRY(ktg_dual_spanning_tree(context, part, 0, &search->random, folded));
    KTG_TRY(ktg_net_new(context, part, folded, &net));
    ktg_status status = ktg_transplant_run(context, net, PATIENCE + part->face_count, search);
    if (status == KTG_OK)
        status = ktg_net_refresh(context, net);
    if (status == KTG_OK)
        memcpy(folded, net->folded, part->edge_count * sizeof *folded);
    if (status == KTG_OK && net->live_count > 0)
        status = ktg_split_conflicts(context, net, folded, &pieces);
    ktg_net_free(&net);
    return status;
}

static ktg_status start_region(ktg_context *context, const ktg_dual *part, const uint32_t *edge_of,
                               void *user) {
    starting *s = user;
    bool *folded = ktg_new(context, part->edge_count, bool);
    ktg_status status = folded ? unfold_tree(context, part, s->search, folded) : KTG_MEMORY;
    for (uint32_t e = 0; status == KTG_OK && e < part->edge_count; e++)
        s->folded[edge_of[e]] = folded[e];
    ktg_free(folded);
    return status;
}

ktg_status ktg_sheet_start(ktg_context *context, const ktg_dual *dual, const uint32_t *region,
                           uint32_t count, ktg_search *search, bool *folded) {
    starting s = {search, folded};
    memset(folded, 0, dual->edge_count * sizeof *folded);
    return visit_regions(context, dual, region, count, start_region, &s);
}

/* ---- overlaps ------------------------------------------------------------------------------- */

typedef struct looking {
    const bool *folded;
    bool overlaps;
} looking;

static ktg_status look_at_tree(ktg_context *context, const ktg_dual *part, const uint32_t *edge_of,
                               void *user) {
    looking *l = user;
    ktg_net *net = NULL;
    bool *folded = ktg_new(context, part->edge_count, bool);
    for (uint32_t e = 0; folded && e < part->edge_count; e++)
        folded[e] = l->folded[edge_of[e]];
    ktg_status status = folded ? ktg_net_new(context, part, folded, &net) : KTG_MEMORY;
    if (status == KTG_OK)
        l->overlaps |= net->live_count > 0;
    ktg_net_free(&net);
    ktg_free(folded);
    return status;
}

ktg_status ktg_sheet_overlaps(ktg_context *context, const ktg_dual *dual, const bool *folded,
                              bool *overlaps) {
    looking l = {folded, false};
    uint32_t *tree = ktg_new(context, dual->face_count, uint32_t), count;
    ktg_status status = tree ? ktg_sheet_trees(context, dual, folded, tree, &count) : KTG_MEMORY;
    if (status == KTG_OK)
        status = visit_regions(context, dual, tree, count, look_at_tree, &l);
    *overlaps = l.overlaps;
    ktg_free(tree);
    return status;
}
