/* unfold/unfold.c - the whole unfolding: part by part, then the pattern around the pieces. */
#include "unfold/unfold.h"
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/check.h"
#include "unfold/edges.h"
#include "unfold/goal.h"
#include "unfold/join.h"
#include "unfold/pieces.h"
#include "unfold/rules.h"
#include "unfold/sheets.h"

#include <string.h>

void ktg_unfold_defaults(ktg_unfold_options *options) {
    *options = (ktg_unfold_options){.method = KTG_METHOD_AUTO,
                                    .effort = KTG_EFFORT_NORMAL,
                                    .population = 32,
                                    .generations = 2000,
                                    .patience = 30,
                                    .crossover_rate = 0.8,
                                    .mutation_rate = 0.1,
                                    .restarts = 20};
    ktg_sheet_defaults(&options->sheet);
    ktg_finish_defaults(&options->finish);
}

static ktg_status check_options(ktg_context *context, const ktg_unfold_options *o) {
    if (o->population < 4 || o->population > 10000)
        return ktg_fail(context, KTG_ARGUMENT, "a population of %u: from 4 to 10000 are possible",
                        o->population);
    if (!(o->crossover_rate >= 0 && o->crossover_rate <= 1))
        return ktg_fail(context, KTG_ARGUMENT, "a crossover rate of %g: from 0 to 1 is possible",
                        o->crossover_rate);
    if (!(o->mutation_rate >= 0 && o->mutation_rate <= 1))
        return ktg_fail(context, KTG_ARGUMENT, "a mutation rate of %g: from 0 to 1 is possible",
                        o->mutation_rate);
    double margins = 2 * o->sheet.margin_mm;
    if (!(o->sheet.width_mm - margins > 1) || !(o->sheet.height_mm - margins > 1))
        return ktg_fail(context, KTG_ARGUMENT, "margins of %g mm leave nothing of a sheet",
                        o->sheet.margin_mm);
    if (!(o->ease >= 0 && o->ease <= 10))
        return ktg_fail(context, KTG_ARGUMENT, "ease of assembly weighs 0 to 10, not %g", o->ease);
    if (!(o->mm_per_unit >= 0) || !isfinite(o->mm_per_unit))
        return ktg_fail(context, KTG_ARGUMENT, "a scale of %g mm for a unit", o->mm_per_unit);
    if (!(o->seconds >= 0))
        return ktg_fail(context, KTG_ARGUMENT, "a time limit of %g seconds; 0 is none", o->seconds);
    return KTG_OK;
}

/* The power of two that brings the largest extent of the mesh into [1, 2). Products of two lengths
 * of the model itself, as edges.c makes them, stay in range. */
static ktg_status normalising_scale(ktg_context *context, const ktg_mesh *mesh, double *scale) {
    double extent;
    KTG_TRY(ktg_mesh_check_extent(context, mesh, &extent));
    *scale = ldexp(1, -ilogb(extent));
    return KTG_OK;
}

static void mark_folds(const ktg_dual *dual, const ktg_adjacency *adjacency, const bool *joined,
                       bool *is_fold) {
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        uint32_t h = dual->edges[e].halfedge[0];
        is_fold[adjacency->halfedge_edge[3 * dual->mesh_face[h / 3] + h % 3]] = joined[e];
    }
}

/* Components up to this many faces get a second chance by the paper's method where transplants left
 * several pieces; with little effort that starts afresh only so often. */
#define SECOND_CHANCE  2000
#define QUICK_RESTARTS 3

static ktg_status second_chance(ktg_context *context, const ktg_dual *dual,
                                const ktg_unfold_options *options, ktg_search *search, bool *joined,
                                uint32_t *pieces) {
    ktg_unfold_options own = *options;
    if (own.effort == KTG_EFFORT_QUICK && own.restarts > QUICK_RESTARTS)
        own.restarts = QUICK_RESTARTS;
    return ktg_join_genetic(context, dual, &own, search, joined, pieces);
}

static ktg_status join_freely(ktg_context *context, const ktg_dual *dual,
                              const ktg_unfold_options *options, ktg_search *search, bool *joined) {
    uint32_t pieces = 0, other = 0;
    if (options->method == KTG_METHOD_GENETIC)
        return ktg_join_genetic(context, dual, options, search, joined, &pieces);
    KTG_TRY(ktg_join_transplant(context, dual, options, search, joined, &pieces));
    if (pieces == 1 || dual->face_count > SECOND_CHANCE || !ktg_search_goes_on(context, search))
        return KTG_OK;
    bool *trial = ktg_new(context, dual->edge_count, bool);
    ktg_status status =
        trial ? second_chance(context, dual, options, search, trial, &other) : KTG_MEMORY;
    if (status == KTG_OK && other < pieces)
        memcpy(joined, trial, dual->edge_count * sizeof *joined);
    ktg_free(trial);
    return status;
}

