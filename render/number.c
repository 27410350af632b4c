/* render/number.c - a number at any angle that a reader of the PDF finds as one word.
 *
 * Readers of text know four directions. What is turned otherwise falls apart into letters, and its
 * box is taken from where the first letter begins and the last one ends. So the letters are one
 * cluster (in a PDF: a span with its text) between two blanks, which begin and end where the number
 * would in the nearest of the four directions. */
#include "render/draw.h"
#include "render/text.h"

#include <string.h>

#define MOST_GLYPHS 16

typedef struct glyph_list {
    cairo_glyph_t items[MOST_GLYPHS];
    int count;
    bool full; /* something had no room */
} glyph_list;

static void append(cairo_t *cairo, ktg_vec2 at, const char *text, glyph_list *list) {
    cairo_glyph_t *made = NULL;
    int count = 0;
    cairo_status_t status = cairo_scaled_font_text_to_glyphs(
        cairo_get_scaled_font(cairo), at.x, at.y, text, -1, &made, &count, NULL, NULL, NULL);
    if (status != CAIRO_STATUS_SUCCESS || list->count + count > MOST_GLYPHS) {
        list->full = true;
    } else {
        memcpy(list->items + list->count, made, (size_t)count * sizeof *made);
        list->count += count;
    }
    cairo_glyph_free(made);
}

void ktg_number_draw(cairo_t *cairo, double angle, double digit_mm, const char *text) {
    double half = ktg_text_width(cairo, text) / 2, blank = ktg_text_width(cairo, " ");
    double rest = angle - KTG_PI / 2 * round(2 * angle / KTG_PI), c = cos(rest), s = sin(rest);
    /* Begin and end on the base line, turned back to the nearest direction; not quite as far from
     * the middle as the number reaches along that, or neighbours would be read as one. */
    ktg_vec2 along = {c, s}, down = {-s, c}, base = ktg_mul2(down, digit_mm / 2);
    double reach = 0.75 * half * c;
    ktg_vec2 begin = ktg_madd2(base, -reach, along), end = ktg_madd2(base, reach, along);
    glyph_list list = {.count = 0};
    append(cairo, begin, " ", &list);
    append(cairo, (ktg_vec2){-half, digit_mm / 2}, text, &list);
    append(cairo, (ktg_vec2){end.x - blank, end.y}, " ", &list);
    cairo_text_cluster_t whole = {(int)strlen(text), list.count};
    if (list.full)
        ktg_text_draw(cairo, -half, digit_mm / 2, text);
    else
        cairo_show_text_glyphs(cairo, text, -1, list.items, list.count, &whole, 1,
                               (cairo_text_cluster_flags_t)0);
    cairo_new_path(cairo);
}
