/* unfold/strips.h - section 4.2: the spanning tree falls apart into strips of faces (unfold only).
 */
#ifndef KTG_UNFOLD_STRIPS_H
#define KTG_UNFOLD_STRIPS_H

#include "unfold/dual.h"

/* Takes edges out of the spanning tree `in_tree` (edge_count flags, changed) until every component
 * is a path of polygons: walks from a leaf and, wherever the way branches, cuts the shorter
 * branches. A polygon is a face, or the faces joined by rigid edges, which are never cut here. */
KTG_NODISCARD ktg_status ktg_strips_cut(ktg_context *context, const ktg_dual *dual, bool *in_tree);

#endif
