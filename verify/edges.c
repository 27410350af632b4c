/* verify/edges.c - each edge of the surface exactly once, with the sides, kind and angle that the
 * surface itself gives it, and the lengths of all pieces' edges. */
#include "core/memory.h"
#include "verify/check.h"

#include <float.h>
#include <string.h>

#define COINCIDE 5e-11 /* of the shortest edge there: two copies of a cut that are one line */
#define ROUNDING 5e-15 /* of the piece's reach: what stored coordinates may be off */

static const char *kind_name(ktg_edge_kind kind) {
    static const char *const names[] = {"cut", "mountain fold", "valley fold", "flat fold",
                                        "border"};
    return names[kind];
}

/* ---- which half-edges an edge claims ------------------------------------------------------ */

static void claim_side(ktg_check *check, uint32_t edge, const ktg_pattern_side *side) {
    uint32_t h = ktg_check_halfedge(side);
    if (check->face_piece[side->face] != side->piece)
        ktg_check_problem(check,
                          "Edge %u: its side on face %u is said to be in piece %u, but that "
                          "face is in piece %u.",
                          edge + 1, side->face, side->piece + 1, check->face_piece[side->face] + 1);
    if (check->edge_at[h] != KTG_NONE)
        ktg_check_problem(check, "Edge %u: corner %u of face %u belongs to edge %u already.",
                          edge + 1, side->corner, side->face, check->edge_at[h] + 1);
    else
        check->edge_at[h] = edge;
}

static void claim_edge(ktg_check *check, uint32_t i) {
    const ktg_pattern_edge *edge = &check->pattern->edges[i];
    uint32_t h = ktg_check_halfedge(&edge->sides[0]);
    for (uint32_t s = 0; s < edge->side_count; s++)
        claim_side(check, i, &edge->sides[s]);
    if (edge->vertices[0] != ktg_check_start(check, h) ||
        edge->vertices[1] != ktg_check_start(check, ktg_check_next(h)))
        ktg_check_problem(check,
                          "Edge %u is said to join vertices %u and %u, but its first side "
                          "runs from %u to %u.",
                          i + 1, edge->vertices[0], edge->vertices[1], ktg_check_start(check, h),
                          ktg_check_start(check, ktg_check_next(h)));
    if (edge->side_count == 1 && check->twin[h] != KTG_NONE)
        ktg_check_problem(check,
                          "Edge %u has one side (face %u), but face %u of the surface is on "
                          "its other side.",
                          i + 1, h / 3, check->twin[h] / 3);
    if (edge->side_count == 2 && check->twin[h] != ktg_check_halfedge(&edge->sides[1]))
        ktg_check_problem(check, "Edge %u: faces %u and %u do not meet there on the surface.",
                          i + 1, edge->sides[0].face, edge->sides[1].face);
}

static void check_complete(ktg_check *check) {
    for (uint32_t h = 0; h < 3 * check->pattern->face_count; h++)
        if (check->edge_at[h] == KTG_NONE)
            ktg_check_problem(check,
                              "The edge at corner %u of face %u (vertices %u and %u) is "
                              "missing from the list of edges.",
                              h % 3, h / 3, ktg_check_start(check, h),
                              ktg_check_start(check, ktg_check_next(h)));
}

/* ---- kinds and angles --------------------------------------------------------------------- */

/* Signed turn between the outward normals on both sides of h, positive where they part. */
static double dihedral(const ktg_check *check, uint32_t h, uint32_t m) {
    ktg_vec3 along = ktg_unit3(ktg_sub3(ktg_check_end3(check, h), ktg_check_start3(check, h)));
    ktg_vec3 a = ktg_check_normal(check, h / 3), b = ktg_check_normal(check, m / 3);
    return atan2(ktg_dot3(ktg_cross3(a, b), along), ktg_dot3(a, b));
}

/* How well the angle is defined at all: rounding of coordinates tilts a face of width w by about
 * eps reach / w. */
