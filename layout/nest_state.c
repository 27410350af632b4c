/* layout/nest_state.c - the items as they lie, and the losses and weights of their pairs. */
#include "layout/nest_state.h"

#include "core/clock.h"
#include "core/memory.h"

static ktg_status make_shapes(nest_state *state, uint32_t *most_corners) {
    const ktg_nest_problem *problem = state->problem;
    state->shapes = ktg_new(state->context, problem->shape_count, nest_shape);
    if (!state->shapes)
        return KTG_MEMORY;
    for (size_t i = 0; i < problem->shape_count; i++) {
        nest_shape *shape = &state->shapes[i];
        KTG_TRY(ktg_nest_shape_make(state->context, &problem->shapes[i], shape));
        if (shape->corner_count > *most_corners)
            *most_corners = shape->corner_count;
    }
    return KTG_OK;
}

static ktg_status make_bodies(nest_state *state, uint32_t most_corners) {
    uint32_t n = state->item_count;
    state->bodies = ktg_new(state->context, (size_t)n + 1, nest_body);
    if (!state->bodies)
        return KTG_MEMORY;
    for (uint32_t i = 0; i <= n; i++) {
        const nest_shape *shape = &state->shapes[state->problem->items[i < n ? i : 0]];
        KTG_TRY(ktg_nest_body_make(state->context, shape, most_corners, &state->bodies[i]));
    }
    return KTG_OK;
}

ktg_status ktg_nest_state_make(ktg_context *context, const ktg_nest_problem *problem,
                               nest_state *state) {
    uint32_t most_corners = 0;
    size_t n = problem->item_count;
    *state = (nest_state){.context = context,
                          .problem = problem,
                          .item_count = (uint32_t)n,
                          .bin_count = 1,
                          .last_length = problem->length,
                          .work_limit = problem->work,
                          .started = ktg_clock_seconds()};
    ktg_random_seed(&state->random, ktg_context_seed(context));
    KTG_TRY(make_shapes(state, &most_corners));
    KTG_TRY(make_bodies(state, most_corners));
    state->losses = ktg_new(context, n * n, float);
    state->weights = ktg_new(context, n * n, float);
    state->order = ktg_new(context, n, uint32_t);
    state->window = ktg_new(context, most_corners, uint32_t);
    state->boxes = ktg_new(context, n + 1, nest_box);
    state->bins = ktg_new(context, n, uint32_t);
    state->doubts = ktg_new(context, n, uint32_t);
    state->depths = ktg_new(context, n, float);
    state->kept = ktg_new(context, n, nest_pose);
    return state->losses && state->weights && state->order && state->window && state->boxes &&
                   state->bins && state->doubts && state->depths && state->kept
               ? KTG_OK
               : KTG_MEMORY;
}

void ktg_nest_state_drop(nest_state *state) {
    for (size_t i = 0; state->shapes && i < state->problem->shape_count; i++)
        ktg_nest_shape_drop(&state->shapes[i]);
    for (size_t i = 0; state->bodies && i <= state->item_count; i++)
        ktg_nest_body_drop(&state->bodies[i]);
    ktg_free(state->shapes);
    ktg_free(state->bodies);
    ktg_free(state->losses);
    ktg_free(state->weights);
    ktg_free(state->order);
    ktg_free(state->window);
    ktg_free(state->kept);
    ktg_free(state->boxes);
    ktg_free(state->bins);
    ktg_free(state->doubts);
    ktg_free(state->depths);
}

static bool clamp(double *at, double low, double high, double room) {
    double least = -low, most = room - high, slack = 1e-9 * room;
    if (!(least <= most + slack))
        return false;
    *at = *at > most ? most : *at;
    *at = *at < least ? least : *at;
    return true;
}

bool ktg_nest_clamp(const nest_state *state, nest_pose *pose) {
    const nest_turn *turn = &pose->turn;
    return clamp(&pose->at.x, turn->low.x, turn->high.x, nest_bin_length(state, pose->bin)) &&
           clamp(&pose->at.y, turn->low.y, turn->high.y, state->problem->width);
}

void ktg_nest_put(nest_state *state, uint32_t item, const nest_pose *pose) {
    ktg_nest_body_put(&state->bodies[item], pose);
    ktg_nest_body_put_corners(&state->bodies[item]);
    state->boxes[item] = nest_box_at(pose);
    state->bins[item] = pose->bin;
}

static float pair_loss(nest_state *state, uint32_t a, uint32_t b) {
    if (a == b || state->bins[a] != state->bins[b] ||
        !nest_boxes_meet(&state->boxes[a], &state->boxes[b]))
        return 0;
    bool deep;
    float loss = ktg_nest_loss(&state->bodies[a], &state->bodies[b], &deep);
    return deep || ktg_nest_covers_meet(state, &state->bodies[a], &state->bodies[b],
                                        &state->boxes[a], &state->boxes[b])
               ? loss
               : 0;
}

static void measure_item(nest_state *state, uint32_t item) {
    size_t n = state->item_count;
    for (uint32_t i = 0; i < n; i++)
        state->losses[item * n + i] = state->losses[i * n + item] = pair_loss(state, item, i);
}

void ktg_nest_save(const nest_state *state, nest_pose *poses) {
    for (uint32_t i = 0; i < state->item_count; i++)
        poses[i] = state->bodies[i].pose;
}

void ktg_nest_load(nest_state *state, const nest_pose *poses) {
    for (uint32_t i = 0; i < state->item_count; i++)
        ktg_nest_put(state, i, &poses[i]);
}

void ktg_nest_move(nest_state *state, uint32_t item, const nest_pose *pose) {
    ktg_nest_put(state, item, pose);
    measure_item(state, item);
}

void ktg_nest_measure(nest_state *state) {
    for (uint32_t i = 0; i < state->item_count; i++)
        measure_item(state, i);
}

void ktg_nest_forget_weights(nest_state *state) {
    size_t count = (size_t)state->item_count * state->item_count;
    for (size_t k = 0; k < count; k++)
        state->weights[k] = 1;
}

double ktg_nest_total_loss(const nest_state *state) {
    size_t n = state->item_count;
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < i; k++)
            sum += (double)state->losses[i * n + k];
    return sum;
}

bool ktg_nest_is_over(nest_state *state) {
    double seconds = state->problem->seconds;
    if (state->work >= state->work_limit || ktg_wants_finish(state->context) ||
        (seconds > 0 && ktg_clock_seconds() - state->started > seconds))
        state->finish = true;
    return state->finish;
}
