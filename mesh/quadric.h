/* mesh/quadric.h - quadric error (Garland & Heckbert 1997) with a spread (mesh only).
 *
 * E(x) = x' A x - 2 b' x + c: a sum of squared distances to planes, and with a small weight to
 * points, as when the planes' normals were a little uncertain (Trettner & Kobbelt 2020). The points
 * keep A well conditioned and vertices evenly spread where a surface is flat. */
#ifndef KTG_MESH_QUADRIC_H
#define KTG_MESH_QUADRIC_H

#include "core/vec.h"

typedef struct ktg_quadric {
    double xx, xy, xz, yy, yz, zz;
    ktg_vec3 b;
    double c;
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
    q->xx += weight;
    q->yy += weight;
    q->zz += weight;
    q->b = ktg_madd3(q->b, weight, point);
    q->c += weight * ktg_dot3(point, point);
}

static inline ktg_quadric ktg_quadric_sum(const ktg_quadric *p, const ktg_quadric *q) {
    return (ktg_quadric){p->xx + q->xx, p->xy + q->xy, p->xz + q->xz,        p->yy + q->yy,
                         p->yz + q->yz, p->zz + q->zz, ktg_add3(p->b, q->b), p->c + q->c};
}

static inline ktg_vec3 ktg_quadric_times(const ktg_quadric *q, ktg_vec3 x) {
    return (ktg_vec3){q->xx * x.x + q->xy * x.y + q->xz * x.z,
                      q->xy * x.x + q->yy * x.y + q->yz * x.z,
                      q->xz * x.x + q->yz * x.y + q->zz * x.z};
}

/* Never below 0, whatever rounding says. */
static inline double ktg_quadric_error(const ktg_quadric *q, ktg_vec3 x) {
    double e = ktg_dot3(x, ktg_quadric_times(q, x)) - 2 * ktg_dot3(q->b, x) + q->c;
    return e > 0 ? e : 0;
}

/* The x of least error, by Cramer's rule from `near` (for the sake of digits); false when there is
 * none that could be told. */
static inline bool ktg_quadric_least(const ktg_quadric *q, ktg_vec3 near, ktg_vec3 *x) {
    ktg_vec3 r = ktg_sub3(q->b, ktg_quadric_times(q, near));
    ktg_vec3 c0 = {q->xx, q->xy, q->xz}, c1 = {q->xy, q->yy, q->yz}, c2 = {q->xz, q->yz, q->zz};
    double det = ktg_dot3(c0, ktg_cross3(c1, c2)), trace = q->xx + q->yy + q->zz;
    if (!(det > 1e-12 * trace * trace * trace))
        return false;
    ktg_vec3 step = {ktg_dot3(r, ktg_cross3(c1, c2)) / det, ktg_dot3(c0, ktg_cross3(r, c2)) / det,
                     ktg_dot3(c0, ktg_cross3(c1, r)) / det};
    *x = ktg_add3(near, step);
    return true;
}

#endif
