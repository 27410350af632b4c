/* render/svg_colours.c - the colours of a sheet as a picture within an SVG. */
#include "render/svg_colours.h"
#include "render/colours.h"

#include "core/memory.h"

#include <string.h>

/* Bytes on their way into the file, three at a time (RFC 4648, section 4). */
typedef struct base64 {
    ktg_context *context;
    ktg_output *output;
    unsigned char kept[3];
    size_t kept_count, written;
    ktg_status status;
} base64;

static void put_group(base64 *b) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t bits = (uint32_t)b->kept[0] << 16 | (uint32_t)b->kept[1] << 8 | b->kept[2];
    char text[5];
    for (size_t k = 0; k < 4; k++)
        text[k] = k <= b->kept_count ? digits[bits >> (18 - 6 * k) & 63] : '=';
    text[4] = '\n';
    b->written += 4;
    b->status = ktg_output_write(b->context, b->output, text, b->written % 76 == 0 ? 5 : 4);
    memset(b->kept, 0, sizeof b->kept);
    b->kept_count = 0;
}

static void put_byte(base64 *b, unsigned char byte) {
    b->kept[b->kept_count++] = byte;
    if (b->kept_count == 3 && b->status == KTG_OK)
        put_group(b);
}

static cairo_status_t put_bytes(void *closure, const unsigned char *bytes, unsigned int size) {
    base64 *b = closure;
    for (unsigned int i = 0; i < size && b->status == KTG_OK; i++)
        put_byte(b, bytes[i]);
    return b->status == KTG_OK ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

/* As JPEG where the picture has one, else as PNG. */
static ktg_status put_picture(base64 *b, cairo_surface_t *surface) {
    const unsigned char *jpeg;
    unsigned long size;
    cairo_surface_get_mime_data(surface, CAIRO_MIME_TYPE_JPEG, &jpeg, &size);
    KTG_TRY(
        ktg_output_print(b->context, b->output, "data:image/%s;base64,", jpeg ? "jpeg" : "png"));
    cairo_status_t drawn = CAIRO_STATUS_SUCCESS;
    if (jpeg)
        drawn = put_bytes(b, jpeg, (unsigned int)size);
    else
        drawn = cairo_surface_write_to_png_stream(surface, put_bytes, b);
    if (b->status == KTG_OK && b->kept_count > 0)
        put_group(b);
    KTG_TRY(b->status);
    return ktg_cairo_status(b->context, NULL, drawn, "the colours of the SVG");
}

static ktg_status put_image(ktg_context *context, const ktg_colours *colours, double units,
                            cairo_surface_t *surface, ktg_output *output) {
    double unit = units / colours->dots_per_mm;
    const struct {
        const char *before;
        double value;
    } attributes[] = {{"<image x=\"", colours->corner.x * units},
                      {"\" y=\"", colours->corner.y * units},
                      {"\" width=\"", colours->width * unit},
                      {"\" height=\"", colours->height * unit}};
    base64 b = {.context = context, .output = output};
    for (size_t i = 0; i < sizeof attributes / sizeof *attributes; i++) {
        char number[KTG_NUMBER_SIZE];
        ktg_plot_number(attributes[i].value, number);
        KTG_TRY(ktg_output_print(context, output, "%s%s", attributes[i].before, number));
    }
    KTG_TRY(ktg_output_print(context, output, "\" preserveAspectRatio=\"none\" xlink:href=\""));
    KTG_TRY(put_picture(&b, surface));
    return ktg_output_print(context, output, "\"/>\n");
}

ktg_status ktg_svg_put_colours(const ktg_plot *plot, double units, ktg_output *output) {
    const ktg_drawing *drawing = plot->page.drawing;
    ktg_context *context = drawing->context;
    ktg_colours *colours;
    cairo_surface_t *surface = NULL;
    KTG_TRY(ktg_colours_make(drawing, plot->page.number, KTG_COLOUR_DOTS_PER_MM, &colours));
    if (!colours)
        return KTG_OK;
    ktg_status status = ktg_output_print(context, output,
                                         "  <g inkscape:groupmode=\"layer\" id=\"colours\" "
                                         "inkscape:label=\"Colours\">\n    ");
    if (status == KTG_OK)
        status = ktg_colours_surface(drawing, colours, true, &surface);
    if (status == KTG_OK)
        status = put_image(context, colours, units, surface, output);
    if (surface)
        cairo_surface_destroy(surface);
    ktg_colours_free(&colours);
    return status == KTG_OK ? ktg_output_print(context, output, "  </g>\n") : status;
}
