/* pattern/notches.c - marks that meet when a seam is sewn: at the same part of both sides' length,
 * single, double or triple so that seams can be told apart. */
#include "core/memory.h"
#include "pattern/cloth.h"

/* Shorter seams need no marks. */
#define SHORT_MM 40.0
/* Marks side by side are so far apart. */
#define APART_MM 6.0
/* The most notches of one seam. */
#define MOST 24
/* A single notch is not in the middle, so that it tells the direction. */
#define OFF_MIDDLE 0.4
/* Where one seam ends and the next begins, a border that turns by less than this has a mark. */
#define SMOOTH (25 * KTG_PI / 180)

/* ---- where ------------------------------------------------------------------------------- */

/* Where point p of side 0 of `seam`, moved by a mirror, comes to lie: at the start or the end of a
 * side of which seam? */
typedef struct mirrored_seam {
    uint32_t seam;
    bool swapped; /* its notches are counted from its other end */
} mirrored_seam;

static ktg_vec2 end_point(const ktg_cloth *cloth, const ktg_pattern_seam *seam, uint32_t side,
                          bool last) {
    uint32_t h = ktg_seam_halfedge(cloth->pattern, seam, last ? seam->edge_count - 1 : 0, side);
    bool at_end = last == (side == 0);
    return at_end ? ktg_end_of(cloth->topology, h) : ktg_start_of(cloth->topology, h);
}

static double apart(ktg_vec2 a, ktg_vec2 b) {
    return ktg_length2(ktg_sub2(a, b));
}

/* How near two mirrored ends must be to count as the same. */
#define SAME_MM 2.0

static bool find_mirrored(const ktg_cloth *cloth, const ktg_likeness *mirror,
                          const ktg_pattern_seam *seam, uint32_t side, mirrored_seam *found) {
    ktg_vec2 a = ktg_likeness_point(mirror, end_point(cloth, seam, side, false));
    ktg_vec2 b = ktg_likeness_point(mirror, end_point(cloth, seam, side, true));
    double length = seam->lengths_mm[side];
    for (uint32_t s = 0; s < cloth->pattern->seam_count; s++) {
        const ktg_pattern_seam *other = &cloth->pattern->seams[s];
        for (uint32_t k = 0; k < 2; k++) {
            if (other->pieces[k] != mirror->piece || other == seam ||
                fabs(other->lengths_mm[k] - length) > 0.01 * length)
                continue;
            ktg_vec2 c = end_point(cloth, other, k, false), d = end_point(cloth, other, k, true);
            bool same = apart(a, c) < SAME_MM && apart(b, d) < SAME_MM;
            bool turned = apart(a, d) < SAME_MM && apart(b, c) < SAME_MM;
            *found = (mirrored_seam){s, turned && !same};
            if (same || turned)
                return true;
        }
    }
    return false;
}

/* One that is its own mirror image, end for end, has marks that are, too. */
static bool is_own_mirror(const ktg_cloth *cloth, const ktg_pattern_seam *seam) {
    for (uint32_t side = 0; side < 2; side++) {
        const ktg_likeness *self = &cloth->selves[seam->pieces[side]];
        if (self->piece == KTG_NONE)
            continue;
        ktg_vec2 a = ktg_likeness_point(self, end_point(cloth, seam, side, false));
        ktg_vec2 b = end_point(cloth, seam, side, true);
        if (apart(a, b) < SAME_MM)
            return true;
    }
    return false;
}

/* The kind of mark that the seams of its two pieces have least. */
static uint32_t rarest_marks(const ktg_cloth *cloth, const ktg_pattern_seam *seam) {
    uint32_t uses[4] = {0}, best = 1;
    for (size_t s = 0; s < cloth->pattern->seam_count; s++) {
        const ktg_pattern_seam *other = &cloth->pattern->seams[s];
        bool near = other->pieces[0] == seam->pieces[0] || other->pieces[0] == seam->pieces[1] ||
                    other->pieces[1] == seam->pieces[0] || other->pieces[1] == seam->pieces[1];
        if (near && other->notch_count > 0)
            uses[other->notches[0].marks]++;
    }
    for (uint32_t k = 2; k <= 3; k++)
        if (uses[k] < uses[best])
            best = k;
    return best;
}

