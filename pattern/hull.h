/* pattern/hull.h - convex hulls (lent to layout/ and flatten/). */
#ifndef KTG_PATTERN_HULL_H
#define KTG_PATTERN_HULL_H

#include "core/vec.h"

/* The corners of the convex hull, counter-clockwise from the lowest of the leftmost points, without
 * points on its sides; *hull is allocated for point_count + 1 points. One corner for a single
 * point, two for points on a line. KTG_ARGUMENT without points or with one that is not finite, or
 * beyond 1e150. */
KTG_NODISCARD ktg_status ktg_hull(ktg_context *context, const ktg_vec2 *points, size_t point_count,
                                  ktg_vec2 **hull, size_t *count);

#endif