static double angle_noise(const ktg_check *check, uint32_t h, uint32_t m) {
    double narrow = fmin(check->width[h / 3], check->width[m / 3]);
    return narrow > 0 ? 64 * DBL_EPSILON * check->reach3 / narrow : INFINITY;
}

static void check_fold_kind(ktg_check *check, uint32_t i, double angle, double noise) {
    ktg_edge_kind kind = check->pattern->edges[i].kind;
    double slack = KTG_VERIFY_ANGLE + noise;
    bool either = fabs(angle) >= KTG_PI - KTG_VERIFY_ANGLE - noise; /* folded back: no sign */
    bool flat = fabs(angle) <= KTG_VERIFY_FLAT + slack;
    bool mountain = either || angle >= KTG_VERIFY_FLAT - slack;
    bool valley = either || angle <= slack - KTG_VERIFY_FLAT;
    if (kind == KTG_EDGE_FLAT ? flat : kind == KTG_EDGE_MOUNTAIN ? mountain : valley)
        return;
    ktg_check_problem(check, "Edge %u is called a %s, but it turns by %.6g degrees: a %s.", i + 1,
                      kind_name(kind), angle * 180 / KTG_PI,
                      kind_name(flat         ? KTG_EDGE_FLAT
                                : angle >= 0 ? KTG_EDGE_MOUNTAIN
                                             : KTG_EDGE_VALLEY));
}

static void check_angle(ktg_check *check, uint32_t i, double angle, double noise) {
    double stated = check->pattern->edges[i].angle;
    double wrong = fabs(remainder(stated - angle, 2 * KTG_PI));
    if (!(wrong <= KTG_VERIFY_ANGLE + noise))
        ktg_check_problem(check, "Edge %u is said to turn by %.9g degrees, but it turns by %.9g.",
                          i + 1, stated * 180 / KTG_PI, angle * 180 / KTG_PI);
}

static double shortest_edge(const ktg_check *check, uint32_t face) {
    double shortest = INFINITY;
    for (uint32_t h = 3 * face; h < 3 * face + 3; h++)
        shortest = fmin(shortest,
                        ktg_check_distance3(ktg_check_start3(check, h), ktg_check_end3(check, h)));
    return shortest;
}

/* A cut at whose end the border turns straight back, and whose two copies are one line, is no cut:
 * joining them leaves the outline one closed walk. Only copies so near that joining them keeps all
 * lengths count: further apart the vertex is not flat, and the cut is needed. */
static bool is_no_cut(const ktg_check *check, uint32_t h, uint32_t m) {
    uint32_t piece = check->face_piece[h / 3];
    if (piece != check->face_piece[m / 3] ||
        (ktg_check_next_border(check, h) != m && ktg_check_next_border(check, m) != h))
        return false;
    double shortest = fmin(shortest_edge(check, h / 3), shortest_edge(check, m / 3));
    double near = fmax(COINCIDE * shortest, ROUNDING * check->reach2[piece]);
    return ktg_check_distance2(ktg_check_start2(check, h), ktg_check_end2(check, m)) <= near &&
           ktg_check_distance2(ktg_check_end2(check, h), ktg_check_start2(check, m)) <= near;
}

static void check_cut(ktg_check *check, uint32_t i, uint32_t h, uint32_t m) {
    if (check->fold[h])
        ktg_check_problem(check,
                          "Edge %u is called a cut, but its sides share both vertices of "
                          "piece %u: a fold.",
                          i + 1, check->face_piece[h / 3] + 1);
    else if (check->pattern->mode == KTG_PAPER && !check->pattern->edges[i].forced &&
             is_no_cut(check, h, m))
        ktg_check_problem(check,
                          "Edge %u is called a cut, but its two copies in piece %u coincide "
                          "along their whole length: it should be a fold.",
                          i + 1, check->face_piece[h / 3] + 1);
}

