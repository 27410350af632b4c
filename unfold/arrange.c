/* unfold/arrange.c - annealing pieces towards their sheets. */
#include "unfold/arrange.h"
#include "core/memory.h"
#include "unfold/leaves.h"
#include "unfold/net.h"
#include "unfold/spread.h"
#include "unfold/transplant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static double P(const char *n, double d) { const char *s = getenv(n); return s ? atof(s) : d; }

/* Temperatures and prices are in parts of what one average face costs at the edge of its sheet. */
typedef struct phase {
    bool soft;            /* faces may overlap, at a price; tabs are only foreseen */
    double hot, cold;     /* the temperature falls geometrically */
    double tab_price;     /* of a seam without a tab */
    double share;         /* of the work */
} phase;

/* An overlapping pair of faces costs this many temperatures at the beginning and at the end. */
#define CONFLICT_FIRST 0.5
#define CONFLICT_LAST  5.0

/* Steps between two tidyings, and between two looks at the clock. */
#define TIDY 65536
#define LOOK 256

/* One step in so many looks for a tab instead of a place. */
#define TAB_STEPS 8

/* Work of a step besides the faces it looks at, and of an attempt with tabs. */
#define STEP_WORK    4
#define ATTEMPT_WORK 30

/* Steps that may end without a new least number of overlaps when those left are taken away. */
#define PATIENCE 20000

typedef struct anneal {
    const ktg_arrange_goal *goal;
    ktg_search *search;
    ktg_vec2 half;          /* as the goal's; where the scale is free, what was reached */
    ktg_seam_tab_wish wish; /* likewise */
    ktg_arrangement *a;
    ktg_spread spread;
    ktg_seam_tabs *tabs;
    ktg_leaves leaves;
    ktg_saved saved;
    bool soft;
    double unit;           /* what an average face costs at the edge of its sheet */
    double temperature, tab_price, conflict_price;
    uint32_t conflicts;    /* overlapping pairs */
    uint64_t work, until;  /* done, and where the phase ends */
    double progress_from, progress_to;
} anneal;

/* ---- steps ---------------------------------------------------------------------------------- */

/* A random branch and a random cut edge on its border. */
static bool draw_graft(const anneal *s, ktg_branch *branch, ktg_graft *graft) {
    const ktg_arrangement *a = s->a;
    ktg_random *random = &s->search->random;
    uint32_t face = (uint32_t)ktg_random_below(random, a->dual->face_count);
    uint32_t fold = a->parent_edge[face];
    if (fold == KTG_NONE || a->dual->edges[fold].rigid)
        return false;
    *branch = ktg_branch_at(a, face);
    for (int tries = 0; tries < 4; tries++) {
        uint32_t f = a->order[branch->first + ktg_random_below(random, branch->count)];
        uint32_t own = 3 * f + (uint32_t)ktg_random_below(random, 3);
        uint32_t e = a->dual->halfedge_edge[own];
        if (e == KTG_NONE || a->folded[e])
            continue;
        uint32_t other = ktg_arrangement_across(a, e, own);
        if (ktg_branch_holds(a, branch, other / 3))
            continue;
        *graft = (ktg_graft){.edge = e, .own = own, .other = other};
        ktg_graft_motion(a, graft);
        return true;
    }
    return false;
}

/* The most a step may cost (Metropolis), drawn beforehand so that looking can end early. */
static double draw_allowance(anneal *s) {
    return -s->temperature * log(1 - ktg_random_unit(&s->search->random));
}

/* Whether the overlaps the graft would make are worth `spare`; counts them. */
static bool overlaps_allow(anneal *s, const ktg_branch *branch, const ktg_graft *graft,
                           double spare) {
    uint32_t more = (uint32_t)fmin(1e6, spare / s->conflict_price);
    uint32_t after = ktg_graft_conflicts(s->a, branch, graft, s->conflicts + more);
    if (after > s->conflicts + more)
        return false;
    uint32_t before =
        s->conflicts > 0 ? ktg_graft_conflicts(s->a, branch, NULL, s->conflicts) : 0;
    if (after > before + more)
        return false;
    s->conflicts += after - before;
    return true;
}

