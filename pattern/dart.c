/* pattern/dart.c - seams that end inside their piece, between whose sides so little is missing that
 * the cloth is folded there, not cut. */
#include "core/memory.h"
#include "pattern/cloth.h"

/* A dart opens no wider than this, in mm and in radians at its point. */
#define DART_MM    80.0
#define DART_ANGLE (60 * KTG_PI / 180)

/* Its legs are no further from straight lines than this part of their length. */
#define BENT 0.1

/* The border from one mouth of a dart over its point to the other: half-edges from..to. */
typedef struct legs {
    uint32_t from, last_down; /* the half-edge that leaves the first mouth; the one at the point */
    uint32_t to;              /* the half-edge that comes to the second mouth */
} legs;

/* True where the seam has its point inside the piece, and a mouth. */
static bool find_legs(const ktg_topology *t, const ktg_pattern *pattern,
                      const ktg_pattern_seam *seam, legs *l) {
    uint32_t last = seam->edge_count - 1;
    uint32_t first = ktg_seam_halfedge(pattern, seam, 0, 0);
    uint32_t end = ktg_seam_halfedge(pattern, seam, last, 0);
    bool at_start = ktg_border_previous(t, first) == ktg_mate(t, first);
    bool at_end = ktg_border_next(t, end) == ktg_mate(t, end);
    if (seam->pieces[0] != seam->pieces[1] || at_start == at_end)
        return false;
    *l = at_end ? (legs){first, end, ktg_mate(t, first)}
                : (legs){ktg_mate(t, end), ktg_mate(t, first), end};
    return true;
}

static bool is_narrow(const ktg_topology *t, const legs *l) {
    ktg_vec2 point = ktg_end_of(t, l->last_down);
    ktg_vec2 a = ktg_sub2(ktg_start_of(t, l->from), point);
    ktg_vec2 b = ktg_sub2(ktg_end_of(t, l->to), point);
    double angle = atan2(ktg_cross2(a, b), ktg_dot2(a, b));
    return angle > 0 && angle < DART_ANGLE && ktg_length2(ktg_sub2(b, a)) < DART_MM;
}

/* Legs that go straight from mouth to point, or nearly so, can be folded onto each other. */
static bool are_straight(const ktg_topology *t, const legs *l) {
    ktg_vec2 point = ktg_end_of(t, l->last_down);
    ktg_vec2 mouth = ktg_start_of(t, l->from), end = ktg_end_of(t, l->to);
    double least = ktg_length2(ktg_sub2(point, mouth));
    bool down = true;
    for (uint32_t h = l->from; h != l->to; h = ktg_border_next(t, h)) {
        down = down && h != l->last_down;
        double away = ktg_distance_to_segment(ktg_end_of(t, h), point, down ? mouth : end);
        if (away > BENT * least)
            return false;
    }
    return true;
}

static bool is_left_of(ktg_vec2 a, ktg_vec2 b, ktg_vec2 p) {
    return ktg_cross2(ktg_sub2(b, a), ktg_sub2(p, a)) > 0;
}

/* Nothing of the piece's border lies in the triangle of point and mouths, but the legs. */
static bool is_free(const ktg_topology *t, const legs *l) {
    ktg_vec2 a = ktg_start_of(t, l->from), b = ktg_end_of(t, l->to);
    ktg_vec2 point = ktg_end_of(t, l->last_down);
    uint32_t after = ktg_border_next(t, l->to);
    for (uint32_t h = ktg_border_next(t, after); h != l->from && after != l->from;
         h = ktg_border_next(t, h)) {
        ktg_vec2 p = ktg_start_of(t, h);
        if (is_left_of(point, a, p) && is_left_of(a, b, p) && is_left_of(b, point, p))
            return false;
    }
    return true;
}

ktg_status ktg_darts_find(ktg_context *context, const ktg_topology *t, ktg_pattern *pattern) {
    for (size_t s = 0; s < pattern->seam_count; s++) {
        legs l;
        ktg_pattern_seam *seam = &pattern->seams[s];
        seam->dart = find_legs(t, pattern, seam, &l) && is_narrow(t, &l) && are_straight(t, &l) &&
                     is_free(t, &l);
    }
    return ktg_check_cancel(context);
}
