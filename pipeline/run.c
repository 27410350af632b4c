/* pipeline/run.c - the whole job, stage by stage. */
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "pipeline/hand.h"
#include "pipeline/outputs.h"
#include "pipeline/sheets.h"
#include "pipeline/size.h"

#include <string.h>

static const char *base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The file's name without folder and ending; "model" where nothing is left. Free with ktg_free. */
static char *title_of(ktg_context *context, const char *path) {
    const char *name = base_name(path), *dot = strrchr(name, '.');
    size_t length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    if (length == 0 || strcmp(path, "-") == 0)
        return ktg_copy_text(context, "model", SIZE_MAX);
    return ktg_copy_text(context, name, length);
}

static void tell_repair(ktg_context *context, const ktg_repair_report *r) {
    const struct {
        uint32_t count;
        const char *what;
    } done[] = {{r->duplicate_faces_removed, "duplicate faces removed"},
                {r->degenerate_faces_removed, "degenerate faces removed"},
                {r->unreferenced_vertices_removed, "unused vertices removed"},
                {r->vertices_welded, "vertices welded along open seams"},
                {r->faces_turned, "faces turned the right way round"},
                {r->nonmanifold_edges_split, "edges with more than two faces split"},
                {r->nonmanifold_vertices_split, "vertices where sheets touch split"},
                {r->seams_opened, "edges cut because the surface has only one side"}};
    for (size_t i = 0; i < sizeof done / sizeof *done; i++)
        if (done[i].count > 0)
            ktg_log(context, KTG_LOG_NOTE, "repaired: %s: %u", done[i].what, done[i].count);
}

static ktg_status simplify(ktg_context *context, const ktg_pipeline_options *options,
                           ktg_mesh *mesh, ktg_pipeline_report *report) {
    report->simplify.faces_before = report->simplify.faces_after = mesh->face_count;
    report->simplify.target_reached = true;
    if (options->faces == KTG_ALL_FACES || mesh->face_count <= options->faces)
        return KTG_OK;
    ktg_progress(context, "simplify", 0, NULL);
    KTG_TRY(ktg_hand_check_simplify(context, options, mesh));
    KTG_TRY(ktg_mesh_simplify(context, mesh, options->faces, &report->simplify));
    if (report->simplify.faces_after < report->simplify.faces_before)
        ktg_log(context, KTG_LOG_NOTE, "simplified from %u to %u faces",
                report->simplify.faces_before, report->simplify.faces_after);
    if (!report->simplify.target_reached)
        ktg_log(context, KTG_LOG_WARNING,
                "fewer than %u faces would change the model's topology or fold it%s",
                report->simplify.faces_after,
                mesh->marked_count > 0 ? ", or an edge that is to be kept or cut" : "");
    return KTG_OK;
}

/* Fewer pieces than somebody asked for are not passed over in silence. */
static void tell_pieces(ktg_context *context, const ktg_unfold_options *options,
                        const ktg_unfold_report *report) {
    uint64_t wanted = (uint64_t)options->pieces * report->parts;
    bool stopped =
        report->stopped_by == KTG_STOPPED_TIME || report->stopped_by == KTG_STOPPED_INTERRUPT;
    if (report->pieces < wanted && !stopped)
        ktg_log(context, KTG_LOG_WARNING,
                "%u pieces instead of %llu: there are no more faces, or edges that may be cut",
                report->pieces, (unsigned long long)wanted);
}

static ktg_status repair(ktg_context *context, const ktg_pipeline_options *options, ktg_mesh *mesh,
                         ktg_pipeline_report *report) {
    KTG_TRY(ktg_mesh_check(context, mesh, false, &report->model));
    ktg_progress(context, "repair", 0, NULL);
    KTG_TRY(ktg_mesh_repair(context, mesh, &report->repair));
    tell_repair(context, &report->repair);
    KTG_TRY(simplify(context, options, mesh, report));
    ktg_mesh_report surface;
    KTG_TRY(ktg_mesh_check(context, mesh, true, &surface));
    report->self_intersections = surface.self_intersections;
    if (surface.self_intersections > 0)
        ktg_log(context, KTG_LOG_WARNING,
                "%u pairs of faces pass through each other; the finished thing will have to do so "
                "too",
                surface.self_intersections);
    return KTG_OK;
}

