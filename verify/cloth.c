/* verify/cloth.c - what only pieces of cloth have: a cutting line that does not cross itself and
 * has the whole piece within it, notches that meet, twins that are mirror images. */
#include "core/memory.h"
#include "verify/check.h"

#include <stdlib.h>

#define SAME_MM  0.6 /* shapes that are cut by one paper */
#define NOTCH_MM 1.5 /* from where a notch is said to be */
#define REACH_MM 60  /* a mark begins so far from its seam, at most; more where cuts are wider */

/* ---- outlines ----------------------------------------------------------------------------- */

typedef struct segment {
    ktg_vec2 a, b;
    double low, high; /* of x */
} segment;

static int by_low(const void *left, const void *right) {
    const segment *a = left, *b = right;
    return (a->low > b->low) - (a->low < b->low);
}

static bool cross(const segment *s, const segment *t, double near) {
    ktg_vec2 d = ktg_sub2(s->b, s->a), e = ktg_sub2(t->b, t->a);
    double ds = ktg_length2(d), es = ktg_length2(e);
    double t0 = ktg_cross2(d, ktg_sub2(t->a, s->a)), t1 = ktg_cross2(d, ktg_sub2(t->b, s->a));
    double s0 = ktg_cross2(e, ktg_sub2(s->a, t->a)), s1 = ktg_cross2(e, ktg_sub2(s->b, t->a));
    return ((t0 > near * ds && t1 < -near * ds) || (t0 < -near * ds && t1 > near * ds)) &&
           ((s0 > near * es && s1 < -near * es) || (s0 < -near * es && s1 > near * es));
}

static ktg_status check_simple(ktg_check *check, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    size_t count = piece->outline_count;
    segment *segments = ktg_new(check->context, count, segment);
    if (!segments)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % count];
        segments[i] = (segment){a, b, fmin(a.x, b.x), fmax(a.x, b.x)};
    }
    qsort(segments, count, sizeof *segments, by_low);
    bool crossed = false;
    for (size_t i = 0; i < count && !crossed; i++)
        for (size_t k = i + 1; k < count && segments[k].low <= segments[i].high && !crossed; k++)
            crossed = cross(&segments[i], &segments[k], KTG_VERIFY_TOUCH * check->mm);
    if (crossed)
        ktg_check_problem(check, "The cutting line of piece %u crosses itself.", id + 1);
    ktg_free(segments);
    return KTG_OK;
}

static double distance_to(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 ab = ktg_sub2(b, a), ap = ktg_sub2(p, a);
    double square = ktg_dot2(ab, ab);
    double t = square > 0 ? fmax(0, fmin(1, ktg_dot2(ap, ab) / square)) : 0;
    return ktg_length2(ktg_sub2(ap, ktg_mul2(ab, t)));
}

/* Inside the outline, or at most `near` outside. */
static bool within(const ktg_pattern_piece *piece, ktg_vec2 p, double near) {
    bool inside = false;
    double nearest = INFINITY;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % piece->outline_count];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
        if (nearest > near)
            nearest = fmin(nearest, distance_to(p, a, b));
    }
    return inside || nearest <= near;
}

/* The line of half a piece on the fold; NULL where it has none. */
static const ktg_pattern_line *fold_of(const ktg_pattern_piece *piece) {
    for (size_t i = 0; i < piece->line_count; i++)
        if (piece->lines[i].kind == KTG_LINE_FOLD && piece->lines[i].point_count == 2)
            return &piece->lines[i];
    return NULL;
}

double ktg_check_on_drawn_side(const ktg_pattern_piece *piece, ktg_vec2 p) {
    const ktg_pattern_line *fold = piece->on_fold ? fold_of(piece) : NULL;
    if (!fold)
        return INFINITY;
    ktg_vec2 a = fold->points[0], along = ktg_unit2(ktg_sub2(fold->points[1], a));
    double most = 0; /* of the outline, which is on one side */
    for (size_t i = 0; i < piece->outline_count; i++) {
        double side = ktg_cross2(along, ktg_sub2(piece->outline[i], a));
        most = fabs(side) > fabs(most) ? side : most;
    }
    return (most < 0 ? -1 : 1) * ktg_cross2(along, ktg_sub2(p, a));
}

