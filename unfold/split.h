/* unfold/split.h - a net with overlaps falls apart into pieces without (unfold only). */
#ifndef KTG_UNFOLD_SPLIT_H
#define KTG_UNFOLD_SPLIT_H

#include "unfold/net.h"

/* Takes folds out of `joined` (edge_count flags; the net's tree on entry) until no two overlapping
 * faces of the net are in one piece. Each cut is the fold that parts most of the pairs still
 * together. Rigid edges go last. *pieces: how many are left.
 */
KTG_NODISCARD ktg_status ktg_split_conflicts(ktg_context *context, ktg_net *net, bool *joined,
                                             uint32_t *pieces);

#endif
