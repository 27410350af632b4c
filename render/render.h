/* render/render.h - drawing sheets with Cairo: PDF, SVG, PNG. */
#ifndef KTG_RENDER_RENDER_H
#define KTG_RENDER_RENDER_H

#include "core/core.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ktg_fold_style {
    KTG_FOLDS_DASHED, /* mountain dashed, valley dash-dot (Blender, origami) */
    KTG_FOLDS_SOLID   /* mountain solid, valley dashed (Pepakura) */
} ktg_fold_style;

typedef struct ktg_render_options {
    const char *title; /* on every sheet and in the metadata; NULL: the model's file name */
    ktg_fold_style folds;
    double flat_below;    /* radians: folds flatter than this are not drawn; default 1 degree */
    double dots_per_inch; /* PNG; 150 */
    bool
        colour; /* mountain red, valley blue; the dashes tell them apart without it; default true */
} ktg_render_options;

KTG_API void ktg_render_defaults(ktg_render_options *options);

/* All sheets, one page each, as vector PDF with embedded fonts; the same pattern gives the same
 * bytes. KTG_ARGUMENT when the pattern has no sheets, KTG_FILE when the output cannot take it. */
KTG_API KTG_NODISCARD ktg_status ktg_render_pdf(ktg_context *context, const ktg_pattern *pattern,
                                                const ktg_render_options *options,
                                                ktg_output *output);

/* One sheet (0 .. sheet_count - 1) as SVG in millimetres, or as PNG. */
KTG_API KTG_NODISCARD ktg_status ktg_render_svg(ktg_context *context, const ktg_pattern *pattern,
                                                size_t sheet, const ktg_render_options *options,
                                                ktg_output *output);
KTG_API KTG_NODISCARD ktg_status ktg_render_png(ktg_context *context, const ktg_pattern *pattern,
                                                size_t sheet, const ktg_render_options *options,
                                                ktg_output *output);

#ifdef __cplusplus
}
#endif
#endif
