/* pipeline/sheets.c - scale, finish, lay out; several pieces grow until they fill one sheet. */
#include "pipeline/sheets.h"
#include "pipeline/size.h"

#include "core/memory.h"
#include "core/vec.h"

#define GROWTH     1.08 /* from one size that fits to the next that is tried */
#define PRECISION  1.02 /* between a size that fits and one that does not */
#define MOST_TRIES 10

/* In what the search's time limit left, or a little. */
static ktg_status lay_out(ktg_context *context, const ktg_pipeline_options *options,
                          const ktg_layout_options *wish, ktg_pattern *pattern,
                          ktg_pipeline_report *report) {
    ktg_layout_options layout = *wish;
    if (options->unfold.seconds > 0)
        layout.seconds = fmax(0.1, options->unfold.seconds - report->seconds_unfold);
    return ktg_layout_place(context, pattern, &layout, &report->layout);
}

static ktg_status put(ktg_context *context, const ktg_pipeline_options *options,
                      const ktg_layout_options *layout, double mm_per_unit, ktg_pattern *pattern,
                      ktg_pipeline_report *report) {
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_pattern_scale(context, pattern, mm_per_unit));
    KTG_TRY(ktg_pattern_finish(context, pattern, &options->finish, &report->finish));
    return lay_out(context, options, layout, pattern, report);
}

/* A copy of the pattern at that size; *fits tells whether it lies on one sheet, and takes the place
 * of *largest then. */
static ktg_status try_size(ktg_context *context, const ktg_pipeline_options *options,
                           const ktg_pattern *pattern, double mm_per_unit, ktg_pattern **largest,
                           ktg_pipeline_report *report, bool *fits) {
    ktg_layout_options layout = options->layout;
    ktg_pipeline_report tried = *report;
    ktg_pattern *copy;
    layout.enough_sheets = 1;
    if (layout.effort > KTG_EFFORT_QUICK)
        layout.effort--; /* several sizes are tried */
    KTG_TRY(ktg_pattern_copy(context, pattern, &copy));
    ktg_status status = put(context, options, &layout, mm_per_unit, copy, &tried);
    *fits = status == KTG_OK && copy->sheet_count == 1;
    if (*fits) {
        ktg_pattern_free(largest);
        *largest = copy;
        *report = tried;
        return KTG_OK;
    }
    ktg_pattern_free(&copy);
    return status == KTG_GEOMETRY ? KTG_OK
                                  : status; /* a piece larger than the sheet does not fit */
}

/* *largest: the pattern at the largest size found to fit one sheet, above `fitting`; NULL when
 * there is none. */
static ktg_status grow(ktg_context *context, const ktg_pipeline_options *options,
                       const ktg_pattern *pattern, double fitting, ktg_pattern **largest,
                       ktg_pipeline_report *report) {
    double too_large = INFINITY;
    for (int k = 0; k < MOST_TRIES && !ktg_wants_finish(context); k++) {
        double size = isinf(too_large) ? fitting * GROWTH : sqrt(fitting * too_large);
        if (too_large < fitting * PRECISION)
            return KTG_OK;
        bool fits;
        KTG_TRY(try_size(context, options, pattern, size, largest, report, &fits));
        if (fits)
            fitting = size;
        else
            too_large = size;
    }
    return KTG_OK;
}

ktg_status ktg_sheets_put(ktg_context *context, const ktg_pipeline_options *options,
                          ktg_pattern **pattern, ktg_pipeline_report *report) {
    double mm_per_unit = 0;
    ktg_pattern *largest = NULL;
    KTG_TRY(ktg_size_scale(context, options, *pattern, &mm_per_unit));
    if (options->size_rule == KTG_SIZE_FIT && (*pattern)->piece_count > 1) {
        ktg_status status = grow(context, options, *pattern, mm_per_unit, &largest, report);
        if (status != KTG_OK) {
            ktg_pattern_free(&largest);
            return status;
        }
    }
    if (!largest)
        return put(context, options, &options->layout, mm_per_unit, *pattern, report);
    ktg_pattern_free(pattern);
    *pattern = largest;
    return KTG_OK;
}
