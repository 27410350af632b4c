/* unfold/arrange_phases.c - annealing pieces towards their sheets: phases. */
#include "core/memory.h"
#include "unfold/annealing.h"
#include "unfold/net.h"
#include "unfold/transplant.h"

#include <stdio.h>
#include <string.h>

/* Temperatures and prices are in parts of what one average face costs at the edge of its sheet.
 * Chosen by measurement on closed/500; docs/unfold.md has the figures. */
typedef struct phase {
    bool soft;
    int power;        /* of the spread */
    double hot, cold; /* the temperature falls geometrically */
    double tab_price; /* of a seam without a tab */
    double share;     /* of the work */
} phase;

static const phase phases[] = {
    {true, 4, 4, 0.15, 10, 0.25},     /* shapes for the sheet; overlaps are resolved after it */
    {false, 4, 2, 0.63, 6, 0.15},     /* room for tabs */
    {false, 8, 0.63, 0.2, 6, 0.1},    /* the same, what stands out moves in */
    {false, 16, 1.6, 0.4, 7, 0.2},    /* again at the scale that was reached */
    {false, 64, 1.2, 0.1, 6.5, 0.3}}; /* what stands out moves in, what lacks a tab gets one */
#define PHASES (sizeof phases / sizeof *phases)

/* From this phase on each begins with the scale that was reached, less a little: */
#define FIRST_RESCALED 3
#define SQUEEZE        0.99

/* An overlapping pair of faces costs this many temperatures at the beginning and at the end. */
#define CONFLICT_FIRST 0.5
#define CONFLICT_LAST  5.0

/* While faces may overlap, those without a common vertex keep this part of a tab's height apart. */
#define GAP 0.3

/* Steps between two tidyings, and between two looks at the clock. */
#define TIDY 65536
#define LOOK 256

/* Steps that may end without a new least number of overlaps when those left are taken away. */
#define PATIENCE 20000

/* ---- phases --------------------------------------------------------------------------------- */

static uint32_t count_conflicts(const ktg_arrangement *a) {
    uint32_t twice = 0;
    for (uint32_t i = 0; i < a->dual->face_count; i++) {
        ktg_branch face = {a->order[i], i, 1};
        twice += ktg_graft_conflicts(a, &face, NULL, UINT32_MAX - 1);
    }
    return twice / 2;
}

/* The box around a piece and its tabs. */
static ktg_flat_box box_of(const ktg_annealing *s, uint32_t piece) {
    ktg_flat_box box = ktg_flat_box_empty();
    ktg_cells_add_boxes(&s->a->cells, piece, &box);
    if (s->tabs)
        ktg_cells_add_boxes(&s->tabs->cells, piece, &box);
    return box;
}

/* How much larger than its sheet a box is. */
static double excess_of(const ktg_annealing *s, const ktg_flat_box *box) {
    return fmax((box->x1 - box->x0) / (2 * s->half.x), (box->y1 - box->y0) / (2 * s->half.y));
}

/* The part of the sheets that faces fill at the scale at which the largest piece fits. */
static double fill_of(const ktg_annealing *s) {
    double excess = 0, sheets = 4 * s->half.x * s->half.y * s->a->piece_count;
    for (uint32_t p = 0; p < s->a->piece_count; p++) {
        ktg_flat_box box = box_of(s, p);
        excess = fmax(excess, excess_of(s, &box));
    }
    return ktg_dual_area(s->a->dual) / (sheets * excess * excess);
}

/* Roots in the middle of their trees, and an end to rounding. */
static ktg_status tidy(ktg_context *context, ktg_annealing *s, int power) {
    ktg_branch all = {0, 0, s->a->dual->face_count};
    ktg_arrangement_order(s->a);
    KTG_TRY(ktg_arrangement_settle(context, s->a));
    ktg_spread_recount(&s->spread, power);
    s->conflicts = s->soft ? count_conflicts(s->a) : 0;
    if (s->tabs && !s->soft)
        KTG_TRY(ktg_seam_tabs_lay(context, s->tabs, &all));
    s->fill = fill_of(s);
    return KTG_OK;
}

