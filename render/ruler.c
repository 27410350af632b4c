/* render/ruler.c - millimetres and inches on one line: a printer that scales is found out. */
#include "render/draw.h"
#include "render/furniture.h"
#include "render/text.h"

#define INCH_MM     25.4
#define LONG_MM     1.5
#define SHORT_MM    1.0
#define RULER_DIGIT 1.3

double ktg_ruler_length(bool whole) {
    return whole ? 4 * INCH_MM : 2 * INCH_MM;
}

/* Ticks every `step` mm up to `length`; every `major`-th and the last one are long. `up` is -1 for
 * ticks above the line. */
static void ticks(cairo_t *cairo, double step, int major, double length, double up) {
    int count = (int)round(length / step);
    for (int i = 0; i <= count; i++) {
        double height = i % major == 0 || i == count ? LONG_MM : SHORT_MM;
        cairo_move_to(cairo, i * step, 0);
        cairo_line_to(cairo, i * step, up * height);
    }
    cairo_stroke(cairo);
}

/* The word stands before the last tick, between it and the one before. */
static void word_before(cairo_t *cairo, double x, double baseline, const char *word) {
    ktg_text_draw(cairo, x - 0.7 - ktg_text_width(cairo, word), baseline, word);
}

void ktg_ruler_draw(cairo_t *cairo, double x, double y, bool whole, bool upright) {
    double length_mm = whole ? 100 : 50, length_in = ktg_ruler_length(whole);
    cairo_save(cairo);
    cairo_translate(cairo, x, y);
    if (upright)
        cairo_rotate(cairo, -KTG_PI / 2);
    cairo_set_source_rgb(cairo, 0.25, 0.25, 0.25);
    cairo_set_line_width(cairo, 0.15);
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_move_to(cairo, -0.075, 0);
    cairo_line_to(cairo, length_in + 0.075, 0);
    cairo_stroke(cairo);
    ticks(cairo, 10, 5, length_mm, -1);
    ticks(cairo, INCH_MM / 2, 2, length_in, 1);
    ktg_text_set(cairo, KTG_FACE_PLAIN, RULER_DIGIT);
    word_before(cairo, length_mm, -0.35, whole ? "100 mm" : "50 mm");
    word_before(cairo, length_in, 0.35 + RULER_DIGIT, whole ? "4 in" : "2 in");
    cairo_restore(cairo);
}
