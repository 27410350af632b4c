/* unfold/sheet_fill.c - annealing several pieces into their sheets. */
#include "unfold/sheet_fill.h"
#include "core/memory.h"
#include "unfold/crease.h"
#include "unfold/ease.h"
#include "unfold/goal.h"
#include "unfold/graft_step.h"
#include "unfold/sheet_check.h"
#include "unfold/sheet_room.h"
#include "unfold/spread.h"

#include <stdio.h>
#include <string.h>

/* Prices beside a corner that stands out by a mean edge, which costs 2 (sheet_room.h): of a border
 * between pieces as long as a mean edge, less along a crease; of any cut as long; of a piece of no
 * size; of a face beyond the number allowed. */
#define BORDER_PRICE 0.20
#define CREASE_OFF   0.75
#define CUT_PRICE    0.04
#define TINY_PRICE   4.0
#define FACE_PRICE   0.5

/* Weight of what is hard to glue, for a weight of 1 in the options and each face. */
#define EASE 0.25

/* Pieces below this part of the mean area count as tiny. */
#define TINY 0.5

/* Steps between two tidyings, and between two looks at the clock; one step in so many looks for a
 * tab; work as in unfold/arrange.c. */
#define TIDY         16384
#define LOOK         256
#define TAB_STEPS    8
#define STEP_WORK    4
#define ATTEMPT_WORK 30

/* Part of a tab that pieces keep from the sheet's edge at first. Where that is not enough the
 * margin grows, in so many rounds at most. */
#define MARGIN 0.5
#define ROUNDS 6

/* Annealing also goes on while more than this part of the seam edges lack a tab. */
#define FEW_MISSING 0.005

typedef struct phase {
    double hot, cold; /* temperatures */
    double tab_price;
    double share; /* of the work */
} phase;

typedef struct filling {
    const ktg_dual *dual;
    const ktg_unfold_options *options;
    const ktg_sheet_fill *fill;
    ktg_search *search;
    ktg_seam_tab_wish wish;
    bool wants_tabs;
    ktg_arrangement *a;
    ktg_sheet_room room;
    ktg_seam_tabs *tabs; /* NULL in the first phase */
    ktg_ease ease;
    ktg_saved saved;
    double *area;       /* face_count */
    double *border;     /* edge_count: price as a border between pieces */
    double *cut;        /* edge_count: price as a cut */
    double *piece_area; /* piece_count */
    uint32_t *piece_faces;
    double mean_area;
    double temperature, tab_price;
    uint64_t work;
    bool *kept;     /* edge_count: the best pieces that fit, ... */
    double missing; /* ... and which part of their seam edges lacks a tab; 2: none fit yet */
} filling;

/* ---- what a graft costs besides room and tabs ----------------------------------------------- */

static double tiny_price(const filling *s, double area) {
    double lacks = 1 - area / (TINY * s->mean_area);
    return lacks > 0 ? TINY_PRICE * lacks * lacks : 0;
}

static double crowd_price(const filling *s, uint32_t faces) {
    uint32_t most = s->options->piece_faces;
    return most > 0 && faces > most ? FACE_PRICE * (faces - most) : 0;
}

/* What the borders change when the branch goes over to another piece. */
static double border_change(const filling *s, const ktg_branch *branch, uint32_t from,
                            uint32_t to) {
    const ktg_arrangement *a = s->a;
    double change = 0;
    for (uint32_t i = 0; i < branch->count; i++)
        for (uint32_t h = 3 * a->order[branch->first + i], end = h + 3; h < end; h++) {
            uint32_t e = a->dual->halfedge_edge[h];
            if (e == KTG_NONE)
                continue;
            uint32_t face = ktg_arrangement_across(a, e, h) / 3;
            if (!ktg_branch_holds(a, branch, face))
                change += s->border[e] * ((a->piece[face] != to) - (a->piece[face] != from));
        }
    return change;
}

static double branch_area(const filling *s, const ktg_branch *branch) {
    double area = 0;
    for (uint32_t i = 0; i < branch->count; i++)
        area += s->area[s->a->order[branch->first + i]];
    return area;
}

