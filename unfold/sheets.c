/* unfold/sheets.c - a part in few pieces that fit their sheets. */
#include "unfold/sheets.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/goal.h"
#include "unfold/join.h"
#include "unfold/regions.h"
#include "unfold/sheet_check.h"
#include "unfold/sheet_fill.h"
#include "unfold/sheet_merge.h"
#include "unfold/sheet_start.h"
#include "unfold/spread.h"

#include <string.h>

/* The most of a sheet that faces are hoped to fill, by effort: the first attempt has so few
 * pieces. */
static const double hoped_fill[] = {0.50, 0.54, 0.57};

/* Work of an attempt, for each face; beyond MANY_FACES it grows with their root only. */
static const double face_work[] = {4e3, 2e4, 8e4};
#define MANY_FACES 1000.0

/* Rising numbers of pieces that are tried. */
#define NUMBERS 8

/* Each number is tried so often at most, with fewer faces than these divided by it. */
#define REPEATS      4
#define REPEAT_FACES 500

typedef struct dividing {
    const ktg_dual *dual;
    const ktg_unfold_options *options;
    ktg_search *search;
    double sheet; /* printable area, in the dual's unit */
    double *load; /* face_count: area, or 1 where faces are counted */
    uint32_t *region;
    bool *whole;        /* edge_count: one piece without overlaps; NULL until it is needed */
    bool *trial, *best; /* edge_count */
    uint32_t pieces, best_pieces; /* of those */
    int attempts;
    bool fits;   /* the trial */
    bool refill; /* the best one has pieces that were halved without looking for better ones */
} dividing;

bool ktg_sheets_wanted(const ktg_unfold_options *o) {
    return (o->mm_per_unit > 0 && o->oversize == KTG_OVERSIZE_SPLIT) || o->pieces > 1 ||
           o->piece_faces > 0;
}

static bool fixed_size(const ktg_unfold_options *o) {
    return o->mm_per_unit > 0 && o->oversize == KTG_OVERSIZE_SPLIT;
}

/* ---- one attempt ---------------------------------------------------------------------------- */

static double counted_faces(const ktg_dual *dual) {
    double faces = dual->face_count;
    return faces < MANY_FACES ? faces : sqrt(faces * MANY_FACES);
}

/* Without a size all pieces share one sheet. */
static ktg_sheet_fill fill_for(const dividing *d, uint32_t count) {
    double part = fixed_size(d->options) ? 1 : ktg_dual_area(d->dual) / d->search->area_all / count;
    return (ktg_sheet_fill){.half = ktg_goal_half(d->options, d->search->mm, part),
                            .mm = d->search->mm,
                            .work = face_work[d->options->effort] * counted_faces(d->dual),
                            .fixed_size = fixed_size(d->options),
                            .progress_from = 1 - pow(0.5, d->attempts),
                            .progress_to = 1 - pow(0.5, d->attempts + 1)};
}

static ktg_status count_trees(ktg_context *context, dividing *d) {
    return ktg_sheet_trees(context, d->dual, d->trial, d->region, &d->pieces);
}

/* Cuts the largest pieces of one net in halves: always as many as are wanted. */
static ktg_status start_from_whole(ktg_context *context, dividing *d, uint32_t count) {
    size_t edges = d->dual->edge_count;
    if (!d->whole) {
        d->whole = ktg_new(context, edges, bool);
        if (!d->whole)
            return KTG_MEMORY;
        KTG_TRY(ktg_join_transplant(context, d->dual, d->options, d->search, d->whole, &d->pieces));
    }
    memcpy(d->trial, d->whole, edges * sizeof *d->trial);
    return ktg_sheet_halve_largest(context, d->dual, count, d->trial);
}

/* A tree for each region; where they fall apart into more, halves of one net. */
static ktg_status start(ktg_context *context, dividing *d, uint32_t count) {
    uint32_t made;
    KTG_TRY(
        ktg_regions_grow(context, d->dual, d->load, count, &d->search->random, d->region, &made));
    KTG_TRY(ktg_sheet_start(context, d->dual, d->region, made, d->search, d->trial));
    KTG_TRY(ktg_sheet_merge(context, d->dual, count, d->trial));
    KTG_TRY(count_trees(context, d));
    return d->pieces > count ? start_from_whole(context, d, count) : KTG_OK;
}

