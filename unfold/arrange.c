/* unfold/arrange.c - annealing pieces towards their sheets: several starts, the best goes on. */
#include "unfold/arrange.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "unfold/annealing.h"

#include <string.h>

/* With enough work there are several starts, as many as get so much work for each face; then the
 * better ones go on, and the best of those. */
#define START_WORK 8000.0
#define ROUNDS     3
static const struct round {
    uint32_t most; /* this many are in the round, at most; ... */
    uint32_t of;   /* ... or one of so many starts */
    double part;   /* of the work, for all of them */
} rounds[ROUNDS] = {{12, 1, 0.5}, {3, 4, 0.25}, {1, 12, 0.25}};

/* A missing tab weighs as much as this part of the area. */
#define PRICE_POINTS 0.04

/* How much what is hard to glue weighs against area. */
#define EASE_POINTS 0.3

/* What a start has come to; `at` are the first two corners of face `anchor`, so that the net can
 * be laid where it lay. */
typedef struct outcome {
    bool *folded; /* NULL: nothing yet */
    double score;
    ktg_vec2 half;
    ktg_seam_tab_wish wish;
    uint32_t anchor;
    ktg_vec2 at[2];
} outcome;

/* One start: whatever thread it runs on, it has its own random numbers, and finds the same. */
typedef struct attempt {
    ktg_search search;
    outcome found;
} attempt;

typedef struct contest {
    const ktg_dual *dual;
    const ktg_arrange_goal *goal;
    const bool *folded;
    attempt *attempts; /* the better ones first, after each round */
    uint32_t starts;
    double budget;        /* of each in the present round */
    uint64_t work_before; /* the rounds before */
} contest;

static void set_sheet(ktg_annealing *s, ktg_vec2 half, const ktg_seam_tab_wish *wish) {
    s->half = half;
    if (wish)
        s->wish = *wish;
    s->wish.half = half;
}

/* Large models are good; missing tabs and what is hard to glue are not. */
static ktg_status score(ktg_context *context, ktg_annealing *s, double *points) {
    double excess;
    KTG_TRY(ktg_annealing_centre(context, s, &excess));
    double size = s->goal->half.x / (s->half.x * excess);
    *points = size * size - (s->tabs ? PRICE_POINTS * s->tabs->price : 0) -
              EASE_POINTS * ktg_ease_price(&s->ease);
    return KTG_OK;
}

static ktg_status keep(ktg_context *context, const ktg_annealing *s, double points, outcome *best) {
    const ktg_arrangement *a = s->a;
    uint32_t edges = a->dual->edge_count;
    bool *folded = ktg_copy_array(context, a->folded, edges, sizeof *folded);
    if (!folded)
        return KTG_MEMORY;
    ktg_free(best->folded);
    *best = (outcome){folded, points, s->half, s->wish, a->order[0], {{0, 0}}};
    memcpy(best->at, a->corners + 3 * (size_t)best->anchor, sizeof best->at);
    return KTG_OK;
}

/* ---- one attempt ---------------------------------------------------------------------------- */

static ktg_status start(ktg_context *context, ktg_annealing *s, const contest *c, bool *folded,
                        outcome *found) {
    double points;
    set_sheet(s, c->goal->half, c->goal->tabs);
    KTG_TRY(ktg_annealing_open(context, s, c->dual, folded));
    KTG_TRY(ktg_annealing_run(context, s, c->dual, false, folded));
    KTG_TRY(score(context, s, &points));
    return keep(context, s, points, found);
}

static ktg_status go_on(ktg_context *context, ktg_annealing *s, const contest *c, bool *folded,
                        outcome *found) {
    double points;
    set_sheet(s, found->half, &found->wish);
    KTG_TRY(ktg_annealing_open(context, s, c->dual, folded));
    const ktg_vec2 *now = s->a->corners + 3 * (size_t)found->anchor;
    KTG_TRY(ktg_arrangement_move(context, s->a, 0,
                                 ktg_motion2_between(now[0], now[1], found->at[0], found->at[1])));
    if (s->tabs)
        KTG_TRY(ktg_seam_tabs_renew(context, s->tabs, &s->wish));
    KTG_TRY(ktg_annealing_run(context, s, c->dual, true, folded));
    KTG_TRY(score(context, s, &points));
    return points > found->score ? keep(context, s, points, found) : KTG_OK;
}

