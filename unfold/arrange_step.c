/* unfold/arrange_step.c - one step of annealing: a branch goes elsewhere, or a seam gets another
 * tab, and what that costs decides. */
#include "core/memory.h"
#include "unfold/annealing.h"
#include "unfold/graft_step.h"

#include <math.h>

/* One step in so many looks for a tab instead of a place, one in so many for a place that helps a
 * seam without one. */
#define TAB_STEPS    8
#define TARGET_STEPS 4

/* Work of a step besides the faces it looks at, and of an attempt with tabs. */
#define STEP_WORK    4
#define ATTEMPT_WORK 30

/* Whether the overlaps the graft would make are worth `spare`; counts them. */
static bool overlaps_allow(ktg_annealing *s, const ktg_branch *branch, const ktg_graft *graft,
                           double spare) {
    uint32_t more = (uint32_t)fmin(1e6, spare / s->conflict_price);
    uint32_t after = ktg_graft_conflicts(s->a, branch, graft, s->conflicts + more);
    if (after > s->conflicts + more)
        return false;
    uint32_t before = s->conflicts > 0 ? ktg_graft_conflicts(s->a, branch, NULL, s->conflicts) : 0;
    if (after > before + more)
        return false;
    s->conflicts += after - before;
    return true;
}

/* Adds what the graft changes in the distances of copies; false when that is too much. */
static bool distances_allow(ktg_annealing *s, const ktg_branch *branch, const ktg_graft *graft,
                            double allowed, double *change) {
    if (!(s->ease.weight > 0))
        return true;
    s->work += branch->count;
    *change += ktg_ease_distances(&s->ease, branch, graft);
    return *change <= allowed;
}

/* Overlaps have a price; what tabs will cost is told by the cuts. */
static ktg_status soft_step(ktg_context *context, ktg_annealing *s, ktg_branch *branch,
                            const ktg_graft *graft) {
    uint32_t fold = s->a->parent_edge[branch->top];
    double allowed = ktg_draw_allowance(&s->search->random, s->temperature), change = 0;
    if (s->tabs)
        allowed -= s->tab_price * ktg_leaves_exchange(&s->leaves, fold, graft->edge);
    allowed -= ktg_ease_cuts(&s->ease, fold, graft->edge);
    if (!ktg_spread_allows(&s->spread, branch, graft, allowed, &change, &s->work) ||
        !distances_allow(s, branch, graft, allowed, &change) ||
        !overlaps_allow(s, branch, graft, allowed - change)) {
        if (s->tabs)
            (void)ktg_leaves_exchange(&s->leaves, graft->edge, fold);
        return KTG_OK;
    }
    KTG_TRY(ktg_arrangement_graft(context, s->a, branch, graft));
    ktg_spread_follow(&s->spread, branch);
    ktg_ease_follow(&s->ease, fold, graft->edge);
    return KTG_OK;
}

static ktg_status hard_step(ktg_context *context, ktg_annealing *s, ktg_branch *branch,
                            const ktg_graft *graft) {
    double allowed = ktg_draw_allowance(&s->search->random, s->temperature), change = 0;
    double gain = s->tabs ? s->tab_price * s->tabs->tabs[graft->edge].price : 0;
    uint32_t fold = s->a->parent_edge[branch->top];
    allowed -= ktg_ease_cuts(&s->ease, fold, graft->edge);
    if (!ktg_spread_allows(&s->spread, branch, graft, allowed + gain, &change, &s->work) ||
        !distances_allow(s, branch, graft, allowed + gain, &change) ||
        ktg_graft_conflicts(s->a, branch, graft, 0) > 0)
        return KTG_OK;
    bool done = true;
    s->work += s->tabs ? ATTEMPT_WORK : 0;
    if (s->tabs)
        KTG_TRY(ktg_graft_with_tabs(context, s->tabs, branch, graft, &s->saved, s->tab_price,
                                    allowed - change, &done));
    else
        KTG_TRY(ktg_arrangement_graft(context, s->a, branch, graft));
    if (done) {
        ktg_spread_follow(&s->spread, branch);
        ktg_ease_follow(&s->ease, fold, graft->edge);
    }
    return KTG_OK;
}

ktg_status ktg_annealing_step(ktg_context *context, ktg_annealing *s, uint64_t step) {
    ktg_branch branch;
    ktg_graft graft;
    bool real_tabs = s->tabs && !s->soft;
    s->work += STEP_WORK;
    if (real_tabs && step % TAB_STEPS == 0) {
        s->work += s->tabs->unhappy_count > 0 ? ATTEMPT_WORK : 0;
        return ktg_tab_step(context, s->tabs, &s->search->random, s->tab_price, s->temperature);
    }
    bool for_tabs = real_tabs && s->tabs->unhappy_count > 0 && step % TARGET_STEPS == 1;
    if (for_tabs ? !ktg_annealing_draw_for_tabs(s, &branch, &graft)
                 : !ktg_annealing_draw(s, &branch, &graft))
        return KTG_OK;
    return s->soft ? soft_step(context, s, &branch, &graft)
                   : hard_step(context, s, &branch, &graft);
}
