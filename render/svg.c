/* render/svg.c - one sheet as SVG, a user unit being a millimetre. */
#include "render/draw.h"

#include "core/memory.h"

#include <cairo-svg.h>
#include <string.h>

/* What cairo wrote, kept until it is whole. */
typedef struct svg_text {
    ktg_context *context;
    ktg_status status;
    char *bytes;
    size_t size, capacity;
} svg_text;

static cairo_status_t keep(void *closure, const unsigned char *bytes, unsigned int size) {
    svg_text *text = closure;
    if (text->status == KTG_OK)
        text->status = ktg_reserve(text->context, &text->bytes, &text->capacity, text->size + size);
    if (text->status != KTG_OK)
        return CAIRO_STATUS_NO_MEMORY;
    memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
    return CAIRO_STATUS_SUCCESS;
}

/* Cairo counts the surfaces of the whole process and names the page by that number, which nothing
 * refers to: left out, the same sheet gives the same bytes every time. */
static ktg_status write_without_id(const svg_text *text, ktg_output *output) {
    static const char mark[] = "<g id=\"surface";
    const char *end = text->bytes + text->size;
    const char *id = memmem(text->bytes, text->size, mark, sizeof mark - 1);
    const char *close = id ? memchr(id, '>', (size_t)(end - id)) : NULL;
    if (!close)
        return ktg_output_write(text->context, output, text->bytes, text->size);
    KTG_TRY(ktg_output_write(text->context, output, text->bytes, (size_t)(id - text->bytes) + 2));
    return ktg_output_write(text->context, output, close, (size_t)(end - close));
}

static ktg_status draw_svg(const ktg_drawing *drawing, size_t number, ktg_output *output) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[number];
    svg_text text = {drawing->context, KTG_OK, NULL, 0, 0};
    cairo_surface_t *surface =
        cairo_svg_surface_create_for_stream(keep, &text, sheet->width_mm, sheet->height_mm);
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
    if (status == KTG_OK)
        status = text.status;
    if (status == KTG_OK)
        status = ktg_cairo_status(drawing->context, NULL, drawn, "the SVG");
    if (status == KTG_OK)
        status = write_without_id(&text, output);
    ktg_free(text.bytes);
    return status;
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
