/* pattern/offset_walk.h - the outermost walk around a closed curve that crosses itself (pattern
 * only). */
#ifndef KTG_PATTERN_OFFSET_WALK_H
#define KTG_PATTERN_OFFSET_WALK_H

#include "core/core.h"

/* *outline (allocated): the boundary, counter-clockwise, of the unbounded region beside the closed
 * curve. Points nearer to each other, or to a side, than `near` are one. *simple says whether the
 * outline is a simple polygon, as it is when nothing merely touches. Where it comes through a point
 * twice, the loop of it around `inside` is taken, if that is not NULL. */
KTG_NODISCARD ktg_status ktg_outermost_walk(ktg_context *context, const ktg_vec2 *curve,
                                            size_t count, double near, const ktg_vec2 *inside,
                                            ktg_vec2 **outline, size_t *outline_count,
                                            bool *simple);

#endif
