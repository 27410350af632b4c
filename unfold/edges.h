/* unfold/edges.h - the edges of the pattern: kinds, angles, sides (unfold only). */
#ifndef KTG_UNFOLD_EDGES_H
#define KTG_UNFOLD_EDGES_H

#include "mesh/mesh.h"
#include "pattern/pattern.h"

/* Fills pattern->edges, one for each edge of the adjacency, in its order. is_fold: flags per edge.
 * The pattern's surface and pieces must be there. */
KTG_NODISCARD ktg_status ktg_edges_fill(ktg_context *context, const ktg_adjacency *adjacency,
                                        const bool *is_fold, ktg_pattern *pattern);

#endif
