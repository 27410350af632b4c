/* unfold/arrange_step.c - one step of annealing: a branch goes elsewhere, or a seam gets another
 * tab, and what that costs decides. */
#include "core/memory.h"
#include "unfold/annealing.h"

#include <math.h>

/* One step in so many looks for a tab instead of a place, one in so many for a place that helps a
 * seam without one. */
#define TAB_STEPS    8
#define TARGET_STEPS 4

/* Work of a step besides the faces it looks at, and of an attempt with tabs. */
#define STEP_WORK    4
#define ATTEMPT_WORK 30

/* The most a step may cost (Metropolis), drawn beforehand so that looking can end early. */
static double draw_allowance(ktg_annealing *s) {
    return -s->temperature * log(1 - ktg_random_unit(&s->search->random));
}

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

/* Overlaps have a price; what tabs will cost is told by the cuts. */
static ktg_status soft_step(ktg_context *context, ktg_annealing *s, ktg_branch *branch,
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
static ktg_status attempt_with_tabs(ktg_context *context, ktg_annealing *s, ktg_branch *branch,
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

static ktg_status hard_step(ktg_context *context, ktg_annealing *s, ktg_branch *branch,
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
static ktg_status tab_step(ktg_context *context, ktg_annealing *s) {
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

ktg_status ktg_annealing_step(ktg_context *context, ktg_annealing *s, uint64_t step) {
    ktg_branch branch;
    ktg_graft graft;
    bool real_tabs = s->tabs && !s->soft;
    s->work += STEP_WORK;
    if (real_tabs && step % TAB_STEPS == 0)
        return tab_step(context, s);
    bool for_tabs = real_tabs && s->tabs->unhappy_count > 0 && step % TARGET_STEPS == 1;
    if (for_tabs ? !ktg_annealing_draw_for_tabs(s, &branch, &graft)
                 : !ktg_annealing_draw(s, &branch, &graft))
        return KTG_OK;
    return s->soft ? soft_step(context, s, &branch, &graft)
                   : hard_step(context, s, &branch, &graft);
}
