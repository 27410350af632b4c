/* unfold/arrange.c - annealing pieces towards their sheets: phases. */
#include "unfold/arrange.h"
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
    {false, 8, 0.63, 0.2, 6, 0.15},   /* the same, what stands out moves in */
    {false, 8, 1, 0.3, 6, 0.2},       /* again at the scale that was reached */
    {false, 16, 1.0, 0.1, 10, 0.25}}; /* what stands out moves in, what lacks a tab gets one */
#define PHASES (sizeof phases / sizeof *phases)

/* From this phase on each begins with the scale that was reached, less a little: */
#define FIRST_RESCALED 3
#define SQUEEZE        0.99

/* With enough work several starts are made, so many at most, each with at least so much work for a
 * face and all with this part of the whole; the best goes on. A missing tab weighs as much as this
 * part of the area. */
#define MOST_STARTS  12
#define START_WORK   8000.0
#define STARTS_PART  0.5
#define PRICE_POINTS 0.03

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

/* Roots in the middle of their trees, and an end to rounding. */
static ktg_status tidy(ktg_context *context, ktg_annealing *s, int power) {
    ktg_branch all = {0, 0, s->a->dual->face_count};
    ktg_arrangement_order(s->a);
    KTG_TRY(ktg_arrangement_settle(context, s->a));
    ktg_spread_recount(&s->spread, power);
    s->conflicts = s->soft ? count_conflicts(s->a) : 0;
    return s->tabs && !s->soft ? ktg_seam_tabs_lay(context, s->tabs, &all) : KTG_OK;
}

static void tell(ktg_context *context, ktg_annealing *s, double part) {
    char detail[64];
    if (s->soft)
        snprintf(detail, sizeof detail, "finding a shape for the sheet");
    else if (s->tabs)
        snprintf(detail, sizeof detail, "%u seams want a better tab", s->tabs->unhappy_count);
    else
        snprintf(detail, sizeof detail, "filling the sheet");
    ktg_search_progress(context, s->search, part * s->a->dual->face_count, detail);
}

static void set_temperature(ktg_annealing *s, const phase *p, double done) {
    double unit = 1.0 / s->a->dual->face_count;
    s->temperature = unit * p->hot * pow(p->cold / p->hot, done);
    s->conflict_price = s->temperature * (CONFLICT_FIRST + (CONFLICT_LAST - CONFLICT_FIRST) * done);
    s->tab_price = unit * p->tab_price;
}