/* Overlaps have a price; what tabs will cost is told by the cuts. */
static ktg_status soft_step(ktg_context *context, anneal *s, ktg_branch *branch,
                            const ktg_graft *graft) {
    uint32_t fold = s->a->parent_edge[branch->top];
    double allowed = draw_allowance(s), change = 0;
    if (s->tabs)
        allowed -= s->tab_price * ktg_leaves_exchange(&s->leaves, fold, graft->edge);
    if (!ktg_spread_allows(&s->spread, branch, graft, allowed, &change, &s->work) ||
        !overlaps_allow(s, branch, graft, allowed - change)) {
        if (s->tabs)
            (void)ktg_leaves_exchange(&s->leaves, graft->edge, fold);
        return KTG_OK;
    }
    KTG_TRY(ktg_arrangement_graft(context, s->a, branch, graft));
    ktg_spread_follow(&s->spread, branch);
    return KTG_OK;
}

/* Grafts and finds all tabs that the graft touches; takes all back where that costs too much. */
static ktg_status attempt_with_tabs(ktg_context *context, anneal *s, ktg_branch *branch,
                                    const ktg_graft *graft, double allowed) {
    double price = s->tabs->price;
    s->work += ATTEMPT_WORK;
    ktg_seam_tabs_begin(s->tabs);
    KTG_TRY(ktg_seam_tabs_damage(context, s->tabs, branch, graft));
    ktg_branch_save(s->a, branch, &s->saved);
    KTG_TRY(ktg_arrangement_graft(context, s->a, branch, graft));
    KTG_TRY(ktg_seam_tabs_follow(context, s->tabs, branch, graft->edge, s->saved.fold));
    if (s->tab_price * (s->tabs->price - price) > allowed) {
        KTG_TRY(ktg_arrangement_ungraft(context, s->a, branch, &s->saved));
        KTG_TRY(ktg_seam_tabs_lay(context, s->tabs, branch));
        return ktg_seam_tabs_undo(context, s->tabs);
    }
    ktg_spread_follow(&s->spread, branch);
    return KTG_OK;
}

static ktg_status hard_step(ktg_context *context, anneal *s, ktg_branch *branch,
                            const ktg_graft *graft) {
    double allowed = draw_allowance(s), change = 0;
    double gain = s->tabs ? s->tab_price * s->tabs->tabs[graft->edge].price : 0;
    if (!ktg_spread_allows(&s->spread, branch, graft, allowed + gain, &change, &s->work) ||
        ktg_graft_conflicts(s->a, branch, graft, 0) > 0)
        return KTG_OK;
    if (s->tabs)
        return attempt_with_tabs(context, s, branch, graft, allowed - change);
    KTG_TRY(ktg_arrangement_graft(context, s->a, branch, graft));
    ktg_spread_follow(&s->spread, branch);
    return KTG_OK;
}

/* Another tab for a seam that has none, or not a full one. */
static ktg_status tab_step(ktg_context *context, anneal *s) {
    static const double parts[] = {1, 0.7, 0.4};
    ktg_seam_tabs *t = s->tabs;
    ktg_random *random = &s->search->random;
    if (t->unhappy_count == 0)
        return KTG_OK;
    uint32_t e = t->unhappy[ktg_random_below(random, t->unhappy_count)];
    double price = t->price, allowed = draw_allowance(s);
    size_t way = ktg_random_below(random, 4);
    s->work += ATTEMPT_WORK;
    ktg_seam_tabs_begin(t);
    if (way == 3)
        KTG_TRY(ktg_seam_tabs_choose(context, t, e));
    else
        KTG_TRY(ktg_seam_tabs_push(context, t, e, (int)ktg_random_below(random, 2), parts[way]));
    return s->tab_price * (t->price - price) > allowed ? ktg_seam_tabs_undo(context, t) : KTG_OK;
}

