/* render/svg.c - one sheet as SVG for a cutting machine: plain XML, a layer for each operation,
 * presentation attributes only. */
#include "render/plot.h"
#include "render/svg_colours.h"

#include "core/memory.h"
#include "render/text.h"

#include <string.h>

/* An SVG while it is written. */
typedef struct svg {
    ktg_context *context;
    const ktg_plot *plot;
    ktg_output *output;
    double units; /* in a millimetre */
} svg;

static ktg_status put(const svg *s, const char *text) {
    return ktg_output_write(s->context, s->output, text, strlen(text));
}

/* Clean text, with what XML reserves written as it wants. */
static ktg_status put_escaped(const svg *s, const char *text) {
    for (; *text; text++) {
        const char *entity = *text == '&'    ? "&amp;"
                             : *text == '<'  ? "&lt;"
                             : *text == '>'  ? "&gt;"
                             : *text == '"'  ? "&quot;"
                             : *text == '\'' ? "&#39;"
                                             : NULL;
        KTG_TRY(entity ? put(s, entity) : ktg_output_write(s->context, s->output, text, 1));
    }
    return KTG_OK;
}

/* A length, in user units. */
static ktg_status put_length(const svg *s, const char *before, double mm) {
    char number[KTG_NUMBER_SIZE];
    ktg_plot_number(mm * s->units, number);
    KTG_TRY(put(s, before));
    return put(s, number);
}

/* Y is turned over here. */
static ktg_status put_point(const svg *s, const char *before, ktg_vec2 point) {
    KTG_TRY(put_length(s, before, point.x));
    return put_length(s, " ", s->plot->page.sheet->height_mm - point.y);
}

static ktg_status put_attribute(const svg *s, const char *name, double mm) {
    KTG_TRY(put(s, " "));
    KTG_TRY(put(s, name));
    KTG_TRY(put_length(s, "=\"", mm));
    return put(s, "\"");
}

static unsigned colour_of(const svg *s, ktg_layer layer) {
    return s->plot->page.drawing->options.colour ? ktg_layer_look_of(layer)->colour : 0;
}

/* ---- paths -------------------------------------------------------------------------------- */

static ktg_status put_way(void *user, const ktg_vec2 *points, size_t count) {
    const svg *s = user;
    for (size_t i = 0; i < count; i++)
        KTG_TRY(put_point(s, i == 0 ? "M" : " L", points[i]));
    return KTG_OK;
}

static ktg_status put_dashes(const svg *s, const ktg_plot_path *path) {
    const ktg_vec2 *points = s->plot->points + path->first;
    double length = 0;
    for (size_t i = 1; i < path->count + (path->closed ? 1 : 0); i++)
        length += ktg_length2(ktg_sub2(points[i % path->count], points[i - 1]));
    ktg_dashes fitted =
        ktg_dashes_fit(ktg_stroke_dashes(s->plot->page.drawing, path->stroke), length);
    if (!(fitted.dash > 0))
        return KTG_OK;
    KTG_TRY(put_length(s, " stroke-dasharray=\"", fitted.dash));
    KTG_TRY(put_length(s, " ", fitted.gap));
    if (fitted.dot > 0) {
        KTG_TRY(put_length(s, " ", fitted.dot));
        KTG_TRY(put_length(s, " ", fitted.gap));
    }
    return put(s, "\"");
}

static ktg_status put_path(svg *s, const ktg_plot_path *path) {
    const ktg_drawing *drawing = s->plot->page.drawing;
    bool dashed = ktg_stroke_dashes(drawing, path->stroke).dash > 0;
    bool real = dashed && drawing->options.real_dashes;
    KTG_TRY(ktg_output_print(s->context, s->output, "    <path fill=\"none\" stroke=\"#%06x\"",
                             colour_of(s, path->layer)));
    KTG_TRY(put_attribute(s, "stroke-width", ktg_stroke_width_mm(path->stroke)));
    KTG_TRY(put(s, " stroke-linejoin=\"round\""));
    if (dashed && !real)
        KTG_TRY(put_dashes(s, path));
    KTG_TRY(put(s, " d=\""));
    if (real)
        KTG_TRY(ktg_plot_dash(s->plot, path, put_way, s));
    else
        KTG_TRY(put_way(s, s->plot->points + path->first, path->count));
    return put(s, path->closed && !real ? " Z\"/>\n" : "\"/>\n");
}

/* ---- text --------------------------------------------------------------------------------- */

static ktg_status put_turn(const svg *s, const ktg_plot_text *text) {
    char degrees[KTG_NUMBER_SIZE];
    ktg_plot_number(-remainder(text->angle, 2 * KTG_PI) * 180 / KTG_PI, degrees);
    if (strcmp(degrees, "0") == 0)
        return KTG_OK;
    KTG_TRY(put(s, " transform=\"rotate("));
    KTG_TRY(put(s, degrees));
    KTG_TRY(put_point(s, " ", text->at));
    return put(s, ")\"");
}

