/* unfold/sheet_check.h - do the pieces of a part fit the sheet with their tabs? (unfold only)
 *
 * Asked of the pattern that they will become, finished as it will be: the same code decides about
 * tabs here and in the end. */
#ifndef KTG_UNFOLD_SHEET_CHECK_H
#define KTG_UNFOLD_SHEET_CHECK_H

#include "unfold/dual.h"
#include "unfold/unfold.h"

typedef struct ktg_sheet_check {
    uint32_t piece_count;
    uint32_t *piece;       /* face_count */
    double *magnification; /* piece_count: below 1 where a piece is too large */
    uint32_t too_large;    /* pieces */
    uint32_t too_many;     /* pieces with more faces than options->piece_faces */
    uint32_t tabs_wanted, tabs_none;
} ktg_sheet_check;

/* joined: edge_count flags, a forest without overlaps. mm: millimetres in a unit of the dual.
 * careful: no look at the tabs there will be; each piece must leave room for a whole one on every
 * side. So it is for a piece that forced cuts part from others anyway, whose tabs are not known
 * here. */
KTG_NODISCARD ktg_status ktg_sheet_check_run(ktg_context *context, const ktg_dual *dual,
                                             const ktg_unfold_options *options, double mm,
                                             const bool *joined, bool careful,
                                             ktg_sheet_check *check);
void ktg_sheet_check_free(ktg_sheet_check *check);

/* The factor by which a finished piece could be larger and would still fit the sheet. */
KTG_NODISCARD ktg_status ktg_sheet_magnification(ktg_context *context,
                                                 const ktg_unfold_options *options,
                                                 const ktg_pattern_piece *piece, bool careful,
                                                 double *magnification);

#endif
