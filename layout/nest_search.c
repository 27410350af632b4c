/* layout/nest_search.c - a better place for one item: samples all over the bins and near where it
 * lies, the best of them refined by coordinate descent. */
#include "layout/nest_state.h"

#define WIDE_SAMPLES 40
#define NEAR_SAMPLES 20
#define KEPT         3
#define FIRST_STEP   0.25 /* of the shape's size */
#define MIDDLE_STEP  0.02
#define LAST_STEP    0.001
#define STEP_GROWTH  1.1
#define STEP_SHRINK  0.5
#define SAMPLE_TRIES 3 /* at other turns, where one does not fit */

typedef struct candidate {
    nest_pose pose;
    double loss; /* weighted */
} candidate;

/* The best few, best first. */
typedef struct shortlist {
    candidate items[KEPT];
    int count;
} shortlist;

/* What poles tell of the weighted loss at a pose; the pairs they leave in doubt go to
 * state->doubts. */
static double loss_by_poles(nest_state *state, uint32_t item, const nest_pose *pose, double bound,
                            uint32_t *doubt_count) {
    uint32_t n = state->item_count;
    nest_body *trial = &state->bodies[n];
    nest_box box = state->boxes[n] = nest_box_at(pose);
    const float *weights = &state->weights[(size_t)item * n];
    double loss = 0;
    trial->shape = state->bodies[item].shape;
    ktg_nest_body_put(trial, pose);
    *doubt_count = 0;
    for (uint32_t i = 0; i < n && loss < bound; i++) {
        if (i == item || state->bins[i] != pose->bin || !nest_boxes_meet(&box, &state->boxes[i]))
            continue;
        bool deep;
        float pair = ktg_nest_loss(trial, &state->bodies[i], &deep) * weights[i];
        state->work += 60;
        if (deep) {
            loss += (double)pair;
            continue;
        }
        state->depths[*doubt_count] = pair;
        state->doubts[(*doubt_count)++] = i;
    }
    return loss;
}

/* The weighted loss at a pose, or infinity once it reaches `bound`. */
static double loss_at(nest_state *state, uint32_t item, const nest_pose *pose, double bound) {
    uint32_t n = state->item_count, doubt_count;
    nest_body *trial = &state->bodies[n];
    double loss = loss_by_poles(state, item, pose, bound, &doubt_count);
    state->work += n + 40;
    if (loss < bound && doubt_count > 0) {
        ktg_nest_body_put_corners(trial);
        state->work += trial->shape->corner_count;
    }
    for (uint32_t k = 0; k < doubt_count && loss < bound; k++) {
        uint32_t i = state->doubts[k];
        if (ktg_nest_covers_meet(state, trial, &state->bodies[i], &state->boxes[n],
                                 &state->boxes[i]))
            loss += (double)state->depths[k];
    }
    return loss < bound ? loss : INFINITY;
}

static double between(ktg_random *random, double low, double high) {
    return low + (high - low) * ktg_random_unit(random);
}

/* ---- samples ------------------------------------------------------------------------------ */

static double random_angle(nest_state *state, const nest_shape *shape) {
    if (shape->turn_count > 0)
        return shape->turns[ktg_random_below(&state->random, shape->turn_count)];
    if (ktg_random_below(&state->random, 2))
        return between(&state->random, 0, 2 * KTG_PI);
    return shape->box_turn + KTG_PI / 2 * (double)ktg_random_below(&state->random, 4);
}

static uint32_t random_bin(nest_state *state) {
    if (state->bin_count == 1)
        return 0;
    double length = state->problem->length;
    double all = (state->bin_count - 1) * length + state->last_length;
    uint32_t bin = (uint32_t)(between(&state->random, 0, all) / length);
    return bin < state->bin_count ? bin : state->bin_count - 1;
}

/* A random position in the pose's bin; false when the shape does not fit with that turn. */
static bool random_position(nest_state *state, nest_pose *pose) {
    const nest_turn *turn = &pose->turn;
    double length = nest_bin_length(state, pose->bin);
    pose->at.x = between(&state->random, -turn->low.x, length - turn->high.x);
    pose->at.y = between(&state->random, -turn->low.y, state->problem->width - turn->high.y);
    return ktg_nest_clamp(state, pose);
}

bool ktg_nest_random_pose(nest_state *state, const nest_shape *shape, int tries, nest_pose *pose) {
    for (int k = 0; k < tries; k++) {
        pose->bin = random_bin(state);
        pose->turn = ktg_nest_turn_by(shape, random_angle(state, shape));
        state->work += 20 + shape->hull_count;
        if (random_position(state, pose)) {
            ktg_nest_turn_cover(shape, &pose->turn);
            return true;
        }
    }
    return false;
}

/* Near where it lies, turned a little or otherwise. */
static bool near_pose(nest_state *state, const nest_body *body, nest_pose *pose) {
    const nest_shape *shape = body->shape;
    ktg_random *random = &state->random;
    double reach = 0.5 * shape->size;
    *pose = body->pose;
    if (shape->turn_count == 0)
        pose->turn = ktg_nest_turn_by(shape, pose->turn.angle + between(random, -0.3, 0.3));
    else if (shape->turn_count > 1 && ktg_random_below(random, 2))
        pose->turn = ktg_nest_turn_by(shape, random_angle(state, shape));
    pose->at.x += between(random, -reach, reach);
    pose->at.y += between(random, -reach, reach);
    state->work += 20 + shape->hull_count;
    if (!ktg_nest_clamp(state, pose))
        return false;
    ktg_nest_turn_cover(shape, &pose->turn);
    return true;
}

