/* pipeline/stages.c - from a repaired surface to a pattern on sheets. */
#include "pipeline/stages.h"
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "pipeline/sheets.h"
#include "pipeline/size.h"

#include <string.h>

const char *ktg_base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
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

static ktg_status unfold(ktg_context *context, const ktg_stage *stage, ktg_pattern **pattern) {
    const ktg_pipeline_options *options = stage->options;
    ktg_unfold_options unfold = options->unfold;
    ktg_progress(context, "unfold", 0, NULL);
    bool page = ktg_layout_is_page(&options->layout.sheet);
    bool split = options->large == KTG_LARGE_SPLIT && !page;
    if (!page) /* else it has no shape that a net should fill: A4's will do */
        unfold.sheet = options->layout.sheet;
    unfold.finish = options->finish;
    unfold.rules = stage->hand->rules;
    unfold.rule_count = stage->hand->rule_count;
    unfold.oversize = options->large == KTG_LARGE_SPLIT ? KTG_OVERSIZE_SPLIT : KTG_OVERSIZE_ERROR;
    KTG_TRY(ktg_size_known(context, options, stage->mesh, &unfold.mm_per_unit));
    if (!split)
        unfold.mm_per_unit = 0; /* one piece, as compact as can be */
    KTG_TRY(
        ktg_unfold(context, stage->mesh, stage->title, &unfold, pattern, &stage->report->unfold));
    tell_pieces(context, &unfold, &stage->report->unfold);
    return KTG_OK;
}

static ktg_status flatten(ktg_context *context, const ktg_stage *stage, ktg_pattern **pattern) {
    ktg_progress(context, "flatten", 0, NULL);
    ktg_flatten_options flatten = stage->options->flatten;
    flatten.up = (unsigned)(ktg_size_up(stage->options) - KTG_AXIS_X);
    return ktg_flatten(context, stage->mesh, stage->title, &flatten, pattern,
                       &stage->report->flatten);
}

ktg_status ktg_stage_pieces(ktg_context *context, const ktg_stage *stage, ktg_pattern **pattern) {
    const ktg_pipeline_options *options = stage->options;
    ktg_pipeline_report *report = stage->report;
    double start = ktg_clock_seconds();
    KTG_TRY(options->mode == KTG_PAPER ? unfold(context, stage, pattern)
                                       : flatten(context, stage, pattern));
    report->seconds_unfold = ktg_clock_seconds() - start;
    ktg_pattern *p = *pattern;
    ktg_free(p->model_file);
    p->model_file = ktg_copy_text(context, ktg_base_name(options->model), SIZE_MAX);
    p->model_faces = report->model.faces;
    p->simplified = p->simplified || report->simplify.faces_after != report->simplify.faces_before;
    if (!p->model_file)
        return KTG_MEMORY;
    return ktg_pattern_set_omitted(context, p, options->omit, options->omit_count);
}

/* A marker that is longer than a page can be is cut from several lengths. */
static void tell_fabric(ktg_context *context, const ktg_pipeline_options *options,
                        const ktg_pattern *pattern, ktg_pipeline_report *report) {
    report->fabric_length_mm = 0;
    if (!options->marker)
        return;
    for (size_t s = 0; s < pattern->sheet_count; s++)
        report->fabric_length_mm += pattern->sheets[s].height_mm;
    ktg_log(context, KTG_LOG_NOTE, "the marker takes %.0f mm of fabric %.0f mm wide",
            ceil(report->fabric_length_mm), pattern->sheets[0].width_mm);
}

ktg_status ktg_stage_sheets(ktg_context *context, const ktg_stage *stage, ktg_pattern **pattern) {
    const ktg_pipeline_options *options = stage->options;
    ktg_pipeline_report *report = stage->report;
    ktg_progress(context, "sheets", 0, NULL);
    KTG_TRY(ktg_sheets_put(context, options, pattern, report));
    const ktg_pattern *p = *pattern;
    report->faces = p->face_count;
    report->pieces = (uint32_t)p->piece_count;
    report->components = (uint32_t)p->component_count;
    report->mm_per_unit = p->mm_per_unit;
    report->sheet_mm = (ktg_vec2){p->sheets[0].width_mm, p->sheets[0].height_mm};
    report->up = ktg_size_up(options);
    tell_fabric(context, options, p, report);
    report->size_mm = ktg_size_of(p->vertices, p->vertex_count, report->up);
    return KTG_OK;
}

ktg_status ktg_stage_pattern(ktg_context *context, const ktg_stage *stage, ktg_pattern **pattern) {
    if (stage->options->size_rule == KTG_SIZE_FIT && stage->options->sheets > 1)
        return ktg_stage_fill(context, stage, pattern);
    KTG_TRY(ktg_stage_pieces(context, stage, pattern));
    return ktg_stage_sheets(context, stage, pattern);
}
