/* render/pdf.c - all sheets as one PDF, a page each. */
#include "core/memory.h"
#include "render/draw.h"
#include "render/more_pages.h"
#include "render/poster.h"

#include <cairo-pdf.h>
#include <stdio.h>

#define POINT_PER_MM (72 / 25.4)
/* What PDF readers take: 200 inches a side. */
#define MOST_MM    5080.0
#define ENTRY_SIZE (4 * KTG_NAME_SIZE)

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

/* A PDF while its pages are drawn. */
typedef struct pdf {
    const ktg_drawing *drawing;
    cairo_surface_t *surface;
    cairo_t *cairo;
    size_t pages; /* begun so far */
    int section;  /* of the outline, to which sheets belong */
    bool all_furnished;
} pdf;

/* An entry of the outline, to the page that is being drawn. */
static int add_entry(const pdf *p, int parent, const char *name, bool open) {
    char target[64];
    snprintf(target, sizeof target, "page=%zu pos=[0 0]", p->pages);
    return cairo_pdf_surface_add_outline(p->surface, parent, name, target,
                                         open ? CAIRO_PDF_OUTLINE_FLAG_OPEN
                                              : (cairo_pdf_outline_flags_t)0);
}

static void begin_page_of(pdf *p, const char *label, double width_mm, double height_mm) {
    cairo_pdf_surface_set_size(p->surface, width_mm * POINT_PER_MM, height_mm * POINT_PER_MM);
    cairo_pdf_surface_set_page_label(p->surface, label);
    cairo_identity_matrix(p->cairo);
    cairo_scale(p->cairo, POINT_PER_MM, POINT_PER_MM);
    p->pages++;
}

static void begin_page(pdf *p, const char *label, const ktg_pattern_sheet *sheet) {
    begin_page_of(p, label, sheet->width_mm, sheet->height_mm);
}

static void draw_covers(pdf *p) {
    size_t count = ktg_cover_count(p->drawing);
    for (size_t k = 0; k < count; k++) {
        char label[32] = "cover";
        if (k > 0)
            snprintf(label, sizeof label, "cover %zu", k + 1);
        begin_page(p, label, &p->drawing->pattern->sheets[0]);
        if (k == 0)
            add_entry(p, CAIRO_PDF_OUTLINE_ROOT, "Cover and maps", false);
        ktg_cover_draw(p->drawing, p->cairo, k);
        cairo_show_page(p->cairo);
    }
}

/* A poster is a section, and so are the sheets before the first one, where there are several. */
static void begin_section(pdf *p, size_t number) {
    const ktg_pattern *pattern = p->drawing->pattern;
    const ktg_pattern_sheet *sheet = &pattern->sheets[number];
    char name[KTG_NAME_SIZE], text[KTG_NAME_SIZE + 32];
    bool tile = ktg_is_tile(sheet);
    if (number > 0 && (tile ? sheet->poster : 0) == pattern->sheets[number - 1].poster)
        return;
    if (tile) {
        ktg_drawing_piece_name(p->drawing, sheet->placements->piece, name);
        snprintf(text, sizeof text, "Poster %u: %s", sheet->poster, name);
        p->section = add_entry(p, CAIRO_PDF_OUTLINE_ROOT, text, false);
    } else if (pattern->sheet_count > 1)
        p->section = add_entry(p, CAIRO_PDF_OUTLINE_ROOT, "Sheets", true);
}

/* "Sheet 2: head, neck and 3 more"; "B2". */
static void sheet_entry(const ktg_drawing *drawing, size_t number, char text[ENTRY_SIZE]) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[number];
    char name[KTG_NAME_SIZE];
    if (ktg_is_tile(sheet)) {
        ktg_tile_name(drawing, sheet, name);
        snprintf(text, ENTRY_SIZE, "%s", name);
        return;
    }
    size_t used = (size_t)snprintf(text, ENTRY_SIZE, "Sheet %zu", number + 1), named = 0;
    for (; drawing->pattern->piece_count > 1 && named < 3 && named < sheet->placement_count;
         named++) {
        ktg_drawing_piece_name(drawing, sheet->placements[named].piece, name);
        used += (size_t)snprintf(text + used, ENTRY_SIZE - used, "%s%s", named ? ", " : ": ", name);
    }
    if (named > 0 && named < sheet->placement_count)
        snprintf(text + used, ENTRY_SIZE - used, " and %zu more", sheet->placement_count - named);
}

