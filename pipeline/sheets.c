/* pipeline/sheets.c - scale, finish, lay out; several pieces grow until they fill one sheet. */
#include "pipeline/sheets.h"
#include "pipeline/printed.h"
#include "pipeline/size.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"

#define GROWTH        1.08 /* from one size that fits to the next that is tried */
#define PRECISION     1.02 /* between a size that fits and one that does not */
#define MOST_TRIES    10
#define LEAST_SECONDS 0.1 /* for laying out, whatever the time limit has left */

typedef struct task {
    ktg_context *context;
    const ktg_pipeline_options *options;
    double began; /* clock */
    ktg_pipeline_report *report;
} task;

/* What the search's time limit has left; infinite where there is none. */
static double seconds_left(const task *t) {
    double limit = t->options->unfold.seconds;
    if (!(limit > 0))
        return INFINITY;
    return limit - t->report->seconds_unfold - (ktg_clock_seconds() - t->began);
}

/* On sheets, on posters too, or on one page. */
static ktg_status lay_out_all(const task *t, const ktg_layout_options *layout, ktg_pattern *pattern,
                              ktg_layout_report *report) {
    if (ktg_layout_is_page(&layout->sheet))
        return ktg_layout_page(t->context, pattern, layout, report);
    if (t->options->large == KTG_LARGE_TILE && !layout->roll)
        return ktg_layout_tile(t->context, pattern, layout, t->options->overlap_mm, report);
    return ktg_layout_place(t->context, pattern, layout, report);
}

static ktg_status lay_out(const task *t, const ktg_layout_options *layout, ktg_pattern *pattern,
                          ktg_layout_report *report) {
    ktg_printed printed;
    if (pattern->mode == KTG_PAPER)
        return lay_out_all(t, layout, pattern, report);
    ktg_status status = ktg_printed_view(t->context, pattern, &printed);
    if (status == KTG_OK)
        status = lay_out_all(t, layout, &printed.view, report);
    if (status == KTG_OK)
        ktg_printed_take_sheets(&printed, pattern);
    ktg_printed_drop(&printed);
    return status;
}

static ktg_status put(const task *t, const ktg_layout_options *wish, double mm_per_unit,
                      ktg_pattern *pattern, ktg_pipeline_report *report) {
    ktg_layout_options layout = *wish;
    ktg_finish_options finish = t->options->finish;
    finish.up = (unsigned)(ktg_size_up(t->options) - KTG_AXIS_X);
    if (t->options->marker) { /* every piece, and the whole of it */
        finish.twins = false;
        finish.on_fold_count = 0;
    }
    KTG_TRY(ktg_check_cancel(t->context));
    KTG_TRY(ktg_pattern_scale(t->context, pattern, mm_per_unit));
    KTG_TRY(ktg_pattern_finish(t->context, pattern, &finish, &report->finish));
    double left = seconds_left(t);
    if (!isinf(left))
        layout.seconds = fmax(LEAST_SECONDS, left);
    return lay_out(t, &layout, pattern, &report->layout);
}

/* A copy of the pattern at that size; *fits tells whether it lies on one sheet, and takes the place
 * of *largest then. */
static ktg_status try_size(const task *t, const ktg_pattern *pattern, double mm_per_unit,
                           ktg_pattern **largest, bool *fits) {
    ktg_layout_options layout = t->options->layout;
    ktg_pipeline_report tried = *t->report;
    ktg_pattern *copy;
    layout.enough_sheets = 1;
    if (layout.effort > KTG_EFFORT_QUICK)
        layout.effort--; /* several sizes are tried */
    KTG_TRY(ktg_pattern_copy(t->context, pattern, &copy));
    ktg_status status = put(t, &layout, mm_per_unit, copy, &tried);
    *fits = status == KTG_OK && copy->sheet_count == 1;
    if (*fits) {
        ktg_pattern_free(largest);
        *largest = copy;
        *t->report = tried;
        return KTG_OK;
    }
    ktg_pattern_free(&copy);
    return status == KTG_GEOMETRY ? KTG_OK
                                  : status; /* a piece larger than the sheet does not fit */
}

/* *largest: the pattern at the largest size found to fit one sheet, above `fitting`; NULL when
 * there is none. */
static ktg_status grow(const task *t, const ktg_pattern *pattern, double fitting,
                       ktg_pattern **largest) {
    double too_large = INFINITY;
    for (int k = 0; k < MOST_TRIES && too_large > fitting * PRECISION; k++) {
        if (ktg_wants_finish(t->context) || seconds_left(t) <= 0)
            break;
        double size = isinf(too_large) ? fitting * GROWTH : sqrt(fitting * too_large);
        bool fits;
        KTG_TRY(try_size(t, pattern, size, largest, &fits));
        *(fits ? &fitting : &too_large) = size;
    }
    return KTG_OK;
}

ktg_status ktg_sheets_put(ktg_context *context, const ktg_pipeline_options *options,
                          ktg_pattern **pattern, ktg_pipeline_report *report) {
    task t = {context, options, ktg_clock_seconds(), report};
    double mm_per_unit = 0;
    ktg_pattern *largest = NULL;
    ktg_status status = ktg_size_scale(context, options, *pattern, &mm_per_unit);
    if (status == KTG_OK && options->size_rule == KTG_SIZE_FIT && (*pattern)->piece_count > 1)
        status = grow(&t, *pattern, mm_per_unit, &largest);
    if (status == KTG_OK && !largest)
        return put(&t, &options->layout, mm_per_unit, *pattern, report);
    if (status == KTG_OK) {
        ktg_pattern_free(pattern);
        *pattern = largest;
        return KTG_OK;
    }
    ktg_pattern_free(&largest);
    return status;
}