static double size_change(const filling *s, const ktg_branch *branch, uint32_t from, uint32_t to) {
    double area = branch_area(s, branch);
    uint32_t count = branch->count;
    return tiny_price(s, s->piece_area[from] - area) - tiny_price(s, s->piece_area[from]) +
           tiny_price(s, s->piece_area[to] + area) - tiny_price(s, s->piece_area[to]) +
           crowd_price(s, s->piece_faces[from] - count) - crowd_price(s, s->piece_faces[from]) +
           crowd_price(s, s->piece_faces[to] + count) - crowd_price(s, s->piece_faces[to]);
}

static double shape_change(const filling *s, const ktg_branch *branch, const ktg_graft *graft) {
    uint32_t from = s->a->piece[branch->top], to = s->a->piece[graft->other / 3];
    double change = s->cut[s->a->parent_edge[branch->top]] - s->cut[graft->edge];
    if (from != to)
        change += border_change(s, branch, from, to) + size_change(s, branch, from, to);
    return change;
}

static void count_over(filling *s, const ktg_branch *branch, uint32_t from, uint32_t to) {
    double area = branch_area(s, branch);
    s->piece_area[from] -= area;
    s->piece_area[to] += area;
    s->piece_faces[from] -= branch->count;
    s->piece_faces[to] += branch->count;
}

/* ---- steps ---------------------------------------------------------------------------------- */

static ktg_status graft_step(ktg_context *context, filling *s, ktg_branch *branch,
                             const ktg_graft *graft) {
    uint32_t from = s->a->piece[branch->top], to = s->a->piece[graft->other / 3];
    uint32_t fold = s->a->parent_edge[branch->top];
    double allowed = ktg_draw_allowance(&s->search->random, s->temperature) -
                     shape_change(s, branch, graft) - ktg_ease_cuts(&s->ease, fold, graft->edge) -
                     ktg_ease_distances(&s->ease, branch, graft),
           change = 0;
    double gain = s->tabs ? s->tab_price * s->tabs->tabs[graft->edge].price : 0;
    bool done = true;
    if (!ktg_sheet_room_allows(&s->room, branch, graft, allowed + gain, &change, &s->work) ||
        ktg_graft_conflicts(s->a, branch, graft, 0) > 0)
        return KTG_OK;
    s->work += s->tabs ? ATTEMPT_WORK : 0;
    if (s->tabs)
        KTG_TRY(ktg_graft_with_tabs(context, s->tabs, branch, graft, &s->saved, s->tab_price,
                                    allowed - change, &done));
    else
        KTG_TRY(ktg_arrangement_graft(context, s->a, branch, graft));
    if (!done)
        return KTG_OK;
    ktg_sheet_room_follow(&s->room, branch);
    ktg_ease_follow(&s->ease, fold, graft->edge);
    if (from != to)
        count_over(s, branch, from, to);
    return KTG_OK;
}

static ktg_status take_step(ktg_context *context, filling *s, uint64_t step) {
    ktg_branch branch;
    ktg_graft graft;
    s->work += STEP_WORK;
    if (s->tabs && step % TAB_STEPS == 0) {
        s->work += s->tabs->unhappy_count > 0 ? ATTEMPT_WORK : 0;
        return ktg_tab_step(context, s->tabs, &s->search->random, s->tab_price, s->temperature);
    }
    size_t face = ktg_random_below(&s->search->random, s->a->dual->face_count);
    if (!ktg_draw_graft(s->a, &s->search->random, (uint32_t)face, &branch, &graft))
        return KTG_OK;
    return graft_step(context, s, &branch, &graft);
}

/* ---- phases --------------------------------------------------------------------------------- */

/* Roots in the middle of their trees, pieces in the middle of their sheets, an end to rounding. */
static ktg_status tidy(ktg_context *context, filling *s) {
    ktg_branch all = {0, 0, s->dual->face_count};
    ktg_arrangement_order(s->a);
    KTG_TRY(ktg_arrangement_settle(context, s->a));
    KTG_TRY(ktg_sheet_room_pose(context, s->a, &s->room));
    return s->tabs ? ktg_seam_tabs_lay(context, s->tabs, &all) : KTG_OK;
}

