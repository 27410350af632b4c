/* layout/nest_apart.c - the proof that two polygons lie apart. It shares no code with the search.
 *
 * Sides that cross properly mean an overlap. Without such a crossing each side of one polygon is
 * cut by the corners of the other that lie on it into parts that are inside the other, outside, or
 * on its boundary; a part inside means an overlap, and so does one on the boundary where both
 * interiors are on the same side of it. All of it is decided with exact predicates. */
#include "layout/nest.h"

#include "core/predicate.h"
#include "core/vec.h"

typedef struct polygon {
    const ktg_vec2 *points;
    size_t count;
    double turn; /* +1 counter-clockwise, -1 clockwise */
    ktg_vec2 low, high;
} polygon;

static polygon polygon_of(const ktg_vec2 *points, size_t count) {
    polygon p = {points, count, 1, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    double twice = 0;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 a = points[i], b = points[i + 1 == count ? 0 : i + 1];
        twice += ktg_cross2(ktg_sub2(a, points[0]), ktg_sub2(b, points[0]));
        p.low = (ktg_vec2){fmin(p.low.x, a.x), fmin(p.low.y, a.y)};
        p.high = (ktg_vec2){fmax(p.high.x, a.x), fmax(p.high.y, a.y)};
    }
    p.turn = twice < 0 ? -1 : 1;
    return p;
}

static ktg_vec2 start_of(const polygon *p, size_t side) {
    return p->points[side];
}

static ktg_vec2 end_of(const polygon *p, size_t side) {
    return p->points[side + 1 == p->count ? 0 : side + 1];
}

static bool same(ktg_vec2 a, ktg_vec2 b) {
    return a.x == b.x && a.y == b.y;
}

/* The side's box, grown by `by`, meets the other polygon's. */
static bool is_near(const polygon *p, size_t side, const polygon *other, double by) {
    ktg_vec2 a = start_of(p, side), b = end_of(p, side);
    return fmin(a.x, b.x) - by <= other->high.x && fmax(a.x, b.x) + by >= other->low.x &&
           fmin(a.y, b.y) - by <= other->high.y && fmax(a.y, b.y) + by >= other->low.y;
}

static bool boxes_near(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d, double by) {
    return fmin(a.x, b.x) - by <= fmax(c.x, d.x) && fmax(a.x, b.x) + by >= fmin(c.x, d.x) &&
           fmin(a.y, b.y) - by <= fmax(c.y, d.y) && fmax(a.y, b.y) + by >= fmin(c.y, d.y);
}

static bool cross_properly(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d) {
    return ktg_orientation2(a, b, c) * ktg_orientation2(a, b, d) < 0 &&
           ktg_orientation2(c, d, a) * ktg_orientation2(c, d, b) < 0;
}

static double point_to_side(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a), v = ktg_sub2(p, a);
    double n = ktg_dot2(d, d), t = n > 0 ? fmin(1, fmax(0, ktg_dot2(v, d) / n)) : 0;
    return ktg_length2(ktg_madd2(v, -t, d));
}

static double side_to_side(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d) {
    return fmin(fmin(point_to_side(a, c, d), point_to_side(b, c, d)),
                fmin(point_to_side(c, a, b), point_to_side(d, a, b)));
}

/* No two sides cross, or are nearer than the gap. */
static bool sides_apart(const polygon *a, const polygon *b, double gap) {
    double least = gap * (1 - 1e-9);
    for (size_t i = 0; i < a->count; i++) {
        if (!is_near(a, i, b, gap))
            continue;
        ktg_vec2 p = start_of(a, i), q = end_of(a, i);
        for (size_t k = 0; k < b->count; k++) {
            ktg_vec2 r = start_of(b, k), s = end_of(b, k);
            if (!boxes_near(p, q, r, s, gap))
                continue;
            if (cross_properly(p, q, r, s) || (gap > 0 && side_to_side(p, q, r, s) < least))
                return false;
        }
    }
    return true;
}

/* How often the polygon winds around a point that is not on its boundary. */
static int winding(const polygon *p, ktg_vec2 at) {
    int winds = 0;
    for (size_t i = 0; i < p->count; i++) {
        ktg_vec2 a = start_of(p, i), b = end_of(p, i);
        if ((a.y <= at.y) == (b.y <= at.y))
            continue;
        int turn = ktg_orientation2(a, b, at);
        if (b.y > a.y && turn > 0)
            winds++;
        else if (b.y < a.y && turn < 0)
            winds--;
    }
    return winds;
}

/* p lies on the closed segment ab. */
static bool lies_on(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    return p.x >= fmin(a.x, b.x) && p.x <= fmax(a.x, b.x) && p.y >= fmin(a.y, b.y) &&
           p.y <= fmax(a.y, b.y) && ktg_orientation2(a, b, p) == 0;
}

/* Whether the part pq of a side, free of the other's corners, lies inside the other polygon, or on
 * its boundary with the interiors on the same side. */
static bool part_overlaps(ktg_vec2 p, ktg_vec2 q, double turn, const polygon *other) {
    bool on_boundary = false;
    for (size_t k = 0; k < other->count; k++) {
        ktg_vec2 r = start_of(other, k), s = end_of(other, k);
        if (same(r, s) || !lies_on(p, r, s) || !lies_on(q, r, s))
            continue;
        on_boundary = true;
        if (ktg_dot2(ktg_sub2(q, p), ktg_sub2(s, r)) * turn * other->turn > 0)
            return true;
    }
    return !on_boundary && winding(other, ktg_mul2(ktg_add2(p, q), 0.5)) != 0;
}

/* The corner of the other polygon on the side from `from` to `end` that comes next after `from`. */
static ktg_vec2 next_corner(ktg_vec2 from, ktg_vec2 end, const polygon *other) {
    ktg_vec2 next = end;
    for (size_t k = 0; k < other->count; k++) {
        ktg_vec2 p = other->points[k];
        if (!same(p, from) && !same(p, next) && lies_on(p, from, next))
            next = p;
    }
    return next;
}

static bool boundary_stays_out(const polygon *a, const polygon *b) {
    for (size_t i = 0; i < a->count; i++) {
        if (!is_near(a, i, b, 0))
            continue;
        ktg_vec2 end = end_of(a, i);
        for (ktg_vec2 from = start_of(a, i); !same(from, end);) {
            ktg_vec2 to = next_corner(from, end, b);
            if (part_overlaps(from, to, a->turn, b))
                return false;
            from = to;
        }
    }
    return true;
}

bool ktg_nest_apart(const ktg_vec2 *a, size_t a_count, const ktg_vec2 *b, size_t b_count,
                    double gap) {
    polygon p = polygon_of(a, a_count), q = polygon_of(b, b_count);
    if (p.low.x - gap > q.high.x || q.low.x - gap > p.high.x || p.low.y - gap > q.high.y ||
        q.low.y - gap > p.high.y)
        return true;
    return sides_apart(&p, &q, gap) && boundary_stays_out(&p, &q) && boundary_stays_out(&q, &p);
}
