/* unfold/sheet_start.h - from regions of a surface to pieces without overlaps, and cutting pieces
 * that stay too large (unfold only). */
#ifndef KTG_UNFOLD_SHEET_START_H
#define KTG_UNFOLD_SHEET_START_H

#include "unfold/dual.h"
#include "unfold/search.h"

/* A tree for each region (region: face_count numbers below `count`), by transplants; where one has
 * overlaps that do not go away it falls apart. folded: edge_count flags, set. */
KTG_NODISCARD ktg_status ktg_sheet_start(ktg_context *context, const ktg_dual *dual,
                                         const uint32_t *region, uint32_t count, ktg_search *search,
                                         bool *folded);

/* Cuts the trees of the marked pieces (piece: of each face; cut: piece_count flags) in halves of
 * like area; *cuts: how many could be. Kept edges stay, rigid ones where there are others. */
KTG_NODISCARD ktg_status ktg_sheet_halve(ktg_context *context, const ktg_dual *dual,
                                         const uint32_t *piece, const bool *cut,
                                         uint32_t piece_count, bool *folded, uint32_t *cuts);

/* Halves the tree of the largest area until there are `count`, or none can be cut any more. */
KTG_NODISCARD ktg_status ktg_sheet_halve_largest(ktg_context *context, const ktg_dual *dual,
                                                 uint32_t count, bool *folded);

/* Whether faces of a tree overlap when it is laid flat from its flags alone. */
KTG_NODISCARD ktg_status ktg_sheet_overlaps(ktg_context *context, const ktg_dual *dual,
                                            const bool *folded, bool *overlaps);

/* The tree that each face is in; *count: how many. */
KTG_NODISCARD ktg_status ktg_sheet_trees(ktg_context *context, const ktg_dual *dual,
                                         const bool *folded, uint32_t *tree, uint32_t *count);

#endif
