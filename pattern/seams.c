/* pattern/seams.c - runs of consecutive cut edges whose mates are consecutive too. */
#include "pattern/finish.h"

#include "core/memory.h"

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
    }
    ktg_free(pattern->seams);
    pattern->seams = NULL;
    pattern->seam_count = 0;
    for (size_t e = 0; e < pattern->edge_count; e++)
        pattern->edges[e].seam = KTG_NONE;
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
    return KTG_OK;
}
