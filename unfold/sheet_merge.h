/* unfold/sheet_merge.h - joining pieces of a forest that is in more of them than it should be
 * (unfold only). */
#ifndef KTG_UNFOLD_SHEET_MERGE_H
#define KTG_UNFOLD_SHEET_MERGE_H

#include "unfold/dual.h"

/* Hangs the smallest trees at others, where that makes no overlaps, until there are `count` or none
 * can be hung any more. How large the pieces become does not matter here: annealing deals with
 * that. folded: edge_count flags of a forest without overlaps. */
KTG_NODISCARD ktg_status ktg_sheet_merge(ktg_context *context, const ktg_dual *dual, uint32_t count,
                                         bool *folded);

#endif
