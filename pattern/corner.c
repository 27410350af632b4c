/* pattern/corner.c - how the cut runs around a corner of a piece of cloth. */
#include "pattern/corner.h"

#include <math.h>

/* A corner's cloth reaches no further along a seam than this many allowances. */
#define REACH 2.0

/* A strip of cloth that is too long by so little of its width is left alone. */
#define LITTLE 0.05

/* So much of the allowance is left around a corner, whatever the other piece has. */
#define ENOUGH 0.7

/* A border that turns by less than this sine goes on, with cloth along it. */
#define SMOOTH 0.7

/* A side seam is mirrored in a hem when the two meet at more than this sine. */
#define STEEP 0.8

ktg_vec2 ktg_meeting_point(ktg_vec2 a, ktg_vec2 d, ktg_vec2 b, ktg_vec2 e) {
    double turn = ktg_cross2(d, e);
    return ktg_madd2(a, ktg_cross2(ktg_sub2(b, a), e) / turn, d);
}

double ktg_corner_reach(const ktg_corner *c, int side) {
    double turn = ktg_cross2(c->along[0], c->along[1]);
    double cosine = ktg_dot2(c->along[0], c->along[1]);
    double most = REACH * fmax(c->width[0], c->width[1]);
    if (turn <= 0 || (turn < SMOOTH && cosine > 0))
        return most;
    /* from the corner along one edge to where its offset line meets the other one's */
    return fmax(0, fmin((c->width[1 - side] - c->width[side] * cosine) / turn, most));
}

static ktg_vec2 shifted(const ktg_corner *c, int side) {
    return ktg_madd2(c->at, c->width[side], ktg_outward(c->along[side]));
}

static void add(ktg_corner_path *path, ktg_vec2 p) {
    if (path->count < KTG_CORNER_POINTS)
        path->points[path->count++] = p;
}

/* Where the square end of strip `side`, from `end`, meets the cut of the other strip between that
 * strip's own end and the mitre, `most` from there; where it does not, the strip's end. */
static ktg_vec2 square_end(const ktg_corner *c, int side, ktg_vec2 end, double most) {
    ktg_vec2 other = shifted(c, 1 - side), along = c->along[1 - side];
    ktg_vec2 meeting = ktg_meeting_point(end, ktg_outward(c->along[side]), other, along);
    double beyond = ktg_dot2(ktg_sub2(meeting, other), along) * (side == 0 ? -1 : 1);
    return beyond > 0 && beyond < most ? meeting : other;
}

/* A mitre, of which each strip's end is cut square where the seam's other side has no more. */
static void go_around(const ktg_corner *c, ktg_corner_path *path) {
    ktg_vec2 a = shifted(c, 0), b = shifted(c, 1);
    ktg_vec2 mitre = ktg_meeting_point(a, c->along[0], b, c->along[1]);
    double reach[2] = {ktg_dot2(ktg_sub2(mitre, a), c->along[0]),
                       -ktg_dot2(ktg_sub2(mitre, b), c->along[1])};
    bool short0 = c->reach[0] < reach[0] - LITTLE * c->width[0];
    bool short1 = c->reach[1] < reach[1] - LITTLE * c->width[1];
    add(path, a);
    if (reach[0] > 0 && reach[1] > 0) {
        ktg_vec2 end0 = ktg_madd2(a, c->reach[0], c->along[0]);
        ktg_vec2 end1 = ktg_madd2(b, -c->reach[1], c->along[1]);
        if (short1 && !short0)
            add(path, square_end(c, 1, end1, reach[0]));
        add(path, short0 ? end0 : short1 ? end1 : mitre);
        if (short0)
            add(path, short1 ? end1 : square_end(c, 0, end0, reach[1]));
    }
    add(path, b);
}

/* Whether the cut leaves enough cloth around the corner. */
static bool keeps_away(const ktg_corner *c, const ktg_corner_path *path) {
    double least = ENOUGH * fmin(c->width[0], c->width[1]);
    for (uint32_t i = 1; i < path->count; i++)
        if (ktg_distance_to_segment(c->at, path->points[i - 1], path->points[i]) < least)
            return false;
    return true;
}