/* A point of the border and the way out of the cloth there. */
typedef struct place {
    ktg_vec2 at, out;
} place;

/* A mark so near to a corner of its seam stands at the corner. */
#define AT_CORNER_MM 1e-3

/* The way out at the end of a seam's k-th edge: of both edges that meet there. */
static ktg_vec2 out_at_corner(const ktg_cloth *cloth, const ktg_pattern_seam *seam, uint32_t side,
                              uint32_t k) {
    uint32_t next = k + 1 < seam->edge_count ? k + 1 : k;
    ktg_vec2 a = ktg_along(cloth->topology, ktg_seam_halfedge(cloth->pattern, seam, k, side));
    ktg_vec2 b = ktg_along(cloth->topology, ktg_seam_halfedge(cloth->pattern, seam, next, side));
    return ktg_unit2(ktg_outward(ktg_add2(a, b)));
}

/* `along_mm` along a side of a seam, from where side 0 begins. */
static place place_on_side(const ktg_cloth *cloth, const ktg_pattern_seam *seam, uint32_t side,
                           double along_mm) {
    const ktg_topology *t = cloth->topology;
    for (uint32_t k = 0;; k++) {
        uint32_t h = ktg_seam_halfedge(cloth->pattern, seam, k, side);
        ktg_vec2 a = ktg_start_of(t, h), b = ktg_end_of(t, h), from = side == 0 ? a : b;
        double length = apart(a, b);
        if (fabs(along_mm - length) < AT_CORNER_MM)
            return (place){side == 0 ? b : a, out_at_corner(cloth, seam, side, k)};
        if (along_mm <= length || k + 1 == seam->edge_count) {
            ktg_vec2 along = ktg_along(t, h);
            return (place){ktg_madd2(from, side == 0 ? along_mm : -along_mm, along),
                           ktg_outward(along)};
        }
        along_mm -= length;
    }
}

/* How far the cloth reaches from p in direction d. */
static double reach(const ktg_pattern_piece *piece, place p) {
    double nearest = INFINITY;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % piece->outline_count];
        ktg_vec2 ab = ktg_sub2(b, a), pa = ktg_sub2(a, p.at);
        double turn = ktg_cross2(p.out, ab);
        if (turn == 0)
            continue;
        double t = ktg_cross2(pa, ab) / turn, s = ktg_cross2(pa, p.out) / turn;
        if (t > -1e-6 && s >= 0 && s <= 1)
            nearest = fmin(nearest, fmax(t, 0));
    }
    return nearest;
}

/* The place of the m-th mark of a notch on a side of a seam. */
static place place_of_mark(const ktg_cloth *cloth, const ktg_pattern_seam *seam, uint32_t side,
                           const ktg_pattern_notch *notch, uint32_t m) {
    double aside = (m - (notch->marks - 1) / 2.0) * APART_MM;
    return place_on_side(cloth, seam, side, notch->at * seam->lengths_mm[side] + aside);
}

/* Whether all marks of a notch lie at their own seam and in its allowance, on both sides: not
 * beyond its ends, where cloth was cleaned away, or where the piece is near itself. */
static bool can_be_drawn(const ktg_cloth *cloth, const ktg_pattern_seam *seam,
                         const ktg_pattern_notch *notch) {
    double most = 1.2 * cloth->options->allowance_mm + 0.1;
    double wide = (notch->marks - 1) / 2.0 * APART_MM;
    for (uint32_t side = 0; side < 2; side++) {
        double along = notch->at * seam->lengths_mm[side];
        if (along < wide || along > seam->lengths_mm[side] - wide)
            return false;
        for (uint32_t m = 0; m < notch->marks; m++) {
            place p = place_of_mark(cloth, seam, side, notch, m);
            if (!(reach(&cloth->pattern->pieces[seam->pieces[side]], p) <= most))
                return false;
        }
    }
    return true;
}

/* Whether the marks of a notch can be told from those of the one before it. */
static bool stands_apart(const ktg_pattern_seam *seam, const ktg_pattern_notch *notch) {
    if (seam->notch_count == 0)
        return true;
    double before = seam->notches[seam->notch_count - 1].at;
    return (notch->at - before) * seam->lengths_mm[0] >= 0.99 * (notch->marks + 1) * APART_MM;
}

