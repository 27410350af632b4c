/* pattern/seams.c - runs of consecutive cut edges whose mates are consecutive too. */
#include "pattern/finish.h"

#include "core/memory.h"

/* Edges that meet in a notch narrower than this, nowhere further apart than this, are seen to
 * belong together. */
#define OBVIOUS_ANGLE (50 * KTG_PI / 180)
#define OBVIOUS_MM    12.0

static bool is_cut(const ktg_topology *t, uint32_t h) {
    return ktg_edge_at(t, h)->kind == KTG_EDGE_CUT;
}

/* True when the border half-edge `next`, which follows h, belongs to the same seam: their mates
 * follow each other as well, the other way round. Around a leaf of the cut tree an edge is followed
 * by its own mate: there a seam ends. */
static bool continues(const ktg_topology *t, uint32_t h, uint32_t next) {
    if (!is_cut(t, h) || !is_cut(t, next) || t->edge_of[h] == t->edge_of[next])
        return false;
    return ktg_border_next(t, ktg_mate(t, next)) == ktg_mate(t, h);
}

/* The first half-edge of the run through h; a run that closes on itself starts at h. */
static uint32_t first_of_run(const ktg_topology *t, uint32_t h) {
    uint32_t first = h;
    for (;;) {
        uint32_t previous = ktg_border_previous(t, first);
        if (!continues(t, previous, first))
            return first;
        if (previous == h)
            return h;
        first = previous;
    }
}

/* The number of edges of the run that starts at `first`. */
static uint32_t length_of_run(const ktg_topology *t, uint32_t first, uint32_t *last) {
    uint32_t count = 1;
    *last = first;
    for (uint32_t next = ktg_border_next(t, first); next != first && continues(t, *last, next);
         next = ktg_border_next(t, next)) {
        *last = next;
        count++;
    }
    return count;
}

/* True when the run leaves a leaf of the cut tree at its start and does not come to one. */
static bool starts_at_leaf(const ktg_topology *t, uint32_t first, uint32_t last) {
    return ktg_border_previous(t, first) == ktg_mate(t, first) &&
           ktg_border_next(t, last) != ktg_mate(t, last);
}

static double length_of(const ktg_topology *t, uint32_t h) {
    return ktg_length2(ktg_sub2(ktg_end_of(t, h), ktg_start_of(t, h)));
}

static ktg_status write_seam(ktg_context *context, const ktg_topology *t, ktg_pattern *pattern,
                             uint32_t first, uint32_t count) {
    ktg_pattern_seam *seam = &pattern->seams[pattern->seam_count];
    seam->edges = ktg_new(context, count, uint32_t);
    seam->first_side = ktg_new(context, count, uint8_t);
    pattern->seam_count++;
    if (!seam->edges || !seam->first_side)
        return KTG_MEMORY;
    seam->edge_count = count;
    seam->pieces[0] = t->piece_of[first / 3];
    seam->pieces[1] = t->piece_of[ktg_mate(t, first) / 3];
    uint32_t h = first;
    for (uint32_t k = 0; k < count; k++, h = ktg_border_next(t, h)) {
        seam->edges[k] = t->edge_of[h];
        seam->first_side[k] = t->side_of[h];
        seam->lengths_mm[0] += length_of(t, h);
        seam->lengths_mm[1] += length_of(t, ktg_mate(t, h));
        pattern->edges[t->edge_of[h]].seam = (uint32_t)(pattern->seam_count - 1);
    }
    return KTG_OK;
}

static void forget_seams(ktg_pattern *pattern) {
    for (size_t s = 0; s < pattern->seam_count; s++) {
        ktg_free(pattern->seams[s].edges);
        ktg_free(pattern->seams[s].first_side);
        ktg_free(pattern->seams[s].notches);
    }
    ktg_free(pattern->seams);
    pattern->seams = NULL;
    pattern->seam_count = 0;
    for (size_t e = 0; e < pattern->edge_count; e++)
        pattern->edges[e].seam = KTG_NONE;
}

/* The two sides of a notch: from the leaf of the cut tree, `out` leaves it and `in` comes to it.
 * The angle between them, outside the paper; larger than pi where they overlap, which they do not.
 */
