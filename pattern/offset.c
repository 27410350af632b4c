/* pattern/offset.c - a polygon grown outwards, with mitred corners.
 *
 * Each edge sweeps a rectangle outwards and each convex corner a wedge; what is wanted is the outer
 * boundary of the polygon and all of these together. Their boundaries add up to one closed curve,
 * the raw offset, which at a concave corner runs through the corner itself: no part of it winds
 * backwards, so that its outermost walk is that boundary, wherever it crosses itself. */
#include "pattern/offset.h"

#include "core/memory.h"
#include "core/vec.h"
#include "pattern/offset_walk.h"

/* Mitres longer than this many distances are cut off at one distance from the corner. */
#define MITRE_LIMIT 2.5

/* How much the distance is changed, relative, when curves that only touch confuse the walk, and how
 * often that is tried. */
#define NUDGE  1e-5
#define NUDGES 8

typedef struct curve {
    ktg_vec2 *points; /* at most 3 per corner */
    size_t count;
} curve;

static void add_point(curve *raw, ktg_vec2 p) {
    raw->points[raw->count++] = p;
}

/* The normal outwards of a counter-clockwise polygon's edge along unit vector d. */
static ktg_vec2 outward(ktg_vec2 d) {
    return (ktg_vec2){d.y, -d.x};
}

/* A corner at `at` from direction d0 to d1 (unit vectors). */
static void add_corner(curve *raw, ktg_vec2 at, ktg_vec2 d0, ktg_vec2 d1, double distance) {
    ktg_vec2 from = ktg_madd2(at, distance, outward(d0)), to = ktg_madd2(at, distance, outward(d1));
    double turn = ktg_cross2(d0, d1), cosine = ktg_dot2(d0, d1);
    if (turn < 0 || (turn == 0 && cosine < 0)) { /* concave, or the end of a slit */
        add_point(raw, from);
        add_point(raw, at);
        add_point(raw, to);
        return;
    }
    double half_cosine = sqrt(fmax(0, (1 + cosine) / 2));
    if (half_cosine * MITRE_LIMIT >= 1) {
        ktg_vec2 n = ktg_add2(outward(d0), outward(d1));
        add_point(raw, ktg_madd2(at, distance / (1 + cosine), n));
        return;
    }
    double half_sine = sqrt((1 - cosine) / 2), along = distance * (1 - half_cosine) / half_sine;
    add_point(raw, ktg_madd2(from, along, d0));
    add_point(raw, ktg_madd2(to, -along, d1));
}

static void raw_offset(const ktg_vec2 *corners, size_t count, double distance, curve *raw) {
    raw->count = 0;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 before = corners[i ? i - 1 : count - 1], at = corners[i];
        ktg_vec2 after = corners[i + 1 == count ? 0 : i + 1];
        add_corner(raw, at, ktg_unit2(ktg_sub2(at, before)), ktg_unit2(ktg_sub2(after, at)),
                   distance);
    }
}

/* The polygon without corners that come twice in a row. */
static size_t different_corners(const ktg_vec2 *polygon, size_t count, ktg_vec2 *corners) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || polygon[i].x != corners[kept - 1].x || polygon[i].y != corners[kept - 1].y)
            corners[kept++] = polygon[i];
    while (kept > 1 && corners[0].x == corners[kept - 1].x && corners[0].y == corners[kept - 1].y)
        kept--;
    return kept;
}

static ktg_status offset(ktg_context *context, const ktg_vec2 *corners, size_t count,
                         double distance, curve *raw, ktg_vec2 **outline, size_t *outline_count) {
    for (int k = 0; k < NUDGES; k++) {
        bool simple = false;
        raw_offset(corners, count, distance * (1 + k * NUDGE), raw);
        KTG_TRY(ktg_outermost_walk(context, raw->points, raw->count, 1e-7 * distance, NULL, outline,
                                   outline_count, &simple));
        if (simple)
            return KTG_OK;
        ktg_free(*outline);
        *outline = NULL;
    }
    return ktg_fail(context, KTG_GEOMETRY, "an outline could not be moved out by %g mm", distance);
}

ktg_status ktg_offset_outward(ktg_context *context, const ktg_vec2 *polygon, size_t count,
                              double distance, ktg_vec2 **outline, size_t *outline_count) {
    ktg_vec2 *corners = ktg_new(context, count, ktg_vec2);
    curve raw = {ktg_new(context, 3 * count, ktg_vec2), 0};
    ktg_status status = corners && raw.points ? KTG_OK : KTG_MEMORY;
    *outline = NULL;
    if (status == KTG_OK) {
        size_t kept = different_corners(polygon, count, corners);
        if (!(distance > 0)) {
            *outline = corners;
            *outline_count = kept;
            corners = NULL;
        } else {
            status = offset(context, corners, kept, distance, &raw, outline, outline_count);
        }
    }
    ktg_free(corners);
    ktg_free(raw.points);
    return status;
}
