/* unfold/graft_step.h - what every annealing of an arrangement does: draw a graft, try it with its
 * tabs, try another tab (unfold only). */
#ifndef KTG_UNFOLD_GRAFT_STEP_H
#define KTG_UNFOLD_GRAFT_STEP_H

#include "core/random.h"
#include "unfold/seam_tabs.h"

/* The branch below `face`, and a random cut edge on its border with the motion that goes with it.
 * False where the fold is rigid or a few draws found none. */
bool ktg_draw_graft(const ktg_arrangement *a, ktg_random *random, uint32_t face, ktg_branch *branch,
                    ktg_graft *graft);

/* The most a step may cost (Metropolis), drawn beforehand so that looking can end early. */
double ktg_draw_allowance(ktg_random *random, double temperature);

/* Grafts and finds all tabs that the graft touches; takes all back (*done is false) where the
 * tabs, at `tab_price` for a missing one, cost more than `allowed`. saved: scratch. */
KTG_NODISCARD ktg_status ktg_graft_with_tabs(ktg_context *context, ktg_seam_tabs *tabs,
                                             ktg_branch *branch, const ktg_graft *graft,
                                             ktg_saved *saved, double tab_price, double allowed,
                                             bool *done);

/* Another tab for a seam that has none, or not a full one; nothing where all are content. */
KTG_NODISCARD ktg_status ktg_tab_step(ktg_context *context, ktg_seam_tabs *tabs, ktg_random *random,
                                      double tab_price, double temperature);

#endif
