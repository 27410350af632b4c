/* pipeline/fill.c - as large as so many sheets allow.
 *
 * At which scale a model takes how many sheets is only known once it has been divided, finished and
 * laid out at that scale, so that is done, quickly, for a bracket of scales that is halved; then
 * once more, with all the effort that was asked for. */
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "pipeline/stages.h"

/* How often the bracket is halved. */
#define HALVINGS 7

/* The largest pattern so far. */
typedef struct filling {
    const ktg_stage *stage;
    ktg_pipeline_options options; /* of a trial */
    ktg_pipeline_report report;   /* of the trial, filled anew each time */
    ktg_pattern *best;
    ktg_pipeline_report best_report;
    double start; /* by the clock */
} filling;

/* The seconds that are left of what the search may take; infinite where nothing limits it. */
static double seconds_left(const filling *f) {
    double seconds = f->stage->options->unfold.seconds;
    return seconds > 0 ? seconds - (ktg_clock_seconds() - f->start) : INFINITY;
}

static ktg_status make(ktg_context *context, filling *f, ktg_pattern **pattern) {
    ktg_stage trial = *f->stage;
    trial.options = &f->options;
    trial.report = &f->report;
    f->report = *f->stage->report;
    double left = seconds_left(f);
    if (isfinite(left))
        f->options.unfold.seconds = fmax(left, 0.05);
    KTG_TRY(ktg_stage_pieces(context, &trial, pattern));
    return ktg_stage_sheets(context, &trial, pattern);
}

/* Makes the pattern and keeps it where it takes no more sheets than it may. What is too large for
 * the sheet at that scale in any way does not fit. */
static ktg_status try_scale(ktg_context *context, filling *f, double mm_per_unit, bool *fits) {
    ktg_pattern *pattern = NULL;
    f->options.size_rule = mm_per_unit > 0 ? KTG_SIZE_FACTOR : KTG_SIZE_FIT;
    f->options.size_mm = mm_per_unit;
    ktg_status status = make(context, f, &pattern);
    bool too_large = mm_per_unit > 0 && (status == KTG_GEOMETRY || status == KTG_LIMIT);
    *fits = status == KTG_OK && pattern->sheet_count <= f->stage->options->sheets;
    if (*fits) {
        ktg_pattern *old = f->best;
        f->best = pattern;
        f->best_report = f->report;
        pattern = old;
    }
    ktg_pattern_free(&pattern);
    return too_large ? KTG_OK : status;
}

static double area_of(const ktg_mesh *mesh) {
    double twice = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = &mesh->faces[3 * (size_t)f];
        ktg_vec3 a = mesh->positions[c[0]];
        twice += ktg_length3(
            ktg_cross3(ktg_sub3(mesh->positions[c[1]], a), ktg_sub3(mesh->positions[c[2]], a)));
    }
    return twice / 2;
}

/* Between what one sheet allows and what the sheets' area allows. */
static ktg_status search(ktg_context *context, filling *f) {
    const ktg_pipeline_options *options = f->stage->options;
    const ktg_sheet_format *sheet = &options->layout.sheet;
    double room =
        (sheet->width_mm - 2 * sheet->margin_mm) * (sheet->height_mm - 2 * sheet->margin_mm);
    double most = sqrt(options->sheets * room / area_of(f->stage->mesh)), scale;
    bool fits;
    f->options.unfold.effort = f->options.layout.effort = KTG_EFFORT_QUICK;
    KTG_TRY(try_scale(context, f, 0, &fits));
    if (!f->best)
        return ktg_fail(context, KTG_INTERNAL, "what fits one sheet takes more than one");
    scale = f->best->mm_per_unit;
    for (int k = 0; k < HALVINGS && !ktg_wants_finish(context) && seconds_left(f) > 0; k++) {
        double middle = sqrt(scale * most);
        ktg_progress(context, "size", (double)k / HALVINGS, NULL);
        KTG_TRY(try_scale(context, f, middle, &fits));
        *(fits ? &scale : &most) = middle;
    }
    f->options.unfold.effort = options->unfold.effort;
    f->options.layout.effort = options->layout.effort;
    if (options->unfold.effort == KTG_EFFORT_QUICK || ktg_wants_finish(context) ||
        seconds_left(f) <= 0)
        return KTG_OK;
    return try_scale(context, f, scale, &fits);
}

ktg_status ktg_stage_fill(ktg_context *context, const ktg_stage *stage, ktg_pattern **pattern) {
    filling f = {.stage = stage, .options = *stage->options, .start = ktg_clock_seconds()};
    ktg_status status = search(context, &f);
    if (status == KTG_OK) {
        *stage->report = f.best_report;
        stage->report->seconds_unfold = ktg_clock_seconds() - f.start;
        if (seconds_left(&f) <= 0)
            stage->report->unfold.stopped_by = KTG_STOPPED_TIME;
        *pattern = f.best;
        f.best = NULL;
    }
    ktg_pattern_free(&f.best);
    return status;
}
