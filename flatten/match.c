/* flatten/match.c - both sides of a seam equally long.
 *
 * No flattening keeps the length of a border, so that two panels would not fit each other. Each
 * edge of a seam is to become as long as the mean of its two sides; springs along the border pull
 * there while the panel finds the shape of least energy again. They are made stiffer until it
 * holds. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/surface.h"

#include <string.h>

/* Twice as good as asked of the whole (0.5 % of a seam), edge by edge. */
static const double tolerance = 0.002;

/* What can still be sewn, of an edge or, where that is shorter, of this part of the model. */
static const double bearable = 0.005, short_edge = 1e-5;

/* Stiffness of the springs in the first round, and its growth. A cotangent weight is about 1. */
static const double first_stiffness = 30, growth = 10;
enum { most_rounds = 5 };

/* The length of the surface's half-edge h in its panel, in the model's unit. */
static double flat_length(const ktg_flat_surface *s, uint32_t h) {
    const ktg_flat_panel *f = &s->flats[s->apart.face_panel[h / 3]];
    uint32_t first = 3 * s->apart.face_index[h / 3];
    const uint32_t *corners = f->panel->faces + first;
    ktg_vec2 a = f->flat[corners[h % 3]], b = f->flat[corners[(h + 1) % 3]];
    return ldexp(ktg_length2(ktg_sub2(b, a)), f->panel->exponent);
}

static bool is_sewn(const ktg_flat_surface *s, uint32_t h) {
    return s->adjacency->twin[h] != KTG_NONE && s->cut[s->adjacency->halfedge_edge[h]];
}

/* The difference of the two sides of a seam's edge, by the mean of both. */
static double mismatch(const ktg_flat_surface *s, uint32_t h) {
    double a = flat_length(s, h), b = flat_length(s, s->adjacency->twin[h]);
    return fabs(a - b) / ((a + b) / 2);
}

/* How far the worst edge of each panel is off; the worst of all. */
static double measure(const ktg_flat_surface *s, double *worst) {
    double most = 0;
    memset(worst, 0, s->apart.count * sizeof *worst);
    for (uint32_t h = 0; h < s->adjacency->halfedge_count; h++) {
        if (!is_sewn(s, h))
            continue;
        double off = mismatch(s, h);
        uint32_t p = s->apart.face_panel[h / 3];
        worst[p] = fmax(worst[p], off);
        most = fmax(most, off);
    }
    return most;
}

/* The wished length of each edge that is sewn, in the model's unit. */
static void set_targets(const ktg_flat_surface *s, double *targets) {
    for (uint32_t h = 0; h < s->adjacency->halfedge_count; h++)
        if (is_sewn(s, h))
            targets[s->adjacency->halfedge_edge[h]] =
                (flat_length(s, h) + flat_length(s, s->adjacency->twin[h])) / 2;
}

static ktg_status make_springs(ktg_context *context, const ktg_flat_surface *s, uint32_t p,
                               const double *targets, ktg_springs *springs) {
    const ktg_panel *panel = s->flats[p].panel;
    const uint32_t *face = s->apart.panels[p].face;
    springs->halfedges = ktg_new(context, panel->adjacency->halfedge_count, uint32_t);
    springs->lengths = ktg_new(context, panel->adjacency->halfedge_count, double);
    if (!springs->halfedges || !springs->lengths)
        return KTG_MEMORY;
    for (uint32_t g = 0; g < panel->adjacency->halfedge_count; g++) {
        uint32_t h = 3 * face[g / 3] + g % 3;
        if (!is_sewn(s, h))
            continue;
        springs->halfedges[springs->count] = g;
        springs->lengths[springs->count++] =
            ldexp(targets[s->adjacency->halfedge_edge[h]], -panel->exponent);
    }
    return KTG_OK;
}

static void free_springs(ktg_springs *springs) {
    ktg_free(springs->halfedges);
    ktg_free(springs->lengths);
}

static ktg_status is_sound(ktg_context *context, const ktg_flat_panel *f, bool *sound) {
    uint32_t vertices[2];
    bool crossed = false;
    *sound = ktg_panel_count_flipped(f->panel, f->flat) == 0;
    if (!*sound)
        return KTG_OK;
    KTG_TRY(ktg_panel_find_crossing(context, f->panel, f->flat, &crossed, vertices));
    *sound = !crossed;
    return KTG_OK;
}

