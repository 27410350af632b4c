/* unfold/genetic.h - section 5: which patches to join, and in which order (unfold only). */
#ifndef KTG_UNFOLD_GENETIC_H
#define KTG_UNFOLD_GENETIC_H

#include "unfold/patches.h"
#include "unfold/search.h"
#include "unfold/unfold.h"

/* Joins the strips of `strips` (all joins done so far are set in `joined`, dual->edge_count flags)
 * by the genetic algorithm; sets further flags in `joined`. *pieces: how many patches are left. The
 * search's limits and counters are updated. */
KTG_NODISCARD ktg_status ktg_genetic_merge(ktg_context *context, const ktg_patches *strips,
                                           const ktg_unfold_options *options, ktg_search *search,
                                           bool *joined, uint32_t *pieces);

#endif
