/* layout/nest.c - the total length is made shorter, step by step, as long as overlaps can be
 * resolved: large steps first, then small ones (exploration and compression of Gardeyn, Vanden
 * Berghe & Wauters 2025). */
#include "layout/nest_state.h"

#include "core/clock.h"
#include "core/memory.h"

#include <stdio.h>

#define FIRST_STEP   0.08  /* of the total length */
#define SMALL_STEP   0.011 /* from here on overlaps are resolved with more patience */
#define LEAST_STEP   0.001 /* while exploring */
#define STEP_GROWTH  1.1
#define EXPLORE      0.8     /* of the work */
#define COMPRESS     0.0005  /* first step of the compression, */
#define COMPRESS_END 0.00001 /* and the last */

/* Strikes and patience of a separation after large steps, after small ones, and in compression. */
#define LARGE_STRIKES    1
#define LARGE_PATIENCE   20
#define SMALL_STRIKES    3
#define COMPRESS_STRIKES 1
#define SMALL_PATIENCE   50

#define LARGE             0.2 /* of the largest item's area */
#define RANDOM_TRIES      64  /* to find a place for what has lost its own, or a large item */
#define WORK_OF_SHRINKING 50  /* for each item */

typedef struct search {
    nest_state state;
    nest_pose *best;   /* item_count: proven */
    ktg_vec2 **placed; /* item_count: outlines as they lie, for the proof */
    double length;     /* total, of the best */
    uint32_t records;
} search;

/* ---- from places to poses and back -------------------------------------------------------- */

static nest_pose pose_of(const nest_shape *shape, const ktg_nest_place *place) {
    nest_turn turn = ktg_nest_turn_by(shape, place->turn);
    ktg_nest_turn_cover(shape, &turn);
    ktg_vec2 m = shape->middle;
    return (nest_pose){
        place->bin,
        turn,
        {place->x + turn.c * m.x - turn.s * m.y, place->y + turn.s * m.x + turn.c * m.y}};
}

static ktg_nest_place place_of(const nest_shape *shape, const nest_pose *pose) {
    ktg_vec2 m = shape->middle;
    double c = pose->turn.c, s = pose->turn.s;
    return (ktg_nest_place){pose->bin, pose->at.x - c * m.x + s * m.y,
                            pose->at.y - s * m.x - c * m.y, pose->turn.angle};
}

static double total_length(const nest_state *state, const nest_pose *poses) {
    uint32_t last = 0;
    double length = 0;
    for (uint32_t i = 0; i < state->item_count; i++)
        last = poses[i].bin > last ? poses[i].bin : last;
    for (uint32_t i = 0; i < state->item_count; i++)
        if (poses[i].bin == last)
            length = fmax(length, poses[i].at.x + poses[i].turn.high.x);
    return last > 0 ? last * state->problem->length + length : length;
}

/* ---- proof -------------------------------------------------------------------------------- */

static void put_outline(const ktg_nest_shape *shape, const ktg_nest_place *place,
                        ktg_vec2 *points) {
    ktg_motion2 motion = {cos(place->turn), sin(place->turn), {place->x, place->y}};
    for (size_t i = 0; i < shape->outline_count; i++)
        points[i] = ktg_move2(motion, shape->outline[i]);
}

/* Whether the state has no overlaps, by the outlines themselves. */
static bool is_proven(search *s) {
    const ktg_nest_problem *problem = s->state.problem;
    for (uint32_t i = 0; i < s->state.item_count; i++) {
        const nest_body *body = &s->state.bodies[i];
        const ktg_nest_shape *shape = &problem->shapes[problem->items[i]];
        ktg_nest_place place = place_of(body->shape, &body->pose);
        put_outline(shape, &place, s->placed[i]);
        for (uint32_t k = 0; k < i; k++) {
            const ktg_nest_shape *other = &problem->shapes[problem->items[k]];
            if (s->state.bodies[k].pose.bin == body->pose.bin &&
                !ktg_nest_apart(s->placed[i], shape->outline_count, s->placed[k],
                                other->outline_count, problem->gap))
                return false;
        }
    }
    return true;
}

