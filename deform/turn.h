/* deform/turn.h - rotations as unit quaternions and their logarithms (deform only). */
#ifndef KTG_DEFORM_TURN_H
#define KTG_DEFORM_TURN_H

#include "core/vec.h"

/* cos(angle / 2) and sin(angle / 2) axis. */
typedef struct ktg_turn {
    double w;
    ktg_vec3 v;
} ktg_turn;

static inline ktg_turn ktg_turn_none(void) {
    return (ktg_turn){1, {0, 0, 0}};
}

/* From the logarithm: half the angle times the axis (equation 4). */
static inline ktg_turn ktg_turn_exp(ktg_vec3 half) {
    double angle = ktg_length3(half);
    return (ktg_turn){cos(angle), ktg_mul3(half, angle > 0 ? sin(angle) / angle : 1)};
}

/* First b, then a; made a unit again, so that products of many stay rotations. */
static inline ktg_turn ktg_turn_mul(ktg_turn a, ktg_turn b) {
    ktg_turn c = {a.w * b.w - ktg_dot3(a.v, b.v),
                  ktg_madd3(ktg_madd3(ktg_cross3(a.v, b.v), a.w, b.v), b.w, a.v)};
    double scale = 1 / sqrt(c.w * c.w + ktg_dot3(c.v, c.v));
    return (ktg_turn){c.w * scale, ktg_mul3(c.v, scale)};
}

/* R p - p, which is exactly zero for no turn. */
static inline ktg_vec3 ktg_turn_shift(ktg_turn r, ktg_vec3 p) {
    ktg_vec3 t = ktg_mul3(ktg_cross3(r.v, p), 2);
    return ktg_madd3(ktg_cross3(r.v, t), r.w, t);
}

static inline ktg_vec3 ktg_turn_apply(ktg_turn r, ktg_vec3 p) {
    return ktg_add3(p, ktg_turn_shift(r, p));
}

/* The angle, 0 to pi. */
static inline double ktg_turn_angle(ktg_turn r) {
    return 2 * atan2(ktg_length3(r.v), fabs(r.w));
}

#endif