static ktg_status make_pieces(ktg_context *context, const ktg_pipeline_options *options,
                              const ktg_mesh *mesh, const ktg_hand *hand, const char *title,
                              ktg_pattern **pattern, ktg_pipeline_report *report) {
    double start = ktg_clock_seconds();
    if (options->mode == KTG_PAPER) {
        ktg_progress(context, "unfold", 0, NULL);
        ktg_unfold_options unfold = options->unfold;
        unfold.sheet = options->layout.sheet;
        unfold.finish = options->finish;
        unfold.rules = hand->rules;
        unfold.rule_count = hand->rule_count;
        KTG_TRY(ktg_size_known(context, options, mesh, &unfold.mm_per_unit));
        if (unfold.oversize == KTG_OVERSIZE_ERROR)
            unfold.mm_per_unit = 0; /* as large as can be, to say how large that is */
        KTG_TRY(ktg_unfold(context, mesh, title, &unfold, pattern, &report->unfold));
        tell_pieces(context, &unfold, &report->unfold);
    } else {
        ktg_progress(context, "flatten", 0, NULL);
        KTG_TRY(ktg_flatten(context, mesh, title, &options->flatten, pattern, &report->flatten));
    }
    report->seconds_unfold = ktg_clock_seconds() - start;
    ktg_pattern *p = *pattern;
    ktg_free(p->model_file);
    p->model_file = ktg_copy_text(context, base_name(options->model), SIZE_MAX);
    p->model_faces = report->model.faces;
    p->simplified = report->simplify.faces_after != report->simplify.faces_before;
    if (!p->model_file)
        return KTG_MEMORY;
    return ktg_pattern_set_omitted(context, p, options->omit, options->omit_count);
}

static ktg_status put_on_sheets(ktg_context *context, const ktg_pipeline_options *options,
                                ktg_pattern **pattern, ktg_pipeline_report *report) {
    ktg_progress(context, "sheets", 0, NULL);
    KTG_TRY(ktg_sheets_put(context, options, pattern, report));
    const ktg_pattern *p = *pattern;
    report->faces = p->face_count;
    report->pieces = (uint32_t)p->piece_count;
    report->components = (uint32_t)p->component_count;
    report->mm_per_unit = p->mm_per_unit;
    report->up = ktg_size_up(options);
    report->size_mm = ktg_size_of(p->vertices, p->vertex_count, report->up);
    return KTG_OK;
}

/* What one run takes and frees. */
typedef struct job {
    ktg_mesh *mesh;
    ktg_pattern *pattern;
    ktg_hand hand;
    char *title;
    ktg_outputs outputs;
    double start;
} job;

static ktg_status shape(ktg_context *context, const ktg_pipeline_options *options, job *j,
                        ktg_pipeline_report *report) {
    KTG_TRY(repair(context, options, j->mesh, report));
    KTG_TRY(ktg_hand_make_rules(context, options, j->mesh, &j->hand));
    KTG_TRY(make_pieces(context, options, j->mesh, &j->hand, j->title, &j->pattern, report));
    return put_on_sheets(context, options, &j->pattern, report);
}

static ktg_status run(ktg_context *context, const ktg_pipeline_options *options, job *j,
                      ktg_pipeline_report *report) {
    if (!options->model)
        return ktg_fail(context, KTG_ARGUMENT, "no model is named");
    KTG_TRY(ktg_size_check(context, options));
    KTG_TRY(ktg_outputs_check(context, options));
    j->title = title_of(context, options->model);
    if (!j->title)
        return KTG_MEMORY;
    ktg_progress(context, "read", 0, options->model);
    KTG_TRY(ktg_mesh_read(context, options->model, options->model_format, &j->mesh));
    KTG_TRY(ktg_hand_take(context, options, j->mesh, &j->hand));
    KTG_TRY(ktg_about_file(context, options->model, shape(context, options, j, report)));
    ktg_pipeline_options with_title = *options;
    if (!with_title.render.title)
        with_title.render.title = j->title;
    KTG_TRY(ktg_outputs_write(context, &with_title, j->pattern, &j->outputs));
    report->seconds = ktg_clock_seconds() - j->start;
    KTG_TRY(ktg_outputs_write_report(context, options, report, &j->outputs));
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_outputs_finish(context, &j->outputs));
    if (options->made)
        options->made(options->user, report);
    return ktg_outputs_commit(context, &j->outputs);
}

ktg_status ktg_pipeline_run(ktg_context *context, const ktg_pipeline_options *options,
                            ktg_pipeline_report *report) {
    ktg_pipeline_report own = {0};
    job j = {.start = ktg_clock_seconds()};
    ktg_status status = run(context, options, &j, &own);
    own.seconds = ktg_clock_seconds() - j.start;
    if (report)
        *report = own;
    ktg_outputs_discard(&j.outputs);
    ktg_pattern_free(&j.pattern);
    ktg_mesh_free(&j.mesh);
    ktg_hand_free(&j.hand);
    ktg_free(j.title);
    return status;
}