static ktg_status put_text(const svg *s, const ktg_plot_text *text) {
    double y = s->plot->page.sheet->height_mm - text->at.y;
    KTG_TRY(put(s, "    <text"));
    KTG_TRY(put_attribute(s, "x", text->at.x));
    KTG_TRY(put_attribute(s, "y", text->begins ? y : y + text->height_mm / 2));
    KTG_TRY(put_turn(s, text));
    KTG_TRY(put(s, " font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\""));
    KTG_TRY(put_attribute(s, "font-size", text->height_mm / KTG_DIGIT_PER_SIZE));
    KTG_TRY(ktg_output_print(s->context, s->output, " text-anchor=\"%s\" fill=\"#%06x\">",
                             text->begins ? "start" : "middle", colour_of(s, text->layer)));
    KTG_TRY(put_escaped(s, text->text));
    return put(s, "</text>\n");
}

/* ---- the file ----------------------------------------------------------------------------- */

static ktg_status put_layer(svg *s, ktg_layer layer) {
    const ktg_layer_look *look = ktg_layer_look_of(layer);
    KTG_TRY(ktg_output_print(s->context, s->output,
                             "  <g inkscape:groupmode=\"layer\" id=\"%s\" inkscape:label=\"%s\">\n",
                             look->id, look->label));
    for (size_t i = 0; i < s->plot->path_count; i++)
        if (s->plot->paths[i].layer == layer)
            KTG_TRY(put_path(s, &s->plot->paths[i]));
    for (size_t i = 0; i < s->plot->text_count; i++)
        if (s->plot->texts[i].layer == layer)
            KTG_TRY(put_text(s, &s->plot->texts[i]));
    return put(s, "  </g>\n");
}

/* Width and height, with the unit where the file has one, and the same as user units. */
static ktg_status put_size(const svg *s) {
    const ktg_pattern_sheet *sheet = s->plot->page.sheet;
    const char *unit = s->units == 1 ? "mm\"" : "\"";
    KTG_TRY(put_length(s, " width=\"", sheet->width_mm));
    KTG_TRY(put(s, unit));
    KTG_TRY(put_length(s, " height=\"", sheet->height_mm));
    KTG_TRY(put(s, unit));
    KTG_TRY(put_length(s, " viewBox=\"0 0 ", sheet->width_mm));
    KTG_TRY(put_length(s, " ", sheet->height_mm));
    return put(s, "\"");
}

static ktg_status put_head(const svg *s) {
    KTG_TRY(put(s, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\""
                   " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\""
                   " xmlns:xlink=\"http://www.w3.org/1999/xlink\""
                   " xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\""
                   " version=\"1.1\""));
    KTG_TRY(put_size(s));
    KTG_TRY(put(s, ">\n  <title>"));
    KTG_TRY(put_escaped(s, s->plot->page.drawing->title));
    KTG_TRY(put(s, "</title>\n"));
    return ktg_output_print(s->context, s->output,
                            "  <desc>Katagami %s: sheet %zu of %zu</desc>\n"
                            "  <sodipodi:namedview inkscape:document-units=\"%s\"/>\n",
                            ktg_version(), s->plot->page.number + 1,
                            s->plot->page.drawing->pattern->sheet_count,
                            s->units == 1 ? "mm" : "px");
}

static ktg_status put_file(svg *s) {
    unsigned layers = ktg_plot_layers(s->plot);
    KTG_TRY(put_head(s));
    KTG_TRY(ktg_svg_put_colours(s->plot, s->units, s->output));
    for (int layer = 0; layer < KTG_LAYER_COUNT; layer++)
        if (layers & 1u << layer)
            KTG_TRY(put_layer(s, (ktg_layer)layer));
    return put(s, "</svg>\n");
}

static ktg_status write_svg(const ktg_drawing *drawing, size_t sheet, ktg_output *output) {
    static const double units[] = {
        [KTG_SVG_MM] = 1, [KTG_SVG_PX72] = 72 / 25.4, [KTG_SVG_PX96] = 96 / 25.4};
    ktg_plot plot;
    ktg_status status = ktg_plot_make(drawing, sheet, &plot);
    svg s = {drawing->context, &plot, output, units[drawing->options.svg_unit]};
    if (status == KTG_OK)
        status = put_file(&s);
    ktg_plot_drop(&plot);
    return status;
}

ktg_status ktg_render_svg(ktg_context *context, const ktg_pattern *pattern, size_t sheet,
                          const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    KTG_TRY(ktg_drawing_of_sheet(context, pattern, options, sheet, &drawing));
    ktg_status status = write_svg(drawing, sheet, output);
    ktg_drawing_free(&drawing);
    return status;
}