/* ---- lengths ------------------------------------------------------------------------------ */

static void set_length(nest_state *state, double total) {
    double length = state->problem->length;
    if (isinf(length)) {
        state->last_length = total;
        return;
    }
    state->bin_count = (uint32_t)fmax(1, ceil(total / length - 1e-9));
    state->last_length = total - (state->bin_count - 1) * length;
}

/* What the bin that is the last one now loses of its length. */
static double loss_of_length(const search *s, double total) {
    double length = s->state.problem->length, before = s->length;
    if (!isinf(length))
        before = fmin(length, before - (s->state.bin_count - 1) * length);
    return isinf(length) ? before - total : before - s->state.last_length;
}

/* The best with a new length: what lies beyond a cut in the last bin moves left by what the bin
 * loses, and what has no bin any more goes anywhere. False when something fits nowhere. */
static bool shrink(search *s, double total) {
    nest_state *state = &s->state;
    ktg_nest_load(state, s->best);
    set_length(state, total);
    double less = loss_of_length(s, total);
    double cut = ktg_random_unit(&state->random) * state->last_length;
    state->work += WORK_OF_SHRINKING * state->item_count;
    for (uint32_t i = 0; i < state->item_count; i++) {
        nest_pose pose = state->bodies[i].pose;
        if (pose.bin + 1 == state->bin_count && pose.at.x > cut)
            pose.at.x -= less;
        if ((pose.bin >= state->bin_count || !ktg_nest_clamp(state, &pose)) &&
            !ktg_nest_random_pose(state, state->bodies[i].shape, RANDOM_TRIES, &pose))
            return false;
        ktg_nest_put(state, i, &pose);
    }
    ktg_nest_forget_weights(state);
    ktg_nest_measure(state);
    return true;
}

/* Takes over what the state holds when it is proven. */
static bool take(search *s) {
    if (!is_proven(s))
        return false;
    ktg_nest_save(&s->state, s->best);
    s->length = total_length(&s->state, s->best);
    s->records++;
    return true;
}

/* ---- the two phases ----------------------------------------------------------------------- */

/* A random item, not much smaller than the largest and of another shape than `other` (NULL: any),
 * where a few tries find one. */
static uint32_t large_item(nest_state *state, const nest_shape *other) {
    double largest = 0;
    uint32_t item = 0;
    for (uint32_t i = 0; i < state->item_count; i++)
        largest = fmax(largest, state->bodies[i].shape->area);
    for (int k = 0; k < RANDOM_TRIES; k++) {
        item = (uint32_t)ktg_random_below(&state->random, state->item_count);
        const nest_shape *shape = state->bodies[item].shape;
        if (shape->area >= LARGE * largest && shape != other)
            break;
    }
    return item;
}

/* Two large items of different shapes change places. */
static void disturb(nest_state *state) {
    uint32_t a = large_item(state, NULL), b = large_item(state, state->bodies[a].shape);
    nest_pose at_a = state->bodies[a].pose, at_b = state->bodies[b].pose;
    nest_pose a_to_b = {at_b.bin, at_a.turn, at_b.at}, b_to_a = {at_a.bin, at_b.turn, at_a.at};
    if (ktg_nest_clamp(state, &a_to_b))
        ktg_nest_put(state, a, &a_to_b);
    if (ktg_nest_clamp(state, &b_to_a))
        ktg_nest_put(state, b, &b_to_a);
    ktg_nest_forget_weights(state);
    ktg_nest_measure(state);
}

static double share_done(const search *s) {
    const nest_state *state = &s->state;
    double share = (double)state->work / (double)state->work_limit;
    if (state->problem->seconds > 0)
        share = fmax(share, (ktg_clock_seconds() - state->started) / state->problem->seconds);
    return share;
}

static void tell(search *s, double share) {
    char detail[48];
    double length = s->state.problem->length;
    uint32_t bins = isinf(length) ? 1 : (uint32_t)ceil(s->length / length - 1e-9);
    snprintf(detail, sizeof detail, "%u sheet%s", bins, bins == 1 ? "" : "s");
    ktg_progress(s->state.context, "sheets", fmin(1, share), detail);
}

