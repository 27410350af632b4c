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

static ktg_status put_panel(ktg_context *context, ktg_output *output, uint32_t piece,
                            const ktg_panel_report *panel) {
    const figure figures[] = {{"faces", panel->faces},
                              {"iterations", panel->iterations},
                              {"flipped_faces", panel->flipped_faces},
                              {"arap_energy", panel->arap_energy},
                              {"symmetric_dirichlet", panel->symmetric_dirichlet},
                              {"strain_mean", panel->strain_mean},
                              {"strain_p95", panel->strain_p95},
                              {"strain_max", panel->strain_max},
                              {"area_beyond_limit", panel->area_beyond_limit},
                              {"border_error", panel->border_error},
                              {"seconds", panel->seconds}};
    KTG_TRY(ktg_output_print(context, output, "%s\n    {\"piece\": %u, \"method\": \"%s\"",
                             piece > 0 ? "," : "", piece + 1,
                             ktg_flatten_method_name(panel->method)));
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        KTG_TRY(
            ktg_output_print(context, output, ", \"%s\": %.17g", figures[i].key, figures[i].value));
    return ktg_output_print(context, output, "}");
}

static ktg_status put_panels(ktg_context *context, ktg_output *output,
                             const ktg_flatten_report *f) {
    KTG_TRY(ktg_output_print(context, output, ",\n  \"panels\": ["));
    for (uint32_t p = 0; p < f->panel_count; p++)
        KTG_TRY(put_panel(context, output, p, &f->panels[p]));
    return ktg_output_print(context, output, "]");
}

/* What is left of the difference between the two sides of each seam. */
static ktg_status put_seams(ktg_context *context, ktg_output *output, const ktg_pattern *pattern) {
    KTG_TRY(ktg_output_print(context, output, ",\n  \"seam_list\": ["));
    for (size_t s = 0; s < pattern->seam_count; s++) {
        const ktg_pattern_seam *seam = &pattern->seams[s];
        double a = seam->lengths_mm[0], b = seam->lengths_mm[1];
        KTG_TRY(ktg_output_print(context, output,
                                 "%s\n    {\"id\": %zu, \"number\": %u, \"pieces\": [%u, %u], "
                                 "\"length_mm\": [%.17g, %.17g], \"difference_mm\": %.17g, "
                                 "\"difference_percent\": %.17g, \"dart\": %s}",
                                 s > 0 ? "," : "", s + 1, seam->number, seam->pieces[0] + 1,
                                 seam->pieces[1] + 1, a, b, a - b, 200 * (a - b) / (a + b),
                                 seam->dart ? "true" : "false"));
    }
    return ktg_output_print(context, output, "]");
}

static ktg_status put_cloth(ktg_context *context, ktg_output *output,
                            const ktg_pipeline_report *r) {
    const ktg_flatten_report *f = &r->flatten;
    const ktg_panel_report *whole = &f->whole;
    const figure figures[] = {{"iterations", whole->iterations},
                              {"flipped_by_arap", whole->flipped_by_arap},
                              {"crossed_by_arap", whole->crossed_by_arap},
                              {"flipped_faces", whole->flipped_faces},
                              {"arap_energy", whole->arap_energy},
                              {"symmetric_dirichlet", whole->symmetric_dirichlet},
                              {"strain_mean", whole->strain_mean},
                              {"strain_p95", whole->strain_p95},
                              {"strain_max", whole->strain_max},
                              {"strain_limit", f->strain_limit},
                              {"area_beyond_limit", whole->area_beyond_limit},
                              {"border_error", whole->border_error},
                              {"panels_beyond_limit", f->panels_beyond},
                              {"cut_edges", f->seam_edges},
                              {"cut_edges_opened", f->opened_edges},
                              {"cut_edges_auto", f->auto_edges},
                              {"edge_error", f->seam_error},
                              {"seam_error", r->finish.seam_error},
                              {"seam_error_mm", r->finish.seam_error_mm},
                              {"darts", r->finish.darts},
                              {"notches", r->finish.notches},
                              {"twins", r->finish.twins},
                              {"on_fold", r->finish.on_fold}};
    KTG_TRY(put_text(context, output, "method", ktg_flatten_method_name(whole->method)));
    KTG_TRY(put_figures(context, output, figures, sizeof figures / sizeof *figures));
    return put_panels(context, output, f);
}

ktg_status ktg_pipeline_write_report(ktg_context *context, const ktg_pipeline_options *options,
                                     const ktg_pipeline_report *r, const ktg_pattern *pattern,
                                     ktg_output *output) {
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
                              {"fabric_length_mm", r->fabric_length_mm},
                              {"sheet_width_mm", r->sheet_mm.x},
                              {"sheet_height_mm", r->sheet_mm.y},
                              {"mm_per_unit", r->mm_per_unit},
                              {"width_mm", r->size_mm.x},
                              {"height_mm", r->size_mm.y},
                              {"length_mm", r->size_mm.z},
                              {"fill", r->layout.fill},
                              {"last_sheet_mm", r->layout.last_mm},
                              {"images", r->paint.images},
                              {"images_missing", r->paint.images_missing},
                              {"faces_coloured_by_closest_point", r->paint.faces_sampled},
                              {"seconds", r->seconds},
                              {"seconds_unfold", r->seconds_unfold}};
    bool paper = options->mode == KTG_PAPER;
    KTG_TRY(ktg_output_print(context, output, "{\n  \"mode\": \"%s\"", paper ? "paper" : "cloth"));
    KTG_TRY(put_seed(context, output));
    KTG_TRY(put_figures(context, output, figures, sizeof figures / sizeof *figures));
    if (options->edit)
        KTG_TRY(ktg_pipeline_put_deform(context, output, &r->deform, "deform_"));
    KTG_TRY(paper ? put_paper(context, output, r) : put_cloth(context, output, r));
    if (!paper && pattern)
        KTG_TRY(put_seams(context, output, pattern));
    ktg_stopped_by stopped = r->flatten.interrupted ? KTG_STOPPED_INTERRUPT : r->unfold.stopped_by;
    KTG_TRY(put_text(context, output, "stopped_by", ktg_stopped_by_name(stopped)));
    return ktg_output_print(context, output, "\n}\n");
}
