/* unfold/cut_table.h - curvature and the cut-count table (sections 3 and 5.1 of the paper; unfold
 * only).
 *
 * For every vertex the number of sectors is kept: the fans into which the faces around it fall
 * apart. An inner vertex has as many as cut edges, a border vertex one more. A saddle (angle sum
 * above 2 pi) needs two, or faces next to each other overlap for certain; any other vertex needs
 * one. */
#ifndef KTG_UNFOLD_CUT_TABLE_H
#define KTG_UNFOLD_CUT_TABLE_H

#include "unfold/dual.h"

typedef struct ktg_cut_table {
    uint32_t vertex_count;
    uint32_t *sectors; /* vertex_count: now */
    uint8_t *needed;   /* vertex_count: 1, or 2 at a saddle */
} ktg_cut_table;

/* The table when every dual edge that is not `joined` (edge_count flags) is cut. */
KTG_NODISCARD ktg_status ktg_cut_table_new(ktg_context *context, const ktg_dual *dual,
                                           const bool *joined, ktg_cut_table *table);
void ktg_cut_table_free(ktg_cut_table *table);

/* False when joining the edge would break the rule at one of its ends: it is not locally mergeable.
 * Kept folds were looked at before (rules.h). */
static inline bool ktg_cut_table_allows(const ktg_cut_table *table, const ktg_dual_edge *edge) {
    uint32_t a = edge->vertices[0], b = edge->vertices[1];
    return edge->kept ||
           (table->sectors[a] > table->needed[a] && table->sectors[b] > table->needed[b]);
}

static inline void ktg_cut_table_join(ktg_cut_table *table, const ktg_dual_edge *edge) {
    table->sectors[edge->vertices[0]]--;
    table->sectors[edge->vertices[1]]--;
}

#endif
