/* render/svg.c - one sheet as SVG, a user unit being a millimetre. */
#include "render/draw.h"

#include <cairo-svg.h>

static ktg_status draw_svg(const ktg_drawing *drawing, size_t number, ktg_output *output) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[number];
    ktg_sink sink = {drawing->context, output, KTG_OK};
    cairo_surface_t *surface = cairo_svg_surface_create_for_stream(
        ktg_sink_write, &sink, sheet->width_mm, sheet->height_mm);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_MM);
    cairo_t *cairo = cairo_create(surface);
    bool furnished;
    ktg_status status = ktg_page_draw(drawing, number, cairo, &furnished);
    cairo_show_page(cairo);
    cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        drawn = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return status != KTG_OK ? status : ktg_cairo_status(drawing->context, &sink, drawn, "the SVG");
}

ktg_status ktg_render_svg(ktg_context *context, const ktg_pattern *pattern, size_t sheet,
                          const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    ktg_status status = ktg_drawing_new(context, pattern, options, &drawing);
    if (status != KTG_OK)
        return status;
    status = ktg_drawing_check_sheet(drawing, sheet);
    if (status == KTG_OK)
        status = draw_svg(drawing, sheet, output);
    ktg_drawing_free(&drawing);
    return status;
}