uint32_t ktg_check_drawn_face(const ktg_pattern_piece *piece, size_t place, ktg_vec2 points[4]) {
    ktg_vec2 corners[3];
    double side[3];
    uint32_t count = 0;
    for (size_t k = 0; k < 3; k++) {
        corners[k] = piece->vertices[piece->corners[3 * place + k]];
        side[k] = piece->on_fold ? ktg_check_on_drawn_side(piece, corners[k]) : INFINITY;
    }
    for (size_t k = 0; k < 3; k++) {
        size_t next = (k + 1) % 3;
        if (side[k] >= 0)
            points[count++] = corners[k];
        if ((side[k] > 0 && side[next] < 0) || (side[k] < 0 && side[next] > 0))
            points[count++] = ktg_madd2(corners[k], side[k] / (side[k] - side[next]),
                                        ktg_sub2(corners[next], corners[k]));
    }
    return count;
}

static ktg_vec2 mirrored(const ktg_pattern_line *fold, ktg_vec2 p) {
    ktg_vec2 a = fold->points[0], along = ktg_unit2(ktg_sub2(fold->points[1], a));
    ktg_vec2 v = ktg_sub2(p, a);
    return ktg_add2(a, ktg_sub2(ktg_mul2(along, 2 * ktg_dot2(v, along)), v));
}

/* Every vertex lies within the cutting line; of half a piece, it or its mirror image, roughly: what
 * was folded together was symmetric to half a millimetre. */
static void check_within(ktg_check *check, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    const ktg_pattern_line *fold = piece->on_fold ? fold_of(piece) : NULL;
    double near = fold ? SAME_MM * check->mm : KTG_VERIFY_TOUCH * check->mm;
    if (piece->on_fold && !fold) {
        ktg_check_problem(check, "Piece %u is to be cut on a fold that is not drawn.", id + 1);
        return;
    }
    for (size_t v = 0; v < piece->vertex_count; v++) {
        ktg_vec2 p = piece->vertices[v];
        if (within(piece, p, near) || (fold && within(piece, mirrored(fold, p), near)))
            continue;
        ktg_check_problem(check, "Piece %u reaches over its cutting line near (%.6g, %.6g).",
                          id + 1, p.x, p.y);
        return;
    }
}

/* ---- notches ------------------------------------------------------------------------------ */

/* A side of a seam as a way through the plane, from where side 0 begins. */
typedef struct way {
    ktg_vec2 *points;
    uint32_t count;
    double length;
} way;

static ktg_status find_way(ktg_check *check, const ktg_pattern_seam *seam, int side, way *w) {
    *w = (way){.points = ktg_new(check->context, (size_t)seam->edge_count + 1, ktg_vec2)};
    if (!w->points)
        return KTG_MEMORY;
    for (uint32_t k = 0; k < seam->edge_count; k++) {
        const ktg_pattern_edge *edge = &check->pattern->edges[seam->edges[k]];
        uint32_t h = ktg_check_halfedge(&edge->sides[seam->first_side[k] ^ side]);
        ktg_vec2 from = side ? ktg_check_end2(check, h) : ktg_check_start2(check, h);
        ktg_vec2 to = side ? ktg_check_start2(check, h) : ktg_check_end2(check, h);
        if (k == 0)
            w->points[w->count++] = from;
        w->points[w->count++] = to;
        w->length += ktg_check_distance2(from, to);
    }
    return KTG_OK;
}

static ktg_vec2 point_at(const way *w, double at) {
    for (uint32_t k = 1; k < w->count; k++) {
        double length = ktg_check_distance2(w->points[k - 1], w->points[k]);
        if (at <= length || k + 1 == w->count)
            return ktg_madd2(w->points[k - 1], at,
                             ktg_unit2(ktg_sub2(w->points[k], w->points[k - 1])));
        at -= length;
    }
    return w->points[0];
}

