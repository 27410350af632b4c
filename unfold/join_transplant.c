/* unfold/join_transplant.c - one piece by transplants, with fresh starts, or few pieces. */
#include "core/clock.h"
#include "core/memory.h"
#include "unfold/arrange.h"
#include "unfold/goal.h"
#include "unfold/join.h"
#include "unfold/split.h"
#include "unfold/spread.h"
#include "unfold/transplant.h"

#include <string.h>

/* Fresh starts by effort, from spanning trees whose weights (0 to 1) are shaken by this much. */
static const uint32_t most_restarts[] = {5, 20, 20};
#define RESTART_JITTER 0.3

/* With little effort only while so few pairs overlap: where it was hundreds it will be again. */
#define QUICK_OVERLAPS 20

/* Steps without a new least number of conflicts after which a run is given up. A run needs about
 * half a step for each face; when a large one stands still for as long as that, a fresh start is
 * the shorter way. */
static uint64_t patience_for(const ktg_dual *dual) {
    uint64_t faces = dual->face_count;
    return faces <= 2000 ? 1500 + faces : 3000 + faces / 4;
}

/* One run; afterwards the net is laid flat anew, so that its conflicts are not those of rounding.
 */
static ktg_status run_once(ktg_context *context, const ktg_dual *dual, double jitter,
                           ktg_search *search, bool *folded, ktg_net **net) {
    KTG_TRY(ktg_dual_spanning_tree(context, dual, jitter, &search->random, folded));
    KTG_TRY(ktg_net_new(context, dual, folded, net));
    KTG_TRY(ktg_transplant_run(context, *net, patience_for(dual), search));
    return ktg_net_refresh(context, *net);
}

/* Keeps the better of two nets in *best. */
static void keep_better(ktg_net **best, ktg_net **net) {
    if (!*best || (*net)->live_count < (*best)->live_count) {
        ktg_net *worse = *best;
        *best = *net;
        *net = worse;
    }
    ktg_net_free(net);
}

static bool may_succeed(const ktg_net *best, ktg_effort effort) {
    return best->live_count > 0 &&
           (effort > KTG_EFFORT_QUICK || best->live_count <= QUICK_OVERLAPS);
}

/* The best net of several runs; one run where it has no conflicts. */
static ktg_status search_net(ktg_context *context, const ktg_dual *dual, ktg_effort effort,
                             ktg_search *search, bool *folded, ktg_net **best) {
    ktg_status status = KTG_OK;
    for (uint32_t run = 0; status == KTG_OK && run <= most_restarts[effort]; run++) {
        ktg_net *net = NULL;
        if (run > 0 && (!may_succeed(*best, effort) || !ktg_search_goes_on(context, search)))
            break;
        search->report.restarts += run > 0;
        status = run_once(context, dual, run > 0 ? RESTART_JITTER : 0, search, folded, &net);
        if (status == KTG_OK)
            keep_better(best, &net);
        ktg_net_free(&net);
    }
    return status;
}

/* The component's share of the work that the effort stands for. */
static uint64_t work_for(const ktg_dual *dual, const ktg_unfold_options *options,
                         const ktg_search *search) {
    static const double work[] = {5e5, 4e6, 9e7};
    return (uint64_t)(work[options->effort] * dual->face_count / search->faces_all);
}

/* Makes the net compact and puts its folds into `joined`, which holds those of the net as it is:
 * they stay when laying flat anew shows that rounding has hidden an overlap. */
static ktg_status make_compact(ktg_context *context, ktg_net *net,
                               const ktg_unfold_options *options, ktg_search *search,
                               bool *joined) {
    const ktg_dual *dual = net->dual;
    ktg_seam_tab_wish wish;
    double part = options->mm_per_unit > 0 ? 1 : ktg_dual_area(dual) / search->area_all;
    ktg_arrange_goal goal = {.half = ktg_goal_half(options, search->mm, part),
                             .tabs = ktg_goal_tabs(options, search->mm, &wish) ? &wish : NULL,
                             .ease = options->ease,
                             .short_edge = options->finish.tab_edge_mm / search->mm,
                             .fixed = options->mm_per_unit > 0,
                             .work = work_for(dual, options, search)};
    if (dual->edge_count == 0)
        return KTG_OK;
    KTG_TRY(ktg_arrange(context, dual, &goal, search, net->folded));
    KTG_TRY(ktg_net_refresh(context, net));
    if (net->live_count == 0)
        memcpy(joined, net->folded, dual->edge_count * sizeof *joined);
    return KTG_OK;
}

ktg_status ktg_join_transplant(ktg_context *context, const ktg_dual *dual,
                               const ktg_unfold_options *options, ktg_search *search, bool *joined,
                               uint32_t *pieces) {
    ktg_net *net = NULL;
    double start = ktg_clock_seconds();
    ktg_status status = search_net(context, dual, options->effort, search, joined, &net);
    *pieces = 1;
    if (status == KTG_OK) {
        search->seconds += ktg_clock_seconds() - start;
        memcpy(joined, net->folded, dual->edge_count * sizeof *joined);
        status = net->live_count == 0 ? make_compact(context, net, options, search, joined)
                                      : ktg_split_conflicts(context, net, joined, pieces);
    }
    ktg_net_free(&net);
    return status;
}