/* Adds the notch, or one near it, where it can be drawn. */
static void add_notch(const ktg_cloth *cloth, ktg_pattern_seam *seam, ktg_pattern_notch notch) {
    static const double aside[] = {0, 0.04, -0.04, 0.08, -0.08};
    double wished = notch.at;
    for (size_t k = 0; k < sizeof aside / sizeof *aside; k++) {
        notch.at = wished + aside[k];
        if (stands_apart(seam, &notch) && can_be_drawn(cloth, seam, &notch)) {
            seam->notches[seam->notch_count++] = notch;
            return;
        }
    }
}

static ktg_status mark_seam(ktg_context *context, const ktg_cloth *cloth, ktg_pattern_seam *seam) {
    double length = (seam->lengths_mm[0] + seam->lengths_mm[1]) / 2;
    if (length < SHORT_MM || seam->dart)
        return KTG_OK;
    uint32_t marks = rarest_marks(cloth, seam);
    double wished = floor(length / cloth->options->notch_every_mm + 0.5);
    double most = fmin(MOST, floor(length / ((marks + 1) * APART_MM)) - 1);
    uint32_t count = (uint32_t)fmax(1, fmin(wished, most));
    bool even = is_own_mirror(cloth, seam);
    seam->notches = ktg_new(context, count, ktg_pattern_notch);
    if (!seam->notches)
        return KTG_MEMORY;
    for (uint32_t k = 0; k < count; k++) {
        double at = count == 1 && !even ? OFF_MIDDLE : (k + 1.0) / (count + 1);
        add_notch(cloth, seam, (ktg_pattern_notch){at, marks});
    }
    return KTG_OK;
}

/* The marks of a mirror image, but for those that cannot be drawn here. */
static ktg_status copy_marks(ktg_context *context, const ktg_cloth *cloth,
                             const ktg_pattern_seam *from, bool swapped, ktg_pattern_seam *to) {
    to->notches = ktg_new(context, from->notch_count, ktg_pattern_notch);
    if (!to->notches)
        return KTG_MEMORY;
    for (size_t k = 0; k < from->notch_count; k++) {
        ktg_pattern_notch n = from->notches[swapped ? from->notch_count - 1 - k : k];
        if (swapped)
            n.at = 1 - n.at;
        if (can_be_drawn(cloth, to, &n))
            to->notches[to->notch_count++] = n;
    }
    return KTG_OK;
}

/* The k-th way, of four, to the mirror image of a seam: by either piece, on its twin or on itself.
 */
static bool image_of(const ktg_cloth *cloth, const ktg_pattern_seam *seam, uint32_t k,
                     mirrored_seam *found) {
    const ktg_likeness *mirror = (k < 2 ? cloth->twins : cloth->selves) + seam->pieces[k % 2];
    return mirror->piece != KTG_NONE && find_mirrored(cloth, mirror, seam, k % 2, found);
}

/* Gives the seam's number and marks to all its mirror images, and theirs; queue: seam_count. */
static ktg_status spread(ktg_context *context, ktg_cloth *cloth, uint32_t first, uint32_t *queue) {
    uint32_t count = 0;
    ktg_pattern_seam *seams = cloth->pattern->seams;
    queue[count++] = first;
    while (count > 0) {
        const ktg_pattern_seam *seam = &seams[queue[--count]];
        for (uint32_t k = 0; k < 4; k++) {
            mirrored_seam found;
            if (!image_of(cloth, seam, k, &found) || seams[found.seam].number > 0)
                continue;
            seams[found.seam].number = seam->number;
            KTG_TRY(copy_marks(context, cloth, seam, found.swapped, &seams[found.seam]));
            queue[count++] = found.seam;
        }
    }
    return KTG_OK;
}

