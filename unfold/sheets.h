/* unfold/sheets.h - a part in the fewest pieces such that each, with its tabs, fits a sheet (unfold
 * only). */
#ifndef KTG_UNFOLD_SHEETS_H
#define KTG_UNFOLD_SHEETS_H

#include "unfold/dual.h"
#include "unfold/search.h"

/* Whether the options ask for pieces at all: a scale that pieces must fit, or their number. */
bool ktg_sheets_wanted(const ktg_unfold_options *options);

/* The fewest pieces that are worth trying. */
uint32_t ktg_sheets_least(const ktg_dual *dual, const ktg_unfold_options *options,
                          const ktg_search *search);

/* KTG_GEOMETRY, with the scale that would fit, when a single face is larger than the sheet. */
KTG_NODISCARD ktg_status ktg_sheets_check_faces(ktg_context *context, const ktg_mesh *mesh,
                                                const ktg_unfold_options *options);

/* Rigid edges of polygons that do not fit the sheet lose their rigidity, unless they are kept. */
KTG_NODISCARD ktg_status ktg_sheets_loosen(ktg_context *context, const ktg_unfold_options *options,
                                           double mm, ktg_dual *dual);

/* joined: edge_count flags of one piece, or few, without overlaps, which matter only when
 * ktg_sheets_least is 1; set to those of the fewest pieces found that fit, or of as many as the
 * options say. *pieces: how many trees. */
KTG_NODISCARD ktg_status ktg_sheets_divide(ktg_context *context, const ktg_dual *dual,
                                           const ktg_unfold_options *options, ktg_search *search,
                                           bool *joined, uint32_t *pieces);

/* Whether every piece of a whole pattern, which is not changed, fits its sheet once it is finished;
 * true where the options do not ask for that. */
KTG_NODISCARD ktg_status ktg_sheets_fit(ktg_context *context, const ktg_unfold_options *options,
                                        const ktg_pattern *pattern, bool *fit);

#endif
