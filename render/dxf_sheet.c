/* render/dxf_sheet.c - one sheet as DXF for a cutting machine: a layer for each operation. */
#include "render/dxf.h"

#include "core/memory.h"

/* A DXF while it is written. */
typedef struct sheet_file {
    ktg_dxf dxf;
    const ktg_plot *plot;
    const ktg_plot_path *path; /* being dashed */
} sheet_file;

/* What a stroke's dashes are called. */
static const char *pattern_of(const ktg_plot *plot, ktg_stroke stroke) {
    static const char *const names[KTG_STROKE_COUNT] = {
        [KTG_STROKE_MOUNTAIN] = "MOUNTAIN", [KTG_STROKE_VALLEY] = "VALLEY",
        [KTG_STROKE_SEW] = "SEW",           [KTG_STROKE_PLACE_FOLD] = "PLACE_ON_FOLD",
        [KTG_STROKE_DART] = "DART",         [KTG_STROKE_JOIN] = "JOIN"};
    const ktg_drawing *drawing = plot->page.drawing;
    bool dashed = ktg_stroke_dashes(drawing, stroke).dash > 0 && !drawing->options.real_dashes;
    return dashed ? names[stroke] : NULL;
}

/* ---- the header ----------------------------------------------------------------------------- */

static ktg_status put_variable(const ktg_dxf *dxf, const char *name, int code, int value) {
    KTG_TRY(ktg_dxf_word(dxf, 9, name));
    return ktg_dxf_integer(dxf, code, value);
}

static ktg_status put_corner(const ktg_dxf *dxf, const char *name, ktg_vec2 corner) {
    KTG_TRY(ktg_dxf_word(dxf, 9, name));
    return ktg_dxf_point(dxf, 0, corner);
}

/* The unit is known to later readers only; Release 12 has none, and a unit is a millimetre. */
static ktg_status put_header(const sheet_file *f) {
    const ktg_dxf *dxf = &f->dxf;
    ktg_vec2 low = {0, 0}, high = {f->plot->page.sheet->width_mm, f->plot->page.sheet->height_mm};
    KTG_TRY(ktg_dxf_section(dxf, "HEADER"));
    KTG_TRY(ktg_dxf_word(dxf, 9, "$ACADVER"));
    KTG_TRY(ktg_dxf_word(dxf, 1, "AC1009"));
    KTG_TRY(put_variable(dxf, "$INSUNITS", 70, 4));
    KTG_TRY(put_variable(dxf, "$MEASUREMENT", 70, 1));
    KTG_TRY(put_variable(dxf, "$LUNITS", 70, 2));
    KTG_TRY(put_corner(dxf, "$EXTMIN", low));
    KTG_TRY(put_corner(dxf, "$EXTMAX", high));
    KTG_TRY(put_corner(dxf, "$LIMMIN", low));
    KTG_TRY(put_corner(dxf, "$LIMMAX", high));
    return ktg_dxf_word(dxf, 0, "ENDSEC");
}

/* ---- tables ------------------------------------------------------------------------------- */

static ktg_status begin_table(const ktg_dxf *dxf, const char *name, int count) {
    KTG_TRY(ktg_dxf_word(dxf, 0, "TABLE"));
    KTG_TRY(ktg_dxf_word(dxf, 2, name));
    return ktg_dxf_integer(dxf, 70, count);
}

static ktg_status begin_entry(const ktg_dxf *dxf, const char *table, const char *name) {
    KTG_TRY(ktg_dxf_word(dxf, 0, table));
    KTG_TRY(ktg_dxf_word(dxf, 2, name));
    return ktg_dxf_integer(dxf, 70, 0);
}

/* A line type: dashes are positive, gaps negative. */
static ktg_status put_line_type(const ktg_dxf *dxf, const char *name, ktg_dashes dashes) {
    const double lengths[] = {dashes.dash, -dashes.gap, dashes.dot, -dashes.gap};
    int count = !(dashes.dash > 0) ? 0 : dashes.dot > 0 ? 4 : 2;
    double sum = 0;
    for (int k = 0; k < count; k++)
        sum += fabs(lengths[k]);
    KTG_TRY(begin_entry(dxf, "LTYPE", name));
    KTG_TRY(ktg_dxf_word(dxf, 3, ""));
    KTG_TRY(ktg_dxf_integer(dxf, 72, 65));
    KTG_TRY(ktg_dxf_integer(dxf, 73, count));
    KTG_TRY(ktg_dxf_real(dxf, 40, sum));
    for (int k = 0; k < count; k++)
        KTG_TRY(ktg_dxf_real(dxf, 49, lengths[k]));
    return KTG_OK;
}

static ktg_status put_line_types(const sheet_file *f) {
    const ktg_drawing *drawing = f->plot->page.drawing;
    KTG_TRY(begin_table(&f->dxf, "LTYPE", KTG_STROKE_COUNT));
    KTG_TRY(put_line_type(&f->dxf, "CONTINUOUS", (ktg_dashes){0, 0, 0}));
    for (int stroke = 0; stroke < KTG_STROKE_COUNT; stroke++) {
        const char *name = pattern_of(f->plot, (ktg_stroke)stroke);
        if (name)
            KTG_TRY(put_line_type(&f->dxf, name, ktg_stroke_dashes(drawing, (ktg_stroke)stroke)));
    }
    return ktg_dxf_word(&f->dxf, 0, "ENDTAB");
}

