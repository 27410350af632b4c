/* unfold/annealing.h - the state of ktg_arrange and its steps (unfold/arrange*.c only). */
#ifndef KTG_UNFOLD_ANNEALING_H
#define KTG_UNFOLD_ANNEALING_H

#include "unfold/arrange.h"
#include "unfold/ease.h"
#include "unfold/leaves.h"
#include "unfold/spread.h"

typedef struct ktg_annealing {
    const ktg_arrange_goal *goal;
    ktg_search *search;
    ktg_vec2 half;          /* as the goal's; where the scale is free, what was reached */
    ktg_seam_tab_wish wish; /* likewise */
    ktg_arrangement *a;
    ktg_spread spread;
    ktg_seam_tabs *tabs; /* NULL: none are wished for */
    ktg_leaves leaves;
    ktg_ease ease;
    ktg_saved saved;
    bool soft; /* faces may overlap, at a price, and tabs are only foreseen */
    double temperature, tab_price, conflict_price;
    uint32_t conflicts;         /* overlapping pairs */
    uint64_t work, work_before; /* of this annealing, and what others of the same goal count for */
    double budget, per_share;   /* the work there is for all phases, and for a share of 1 */
    double fill; /* the part of the sheets that is filled, as it was last looked at */
} ktg_annealing;

/* Lays the net of `folded` flat, with what the goal, `half` and `wish` ask for (arrange_phases.c).
 */
KTG_NODISCARD ktg_status ktg_annealing_open(ktg_context *context, ktg_annealing *s,
                                            const ktg_dual *dual, const bool *folded);
void ktg_annealing_close(ktg_annealing *s);

/* All phases with the work of the budget, or, where the pieces have their shape, only those that
 * refine it. folded: the net to go back to where faces that overlapped cannot be parted. */
KTG_NODISCARD ktg_status ktg_annealing_run(ktg_context *context, ktg_annealing *s,
                                           const ktg_dual *dual, bool shaped, bool *folded);

/* Moves every piece into the middle of its sheet; how much larger than the sheet the largest is. */
KTG_NODISCARD ktg_status ktg_annealing_centre(ktg_context *context, ktg_annealing *s,
                                              double *excess);

/* A random branch and a cut edge on its border; false when the draw was none (arrange_draw.c). */
bool ktg_annealing_draw(const ktg_annealing *s, ktg_branch *branch, ktg_graft *graft);
/* The same, to help a seam that lacks its tab; there must be such seams. */
bool ktg_annealing_draw_for_tabs(const ktg_annealing *s, ktg_branch *branch, ktg_graft *graft);

/* One step, the `step`th of its phase (arrange_step.c). KTG_MEMORY only. */
KTG_NODISCARD ktg_status ktg_annealing_step(ktg_context *context, ktg_annealing *s, uint64_t step);

#endif
