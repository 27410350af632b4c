/* unfold/pieces.h - from folds and cuts to the pieces of a pattern (unfold only). */
#ifndef KTG_UNFOLD_PIECES_H
#define KTG_UNFOLD_PIECES_H

#include "pattern/pattern.h"
#include "unfold/dual.h"

/* Lays the pieces of one part flat and appends them to the pattern, largest first, in the
 * model's unit (coordinates of the dual over `scale`). `joined`: edge_count flags of the dual's
 * edges that are folds, a forest; a cut that closes by itself around a flat vertex is turned into a
 * fold (the flag is set). The pattern's edges are not touched. pieces_capacity belongs to
 * pattern->pieces. */
KTG_NODISCARD ktg_status ktg_pieces_append(ktg_context *context, const ktg_dual *dual, double scale,
                                           bool *joined, uint32_t component, ktg_pattern *pattern,
                                           size_t *pieces_capacity);

/* Only sets the flags of such cuts that close by themselves. */
KTG_NODISCARD ktg_status ktg_pieces_close(ktg_context *context, const ktg_dual *dual, bool *joined);

/* Sorts the pieces by component, those of one the largest first; before there are edges. */
KTG_NODISCARD ktg_status ktg_pieces_sort(ktg_context *context, ktg_pattern *pattern);

#endif
