/* core/vec.h - small vector and rigid-motion maths (shared between folders, not installed). */
#ifndef KTG_CORE_VEC_H
#define KTG_CORE_VEC_H

#include "core/core.h"

#include <math.h>

#define KTG_PI 3.14159265358979323846

/* fmin and fmax as one instruction each: NaN is nobody's business here. */
static inline double ktg_min(double a, double b) {
    return a < b ? a : b;
}
static inline double ktg_max(double a, double b) {
    return a > b ? a : b;
}

static inline ktg_vec2 ktg_add2(ktg_vec2 a, ktg_vec2 b) {
    return (ktg_vec2){a.x + b.x, a.y + b.y};
}
static inline ktg_vec2 ktg_sub2(ktg_vec2 a, ktg_vec2 b) {
    return (ktg_vec2){a.x - b.x, a.y - b.y};
}
static inline ktg_vec2 ktg_mul2(ktg_vec2 a, double s) {
    return (ktg_vec2){a.x * s, a.y * s};
}
/* a + s b */
static inline ktg_vec2 ktg_madd2(ktg_vec2 a, double s, ktg_vec2 b) {
    return (ktg_vec2){a.x + s * b.x, a.y + s * b.y};
}
static inline double ktg_dot2(ktg_vec2 a, ktg_vec2 b) {
    return a.x * b.x + a.y * b.y;
}
static inline double ktg_cross2(ktg_vec2 a, ktg_vec2 b) {
    return a.x * b.y - a.y * b.x;
}
static inline double ktg_length2(ktg_vec2 a) {
    return sqrt(ktg_dot2(a, a));
}
/* a turned by 90 degrees counter-clockwise */
static inline ktg_vec2 ktg_perp2(ktg_vec2 a) {
    return (ktg_vec2){-a.y, a.x};
}
/* Unit vector along a; (0, 0) for a zero vector. */
static inline ktg_vec2 ktg_unit2(ktg_vec2 a) {
    double length = ktg_length2(a);
    return length > 0 ? ktg_mul2(a, 1 / length) : (ktg_vec2){0, 0};
}

static inline ktg_vec3 ktg_add3(ktg_vec3 a, ktg_vec3 b) {
    return (ktg_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline ktg_vec3 ktg_sub3(ktg_vec3 a, ktg_vec3 b) {
    return (ktg_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline ktg_vec3 ktg_mul3(ktg_vec3 a, double s) {
    return (ktg_vec3){a.x * s, a.y * s, a.z * s};
}
/* a + s b */
static inline ktg_vec3 ktg_madd3(ktg_vec3 a, double s, ktg_vec3 b) {
    return (ktg_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline double ktg_dot3(ktg_vec3 a, ktg_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline ktg_vec3 ktg_cross3(ktg_vec3 a, ktg_vec3 b) {
    return (ktg_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double ktg_length3(ktg_vec3 a) {
    return sqrt(ktg_dot3(a, a));
}
static inline ktg_vec3 ktg_unit3(ktg_vec3 a) {
    double length = ktg_length3(a);
    return length > 0 ? ktg_mul3(a, 1 / length) : (ktg_vec3){0, 0, 0};
}

/* The largest coordinate without its sign. */
static inline double ktg_largest3(ktg_vec3 v) {
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}
/* a times 2^exponent, which is exact */
static inline ktg_vec3 ktg_ldexp3(ktg_vec3 a, int exponent) {
    return (ktg_vec3){ldexp(a.x, exponent), ldexp(a.y, exponent), ldexp(a.z, exponent)};
}

/* Rigid motion of the plane without reflection: p -> R p + t, R = [c -s; s c]. */
typedef struct ktg_motion2 {
    double c, s;
    ktg_vec2 t;
} ktg_motion2;

static inline ktg_vec2 ktg_move2(ktg_motion2 m, ktg_vec2 p) {
    return (ktg_vec2){m.c * p.x - m.s * p.y + m.t.x, m.s * p.x + m.c * p.y + m.t.y};
}

/* The motion that takes point a to A with direction b - a to B - A (lengths taken as equal). */
static inline ktg_motion2 ktg_motion2_between(ktg_vec2 a, ktg_vec2 b, ktg_vec2 A, ktg_vec2 B) {
    ktg_vec2 from = ktg_sub2(b, a), to = ktg_sub2(B, A);
    double c = ktg_dot2(from, to), s = ktg_cross2(from, to), n = sqrt(c * c + s * s);
    ktg_motion2 m = {n > 0 ? c / n : 1, n > 0 ? s / n : 0, {0, 0}};
    ktg_vec2 moved = ktg_move2(m, a);
    m.t = ktg_sub2(A, moved);
    return m;
}

#endif
