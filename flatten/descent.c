/* flatten/descent.c - downhill to a minimum of an energy.
 *
 * A step of local/global iteration (Liu et al. 2008) is a step down the gradient measured with the
 * panel's Laplacian: positions' = positions - L^-1 gradient. A limited memory of the last steps
 * (Nocedal 1980, the two-loop recursion) makes it a quasi-Newton step that starts from the same
 * Laplacian, factored once. For the symmetric Dirichlet energy the Laplacian is made anew, from the
 * faces' present maps, after every few steps; its pattern is kept. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/iterate.h"

#include <string.h>

enum { remembered = 8, most_iterations = 1000, window = 6 };

/* For the symmetric Dirichlet energy: sweeps over the vertices at first, then rounds of some
 * sweeps, a new Laplacian and this many steps. Without sweeps the mannequin is at 35 instead of 7.4
 * after 100 steps, held up by a few squeezed faces. */
enum { first_sweeps = 6, round_sweeps = 2, round_length = 6 };

/* Done when the last `window` iterations together brought less than this part of the energy. */
static const double least_gain = 5e-4;

/* An energy per area that is rounding noise: strains of 1e-12. */
static const double noise = 1e-24;

typedef struct descent {
    const ktg_panel *panel;
    const ktg_rest *rests;
    ktg_energy energy;
    const ktg_springs *springs; /* or NULL */
    ktg_laplacian *laplacian;
    double *weights;
    uint32_t count; /* vertices */
    ktg_vec2 *gradient, *direction, *trial, *trial_gradient;
    ktg_vec2 *steps[remembered], *changes[remembered]; /* of positions, of the gradient */
    double products[remembered];                       /* step . change */
    uint32_t memory, newest; /* how many are in use; where the next goes */
    double value, noise;
} descent;

static ktg_status take_memory(ktg_context *context, descent *d) {
    ktg_vec2 **arrays[4 + 2 * remembered] = {&d->gradient, &d->direction, &d->trial,
                                             &d->trial_gradient};
    for (int k = 0; k < remembered; k++) {
        arrays[4 + 2 * k] = &d->steps[k];
        arrays[5 + 2 * k] = &d->changes[k];
    }
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) {
        *arrays[k] = ktg_new(context, d->count, ktg_vec2);
        if (!*arrays[k])
            return KTG_MEMORY;
    }
    d->weights = ktg_new(context, d->panel->adjacency->edge_count, double);
    return d->weights ? KTG_OK : KTG_MEMORY;
}

static void free_memory(descent *d) {
    ktg_free(d->gradient);
    ktg_free(d->direction);
    ktg_free(d->trial);
    ktg_free(d->trial_gradient);
    for (int k = 0; k < remembered; k++) {
        ktg_free(d->steps[k]);
        ktg_free(d->changes[k]);
    }
    ktg_free(d->weights);
    ktg_laplacian_free(&d->laplacian);
}

/* One vertex is held, wherever; the energies do not change with the place. */
static ktg_status make_laplacian(ktg_context *context, descent *d) {
    bool *held = ktg_new(context, d->count, bool);
    if (!held)
        return KTG_MEMORY;
    held[0] = true;
    ktg_status status = ktg_laplacian_new(context, d->panel, held, &d->laplacian);
    ktg_free(held);
    return status;
}

static ktg_status factor_laplacian(ktg_context *context, descent *d, const ktg_vec2 *flat) {
    if (d->energy == KTG_ENERGY_ARAP)
        ktg_cotangent_weights(d->panel, d->rests, d->weights);
    else
        ktg_proxy_weights(d->panel, d->rests, flat, d->weights);
    for (uint32_t k = 0; d->springs && k < d->springs->count; k++)
        d->weights[d->panel->adjacency->halfedge_edge[d->springs->halfedges[k]]] +=
            d->springs->stiffness;
    return ktg_laplacian_factor(context, d->laplacian, d->weights);
}

static double energy_of(const descent *d, const ktg_vec2 *flat, ktg_vec2 *gradient) {
    double value = ktg_energy_value(d->panel, d->rests, d->energy, flat, gradient);
    return d->springs ? value + ktg_springs_value(d->panel, d->springs, flat, gradient) : value;
}

static double dot(const descent *d, const ktg_vec2 *a, const ktg_vec2 *b) {
    double total = 0;
    for (uint32_t v = 0; v < d->count; v++)
        total += ktg_dot2(a[v], b[v]);
    return total;
}

static void add(const descent *d, ktg_vec2 *sum, double factor, const ktg_vec2 *a) {
    for (uint32_t v = 0; v < d->count; v++)
        sum[v] = ktg_madd2(sum[v], factor, a[v]);
}

/* direction = - (approximate inverse Hessian) gradient. */
static ktg_status find_direction(ktg_context *context, descent *d) {
    double alphas[remembered];
    for (uint32_t v = 0; v < d->count; v++)
        d->direction[v] = ktg_mul2(d->gradient[v], -1);
    for (uint32_t i = 0; i < d->memory; i++) {
        uint32_t k = (d->newest + remembered - 1 - i) % remembered;
        alphas[k] = dot(d, d->steps[k], d->direction) / d->products[k];
        add(d, d->direction, -alphas[k], d->changes[k]);
    }
    KTG_TRY(ktg_laplacian_solve(context, d->laplacian, d->direction, d->direction));
    for (uint32_t i = d->memory; i-- > 0;) {
        uint32_t k = (d->newest + remembered - 1 - i) % remembered;
        double beta = dot(d, d->changes[k], d->direction) / d->products[k];
        add(d, d->direction, alphas[k] - beta, d->steps[k]);
    }
    return KTG_OK;
}