/* While there is work for this phase. */
static bool goes_on(search *s, double until) {
    double share = share_done(s);
    tell(s, share);
    return share < until && s->length > s->state.problem->enough && !ktg_nest_is_over(&s->state);
}

/* Resolves what shrinking brought about; where steps are small already, from other arrangements
 * too. */
static ktg_status resolve(search *s, double step, bool *done) {
    bool large = step > SMALL_STEP;
    KTG_TRY(ktg_nest_separate(&s->state, large ? LARGE_STRIKES : SMALL_STRIKES,
                              large ? LARGE_PATIENCE : SMALL_PATIENCE, done));
    while (!*done && step <= LEAST_STEP && goes_on(s, EXPLORE)) {
        disturb(&s->state);
        KTG_TRY(ktg_nest_separate(&s->state, SMALL_STRIKES, SMALL_PATIENCE, done));
    }
    return KTG_OK;
}

static ktg_status explore(search *s) {
    double step = FIRST_STEP;
    while (goes_on(s, EXPLORE)) {
        bool done = false;
        if (shrink(s, s->length * (1 - step)))
            KTG_TRY(resolve(s, step, &done));
        step = done && take(s) ? step * STEP_GROWTH : fmax(step / 2, LEAST_STEP);
    }
    return KTG_OK;
}

static ktg_status compress(search *s) {
    while (goes_on(s, 1)) {
        bool done = false;
        double left = fmax(0, 1 - share_done(s)) / (1 - EXPLORE);
        double step = COMPRESS_END + (COMPRESS - COMPRESS_END) * fmin(1, left);
        if (shrink(s, s->length * (1 - step)))
            KTG_TRY(ktg_nest_separate(&s->state, COMPRESS_STRIKES, SMALL_PATIENCE, &done));
        if (done)
            (void)take(s);
    }
    return KTG_OK;
}

/* ---- the whole ---------------------------------------------------------------------------- */

static ktg_status make(ktg_context *context, const ktg_nest_problem *problem, search *s) {
    KTG_TRY(ktg_nest_state_make(context, problem, &s->state));
    size_t n = problem->item_count;
    s->best = ktg_new(context, n, nest_pose);
    s->placed = ktg_new(context, n, ktg_vec2 *);
    if (!s->best || !s->placed)
        return KTG_MEMORY;
    for (size_t i = 0; i < n; i++) {
        s->placed[i] = ktg_new(context, problem->shapes[problem->items[i]].outline_count, ktg_vec2);
        if (!s->placed[i])
            return KTG_MEMORY;
    }
    return KTG_OK;
}

static void drop(search *s, size_t item_count) {
    ktg_nest_state_drop(&s->state);
    for (size_t i = 0; s->placed && i < item_count; i++)
        ktg_free(s->placed[i]);
    ktg_free(s->placed);
    ktg_free(s->best);
}

static ktg_status run(search *s, ktg_nest_place *places) {
    nest_state *state = &s->state;
    for (uint32_t i = 0; i < state->item_count; i++)
        s->best[i] = pose_of(state->bodies[i].shape, &places[i]);
    s->length = total_length(state, s->best);
    if (state->work_limit == 0)
        return KTG_OK;
    KTG_TRY(explore(s));
    KTG_TRY(compress(s));
    KTG_TRY(ktg_check_cancel(state->context));
    if (s->records > 0)
        for (uint32_t i = 0; i < state->item_count; i++)
            places[i] = place_of(state->bodies[i].shape, &s->best[i]);
    return KTG_OK;
}

ktg_status ktg_nest(ktg_context *context, const ktg_nest_problem *problem, ktg_nest_place *places,
                    ktg_nest_report *report) {
    search s = {0};
    ktg_status status = make(context, problem, &s);
    if (status == KTG_OK)
        status = run(&s, places);
    if (report)
        *report = (ktg_nest_report){s.length, s.state.work, s.records};
    drop(&s, problem->item_count);
    return status;
}