static ktg_status run_phase(ktg_context *context, ktg_annealing *s, const phase *p) {
    uint64_t begin = s->work, end = begin + (uint64_t)(p->share * s->budget);
    s->soft = p->soft;
    s->a->gap = s->soft && s->tabs ? GAP * s->wish.height : 0;
    KTG_TRY(tidy(context, s, p->power));
    for (uint64_t step = 1; s->work < end; step++) {
        if (step % LOOK == 1) {
            double done = (double)(s->work - begin) / (double)(end - begin);
            set_temperature(s, p, done);
            tell(context, s, (double)s->work / (double)s->goal->work);
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

static ktg_status start(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                        const bool *folded) {
    uint32_t n = dual->face_count;
    ktg_vec2 region = ktg_mul2(s->half, 1.4);
    KTG_TRY(ktg_arrangement_new(context, dual, folded, region,
                                n + dual->edge_count + dual->forced_count, &s->a));
    KTG_TRY(ktg_spread_new(context, s->a, s->half, &s->spread));
    KTG_TRY(ktg_spread_pose(context, s->a, &s->spread));
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

static void finish(ktg_annealing *s) {
    ktg_leaves_free(&s->leaves);
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
    finish(s);
    KTG_TRY(start(context, s, dual, folded));
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
    finish(s);
    return start(context, s, dual, folded);
}

/* The box around a piece and its tabs. */
static ktg_flat_box box_of(const ktg_annealing *s, uint32_t piece) {
    ktg_flat_box box = ktg_flat_box_empty();
    for (uint32_t i = 0; i < s->a->cells.item_count; i++)
        if (s->a->cells.sheet[i] == piece)
            ktg_flat_box_add(&box, &s->a->cells.boxes[i]);
    return box;
}

/* Moves every piece into the middle of its sheet; how much larger than the sheet the largest is. */
static ktg_status centre(ktg_context *context, ktg_annealing *s, double *excess) {
    *excess = 0;
    for (uint32_t p = 0; p < s->a->piece_count; p++) {
        ktg_flat_box box = box_of(s, p);
        ktg_motion2 shift = {
            1, 0, {-0.5 * ((double)box.x0 + box.x1), -0.5 * ((double)box.y0 + box.y1)}};
        *excess = fmax(*excess, fmax((box.x1 - box.x0) / (2 * s->half.x),
                                     (box.y1 - box.y0) / (2 * s->half.y)));
        KTG_TRY(ktg_arrangement_move(context, s->a, p, shift));
    }
    return KTG_OK;
}

/* Where the scale is free: sheet and tabs as large as they are at the scale that was reached, but
 * for a little. */
static ktg_status rescale(ktg_context *context, ktg_annealing *s) {
    double excess;
    KTG_TRY(centre(context, s, &excess));
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

/* Phases first .. PHASES - 1 with the work of the budget. */
static ktg_status run_phases(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                             size_t first, bool *folded) {
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

/* ---- several starts ------------------------------------------------------------------------- */

/* What a start has come to; `at` are the first two corners of face `anchor`, so that the net can
 * be laid where it lay. */
typedef struct outcome {
    bool *folded;
    double score;
    ktg_vec2 half;
    ktg_seam_tab_wish wish;
    uint32_t anchor;
    ktg_vec2 at[2];
} outcome;

static void set_sheet(ktg_annealing *s, ktg_vec2 half, const ktg_seam_tab_wish *wish) {
    s->half = half;
    if (wish)
        s->wish = *wish;
    s->wish.half = half;
}

/* Large models are good; missing tabs are not. */
static ktg_status score(ktg_context *context, ktg_annealing *s, double *points) {
    double excess;
    KTG_TRY(centre(context, s, &excess));
    double size = s->goal->half.x / (s->half.x * excess);
    *points = size * size - (s->tabs ? PRICE_POINTS * s->tabs->price : 0);
    return KTG_OK;
}

static void keep_better(const ktg_annealing *s, double points, outcome *best) {
    if (points <= best->score)
        return;
    const ktg_arrangement *a = s->a;
    best->score = points;
    best->half = s->half;
    best->wish = s->wish;
    best->anchor = a->order[0];
    memcpy(best->at, a->corners + 3 * (size_t)a->order[0], sizeof best->at);
    memcpy(best->folded, a->folded, a->dual->edge_count * sizeof *best->folded);
}

/* A whole annealing with a part of the work; the better outcome stays in *best. */
static ktg_status try_start(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                            bool *folded, outcome *best) {
    double points;
    set_sheet(s, s->goal->half, s->goal->tabs);
    KTG_TRY(start(context, s, dual, folded));
    KTG_TRY(run_phases(context, s, dual, 0, folded));
    KTG_TRY(score(context, s, &points));
    keep_better(s, points, best);
    finish(s);
    return KTG_OK;
}

/* The best outcome goes on with what is left of the work. */
static ktg_status polish(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                         outcome *best) {
    double points, share = 0;
    for (size_t k = FIRST_RESCALED; k < PHASES; k++)
        share += phases[k].share;
    if (s->work >= s->goal->work)
        return KTG_OK;
    s->budget = (double)(s->goal->work - s->work) / share;
    set_sheet(s, best->half, &best->wish);
    KTG_TRY(start(context, s, dual, best->folded));
    const ktg_vec2 *now = s->a->corners + 3 * (size_t)best->anchor;
    KTG_TRY(ktg_arrangement_move(context, s->a, 0,
                                 ktg_motion2_between(now[0], now[1], best->at[0], best->at[1])));
    if (s->tabs)
        KTG_TRY(ktg_seam_tabs_renew(context, s->tabs, &s->wish));
    KTG_TRY(run_phases(context, s, dual, FIRST_RESCALED, best->folded));
    KTG_TRY(score(context, s, &points));
    keep_better(s, points, best);
    return KTG_OK;
}

static uint32_t starts_for(const ktg_annealing *s, const ktg_dual *dual) {
    double each = START_WORK * dual->face_count;
    double starts = STARTS_PART * (double)s->goal->work / each;
    return s->goal->fixed || starts < 2 ? 1 : starts > MOST_STARTS ? MOST_STARTS : (uint32_t)starts;
}

static ktg_status anneal(ktg_context *context, ktg_annealing *s, const ktg_dual *dual,
                         bool *folded) {
    outcome best = {.folded = ktg_copy_array(context, folded, dual->edge_count, sizeof *folded),
                    .score = -INFINITY};
    uint32_t starts = starts_for(s, dual);
    ktg_status status = best.folded ? KTG_OK : KTG_MEMORY;
    s->budget = (double)s->goal->work * (starts > 1 ? STARTS_PART / starts : 1);
    for (uint32_t k = 0; status == KTG_OK && k < starts; k++)
        if (k == 0 || ktg_search_goes_on(context, s->search))
            status = try_start(context, s, dual, folded, &best);
    if (status == KTG_OK && starts > 1 && ktg_search_goes_on(context, s->search))
        status = polish(context, s, dual, &best);
    if (status == KTG_OK)
        memcpy(folded, best.folded, dual->edge_count * sizeof *folded);
    ktg_free(best.folded);
    return status;
}

ktg_status ktg_arrange(ktg_context *context, const ktg_dual *dual, const ktg_arrange_goal *goal,
                       ktg_search *search, bool *folded) {
    ktg_annealing s = {.goal = goal, .search = search};
    ktg_status status = anneal(context, &s, dual, folded);
    finish(&s);
    return status;
}
