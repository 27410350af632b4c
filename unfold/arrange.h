/* unfold/arrange.h - pieces without overlaps become compact, with a tab on every seam (unfold
 * only).
 *
 * Simulated annealing over forests of the dual graph: a step cuts a fold and hangs the branch below
 * it elsewhere, or finds another tab for a seam that lacks one. First faces may overlap at a price
 * that rises, so that large branches find their place while the sheet is still a crowd; then they
 * may not, and tabs are real. */
#ifndef KTG_UNFOLD_ARRANGE_H
#define KTG_UNFOLD_ARRANGE_H

#include "unfold/seam_tabs.h"
#include "unfold/search.h"

typedef struct ktg_arrange_goal {
    ktg_vec2 half; /* half of the printable area each piece should fit, in the dual's unit */
    const ktg_seam_tab_wish *tabs; /* NULL: none */
    double ease;                   /* weight of how easy the net is to glue (ease.h); 0: none */
    double short_edge;             /* what counts as short there */
    bool fixed;    /* the scale: sheet and tabs keep their size, instead of following what is
                      reached */
    uint64_t work; /* counted in faces looked at; about ten million a second */
} ktg_arrange_goal;

/* folded: edge_count flags of a forest whose trees have no overlaps; so it is afterwards, with as
 * many trees, which may have traded faces. Ends when the work is done, or at the search's limits.
 * Rigid edges stay folds. */
KTG_NODISCARD ktg_status ktg_arrange(ktg_context *context, const ktg_dual *dual,
                                     const ktg_arrange_goal *goal, ktg_search *search,
                                     bool *folded);

#endif
