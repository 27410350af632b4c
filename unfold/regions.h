/* unfold/regions.h - a surface divided into compact regions of like size, before each becomes a
 * piece (unfold only).
 *
 * Regions grow from seeds over the dual graph, the nearest seed taking each face (Dijkstra). Steps
 * across creases, valleys above all, are long, so that borders run along them. Then seeds move to
 * the middles of their regions (Lloyd), and regions that are too large start later. */
#ifndef KTG_UNFOLD_REGIONS_H
#define KTG_UNFOLD_REGIONS_H

#include "unfold/dual.h"

/* region: face_count numbers below `count`, set: each region is connected and has at least one
 * face. load: face_count, what is to be balanced. count: 1 .. face_count of a connected dual.
 * Faces joined by rigid edges stay together; there may be fewer regions when so many faces do:
 * *made. */
KTG_NODISCARD ktg_status ktg_regions_grow(ktg_context *context, const ktg_dual *dual,
                                          const double *load, uint32_t count, ktg_random *random,
                                          uint32_t *region, uint32_t *made);

#endif
