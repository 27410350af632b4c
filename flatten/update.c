/* flatten/update.c - where the shape goes when its handles move: both steps, and refinement.
 *
 * Igarashi & Igarashi 2009, sections 4.2 and 4.3, with what flatten/shape.h precomputed. */
#include "core/memory.h"
#include "flatten/shape.h"

/* ---- targets ------------------------------------------------------------------------------ */

ktg_status ktg_shape_take_targets(ktg_context *context, ktg_shape *s, const ktg_vec2 *targets) {
    for (uint32_t k = 0; k < s->handle_count; k++) {
        if (!isfinite(targets[k].x) || !isfinite(targets[k].y))
            return ktg_fail(context, KTG_ARGUMENT, "handle %u has no finite target", k + 1);
        s->wanted[k] = ktg_shape_inward(s, targets[k]);
    }
    return KTG_OK;
}

/* ---- step 1 ------------------------------------------------------------------------------- */

/* With one handle, or none, there is nothing but a shift. */
static void shift(const ktg_shape *s, ktg_vec2 *z) {
    ktg_vec2 by = {0, 0};
    if (s->handle_count == 1)
        by = ktg_sub2(s->wanted[0], ktg_handle_place(&s->handles[0], s->rest));
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        z[v] = ktg_add2(s->rest[v], by);
}

/* z = Z l + N a, with l and a from the dense system. */
static void find_similar(ktg_shape *s, ktg_vec2 *z) {
    uint32_t count = s->handle_count, vertices = s->mesh->vertex_count;
    ktg_vec2 *right = s->forces, *forces = s->forces + count + 2;
    for (uint32_t k = 0; k < count + 2; k++)
        right[k] = k < count ? s->wanted[k] : (ktg_vec2){0, 0};
    ktg_dense_solve(&s->dense1, right, forces);
    for (uint32_t v = 0; v < vertices; v++)
        z[v] = ktg_add2(forces[count], ktg_turn(forces[count + 1], s->centred[v]));
    for (uint32_t k = 0; k < count; k++) {
        const ktg_vec2 *response = s->responses1 + (size_t)vertices * k;
        for (uint32_t v = 0; v < vertices; v++)
            z[v] = ktg_add2(z[v], ktg_turn(forces[k], response[v]));
    }
}

/* ---- step 2 ------------------------------------------------------------------------------- */

/* s->pulls: at each vertex, what its edges, turned as z says, ask for. */
static void pull_edges(ktg_shape *s, const ktg_vec2 *z) {
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        s->pulls[v] = (ktg_vec2){0, 0};
    for (uint32_t e = 0; e < s->panel->adjacency->edge_count; e++) {
        const ktg_shape_edge *edge = &s->edges[e];
        ktg_vec2 turn = ktg_turn(edge->factors[0], z[edge->vertices[0]]);
        for (int k = 1; k < 4; k++)
            turn = ktg_add2(turn, ktg_turn(edge->factors[k], z[edge->vertices[k]]));
        double length = ktg_length2(turn), pull = length > 0 ? edge->pull / length : 0;
        ktg_vec2 *a = &s->pulls[edge->vertices[0]], *b = &s->pulls[edge->vertices[1]];
        *a = ktg_madd2(*a, -pull, turn);
        *b = ktg_madd2(*b, pull, turn);
    }
}

/* The forces that bring the handles from where `y` has them to s->wanted, and the shift; both are
 * added to y. */
void ktg_shape_bring_handles(ktg_shape *s, ktg_vec2 *y) {
    uint32_t count = s->handle_count, vertices = s->mesh->vertex_count;
    ktg_vec2 *right = s->forces, *forces = s->forces + count + 2;
    for (uint32_t k = 0; k < count; k++)
        right[k] = ktg_sub2(s->wanted[k], ktg_handle_place(&s->handles[k], y));
    right[count] = (ktg_vec2){0, 0};
    ktg_dense_solve(&s->dense2, right, forces);
    for (uint32_t v = 0; v < vertices; v++)
        y[v] = ktg_add2(y[v], forces[count]);
    for (uint32_t k = 0; k < count; k++) {
        const double *response = s->responses2 + (size_t)vertices * k;
        for (uint32_t v = 0; v < vertices; v++)
            y[v] = ktg_madd2(y[v], response[v], forces[k]);
    }
}

