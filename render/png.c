/* render/png.c - one sheet as PNG on white, at any resolution. */
#include "core/memory.h"
#include "render/draw.h"

/* Cairo's coordinates end here. */
#define MOST_PIXELS 32767

static ktg_status check_pixels(const ktg_drawing *drawing, size_t number, int *width, int *height) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[number];
    double dots = drawing->options.dots_per_inch;
    if (!(dots > 0) || !isfinite(dots))
        return ktg_fail(drawing->context, KTG_ARGUMENT, "%g dots per inch: it must be more than 0",
                        dots);
    double wide = fmax(1, round(sheet->width_mm / 25.4 * dots)),
           high = fmax(1, round(sheet->height_mm / 25.4 * dots));
    if (wide > MOST_PIXELS || high > MOST_PIXELS)
        return ktg_fail(drawing->context, KTG_LIMIT,
                        "a PNG of %.0f x %.0f pixels is too large (at most %d a side): choose at "
                        "most %.0f dots per inch, or PDF or SVG",
                        wide, high, MOST_PIXELS,
                        floor(MOST_PIXELS * 25.4 / fmax(sheet->width_mm, sheet->height_mm)));
    *width = (int)wide;
    *height = (int)high;
    return KTG_OK;
}

ktg_status ktg_png_make(const ktg_drawing *drawing, int width, int height, ktg_png_draw *draw,
                        const void *what, ktg_output *output) {
    ktg_sink sink = {drawing->context, output, KTG_OK};
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cairo = cairo_create(surface);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    ktg_status status = draw(drawing, cairo, what);
    cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    if (status == KTG_OK && drawn == CAIRO_STATUS_SUCCESS)
        drawn = cairo_surface_write_to_png_stream(surface, ktg_sink_write, &sink);
    cairo_surface_destroy(surface);
    return status != KTG_OK ? status : ktg_cairo_status(drawing->context, &sink, drawn, "the PNG");
}

static ktg_status draw_sheet(const ktg_drawing *drawing, cairo_t *cairo, const void *what) {
    const size_t *number = what;
    double scale = drawing->options.dots_per_inch / 25.4;
    bool furnished;
    cairo_scale(cairo, scale, scale);
    return ktg_page_draw(drawing, *number, cairo, &furnished);
}

ktg_status ktg_render_png(ktg_context *context, const ktg_pattern *pattern, size_t sheet,
                          const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    int width = 0, height = 0;
    KTG_TRY(ktg_drawing_of_sheet(context, pattern, options, sheet, &drawing));
    ktg_status status = check_pixels(drawing, sheet, &width, &height);
    if (status == KTG_OK)
        status = ktg_png_make(drawing, width, height, draw_sheet, &sheet, output);
    ktg_drawing_free(&drawing);
    return status;
}