/* As few pieces as there can be, or as the sheet allows. */
static ktg_status join(ktg_context *context, const ktg_dual *dual,
                       const ktg_unfold_options *options, ktg_search *search, bool *joined) {
    uint32_t pieces = 0;
    if (!ktg_sheets_wanted(options))
        return join_freely(context, dual, options, search, joined);
    if (ktg_sheets_least(dual, options, search) == 1)
        KTG_TRY(join_freely(context, dual, options, search, joined));
    return ktg_sheets_divide(context, dual, options, search, joined, &pieces);
}

typedef struct work {
    const ktg_mesh *mesh;
    const ktg_adjacency *adjacency;
    const ktg_unfold_options *options;
    double scale;
    ktg_search search;
    ktg_rules rules;
    ktg_parts parts;
    uint32_t *face_component;
    uint32_t component_count;
    bool *is_fold; /* per edge of the adjacency */
    size_t pieces_capacity;
} work;

static ktg_status part_dual(ktg_context *context, const work *w, uint32_t part, ktg_dual **dual) {
    uint32_t begin = w->parts.first[part], count = w->parts.first[part + 1] - begin;
    KTG_TRY(ktg_dual_new(context, w->mesh, &w->rules.adjacency, w->parts.faces + begin, count,
                         w->scale, dual));
    ktg_rules_apply(&w->rules, w->adjacency, *dual);
    return KTG_OK;
}

/* Before any part is searched: what cannot be is said at once. */
static ktg_status check_kept(ktg_context *context, const work *w) {
    ktg_status status = KTG_OK;
    if (w->options->rule_count == 0)
        return KTG_OK;
    for (uint32_t part = 0; status == KTG_OK && part < w->parts.count; part++) {
        ktg_dual *dual = NULL;
        status = part_dual(context, w, part, &dual);
        if (status == KTG_OK)
            status = ktg_kept_check(context, w->mesh, &w->rules, dual, w->scale);
        ktg_dual_free(&dual);
    }
    return status;
}

static ktg_status unfold_dual(ktg_context *context, work *w, ktg_dual *dual, uint32_t part,
                              bool *joined, ktg_pattern *pattern) {
    ktg_random_seed(&w->search.random, ktg_context_seed(context) + part);
    w->search.generations_before = w->search.report.generations;
    if (ktg_sheets_wanted(w->options))
        KTG_TRY(ktg_sheets_loosen(context, w->options, w->search.mm, dual));
    KTG_TRY(join(context, dual, w->options, &w->search, joined));
    KTG_TRY(ktg_pieces_append(context, dual, w->scale, joined, w->parts.component[part], pattern,
                              &w->pieces_capacity));
    KTG_TRY(ktg_kept_are_folds(context, &w->rules, dual, joined));
    mark_folds(dual, w->adjacency, joined, w->is_fold);
    w->search.faces_done += dual->face_count;
    return KTG_OK;
}

static ktg_status unfold_part(ktg_context *context, work *w, uint32_t part, ktg_pattern *pattern) {
    ktg_dual *dual = NULL;
    KTG_TRY(part_dual(context, w, part, &dual));
    bool *joined = ktg_new(context, dual->edge_count, bool);
    ktg_status status = joined ? unfold_dual(context, w, dual, part, joined, pattern) : KTG_MEMORY;
    ktg_free(joined);
    ktg_dual_free(&dual);
    return status;
}

/* The surface and the components' names. */
static ktg_status start_pattern(ktg_context *context, const work *w, const char *name,
                                ktg_pattern *pattern) {
    const ktg_mesh *mesh = w->mesh;
    pattern->mode = KTG_PAPER;
    pattern->model_faces = mesh->face_count;
    pattern->vertex_count = mesh->vertex_count;
    pattern->face_count = mesh->face_count;
    pattern->vertices =
        ktg_copy_array(context, mesh->positions, mesh->vertex_count, sizeof *mesh->positions);
    pattern->faces =
        ktg_copy_array(context, mesh->faces, 3 * (size_t)mesh->face_count, sizeof *mesh->faces);
    pattern->components = ktg_new(context, w->component_count, ktg_pattern_component);
    if (!pattern->vertices || !pattern->faces || !pattern->components)
        return KTG_MEMORY;
    ktg_names names;
    KTG_TRY(ktg_mesh_component_names(context, mesh, w->face_component, w->component_count, name,
                                     &names));
    pattern->component_count = w->component_count;
    for (uint32_t c = 0; c < w->component_count; c++) {
        pattern->components[c].name = names.text[c]; /* handed over */
        names.text[c] = NULL;
    }
    ktg_names_free(&names);
    return KTG_OK;
}

static ktg_status name_pieces(ktg_context *context, ktg_pattern *pattern) {
    for (size_t i = 0; i < pattern->piece_count; i++) {
        const char *name = pattern->components[pattern->pieces[i].component].name;
        pattern->pieces[i].name = ktg_copy_text(context, name, SIZE_MAX);
        if (!pattern->pieces[i].name)
            return KTG_MEMORY;
    }
    return KTG_OK;
}

static void mark_forced(const work *w, ktg_pattern *pattern) {
    for (uint32_t e = 0; e < w->adjacency->edge_count; e++)
        pattern->edges[e].forced = ktg_rules_cut(&w->rules, e);
}

