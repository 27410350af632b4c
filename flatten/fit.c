/* flatten/fit.c - how well a disk can be laid flat, and where a cut would help most. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/iterate.h"
#include "flatten/sheet.h"
#include "pattern/hull.h"

/* Strain counts as excess from this part of the limit on, so that a panel that has just come within
 * it is still better when it strains less; and not above this, where more is only more hopeless. */
static const double counts_from = 0.8, most_excess = 6;

/* What is laid flat, and how. */
typedef struct fitting {
    ktg_panel *panel;
    ktg_rest *rests;
    ktg_vec2 *flat;
    ktg_fit_limit *limit;
} fitting;

static double excess_of(double strain, double limit) {
    if (!(strain < INFINITY))
        return most_excess;
    return ktg_min(most_excess, log2(ktg_max(1, strain / (counts_from * limit))));
}

/* A face that is turned over is as wrong as can be. */
static void add_up(const ktg_panel *panel, const ktg_vec2 *flat, double limit, ktg_fit *fit) {
    *fit = (ktg_fit){0};
    for (uint32_t k = 0; k < panel->face_count; k++) {
        ktg_face_map map = ktg_face_map_of(panel, k, flat);
        double strain = ktg_max(fabs(map.s1 - 1), fabs(map.s2 - 1));
        bool folded = !(map.s2 > 0) || !(strain < INFINITY);
        fit->area += map.area;
        fit->excess += map.area * (folded ? most_excess : excess_of(strain, limit));
        if (folded || strain > limit)
            fit->beyond += map.area;
    }
    fit->beyond /= fit->area;
    double unit = ldexp(1, 2 * panel->exponent);
    fit->area *= unit;
    fit->excess *= unit;
}

static ktg_status find_waste(ktg_context *context, const ktg_panel *panel, const ktg_vec2 *flat,
                             ktg_fit *fit) {
    ktg_vec2 *hull;
    size_t count;
    double area = 0;
    fit->waste = 1;
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        if (!isfinite(flat[v].x) || !isfinite(flat[v].y))
            return KTG_OK;
    KTG_TRY(ktg_hull(context, flat, panel->vertex_count, &hull, &count));
    for (size_t i = 0; i < count; i++)
        area += ktg_cross2(hull[i], hull[(i + 1) % count]) / 2;
    ktg_free(hull);
    fit->waste = ktg_max(0, 1 - ldexp(fit->area, -2 * panel->exponent) / ktg_max(area, 1e-300));
    return KTG_OK;
}

static ktg_status find_soundness(ktg_context *context, const ktg_panel *panel, const ktg_vec2 *flat,
                                 const ktg_fit_limit *limit, ktg_fit *fit) {
    uint32_t vertices[2];
    bool crossed = true;
    if (ktg_panel_count_flipped(panel, flat) == 0)
        KTG_TRY(ktg_panel_find_crossing(context, panel, flat, &crossed, vertices));
    fit->known = true;
    fit->flat = !crossed;
    fit->good = fit->flat && fit->beyond <= 1 - limit->area_part;
    return KTG_OK;
}

ktg_status ktg_fit_of_flat(ktg_context *context, const ktg_panel *panel, const ktg_vec2 *flat,
                           const ktg_fit_limit *limit, ktg_fit *fit) {
    add_up(panel, flat, limit->max_strain, fit);
    KTG_TRY(find_waste(context, panel, flat, fit));
    return find_soundness(context, panel, flat, limit, fit);
}

/* The way the default method begins; no more is needed to see that a panel does not fit. */
static ktg_status lay_quickly(ktg_context *context, fitting *f) {
    uint32_t iterations = 0;
    f->limit->work += f->panel->face_count;
    KTG_TRY(ktg_conformal_start(context, f->panel, f->rests, f->flat));
    return ktg_descend(context, f->panel, f->rests, KTG_ENERGY_ARAP, NULL, f->flat, &iterations);
}

/* Does it come out as ktg_flatten would accept it? Asked only where the strain is within the limit
 * or nearly so: folds are then few, and the injective method may have to take over. */