/* Marks like those of a mirror image that has some already, or new ones. */
static ktg_status choose(ktg_context *context, ktg_cloth *cloth, uint32_t s, uint32_t *number) {
    ktg_pattern_seam *seams = cloth->pattern->seams;
    mirrored_seam found;
    for (uint32_t k = 0; k < 4; k++) {
        if (!image_of(cloth, &seams[s], k, &found) || seams[found.seam].number == 0)
            continue;
        seams[s].number = seams[found.seam].number;
        return copy_marks(context, cloth, &seams[found.seam], found.swapped, &seams[s]);
    }
    seams[s].number = ++*number;
    return cloth->options->notch_mm > 0 ? mark_seam(context, cloth, &seams[s]) : KTG_OK;
}

ktg_status ktg_notches_choose(ktg_context *context, ktg_cloth *cloth) {
    ktg_pattern *pattern = cloth->pattern;
    uint32_t number = 0;
    uint32_t *queue = ktg_new(context, pattern->seam_count, uint32_t);
    ktg_status status = queue ? KTG_OK : KTG_MEMORY;
    for (size_t s = 0; s < pattern->seam_count; s++)
        pattern->seams[s].number = 0;
    for (uint32_t s = 0; status == KTG_OK && s < pattern->seam_count; s++) {
        if (pattern->seams[s].number > 0)
            continue;
        status = choose(context, cloth, s, &number);
        if (status == KTG_OK)
            status = spread(context, cloth, s, queue);
    }
    ktg_free(queue);
    return status;
}

/* ---- drawing ------------------------------------------------------------------------------ */

/* From the cut inwards, no further than to the line that is sewn; without an allowance into the
 * piece. */
static ktg_status draw_mark(ktg_context *context, const ktg_cloth *cloth, uint32_t piece, place p) {
    double out = reach(&cloth->pattern->pieces[piece], p), length = cloth->options->notch_mm;
    if (!isfinite(out))
        return KTG_OK;
    ktg_vec2 cut = ktg_madd2(p.at, out, p.out);
    if (out >= 1)
        length = fmin(length, out);
    return ktg_piece_add_segment(context, &cloth->pattern->pieces[piece], KTG_LINE_NOTCH, cut,
                                 ktg_madd2(cut, -length, p.out));
}

static ktg_status draw_seam(ktg_context *context, const ktg_cloth *cloth,
                            const ktg_pattern_seam *seam) {
    for (size_t i = 0; i < seam->notch_count; i++) {
        const ktg_pattern_notch *notch = &seam->notches[i];
        for (uint32_t side = 0; side < 2; side++)
            for (uint32_t m = 0; m < notch->marks; m++)
                KTG_TRY(draw_mark(context, cloth, seam->pieces[side],
                                  place_of_mark(cloth, seam, side, notch, m)));
    }
    return KTG_OK;
}

/* Where one seam ends and another one begins on a border that goes on smoothly, nothing else shows
 * the place: the top of a sleeve, where a shoulder seam comes. */
static bool is_joint(const ktg_topology *t, uint32_t h, uint32_t next) {
    const ktg_pattern_edge *e = ktg_edge_at(t, h), *f = ktg_edge_at(t, next);
    bool ends = e->seam != f->seam && !ktg_is_dart(t, h) && !ktg_is_dart(t, next);
    ktg_vec2 a = ktg_along(t, h), b = ktg_along(t, next);
    return ends && fabs(atan2(ktg_cross2(a, b), ktg_dot2(a, b))) < SMOOTH;
}

static ktg_status draw_joints(ktg_context *context, const ktg_cloth *cloth) {
    const ktg_topology *t = cloth->topology;
    for (uint32_t k = 0; k < t->border_count; k++) {
        uint32_t h = t->border[k], next = ktg_border_next(t, h);
        if (!is_joint(t, h, next))
            continue;
        ktg_vec2 out = ktg_add2(ktg_outward(ktg_along(t, h)), ktg_outward(ktg_along(t, next)));
        KTG_TRY(draw_mark(context, cloth, t->piece_of[h / 3],
                          (place){ktg_end_of(t, h), ktg_unit2(out)}));
    }
    return KTG_OK;
}

ktg_status ktg_notches_draw(ktg_context *context, const ktg_cloth *cloth) {
    if (!(cloth->options->notch_mm > 0))
        return KTG_OK;
    for (size_t s = 0; s < cloth->pattern->seam_count; s++)
        KTG_TRY(draw_seam(context, cloth, &cloth->pattern->seams[s]));
    return draw_joints(context, cloth);
}
