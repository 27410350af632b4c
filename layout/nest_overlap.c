/* layout/nest_overlap.c - do two covers overlap, and how badly? */
#include "layout/nest_state.h"

/* Below this depth, relative to the larger diameter, circles still attract a little: it tells a
 * position whose circles are nearly apart from one where they are. */
#define SOFTNESS 0.01f

/* What one pole adds to the overlap with each of the other's poles; loops without branches over
 * whole blocks, so that a compiler takes four at a time. */
static void add_pole(float x, float y, float radius, float soft, const float *restrict other_x,
                     const float *restrict other_y, const float *restrict other_radius,
                     uint32_t count, float *restrict sums, float *restrict deepest) {
    for (uint32_t k = 0; k < count; k++) {
        float dx = other_x[k] - x, dy = other_y[k] - y;
        float least = other_radius[k] < radius ? other_radius[k] : radius;
        float d = radius + other_radius[k] - sqrtf(dx * dx + dy * dy);
        sums[k] += (d + sqrtf(d * d + soft)) * least;
        deepest[k] = d > deepest[k] ? d : deepest[k];
    }
}

/* How deep the poles reach into each other, added up: with d what two circles would have to move to
 * part, softened to (d + sqrt(d^2 + 4 e^2)) / 2, times the smaller radius. *deep: some d > 0. */
static float pole_overlap(const nest_body *a, const nest_body *b, float softness, bool *deep) {
    const nest_poles *p = &a->shape->poles, *q = &b->shape->poles;
    float sums[NEST_MOST_POLES] = {0}, deepest[NEST_MOST_POLES] = {0}, sum = 0, most = 0;
    for (uint32_t i = 0; i < p->count; i++)
        add_pole(a->pole_x[i], a->pole_y[i], p->radius[i], 4 * softness * softness, b->pole_x,
                 b->pole_y, q->radius, q->padded, sums, deepest);
    for (uint32_t k = 0; k < q->count; k++) {
        sum += sums[k];
        most = deepest[k] > most ? deepest[k] : most;
    }
    *deep = most > 0;
    return sum / 2;
}

static double turn_of(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* True when the segments have a point in common. Their boxes meet. */
static bool segments_touch(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d) {
    double ac = turn_of(a, b, c), ad = turn_of(a, b, d);
    if ((ac > 0 && ad > 0) || (ac < 0 && ad < 0))
        return false;
    double ca = turn_of(c, d, a), cb = turn_of(c, d, b);
    return !((ca > 0 && cb > 0) || (ca < 0 && cb < 0));
}

static bool side_meets(ktg_vec2 a, ktg_vec2 b, ktg_vec2 low, ktg_vec2 high) {
    return (a.x >= low.x || b.x >= low.x) && (a.x <= high.x || b.x <= high.x) &&
           (a.y >= low.y || b.y >= low.y) && (a.y <= high.y || b.y <= high.y);
}

/* The sides of a body that may lie in a box, by their first corner. */
static uint32_t sides_in(const nest_body *body, ktg_vec2 low, ktg_vec2 high, uint32_t *sides) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < body->shape->corner_count; i++)
        if (side_meets(body->corners[i], body->corners[i + 1], low, high))
            sides[count++] = i;
    return count;
}

/* True when the boundaries have a point in common: touching counts, so that covers which lie flush
 * along a side, or on each other, are not taken for apart. */
static bool boundaries_touch(nest_state *state, const nest_body *a, const nest_body *b,
                             ktg_vec2 low, ktg_vec2 high) {
    uint32_t count = sides_in(a, low, high, state->window);
    state->work += a->shape->corner_count + b->shape->corner_count;
    if (count == 0)
        return false;
    for (uint32_t j = 0; j < b->shape->corner_count; j++) {
        ktg_vec2 c = b->corners[j], d = b->corners[j + 1];
        if (!side_meets(c, d, low, high))
            continue;
        state->work += count;
        ktg_vec2 l = {c.x < d.x ? c.x : d.x, c.y < d.y ? c.y : d.y};
        ktg_vec2 h = {c.x < d.x ? d.x : c.x, c.y < d.y ? d.y : c.y};
        for (uint32_t k = 0; k < count; k++) {
            ktg_vec2 p = a->corners[state->window[k]], q = a->corners[state->window[k] + 1];
            if (side_meets(p, q, l, h) && segments_touch(p, q, c, d))
                return true;
        }
    }
    return false;
}

static bool holds(const nest_body *body, ktg_vec2 p) {
    bool inside = false;
    for (uint32_t i = 0; i < body->shape->corner_count; i++) {
        ktg_vec2 a = body->corners[i], b = body->corners[i + 1];
        if ((a.y > p.y) != (b.y > p.y) && (turn_of(a, b, p) > 0) == (b.y > a.y))
            inside = !inside;
    }
    return inside;
}

static bool box_holds(const nest_box *a, const nest_box *b) {
    return a->low.x <= b->low.x && a->low.y <= b->low.y && a->high.x >= b->high.x &&
           a->high.y >= b->high.y;
}

bool ktg_nest_covers_meet(nest_state *state, const nest_body *a, const nest_body *b,
                          const nest_box *a_box, const nest_box *b_box) {
    ktg_vec2 low = {fmax(a_box->low.x, b_box->low.x), fmax(a_box->low.y, b_box->low.y)};
    ktg_vec2 high = {fmin(a_box->high.x, b_box->high.x), fmin(a_box->high.y, b_box->high.y)};
    return boundaries_touch(state, a, b, low, high) ||
           (box_holds(a_box, b_box) && holds(a, b->corners[0])) ||
           (box_holds(b_box, a_box) && holds(b, a->corners[0]));
}

float ktg_nest_loss(const nest_body *a, const nest_body *b, bool *deep) {
    float softness = SOFTNESS * (float)fmax(a->shape->diameter, b->shape->diameter);
    float sum = pole_overlap(a, b, softness, deep) + softness * softness;
    return sqrtf(sum * (float)(a->shape->size * b->shape->size));
}