static double notch_angle(const ktg_topology *t, uint32_t in, uint32_t out) {
    ktg_vec2 a = ktg_sub2(ktg_end_of(t, out), ktg_start_of(t, out));
    ktg_vec2 b = ktg_sub2(ktg_start_of(t, in), ktg_end_of(t, in));
    double angle = atan2(ktg_cross2(b, a), ktg_dot2(b, a));
    return angle < 0 ? angle + 2 * KTG_PI : angle;
}

static uint32_t halfedge_of(const ktg_pattern *pattern, const ktg_pattern_seam *seam, uint32_t k,
                            uint32_t side) {
    return ktg_side_halfedge(&pattern->edges[seam->edges[k]].sides[seam->first_side[k] ^ side]);
}

/* How far apart the middles of an edge's two copies are. */
static double apart(const ktg_topology *t, uint32_t h, uint32_t mate) {
    ktg_vec2 sum = ktg_add2(ktg_start_of(t, h), ktg_end_of(t, h));
    return ktg_length2(ktg_sub2(sum, ktg_add2(ktg_start_of(t, mate), ktg_end_of(t, mate)))) / 2;
}

/* True when the seam begins or ends at a narrow notch, and none of it is far from its mate. */
static bool is_obvious(const ktg_topology *t, const ktg_pattern *pattern,
                       const ktg_pattern_seam *seam) {
    uint32_t last = seam->edge_count - 1;
    uint32_t first = halfedge_of(pattern, seam, 0, 0), end = halfedge_of(pattern, seam, last, 0);
    double angle = 2 * KTG_PI;
    if (pattern->mode != KTG_PAPER || seam->pieces[0] != seam->pieces[1])
        return false;
    if (ktg_border_previous(t, first) == ktg_mate(t, first))
        angle = notch_angle(t, ktg_mate(t, first), first);
    else if (ktg_border_next(t, end) == ktg_mate(t, end))
        angle = notch_angle(t, end, ktg_mate(t, end));
    bool obvious = angle <= OBVIOUS_ANGLE;
    for (uint32_t k = 0; obvious && k <= last; k++)
        obvious = apart(t, halfedge_of(pattern, seam, k, 0), halfedge_of(pattern, seam, k, 1)) <=
                  OBVIOUS_MM;
    return obvious;
}

/* Puts the obvious seams last, the others keep their order: they are numbered from 1 on. */
static ktg_status sort_seams(ktg_context *context, const ktg_topology *t, ktg_pattern *pattern) {
    size_t count = pattern->seam_count, next = 0;
    ktg_pattern_seam *sorted = ktg_new(context, count, ktg_pattern_seam);
    if (!sorted)
        return KTG_MEMORY;
    for (size_t s = 0; s < count; s++)
        pattern->seams[s].obvious = is_obvious(t, pattern, &pattern->seams[s]);
    for (int obvious = 0; obvious < 2; obvious++)
        for (size_t s = 0; s < count; s++)
            if (pattern->seams[s].obvious == obvious)
                sorted[next++] = pattern->seams[s];
    ktg_free(pattern->seams);
    pattern->seams = sorted;
    for (size_t s = 0; s < count; s++)
        sorted[s].number = (uint32_t)s + 1;
    for (size_t s = 0; s < count; s++)
        for (uint32_t k = 0; k < sorted[s].edge_count; k++)
            pattern->edges[sorted[s].edges[k]].seam = (uint32_t)s;
    return KTG_OK;
}

ktg_status ktg_seams_find(ktg_context *context, const ktg_topology *t, ktg_pattern *pattern) {
    size_t capacity = 0;
    forget_seams(pattern);
    for (uint32_t k = 0; k < t->border_count; k++) {
        uint32_t h = t->border[k], last;
        if (!is_cut(t, h) || ktg_edge_at(t, h)->seam != KTG_NONE)
            continue;
        uint32_t first = first_of_run(t, h), count = length_of_run(t, first, &last);
        if (starts_at_leaf(t, first, last))
            first = ktg_mate(t, last);
        KTG_TRY(ktg_reserve(context, &pattern->seams, &capacity, pattern->seam_count + 1));
        KTG_TRY(write_seam(context, t, pattern, first, count));
    }
    return sort_seams(context, t, pattern);
}