/* Anneals the trial. */
static ktg_status fill_sheets(ktg_context *context, dividing *d) {
    KTG_TRY(count_trees(context, d));
    ktg_sheet_fill fill = fill_for(d, d->pieces);
    bool overlaps = false;
    bool *before = ktg_copy_array(context, d->trial, d->dual->edge_count, sizeof *before);
    if (!before)
        return KTG_MEMORY;
    ktg_status status =
        ktg_sheet_fill_run(context, d->dual, d->options, &fill, d->search, d->trial, &d->fits);
    if (status == KTG_OK)
        status = ktg_sheet_overlaps(context, d->dual, d->trial, &overlaps);
    if (overlaps) { /* rounding has hidden one */
        d->fits = false;
        memcpy(d->trial, before, d->dual->edge_count * sizeof *before);
    }
    ktg_free(before);
    return status;
}

/* ---- what does not fit ---------------------------------------------------------------------- */

static ktg_status halve_once(ktg_context *context, dividing *d, uint32_t *cuts) {
    ktg_sheet_check check;
    *cuts = 0;
    KTG_TRY(ktg_sheet_check_run(context, d->dual, d->options, d->search->mm, d->trial,
                                d->search->careful, &check));
    uint32_t *faces = ktg_new(context, check.piece_count, uint32_t);
    bool *cut = ktg_new(context, check.piece_count, bool);
    ktg_status status = faces && cut ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t f = 0; f < d->dual->face_count; f++)
            faces[check.piece[f]]++;
        for (uint32_t p = 0; p < check.piece_count; p++)
            cut[p] = (fixed_size(d->options) && check.magnification[p] < 1) ||
                     (d->options->piece_faces > 0 && faces[p] > d->options->piece_faces);
        status =
            ktg_sheet_halve(context, d->dual, check.piece, cut, check.piece_count, d->trial, cuts);
    }
    ktg_free(faces);
    ktg_free(cut);
    ktg_sheet_check_free(&check);
    return status;
}

static ktg_status halve_until_all_fit(ktg_context *context, dividing *d) {
    uint32_t cuts = 1;
    while (cuts > 0) {
        KTG_TRY(halve_once(context, d, &cuts));
        KTG_TRY(ktg_check_cancel(context));
    }
    return count_trees(context, d);
}

/* ---- how many ------------------------------------------------------------------------------- */

/* The fewest pieces worth an attempt. */
static uint32_t least_pieces(const dividing *d) {
    const ktg_unfold_options *o = d->options;
    double most = o->pieces > 1 ? o->pieces : 1;
    if (fixed_size(o))
        most = fmax(most, ceil(ktg_dual_area(d->dual) / (hoped_fill[o->effort] * d->sheet)));
    if (o->piece_faces > 0)
        most = fmax(most, ceil((double)d->dual->face_count / o->piece_faces));
    return (uint32_t)fmin(most, d->dual->face_count);
}

/* The one piece there is already may do. */
static ktg_status try_present(ktg_context *context, dividing *d, const bool *joined) {
    ktg_sheet_check check;
    memcpy(d->trial, joined, d->dual->edge_count * sizeof *joined);
    KTG_TRY(ktg_sheet_check_run(context, d->dual, d->options, d->search->mm, joined,
                                d->search->careful, &check));
    d->pieces = check.piece_count;
    d->fits = check.too_many == 0 && (!fixed_size(d->options) || check.too_large == 0);
    ktg_sheet_check_free(&check);
    return KTG_OK;
}

/* True when so many pieces would be better than the best so far; of as many, those that were not
 * halved are. */
static bool would_gain(const dividing *d, uint32_t pieces, bool refill) {
    return pieces < d->best_pieces || (pieces == d->best_pieces && d->refill && !refill);
}