static void tell(ktg_context *context, filling *s) {
    char detail[64];
    uint32_t over;
    (void)ktg_sheet_room_over(&s->room, NULL, &over);
    snprintf(detail, sizeof detail, "%u pieces, %u still too large", s->a->piece_count, over);
    double done = fmin(1, (double)s->work / s->fill->work);
    double part = s->fill->progress_from + (s->fill->progress_to - s->fill->progress_from) * done;
    ktg_search_progress(context, s->search, part * s->dual->face_count, detail);
}

static ktg_status run_phase(ktg_context *context, filling *s, const phase *p) {
    uint64_t begin = s->work, end = begin + (uint64_t)(p->share * s->fill->work);
    s->tab_price = p->tab_price;
    KTG_TRY(tidy(context, s));
    for (uint64_t step = 1; s->work < end; step++) {
        if (step % LOOK == 1) {
            double done = (double)(s->work - begin) / (double)(end - begin);
            s->temperature = p->hot * pow(p->cold / p->hot, done);
            if (!ktg_search_goes_on(context, s->search))
                break;
        }
        if (step % TIDY == 0) {
            KTG_TRY(tidy(context, s));
            tell(context, s);
        }
        KTG_TRY(take_step(context, s, step));
    }
    return tidy(context, s);
}

/* ---- does it fit? --------------------------------------------------------------------------- */

/* Pieces that the check found too large get a larger margin. */
static void widen_margins(filling *s, const ktg_sheet_check *check) {
    for (uint32_t f = 0; f < s->dual->face_count; f++) {
        double *magnification = &check->magnification[check->piece[f]];
        if (*magnification >= 1)
            continue;
        double over = (1 / *magnification - 1) * fmax(s->room.half.x, s->room.half.y);
        s->room.margin[s->a->piece[f]] += fmin(over, 3 / s->fill->mm) + 0.3 / s->fill->mm;
        *magnification = 1; /* once for each piece */
    }
}

/* Keeps the pieces as they are where they fit and have the fewest seams without a tab so far. */
static ktg_status check_fit(ktg_context *context, filling *s) {
    ktg_sheet_check check;
    KTG_TRY(ktg_sheet_check_run(context, s->dual, s->options, s->fill->mm, s->a->folded,
                                s->search->careful, &check));
    bool fits = check.too_many == 0 && (!s->fill->fixed_size || check.too_large == 0);
    double missing = check.tabs_wanted > 0 ? (double)check.tabs_none / check.tabs_wanted : 0;
    if (fits && missing < s->missing) {
        s->missing = missing;
        memcpy(s->kept, s->a->folded, s->dual->edge_count * sizeof *s->kept);
    }
    if (s->fill->fixed_size)
        widen_margins(s, &check);
    ktg_sheet_check_free(&check);
    return KTG_OK;
}

static ktg_status begin_tabs(ktg_context *context, filling *s) {
    if (!s->wants_tabs)
        return KTG_OK;
    KTG_TRY(ktg_seam_tabs_new(context, s->a, &s->wish, &s->tabs));
    return ktg_seam_tabs_renew(context, s->tabs, &s->wish);
}

/* Whether what stands out after the first phase is more than the second can bring in. */
static bool is_hopeless(const filling *s) {
    uint32_t pieces;
    double over = ktg_sheet_room_over(&s->room, NULL, &pieces);
    return s->fill->fixed_size && over > 1.5 * s->a->piece_count;
}

