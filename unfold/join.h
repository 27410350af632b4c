/* unfold/join.h - the methods: which faces of one component are joined (unfold only). */
#ifndef KTG_UNFOLD_JOIN_H
#define KTG_UNFOLD_JOIN_H

#include "unfold/dual.h"
#include "unfold/search.h"

/* The method of the paper, with fresh starts. joined: edge_count flags, set: a forest whose trees
 * have no overlaps. *pieces: how many trees. */
KTG_NODISCARD ktg_status ktg_join_genetic(ktg_context *context, const ktg_dual *dual,
                                          const ktg_unfold_options *options, ktg_search *search,
                                          bool *joined, uint32_t *pieces);

/* Conflict-driven subtree transplant, with fresh starts, then annealing towards the sheet's shape;
 * where no tree without overlaps is found, the best one falls apart into few pieces. Likewise. */
KTG_NODISCARD ktg_status ktg_join_transplant(ktg_context *context, const ktg_dual *dual,
                                             const ktg_unfold_options *options, ktg_search *search,
                                             bool *joined, uint32_t *pieces);

#endif