/* y: L y = s->pulls, which add up to 0, with the anchor in the origin. */
ktg_status ktg_shape_answer_pulls(ktg_context *context, ktg_shape *s, ktg_vec2 *y) {
    uint32_t n = s->count2;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        uint32_t k = s->number2[v];
        if (k == KTG_NONE)
            continue;
        s->right[k] = s->pulls[v].x;
        s->right[n + k] = s->pulls[v].y;
    }
    KTG_TRY(ktg_factor_solve(context, s->factor2, s->right, 2, s->right));
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        uint32_t k = s->number2[v];
        y[v] = k == KTG_NONE ? (ktg_vec2){0, 0} : (ktg_vec2){s->right[k], s->right[n + k]};
    }
    return KTG_OK;
}

/* ---- updates ------------------------------------------------------------------------------ */

/* Vertices without faces stay; all of a shape that nobody holds does. */
void ktg_shape_give(const ktg_shape *s, const ktg_vec2 *z, ktg_vec2 *positions) {
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        bool stays = s->handle_count == 0 || s->panel->leaving[v] == KTG_NONE;
        positions[v] = stays ? s->given[v] : ktg_shape_outward(s, z[v]);
    }
}

ktg_status ktg_shape_update_similar(ktg_context *context, ktg_shape *shape, const ktg_vec2 *targets,
                                    ktg_vec2 *positions) {
    KTG_TRY(ktg_shape_take_targets(context, shape, targets));
    if (shape->handle_count < 2)
        shift(shape, shape->now);
    else
        find_similar(shape, shape->now);
    ktg_shape_give(shape, shape->now, positions);
    return KTG_OK;
}

ktg_status ktg_shape_update(ktg_context *context, ktg_shape *shape, const ktg_vec2 *targets,
                            ktg_vec2 *positions) {
    KTG_TRY(ktg_shape_take_targets(context, shape, targets));
    if (shape->handle_count < 2) {
        shift(shape, shape->now);
    } else {
        find_similar(shape, shape->now);
        pull_edges(shape, shape->now);
        KTG_TRY(ktg_shape_answer_pulls(context, shape, shape->now));
        ktg_shape_bring_handles(shape, shape->now);
    }
    ktg_shape_give(shape, shape->now, positions);
    return KTG_OK;
}

/* ---- refinement --------------------------------------------------------------------------- */

/* A step that gains less than this part of the energy is the last. */
static const double least_gain = 1e-6;
enum { most_halvings = 12 };

/* What is to fall: twice the ARAP energy, whose Hessian the matrix of step 2 stands for, and what
 * soft handles cost. The gradient, negated, goes to s->pulls unless `slope` is false. */
static double energy_at(ktg_shape *s, const ktg_vec2 *y, bool slope) {
    double energy =
        2 * ktg_energy_value(s->panel, s->rests, KTG_ENERGY_ARAP, y, slope ? s->pulls : NULL);
    for (uint32_t k = 0; k < s->handle_count; k++) {
        ktg_vec2 off = ktg_sub2(s->wanted[k], ktg_handle_place(&s->handles[k], y));
        energy += s->handles[k].weight / 2 * ktg_dot2(off, off);
    }
    for (uint32_t v = 0; slope && v < s->mesh->vertex_count; v++)
        s->pulls[v] = ktg_mul2(s->pulls[v], -2);
    return energy;
}

/* s->now: where a full step leads. */
static ktg_status find_step(ktg_context *context, ktg_shape *s, const ktg_vec2 *y) {
    KTG_TRY(ktg_shape_answer_pulls(context, s, s->now));
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        s->now[v] = ktg_add2(s->now[v], y[v]);
    ktg_shape_bring_handles(s, s->now);
    return KTG_OK;
}