static void check_border(ktg_check *check, uint32_t i) {
    const ktg_pattern_edge *edge = &check->pattern->edges[i];
    if (edge->kind != KTG_EDGE_BORDER)
        ktg_check_problem(check,
                          "Edge %u is called a %s, but the surface has one face there: a "
                          "border.",
                          i + 1, kind_name(edge->kind));
    else if (edge->angle != 0)
        ktg_check_problem(check, "Edge %u is a border, but it is said to turn by %.9g degrees.",
                          i + 1, edge->angle * 180 / KTG_PI);
}

static void check_kind(ktg_check *check, uint32_t i) {
    const ktg_pattern_edge *edge = &check->pattern->edges[i];
    uint32_t h = ktg_check_halfedge(&edge->sides[0]), m = check->twin[h];
    bool paper = check->pattern->mode == KTG_PAPER;
    if (m == KTG_NONE) {
        check_border(check, i);
        return;
    }
    double angle = dihedral(check, h, m), noise = angle_noise(check, h, m);
    if (edge->kind == KTG_EDGE_BORDER)
        ktg_check_problem(check,
                          "Edge %u is called a border, but the surface has faces %u and %u "
                          "there: a cut or a fold.",
                          i + 1, h / 3, m / 3);
    else if (edge->kind == KTG_EDGE_CUT)
        check_cut(check, i, h, m);
    else if (!check->fold[h])
        ktg_check_problem(check,
                          "Edge %u is called a %s, but its sides do not lie in one piece and "
                          "share both vertices: a cut.",
                          i + 1, kind_name(edge->kind));
    else if (paper)
        check_fold_kind(check, i, angle, noise);
    if (paper)
        check_angle(check, i, angle, noise);
}

ktg_status ktg_check_edges(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    memset(check->edge_at, 0xff, 3 * (size_t)p->face_count * sizeof *check->edge_at);
    for (uint32_t i = 0; i < p->edge_count; i++)
        claim_edge(check, i);
    check_complete(check);
    for (uint32_t i = 0; i < p->edge_count; i++)
        check_kind(check, i);
    return KTG_OK;
}

/* ---- lengths ------------------------------------------------------------------------------ */

static void check_length(ktg_check *check, uint32_t h) {
    uint32_t piece = check->face_piece[h / 3];
    double flat = ktg_check_distance2(ktg_check_start2(check, h), ktg_check_end2(check, h));
    double solid = ktg_check_distance3(ktg_check_start3(check, h), ktg_check_end3(check, h));
    double least = KTG_VERIFY_SHORT * fmax(check->reach2[piece], check->reach3);
    double error = fabs(flat - solid) / fmax(solid, least);
    check->report->length_error = fmax(check->report->length_error, error);
    if (!(error <= KTG_VERIFY_LENGTH))
        ktg_check_problem(check,
                          "The edge at corner %u of face %u in piece %u is %.12g long, but "
                          "%.12g on the surface.",
                          h % 3, h / 3, piece + 1, flat, solid);
}

/* Cloth: the two sides of a cut are sewn together. */
static void check_sewn(ktg_check *check, uint32_t h) {
    uint32_t m = check->twin[h];
    if (m == KTG_NONE || m < h || check->fold[h])
        return;
    double a = ktg_check_distance2(ktg_check_start2(check, h), ktg_check_end2(check, h));
    double b = ktg_check_distance2(ktg_check_start2(check, m), ktg_check_end2(check, m));
    double error = fabs(a - b) / fmax(fmax(a, b), KTG_VERIFY_SEWN * check->reach3);
    if (!(error <= KTG_VERIFY_EASE))
        ktg_check_problem(check,
                          "The cut between faces %u and %u is %.6g long on one side, but "
                          "%.6g on the other.",
                          h / 3, m / 3, a, b);
}

void ktg_check_lengths(ktg_check *check) {
    for (uint32_t h = 0; h < 3 * check->pattern->face_count; h++)
        if (check->pattern->mode == KTG_PAPER)
            check_length(check, h);
        else
            check_sewn(check, h);
}