static ktg_status settle(ktg_context *context, fitting *f, ktg_fit *fit) {
    KTG_TRY(find_soundness(context, f->panel, f->flat, f->limit, fit));
    if (fit->flat)
        return KTG_OK;
    ktg_flatten_options options;
    ktg_panel_report report = {0};
    ktg_flatten_defaults(&options);
    options.method = KTG_FLATTEN_INJECTIVE;
    f->limit->work += 2 * (uint64_t)f->panel->face_count;
    ktg_status status = ktg_lay_flat(context, f->panel, &options, f->flat, &report);
    if (status != KTG_OK && status != KTG_GEOMETRY)
        return status;
    KTG_TRY(ktg_fit_of_flat(context, f->panel, f->flat, f->limit, fit));
    if (!fit->flat)
        fit->excess += fit->area / 4;
    return KTG_OK;
}

static ktg_status measure(ktg_context *context, const ktg_mesh *mesh, fitting *f, ktg_fit *fit) {
    KTG_TRY(ktg_panel_new(context, mesh, &f->panel));
    KTG_TRY(ktg_rests_new(context, f->panel, &f->rests));
    f->flat = ktg_new(context, f->panel->vertex_count, ktg_vec2);
    if (!f->flat)
        return KTG_MEMORY;
    ktg_status status = lay_quickly(context, f);
    if (status != KTG_OK && status != KTG_GEOMETRY)
        return status;
    if (status == KTG_GEOMETRY) /* too long and thin for the digits: cut on */
        for (uint32_t v = 0; v < f->panel->vertex_count; v++)
            f->flat[v] = (ktg_vec2){0, 0};
    add_up(f->panel, f->flat, f->limit->max_strain, fit);
    KTG_TRY(find_waste(context, f->panel, f->flat, fit));
    if (!f->limit->thorough && fit->beyond > 2 * (1 - f->limit->area_part))
        return KTG_OK;
    return settle(context, f, fit);
}

ktg_status ktg_fit_measure(ktg_context *context, const ktg_mesh *mesh, ktg_fit_limit *limit,
                           ktg_fit *fit) {
    fitting f = {.limit = limit};
    ktg_status status = measure(context, mesh, &f, fit);
    ktg_panel_free(&f.panel);
    ktg_free(f.rests);
    ktg_free(f.flat);
    return status;
}

/* ---- scales -------------------------------------------------------------------------------- */

typedef struct scaling {
    ktg_panel *panel;
    ktg_rest *rests;
    ktg_laplacian *inside;
    double *weights;
    bool *held;
    ktg_vec2 *u;
} scaling;

/* L u = -K inside, u = 0 on the border (flatten/start.c). */
static ktg_status solve_scales(ktg_context *context, const ktg_mesh *mesh, scaling *s) {
    KTG_TRY(ktg_panel_new(context, mesh, &s->panel));
    KTG_TRY(ktg_rests_new(context, s->panel, &s->rests));
    s->weights = ktg_new(context, s->panel->adjacency->edge_count, double);
    s->held = ktg_new(context, mesh->vertex_count, bool);
    s->u = ktg_new(context, mesh->vertex_count, ktg_vec2);
    if (!s->weights || !s->held || !s->u)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        s->held[v] = s->panel->adjacency->twin[s->panel->leaving[v]] == KTG_NONE;
    ktg_cotangent_weights(s->panel, s->rests, s->weights);
    KTG_TRY(ktg_laplacian_new(context, s->panel, s->held, &s->inside));
    KTG_TRY(ktg_laplacian_factor(context, s->inside, s->weights));
    ktg_angle_defects(s->panel, s->rests, s->u);
    return ktg_laplacian_solve(context, s->inside, s->u, s->u);
}

ktg_status ktg_fit_scales(ktg_context *context, const ktg_mesh *mesh, double *scale) {
    scaling s = {0};
    ktg_status status = solve_scales(context, mesh, &s);
    for (uint32_t v = 0; status == KTG_OK && v < mesh->vertex_count; v++)
        scale[v] = fabs(s.u[v].x);
    ktg_panel_free(&s.panel);
    ktg_free(s.rests);
    ktg_laplacian_free(&s.inside);
    ktg_free(s.weights);
    ktg_free(s.held);
    ktg_free(s.u);
    return status;
}
