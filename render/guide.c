/* render/guide.c - "How to read this pattern": a page of its own where sheets had no room for it.
 */
#include "render/draw.h"

#include <string.h>

#define MARGIN_MM 20.0

/* The state of a page that is written from top to bottom. */
typedef struct column {
    const ktg_drawing *drawing;
    cairo_t *cairo;
    double x, y, width;
    double scale; /* 1, less on small paper */
} column;

static void write_line(column *at, ktg_face face, double digit_mm, double indent,
                       const char *text) {
    char line[KTG_TITLE_SIZE];
    ktg_text_clean(text, SIZE_MAX, line, sizeof line);
    digit_mm *= at->scale;
    indent *= at->scale;
    ktg_text_set(at->cairo, face, digit_mm);
    ktg_text_shorten(at->cairo, at->width - indent, line, sizeof line);
    cairo_set_source_rgb(at->cairo, 0.15, 0.15, 0.15);
    ktg_text_draw(at->cairo, at->x + indent, at->y + digit_mm, line);
    at->y += 2.2 * digit_mm;
}

static const char *explain(ktg_stroke stroke) {
    static const char *const words[KTG_STROKE_COUNT] = {
        [KTG_STROKE_CUT] = "cut: along the whole outline, slits too",
        [KTG_STROKE_MOUNTAIN] = "mountain fold: away from you, the print outside",
        [KTG_STROKE_VALLEY] = "valley fold: towards you, the print inside",
        [KTG_STROKE_TAB] =
            "glue tab: fold it at its foot, glue it under the edge of the same number",
        [KTG_STROKE_JOINT] =
            "no tab: glue it edge to edge, halves on each other, on a strip of paper inside",
        [KTG_STROKE_SEW] = "seam: sew here",
        [KTG_STROKE_GRAIN] = "grain: lay it along the threads of the cloth",
        [KTG_STROKE_PLACE_FOLD] = "place on fold: lay it on the fold of the doubled cloth",
        [KTG_STROKE_DART] = "dart: bring both sides together and sew",
        [KTG_STROKE_NOTCH] = "notch: must meet the same notch of the other piece",
        [KTG_STROKE_INTERNAL] = "inner line: a mark, neither cut nor sewn",
    };
    return words[stroke];
}

static void write_lines(column *at) {
    for (int k = 0; k < KTG_STROKE_COUNT; k++)
        if (at->drawing->kinds & 1u << k) {
            ktg_legend_sample(at->drawing, at->cairo, (ktg_stroke)k, at->x, at->y + 1.2 * at->scale,
                              18 * at->scale);
            write_line(at, KTG_FACE_PLAIN, 2.4, 23, explain((ktg_stroke)k));
            at->y += 1.6 * at->scale;
        }
}

static void write_head(column *at) {
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE];
    write_line(at, KTG_FACE_BOLD, 4.2, 0, "How to read this pattern");
    at->y += 1 * at->scale;
    write_line(at, KTG_FACE_BOLD, 2.8, 0, at->drawing->title);
    size_t count = ktg_furniture_details(at->drawing, SIZE_MAX, details);
    for (size_t i = 0; i + 1 < count; i++) /* the last one has a section of its own */
        write_line(at, KTG_FACE_PLAIN, 2.4, 0, details[i]);
    at->y += 5 * at->scale;
}

static void write_rulers(column *at, double floor) {
    double room = floor - at->y - 6;
    write_line(at, KTG_FACE_BOLD, 2.8, 0, "Size");
    write_line(at, KTG_FACE_PLAIN, 2.4, 0,
               "Print at 100 %, not fitted to the page, then measure both rulers.");
    if (room < ktg_ruler_length(false) || at->width < ktg_ruler_length(false) + 6)
        return;
    bool whole = room >= ktg_ruler_length(true) && at->width >= ktg_ruler_length(true) + 6;
    double foot = at->y + 4 + ktg_ruler_length(whole);
    ktg_ruler_draw(at->cairo, at->x + 2, foot, whole, true);
    ktg_ruler_draw(at->cairo, at->x + 6, foot + 4, whole, false);
}

void ktg_guide_draw(const ktg_drawing *drawing, cairo_t *cairo, double width_mm, double height_mm) {
    double margin = fmin(MARGIN_MM, fmin(width_mm, height_mm) / 8);
    double scale = fmin(1, fmin((width_mm - 2 * margin) / 150, (height_mm - 2 * margin) / 240));
    column at = {drawing, cairo, margin, margin, width_mm - 2 * margin, scale};
    ktg_page_begin(cairo);
    write_head(&at);
    write_line(&at, KTG_FACE_BOLD, 2.8, 0, "Lines");
    at.y += 1 * scale;
    write_lines(&at);
    at.y += 5 * scale;
    write_line(&at, KTG_FACE_BOLD, 2.8, 0, "Numbers");
    write_line(&at, KTG_FACE_PLAIN, 2.4, 0, "Edges with the same number belong together.");
    write_line(&at, KTG_FACE_PLAIN, 2.4, 0,
               "A dot follows numbers that could be read upside down: \"6.\" is six, not nine.");
    at.y += 5 * scale;
    write_rulers(&at, height_mm - margin);
}