typedef struct extent {
    ktg_vec2 low, high;
} extent;

static extent extent_of(const ktg_vec2 *points, size_t count) {
    extent e = {points[0], points[0]};
    for (size_t k = 1; k < count; k++) {
        e.low = (ktg_vec2){fmin(e.low.x, points[k].x), fmin(e.low.y, points[k].y)};
        e.high = (ktg_vec2){fmax(e.high.x, points[k].x), fmax(e.high.y, points[k].y)};
    }
    return e;
}

/* How far the marks of a piece may begin from their seams: its cutting line reaches over its border
 * by about the allowance. */
static double reach_of(const ktg_check *check, const ktg_pattern_piece *piece) {
    extent sewn = extent_of(piece->vertices, piece->vertex_count);
    extent cut = extent_of(piece->outline, piece->outline_count);
    double wide = fmax(fmax(sewn.low.x - cut.low.x, sewn.low.y - cut.low.y),
                       fmax(cut.high.x - sewn.high.x, cut.high.y - sewn.high.y));
    return fmax(REACH_MM * check->mm, 1.5 * wide);
}

/* A mark of the piece that points at p from the cut, or from it into the piece. */
static bool has_mark(const ktg_check *check, const ktg_pattern_piece *piece, ktg_vec2 p) {
    double reach = reach_of(check, piece);
    for (size_t i = 0; i < piece->line_count; i++) {
        const ktg_pattern_line *line = &piece->lines[i];
        if (line->kind != KTG_LINE_NOTCH || line->point_count != 2)
            continue;
        ktg_vec2 in = ktg_unit2(ktg_sub2(line->points[1], line->points[0]));
        ktg_vec2 end = ktg_madd2(line->points[0], reach, in);
        if (distance_to(p, line->points[0], end) <= NOTCH_MM * check->mm)
            return true;
    }
    return false;
}

/* All marks of a notch are on the piece, unless they are in the half of it that is not drawn. */
static void check_notch(ktg_check *check, uint32_t s, size_t i, int side, const way *w) {
    const ktg_pattern_seam *seam = &check->pattern->seams[s];
    const ktg_pattern_notch *notch = &seam->notches[i];
    const ktg_pattern_piece *piece = &check->pattern->pieces[seam->pieces[side]];
    for (uint32_t m = 0; m < notch->marks && notch->marks <= 3; m++) {
        double aside = (m - (notch->marks - 1) / 2.0) * KTG_VERIFY_MARKS * check->mm;
        double at = fmax(0, fmin(w->length, notch->at * w->length + aside));
        ktg_vec2 p = point_at(w, at);
        if ((piece->on_fold && !within(piece, p, 0)) || has_mark(check, piece, p))
            continue;
        ktg_check_problem(check,
                          "Seam %u has no mark in piece %u at %.6g mm, where it has a notch.",
                          s + 1, seam->pieces[side] + 1, at);
    }
    if (!(notch->at >= 0 && notch->at <= 1) || notch->marks < 1 || notch->marks > 3)
        ktg_check_problem(check, "Notch %zu of seam %u makes no sense.", i + 1, s + 1);
}

static ktg_status check_notches(ktg_check *check, uint32_t s) {
    const ktg_pattern_seam *seam = &check->pattern->seams[s];
    for (int side = 0; side < 2 && seam->notch_count > 0; side++) {
        way w;
        ktg_status status = find_way(check, seam, side, &w);
        for (size_t i = 0; status == KTG_OK && i < seam->notch_count; i++)
            check_notch(check, s, i, side, &w);
        ktg_free(w.points);
        KTG_TRY(status);
    }
    return KTG_OK;
}

/* ---- twins -------------------------------------------------------------------------------- */

