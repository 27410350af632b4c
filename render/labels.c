/* render/labels.c - numbers and names on the pieces. */
#include "render/draw.h"

/* True when text turned counter-clockwise by `angle` stands on its head, or reads from top to
 * bottom. */
static bool upside_down(double angle) {
    double c = cos(angle), s = sin(angle);
    return c < -1e-9 || (c < 1e-9 && s < 0);
}

/* A name may cross folds: it gets a clear ground. */
static void clear_ground(cairo_t *cairo, double x, double baseline, const char *text,
                         double width) {
    cairo_move_to(cairo, x, baseline);
    cairo_text_path(cairo, text);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
}

static void draw_label(const ktg_page *page, const ktg_pattern_placement *placement,
                       const ktg_pattern_label *label) {
    cairo_t *cairo = page->cairo;
    char text[3 * sizeof label->text + 1];
    ktg_text_clean(label->text, sizeof label->text, text, sizeof text);
    if (!*text || !(label->height_mm > 0))
        return;
    /* A number keeps its turn, and a dot after it where it could be misread; a name is turned so
     * that it can be read. */
    bool name = label->edge == KTG_NONE;
    double angle = label->rotation + placement->rotation;
    if (name && upside_down(angle))
        angle += KTG_PI;
    ktg_vec2 at = ktg_page_point(page, ktg_page_motion(placement), label->at);
    cairo_save(cairo);
    cairo_translate(cairo, at.x, at.y);
    cairo_rotate(cairo, -angle);
    ktg_text_set(cairo, KTG_FACE_PLAIN, label->height_mm);
    double x = -ktg_text_width(cairo, text) / 2, baseline = label->height_mm / 2;
    if (name)
        clear_ground(cairo, x, baseline, text, label->height_mm / 3);
    cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
    ktg_text_draw(cairo, x, baseline, text);
    cairo_restore(cairo);
}

void ktg_draw_labels(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    for (size_t i = 0; i < piece->label_count; i++)
        draw_label(page, placement, &piece->labels[i]);
}