static ktg_status anneal(ktg_context *context, filling *s) {
    static const phase shape = {0.4, 0.05, 0, 0.4}, tabs = {0.25, 0.02, 1, 0.4},
                       again = {0.3, 0.02, 1, 0.1}, polish = {0.2, 0.02, 1.5, 0.15};
    KTG_TRY(run_phase(context, s, &shape));
    if (is_hopeless(s))
        return KTG_OK;
    KTG_TRY(begin_tabs(context, s));
    KTG_TRY(run_phase(context, s, &tabs));
    for (int round = 0;; round++) {
        KTG_TRY(check_fit(context, s));
        if (s->missing <= FEW_MISSING || round == ROUNDS || !ktg_search_goes_on(context, s->search))
            return KTG_OK;
        ktg_sheet_room_recount(&s->room);
        KTG_TRY(run_phase(context, s, s->missing <= 1 ? &polish : &again));
    }
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status price_edges(ktg_context *context, filling *s) {
    s->border = ktg_new(context, s->dual->edge_count, double);
    s->cut = ktg_new(context, s->dual->edge_count, double);
    if (!s->border || !s->cut)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < s->dual->edge_count; e++) {
        const ktg_dual_edge *edge = &s->dual->edges[e];
        double length = edge->length / s->room.unit;
        double crease = fmin(1, 2 * ktg_dual_crease(s->dual, edge));
        s->border[e] = BORDER_PRICE * length * (1 - CREASE_OFF * crease);
        s->cut[e] = CUT_PRICE * length;
    }
    return KTG_OK;
}

static ktg_status measure_pieces(ktg_context *context, filling *s) {
    s->area = ktg_new(context, s->dual->face_count, double);
    s->piece_area = ktg_new(context, s->a->piece_count, double);
    s->piece_faces = ktg_new(context, s->a->piece_count, uint32_t);
    if (!s->area || !s->piece_area || !s->piece_faces)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < s->dual->face_count; f++) {
        const ktg_vec2 *p = s->dual->flat + 3 * (size_t)f;
        s->area[f] = 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
        s->piece_area[s->a->piece[f]] += s->area[f];
        s->piece_faces[s->a->piece[f]]++;
    }
    s->mean_area = ktg_dual_area(s->dual) / s->a->piece_count;
    return KTG_OK;
}

static ktg_status start(ktg_context *context, filling *s, const bool *folded) {
    uint32_t n = s->dual->face_count;
    s->wants_tabs = ktg_goal_tabs(s->options, s->fill->mm, &s->wish);
    KTG_TRY(ktg_arrangement_new(context, s->dual, folded, ktg_mul2(s->fill->half, 1.4), &s->a));
    KTG_TRY(ktg_sheet_room_new(context, s->a, s->fill->half,
                               s->wants_tabs ? MARGIN * s->wish.height : 0, &s->room));
    KTG_TRY(ktg_ease_new(context, s->a, EASE * n * s->options->ease, s->fill->half,
                         s->options->finish.tab_edge_mm / s->fill->mm, &s->ease));
    KTG_TRY(price_edges(context, s));
    KTG_TRY(measure_pieces(context, s));
    s->saved = (ktg_saved){.faces = ktg_new(context, n, uint32_t),
                           .corners = ktg_new(context, 3 * (size_t)n, ktg_vec2),
                           .turns = ktg_new(context, n, ktg_vec2)};
    s->kept = ktg_new(context, s->dual->edge_count, bool);
    s->missing = 2;
    return s->kept && s->saved.faces && s->saved.corners && s->saved.turns ? KTG_OK : KTG_MEMORY;
}

static void finish(filling *s) {
    ktg_seam_tabs_free(&s->tabs);
    ktg_sheet_room_free(&s->room);
    ktg_ease_free(&s->ease);
    ktg_arrangement_free(&s->a);
    ktg_free(s->area);
    ktg_free(s->border);
    ktg_free(s->cut);
    ktg_free(s->piece_area);
    ktg_free(s->piece_faces);
    ktg_free(s->saved.faces);
    ktg_free(s->saved.corners);
    ktg_free(s->saved.turns);
    ktg_free(s->kept);
}

ktg_status ktg_sheet_fill_run(ktg_context *context, const ktg_dual *dual,
                              const ktg_unfold_options *options, const ktg_sheet_fill *fill,
                              ktg_search *search, bool *folded, bool *fits) {
    filling s = {.dual = dual, .options = options, .fill = fill, .search = search};
    ktg_status status = start(context, &s, folded);
    if (status == KTG_OK)
        status = anneal(context, &s);
    *fits = s.missing <= 1;
    if (status == KTG_OK)
        memcpy(folded, *fits ? s.kept : s.a->folded, dual->edge_count * sizeof *folded);
    finish(&s);
    return status;
}
