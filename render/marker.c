/* render/marker.c - a sheet that is fabric: its edges, how wide it is and how long. */
#include "render/draw.h"
#include "render/furniture.h"
#include "render/text.h"

#include <stdio.h>

#define EDGE_MM  0.6 /* of the fabric: a line just inside the page */
#define DIGIT_MM 4.0
#define ARROW_MM 4.0

bool ktg_is_marker(const ktg_page *page) {
    return page->drawing->options.marker && page->sheet->kind == KTG_ROLL;
}

void ktg_marker_tell(const ktg_pattern_sheet *sheet, char text[KTG_DETAIL_SIZE]) {
    snprintf(text, KTG_DETAIL_SIZE, "fabric %.0f mm wide, %.0f mm long", sheet->width_mm,
             ceil(sheet->height_mm));
}

/* An arrow of two heads along a side of `length`, `in` from it, with a text in its middle; the side
 * runs from the origin to the right. */
static void measure(cairo_t *cairo, double length, double in, const char *text) {
    ktg_text_set(cairo, KTG_FACE_PLAIN, DIGIT_MM);
    double half = ktg_text_width(cairo, text) / 2 + DIGIT_MM / 2, middle = length / 2;
    if (length < 4 * half)
        return;
    cairo_move_to(cairo, middle - 2 * half, in);
    cairo_line_to(cairo, middle - half, in);
    cairo_move_to(cairo, middle + half, in);
    cairo_line_to(cairo, middle + 2 * half, in);
    cairo_stroke(cairo);
    ktg_draw_arrow_head(cairo, (ktg_vec2){middle - 2 * half - ARROW_MM, in}, (ktg_vec2){middle, in},
                        ARROW_MM);
    ktg_draw_arrow_head(cairo, (ktg_vec2){middle + 2 * half + ARROW_MM, in}, (ktg_vec2){middle, in},
                        ARROW_MM);
    ktg_text_draw(cairo, middle - half + DIGIT_MM / 2, in + DIGIT_MM / 2, text);
}

/* In the middles of the upper and the right margin, where nothing else stands. */
static void draw_measures(const ktg_page *page) {
    const ktg_pattern_sheet *sheet = page->sheet;
    cairo_t *cairo = page->cairo;
    double in = (sheet->height_mm - sheet->printable[3]) / 2;
    char text[KTG_DETAIL_SIZE];
    if (2 * in < DIGIT_MM + 2)
        return;
    snprintf(text, sizeof text, "width %.0f mm", sheet->width_mm);
    measure(cairo, sheet->width_mm, in, text);
    snprintf(text, sizeof text, "length %.0f mm", ceil(sheet->height_mm));
    cairo_translate(cairo, sheet->width_mm, 0);
    cairo_rotate(cairo, KTG_PI / 2);
    measure(cairo, sheet->height_mm, in, text);
}

void ktg_marker_draw(const ktg_page *page) {
    cairo_t *cairo = page->cairo;
    if (!ktg_is_marker(page))
        return;
    cairo_save(cairo);
    ktg_draw_set_stroke(page->drawing, cairo, KTG_STROKE_TRIM);
    cairo_set_line_width(cairo, EDGE_MM);
    cairo_rectangle(cairo, EDGE_MM / 2, EDGE_MM / 2, page->sheet->width_mm - EDGE_MM,
                    page->sheet->height_mm - EDGE_MM);
    cairo_stroke(cairo);
    cairo_set_line_width(cairo, KTG_CUT_MM);
    draw_measures(page);
    cairo_restore(cairo);
}