static ktg_status take_step(ktg_context *context, anneal *s, uint64_t step) {
    ktg_branch branch;
    ktg_graft graft;
    s->work += STEP_WORK;
    if (s->tabs && !s->soft && step % TAB_STEPS == 0)
        return tab_step(context, s);
    if (!draw_graft(s, &branch, &graft))
        return KTG_OK;
    return s->soft ? soft_step(context, s, &branch, &graft)
                   : hard_step(context, s, &branch, &graft);
}

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
static ktg_status tidy(ktg_context *context, anneal *s, int power) {
    ktg_branch all = {0, 0, s->a->dual->face_count};
    ktg_arrangement_order(s->a);
    KTG_TRY(ktg_arrangement_settle(context, s->a));
    ktg_spread_recount(&s->spread, power);
    s->conflicts = s->soft ? count_conflicts(s->a) : 0;
    return s->tabs && !s->soft ? ktg_seam_tabs_lay(context, s->tabs, &all) : KTG_OK;
}

static void tell(ktg_context *context, anneal *s, double done) {
    char detail[64];
    double part = s->progress_from + (s->progress_to - s->progress_from) * done;
    if (s->soft)
        snprintf(detail, sizeof detail, "finding a shape for the sheet");
    else if (s->tabs)
        snprintf(detail, sizeof detail, "%u seams want a better tab", s->tabs->unhappy_count);
    else
        snprintf(detail, sizeof detail, "filling the sheet");
    ktg_search_progress(context, s->search, part * s->a->dual->face_count, detail);
}

/* The spread's power rises while the temperature falls. */
static int power_at(const phase *p, double done) {
    return p->soft || done < P("S1",0.3) ? 4 : done < P("S2",0.6) ? 8 : 16;
}

