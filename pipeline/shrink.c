/* pipeline/shrink.c - a size that is too large for the sheet, reduced to the largest that is not.
 */
#include "pipeline/size.h"

/* How often the scale is halved in search of one that fits, and how narrow the bracket becomes. */
#define HALVINGS 60
#define NARROW   1e-3

/* Does every piece, finished at this scale, fit a sheet? */
static ktg_status all_fit(ktg_context *context, const ktg_pipeline_options *options,
                          const ktg_pattern *pattern, double mm_per_unit, bool *fits) {
    ktg_pattern *copy = NULL;
    ktg_status status = ktg_check_cancel(context);
    if (status == KTG_OK)
        status = ktg_pattern_copy(context, pattern, &copy);
    if (status == KTG_OK)
        status = ktg_pattern_scale(context, copy, mm_per_unit);
    if (status == KTG_OK)
        status = ktg_pattern_finish(context, copy, &options->finish, NULL);
    *fits = true;
    for (size_t p = 0; status == KTG_OK && *fits && p < copy->piece_count; p++)
        status = ktg_layout_fits(context, copy, &options->layout, p, fits);
    ktg_pattern_free(&copy);
    return status;
}

ktg_status ktg_size_shrink(ktg_context *context, const ktg_pipeline_options *options,
                           const ktg_pattern *pattern, double *mm_per_unit) {
    double asked = *mm_per_unit, most = asked, scale = asked;
    bool fits;
    ktg_status status = all_fit(context, options, pattern, scale, &fits);
    for (int k = 0; status == KTG_OK && !fits && k < HALVINGS; k++) {
        most = scale;
        scale /= 2;
        status = all_fit(context, options, pattern, scale, &fits);
    }
    if (status == KTG_OK && !fits)
        return ktg_fail(context, KTG_GEOMETRY,
                        "no size of this pattern fits a sheet of %g x %g mm: choose a larger sheet "
                        "or smaller margins",
                        options->layout.sheet.width_mm, options->layout.sheet.height_mm);
    while (status == KTG_OK && most > scale * (1 + NARROW)) {
        double middle = (scale + most) / 2;
        status = all_fit(context, options, pattern, middle, &fits);
        *(fits ? &scale : &most) = middle;
    }
    if (status == KTG_OK && scale < asked)
        ktg_log(context, KTG_LOG_WARNING,
                "larger than a sheet at that size: reduced to %.3g %% of it, %.4g mm per unit",
                100 * scale / asked, scale);
    *mm_per_unit = scale;
    return status;
}
