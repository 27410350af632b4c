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

#include <float.h>
#include <stdlib.h>

/* The hull between four parallels, which turn with it: the corners that touch them move on from
 * side to side (rotating calipers: Shamos 1978), so that rising angles cost O(1) each. */
typedef struct calipers {
    ktg_vec2 *hull;
    size_t count;
    size_t corner[4]; /* on the right, on the left, at the top, at the bottom */
    double *angles;   /* count: at which a side is flush, rising, below a quarter turn */
    double rounding;  /* of how far a corner lies in some direction */
} calipers;

/* A rotation, and the box around the hull turned by it. */
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

static int by_angle(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static void drop(calipers *c) {
    ktg_free(c->hull);
    ktg_free(c->angles);
}

static ktg_status hold(ktg_context *context, const ktg_vec2 *points, size_t point_count,
                       calipers *c) {
    *c = (calipers){0};
    KTG_TRY(ktg_hull(context, points, point_count, &c->hull, &c->count));
    c->angles = ktg_new(context, c->count, double);
    if (!c->angles) {
        drop(c);
        return KTG_MEMORY;
    }
    double largest = 0;
    for (size_t i = 0; i < c->count; i++)
        largest = fmax(largest, fmax(fabs(c->hull[i].x), fabs(c->hull[i].y)));
    c->rounding = 8 * DBL_EPSILON * largest;
    for (size_t i = 0; i < c->count; i++)
        c->angles[i] = flush_angle(ktg_sub2(c->hull[i + 1 == c->count ? 0 : i + 1], c->hull[i]));
    qsort(c->angles, c->count, sizeof *c->angles, by_angle);
    return KTG_OK;
}

/* From corner to corner, `step` further each time, as long as that leads farther, or would but for
 * rounding. */
static size_t climb(const calipers *c, ktg_vec2 direction, size_t corner, size_t step) {
    double far = ktg_dot2(direction, c->hull[corner]);
    size_t next = corner;
    for (size_t walked = 1; walked < c->count; walked++) {
        next = (next + step) % c->count;
        double d = ktg_dot2(direction, c->hull[next]);
        if (d < far - c->rounding)
            break;
        if (d > far) {
            far = d;
            corner = next;
        }
    }
    return corner;
}

static void turn_calipers(calipers *c, ktg_motion2 motion) {
    const ktg_vec2 ways[4] = {
        {motion.c, -motion.s}, {-motion.c, motion.s}, {motion.s, motion.c}, {-motion.s, -motion.c}};
    for (int k = 0; k < 4; k++)
        c->corner[k] = climb(c, ways[k], climb(c, ways[k], c->corner[k], 1), c->count - 1);
}

static turned turn(calipers *c, double angle) {
    ktg_motion2 motion = {cos(angle), sin(angle), {0, 0}};
    turn_calipers(c, motion);
    ktg_vec2 right = ktg_move2(motion, c->hull[c->corner[0]]),
             left = ktg_move2(motion, c->hull[c->corner[1]]),
             top = ktg_move2(motion, c->hull[c->corner[2]]),
             bottom = ktg_move2(motion, c->hull[c->corner[3]]);
    return (turned){angle, {left.x, bottom.y}, {right.x - left.x, top.y - bottom.y}};
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
    calipers c;
    KTG_TRY(hold(context, points, point_count, &c));
    turned best = {0, {0, 0}, {INFINITY, INFINITY}};
    for (size_t i = 0; i < c.count; i++)
        keep_smaller(&best, turn(&c, c.angles[i]));
    *rotation = best.angle;
    *low = best.low;
    *size = best.size;
    drop(&c);
    return KTG_OK;
}

/* ---- the best fit ------------------------------------------------------------------------- */

typedef struct best_fit {
    calipers calipers;
    ktg_vec2 room;
    turned turned;
    double magnification;
} best_fit;

static void consider(best_fit *fit, double angle) {
    turned t = turn(&fit->calipers, angle);
    double x = t.size.x > 0 ? fit->room.x / t.size.x : INFINITY;
    double y = t.size.y > 0 ? fit->room.y / t.size.y : INFINITY;
    double magnification = fmin(x, y), best = fit->magnification;
    if (magnification > best * (1 + SAME) ||
        (magnification >= best * (1 - SAME) && angle < fit->turned.angle)) {
        fit->turned = t;
        fit->magnification = magnification;
    }
}

/* Between two flush angles the same two diagonals span the box, from left to right and from bottom
 * to top: width = across . (c, -s), height = up . (s, c); both ratios are equal where
 * H width - W height = c (H across.x - W up.y) - s (H across.y + W up.x) is 0. */
static void consider_between(best_fit *fit, double from, double to) {
    calipers *c = &fit->calipers;
    double middle = (from + to) / 2;
    turn_calipers(c, (ktg_motion2){cos(middle), sin(middle), {0, 0}});
    ktg_vec2 across = ktg_sub2(c->hull[c->corner[0]], c->hull[c->corner[1]]);
    ktg_vec2 up = ktg_sub2(c->hull[c->corner[2]], c->hull[c->corner[3]]);
    double a = fit->room.y * across.x - fit->room.x * up.y;
    double b = fit->room.y * across.y + fit->room.x * up.x;
    if (a == 0 && b == 0)
        return;
    double angle = atan2(a, b);
    angle -= floor((angle - from) / KTG_PI) * KTG_PI;
    if (angle > from && angle < to)
        consider(fit, angle);
}

/* Every flush angle in [0, pi) in order, and the angles between. */
static void consider_all(best_fit *fit) {
    const calipers *c = &fit->calipers;
    for (int quarter = 0; quarter < 2; quarter++) {
        double turned_by = quarter * KTG_PI / 2;
        for (size_t i = 0; i < c->count; i++) {
            double from = turned_by + c->angles[i], to = turned_by + KTG_PI / 2 + c->angles[0];
            if (i + 1 < c->count)
                to = turned_by + c->angles[i + 1];
            consider(fit, from);
            if (to > from)
                consider_between(fit, from, to);
        }
    }
}

ktg_status ktg_best_fit(ktg_context *context, const ktg_vec2 *points, size_t point_count,
                        double width, double height, double *rotation, ktg_vec2 *low,
                        double *magnification) {
    if (!(width > 0) || !(height > 0))
        return ktg_fail(context, KTG_ARGUMENT, "nothing fits a rectangle of %g x %g", width,
                        height);
    best_fit fit = {.room = {width, height}};
    KTG_TRY(hold(context, points, point_count, &fit.calipers));
    consider_all(&fit);
    *rotation = fit.turned.angle;
    *low = fit.turned.low;
    *magnification = fit.magnification;
    drop(&fit.calipers);
    return KTG_OK;
}