static void keep_best(dividing *d, bool refill) {
    if (!would_gain(d, d->pieces, refill))
        return;
    memcpy(d->best, d->trial, d->dual->edge_count * sizeof *d->best);
    d->best_pieces = d->pieces;
    d->refill = refill;
}

static ktg_status attempt(ktg_context *context, dividing *d, uint32_t count) {
    KTG_TRY(start(context, d, count));
    KTG_TRY(fill_sheets(context, d));
    bool fits = d->fits;
    if (!fits)
        KTG_TRY(halve_until_all_fit(context, d));
    keep_best(d, !fits);
    return KTG_OK;
}

/* Pieces that were halved because they were too large are annealed, too. */
static ktg_status anneal_halves(ktg_context *context, dividing *d) {
    memcpy(d->trial, d->best, d->dual->edge_count * sizeof *d->trial);
    KTG_TRY(fill_sheets(context, d));
    if (d->fits)
        memcpy(d->best, d->trial, d->dual->edge_count * sizeof *d->best);
    return KTG_OK;
}

/* Luck counts for more where there are few faces, and tries cost less. */
static ktg_status try_number(ktg_context *context, dividing *d, uint32_t count) {
    for (uint32_t i = 0; i < REPEATS && i * d->dual->face_count <= REPEAT_FACES; i++) {
        KTG_TRY(attempt(context, d, count));
        if (!would_gain(d, count, false) || !ktg_search_goes_on(context, d->search))
            break;
    }
    return KTG_OK;
}

/* More pieces each time, as long as that can be fewer than what was found. */
static ktg_status try_numbers(ktg_context *context, dividing *d, const bool *joined) {
    uint32_t count = least_pieces(d);
    if (count == 1) {
        KTG_TRY(try_present(context, d, joined));
        if (d->fits)
            keep_best(d, false);
        count = 2;
    }
    for (int tries = 0; tries < NUMBERS && would_gain(d, count, false); tries++) {
        KTG_TRY(try_number(context, d, count));
        if (!ktg_search_goes_on(context, d->search))
            return KTG_OK;
        count += 1 + (d->best_pieces > count ? (d->best_pieces - count) / 4 : 0);
    }
    return d->refill ? anneal_halves(context, d) : KTG_OK;
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status prepare(ktg_context *context, dividing *d) {
    size_t n = d->dual->face_count;
    ktg_vec2 half = ktg_goal_half(d->options, d->search->mm, 1);
    d->sheet = 4 * half.x * half.y;
    d->load = ktg_new(context, n, double);
    d->region = ktg_new(context, n, uint32_t);
    d->trial = ktg_new(context, d->dual->edge_count, bool);
    d->best = ktg_new(context, d->dual->edge_count, bool);
    d->best_pieces = UINT32_MAX;
    if (!d->load || !d->region || !d->trial || !d->best)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < n; f++) {
        const ktg_vec2 *p = d->dual->flat + 3 * (size_t)f;
        d->load[f] = d->options->piece_faces > 0
                         ? 1
                         : 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
    }
    return KTG_OK;
}

ktg_status ktg_sheets_divide(ktg_context *context, const ktg_dual *dual,
                             const ktg_unfold_options *options, ktg_search *search, bool *joined,
                             uint32_t *pieces) {
    dividing d = {.dual = dual, .options = options, .search = search};
    ktg_status status = prepare(context, &d);
    if (status == KTG_OK)
        status = try_numbers(context, &d, joined);
    if (status == KTG_OK) {
        memcpy(joined, d.best, dual->edge_count * sizeof *joined);
        *pieces = d.best_pieces;
    }
    ktg_free(d.load);
    ktg_free(d.region);
    ktg_free(d.whole);
    ktg_free(d.trial);
    ktg_free(d.best);
    return status;
}

uint32_t ktg_sheets_least(const ktg_dual *dual, const ktg_unfold_options *options,
                          const ktg_search *search) {
    ktg_vec2 half = ktg_goal_half(options, search->mm, 1);
    dividing d = {.dual = dual, .options = options, .sheet = 4 * half.x * half.y};
    return least_pieces(&d);
}
