/* pattern/tab_room.c - the room a tab has: a trapezoid that is cut back by obstacles. */
#include "pattern/tab_room.h"

/* A clipped obstacle: each of the four clips adds one corner at most. */
#define CLIPPED_CORNERS (KTG_OBSTACLE_CORNERS + 4)

/* Flanks flatter than this (5 degrees) are slivers no one can glue. */
#define FLATTEST_COT 11.43

/* A top narrower than this is a point, in parts of the height. */
#define POINTED 0.01

static double base_of(const ktg_trapezoid *t) {
    return t->right - t->left;
}

static double top_of(const ktg_trapezoid *t) {
    return base_of(t) - t->height * (t->left_cot + t->right_cot);
}

ktg_trapezoid ktg_trapezoid_wished(double length, double height, double cot, double inset) {
    ktg_trapezoid tab = {inset, length - inset, cot, cot, height};
    tab.height = ktg_min(height, base_of(&tab) / (2 * cot));
    return tab;
}

uint32_t ktg_trapezoid_corners(const ktg_trapezoid *t, ktg_vec2 corners[4]) {
    double left = t->left + t->left_cot * t->height, right = t->right - t->right_cot * t->height;
    corners[0] = (ktg_vec2){t->left, 0};
    corners[1] = (ktg_vec2){t->right, 0};
    if (right - left < POINTED * t->height) {
        corners[2] = (ktg_vec2){(left + right) / 2, t->height};
        return 3;
    }
    corners[2] = (ktg_vec2){right, t->height};
    corners[3] = (ktg_vec2){left, t->height};
    return 4;
}

/* A hair is allowed for rounding, so that what was made full is called full. */
#define HAIR 1e-9

bool ktg_trapezoid_is_full(const ktg_trapezoid *t, const ktg_tab_wish *wish) {
    return base_of(t) >= (KTG_TAB_COVER_FULL - HAIR) * wish->length &&
           t->height >= (1 - HAIR) * wish->height && ktg_trapezoid_is_tab(t, wish);
}

bool ktg_trapezoid_is_tab(const ktg_trapezoid *t, const ktg_tab_wish *wish) {
    return base_of(t) >= (KTG_TAB_COVER_LEAST - HAIR) * wish->length &&
           t->height >= (1 - HAIR) * wish->least;
}

double ktg_trapezoid_value(const ktg_trapezoid *t, const ktg_tab_wish *wish) {
    double base = base_of(t);
    if (!(base > 0) || !(t->height > 0))
        return 0;
    double high = ktg_min(1, t->height / wish->height);
    double wide = ktg_min(1, base / (KTG_TAB_COVER_FULL * wish->length));
    double area = t->height * (base + top_of(t)) / (2 * wish->length * wish->height);
    double value = 0.4 * high * wide + 0.1 * area;
    if (!ktg_trapezoid_is_tab(t, wish))
        return value;
    return value + (ktg_trapezoid_is_full(t, wish) ? 2 : 1);
}

/* ---- clipping ----------------------------------------------------------------------------- */

/* The half-plane offset + x * p.x + y * p.y > 0. */
typedef struct half_plane {
    double offset, x, y;
} half_plane;

static double depth_in(const half_plane *h, ktg_vec2 p) {
    return h->offset + h->x * p.x + h->y * p.y;
}

/* Sutherland and Hodgman; a segment counts as a polygon of two corners. */
static uint32_t clip(const ktg_vec2 *from, uint32_t count, const half_plane *h, ktg_vec2 *to) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        ktg_vec2 a = from[i], b = from[i + 1 == count ? 0 : i + 1];
        double da = depth_in(h, a), db = depth_in(h, b);
        bool last_of_segment = count == 2 && i == 1;
        if (da > 0)
            to[kept++] = a;
        if ((da > 0) != (db > 0) && !last_of_segment) {
            double s = da / (da - db);
            to[kept++] = (ktg_vec2){a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)};
        }
    }
    /* A segment entered from outside has its crossing first: two corners again either way. */
    return kept;
}

/* The part of the obstacle nearer than `clearance` to the trapezoid, with mitred corners and
 * without what lies below the edge: 0 corners means that the trapezoid is clear. */
static uint32_t part_in_the_way(const ktg_trapezoid *t, const ktg_vec2 *obstacle, uint32_t count,
                                double clearance, ktg_vec2 *part) {
    double near = clearance * (1 - HAIR);
    half_plane sides[4] = {
        {1e-3 * clearance, 0, 1},
        {t->height + near, 0, -1},
        {near * sqrt(1 + t->left_cot * t->left_cot) - t->left, 1, -t->left_cot},
        {near * sqrt(1 + t->right_cot * t->right_cot) + t->right, -1, -t->right_cot}};
    for (int k = 0; k < 4; k++) { /* most obstacles are beyond one side */
        bool beyond = true;
        for (uint32_t i = 0; i < count && beyond; i++)
            beyond = depth_in(&sides[k], obstacle[i]) <= 0;
        if (beyond)
            return 0;
    }
    ktg_vec2 other[CLIPPED_CORNERS];
    count = clip(obstacle, count, &sides[0], other);
    count = clip(other, count, &sides[1], part);
    count = clip(part, count, &sides[2], other);
    return clip(other, count, &sides[3], part);
}

