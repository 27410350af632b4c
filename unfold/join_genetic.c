/* unfold/join_genetic.c - the method of the paper: spanning tree, strips, genetic merging; and
 * fresh starts. */
#include "core/memory.h"
#include "unfold/genetic.h"
#include "unfold/join.h"
#include "unfold/strips.h"

#include <string.h>

/* How much the weights of the spanning tree, which lie between 0 and 1, are shaken for a fresh
 * start. */
#define RESTART_JITTER 0.5

/* Section 4: spanning tree and strips. Strips are joined face by face, so that one that would lie
 * over itself falls apart where it does. */
static ktg_status make_strips(ktg_context *context, const ktg_dual *dual, double jitter,
                              ktg_random *random, bool *joined, ktg_patches **strips) {
    bool *wanted = ktg_new(context, dual->edge_count, bool);
    ktg_status status =
        wanted ? ktg_dual_spanning_tree(context, dual, jitter, random, wanted) : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_strips_cut(context, dual, wanted);
    if (status == KTG_OK)
        status = ktg_patches_new(context, dual, strips);
    for (int firm = 2; firm >= 0; firm--) { /* kept edges, other rigid ones, the rest */
        for (uint32_t e = 0; status == KTG_OK && e < dual->edge_count; e++) {
            ktg_join result = KTG_OVERLAPS;
            if (wanted[e] && dual->edges[e].rigid + dual->edges[e].kept == firm)
                status = ktg_patches_join(context, *strips, e, &result);
            joined[e] = joined[e] || result == KTG_JOINED;
        }
    }
    ktg_free(wanted);
    return status;
}

/* One run of sections 4 and 5; joined: edge_count flags, set. */
static ktg_status join_once(ktg_context *context, const ktg_dual *dual,
                            const ktg_unfold_options *options, uint32_t run, ktg_search *search,
                            bool *joined, uint32_t *pieces) {
    ktg_patches *strips = NULL;
    memset(joined, 0, dual->edge_count * sizeof *joined);
    ktg_status status =
        make_strips(context, dual, run > 0 ? RESTART_JITTER : 0, &search->random, joined, &strips);
    if (status == KTG_OK && run == 0)
        search->report.strips += strips->patch_count;
    if (status == KTG_OK)
        status = ktg_genetic_merge(context, strips, options, search, joined, pieces);
    ktg_patches_free(&strips);
    return status;
}

/* The paper's run and, while it takes more than one piece, fresh starts from other strips; the
 * fewest pieces win. */
ktg_status ktg_join_genetic(ktg_context *context, const ktg_dual *dual,
                            const ktg_unfold_options *options, ktg_search *search, bool *joined,
                            uint32_t *pieces_left) {
    bool *trial = ktg_new(context, dual->edge_count, bool);
    ktg_stopped_by before = search->report.stopped_by;
    uint32_t least = 0, pieces = 0;
    ktg_status status =
        trial ? join_once(context, dual, options, 0, search, joined, &least) : KTG_MEMORY;
    for (uint32_t run = 1; status == KTG_OK && least > 1 && run <= options->restarts; run++) {
        if (!ktg_search_goes_on(context, search))
            break;
        status = join_once(context, dual, options, run, search, trial, &pieces);
        search->report.restarts++;
        if (status != KTG_OK || pieces >= least)
            continue;
        least = pieces;
        memcpy(joined, trial, dual->edge_count * sizeof *joined);
    }
    if (least == 1)
        search->report.stopped_by = before; /* limits of single runs did not matter */
    *pieces_left = least;
    ktg_free(trial);
    return status;
}