/* The first start is made whatever happens: it ends at once where time is up. */
static ktg_status try_attempt(ktg_context *context, uint32_t index, void *user) {
    const contest *c = user;
    attempt *own = &c->attempts[index];
    const bool *from = own->found.folded ? own->found.folded : c->folded;
    if ((index > 0 || own->found.folded) && !ktg_search_goes_on(context, &own->search))
        return KTG_OK;
    ktg_annealing s = {.goal = c->goal,
                       .search = &own->search,
                       .budget = c->budget,
                       .work_before = c->work_before + (uint64_t)(index * c->budget)};
    bool *folded = ktg_copy_array(context, from, c->dual->edge_count, sizeof *from);
    ktg_status status = !folded             ? KTG_MEMORY
                        : own->found.folded ? go_on(context, &s, c, folded, &own->found)
                                            : start(context, &s, c, folded, &own->found);
    ktg_annealing_close(&s);
    ktg_free(folded);
    return status;
}

/* ---- rounds --------------------------------------------------------------------------------- */

static uint32_t starts_for(const ktg_arrange_goal *goal, const ktg_dual *dual) {
    double count = rounds[0].part * (double)goal->work / (START_WORK * dual->face_count);
    return goal->fixed || count < 2 ? 1 : count > rounds[0].most ? rounds[0].most : (uint32_t)count;
}

/* Random numbers, limits and progress of their own for all. */
static void prepare(contest *c, const ktg_search *search) {
    ktg_random seeds = search->random;
    for (uint32_t k = 0; k < c->starts; k++) {
        c->attempts[k].search = *search;
        ktg_random_seed(&c->attempts[k].search.random, ktg_random_next(&seeds));
    }
}

/* What the attempts' searches have come to becomes the whole's. */
static void gather(const contest *c, ktg_search *search) {
    for (uint32_t k = 0; k < c->starts; k++) {
        const ktg_search *own = &c->attempts[k].search;
        search->told = own->told > search->told ? own->told : search->told;
        if (own->report.stopped_by == KTG_STOPPED_TIME ||
            own->report.stopped_by == KTG_STOPPED_INTERRUPT)
            search->report.stopped_by = own->report.stopped_by;
    }
    ktg_random_seed(&search->random, ktg_random_next(&search->random));
}

static double score_of(const attempt *a) {
    return a->found.folded ? a->found.score : -INFINITY;
}

/* The best to the front; equal ones stay in their order. */
static void rank(attempt *attempts, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        attempt own = attempts[i];
        uint32_t k = i;
        for (; k > 0 && score_of(&attempts[k - 1]) < score_of(&own); k--)
            attempts[k] = attempts[k - 1];
        attempts[k] = own;
    }
}

static ktg_status run_round(ktg_context *context, contest *c, const struct round *round) {
    uint32_t count = c->starts / round->of;
    count = count > round->most ? round->most : count > 0 ? count : 1;
    double work = c->starts > 1 ? round->part * (double)c->goal->work : (double)c->goal->work;
    c->budget = work / count;
    KTG_TRY(ktg_parallel_run(context, count, try_attempt, c));
    rank(c->attempts, count);
    c->work_before += (uint64_t)work;
    return KTG_OK;
}

ktg_status ktg_arrange(ktg_context *context, const ktg_dual *dual, const ktg_arrange_goal *goal,
                       ktg_search *search, bool *folded) {
    contest c = {.dual = dual, .goal = goal, .folded = folded, .starts = starts_for(goal, dual)};
    ktg_status status = KTG_OK;
    c.attempts = ktg_new(context, c.starts, attempt);
    if (!c.attempts)
        return KTG_MEMORY;
    prepare(&c, search);
    for (int k = 0; status == KTG_OK && k < (c.starts > 1 ? ROUNDS : 1); k++)
        status = run_round(context, &c, &rounds[k]);
    gather(&c, search);
    if (status == KTG_OK)
        memcpy(folded, c.attempts[0].found.folded, dual->edge_count * sizeof *folded);
    for (uint32_t k = 0; k < c.starts; k++)
        ktg_free(c.attempts[k].found.folded);
    ktg_free(c.attempts);
    return status;
}
