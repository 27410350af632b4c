/* unfold/transplant.h - conflict-driven subtree transplant: from any spanning tree to one without
 * overlaps (unfold only).
 *
 * A step draws an overlapping pair of faces at random. The way between them in the tree must lose a
 * fold: for a few folds of it the smaller side is taken as a rigid body, and for a few of the edges
 * where that body could hang instead its conflicts with the rest are counted. The best of these is
 * done if it costs no more than a Metropolis threshold, drawn beforehand so that hopeless places
 * are given up early. What was changed stays for a while (tabu).
 *
 * When the best costs more than it resolves, the two faces grow heavier, and all conflicts of
 * theirs with them (as clauses do in breakout search, Morris 1993). So a knot that is tight for
 * light moves is worth a heavy one after a while, whose new conflicts are light again. */
#ifndef KTG_UNFOLD_TRANSPLANT_H
#define KTG_UNFOLD_TRANSPLANT_H

#include "unfold/net.h"
#include "unfold/search.h"

/* Changes the net until no faces overlap (net->live_count = 0), or `patience` steps brought no new
 * least number of conflicts, or the search's limits are reached. */
KTG_NODISCARD ktg_status ktg_transplant_run(ktg_context *context, ktg_net *net, uint64_t patience,
                                            ktg_search *search);

#endif
