/* unfold/sheets.c - a part in few pieces that fit their sheets. */
#include "unfold/sheets.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/goal.h"
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

/* Work of an attempt, for each face. */
static const double face_work[] = {4e3, 1.2e4, 6e4};

/* Attempts with rising numbers of pieces; then those that are too large are halved. */
#define ATTEMPTS 12

typedef struct dividing {
    const ktg_dual *dual;
    const ktg_unfold_options *options;
    ktg_search *search;
    double sheet; /* printable area, in the dual's unit */
    double *load; /* face_count: area, or 1 where faces are counted */
    uint32_t *region;
    bool *trial;
    uint32_t pieces; /* of `trial` */
    bool fits;
} dividing;

bool ktg_sheets_wanted(const ktg_unfold_options *o) {
    return (o->mm_per_unit > 0 && o->oversize == KTG_OVERSIZE_SPLIT) || o->pieces > 1 ||
           o->piece_faces > 0;
}

static bool fixed_size(const ktg_unfold_options *o) {
    return o->mm_per_unit > 0 && o->oversize == KTG_OVERSIZE_SPLIT;
}

/* ---- one attempt ---------------------------------------------------------------------------- */

/* Without a size all pieces share one sheet. */
static ktg_sheet_fill fill_for(const dividing *d, uint32_t count) {
    double part = fixed_size(d->options) ? 1 : ktg_dual_area(d->dual) / d->search->area_all / count;
    return (ktg_sheet_fill){.half = ktg_goal_half(d->options, d->search->mm, part),
                            .mm = d->search->mm,
                            .work = face_work[d->options->effort] * d->dual->face_count,
                            .fixed_size = fixed_size(d->options)};
}

static ktg_status count_trees(ktg_context *context, dividing *d) {
    return ktg_sheet_trees(context, d->dual, d->trial, d->region, &d->pieces);
}

static ktg_status attempt(ktg_context *context, dividing *d, uint32_t count) {
    ktg_sheet_fill fill = fill_for(d, count);
    bool overlaps = false;
    uint32_t made;
    KTG_TRY(
        ktg_regions_grow(context, d->dual, d->load, count, &d->search->random, d->region, &made));
    KTG_TRY(ktg_sheet_start(context, d->dual, d->region, made, d->search, d->trial));
    KTG_TRY(ktg_sheet_merge(context, d->dual, count, d->trial));

    KTG_TRY(ktg_sheet_fill_run(context, d->dual, d->options, &fill, d->search, d->trial, &d->fits));
    KTG_TRY(ktg_sheet_overlaps(context, d->dual, d->trial, &overlaps));
    if (overlaps) { /* rounding has hidden one */
        d->fits = false;
        KTG_TRY(ktg_sheet_start(context, d->dual, d->region, made, d->search, d->trial));
    }
    return count_trees(context, d);
}

/* ---- what does not fit in the end ----------------------------------------------------------- */

static ktg_status halve_once(ktg_context *context, dividing *d, uint32_t *cuts) {
    ktg_sheet_check check;
    *cuts = 0;
    KTG_TRY(ktg_sheet_check_run(context, d->dual, d->options, d->search->mm, d->trial, &check));
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
    KTG_TRY(ktg_sheet_check_run(context, d->dual, d->options, d->search->mm, joined, &check));
    d->pieces = check.piece_count;
    d->fits = check.too_many == 0 && (!fixed_size(d->options) || check.too_large == 0);
    ktg_sheet_check_free(&check);
    return KTG_OK;
}

static ktg_status try_numbers(ktg_context *context, dividing *d, const bool *joined) {
    uint32_t count = least_pieces(d), faces = d->dual->face_count;
    if (count == 1) {
        KTG_TRY(try_present(context, d, joined));
        count = 2;
        if (d->fits)
            return KTG_OK;
    }
    for (int tries = 0; !d->fits && tries < ATTEMPTS; tries++) {
        count = count < faces ? count : faces;
        KTG_TRY(attempt(context, d, count));
        if (!ktg_search_goes_on(context, d->search))
            break;
        if (d->options->pieces > 1 && tries > 2)
            break;
        if (d->options->pieces < 2)
            count += 1 + (tries > 3 ? count / 8 : 0);
    }
    return d->fits ? KTG_OK : halve_until_all_fit(context, d);
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status prepare(ktg_context *context, dividing *d) {
    size_t n = d->dual->face_count;
    ktg_vec2 half = ktg_goal_half(d->options, d->search->mm, 1);
    d->sheet = 4 * half.x * half.y;
    d->load = ktg_new(context, n, double);
    d->region = ktg_new(context, n, uint32_t);
    d->trial = ktg_new(context, d->dual->edge_count, bool);
    if (!d->load || !d->region || !d->trial)
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
        memcpy(joined, d.trial, dual->edge_count * sizeof *joined);
        *pieces = d.pieces;
    }
    ktg_free(d.load);
    ktg_free(d.region);
    ktg_free(d.trial);
    return status;
}

uint32_t ktg_sheets_least(const ktg_dual *dual, const ktg_unfold_options *options,
                          const ktg_search *search) {
    ktg_vec2 half = ktg_goal_half(options, search->mm, 1);
    dividing d = {.dual = dual, .options = options, .sheet = 4 * half.x * half.y};
    return least_pieces(&d);
}
