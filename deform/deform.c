/* deform/deform.c - the order of it all: check, join, assemble, factor; update; measure. */
#include "core/clock.h"
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

#include <string.h>

/* ---- scales --------------------------------------------------------------------------------- */

/* Whose scale is given: what is held but not resized keeps 1. */
static void give_scales(const ktg_deform *d, bool *given, ktg_vec3 *logs) {
    const ktg_bodies *b = d->bodies;
    for (uint32_t v = 0; v < b->vertex_count; v++) {
        uint32_t root = ktg_set_of(b->parent, v), sized = b->sized[root];
        double scale = sized == KTG_NONE ? 0 : d->frame->edit->holds[sized].scale;
        given[v] = sized == KTG_NONE ? b->hold[root] != KTG_NONE : scale > 0;
        logs[v] = (ktg_vec3){scale > 0 ? log(scale) : 0, 0, 0};
    }
    for (uint32_t i = 0; i < b->follower_count; i++) {
        const ktg_follower *f = &b->followers[i];
        logs[f->vertex].x = 0;
        for (int k = 0; k < 3 && f->masters[k] != KTG_NONE; k++)
            logs[f->vertex].x += f->weights[k] * logs[f->masters[k]].x;
    }
}

/* The logarithms of the scales are as smooth as can be between the given ones. What is given is not
 * what is held, so they have a matrix of their own. */
static ktg_status find_scales(ktg_context *context, ktg_deform *d) {
    uint32_t count = d->bodies->vertex_count;
    ktg_system *system = NULL;
    bool *given = ktg_new(context, count, bool);
    ktg_vec3 *logs = ktg_new(context, count, ktg_vec3);
    d->log_scale = ktg_new(context, count, double);
    ktg_status status = given && logs && d->log_scale ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        give_scales(d, given, logs);
        status = ktg_system_new(context, d->rows, d->bodies, given, &system);
    }
    if (status == KTG_OK) {
        memset(d->targets, 0, d->rows->count * sizeof *d->targets);
        status = ktg_system_solve(context, system, d->targets, logs);
    }
    for (uint32_t v = 0; status == KTG_OK && v < count; v++)
        d->log_scale[v] = logs[v].x;
    ktg_system_free(&system);
    ktg_free(given);
    ktg_free(logs);
    return status;
}

static bool resizes(const ktg_edit *edit) {
    for (size_t h = 0; h < edit->hold_count; h++)
        if (edit->holds[h].kind == KTG_HOLD_RESIZE)
            return true;
    return false;
}

/* ---- setup ---------------------------------------------------------------------------------- */

static ktg_status take_memory(ktg_context *context, ktg_deform *d) {
    size_t vertices = d->bodies->vertex_count;
    d->known = ktg_new(context, vertices, bool);
    d->motions = ktg_new(context, d->frame->edit->hold_count, ktg_deform_motion);
    d->base = ktg_new(context, vertices, ktg_vec3);
    d->now = ktg_new(context, vertices, ktg_vec3);
    d->turns = ktg_new(context, vertices, ktg_turn);
    d->base_turns = ktg_new(context, vertices, ktg_turn);
    d->step_turns = ktg_new(context, vertices, ktg_turn);
    d->logs = ktg_new(context, vertices, ktg_vec3);
    d->targets = ktg_new(context, d->rows->count, ktg_vec3);
    if (d->frame->edit->refine > 0)
        d->spreads = ktg_new(context, vertices, ktg_spread);
    if (!d->known || !d->motions || !d->base || !d->now || !d->turns || !d->base_turns ||
        !d->step_turns || !d->logs || !d->targets || (d->frame->edit->refine > 0 && !d->spreads))
        return KTG_MEMORY;
    return KTG_OK;
}

static ktg_status setup(ktg_context *context, const ktg_mesh *mesh, const ktg_edit *edit,
                        ktg_deform *d) {
    KTG_TRY(ktg_frame_new(context, mesh, edit, &d->frame));
    KTG_TRY(ktg_bodies_new(context, d->frame, &d->bodies));
    KTG_TRY(ktg_anchors_check(context, d->frame, d->bodies));
    KTG_TRY(ktg_rows_new(context, mesh, d->frame->adjacency, d->frame->rest, &d->rows));
    KTG_TRY(take_memory(context, d));
    for (uint32_t v = 0; v < d->bodies->vertex_count; v++)
        d->known[v] = d->bodies->hold[v] != KTG_NONE;
    KTG_TRY(ktg_system_new(context, d->rows, d->bodies, d->known, &d->system));
    return resizes(edit) ? find_scales(context, d) : KTG_OK;
}

ktg_status ktg_deform_new(ktg_context *context, const ktg_mesh *mesh, const ktg_edit *edit,
                          ktg_deform **deform) {
    *deform = ktg_new(context, 1, ktg_deform);
    ktg_status status = *deform ? setup(context, mesh, edit, *deform) : KTG_MEMORY;
    if (status != KTG_OK)
        ktg_deform_free(deform);
    return status;
}

void ktg_deform_free(ktg_deform **deform) {
    if (!deform || !*deform)
        return;
    ktg_deform *d = *deform;
    ktg_system_free(&d->system);
    ktg_rows_free(&d->rows);
    ktg_rows_free(&d->step_rows);
    ktg_bodies_free(&d->bodies);
    ktg_frame_free(&d->frame);
    ktg_free(d->known);
    ktg_free(d->log_scale);
    ktg_free(d->motions);
    ktg_free(d->base);
    ktg_free(d->now);
    ktg_free(d->turns);
    ktg_free(d->base_turns);
    ktg_free(d->step_turns);
    ktg_free(d->logs);
    ktg_free(d->targets);
    ktg_free(d->spreads);
    ktg_free(d);
    *deform = NULL;
}

/* ---- all of it ------------------------------------------------------------------------------ */

static ktg_status run(ktg_context *context, const ktg_mesh *mesh, const ktg_edit *edit,
                      ktg_deform **deform, ktg_vec3 *positions, ktg_deform_report *report) {
    double start = ktg_clock_seconds();
    KTG_TRY(ktg_deform_new(context, mesh, edit, deform));
    double ready = ktg_clock_seconds();
    KTG_TRY(ktg_deform_update(context, *deform, NULL, positions));
    double done = ktg_clock_seconds();
    KTG_TRY(ktg_deform_measure(context, *deform, positions, report));
    report->seconds_setup = ready - start;
    report->seconds_update = done - ready;
    return KTG_OK;
}

ktg_status ktg_deform_mesh(ktg_context *context, ktg_mesh *mesh, const ktg_edit *edit,
                           ktg_deform_report *report) {
    ktg_deform_report own = {0};
    ktg_deform *deform = NULL;
    ktg_vec3 *positions = ktg_new(context, mesh->vertex_count, ktg_vec3);
    ktg_status status = positions ? run(context, mesh, edit, &deform, positions, &own) : KTG_MEMORY;
    if (status == KTG_OK)
        memcpy(mesh->positions, positions, mesh->vertex_count * sizeof *positions);
    if (report)
        *report = own;
    ktg_deform_free(&deform);
    ktg_free(positions);
    return status;
}
