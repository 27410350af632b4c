/* flatten/lead.c - handles led to their targets on a way that folds nothing.
 *
 * From the rest shape, turned as the handles ask for: each round moves the handles on, as far as no
 * face loses its area, and then lets the shape relax under the symmetric Dirichlet energy (Smith &
 * Schaefer 2015), which makes room for the next. Directions come from the factor of step 2. */
#include "core/memory.h"
#include "flatten/shape.h"

#include <string.h>

enum { most_rounds = 300, steps_per_round = 2, sweeps = 2, last_steps = 200, most_halvings = 20 };

/* Parts of the way to the first face without area that are gone. */
static const double leading_part = 0.5, relaxing_part = 0.8;

/* A step that gains less than this part of the energy ends relaxation. */
static const double least_gain = 1e-5;

/* Slower than this the handles do not arrive. */
static const double least_lead = 1e-4;

/* What one run works on. */
typedef struct lead {
    ktg_shape *shape;
    ktg_vec2 *y, *direction; /* vertex_count */
    ktg_vec2 *goal;          /* handle_count: where the handles are to go in the end */
    uint32_t *faces;         /* vertex_count: how many it has; 0 where sweeps leave it alone */
} lead;

/* y: the rest shape, moved as a whole so that its handles are next to their goals. */
static void start(lead *l) {
    const ktg_shape *s = l->shape;
    ktg_vec2 from = {0, 0}, to = {0, 0}, turn = {0, 0};
    for (uint32_t k = 0; k < s->handle_count; k++) {
        from = ktg_add2(from, ktg_handle_place(&s->handles[k], s->rest));
        to = ktg_add2(to, l->goal[k]);
    }
    from = ktg_mul2(from, 1.0 / s->handle_count);
    to = ktg_mul2(to, 1.0 / s->handle_count);
    for (uint32_t k = 0; k < s->handle_count; k++) {
        ktg_vec2 p = ktg_sub2(ktg_handle_place(&s->handles[k], s->rest), from);
        turn = ktg_add2(turn, ktg_turn_back(p, ktg_sub2(l->goal[k], to)));
    }
    turn = ktg_length2(turn) > 0 ? ktg_unit2(turn) : (ktg_vec2){1, 0};
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        l->y[v] = ktg_add2(to, ktg_turn(turn, ktg_sub2(s->rest[v], from)));
}

/* y + part of the direction, into s->now. */
static void look_ahead(const lead *l, double part) {
    for (uint32_t v = 0; v < l->shape->mesh->vertex_count; v++)
        l->shape->now[v] = ktg_madd2(l->y[v], part, l->direction[v]);
}

static void go(lead *l) {
    memcpy(l->y, l->shape->now, l->shape->mesh->vertex_count * sizeof *l->y);
}

/* Moves the handles on; the part of the way to their goals that was gone. */
static double advance(lead *l) {
    ktg_shape *s = l->shape;
    memcpy(s->wanted, l->goal, s->handle_count * sizeof *s->wanted);
    memcpy(s->now, l->y, s->mesh->vertex_count * sizeof *s->now);
    ktg_shape_bring_handles(s, s->now);
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        l->direction[v] = ktg_sub2(s->now[v], l->y[v]);
    double most = ktg_largest_step(s->panel, l->y, l->direction, 1 / leading_part);
    double part = fmin(1, leading_part * most);
    look_ahead(l, part);
    if (ktg_panel_count_flipped(s->panel, s->now) > 0)
        return 0;
    go(l);
    return part;
}

/* Vertices that carry handles, that no face has or where fans touch in a point, are not swept. */
static void choose_swept(lead *l) {
    const ktg_shape *s = l->shape;
    for (uint32_t h = 0; h < s->panel->adjacency->halfedge_count; h++)
        l->faces[s->panel->faces[h]]++;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        uint32_t h = s->panel->leaving[v], fan = 0;
        while (h != KTG_NONE && fan < l->faces[v] && (fan == 0 || h != s->panel->leaving[v])) {
            fan++;
            h = ktg_panel_around(s->panel, h);
        }
        if (fan != l->faces[v])
            l->faces[v] = 0;
    }
    for (uint32_t k = 0; k < s->handle_count; k++)
        for (int i = 0; i < 3; i++)
            l->faces[s->handles[k].vertices[i]] = 0;
}