bool ktg_trapezoid_meets(const ktg_trapezoid *t, const ktg_vec2 *obstacle, uint32_t corner_count,
                         double clearance) {
    ktg_vec2 part[CLIPPED_CORNERS];
    return part_in_the_way(t, obstacle, corner_count, clearance, part) > 0;
}

static double distance_to_segment(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 ab = ktg_sub2(b, a), ap = ktg_sub2(p, a);
    double length = ktg_dot2(ab, ab), s = length > 0 ? ktg_dot2(ap, ab) / length : 0;
    return ktg_length2(ktg_madd2(ap, -ktg_max(0, ktg_min(1, s)), ab));
}

/* The distance of the part to the trapezoid when no corner of either lies in the other. */
static double distance_outside(const ktg_trapezoid *t, const ktg_vec2 *part, uint32_t count) {
    ktg_vec2 corners[4];
    uint32_t own = ktg_trapezoid_corners(t, corners);
    double nearest = INFINITY;
    for (uint32_t i = 0; i < own; i++)
        for (uint32_t k = 0; k < count; k++) {
            ktg_vec2 a = corners[i], b = corners[i + 1 == own ? 0 : i + 1];
            ktg_vec2 p = part[k], q = part[k + 1 == count ? 0 : k + 1];
            nearest = ktg_min(nearest, distance_to_segment(p, a, b));
            nearest = ktg_min(nearest, distance_to_segment(a, p, q));
        }
    return nearest;
}

/* True when some side of the trapezoid's true outline separates it from the part, so that
 * distance_outside tells the distance. */
static bool is_outside(const ktg_trapezoid *t, const ktg_vec2 *part, uint32_t count) {
    half_plane sides[3] = {
        {t->height, 0, -1}, {-t->left, 1, -t->left_cot}, {t->right, -1, -t->right_cot}};
    for (int k = 0; k < 3; k++) {
        bool beyond = true;
        for (uint32_t i = 0; i < count && beyond; i++)
            beyond = depth_in(&sides[k], part[i]) <= 0;
        if (beyond)
            return true;
    }
    return false;
}

static bool is_clear(const ktg_trapezoid *t, const ktg_vec2 *part, uint32_t count,
                     double clearance) {
    return is_outside(t, part, count) && distance_outside(t, part, count) >= clearance * (1 - HAIR);
}

bool ktg_trapezoid_is_clear(const ktg_trapezoid *t, const ktg_vec2 *obstacle, uint32_t corner_count,
                            double clearance) {
    ktg_vec2 part[CLIPPED_CORNERS];
    uint32_t count = part_in_the_way(t, obstacle, corner_count, clearance, part);
    return count == 0 || is_clear(t, part, count, clearance);
}

bool ktg_trapezoid_is_gluable(const ktg_trapezoid *t) {
    return t->left_cot <= FLATTEST_COT && t->right_cot <= FLATTEST_COT;
}

/* ---- cutting back ------------------------------------------------------------------------- */

static ktg_trapezoid mirrored(const ktg_trapezoid *t) {
    return (ktg_trapezoid){-t->right, -t->left, t->right_cot, t->left_cot, t->height};
}

/* Keeps the better of *best and t with its height brought down to where its flanks meet. */
static void offer(ktg_trapezoid *best, double *best_value, ktg_trapezoid t,
                  const ktg_tab_wish *wish, bool mirror) {
    double cots = t.left_cot + t.right_cot;
    if (cots * t.height > base_of(&t))
        t.height = base_of(&t) / cots;
    double value = ktg_trapezoid_value(&t, wish);
    if (!(value > *best_value))
        return;
    *best_value = value;
    *best = mirror ? mirrored(&t) : t;
}

/* The cotangent of the steepest line from (left, 0) that leaves all points on its left, `clearance`
 * away; infinite when a point is too near to (left, 0) itself. */
static double leaning_cot(double left, const ktg_vec2 *part, uint32_t count, double clearance) {
    double cot = 0;
    for (uint32_t i = 0; i < count; i++) {
        ktg_vec2 v = {part[i].x - left, part[i].y};
        double along = ktg_dot2(v, v) - clearance * clearance;
        if (!(along > 0))
            return INFINITY;
        along = sqrt(along); /* tangent to the circle around the point, times |v|^2 */
        ktg_vec2 d = {v.x * along + v.y * clearance, v.y * along - v.x * clearance};
        if (!(d.y > 0))
            return INFINITY;
        cot = ktg_max(cot, d.x / d.y);
    }
    return cot;
}

