/* pipeline/report.c - the figures of a run as JSON. */
#include "core/memory.h"
#include "pipeline/stages.h"

#include <inttypes.h>

static ktg_status put_number(ktg_context *context, ktg_output *output, const char *key,
                             double value) {
    return ktg_output_print(context, output, ",\n  \"%s\": %.17g", key, value);
}

static ktg_status put_text(ktg_context *context, ktg_output *output, const char *key,
                           const char *text) {
    return ktg_output_print(context, output, ",\n  \"%s\": \"%s\"", key, text);
}

/* A number as long as every reader of JSON keeps it exactly (2^53), else text. */
static ktg_status put_seed(ktg_context *context, ktg_output *output) {
    uint64_t seed = ktg_context_seed(context);
    const char *quote = seed > UINT64_C(1) << 53 ? "\"" : "";
    return ktg_output_print(context, output, ",\n  \"seed\": %s%" PRIu64 "%s", quote, seed, quote);
}

typedef struct figure {
    const char *key;
    double value;
} figure;

static ktg_status put_figures(ktg_context *context, ktg_output *output, const figure *figures,
                              size_t count) {
    for (size_t i = 0; i < count; i++)
        KTG_TRY(put_number(context, output, figures[i].key, figures[i].value));
    return KTG_OK;
}

static ktg_status put_paper(ktg_context *context, ktg_output *output,
                            const ktg_pipeline_report *r) {
    const figure figures[] = {{"parts", r->unfold.parts},
                              {"strips", r->unfold.strips},
                              {"generations", r->unfold.generations},
                              {"evaluations", (double)r->unfold.evaluations},
                              {"restarts", r->unfold.restarts},
                              {"seconds_to_one_piece", r->unfold.seconds_to_one_piece}};
    return put_figures(context, output, figures, sizeof figures / sizeof *figures);
}

static ktg_status put_cloth(ktg_context *context, ktg_output *output,
                            const ktg_pipeline_report *r) {
    const ktg_flatten_report *f = &r->flatten;
    const figure figures[] = {{"iterations", f->iterations},
                              {"flipped_by_arap", f->flipped_by_arap},
                              {"crossed_by_arap", f->crossed_by_arap},
                              {"flipped_faces", f->flipped_faces},
                              {"arap_energy", f->arap_energy},
                              {"symmetric_dirichlet", f->symmetric_dirichlet},
                              {"strain_mean", f->strain_mean},
                              {"strain_p95", f->strain_p95},
                              {"strain_max", f->strain_max},
                              {"strain_limit", f->strain_limit},
                              {"area_beyond_limit", f->area_beyond_limit},
                              {"border_error", f->border_error}};
    KTG_TRY(put_text(context, output, "method", ktg_flatten_method_name(f->method)));
    return put_figures(context, output, figures, sizeof figures / sizeof *figures);
}

ktg_status ktg_pipeline_write_report(ktg_context *context, const ktg_pipeline_options *options,
                                     const ktg_pipeline_report *r, ktg_output *output) {
    const figure figures[] = {{"faces_model", r->model.faces},
                              {"faces", r->faces},
                              {"pieces", r->pieces},
                              {"components", r->components},
                              {"self_intersections", r->self_intersections},
                              {"seams", r->finish.seams},
                              {"seam_edges", r->finish.seam_edges},
                              {"tabs_full", r->finish.tabs_full},
                              {"tabs_reduced", r->finish.tabs_reduced},
                              {"tabs_none", r->finish.tabs_none},
                              {"mate_distance_mm", r->finish.mate_distance_mm},
                              {"sheets", r->layout.sheets},
                              {"sheet_width_mm", r->sheet_mm.x},
                              {"sheet_height_mm", r->sheet_mm.y},
                              {"mm_per_unit", r->mm_per_unit},
                              {"width_mm", r->size_mm.x},
                              {"height_mm", r->size_mm.y},
                              {"length_mm", r->size_mm.z},
                              {"fill", r->layout.fill},
                              {"last_sheet_mm", r->layout.last_mm},
                              {"seconds", r->seconds},
                              {"seconds_unfold", r->seconds_unfold}};
    bool paper = options->mode == KTG_PAPER;
    KTG_TRY(ktg_output_print(context, output, "{\n  \"mode\": \"%s\"", paper ? "paper" : "cloth"));
    KTG_TRY(put_seed(context, output));
    KTG_TRY(put_figures(context, output, figures, sizeof figures / sizeof *figures));
    if (options->edit)
        KTG_TRY(ktg_pipeline_put_deform(context, output, &r->deform, "deform_"));
    KTG_TRY(paper ? put_paper(context, output, r) : put_cloth(context, output, r));
    ktg_stopped_by stopped = r->flatten.interrupted ? KTG_STOPPED_INTERRUPT : r->unfold.stopped_by;
    KTG_TRY(put_text(context, output, "stopped_by", ktg_stopped_by_name(stopped)));
    return ktg_output_print(context, output, "\n}\n");
}