/* Goes from y towards s->now as far as the energy falls; the energy there. */
static double take_step(ktg_shape *s, ktg_vec2 *y, double energy) {
    for (int halving = 0; halving < most_halvings; halving++) {
        double there = energy_at(s, s->now, false);
        if (there < energy) {
            for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
                y[v] = s->now[v];
            return there;
        }
        for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
            s->now[v] = ktg_mul2(ktg_add2(s->now[v], y[v]), 0.5);
    }
    return energy;
}

static ktg_status refine(ktg_context *context, ktg_shape *s, uint32_t rounds, ktg_vec2 *y,
                         uint32_t *done) {
    while (*done < rounds) {
        if (ktg_wants_finish(context)) /* or stop */
            return ktg_check_cancel(context);
        double energy = energy_at(s, y, true);
        KTG_TRY(find_step(context, s, y));
        double after = take_step(s, y, energy);
        if (after < energy)
            ++*done;
        if (!(after < (1 - least_gain) * energy))
            break;
    }
    return KTG_OK;
}

ktg_status ktg_shape_refine(ktg_context *context, ktg_shape *shape, const ktg_vec2 *targets,
                            uint32_t rounds, ktg_vec2 *positions, uint32_t *rounds_done) {
    uint32_t done = 0;
    KTG_TRY(ktg_shape_take_targets(context, shape, targets));
    ktg_vec2 *y = ktg_new(context, shape->mesh->vertex_count, ktg_vec2);
    if (!y)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < shape->mesh->vertex_count; v++)
        y[v] = ktg_shape_inward(shape, positions[v]);
    ktg_status status = KTG_OK;
    if (shape->handle_count >= 2)
        status = refine(context, shape, rounds, y, &done);
    if (status == KTG_OK && done > 0)
        ktg_shape_give(shape, y, positions);
    ktg_free(y);
    if (rounds_done)
        *rounds_done = done;
    return status;
}

/* ---- what came out ------------------------------------------------------------------------ */

/* Below this part of its area a face counts as folded. */
static const double folded_area = 1e-6;

static bool measure_face(const ktg_shape *s, uint32_t f, const ktg_vec2 *positions, double *energy,
                         ktg_shape_report *r) {
    const uint32_t *v = s->panel->faces + 3 * (size_t)f;
    ktg_vec2 corners[3];
    for (int k = 0; k < 3; k++)
        corners[k] = ktg_shape_inward(s, positions[v[k]]);
    ktg_jacobian j = ktg_jacobian_of(&s->rests[f], (const uint32_t[]){0, 1, 2}, corners);
    double conformal = hypot(j.x.x + j.y.y, j.x.y - j.y.x) / 2;
    double anticonformal = hypot(j.x.x - j.y.y, j.x.y + j.y.x) / 2;
    double s1 = conformal + anticonformal, s2 = conformal - anticonformal;
    *energy += s->rests[f].area * ((s1 - 1) * (s1 - 1) + (s2 - 1) * (s2 - 1));
    r->stretch_least = fmin(r->stretch_least, s2);
    r->stretch_most = fmax(r->stretch_most, s1);
    return !(s1 * s2 > folded_area);
}

void ktg_shape_measure(const ktg_shape *shape, const ktg_vec2 *targets, const ktg_vec2 *positions,
                       bool *folded, ktg_shape_report *report) {
    double energy = 0, area = 0;
    *report = (ktg_shape_report){
        .faces = shape->mesh->face_count, .first_folded = KTG_NONE, .stretch_least = INFINITY};
    for (uint32_t f = 0; f < shape->mesh->face_count; f++) {
        bool over = measure_face(shape, f, positions, &energy, report);
        area += shape->rests[f].area;
        report->folded_faces += over;
        if (over && report->first_folded == KTG_NONE)
            report->first_folded = f;
        if (folded)
            folded[f] = over;
    }
    report->energy = energy / area;
    for (uint32_t k = 0; k < shape->handle_count; k++) {
        ktg_vec2 at = ktg_handle_place(&shape->handles[k], positions);
        report->handle_error = fmax(report->handle_error, ktg_length2(ktg_sub2(at, targets[k])));
    }
}
