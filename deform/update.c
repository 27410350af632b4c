/* deform/update.c - rotations, then positions (section 2 of the paper), in steps.
 *
 * A turn of theta makes a twisted tube thinner by the order of theta squared, because the rows of
 * the rest shape know nothing of its shear. So a large one is made in equal steps, each with the
 * rows of what the last one came to. The first step takes the factor that is there; each further
 * one factors anew (the ordering is kept). */
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

#include <string.h>

#define STEP_RADIANS (30 * KTG_PI / 180)
#define MOST_STEPS   1000
/* A handle that moves further than so many times the model's size means another unit. */
static const double furthest = 1e4;

/* ---- motions -------------------------------------------------------------------------------- */

static bool is_finite3(ktg_vec3 v) {
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static ktg_vec3 normalised(const ktg_frame *frame, ktg_vec3 v) {
    return (ktg_vec3){ldexp(v.x, -frame->exponent), ldexp(v.y, -frame->exponent),
                      ldexp(v.z, -frame->exponent)};
}

static ktg_status check_motion(ktg_context *context, const ktg_frame *frame, const ktg_hold *hold,
                               const ktg_deform_motion *m) {
    const char *name = hold->name ? hold->name : "", *file = frame->edit->file;
    bool turns = m->angle != 0;
    if (!is_finite3(m->axis) || !is_finite3(m->centre) || !is_finite3(m->move) ||
        !isfinite(m->angle))
        return ktg_fail(context, KTG_ARGUMENT, "[handle %.80s] has a motion that is not finite",
                        name);
    double scale = ktg_max(fabs(m->axis.x), ktg_max(fabs(m->axis.y), fabs(m->axis.z)));
    if (turns && !(scale > 0))
        return ktg_edit_fail(context, file, hold->line,
                             "[handle %.80s] turns about an axis without a direction", name);
    if (fabs(m->angle) > STEP_RADIANS * MOST_STEPS)
        return ktg_edit_fail(context, file, hold->line,
                             "[handle %.80s] turns by more than %g degrees", name,
                             MOST_STEPS * 30.0);
    double move = ktg_length3(normalised(frame, m->move));
    double away = ktg_length3(ktg_sub3(normalised(frame, m->centre), frame->low));
    if (!(move <= furthest) || (turns && !(away <= furthest)))
        return ktg_edit_fail(context, file, hold->line,
                             "[handle %.80s] moves by %g, or turns about a point so far away, more "
                             "than %g times the model's size: is that another unit?",
                             name, ktg_length3(m->move), furthest);
    return KTG_OK;
}

/* Takes the motions over, normalised; the axis a unit vector. */
static ktg_status take_motions(ktg_context *context, ktg_deform *d,
                               const ktg_deform_motion *motions) {
    const ktg_edit *edit = d->frame->edit;
    for (size_t h = 0; h < edit->hold_count; h++) {
        d->motions[h] = (ktg_deform_motion){{1, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
        if (edit->holds[h].kind != KTG_HOLD_HANDLE)
            continue;
        const ktg_deform_motion *m = motions ? &motions[h] : &edit->holds[h].motion;
        KTG_TRY(check_motion(context, d->frame, &edit->holds[h], m));
        double scale = ktg_max(fabs(m->axis.x), ktg_max(fabs(m->axis.y), fabs(m->axis.z)));
        if (m->angle != 0)
            d->motions[h].axis = ktg_unit3(ktg_mul3(m->axis, 1 / scale));
        d->motions[h].angle = m->angle;
        d->motions[h].centre = ktg_sub3(normalised(d->frame, m->centre), d->frame->low);
        d->motions[h].move = normalised(d->frame, m->move);
    }
    return KTG_OK;
}

static uint32_t count_steps(const ktg_deform *d) {
    double largest = 0;
    if (d->frame->edit->steps > 0)
        return d->frame->edit->steps;
    for (size_t h = 0; h < d->frame->edit->hold_count; h++)
        largest = ktg_max(largest, fabs(d->motions[h].angle));
    uint32_t steps = (uint32_t)ceil(largest / STEP_RADIANS - 1e-9);
    return steps > 0 ? steps : 1;
}

/* The part of a motion that is made after `part` of it: exactly nothing where it is none. */
static ktg_vec3 moved(const ktg_deform_motion *m, double part, ktg_vec3 p) {
    ktg_turn turn = ktg_turn_exp(ktg_mul3(m->axis, part * m->angle / 2));
    return ktg_add3(ktg_madd3(p, part, m->move), ktg_turn_shift(turn, ktg_sub3(p, m->centre)));
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* The rows of the base, and their factor. Where the base is too squeezed for one, the rows of the
 * rest shape do. */
static ktg_status take_rows(ktg_context *context, ktg_deform *d, bool first) {
    if (first && !d->stale)
        return KTG_OK;
    ktg_rows_free(&d->step_rows);
    d->stale = true;
    if (!first) {
        KTG_TRY(ktg_rows_new(context, d->frame->mesh, d->frame->adjacency, d->base, &d->step_rows));
        ktg_status status = ktg_system_refill(context, d->system, d->step_rows);
        if (status != KTG_GEOMETRY)
            return status;
        ktg_rows_free(&d->step_rows);
    }
    KTG_TRY(ktg_system_refill(context, d->system, d->rows));
    d->stale = false;
    return KTG_OK;
}

static const ktg_rows *rows_of(const ktg_deform *d) {
    return d->step_rows ? d->step_rows : d->rows;
}

/* ---- rotations ------------------------------------------------------------------------------ */

static ktg_vec3 mean_of_masters(const ktg_follower *f, const ktg_vec3 *values) {
    ktg_vec3 sum = {0, 0, 0};
    for (int k = 0; k < 3 && f->masters[k] != KTG_NONE; k++)
        sum = ktg_madd3(sum, f->weights[k], values[f->masters[k]]);
    return sum;
}

/* The logarithms of one step's rotations: given on what is held, else as smooth as can be. */
static ktg_status find_turns(ktg_context *context, ktg_deform *d) {
    const ktg_bodies *b = d->bodies;
    for (uint32_t v = 0; v < b->vertex_count; v++) {
        uint32_t hold = b->hold[ktg_set_of(b->parent, v)];
        d->logs[v] = hold == KTG_NONE
                         ? (ktg_vec3){0, 0, 0}
                         : ktg_mul3(d->motions[hold].axis, d->motions[hold].angle / 2 / d->steps);
    }
    for (uint32_t i = 0; i < b->follower_count; i++)
        d->logs[b->followers[i].vertex] = mean_of_masters(&b->followers[i], d->logs);
    memset(d->targets, 0, d->rows->count * sizeof *d->targets);
    return ktg_system_solve(context, d->system, d->targets, d->logs);
}

/* ---- positions ------------------------------------------------------------------------------ */

static double scale_at(const ktg_deform *d, uint32_t vertex, double part) {
    return d->log_scale ? exp(part * d->log_scale[vertex]) : 1;
}

/* (s R - 1) p, exactly nothing where nothing happens. */
static ktg_vec3 shift(ktg_turn turn, double scale, ktg_vec3 p) {
    ktg_vec3 change = ktg_turn_shift(turn, p);
    return scale == 1 ? change : ktg_madd3(ktg_mul3(change, scale), scale - 1, p);
}

/* Where a vertex is when its body's pivot is where `now` says: from the rest shape, so that a body
 * keeps it however many steps there are. */
static ktg_vec3 place_in_body(const ktg_deform *d, uint32_t vertex, uint32_t pivot, double part) {
    const ktg_vec3 *rest = d->frame->rest;
    ktg_vec3 arm = ktg_sub3(rest[vertex], rest[pivot]);
    ktg_vec3 by = ktg_sub3(d->now[pivot], rest[pivot]);
    return ktg_add3(ktg_add3(rest[vertex], by),
                    shift(d->turns[pivot], scale_at(d, pivot, part), arm));
}

/* Brings `now` into a state that fulfils every constraint: what is held where it is to be after
 * `part` of the way, all else in its body's place. */
static void constrain(ktg_deform *d, double part) {
    const ktg_bodies *b = d->bodies;
    const ktg_vec3 *rest = d->frame->rest;
    for (uint32_t v = 0; v < b->vertex_count; v++) {
        uint32_t root = ktg_set_of(b->parent, v), hold = b->hold[root];
        if (hold != KTG_NONE && (b->pivot[root] == v || !b->held[root]))
            d->now[v] = moved(&d->motions[hold], part, rest[v]);
    }
    for (uint32_t v = 0; v < b->vertex_count; v++) {
        uint32_t root = ktg_set_of(b->parent, v), pivot = b->pivot[root];
        if (v != pivot && !b->follows[v] && (b->hold[root] == KTG_NONE || b->held[root]))
            d->now[v] = place_in_body(d, v, pivot, part);
    }
    for (uint32_t i = 0; i < b->follower_count; i++) {
        const ktg_follower *f = &b->followers[i];
        ktg_vec3 gap =
            ktg_add3(f->gap, shift(d->turns[f->vertex], scale_at(d, f->vertex, part), f->gap));
        d->now[f->vertex] = ktg_add3(mean_of_masters(f, d->now), gap);
    }
}

/* What the rows are to be: those of the base, turned and scaled by the step. */
static void put_targets(ktg_deform *d) {
    const ktg_rows *rows = rows_of(d);
    ktg_rows_apply(rows, d->base, d->targets);
    for (uint32_t m = 0; m < rows->count; m++) {
        uint32_t v = rows->vertex[m];
        ktg_vec3 t = d->targets[m];
        d->targets[m] = ktg_add3(t, shift(d->step_turns[v], scale_at(d, v, 1.0 / d->steps), t));
    }
}

/* From base to now by step_turns, which are added to turns. */
static ktg_status solve_positions(ktg_context *context, ktg_deform *d, double part) {
    constrain(d, part);
    put_targets(d);
    return ktg_system_solve(context, d->system, d->targets, d->now);
}

static void add_turns(ktg_deform *d, const ktg_turn *before) {
    for (uint32_t v = 0; v < d->bodies->vertex_count; v++)
        d->turns[v] = ktg_turn_mul(d->step_turns[v], before[v]);
}

static ktg_status make_step(ktg_context *context, ktg_deform *d, uint32_t step) {
    uint32_t vertices = d->bodies->vertex_count;
    double part = (double)(step + 1) / d->steps;
    memcpy(d->base, d->now, vertices * sizeof *d->base);
    memcpy(d->base_turns, d->turns, vertices * sizeof *d->turns);
    KTG_TRY(take_rows(context, d, step == 0));
    KTG_TRY(find_turns(context, d));
    for (uint32_t v = 0; v < vertices; v++)
        d->step_turns[v] = ktg_turn_exp(d->logs[v]);
    add_turns(d, d->base_turns);
    KTG_TRY(solve_positions(context, d, part));
    for (uint32_t pass = 0; pass < d->frame->edit->refine; pass++) {
        KTG_TRY(ktg_check_cancel(context));
        ktg_refit_turns(d);
        add_turns(d, d->base_turns);
        KTG_TRY(solve_positions(context, d, part));
    }
    return KTG_OK;
}

/* Exactly the mesh's position where a vertex has not moved. */
static void give_positions(const ktg_deform *d, ktg_vec3 *positions) {
    const ktg_frame *frame = d->frame;
    for (uint32_t v = 0; v < d->bodies->vertex_count; v++) {
        ktg_vec3 by = ktg_sub3(d->now[v], frame->rest[v]);
        positions[v] =
            ktg_add3(frame->mesh->positions[v],
                     (ktg_vec3){ldexp(by.x, frame->exponent), ldexp(by.y, frame->exponent),
                                ldexp(by.z, frame->exponent)});
    }
}

ktg_status ktg_deform_update(ktg_context *context, ktg_deform *d, const ktg_deform_motion *motions,
                             ktg_vec3 *positions) {
    KTG_TRY(take_motions(context, d, motions));
    d->steps = count_steps(d);
    memcpy(d->now, d->frame->rest, d->bodies->vertex_count * sizeof *d->now);
    for (uint32_t v = 0; v < d->bodies->vertex_count; v++)
        d->turns[v] = ktg_turn_none();
    for (uint32_t step = 0; step < d->steps; step++) {
        ktg_progress(context, "deform", (double)step / d->steps, NULL);
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(make_step(context, d, step));
    }
    give_positions(d, positions);
    return KTG_OK;
}