/* The left flank at the given slope, moved right as far as the part demands. */
static ktg_trapezoid with_left_flank(const ktg_trapezoid *t, double cot, const ktg_vec2 *part,
                                     uint32_t count, double clearance) {
    ktg_trapezoid moved = *t;
    double aside = clearance * sqrt(1 + cot * cot);
    moved.left_cot = cot;
    for (uint32_t i = 0; i < count; i++)
        moved.left = ktg_max(moved.left, part[i].x - cot * part[i].y + aside);
    return moved;
}

/* A flank is kept away from the part as if it went on below the edge, which costs the shortest tabs
 * dear: tries to stay nearer to the part, where the true distance allows it. */
static void try_nearer(const ktg_trapezoid *t, const ktg_trapezoid *moved, const ktg_tab_wish *wish,
                       const ktg_vec2 *part, uint32_t count, double clearance, bool mirror,
                       ktg_trapezoid *best, double *best_value) {
    double step = moved->left - t->left;
    for (int k = 1; k < 4 && step > 0 && step < clearance; k++) {
        ktg_trapezoid nearer = *moved;
        nearer.left = t->left + k * step / 4;
        nearer.height = ktg_min(t->height, base_of(&nearer) / (nearer.left_cot + nearer.right_cot));
        if (!is_clear(&nearer, part, count, clearance))
            continue;
        offer(best, best_value, nearer, wish, mirror);
        return;
    }
}

/* Ways past the part on its right side: the flank as steep as it is but further in; leaning from
 * where it stands; parallel to a side of the part. */
static void try_left(const ktg_trapezoid *t, const ktg_tab_wish *wish, const ktg_vec2 *part,
                     uint32_t count, double clearance, bool mirror, ktg_trapezoid *best,
                     double *best_value) {
    ktg_trapezoid moved = with_left_flank(t, t->left_cot, part, count, clearance);
    offer(best, best_value, moved, wish, mirror);
    try_nearer(t, &moved, wish, part, count, clearance, mirror, best, best_value);
    double leaning = leaning_cot(t->left, part, count, clearance);
    if (leaning > t->left_cot && leaning <= FLATTEST_COT)
        offer(best, best_value, with_left_flank(t, leaning, part, count, clearance), wish, mirror);
    for (uint32_t i = 0; i < count && count > 1; i++) {
        ktg_vec2 side = ktg_sub2(part[i + 1 == count ? 0 : i + 1], part[i]);
        double cot = side.y != 0 ? side.x / side.y : INFINITY;
        if (cot > t->left_cot && cot <= FLATTEST_COT)
            offer(best, best_value, with_left_flank(t, cot, part, count, clearance), wish, mirror);
    }
}

/* Every way past the part from the present trapezoid. */
static void try_all(const ktg_trapezoid *t, const ktg_tab_wish *wish, const ktg_vec2 *part,
                    uint32_t count, double clearance, ktg_trapezoid *best, double *best_value) {
    ktg_vec2 turned[CLIPPED_CORNERS];
    double lowest = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        turned[i] = (ktg_vec2){-part[i].x, part[i].y};
        lowest = ktg_min(lowest, part[i].y);
    }
    try_left(t, wish, part, count, clearance, false, best, best_value);
    ktg_trapezoid mirror = mirrored(t);
    try_left(&mirror, wish, turned, count, clearance, true, best, best_value);
    ktg_trapezoid lower = *t;
    lower.height = ktg_min(t->height, lowest - clearance);
    if (lower.height > 0)
        offer(best, best_value, lower, wish, false);
}

void ktg_trapezoid_cut(ktg_trapezoid *t, const ktg_tab_wish *wish, const ktg_vec2 *obstacle,
                       uint32_t corner_count, double clearance) {
    static const double heights[] = {0.8, 0.6, 0.45};
    ktg_vec2 part[CLIPPED_CORNERS];
    uint32_t count = part_in_the_way(t, obstacle, corner_count, clearance, part);
    if (count == 0 || is_clear(t, part, count, clearance))
        return;
    ktg_trapezoid best = {t->left, t->left, t->left_cot, t->right_cot, 0};
    double best_value = 0;
    try_all(t, wish, part, count, clearance, &best, &best_value);
    for (int k = 0; k < 3 && !ktg_trapezoid_is_full(&best, wish); k++) {
        ktg_trapezoid lower = *t;
        lower.height *= heights[k];
        if (lower.height < wish->least)
            break;
        count = part_in_the_way(&lower, obstacle, corner_count, clearance, part);
        if (count == 0)
            offer(&best, &best_value, lower, wish, false);
        else
            try_all(&lower, wish, part, count, clearance, &best, &best_value);
    }
    *t = best;
}
