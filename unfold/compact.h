/* unfold/compact.h - a net without overlaps becomes more compact, so that it fits its sheet at a
 * larger scale (unfold only). */
#ifndef KTG_UNFOLD_COMPACT_H
#define KTG_UNFOLD_COMPACT_H

#include "unfold/net.h"
#include "unfold/search.h"

/* Simulated annealing with the moves of the transplant search, among nets without overlaps: the
 * cost is the mean over the net's area of (|x| / a)^4 + (|y| / b)^4 about the middle, a / b =
 * `aspect` (width over height of the sheet), a b = the net's area. Ends when bodies of `most_work`
 * faces in all have been looked at, or at the search's limits. The net must have no conflicts and
 * gets none. Rigid edges stay folds. */
KTG_NODISCARD ktg_status ktg_compact_run(ktg_context *context, ktg_net *net, double aspect,
                                         uint64_t most_work, ktg_search *search);

#endif
