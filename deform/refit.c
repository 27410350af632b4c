/* deform/refit.c - rotations fitted to what came out.
 *
 * A handle that only shifts gives no rotation anywhere, so that what lies between is sheared. The
 * rotation that takes the edges around a vertex, or a body, from where they were nearest to where
 * they came to tells more; with it the positions are solved once more. */
#include "core/sets.h"
#include "deform/solver.h"

#include <string.h>

#define MOST_TURNS 30
static const double settled = 1e-10;
/* Edges with a small or negative cotangent still count for so much of the row's sum. */
static const double least_weight = 0.02;

static void add_edge(ktg_spread *s, double weight, ktg_vec3 from, ktg_vec3 to) {
    s->columns[0] = ktg_madd3(s->columns[0], weight * from.x, to);
    s->columns[1] = ktg_madd3(s->columns[1], weight * from.y, to);
    s->columns[2] = ktg_madd3(s->columns[2], weight * from.z, to);
}

static void gather(ktg_deform *d) {
    const ktg_rows *rows = d->step_rows ? d->step_rows : d->rows;
    memset(d->spreads, 0, d->bodies->vertex_count * sizeof *d->spreads);
    for (uint32_t m = 0; m < rows->count; m++) {
        uint32_t v = rows->vertex[m], root = ktg_set_of(d->bodies->parent, v);
        ktg_spread *spread = &d->spreads[root];
        for (size_t i = rows->first[m] + 1; i < rows->first[m + 1]; i++) {
            uint32_t other = rows->column[i];
            if (ktg_set_of(d->bodies->parent, other) == root)
                continue; /* within a body edges only tell how it was turned */
            double weight =
                ktg_max(-rows->value[i], least_weight * fabs(rows->value[rows->first[m]]));
            add_edge(spread, weight, ktg_sub3(d->base[other], d->base[v]),
                     ktg_sub3(d->now[other], d->now[v]));
        }
    }
}

/* The rotation nearest to the spread, from the one before on (M. Mueller et al., "A robust method
 * to extract the rotational part of deformations", 2016). */
static ktg_turn nearest_turn(const ktg_spread *s, ktg_turn turn) {
    static const ktg_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < MOST_TURNS; i++) {
        ktg_vec3 twist = {0, 0, 0};
        double along = 0;
        for (int k = 0; k < 3; k++) {
            ktg_vec3 axis = ktg_turn_apply(turn, axes[k]);
            twist = ktg_add3(twist, ktg_cross3(axis, s->columns[k]));
            along += ktg_dot3(axis, s->columns[k]);
        }
        double length = ktg_length3(twist);
        if (!(length > settled * fabs(along)) || !(fabs(along) > 0))
            break;
        ktg_vec3 half = ktg_mul3(twist, 0.5 / fabs(along));
        if (length > fabs(along)) /* never more than a radian at once */
            half = ktg_mul3(twist, 0.5 / length);
        turn = ktg_turn_mul(ktg_turn_exp(half), turn);
    }
    return turn;
}

/* Those who follow turn like the mean of their masters. */
static ktg_turn mean_turn(const ktg_follower *f, const ktg_turn *turns) {
    ktg_turn first = turns[f->masters[0]], sum = {0, {0, 0, 0}};
    for (int k = 0; k < 3 && f->masters[k] != KTG_NONE; k++) {
        ktg_turn t = turns[f->masters[k]];
        double sign = t.w * first.w + ktg_dot3(t.v, first.v) < 0 ? -1 : 1;
        sum.w += sign * f->weights[k] * t.w;
        sum.v = ktg_madd3(sum.v, sign * f->weights[k], t.v);
    }
    return ktg_turn_mul(sum, ktg_turn_none());
}

void ktg_refit_turns(ktg_deform *d) {
    const ktg_bodies *b = d->bodies;
    gather(d);
    for (uint32_t v = 0; v < b->vertex_count; v++)
        if (b->parent[v] == v && b->hold[v] == KTG_NONE && !b->follows[v])
            d->step_turns[v] = nearest_turn(&d->spreads[v], d->step_turns[v]);
    for (uint32_t v = 0; v < b->vertex_count; v++)
        d->step_turns[v] = d->step_turns[b->follows[v] ? v : ktg_set_of(b->parent, v)];
    for (uint32_t i = 0; i < b->follower_count; i++)
        d->step_turns[b->followers[i].vertex] = mean_turn(&b->followers[i], d->step_turns);
}
