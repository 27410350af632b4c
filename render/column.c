/* render/column.c - a page that is written from top to bottom. */
#include "render/draw.h"
#include "render/text.h"

#include <string.h>

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

/* The length of the words that fit a line, with the blanks between them; one word at least. */
static size_t fitting(const ktg_column *at, const char *text) {
    char line[KTG_TITLE_SIZE];
    size_t best = 0;
    for (size_t end = 0;; end++) {
        if (text[end] != ' ' && text[end] != 0)
            continue;
        size_t length = end < sizeof line ? end : sizeof line - 1;
        memcpy(line, text, length);
        line[length] = 0;
        if (best > 0 && (end >= sizeof line || ktg_text_width(at->cairo, line) > at->width))
            return best;
        best = end;
        if (text[end] == 0)
            return best;
    }
}

void ktg_column_wrap(ktg_column *at, ktg_face face, double digit_mm, const char *text, bool dry) {
    digit_mm *= at->scale;
    ktg_text_set(at->cairo, face, digit_mm);
    cairo_set_source_rgb(at->cairo, 0.15, 0.15, 0.15);
    while (*text) {
        char line[KTG_TITLE_SIZE];
        size_t length = fitting(at, text);
        ktg_text_clean(text, length, line, sizeof line);
        ktg_text_shorten(at->cairo, at->width, line, sizeof line);
        if (!dry)
            ktg_text_draw(at->cairo, at->x, at->y + digit_mm, line);
        at->y += 1.75 * digit_mm;
        text += length;
        while (*text == ' ')
            text++;
    }
    at->y += 0.5 * digit_mm;
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
