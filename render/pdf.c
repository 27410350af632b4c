/* render/pdf.c - all sheets as one PDF, a page each. */
#include "render/draw.h"

#include <cairo-pdf.h>
#include <stdio.h>

#define POINT_PER_MM (72 / 25.4)
/* What PDF readers take: 200 inches a side. */
#define MOST_MM 5080.0

static ktg_status check_size(const ktg_drawing *drawing) {
    for (size_t s = 0; s < drawing->pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[s];
        if (sheet->width_mm > MOST_MM || sheet->height_mm > MOST_MM)
            return ktg_fail(drawing->context, KTG_LIMIT,
                            "sheet %zu is %g x %g mm, but a PDF page can have %g mm a side: choose "
                            "smaller sheets, or SVG",
                            s + 1, sheet->width_mm, sheet->height_mm, MOST_MM);
    }
    return KTG_OK;
}

/* The date is fixed: the same pattern gives the same bytes. */
static void set_metadata(const ktg_drawing *drawing, cairo_surface_t *surface) {
    char creator[64];
    snprintf(creator, sizeof creator, "Katagami %s", ktg_version());
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, drawing->title);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, creator);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_SUBJECT,
                                   drawing->pattern->mode == KTG_CLOTH ? "Cloth pattern"
                                                                       : "Papercraft net");
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
}

/* Begins page `number` (from 1); it appears in the reader's outline under `name`. */
static void begin_page(cairo_surface_t *surface, cairo_t *cairo, size_t number, const char *label,
                       const char *name, double width_mm, double height_mm) {
    char target[64];
    cairo_pdf_surface_set_size(surface, width_mm * POINT_PER_MM, height_mm * POINT_PER_MM);
    cairo_pdf_surface_set_page_label(surface, label);
    snprintf(target, sizeof target, "page=%zu pos=[0 0]", number);
    cairo_pdf_surface_add_outline(surface, CAIRO_PDF_OUTLINE_ROOT, name, target,
                                  (cairo_pdf_outline_flags_t)0);
    cairo_identity_matrix(cairo);
    cairo_scale(cairo, POINT_PER_MM, POINT_PER_MM);
}

static void draw_covers(const ktg_drawing *drawing, cairo_surface_t *surface, cairo_t *cairo) {
    const ktg_pattern_sheet *first = &drawing->pattern->sheets[0];
    size_t count = ktg_cover_count(drawing);
    for (size_t k = 0; k < count; k++) {
        char label[32] = "cover";
        if (k > 0)
            snprintf(label, sizeof label, "cover %zu", k + 1);
        begin_page(surface, cairo, k + 1, label, k > 0 ? "More maps" : "Cover and maps",
                   first->width_mm, first->height_mm);
        ktg_cover_draw(drawing, cairo, k);
        cairo_show_page(cairo);
    }
}

static ktg_status draw_sheets(const ktg_drawing *drawing, cairo_surface_t *surface,
                              cairo_t *cairo) {
    const ktg_pattern *pattern = drawing->pattern;
    size_t before = ktg_cover_count(drawing);
    bool all_furnished = true;
    draw_covers(drawing, surface, cairo);
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        char label[32], name[48];
        bool furnished;
        snprintf(label, sizeof label, "%zu", s + 1);
        snprintf(name, sizeof name, "Sheet %zu", s + 1);
        begin_page(surface, cairo, before + s + 1, label, name, pattern->sheets[s].width_mm,
                   pattern->sheets[s].height_mm);
        ktg_status status = ktg_page_draw(drawing, s, cairo, &furnished);
        if (status != KTG_OK)
            return status;
        all_furnished = all_furnished && furnished;
        cairo_show_page(cairo);
    }
    if (!all_furnished) {
        const ktg_pattern_sheet *first = &pattern->sheets[0];
        begin_page(surface, cairo, before + pattern->sheet_count + 1, "guide",
                   "How to read this pattern", first->width_mm, first->height_mm);
        ktg_guide_draw(drawing, cairo, first->width_mm, first->height_mm);
        cairo_show_page(cairo);
    }
    return KTG_OK;
}

static ktg_status draw_pdf(const ktg_drawing *drawing, ktg_output *output) {
    const ktg_pattern_sheet *first = &drawing->pattern->sheets[0];
    ktg_sink sink = {drawing->context, output, KTG_OK};
    cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
        ktg_sink_write, &sink, first->width_mm * POINT_PER_MM, first->height_mm * POINT_PER_MM);
    set_metadata(drawing, surface);
    cairo_t *cairo = cairo_create(surface);
    ktg_status status = draw_sheets(drawing, surface, cairo);
    cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        drawn = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return status != KTG_OK ? status : ktg_cairo_status(drawing->context, &sink, drawn, "the PDF");
}

ktg_status ktg_render_pdf(ktg_context *context, const ktg_pattern *pattern,
                          const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    ktg_status status = ktg_drawing_new(context, pattern, options, &drawing);
    if (status != KTG_OK)
        return status;
    status = check_size(drawing);
    if (status == KTG_OK)
        status = draw_pdf(drawing, output);
    ktg_drawing_free(&drawing);
    return status;
}
