/* unfold/dual_part.h - some faces of a dual graph as a dual graph of their own (unfold only). */
#ifndef KTG_UNFOLD_DUAL_PART_H
#define KTG_UNFOLD_DUAL_PART_H

#include "unfold/dual.h"

/* faces: face_count faces of `dual`, rising. Edges to other faces become borders. edge_of:
 * allocated, the number in `dual` of each edge of the part (free with ktg_free). */
KTG_NODISCARD ktg_status ktg_dual_part(ktg_context *context, const ktg_dual *dual,
                                       const uint32_t *faces, uint32_t face_count, ktg_dual **part,
                                       uint32_t **edge_of);

#endif