static bool is_near(const candidate *a, const candidate *b, double reach) {
    return a->pose.bin == b->pose.bin && fabs(a->pose.at.x - b->pose.at.x) < reach &&
           fabs(a->pose.at.y - b->pose.at.y) < reach &&
           fabs(a->pose.turn.angle - b->pose.turn.angle) < 0.1;
}

static double bound_of(const shortlist *list) {
    return list->count < KEPT ? INFINITY : list->items[KEPT - 1].loss;
}

/* Keeps a candidate that is better than the worst, one of those that lie near each other. */
static void consider(shortlist *list, const candidate *c, double reach) {
    int k = 0, last;
    while (k < list->count && list->items[k].loss <= c->loss)
        if (is_near(&list->items[k++], c, reach))
            return;
    if (k == KEPT)
        return;
    for (last = k; last < list->count && !is_near(&list->items[last], c, reach); last++)
        ;
    if (last == list->count && list->count < KEPT)
        list->count++;
    if (last == KEPT)
        last--;
    for (; last > k; last--)
        list->items[last] = list->items[last - 1];
    list->items[k] = *c;
}

static void sample(nest_state *state, uint32_t item, shortlist *list) {
    const nest_body *body = &state->bodies[item];
    for (int k = 0; k < WIDE_SAMPLES + NEAR_SAMPLES && list->items[0].loss > 0; k++) {
        candidate c;
        if (!(k < WIDE_SAMPLES ? ktg_nest_random_pose(state, body->shape, SAMPLE_TRIES, &c.pose)
                               : near_pose(state, body, &c.pose)))
            continue;
        c.loss = loss_at(state, item, &c.pose, bound_of(list));
        if (c.loss < INFINITY)
            consider(list, &c, 0.05 * body->shape->size);
    }
}

/* ---- descent ------------------------------------------------------------------------------ */

typedef struct steps {
    double x, y, turn; /* all in length: a turn moves the rim by so much */
} steps;

/* Directions of a descent: x, y, both diagonals, and turning twice where turns are free. */
static const steps ways[] = {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, -1, 0}, {0, 0, 1}, {0, 0, 1}};

/* A step from `from` that gets below `bound`. */
static bool step_from(nest_state *state, uint32_t item, const candidate *from, const steps *way,
                      const steps *step, double sign, double bound, candidate *to) {
    const nest_shape *shape = state->bodies[item].shape;
    *to = *from;
    to->pose.at.x += sign * way->x * step->x;
    to->pose.at.y += sign * way->y * step->y;
    if (way->turn != 0)
        to->pose.turn =
            ktg_nest_turn_by(shape, to->pose.turn.angle + sign * 2 * step->turn / shape->diameter);
    if (!ktg_nest_clamp(state, &to->pose))
        return false;
    if (way->turn != 0)
        ktg_nest_turn_cover(shape, &to->pose.turn);
    to->loss = loss_at(state, item, &to->pose, bound);
    return to->loss < bound;
}

/* The better of a step forth and one back, where one is better than *c. */
static bool try_both(nest_state *state, uint32_t item, const steps *way, const steps *step,
                     candidate *c) {
    candidate forth, back;
    bool is_forth = step_from(state, item, c, way, step, 1, c->loss, &forth);
    double bound = is_forth ? forth.loss : c->loss;
    bool is_back = step_from(state, item, c, way, step, -1, bound, &back);
    if (is_back)
        *c = back;
    else if (is_forth)
        *c = forth;
    return is_forth || is_back;
}

static void descend(nest_state *state, uint32_t item, double first, double last, candidate *c) {
    const nest_shape *shape = state->bodies[item].shape;
    size_t way_count = shape->turn_count == 0 ? 6 : 4;
    double start = first * shape->size, end = last * shape->size;
    steps step = {start, start, shape->turn_count == 0 ? start : 0};
    while (c->loss > 0 && (step.x > end || step.y > end || step.turn > end)) {
        const steps *way = &ways[ktg_random_below(&state->random, way_count)];
        double factor = try_both(state, item, way, &step, c) ? STEP_GROWTH : STEP_SHRINK;
        step.x *= way->x != 0 ? factor : 1;
        step.y *= way->y != 0 ? factor : 1;
        step.turn *= way->turn != 0 ? factor : 1;
    }
}

static double present_loss(const nest_state *state, uint32_t item) {
    size_t n = state->item_count, row = item * n;
    double loss = 0;
    for (size_t i = 0; i < n; i++)
        loss += (double)state->weights[row + i] * (double)state->losses[row + i];
    return loss;
}

void ktg_nest_improve(nest_state *state, uint32_t item) {
    shortlist list = {{{state->bodies[item].pose, present_loss(state, item)}}, 1};
    double present = list.items[0].loss;
    if (!(present > 0))
        return;
    sample(state, item, &list);
    int best = 0;
    for (int k = 0; k < list.count; k++) {
        descend(state, item, FIRST_STEP, MIDDLE_STEP, &list.items[k]);
        if (list.items[k].loss < list.items[best].loss)
            best = k;
    }
    descend(state, item, MIDDLE_STEP, LAST_STEP, &list.items[best]);
    if (list.items[best].loss < present)
        ktg_nest_move(state, item, &list.items[best].pose);
}
