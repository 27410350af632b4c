/* flatten/flatten.c - the whole way from a mesh to a flat pattern. */
#include "flatten/flatten.h"
#include "core/clock.h"
#include "core/memory.h"
#include "flatten/kernel.h"

void ktg_flatten_defaults(ktg_flatten_options *options) {
    *options = (ktg_flatten_options){
        .method = KTG_FLATTEN_ARAP, .weight = KTG_WEIGHT_COTANGENT, .strain_limit = 0.05};
}

const char *ktg_flatten_method_name(ktg_flatten_method method) {
    static const char *const names[] = {"arap", "injective", "two-step"};
    return names[method];
}

static ktg_status check_options(ktg_context *context, const ktg_flatten_options *options) {
    if (options->method > KTG_FLATTEN_TWO_STEP || options->weight > KTG_WEIGHT_UNIT)
        return ktg_fail(context, KTG_ARGUMENT, "there is no such way to flatten");
    if (!(options->strain_limit >= 0))
        return ktg_fail(context, KTG_ARGUMENT, "a limit of strain is 0 or more");
    if (options->weight == KTG_WEIGHT_UNIT && options->method != KTG_FLATTEN_TWO_STEP)
        return ktg_fail(context, KTG_ARGUMENT,
                        "unit weights are for the two-step method only (--method two-step)");
    return KTG_OK;
}

static ktg_status refuse_flipped(ktg_context *context, const ktg_flatten_report *report,
                                 uint32_t first_flipped) {
    if (report->flipped_faces == 0)
        return KTG_OK;
    return ktg_fail(context, KTG_GEOMETRY,
                    "%u of %u faces (the first is face %u) fold over when the panel is laid flat: "
                    "it is too curved for one piece%s, or has needle-thin faces; cut it into "
                    "flatter panels by seams, or remesh it, first",
                    report->flipped_faces, report->faces, first_flipped + 1,
                    report->method == KTG_FLATTEN_TWO_STEP ? " by the two-step method" : "");
}

/* What the parts of ktg_flatten share; freed together. */
typedef struct flatten_work {
    ktg_panel *panel;
    ktg_vec2 *flat;
    double *face_strain;
} flatten_work;

static ktg_status flatten(ktg_context *context, const ktg_mesh *mesh, const char *name,
                          const ktg_flatten_options *options, flatten_work *work,
                          ktg_pattern **pattern, ktg_flatten_report *report) {
    uint32_t first_flipped;
    report->strain_limit = options->strain_limit;
    ktg_progress(context, "flatten", 0, NULL);
    KTG_TRY(check_options(context, options));
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_panel_new(context, mesh, &work->panel));
    KTG_TRY(ktg_panel_check_disk(context, mesh, work->panel));
    work->flat = ktg_new(context, mesh->vertex_count, ktg_vec2);
    work->face_strain = ktg_new(context, mesh->face_count, double);
    if (!work->flat || !work->face_strain)
        return KTG_MEMORY;
    KTG_TRY(ktg_lay_flat(context, work->panel, options, work->flat, report));
    ktg_progress(context, "flatten", 0.95, "strain");
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_strain_measure(context, work->panel, work->flat, work->face_strain, report,
                               &first_flipped));
    KTG_TRY(refuse_flipped(context, report, first_flipped));
    KTG_TRY(ktg_panel_check_overlap(context, work->panel, work->flat));
    KTG_TRY(
        ktg_flat_pattern(context, mesh, work->panel, name, work->flat, work->face_strain, pattern));
    ktg_progress(context, "flatten", 1, NULL);
    return KTG_OK;
}

ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh, const char *name,
                       const ktg_flatten_options *options, ktg_pattern **pattern,
                       ktg_flatten_report *report) {
    double start = ktg_clock_seconds();
    ktg_flatten_options defaults;
    ktg_flatten_report measured = {0};
    flatten_work work = {0};
    ktg_flatten_defaults(&defaults);
    *pattern = NULL;
    ktg_status status =
        flatten(context, mesh, name, options ? options : &defaults, &work, pattern, &measured);
    ktg_panel_free(&work.panel);
    ktg_free(work.flat);
    ktg_free(work.face_strain);
    measured.seconds = ktg_clock_seconds() - start;
    if (report)
        *report = measured;
    return status;
}