static const ktg_pattern_line *sewing_line(const ktg_pattern_piece *piece) {
    for (size_t i = 0; i < piece->line_count; i++)
        if (piece->lines[i].kind == KTG_LINE_SEW && piece->lines[i].point_count > 1)
            return &piece->lines[i];
    return NULL;
}

static double distance_to_line(ktg_vec2 p, const ktg_pattern_line *line) {
    double nearest = INFINITY;
    for (size_t k = 1; k < line->point_count; k++)
        nearest = fmin(nearest, distance_to(p, line->points[k - 1], line->points[k]));
    return nearest;
}

/* Box on box, mirrored across an upright line or not, the way there being the way back. */
static ktg_vec2 onto(ktg_vec2 p, extent from, extent to, bool mirror) {
    ktg_vec2 v = ktg_sub2(p, from.low);
    return (ktg_vec2){mirror ? to.high.x - v.x : to.low.x + v.x, to.low.y + v.y};
}

/* The sewing line of a piece, laid on another one, lies on that one's. */
static bool lies_on(const ktg_check *check, const ktg_pattern_piece *a, const ktg_pattern_piece *b,
                    bool mirror) {
    const ktg_pattern_line *from = sewing_line(a), *to = sewing_line(b);
    extent ea = extent_of(a->vertices, a->vertex_count),
           eb = extent_of(b->vertices, b->vertex_count);
    for (size_t i = 0; i < from->point_count; i++) {
        ktg_vec2 p = onto(from->points[i], ea, eb, mirror);
        if (distance_to_line(p, to) > 2 * SAME_MM * check->mm)
            return false;
    }
    return true;
}

/* Half a piece has half a line only, to be looked for on the whole one. */
static bool are_alike(const ktg_check *check, const ktg_pattern_piece *drawn,
                      const ktg_pattern_piece *twin, bool mirror) {
    return sewing_line(drawn) && sewing_line(twin) && lies_on(check, drawn, twin, mirror) &&
           (drawn->on_fold || lies_on(check, twin, drawn, mirror));
}

static void check_twin(ktg_check *check, uint32_t id, uint64_t *twins) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    if (piece->twin_of >= check->pattern->piece_count || piece->twin_of == id ||
        check->pattern->pieces[piece->twin_of].cut_count == 0) {
        ktg_check_problem(check, "Piece %u is cut with a piece that is not cut.", id + 1);
        return;
    }
    const ktg_pattern_piece *other = &check->pattern->pieces[piece->twin_of];
    twins[piece->twin_of]++;
    if (!are_alike(check, other, piece, true) && !are_alike(check, other, piece, false))
        ktg_check_problem(check, "Pieces %u and %u are cut as one, but their shapes differ.",
                          piece->twin_of + 1, id + 1);
}

static ktg_status check_twins(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    uint64_t *twins = ktg_new(check->context, p->piece_count, uint64_t);
    if (!twins)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < p->piece_count; i++)
        if (p->pieces[i].cut_count == 0)
            check_twin(check, i, twins);
    for (uint32_t i = 0; i < p->piece_count; i++) {
        uint64_t cuts = (uint64_t)p->pieces[i].cut_count + p->pieces[i].cut_mirrored;
        if (p->pieces[i].cut_count > 0 && cuts < 1 + twins[i])
            ktg_check_problem(check, "Piece %u is cut less often than it has twins.", i + 1);
    }
    ktg_free(twins);
    return KTG_OK;
}

/* ---- all ---------------------------------------------------------------------------------- */

ktg_status ktg_check_cloth(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    uint32_t before = check->report->problem_count;
    for (uint32_t i = 0; i < p->piece_count; i++) {
        if (p->pieces[i].outline_count < 3)
            continue; /* told already */
        KTG_TRY(ktg_check_cancel(check->context));
        KTG_TRY(check_simple(check, i));
        check_within(check, i);
    }
    if (check->report->problem_count > before)
        return KTG_OK;
    for (uint32_t s = 0; s < p->seam_count; s++)
        KTG_TRY(check_notches(check, s));
    return check_twins(check);
}
