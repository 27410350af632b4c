/* unfold/sheet_fill.h - annealing several pieces so that each fits its sheet (unfold only).
 *
 * The step is that of unfold/arrange.h: a branch is cut off and hung elsewhere, at its own piece or
 * at another one. What counts here is what stands out over the sheets, then how the pieces
 * meet (short borders along creases, no tiny pieces), then seams without a tab. Faces never
 * overlap. */
#ifndef KTG_UNFOLD_SHEET_FILL_H
#define KTG_UNFOLD_SHEET_FILL_H

#include "unfold/dual.h"
#include "unfold/search.h"

typedef struct ktg_sheet_fill {
    ktg_vec2 half;   /* of the printable area, in the dual's unit */
    double mm;       /* millimetres in that unit */
    double work;     /* steps and faces looked at; about 5 million a second */
    bool fixed_size; /* false: there is no sheet to fit yet, only shapes to be found */
    double progress_from, progress_to; /* of the part's */
} ktg_sheet_fill;

/* folded: edge_count flags of a forest without overlaps; so it is afterwards, with as many trees.
 * *fits: every piece fits with its tabs (ktg_sheet_check says so). Gives up early where that is
 * hopeless. */
KTG_NODISCARD ktg_status ktg_sheet_fill_run(ktg_context *context, const ktg_dual *dual,
                                            const ktg_unfold_options *options,
                                            const ktg_sheet_fill *fill, ktg_search *search,
                                            bool *folded, bool *fits);

#endif
