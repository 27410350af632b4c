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

typedef struct search {
    nest_state state;
    nest_pose *best;   /* item_count: proven */
    ktg_vec2 **placed; /* item_count: outlines as they lie, for the proof */
    double length;     /* total, of the best */
    uint32_t records;
} search;

/* ---- from places to poses and back -------------------------------------------------------- */

static nest_pose pose_of(const nest_shape *shape, const ktg_nest_place *place) {
    nest_turn turn = nest_turn_by(shape, place->turn);
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

/* The best with a new length: what lies beyond a cut in the last bin moves left by what the bin
 * loses, and what has no bin any more goes anywhere. False when something fits nowhere. */
static bool shrink(search *s, double total) {
    nest_state *state = &s->state;
    nest_load(state, s->best);
    double before = s->length;
    set_length(state, total);
    double cut = ktg_random_unit(&state->random) * state->last_length;
    for (uint32_t i = 0; i < state->item_count; i++) {
        nest_pose pose = state->bodies[i].pose;
        if (pose.bin + 1 == state->bin_count && pose.at.x > cut)
            pose.at.x -= before - total;
        if ((pose.bin >= state->bin_count || !nest_clamp(state, &pose)) &&
            !nest_random_pose(state, state->bodies[i].shape, &pose))
            return false;
        nest_put(state, i, &pose);
    }
    nest_forget_weights(state);
    nest_measure(state);
    return true;
}

/* Takes over what the state holds when it is proven. */
static bool take(search *s) {
    if (!is_proven(s))
        return false;
    nest_save(&s->state, s->best);
    s->length = total_length(&s->state, s->best);
    s->records++;
    return true;
}

/* ---- the two phases ----------------------------------------------------------------------- */

/* Two large items of different shapes change places. */
static void disturb(nest_state *state) {
    uint32_t n = state->item_count, pair[2];
    double largest = 0;
    for (uint32_t i = 0; i < n; i++)
        largest = fmax(largest, state->bodies[i].shape->area);
    for (int k = 0, tries = 0; k < 2 && tries < 1000; tries++) {
        pair[k] = (uint32_t)ktg_random_below(&state->random, n);
        const nest_shape *shape = state->bodies[pair[k]].shape;
        if (shape->area >= 0.2 * largest * (tries < 500) &&
            (k == 0 || tries > 900 || shape != state->bodies[pair[0]].shape))
            k++;
        else
            continue;
    }
    nest_pose a = state->bodies[pair[0]].pose, b = state->bodies[pair[1]].pose;
    nest_pose to_a = {b.bin, a.turn, b.at}, to_b = {a.bin, b.turn, a.at};
    if (nest_clamp(state, &to_a))
        nest_put(state, pair[0], &to_a);
    if (nest_clamp(state, &to_b))
        nest_put(state, pair[1], &to_b);
    nest_forget_weights(state);
    nest_measure(state);
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
    return share < until && !nest_is_over(&s->state);
}

/* Resolves what shrinking brought about; where steps are small already, from other arrangements
 * too. */
static ktg_status resolve(search *s, double step, bool *done) {
    bool large = step > SMALL_STEP;
    KTG_TRY(nest_separate(&s->state, large ? 1 : 3, large ? 20 : 50, done));
    while (!*done && step <= LEAST_STEP && goes_on(s, EXPLORE)) {
        disturb(&s->state);
        KTG_TRY(nest_separate(&s->state, 3, 50, done));
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
            KTG_TRY(nest_separate(&s->state, 1, 50, &done));
        if (done)
            (void)take(s);
    }
    return KTG_OK;
}

/* ---- the whole ---------------------------------------------------------------------------- */

static ktg_status make(ktg_context *context, const ktg_nest_problem *problem, search *s) {
    KTG_TRY(nest_state_make(context, problem, &s->state));
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
    nest_state_drop(&s->state);
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
