/* unfold/overlap.c - the overlap of two flat triangles, by separating axes. */
#include "unfold/overlap.h"
#include "core/vec.h"

/* One step outwards for a float made from a double. */
static float down(double x) {
    float f = (float)x;
    return f - fabsf(f) * 0x1p-22f;
}

static float up(double x) {
    float f = (float)x;
    return f + fabsf(f) * 0x1p-22f;
}

ktg_flat_box ktg_flat_box_around(ktg_vec2 low, ktg_vec2 high) {
    return (ktg_flat_box){down(low.x), down(low.y), up(high.x), up(high.y)};
}

ktg_flat_box ktg_flat_box_of(const ktg_vec2 c[3]) {
    double x0 = ktg_min(c[0].x, ktg_min(c[1].x, c[2].x)),
           x1 = ktg_max(c[0].x, ktg_max(c[1].x, c[2].x));
    double y0 = ktg_min(c[0].y, ktg_min(c[1].y, c[2].y)),
           y1 = ktg_max(c[0].y, ktg_max(c[1].y, c[2].y));
    return (ktg_flat_box){down(x0), down(y0), up(x1), up(y1)};
}

void ktg_flat_box_add(ktg_flat_box *box, const ktg_flat_box *other) {
    box->x0 = other->x0 < box->x0 ? other->x0 : box->x0;
    box->y0 = other->y0 < box->y0 ? other->y0 : box->y0;
    box->x1 = other->x1 > box->x1 ? other->x1 : box->x1;
    box->y1 = other->y1 > box->y1 ? other->y1 : box->y1;
}

ktg_flat_box ktg_flat_box_empty(void) {
    return (ktg_flat_box){INFINITY, INFINITY, -INFINITY, -INFINITY};
}

/* True when an edge of `a` has all of `b` on its outer side, but for `depth`. */
static bool edge_parts(const ktg_vec2 a[3], const double lengths[3], const ktg_vec2 b[3],
                       double depth) {
    for (int k = 0; k < 3; k++) {
        ktg_vec2 p = a[k], q = a[k == 2 ? 0 : k + 1];
        double nx = q.y - p.y, ny = p.x - q.x; /* outwards, as long as the edge */
        double s0 = nx * (b[0].x - p.x) + ny * (b[0].y - p.y);
        double s1 = nx * (b[1].x - p.x) + ny * (b[1].y - p.y);
        double s2 = nx * (b[2].x - p.x) + ny * (b[2].y - p.y);
        double least = s0 < s1 ? s0 : s1;
        least = s2 < least ? s2 : least;
        if (least >= -depth * lengths[k])
            return true;
    }
    return false;
}

bool ktg_triangles_overlap(const ktg_vec2 a[3], const double a_lengths[3], const ktg_vec2 b[3],
                           const double b_lengths[3], double depth) {
    return !edge_parts(a, a_lengths, b, depth) && !edge_parts(b, b_lengths, a, depth);
}
