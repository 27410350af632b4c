/* render/weld.h - points that lie together become one, and segments between them become long paths
 * (render only). */
#ifndef KTG_RENDER_WELD_H
#define KTG_RENDER_WELD_H

#include "core/core.h"

/* Points in the order in which they were first met. Starts with context and tolerance set, the rest
 * 0; free with ktg_weld_drop. */
typedef struct ktg_weld {
    ktg_context *context;
    double tolerance;
    size_t count, capacity;
    ktg_vec2 *points;
    size_t slot_count;
    uint32_t *slots; /* a hash table of the points by their cell; point + 1, 0: free */
} ktg_weld;

/* The index of the first point met that lies within the tolerance of `point`. */
KTG_NODISCARD ktg_status ktg_weld_point(ktg_weld *weld, ktg_vec2 point, uint32_t *index);
void ktg_weld_drop(ktg_weld *weld);

typedef struct ktg_segment {
    uint32_t a, b; /* points of a weld */
} ktg_segment;

typedef ktg_status ktg_trail_draw(void *user, const ktg_vec2 *points, size_t count, bool closed);

/* Joins segments, each used once, to paths that go on as straight as they can, and hands these to
 * `draw`: open ones begin at loose ends, what has none is closed. */
KTG_NODISCARD ktg_status ktg_trails_join(const ktg_weld *weld, const ktg_segment *segments,
                                         size_t count, ktg_trail_draw *draw, void *user);

#endif
