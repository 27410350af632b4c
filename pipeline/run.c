/* pipeline/run.c - the whole job, stage by stage. */
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "pipeline/hand.h"
#include "pipeline/outputs.h"
#include "pipeline/paint.h"
#include "pipeline/size.h"
#include "pipeline/stages.h"

#include <string.h>

/* The file's name without folder and ending; "model" where nothing is left. Free with ktg_free. */
static char *title_of(ktg_context *context, const char *path) {
    const char *name = ktg_base_name(path), *dot = strrchr(name, '.');
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

/* Deforms the model, if that is wanted. */
static ktg_status change(ktg_context *context, const ktg_pipeline_options *options, ktg_mesh *mesh,
                         ktg_pipeline_report *report) {
    ktg_edit *edit = NULL;
    if (!options->edit)
        return KTG_OK;
    ktg_status status = ktg_edit_read(context, options->edit, mesh, &edit);
    if (status == KTG_OK)
        status = ktg_about_file(context, options->model,
                                ktg_deform_mesh(context, mesh, edit, &report->deform));
    ktg_edit_free(&edit);
    if (status == KTG_OK)
        ktg_pipeline_tell_deform(context, &report->deform);
    return status;
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

static ktg_status repair(ktg_context *context, const ktg_pipeline_options *options, ktg_mesh *mesh,
                         ktg_pipeline_report *report) {
    KTG_TRY(ktg_mesh_check(context, mesh, false, &report->model));
    if (options->part_groups && options->mode == KTG_CLOTH)
        KTG_TRY(ktg_mesh_group_components(context, mesh, "part"));
    ktg_progress(context, "repair", 0, NULL);
    KTG_TRY(ktg_mesh_repair(context, mesh, &report->repair));
    tell_repair(context, &report->repair);
    double extent;
    return ktg_mesh_check_extent(context, mesh, &extent);
}

/* What was left of the model's faces may pass through each other. */
static ktg_status look_for_intersections(ktg_context *context, const ktg_mesh *mesh,
                                         ktg_pipeline_report *report) {
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

/* What one run takes and frees. */
typedef struct job {
    ktg_mesh *mesh;
    ktg_pattern *pattern;
    ktg_paint *paint;
    ktg_hand hand;
    char *title;
    ktg_outputs outputs;
    double start;
} job;

/* Texture coordinates that nothing goes by would only hinder the simplification. */
static void drop_idle_uvs(const ktg_pipeline_options *options, const ktg_paint *paint,
                          ktg_mesh *mesh) {
    if ((paint && ktg_paint_is_picture(paint)) ||
        (options->mode == KTG_CLOTH && options->flatten.seams & KTG_SEAMS_UV))
        return;
    ktg_free(mesh->face_uv);
    ktg_free(mesh->uvs);
    mesh->face_uv = NULL;
    mesh->uvs = NULL;
    mesh->uv_count = 0;
}

static ktg_status shape(ktg_context *context, const ktg_pipeline_options *options, job *j,
                        ktg_pipeline_report *report) {
    KTG_TRY(repair(context, options, j->mesh, report));
    KTG_TRY(ktg_paint_of_model(context, options, j->mesh, &j->paint, &report->paint));
    drop_idle_uvs(options, j->paint, j->mesh);
    KTG_TRY(simplify(context, options, j->mesh, report));
    KTG_TRY(look_for_intersections(context, j->mesh, report));
    KTG_TRY(ktg_hand_make_rules(context, options, j->mesh, &j->hand));
    ktg_stage stage = {options, j->mesh, &j->hand, j->title, report};
    KTG_TRY(ktg_stage_pattern(context, &stage, &j->pattern));
    return j->paint ? ktg_paint_onto_pattern(context, j->mesh, j->pattern, j->paint, &report->paint)
                    : KTG_OK;
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
    KTG_TRY(ktg_hand_read(context, options, j->mesh, &j->hand));
    KTG_TRY(change(context, options, j->mesh, report));
    KTG_TRY(ktg_hand_take(context, options, j->mesh, &j->hand));
    KTG_TRY(ktg_about_file(context, options->model, shape(context, options, j, report)));
    ktg_pipeline_options with_title = *options;
    if (!with_title.render.title)
        with_title.render.title = j->title;
    with_title.render.strain_limit = options->flatten.strain_limit;
    with_title.render.up = (unsigned)(ktg_size_up(options) - KTG_AXIS_X);
    with_title.render.paint = j->paint;
    with_title.render.marker = options->marker;
    KTG_TRY(ktg_outputs_write(context, &with_title, j->pattern, &j->outputs));
    report->seconds = ktg_clock_seconds() - j->start;
    KTG_TRY(ktg_outputs_write_report(context, options, report, j->pattern, &j->outputs));
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_outputs_finish(context, &j->outputs));
    if (options->made)
        options->made(options->user, report);
    return ktg_outputs_commit(context, &j->outputs);
}

void ktg_pipeline_report_free(ktg_pipeline_report *report) {
    if (report)
        ktg_flatten_report_free(&report->flatten);
}

ktg_status ktg_pipeline_run(ktg_context *context, const ktg_pipeline_options *options,
                            ktg_pipeline_report *report) {
    ktg_pipeline_report own = {0};
    job j = {.start = ktg_clock_seconds()};
    ktg_status status = run(context, options, &j, &own);
    own.seconds = ktg_clock_seconds() - j.start;
    if (report)
        *report = own;
    else
        ktg_pipeline_report_free(&own);
    ktg_outputs_discard(&j.outputs);
    ktg_pattern_free(&j.pattern);
    ktg_paint_free(&j.paint);
    ktg_mesh_free(&j.mesh);
    ktg_hand_free(&j.hand);
    ktg_free(j.title);
    return status;
}