static void tell(ktg_context *context, ktg_annealing *s) {
    char detail[96];
    /* the last step may take more than was left */
    double part = fmin(1, (double)(s->work_before + s->work) / (double)s->goal->work);
    if (s->soft)
        snprintf(detail, sizeof detail, "finding a shape for the sheet, %u overlaps", s->conflicts);
    else if (s->tabs)
        snprintf(detail, sizeof detail, "%.0f %% of the sheet filled, %u seams want a better tab",
                 100 * s->fill, s->tabs->unhappy_count);
    else
        snprintf(detail, sizeof detail, "%.0f %% of the sheet filled", 100 * s->fill);
    ktg_search_progress(context, s->search, part * s->a->dual->face_count, detail);
}

static void set_temperature(ktg_annealing *s, const phase *p, double done) {
    double unit = 1.0 / s->a->dual->face_count;
    s->temperature = unit * p->hot * pow(p->cold / p->hot, done);
    s->conflict_price = s->temperature * (CONFLICT_FIRST + (CONFLICT_LAST - CONFLICT_FIRST) * done);
    s->tab_price = unit * p->tab_price;
}

static ktg_status run_phase(ktg_context *context, ktg_annealing *s, const phase *p) {
    uint64_t begin = s->work, end = begin + (uint64_t)(p->share * s->per_share);
    s->soft = p->soft;
    s->a->gap = s->soft && s->tabs ? GAP * s->wish.height : 0;
    KTG_TRY(tidy(context, s, p->power));
    for (uint64_t step = 1; s->work < end; step++) {
        if (step % LOOK == 1) {
            double done = (double)(s->work - begin) / (double)(end - begin);
            set_temperature(s, p, done);
            tell(context, s);
            if (!ktg_search_goes_on(context, s->search))
                break;
        }
        if (step % TIDY == 0)
            KTG_TRY(tidy(context, s, p->power));
        KTG_TRY(ktg_annealing_step(context, s, step));
    }
    return KTG_OK;
}

/* ---- the whole ------------------------------------------------------------------------------ */

ktg_status ktg_annealing_open(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                              const bool *folded) {
    uint32_t n = dual->face_count;
    ktg_vec2 region = ktg_mul2(s->half, 1.4);
    KTG_TRY(ktg_arrangement_new(context, dual, folded, region, &s->a));
    KTG_TRY(ktg_spread_new(context, s->a, s->half, &s->spread));
    KTG_TRY(ktg_spread_pose(context, s->a, &s->spread));
    KTG_TRY(ktg_ease_new(context, s->a, s->goal->ease, s->half, s->goal->short_edge, &s->ease));
    if (!s->goal->tabs)
        return KTG_OK;
    s->saved = (ktg_saved){.faces = ktg_new(context, n, uint32_t),
                           .corners = ktg_new(context, 3 * (size_t)n, ktg_vec2),
                           .turns = ktg_new(context, n, ktg_vec2)};
    if (!s->saved.faces || !s->saved.corners || !s->saved.turns)
        return KTG_MEMORY;
    KTG_TRY(ktg_seam_tabs_new(context, s->a, &s->wish, &s->tabs));
    return ktg_leaves_new(context, s->a, s->tabs, &s->leaves);
}

void ktg_annealing_close(ktg_annealing *s) {
    ktg_leaves_free(&s->leaves);
    ktg_ease_free(&s->ease);
    ktg_seam_tabs_free(&s->tabs);
    ktg_spread_free(&s->spread);
    ktg_arrangement_free(&s->a);
    ktg_free(s->saved.faces);
    ktg_free(s->saved.corners);
    ktg_free(s->saved.turns);
    s->saved = (ktg_saved){0};
}