static ktg_status draw_sheet(pdf *p, size_t number) {
    const ktg_pattern_sheet *sheet = &p->drawing->pattern->sheets[number];
    char label[KTG_NAME_SIZE], entry[ENTRY_SIZE];
    bool furnished = false;
    snprintf(label, sizeof label, "%zu", number + 1);
    if (ktg_is_tile(sheet))
        ktg_tile_name(p->drawing, sheet, label);
    begin_page(p, label, sheet);
    begin_section(p, number);
    sheet_entry(p->drawing, number, entry);
    add_entry(p, p->section, entry, false);
    ktg_status status = ktg_page_draw(p->drawing, number, p->cairo, &furnished);
    p->all_furnished = p->all_furnished && furnished;
    cairo_show_page(p->cairo);
    return status;
}

static ktg_status draw_strain(pdf *p) {
    const ktg_pattern_sheet *first = &p->drawing->pattern->sheets[0];
    if (!ktg_strain_is_wanted(p->drawing))
        return KTG_OK;
    begin_page(p, "strain", first);
    add_entry(p, CAIRO_PDF_OUTLINE_ROOT, "Where the cloth strains", false);
    ktg_status status = ktg_strain_draw(p->drawing, p->cairo, first->width_mm, first->height_mm);
    cairo_show_page(p->cairo);
    return status;
}

static ktg_status draw_guide_pages(pdf *p, ktg_build_guide *guide) {
    ktg_status status = KTG_OK;
    double width, height;
    ktg_build_guide_size(p->drawing, &width, &height);
    for (size_t k = 0; status == KTG_OK && !ktg_build_guide_is_done(guide); k++) {
        char label[32] = "build";
        if (k > 0)
            snprintf(label, sizeof label, "build %zu", k + 1);
        begin_page_of(p, label, width, height);
        if (k == 0)
            add_entry(p, CAIRO_PDF_OUTLINE_ROOT, "How to build it", false);
        status = ktg_build_guide_draw(guide, p->cairo, width, height);
        cairo_show_page(p->cairo);
    }
    return status;
}

static ktg_status draw_guide(pdf *p) {
    ktg_build_guide *guide;
    if (!ktg_build_guide_is_wanted(p->drawing))
        return KTG_OK;
    KTG_TRY(ktg_build_guide_new(p->drawing, &guide));
    ktg_status status = draw_guide_pages(p, guide);
    ktg_build_guide_free(&guide);
    return status;
}

static ktg_status draw_pages(pdf *p) {
    const ktg_pattern *pattern = p->drawing->pattern;
    ktg_status status = KTG_OK;
    draw_covers(p);
    for (size_t s = 0; status == KTG_OK && s < pattern->sheet_count; s++)
        status = draw_sheet(p, s);
    if (status == KTG_OK && !p->all_furnished) {
        const ktg_pattern_sheet *first = &pattern->sheets[0];
        begin_page(p, "guide", first);
        add_entry(p, CAIRO_PDF_OUTLINE_ROOT, "How to read this pattern", false);
        ktg_guide_draw(p->drawing, p->cairo, first->width_mm, first->height_mm);
        cairo_show_page(p->cairo);
    }
    if (status == KTG_OK)
        status = draw_guide(p);
    return status == KTG_OK ? draw_strain(p) : status;
}

static ktg_status draw_pdf(const ktg_drawing *drawing, ktg_output *output) {
    const ktg_pattern_sheet *first = &drawing->pattern->sheets[0];
    ktg_sink sink = {drawing->context, output, KTG_OK};
    cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
        ktg_sink_write, &sink, first->width_mm * POINT_PER_MM, first->height_mm * POINT_PER_MM);
    set_metadata(drawing, surface);
    cairo_t *cairo = cairo_create(surface);
    pdf p = {drawing, surface, cairo, 0, CAIRO_PDF_OUTLINE_ROOT, true};
    ktg_status status = draw_pages(&p);
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
