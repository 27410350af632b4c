/* flatten/ways.c - which way of cutting a panel gains most: all are tried, the parts laid flat. */
#include "core/memory.h"
#include "core/parallel.h"
#include "core/vec.h"
#include "flatten/search.h"

#include <string.h>

/* In square roots of the area of what is cut: what any cut costs, and what a panel smaller than
 * this part does. */
static const double least_cost = 0.4, small_cost = 1, small_part = 0.06;

/* A cut that takes away less than this part of the excess is not worth making. */
static const double least_gain = 0.03;

typedef struct way {
    bool *cut; /* NULL where it does not apply */
    ktg_trial trial;
    uint64_t work;
} way;

typedef struct ways {
    const ktg_search *search;
    const ktg_sheet *sheet;
    ktg_split *split;
    way list[ktg_split_ways];
} ways;

static ktg_status make_smooth(ktg_context *context, const ways *w, uint32_t index, bool *cut) {
    double *cost =
        ktg_copy_array(context, w->sheet->cost, w->sheet->edge_count, sizeof *w->sheet->cost);
    if (!cost)
        return KTG_MEMORY;
    ktg_status status = ktg_split_make(context, w->split, index, cut, cost);
    if (status == KTG_OK)
        status = ktg_seams_smooth(context, w->sheet, cost, NULL, cut);
    ktg_free(cost);
    return status;
}

/* Makes way number `index`, smooths it and tries it. */
static ktg_status try_way(ktg_context *context, uint32_t index, void *user) {
    ways *w = user;
    way *mine = &w->list[index];
    ktg_fit_limit limit = w->search->limit;
    limit.work = 0;
    bool *cut = mine->cut = ktg_new(context, w->sheet->edge_count, bool);
    if (!cut)
        return KTG_MEMORY;
    KTG_TRY(make_smooth(context, w, index, cut));
    if (ktg_any(cut, w->sheet->edge_count)) {
        KTG_TRY(ktg_trial_run(context, w->sheet, cut, &limit, &mine->trial));
    } else {
        ktg_free(mine->cut);
        mine->cut = NULL;
    }
    mine->work = limit.work;
    return KTG_OK;
}

/* How many times less excess there is, as a logarithm, for what that costs: seams, and panels that
 * are awkward or small. When everything fits there is next to none. */
static double rate(const ktg_sheet *sheet, const ktg_trial *before, const ktg_trial *after) {
    double none = 0.02 * sheet->area, left = after->good ? none : after->excess + none;
    double length = ktg_max(0, after->length - before->length) / sqrt(sheet->area);
    double shape = ktg_max(0, after->shape - before->shape);
    double small =
        after->least_area < small_part * sheet->area && after->panels > 1 ? small_cost : 0;
    return log((before->excess + none) / left) / (least_cost + length + shape + small);
}

/* The best way below a rate; of all, or without lines. */
static const way *next_way(const ways *w, const ktg_trial *before, double below, bool no_lines) {
    const way *best = NULL;
    double highest = 0;
    for (uint32_t i = 0; i < ktg_split_ways; i++) {
        const way *one = &w->list[i];
        if (!one->cut || (no_lines && ktg_split_is_line(i)) ||
            (!one->trial.good && one->trial.excess > (1 - least_gain) * before->excess))
            continue;
        double its = rate(w->sheet, before, &one->trial);
        if (its < below && its > highest) {
            best = one;
            highest = its;
        }
    }
    return best;
}

/* The best; at the first cut the one of the rank that is asked for, if there are so many. */
static const way *choose_way(ktg_search *s, const ways *w, const ktg_trial *before) {
    uint32_t rank = s->begun ? 0 : s->first_rank;
    const way *best = next_way(w, before, INFINITY, s->lines_last);
    for (; best && rank > 0; rank--) {
        const way *next =
            next_way(w, before, 0.97 * rate(w->sheet, before, &best->trial), s->lines_last);
        if (!next)
            break;
        best = next;
    }
    s->begun = true;
    return best ? best : next_way(w, before, INFINITY, false);
}

ktg_status ktg_search_measure(ktg_context *context, ktg_search *search, const ktg_sheet *sheet,
                              ktg_fit *fit) {
    *fit = (ktg_fit){0};
    if (!ktg_sheet_is_disk(sheet))
        return KTG_OK;
    search->limit.thorough = true;
    ktg_status status = ktg_fit_measure(context, sheet->mesh, &search->limit, fit);
    search->limit.thorough = false;
    return status;
}

/* Where no way gains anything, but the panel lies on itself: the one that leaves least excess in
 * more than one part. */
static const way *any_way(const ways *w) {
    const way *best = NULL;
    for (uint32_t i = 0; i < ktg_split_ways; i++) {
        const way *one = &w->list[i];
        if (one->cut && one->trial.panels > 1 && (!best || one->trial.excess < best->trial.excess))
            best = one;
    }
    return best;
}

static ktg_status take_best(ktg_context *context, ktg_search *s, const ways *w,
                            const ktg_trial *before, bool *cut) {
    const way *best = choose_way(s, w, before);
    if (!best) {
        ktg_fit fit;
        KTG_TRY(ktg_search_measure(context, s, w->sheet, &fit));
        best = fit.flat ? NULL : any_way(w);
    }
    if (best)
        memcpy(cut, best->cut, w->sheet->edge_count * sizeof *cut);
    return KTG_OK;
}

ktg_status ktg_search_cut_panel(ktg_context *context, ktg_search *search, const ktg_sheet *sheet,
                                const ktg_trial *before, bool *cut) {
    ways w = {.search = search, .sheet = sheet};
    ktg_status status = ktg_split_new(context, sheet, &w.split);
    if (status == KTG_OK)
        status = ktg_parallel_run(context, ktg_split_ways, try_way, &w);
    for (uint32_t i = 0; i < ktg_split_ways; i++)
        search->limit.work += w.list[i].work;
    if (status == KTG_OK)
        status = take_best(context, search, &w, before, cut);
    for (uint32_t i = 0; i < ktg_split_ways; i++)
        ktg_free(w.list[i].cut);
    ktg_split_free(&w.split);
    return status;
}
