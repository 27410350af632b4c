/* unfold/graft_step.c - drawing grafts, and trying them with their tabs. */
#include "unfold/graft_step.h"
#include "core/memory.h"

/* Draws for a place before a branch is given up. */
#define DRAWS 4

bool ktg_draw_graft(const ktg_arrangement *a, ktg_random *random, uint32_t face, ktg_branch *branch,
                    ktg_graft *graft) {
    uint32_t fold = a->parent_edge[face];
    if (fold == KTG_NONE || a->dual->edges[fold].rigid)
        return false;
    *branch = ktg_branch_at(a, face);
    for (int tries = 0; tries < DRAWS; tries++) {
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

double ktg_draw_allowance(ktg_random *random, double temperature) {
    return -temperature * log(1 - ktg_random_unit(random));
}

ktg_status ktg_graft_with_tabs(ktg_context *context, ktg_seam_tabs *t, ktg_branch *branch,
                               const ktg_graft *graft, ktg_saved *saved, double tab_price,
                               double allowed, bool *done) {
    double most = t->price + allowed / tab_price;
    ktg_seam_tabs_begin(t);
    KTG_TRY(ktg_seam_tabs_damage(context, t, branch, graft));
    ktg_branch_save(t->a, branch, saved);
    KTG_TRY(ktg_arrangement_graft(context, t->a, branch, graft));
    KTG_TRY(ktg_seam_tabs_follow(context, t, branch, graft->edge, saved->fold, most));
    *done = t->price <= most;
    if (*done)
        return KTG_OK;
    KTG_TRY(ktg_arrangement_ungraft(context, t->a, branch, saved));
    KTG_TRY(ktg_seam_tabs_lay(context, t, branch));
    return ktg_seam_tabs_undo(context, t);
}

ktg_status ktg_tab_step(ktg_context *context, ktg_seam_tabs *t, ktg_random *random,
                        double tab_price, double temperature) {
    static const double parts[] = {1, 0.7, 0.4};
    if (t->unhappy_count == 0)
        return KTG_OK;
    uint32_t e = t->unhappy[ktg_random_below(random, t->unhappy_count)];
    double most = t->price + ktg_draw_allowance(random, temperature) / tab_price;
    size_t way = ktg_random_below(random, 4);
    ktg_seam_tabs_begin(t);
    if (way == 3)
        KTG_TRY(ktg_seam_tabs_choose(context, t, e));
    else
        KTG_TRY(
            ktg_seam_tabs_push(context, t, e, (int)ktg_random_below(random, 2), parts[way], most));
    return t->price > most ? ktg_seam_tabs_undo(context, t) : KTG_OK;
}