/* Each of the others by itself: few faces are pressed, and what presses them is next to them. */
static void sweep(lead *l) {
    for (uint32_t v = 0; v < l->shape->mesh->vertex_count; v++)
        if (l->faces[v] > 0)
            ktg_relax_vertex(l->shape->panel, l->shape->rests, l->y, v);
}

/* One step down; false where it no longer gains. */
static ktg_status relax(ktg_context *context, lead *l, bool *gains) {
    ktg_shape *s = l->shape;
    double energy = ktg_energy_value(s->panel, s->rests, KTG_ENERGY_DIRICHLET, l->y, s->pulls),
           after = energy;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        s->pulls[v] = ktg_mul2(s->pulls[v], -1);
    KTG_TRY(ktg_shape_answer_pulls(context, s, l->direction));
    for (uint32_t k = 0; k < s->handle_count; k++) /* as they are */
        s->wanted[k] = (ktg_vec2){0, 0};
    ktg_shape_bring_handles(s, l->direction);
    double part =
        fmin(1, relaxing_part * ktg_largest_step(s->panel, l->y, l->direction, 1 / relaxing_part));
    for (int halving = 0; halving < most_halvings; halving++, part /= 2) {
        look_ahead(l, part);
        after = ktg_energy_value(s->panel, s->rests, KTG_ENERGY_DIRICHLET, s->now, NULL);
        if (after < energy)
            break;
    }
    *gains = after < (1 - least_gain) * energy;
    if (after < energy)
        go(l);
    return KTG_OK;
}

static ktg_status relax_often(ktg_context *context, lead *l, int steps) {
    bool gains = true;
    for (int k = 0; k < sweeps; k++)
        sweep(l);
    for (int k = 0; k < steps && gains; k++)
        KTG_TRY(relax(context, l, &gains));
    return KTG_OK;
}

static ktg_status run(ktg_context *context, lead *l, bool *arrived) {
    start(l);
    choose_swept(l);
    for (int round = 0; round < most_rounds && !*arrived; round++) {
        if (ktg_wants_finish(context)) /* or stop */
            return ktg_check_cancel(context);
        ktg_progress(context, "warp", (double)round / most_rounds, NULL);
        double part = advance(l);
        *arrived = part >= 1;
        if (part < least_lead)
            return KTG_OK;
        KTG_TRY(relax_often(context, l, steps_per_round));
    }
    if (!*arrived)
        return KTG_OK;
    KTG_TRY(relax_often(context, l, last_steps));
    *arrived = ktg_panel_count_flipped(l->shape->panel, l->y) == 0;
    return KTG_OK;
}

ktg_status ktg_shape_lead(ktg_context *context, ktg_shape *shape, const ktg_vec2 *targets,
                          ktg_vec2 *positions, bool *arrived) {
    *arrived = false;
    if (shape->handle_count < 2)
        return KTG_OK;
    KTG_TRY(ktg_shape_take_targets(context, shape, targets));
    lead l = {.shape = shape,
              .y = ktg_new(context, shape->mesh->vertex_count, ktg_vec2),
              .direction = ktg_new(context, shape->mesh->vertex_count, ktg_vec2)};
    l.faces = ktg_new(context, shape->mesh->vertex_count, uint32_t);
    l.goal = ktg_copy_array(context, shape->wanted, shape->handle_count, sizeof *l.goal);
    ktg_status status =
        l.y && l.direction && l.faces && l.goal ? run(context, &l, arrived) : KTG_MEMORY;
    if (status == KTG_OK && *arrived)
        ktg_shape_give(shape, l.y, positions);
    ktg_free(l.y);
    ktg_free(l.direction);
    ktg_free(l.faces);
    ktg_free(l.goal);
    return status;
}