/* Takes the last overlaps of a single piece away by transplants, and turns it back to where it
 * lay. False when some are left. */
static ktg_status resolve(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                          bool *folded, bool *resolved) {
    ktg_net *net = NULL;
    uint32_t root = 3 * s->a->order[0];
    ktg_vec2 from = s->a->corners[root], to = s->a->corners[root + 1];
    *resolved = false;
    KTG_TRY(ktg_net_new(context, dual, s->a->folded, &net));
    ktg_status status = ktg_transplant_run(context, net, PATIENCE, s->search);
    if (status == KTG_OK)
        status = ktg_net_refresh(context, net);
    if (status == KTG_OK && net->live_count == 0) {
        *resolved = true;
        memcpy(folded, net->folded, dual->edge_count * sizeof *folded);
    }
    ktg_net_free(&net);
    if (status != KTG_OK || !*resolved)
        return status;
    ktg_annealing_close(s);
    KTG_TRY(ktg_annealing_open(context, s, dual, folded));
    return ktg_arrangement_move(
        context, s->a, 0,
        ktg_motion2_between(s->a->corners[root], s->a->corners[root + 1], from, to));
}

/* After faces were allowed to overlap: back to where that began, if they cannot be parted. */
static ktg_status make_hard(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                            bool *folded) {
    bool resolved = s->conflicts == 0;
    s->a->gap = 0;
    if (!resolved && s->a->piece_count == 1)
        KTG_TRY(resolve(context, s, dual, folded, &resolved));
    s->conflicts = 0;
    if (resolved)
        return KTG_OK;
    ktg_annealing_close(s);
    return ktg_annealing_open(context, s, dual, folded);
}

ktg_status ktg_annealing_centre(ktg_context *context, ktg_annealing *s, double *excess) {
    *excess = 0;
    for (uint32_t p = 0; p < s->a->piece_count; p++) {
        ktg_flat_box box = box_of(s, p);
        ktg_motion2 shift = {
            1, 0, {-0.5 * ((double)box.x0 + box.x1), -0.5 * ((double)box.y0 + box.y1)}};
        *excess = fmax(*excess, excess_of(s, &box));
        KTG_TRY(ktg_arrangement_move(context, s->a, p, shift));
    }
    return KTG_OK;
}

/* Where the scale is free: sheet and tabs as large as they are at the scale that was reached, but
 * for a little. */
static ktg_status rescale(ktg_context *context, ktg_annealing *s) {
    double excess;
    KTG_TRY(ktg_annealing_centre(context, s, &excess));
    if (s->goal->fixed)
        return KTG_OK;
    double by = excess * SQUEEZE;
    s->half = ktg_mul2(s->half, by);
    s->spread.per = (ktg_vec2){1 / s->half.x, 1 / s->half.y};
    s->wish.height *= by;
    s->wish.least *= by;
    s->wish.edge *= by;
    s->wish.inset *= by;
    s->wish.air *= by;
    s->wish.half = s->half;
    return KTG_OK;
}

ktg_status ktg_annealing_run(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                             bool shaped, bool *folded) {
    size_t first = shaped ? FIRST_RESCALED : 0;
    double shares = 0;
    for (size_t k = first; k < PHASES; k++)
        shares += phases[k].share;
    s->per_share = s->budget / shares;
    for (size_t k = first; k < PHASES; k++) {
        if (k >= FIRST_RESCALED)
            KTG_TRY(rescale(context, s));
        if (s->tabs && !phases[k].soft && (k >= FIRST_RESCALED || phases[k - 1].soft))
            KTG_TRY(ktg_seam_tabs_renew(context, s->tabs, &s->wish));
        KTG_TRY(run_phase(context, s, &phases[k]));
        if (phases[k].soft)
            KTG_TRY(make_hard(context, s, dual, folded));
    }
    return KTG_OK;
}
