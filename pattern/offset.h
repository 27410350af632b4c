/* pattern/offset.h - a polygon grown outwards (lent to layout/). */
#ifndef KTG_PATTERN_OFFSET_H
#define KTG_PATTERN_OFFSET_H

#include "core/core.h"

/* The outer boundary of the region within `distance` of a polygon, with mitred corners:
 * a simple, counter-clockwise polygon in *outline (allocated). The polygon is counter-clockwise,
 * weakly simple and has at least 3 corners. KTG_GEOMETRY when it is so bent that none is found. */
KTG_NODISCARD ktg_status ktg_offset_outward(ktg_context *context, const ktg_vec2 *polygon,
                                            size_t count, double distance, ktg_vec2 **outline,
                                            size_t *outline_count);

#endif
