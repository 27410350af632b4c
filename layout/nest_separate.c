/* layout/nest_separate.c - guided local search until nothing overlaps. */
#include "layout/nest_state.h"

#include "core/memory.h"

/* How the weights of pairs that overlap grow, from the least to the worst of them, and how those of
 * others shrink. */
#define LEAST_GROWTH 1.2f
#define MOST_GROWTH  2.0f
#define DECAY        0.95f

#define MUCH_LESS 0.98 /* a loss that counts as progress, relative to the last one */

static void adapt_weights(nest_state *state) {
    size_t count = (size_t)state->item_count * state->item_count;
    float worst = 0;
    for (size_t k = 0; k < count; k++)
        worst = state->losses[k] > worst ? state->losses[k] : worst;
    for (size_t k = 0; k < count; k++) {
        float loss = state->losses[k], *weight = &state->weights[k];
        float by = loss > 0 ? LEAST_GROWTH + (MOST_GROWTH - LEAST_GROWTH) * loss / worst : DECAY;
        *weight *= by;
        *weight = *weight < 1 ? 1 : *weight > 1e30f ? 1e30f : *weight;
    }
}

static bool overlaps(const nest_state *state, uint32_t item) {
    size_t n = state->item_count;
    for (size_t i = 0; i < n; i++)
        if (state->losses[item * n + i] > 0)
            return true;
    return false;
}

/* Each item that overlaps, in random order, is moved to where it does so less. */
static void improve_all(nest_state *state) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < state->item_count; i++)
        if (overlaps(state, i))
            state->order[count++] = i;
    for (uint32_t i = count; i > 1; i--) {
        size_t k = ktg_random_below(&state->random, i);
        uint32_t swapped = state->order[k];
        state->order[k] = state->order[i - 1];
        state->order[i - 1] = swapped;
    }
    for (uint32_t i = 0; i < count && !ktg_nest_is_over(state); i++)
        ktg_nest_improve(state, state->order[i]);
}

/* Improves until there was no progress for `patience` rounds; leaves the best in state->kept. */
static ktg_status strike(nest_state *state, uint32_t patience, double *least) {
    for (uint32_t idle = 0; idle<patience && * least> 0 && !ktg_nest_is_over(state);) {
        KTG_TRY(ktg_check_cancel(state->context));
        improve_all(state);
        adapt_weights(state);
        double loss = ktg_nest_total_loss(state);
        idle = loss < MUCH_LESS * *least ? 0 : idle + 1;
        if (loss < *least) {
            *least = loss;
            ktg_nest_save(state, state->kept);
        }
    }
    return KTG_OK;
}

ktg_status ktg_nest_separate(nest_state *state, uint32_t strikes, uint32_t patience, bool *done) {
    double least = ktg_nest_total_loss(state);
    ktg_nest_save(state, state->kept);
    for (uint32_t k = 0; k < strikes && least > 0 && !ktg_nest_is_over(state);) {
        double before = least;
        KTG_TRY(strike(state, patience, &least));
        k = least < MUCH_LESS * before ? 0 : k + 1;
        ktg_nest_load(state, state->kept);
        ktg_nest_measure(state);
    }
    *done = least <= 0;
    return KTG_OK;
}
