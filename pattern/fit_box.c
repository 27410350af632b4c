/* pattern/fit_box.c - the smallest rectangle around points, and the rotation that fits a given
 * rectangle best.
 *
 * Turned by some angle, a hull is supported from below, right, above and left by four corners.
 * Between two angles at which one of its edges is flush with the page these four stay the same, and
 * width and height are each a distance times the cosine of a shifted angle: concave. The largest
 * magnification min(W / width, H / height) therefore lies at a flush angle or where both ratios are
 * equal; the smallest rectangle has a flush edge. */
#include "pattern/hull.h"

#include "core/memory.h"
#include "pattern/pattern.h"

#include <stdlib.h>

/* A rotation, cosine and sine with it, and the box around the hull turned by it. */
typedef struct turned {
    double angle;
    ktg_vec2 low, size;
} turned;

/* The least rotation in [0, pi/2) that makes direction d flush with an axis; so small a turn that
 * it only is rounding counts as 0. */
static double flush_angle(ktg_vec2 d) {
    double angle = -atan2(d.y, d.x);
    angle -= floor(angle / (KTG_PI / 2)) * (KTG_PI / 2);
    return angle >= KTG_PI / 2 * (1 - 1e-15) ? 0 : angle;
}

static turned turn(const ktg_vec2 *hull, size_t count, double angle) {
    ktg_motion2 motion = {cos(angle), sin(angle), {0, 0}};
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 p = ktg_move2(motion, hull[i]);
        low = (ktg_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    return (turned){angle, low, ktg_sub2(high, low)};
}

/* Equal up to rounding: then the smaller angle wins. */
#define SAME 1e-12

static void keep_smaller(turned *best, turned t) {
    double area = t.size.x * t.size.y, least = best->size.x * best->size.y;
    if (area < least * (1 - SAME) || (area <= least * (1 + SAME) && t.angle < best->angle))
        *best = t;
}

ktg_status ktg_smallest_box(ktg_context *context, const ktg_vec2 *points, size_t point_count,
                            double *rotation, ktg_vec2 *low, ktg_vec2 *size) {
    ktg_vec2 *hull;
    size_t count;
    KTG_TRY(ktg_hull(context, points, point_count, &hull, &count));
    turned best = {0, {0, 0}, {INFINITY, INFINITY}};
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 side = ktg_sub2(hull[i + 1 == count ? 0 : i + 1], hull[i]);
        keep_smaller(&best, turn(hull, count, flush_angle(side)));
    }
    *rotation = best.angle;
    *low = best.low;
    *size = best.size;
    ktg_free(hull);
    return KTG_OK;
}

/* ---- the best fit ------------------------------------------------------------------------- */

typedef struct best_fit {
    const ktg_vec2 *hull;
    size_t count;
    ktg_vec2 room;
    turned turned;
    double magnification;
} best_fit;

static void consider(best_fit *fit, double angle) {
    turned t = turn(fit->hull, fit->count, angle);
    double x = t.size.x > 0 ? fit->room.x / t.size.x : INFINITY;
    double y = t.size.y > 0 ? fit->room.y / t.size.y : INFINITY;
    double magnification = fmin(x, y), best = fit->magnification;
    if (magnification > best * (1 + SAME) ||
        (magnification >= best * (1 - SAME) && angle < fit->turned.angle)) {
        fit->turned = t;
        fit->magnification = magnification;
    }
}

/* The diagonals (right - left corner, top - bottom corner) that span the box at this angle. */
static void spans(const best_fit *fit, double angle, ktg_vec2 *across, ktg_vec2 *up) {
    double c = cos(angle), s = sin(angle);
    ktg_vec2 reach[4] = {{c, -s}, {-c, s}, {s, c}, {-s, -c}};
    ktg_vec2 corner[4];
    for (int k = 0; k < 4; k++) {
        double far = -INFINITY;
        for (size_t i = 0; i < fit->count; i++) {
            double d = ktg_dot2(reach[k], fit->hull[i]);
            if (d > far) {
                far = d;
                corner[k] = fit->hull[i];
            }
        }
    }
    *across = ktg_sub2(corner[0], corner[1]);
    *up = ktg_sub2(corner[2], corner[3]);
}

/* Between two flush angles: width = across . (c, -s), height = up . (s, c); both ratios are equal
 * where H width - W height = c (H across.x - W up.y) - s (H across.y + W up.x) is 0. */
static void consider_between(best_fit *fit, double from, double to) {
    ktg_vec2 across, up;
    spans(fit, (from + to) / 2, &across, &up);
    double a = fit->room.y * across.x - fit->room.x * up.y;
    double b = fit->room.y * across.y + fit->room.x * up.x;
    if (a == 0 && b == 0)
        return;
    double angle = atan2(a, b);
    angle -= floor((angle - from) / KTG_PI) * KTG_PI;
    if (angle > from && angle < to)
        consider(fit, angle);
}

static int by_angle(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Every flush angle in [0, pi) in order, and the angles between. */
static ktg_status consider_all(ktg_context *context, best_fit *fit) {
    double *angles = ktg_new(context, 2 * fit->count + 1, double);
    if (!angles)
        return KTG_MEMORY;
    size_t n = 2 * fit->count;
    for (size_t i = 0; i < fit->count; i++) {
        ktg_vec2 side = ktg_sub2(fit->hull[i + 1 == fit->count ? 0 : i + 1], fit->hull[i]);
        angles[2 * i] = flush_angle(side);
        angles[2 * i + 1] = angles[2 * i] + KTG_PI / 2;
    }
    qsort(angles, n, sizeof *angles, by_angle);
    angles[n] = angles[0] + KTG_PI;
    for (size_t i = 0; i < n; i++) {
        consider(fit, angles[i]);
        if (angles[i + 1] > angles[i])
            consider_between(fit, angles[i], angles[i + 1]);
    }
    ktg_free(angles);
    return KTG_OK;
}

ktg_status ktg_best_fit(ktg_context *context, const ktg_vec2 *points, size_t point_count,
                        double width, double height, double *rotation, ktg_vec2 *low,
                        double *magnification) {
    ktg_vec2 *hull;
    if (!(width > 0) || !(height > 0))
        return ktg_fail(context, KTG_ARGUMENT, "nothing fits a rectangle of %g x %g", width,
                        height);
    best_fit fit = {.room = {width, height}};
    KTG_TRY(ktg_hull(context, points, point_count, &hull, &fit.count));
    fit.hull = hull;
    ktg_status status = consider_all(context, &fit);
    *rotation = fit.turned.angle;
    *low = fit.turned.low;
    *magnification = fit.magnification;
    ktg_free(hull);
    return status;
}
