/* render/column.c - a page that is written from top to bottom. */
#include "render/draw.h"

void ktg_column_write(ktg_column *at, ktg_face face, double digit_mm, double indent,
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

void ktg_column_skip(ktg_column *at, double mm) {
    at->y += mm * at->scale;
}

ktg_column ktg_column_begin(const ktg_drawing *drawing, cairo_t *cairo, double width_mm,
                            double height_mm) {
    double margin = fmin(20, fmin(width_mm, height_mm) / 8);
    double scale = fmin(1, fmin((width_mm - 2 * margin) / 150, (height_mm - 2 * margin) / 240));
    ktg_page_begin(cairo);
    return (ktg_column){drawing, cairo, margin, margin, width_mm - 2 * margin, height_mm - margin,
                        scale};
}
