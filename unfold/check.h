/* unfold/check.h - can this surface be unfolded at all? (unfold only) */
#ifndef KTG_UNFOLD_CHECK_H
#define KTG_UNFOLD_CHECK_H

#include "mesh/mesh.h"

/* KTG_OK for an oriented manifold, with or without border, whose faces all have an area;
 * KTG_ARGUMENT names a face where it is not. KTG_MEMORY. */
KTG_NODISCARD ktg_status ktg_unfold_check(ktg_context *context, const ktg_mesh *mesh,
                                          const ktg_adjacency *adjacency);

#endif
