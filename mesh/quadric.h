/* mesh/quadric.h - quadric error (Garland & Heckbert 1997) with a spread (mesh only).
 *
 * E(x) = x' A x - 2 b' x + c + w x' x - 2 p' x + d: a sum of squared distances to planes, and with
 * a small weight to points, as when the planes' normals were a little uncertain (Trettner & Kobbelt
 * 2020). The points make collapses cost something where a surface is flat, so that vertices stay
 * evenly spread. They are kept apart from the planes, because the best position should lie where
 * the planes say (an edge stays sharp), and where the points say only along what the planes leave
 * open. */
#ifndef KTG_MESH_QUADRIC_H
#define KTG_MESH_QUADRIC_H

#include "core/vec.h"

typedef struct ktg_quadric {
    double xx, xy, xz, yy, yz, zz;
    ktg_vec3 b;
    double c;
    double point_weight; /* w */
    ktg_vec3 points;     /* p */
    double squares;      /* d */
} ktg_quadric;

/* The plane through `point` with unit normal `n`. */
static inline void ktg_quadric_add_plane(ktg_quadric *q, ktg_vec3 n, ktg_vec3 point,
                                         double weight) {
    double d = ktg_dot3(n, point);
    q->xx += weight * n.x * n.x;
    q->xy += weight * n.x * n.y;
    q->xz += weight * n.x * n.z;
    q->yy += weight * n.y * n.y;
    q->yz += weight * n.y * n.z;
    q->zz += weight * n.z * n.z;
    q->b = ktg_madd3(q->b, weight * d, n);
    q->c += weight * d * d;
}

static inline void ktg_quadric_add_point(ktg_quadric *q, ktg_vec3 point, double weight) {
    q->point_weight += weight;
    q->points = ktg_madd3(q->points, weight, point);
    q->squares += weight * ktg_dot3(point, point);
}

static inline ktg_quadric ktg_quadric_sum(const ktg_quadric *p, const ktg_quadric *q) {
    ktg_quadric sum = *p;
    sum.xx += q->xx;
    sum.xy += q->xy;
    sum.xz += q->xz;
    sum.yy += q->yy;
    sum.yz += q->yz;
    sum.zz += q->zz;
    sum.b = ktg_add3(p->b, q->b);
    sum.c += q->c;
    sum.point_weight += q->point_weight;
    sum.points = ktg_add3(p->points, q->points);
    sum.squares += q->squares;
    return sum;
}

/* A x + w s x, the points weighing s times what they do in the error. */
static inline ktg_vec3 ktg_quadric_times(const ktg_quadric *q, double s, ktg_vec3 x) {
    double w = s * q->point_weight;
    return (ktg_vec3){(q->xx + w) * x.x + q->xy * x.y + q->xz * x.z,
                      q->xy * x.x + (q->yy + w) * x.y + q->yz * x.z,
                      q->xz * x.x + q->yz * x.y + (q->zz + w) * x.z};
}

/* Never below 0, whatever rounding says. */
static inline double ktg_quadric_error(const ktg_quadric *q, ktg_vec3 x) {
    double e = ktg_dot3(x, ktg_quadric_times(q, 1, x)) -
               2 * ktg_dot3(ktg_add3(q->b, q->points), x) + q->c + q->squares;
    return e > 0 ? e : 0;
}

/* What the points count in the choice of a position, as a part of what they do in the error. */
#define KTG_QUADRIC_POINTS 0.01

/* The best x, by Cramer's rule from `near` (for the sake of digits); false when there is none that
 * could be told. */
static inline bool ktg_quadric_least(const ktg_quadric *q, ktg_vec3 near, ktg_vec3 *x) {
    double s = KTG_QUADRIC_POINTS, w = s * q->point_weight;
    ktg_vec3 r = ktg_sub3(ktg_madd3(q->b, s, q->points), ktg_quadric_times(q, s, near));
    ktg_vec3 c0 = {q->xx + w, q->xy, q->xz}, c1 = {q->xy, q->yy + w, q->yz},
             c2 = {q->xz, q->yz, q->zz + w};
    double det = ktg_dot3(c0, ktg_cross3(c1, c2)), trace = c0.x + c1.y + c2.z;
    if (!(det > 1e-13 * trace * trace * trace))
        return false;
    ktg_vec3 step = {ktg_dot3(r, ktg_cross3(c1, c2)) / det, ktg_dot3(c0, ktg_cross3(r, c2)) / det,
                     ktg_dot3(c0, ktg_cross3(c1, r)) / det};
    *x = ktg_add3(near, step);
    return true;
}

/* The best x on the line through `near` along `direction`; false as above. */
static inline bool ktg_quadric_least_along(const ktg_quadric *q, ktg_vec3 near, ktg_vec3 direction,
                                           ktg_vec3 *x) {
    double s = KTG_QUADRIC_POINTS;
    ktg_vec3 r = ktg_sub3(ktg_madd3(q->b, s, q->points), ktg_quadric_times(q, s, near));
    double bend = ktg_dot3(direction, ktg_quadric_times(q, s, direction));
    if (!(bend > 0))
        return false;
    *x = ktg_madd3(near, ktg_dot3(r, direction) / bend, direction);
    return true;
}

#endif