static ktg_status put_layer(const sheet_file *f, const char *name, int colour) {
    KTG_TRY(begin_entry(&f->dxf, "LAYER", name));
    KTG_TRY(ktg_dxf_integer(&f->dxf, 62, f->plot->page.drawing->options.colour ? colour : 7));
    return ktg_dxf_word(&f->dxf, 6, "CONTINUOUS");
}

static ktg_status put_layers(const sheet_file *f) {
    unsigned layers = ktg_plot_layers(f->plot);
    KTG_TRY(begin_table(&f->dxf, "LAYER", KTG_LAYER_COUNT + 1));
    KTG_TRY(put_layer(f, "0", 7));
    for (int layer = 0; layer < KTG_LAYER_COUNT; layer++) {
        const ktg_layer_look *look = ktg_layer_look_of((ktg_layer)layer);
        if (layers & 1u << layer)
            KTG_TRY(put_layer(f, look->name, look->index));
    }
    return ktg_dxf_word(&f->dxf, 0, "ENDTAB");
}

static ktg_status put_style(const ktg_dxf *dxf) {
    KTG_TRY(begin_table(dxf, "STYLE", 1));
    KTG_TRY(begin_entry(dxf, "STYLE", "STANDARD"));
    KTG_TRY(ktg_dxf_real(dxf, 40, 0));
    KTG_TRY(ktg_dxf_real(dxf, 41, 1));
    KTG_TRY(ktg_dxf_real(dxf, 50, 0));
    KTG_TRY(ktg_dxf_integer(dxf, 71, 0));
    KTG_TRY(ktg_dxf_real(dxf, 42, 2.5));
    KTG_TRY(ktg_dxf_word(dxf, 3, "txt"));
    KTG_TRY(ktg_dxf_word(dxf, 4, ""));
    return ktg_dxf_word(dxf, 0, "ENDTAB");
}

static ktg_status put_tables(const sheet_file *f) {
    KTG_TRY(ktg_dxf_section(&f->dxf, "TABLES"));
    KTG_TRY(put_line_types(f));
    KTG_TRY(put_layers(f));
    KTG_TRY(put_style(&f->dxf));
    return ktg_dxf_word(&f->dxf, 0, "ENDSEC");
}

/* ---- entities ----------------------------------------------------------------------------- */

static ktg_status put_dash(void *user, const ktg_vec2 *points, size_t count) {
    const sheet_file *f = user;
    return ktg_dxf_way(&f->dxf, ktg_layer_look_of(f->path->layer)->name, NULL, points, count,
                       false);
}

static ktg_status put_path(sheet_file *f, const ktg_plot_path *path) {
    const ktg_drawing *drawing = f->plot->page.drawing;
    f->path = path;
    if (drawing->options.real_dashes && ktg_stroke_dashes(drawing, path->stroke).dash > 0)
        return ktg_plot_dash(f->plot, path, put_dash, f);
    return ktg_dxf_way(&f->dxf, ktg_layer_look_of(path->layer)->name,
                       pattern_of(f->plot, path->stroke), f->plot->points + path->first,
                       path->count, path->closed);
}

static ktg_status put_text(const sheet_file *f, const ktg_plot_text *text) {
    const char *layer = ktg_layer_look_of(text->layer)->name;
    if (text->begins)
        return ktg_dxf_line(&f->dxf, layer, text->at, text->height_mm, text->text);
    return ktg_dxf_label(&f->dxf, layer, text->at, text->width, text->height_mm, text->angle,
                         text->text);
}

static ktg_status put_entities(sheet_file *f) {
    const ktg_plot *plot = f->plot;
    KTG_TRY(ktg_dxf_section(&f->dxf, "ENTITIES"));
    for (int layer = 0; layer < KTG_LAYER_COUNT; layer++) {
        for (size_t i = 0; i < plot->path_count; i++)
            if (plot->paths[i].layer == (ktg_layer)layer)
                KTG_TRY(put_path(f, &plot->paths[i]));
        for (size_t i = 0; i < plot->text_count; i++)
            if (plot->texts[i].layer == (ktg_layer)layer)
                KTG_TRY(put_text(f, &plot->texts[i]));
    }
    return ktg_dxf_word(&f->dxf, 0, "ENDSEC");
}

static ktg_status put_file(sheet_file *f) {
    KTG_TRY(put_header(f));
    KTG_TRY(put_tables(f));
    KTG_TRY(ktg_dxf_section(&f->dxf, "BLOCKS"));
    KTG_TRY(ktg_dxf_word(&f->dxf, 0, "ENDSEC"));
    KTG_TRY(put_entities(f));
    return ktg_dxf_word(&f->dxf, 0, "EOF");
}

static ktg_status write_sheet(const ktg_drawing *drawing, size_t sheet, ktg_output *output) {
    ktg_plot plot;
    ktg_status status = ktg_plot_make(drawing, sheet, &plot);
    sheet_file f = {{drawing->context, output, false}, &plot, NULL};
    if (status == KTG_OK)
        status = put_file(&f);
    ktg_plot_drop(&plot);
    return status;
}

ktg_status ktg_render_dxf(ktg_context *context, const ktg_pattern *pattern, size_t sheet,
                          const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    KTG_TRY(ktg_drawing_of_sheet(context, pattern, options, sheet, &drawing));
    ktg_status status = write_sheet(drawing, sheet, output);
    ktg_drawing_free(&drawing);
    return status;
}