static ktg_status run_phase(ktg_context *context, anneal *s, const phase *p) {
    uint64_t begin = s->work, end = begin + (uint64_t)(p->share * (double)s->goal->work);
    double hot = p->hot * s->unit, cold = p->cold * s->unit;
    s->soft = p->soft;
    s->a->gap = s->soft && s->tabs ? P("GAP", 0.5) * s->wish.height : 0;
    s->tab_price = p->tab_price * s->unit;
    KTG_TRY(tidy(context, s, 4));
    for (uint64_t step = 1; s->work < end; step++) {
        if (step % LOOK == 1) {
            double done = (double)(s->work - begin) / (double)(end - begin);
            s->temperature = hot * pow(cold / hot, done);
            s->conflict_price =
                s->temperature * (CONFLICT_FIRST + (CONFLICT_LAST - CONFLICT_FIRST) * done);
            if (power_at(p, done) != s->spread.power)
                ktg_spread_recount(&s->spread, power_at(p, done));
            tell(context, s, done);
            if (!ktg_search_goes_on(context, s->search))
                break;
        }
        if (step % TIDY == 0)
            KTG_TRY(tidy(context, s, s->spread.power));
        KTG_TRY(take_step(context, s, step));
    }
    return KTG_OK;
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status start(ktg_context *context, anneal *s, const ktg_dual *dual, const bool *folded) {
    uint32_t n = dual->face_count;
    ktg_vec2 region = ktg_mul2(s->half, 1.4);
    KTG_TRY(ktg_arrangement_new(context, dual, folded, region,
                                n + dual->edge_count + dual->forced_count, &s->a));
    KTG_TRY(ktg_spread_new(context, s->a, s->half, &s->spread));
    KTG_TRY(ktg_spread_pose(context, s->a, &s->spread));
    s->unit = 1.0 / n;
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

static void finish(anneal *s) {
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
static ktg_status resolve(ktg_context *context, anneal *s, const ktg_dual *dual, bool *folded,
                          bool *resolved) {
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

static ktg_status soften(ktg_context *context, anneal *s, const ktg_dual *dual, const phase *p,
                         bool *folded) {
    bool resolved = true;
    KTG_TRY(run_phase(context, s, p));
    fprintf(stderr, "soft spread %g conflicts %u leaves %g\n", s->spread.total, s->conflicts, s->leaves.price);
    if (s->conflicts > 0 && s->a->piece_count == 1)
        KTG_TRY(resolve(context, s, dual, folded, &resolved));
    else if (s->conflicts > 0)
        resolved = false;
    s->conflicts = 0;
    if (resolved)
        return KTG_OK;
    uint64_t work = s->work; /* back to the beginning */
    finish(s);
    KTG_TRY(start(context, s, dual, folded));
    s->work = work;
    return KTG_OK;
}

/* The box around a piece and its tabs. */
static ktg_flat_box box_of(const anneal *s, uint32_t piece) {
    ktg_flat_box box = ktg_flat_box_empty();
    for (uint32_t i = 0; i < s->a->cells.item_count; i++)
        if (s->a->cells.sheet[i] == piece)
            ktg_flat_box_add(&box, &s->a->cells.boxes[i]);
    return box;
}

/* Moves every piece into the middle of its sheet; how much larger than the sheet the largest is. */
static ktg_status centre(ktg_context *context, anneal *s, double *excess) {
    *excess = 0;
    for (uint32_t p = 0; p < s->a->piece_count; p++) {
        ktg_flat_box box = box_of(s, p);
        ktg_motion2 shift = {1, 0, {-0.5 * ((double)box.x0 + box.x1), -0.5 * ((double)box.y0 + box.y1)}};
        *excess = fmax(*excess, fmax((box.x1 - box.x0) / (2 * s->half.x),
                                     (box.y1 - box.y0) / (2 * s->half.y)));
        KTG_TRY(ktg_arrangement_move(context, s->a, p, shift));
    }
    return KTG_OK;
}

/* Where the scale is free: sheet and tabs as large as they are at the scale that was reached, but
 * for a `squeeze`. */
static ktg_status rescale(ktg_context *context, anneal *s, double squeeze) {
    double excess;
    KTG_TRY(centre(context, s, &excess));
    if (s->goal->fixed)
        return KTG_OK;
    fprintf(stderr, "excess %g spread %g price %g\n", excess, s->spread.total, s->tabs ? s->tabs->price : 0);
    double by = excess * squeeze;
    s->half = ktg_mul2(s->half, by);
    s->spread.per = (ktg_vec2){1 / s->half.x, 1 / s->half.y};
    s->wish.height *= by;
    s->wish.least *= by;
    s->wish.edge *= by;
    s->wish.inset *= by;
    s->wish.air *= by;
    return KTG_OK;
}

static ktg_status harden(ktg_context *context, anneal *s, const phase *p, double squeeze) {
    KTG_TRY(rescale(context, s, squeeze));
    if (s->tabs)
        KTG_TRY(ktg_seam_tabs_renew(context, s->tabs, &s->wish));
    s->progress_from = s->progress_to;
    s->progress_to += p->share;
    return run_phase(context, s, p);
}

static ktg_status anneal_all(ktg_context *context, anneal *s, const ktg_dual *dual, bool *folded) {
    phase soft = {true, P("SHOT", 20), P("SCOLD", 0.5), P("SLAM", 10), P("SOFT", 0.25)};
    phase hard = {false, P("HOT", 2), P("COLD", 0.2), P("LAM", 6), P("HARD", 0.5)};
    phase last = {false, P("LHOT", 0.5), P("LCOLD", 0.1), P("LLAM", 10), P("LAST", 0.25)};
    s->half = s->goal->half;
    if (s->goal->tabs)
        s->wish = *s->goal->tabs;
    KTG_TRY(start(context, s, dual, folded));
    s->progress_to = soft.share;
    KTG_TRY(soften(context, s, dual, &soft, folded));
    if (s->tabs)
        KTG_TRY(ktg_seam_tabs_renew(context, s->tabs, &s->wish));
    s->progress_from = soft.share;
    s->progress_to = soft.share + hard.share;
    KTG_TRY(run_phase(context, s, &hard));
    KTG_TRY(harden(context, s, &last, P("SQ", 0.98)));
    double e; KTG_TRY(centre(context, s, &e));
    fprintf(stderr, "end excess %g spread %g price %g\n", e, s->spread.total, s->tabs ? s->tabs->price : 0);
    memcpy(folded, s->a->folded, dual->edge_count * sizeof *folded);
    return KTG_OK;
}

ktg_status ktg_arrange(ktg_context *context, const ktg_dual *dual, const ktg_arrange_goal *goal,
                       ktg_search *search, bool *folded) {
    anneal s = {.goal = goal, .search = search};
    ktg_status status = anneal_all(context, &s, dual, folded);
    finish(&s);
    return status;
}