/* As rigid as possible if the panel was and no face folds that way, else without folds. A panel
 * that was unsound before stays as it is, to be refused. */
static ktg_status pull_panel(ktg_context *context, ktg_flat_panel *f, const ktg_springs *springs,
                             ktg_vec2 *before) {
    ktg_rest *rests = NULL;
    bool sound;
    KTG_TRY(is_sound(context, f, &sound));
    if (!sound)
        return KTG_OK;
    KTG_TRY(ktg_rests_new(context, f->panel, &rests));
    memcpy(before, f->flat, f->panel->vertex_count * sizeof *before);
    ktg_status status = KTG_OK;
    sound = false;
    if (f->report.method != KTG_FLATTEN_INJECTIVE) {
        status = ktg_descend(context, f->panel, rests, KTG_ENERGY_ARAP, springs, f->flat,
                             &f->report.iterations);
        if (status == KTG_OK)
            status = is_sound(context, f, &sound);
        if (!sound)
            memcpy(f->flat, before, f->panel->vertex_count * sizeof *before);
    }
    if (status == KTG_OK && !sound)
        status = ktg_descend(context, f->panel, rests, KTG_ENERGY_DIRICHLET, springs, f->flat,
                             &f->report.iterations);
    ktg_free(rests);
    return status;
}

static ktg_status match_panel(ktg_context *context, ktg_flat_surface *s, uint32_t p,
                              const double *targets, double stiffness) {
    ktg_flat_panel *f = &s->flats[p];
    ktg_springs springs = {.stiffness = stiffness};
    ktg_vec2 *before = ktg_new(context, f->panel->vertex_count, ktg_vec2);
    ktg_status status = before ? make_springs(context, s, p, targets, &springs) : KTG_MEMORY;
    if (status == KTG_OK)
        status = pull_panel(context, f, &springs, before);
    free_springs(&springs);
    ktg_free(before);
    return status;
}

/* Each round pulls only panels that are off; a panel whose seams fit already keeps its shape. */
static ktg_status match(ktg_context *context, ktg_flat_surface *s, double *worst, double *targets) {
    double stiffness = first_stiffness;
    set_targets(s, targets);
    for (int round = 0; round < most_rounds; round++, stiffness *= growth) {
        if (measure(s, worst) <= tolerance || ktg_wants_finish(context))
            break;
        ktg_progress(context, "seams", (double)round / most_rounds, NULL);
        for (uint32_t p = 0; p < s->apart.count; p++) {
            KTG_TRY(ktg_check_cancel(context));
            if (worst[p] > tolerance)
                KTG_TRY(match_panel(context, s, p, targets, stiffness));
        }
    }
    return KTG_OK;
}

ktg_status ktg_seams_match(ktg_context *context, ktg_flat_surface *s) {
    double *worst = ktg_new(context, s->apart.count, double);
    double *targets = ktg_new(context, s->adjacency->edge_count, double);
    ktg_status status = worst && targets ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK && s->options->match_seams)
        status = match(context, s, worst, targets);
    if (status == KTG_OK)
        s->report->seam_error = measure(s, worst);
    ktg_free(worst);
    ktg_free(targets);
    return status;
}

ktg_status ktg_seams_check(ktg_context *context, const ktg_flat_surface *s) {
    double extent;
    KTG_TRY(ktg_mesh_check_extent(context, s->mesh, &extent));
    bool unmatched = !s->options->match_seams || ktg_wants_finish(context);
    for (uint32_t h = 0; h < s->adjacency->halfedge_count && !unmatched; h++) {
        if (!is_sewn(s, h) || mismatch(s, h) <= tolerance)
            continue;
        double a = flat_length(s, h), b = flat_length(s, s->adjacency->twin[h]);
        const uint32_t *corners = s->mesh->faces + h / 3 * 3;
        ktg_vec3 at = s->mesh->positions[corners[h % 3]];
        if (fabs(a - b) > bearable * fmax(fmax(a, b), short_edge * extent))
            return ktg_fail(context, KTG_GEOMETRY,
                            "laid flat, the seam at (%g, %g, %g) is %g long on one side and %g on "
                            "the other, and cannot be sewn: faces there are too long and thin; "
                            "remesh the model, or simplify it (--faces)",
                            at.x, at.y, at.z, a, b);
    }
    return KTG_OK;
}