static double first_step(const descent *d, const ktg_vec2 *flat) {
    if (d->energy == KTG_ENERGY_ARAP)
        return 1;
    return fmin(1, 0.9 * ktg_largest_step(d->panel, flat, d->direction, 2));
}

/* Halves the step until the energy falls as it should; 0 when it does not. */
static double search_line(descent *d, const ktg_vec2 *flat, double slope) {
    for (double t = first_step(d, flat); t > 1e-12; t /= 2) {
        for (uint32_t v = 0; v < d->count; v++)
            d->trial[v] = ktg_madd2(flat[v], t, d->direction[v]);
        double value = energy_of(d, d->trial, d->trial_gradient);
        if (value <= d->value + 1e-4 * t * slope) {
            d->value = value;
            return t;
        }
    }
    return 0;
}

/* Remembers the step and what it did to the gradient, where the energy is convex along it. */
static void remember(descent *d, const ktg_vec2 *flat) {
    ktg_vec2 *step = d->steps[d->newest], *change = d->changes[d->newest];
    for (uint32_t v = 0; v < d->count; v++) {
        step[v] = ktg_sub2(d->trial[v], flat[v]);
        change[v] = ktg_sub2(d->trial_gradient[v], d->gradient[v]);
    }
    double product = dot(d, step, change);
    if (!(product > 0))
        return;
    d->products[d->newest] = product;
    d->newest = (d->newest + 1) % remembered;
    d->memory += d->memory < remembered;
}

/* One step; *moved: whether the energy fell. */
static ktg_status step_down(ktg_context *context, descent *d, ktg_vec2 *flat, bool *moved) {
    KTG_TRY(find_direction(context, d));
    double slope = dot(d, d->gradient, d->direction);
    *moved = slope < 0 && search_line(d, flat, slope) > 0;
    if (!*moved)
        return KTG_OK;
    remember(d, flat);
    memcpy(flat, d->trial, d->count * sizeof *flat);
    memcpy(d->gradient, d->trial_gradient, d->count * sizeof *flat);
    return KTG_OK;
}

/* A Laplacian for where the shape is now; the memory speaks of another one and is dropped. With
 * springs the shape is nearly there, and vertices by themselves do not know of them. */
static ktg_status begin_round(ktg_context *context, descent *d, ktg_vec2 *flat, int sweeps) {
    if (d->energy == KTG_ENERGY_DIRICHLET && !d->springs)
        for (int k = 0; k < sweeps; k++)
            ktg_relax(d->panel, d->rests, flat);
    KTG_TRY(factor_laplacian(context, d, flat));
    d->value = energy_of(d, flat, d->gradient);
    d->memory = 0;
    return KTG_OK;
}

/* Whether it still falls, by what it was `window` iterations ago; notes what it is now. */
static bool still_falls(const descent *d, uint32_t i, double *before) {
    double was = before[i % window];
    before[i % window] = d->value;
    return d->value > d->noise && (i < window || was - d->value > least_gain * d->value);
}

static ktg_status descend(ktg_context *context, descent *d, ktg_vec2 *flat, uint32_t *iterations) {
    double before[window];
    uint32_t round = d->energy == KTG_ENERGY_ARAP ? most_iterations : round_length;
    KTG_TRY(begin_round(context, d, flat, first_sweeps));
    for (uint32_t i = 0; i < most_iterations && still_falls(d, i, before); i++) {
        ktg_progress(context, "flatten", 1 - 10.0 / (10 + i), NULL);
        KTG_TRY(ktg_check_cancel(context));
        if (ktg_wants_finish(context))
            break;
        if (i > 0 && i % round == 0)
            KTG_TRY(begin_round(context, d, flat, round_sweeps));
        bool moved, from_memory = d->memory > 0;
        KTG_TRY(step_down(context, d, flat, &moved));
        if (!moved && !from_memory)
            break;
        if (!moved)
            d->memory = 0;
        ++*iterations;
    }
    return KTG_OK;
}

ktg_status ktg_descend(ktg_context *context, const ktg_panel *panel, const ktg_rest *rests,
                       ktg_energy energy, const ktg_springs *springs, ktg_vec2 *flat,
                       uint32_t *iterations) {
    descent d = {.panel = panel,
                 .rests = rests,
                 .energy = energy,
                 .springs = springs,
                 .count = panel->vertex_count};
    for (uint32_t f = 0; f < panel->face_count; f++)
        d.noise += rests[f].area * noise;
    ktg_status status = take_memory(context, &d);
    if (status == KTG_OK)
        status = make_laplacian(context, &d);
    if (status == KTG_OK)
        status = descend(context, &d, flat, iterations);
    free_memory(&d);
    return status;
}