/* Cut off at one width from the corner. */
static void bevel(const ktg_corner *c, ktg_corner_path *path) {
    double cosine = ktg_dot2(c->along[0], c->along[1]);
    double half_sine = sqrt((1 - cosine) / 2), half_cosine = sqrt((1 + cosine) / 2);
    double beyond = (1 - half_cosine) / half_sine;
    ktg_vec2 a = shifted(c, 0), b = shifted(c, 1);
    path->count = 0;
    add(path, a);
    add(path, ktg_madd2(a, beyond * c->width[0], c->along[0]));
    add(path, ktg_madd2(b, -beyond * c->width[1], c->along[1]));
    add(path, b);
}

/* When the hem is turned up, its end lies on the piece: it runs as the side seam does, mirrored in
 * the hem's line. `seam` is the side that is no hem. */
static bool mirror_in_hem(const ktg_corner *c, int seam, ktg_corner_path *path) {
    ktg_vec2 out = ktg_outward(c->along[1 - seam]);
    ktg_vec2 along = ktg_mul2(c->along[seam], seam == 0 ? 1 : -1); /* towards the corner */
    double steep = ktg_dot2(along, out);
    if (steep < STEEP)
        return false;
    ktg_vec2 on_hem = ktg_meeting_point(shifted(c, seam), along, c->at, c->along[1 - seam]);
    ktg_vec2 mirrored = ktg_madd2(ktg_mul2(along, -1), 2 * steep, out);
    ktg_vec2 end = ktg_madd2(on_hem, c->width[1 - seam] / steep, mirrored);
    add(path, seam == 0 ? on_hem : end);
    add(path, seam == 0 ? end : on_hem);
    return true;
}

void ktg_corner_go(const ktg_corner *c, ktg_corner_path *path) {
    double turn = ktg_cross2(c->along[0], c->along[1]);
    double cosine = ktg_dot2(c->along[0], c->along[1]);
    path->count = 0;
    if (turn > 0 && c->hem[0] != c->hem[1] && mirror_in_hem(c, c->hem[0] ? 1 : 0, path))
        return;
    if (turn > 1e-9) {
        go_around(c, path);
        if (!keeps_away(c, path))
            bevel(c, path);
        return;
    }
    add(path, shifted(c, 0));
    if (turn < 0 || cosine < 0) /* concave, or the end of a slit */
        add(path, c->at);
    add(path, shifted(c, 1));
}

/* ---- darts -------------------------------------------------------------------------------- */

/* Folded, a dart lies on one side of its seam; its end is to meet the cut line there: that is the
 * cut line mirrored in the leg, as far as the dart's middle. */
bool ktg_dart_cap(const ktg_corner *before, const ktg_corner *after, ktg_vec2 leg_in,
                  ktg_vec2 leg_out, ktg_vec2 point, ktg_vec2 cap[3]) {
    ktg_vec2 a = before->at, b = after->at, d = before->along[0], e = after->along[1];
    ktg_vec2 middle = ktg_mul2(ktg_add2(a, b), 0.5), axis = ktg_sub2(middle, point);
    if (ktg_cross2(d, leg_in) < 0.5 || ktg_cross2(e, leg_out) < 0.5)
        return false;
    cap[0] = ktg_meeting_point(shifted(before, 0), d, a, leg_in);
    cap[2] = ktg_meeting_point(shifted(after, 1), e, b, leg_out);
    if (ktg_dot2(ktg_sub2(cap[0], a), leg_in) > 0 || ktg_dot2(ktg_sub2(cap[2], b), leg_out) > 0)
        return false;
    ktg_vec2 from_a = ktg_madd2(d, -2 * ktg_dot2(d, leg_in), leg_in);
    ktg_vec2 from_b = ktg_madd2(e, -2 * ktg_dot2(e, leg_out), leg_out);
    if (fabs(ktg_cross2(from_a, ktg_unit2(axis))) < 0.1 ||
        fabs(ktg_cross2(from_b, ktg_unit2(axis))) < 0.1)
        return false;
    cap[1] = ktg_mul2(ktg_add2(ktg_meeting_point(cap[0], from_a, point, axis),
                               ktg_meeting_point(cap[2], from_b, point, axis)),
                      0.5);
    double reach = ktg_length2(ktg_sub2(cap[1], middle));
    double wide = ktg_length2(ktg_sub2(b, a)) / 2 + 2 * fmax(before->width[0], after->width[1]);
    return reach <= wide && ktg_dot2(ktg_sub2(cap[1], middle), axis) >=
                                0.6 * fmin(before->width[0], after->width[1]) * ktg_length2(axis);
}
