/* unfold/overlap.h - do two flat triangles overlap? (unfold only) */
#ifndef KTG_UNFOLD_OVERLAP_H
#define KTG_UNFOLD_OVERLAP_H

#include "core/core.h"

/* A bounding box rounded outwards to floats: four of them share a cache line. */
typedef struct ktg_flat_box {
    float x0, y0, x1, y1;
} ktg_flat_box;

static inline bool ktg_flat_boxes_meet(const ktg_flat_box *a, const ktg_flat_box *b) {
    return (a->x0 <= b->x1) & (b->x0 <= a->x1) & (a->y0 <= b->y1) & (b->y0 <= a->y1);
}

/* The box from `low` to `high`. */
ktg_flat_box ktg_flat_box_around(ktg_vec2 low, ktg_vec2 high);
/* The box of three corners. */
ktg_flat_box ktg_flat_box_of(const ktg_vec2 corners[3]);
/* Grows *box to hold other. */
void ktg_flat_box_add(ktg_flat_box *box, const ktg_flat_box *other);
/* Holds nothing; the start for ktg_flat_box_add. */
ktg_flat_box ktg_flat_box_empty(void);

/* True when the shortest translation that parts the two counter-clockwise triangles is longer than
 * `depth`. For convex shapes it runs along the normal of some edge (separating axis theorem).
 * a_lengths, b_lengths: of the edges from corner k to the next. */
bool ktg_triangles_overlap(const ktg_vec2 a[3], const double a_lengths[3], const ktg_vec2 b[3],
                           const double b_lengths[3], double depth);

#endif