static double face_area(const ktg_mesh *mesh, uint32_t face) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    ktg_vec3 a = mesh->positions[v[0]], b = mesh->positions[v[1]], c = mesh->positions[v[2]];
    return 0.5 * ktg_length3(ktg_cross3(ktg_sub3(b, a), ktg_sub3(c, a)));
}

static void set_goal(work *w) {
    double area = 0;
    for (uint32_t f = 0; f < w->mesh->face_count; f++)
        area += face_area(w->mesh, f);
    w->search.area_all = area * w->scale * w->scale;
    w->search.mm = ktg_goal_mm(w->options, w->search.area_all, w->scale);
}

static ktg_status fill_pattern(ktg_context *context, work *w, const char *name,
                               ktg_pattern *pattern) {
    KTG_TRY(ktg_rules_new(context, w->mesh, w->adjacency, w->options, &w->rules));
    KTG_TRY(ktg_mesh_components(context, w->mesh, w->adjacency, &w->face_component,
                                &w->component_count));
    KTG_TRY(ktg_parts_new(context, w->mesh, &w->rules, w->face_component, w->component_count,
                          &w->parts));
    w->is_fold = ktg_new(context, w->adjacency->edge_count, bool);
    if (!w->is_fold)
        return KTG_MEMORY;
    set_goal(w);
    KTG_TRY(ktg_sheets_check_faces(context, w->mesh, w->options));
    KTG_TRY(start_pattern(context, w, name, pattern));
    KTG_TRY(check_kept(context, w));
    for (uint32_t part = 0; part < w->parts.count; part++) {
        KTG_TRY(unfold_part(context, w, part, pattern));
        KTG_TRY(ktg_check_cancel(context));
    }
    KTG_TRY(ktg_pieces_sort(context, pattern));
    KTG_TRY(name_pieces(context, pattern));
    KTG_TRY(ktg_edges_fill(context, w->adjacency, w->is_fold, pattern));
    mark_forced(w, pattern);
    return KTG_OK;
}

static void fill_report(work *w, const ktg_pattern *pattern, ktg_unfold_report *report) {
    ktg_unfold_report *r = &w->search.report;
    r->pieces = (uint32_t)pattern->piece_count;
    r->components = w->component_count;
    r->parts = w->parts.count;
    if (w->options->method == KTG_METHOD_AUTO && r->pieces == r->parts)
        r->seconds_to_one_piece = w->search.seconds;
    if (report)
        *report = *r;
}

static void release(work *w) {
    ktg_free(w->face_component);
    ktg_free(w->is_fold);
    ktg_parts_free(&w->parts);
    ktg_rules_free(&w->rules);
    w->face_component = NULL;
    w->is_fold = NULL;
    w->pieces_capacity = 0;
}

static ktg_status make_pattern(ktg_context *context, work *w, const char *name,
                               ktg_pattern **pattern) {
    *pattern = ktg_new(context, 1, ktg_pattern);
    ktg_status status = *pattern ? fill_pattern(context, w, name, *pattern) : KTG_MEMORY;
    if (status != KTG_OK)
        ktg_pattern_free(pattern);
    return status;
}

/* Pieces that were found to fit do so in all likelihood; where tabs come out otherwise in the whole
 * pattern, everything is done again with room to spare. */
static ktg_status make_fitting(ktg_context *context, work *w, const char *name,
                               ktg_pattern **pattern) {
    bool fit = true;
    KTG_TRY(make_pattern(context, w, name, pattern));
    ktg_status status = ktg_sheets_fit(context, w->options, *pattern, &fit);
    if (status != KTG_OK || !fit)
        ktg_pattern_free(pattern);
    if (status != KTG_OK || fit)
        return status;
    release(w);
    w->search.careful = true;
    w->search.faces_done = 0;
    return make_pattern(context, w, name, pattern);
}

ktg_status ktg_unfold(ktg_context *context, const ktg_mesh *mesh, const char *name,
                      const ktg_unfold_options *options, ktg_pattern **pattern,
                      ktg_unfold_report *report) {
    ktg_unfold_options defaults;
    ktg_unfold_defaults(&defaults);
    work w = {.mesh = mesh, .options = options ? options : &defaults};
    ktg_adjacency *adjacency = NULL;
    *pattern = NULL;
    KTG_TRY(check_options(context, w.options));
    if (mesh->face_count == 0)
        return ktg_fail(context, KTG_GEOMETRY, "there are no faces to unfold");
    KTG_TRY(ktg_adjacency_new(context, mesh, &adjacency));
    w.adjacency = adjacency;
    w.search.faces_all = mesh->face_count;
    w.search.deadline = w.options->seconds > 0 ? ktg_clock_seconds() + w.options->seconds : 0;
    ktg_status status = normalising_scale(context, mesh, &w.scale);
    if (status == KTG_OK)
        status = ktg_unfold_check(context, mesh, adjacency);
    if (status == KTG_OK)
        status = make_fitting(context, &w, name, pattern);
    if (status == KTG_OK)
        fill_report(&w, *pattern, report);
    release(&w);
    ktg_adjacency_free(&adjacency);
    return status;
}
