/* render/labels.c - numbers and names on the pieces. */
#include "render/draw.h"
#include "render/text.h"

#define LEADER_MM 0.12

/* True when text turned counter-clockwise by `angle` stands on its head, or reads from top to
 * bottom. */
static bool upside_down(double angle) {
    double c = cos(angle), s = sin(angle);
    return c < -1e-9 || (c < 1e-9 && s < 0);
}

/* The place nearest to `at` where a text of the given size, turned by `angle`, stays within the
 * printable area: a name may be longer than its piece, but does not run into the furniture. */
static ktg_vec2 within_printable(const ktg_page *page, ktg_vec2 at, double angle, double width,
                                 double height) {
    ktg_area area = ktg_page_printable(page);
    double c = fabs(cos(angle)), s = fabs(sin(angle));
    double x = (c * width + s * height) / 2, y = (s * width + c * height) / 2;
    return (ktg_vec2){fmax(fmin(at.x, area.x1 - x), area.x0 + x),
                      fmax(fmin(at.y, area.y1 - y), area.y0 + y)};
}

/* Level lines of a name stand below each other, and do so too when each is turned over to be read:
 * then they change places, about the middle of them all. */
static ktg_vec2 turned_place(const ktg_page *page, const ktg_pattern_placement *placement,
                             const ktg_pattern_label *label) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    double low = INFINITY, high = -INFINITY;
    if (label->rotation != 0 || !upside_down(placement->rotation))
        return label->at;
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *line = &piece->labels[i];
        if (line->edge != KTG_NONE || line->rotation != 0 || line->at.x != label->at.x)
            continue;
        low = fmin(low, line->at.y - line->height_mm / 2);
        high = fmax(high, line->at.y + line->height_mm / 2);
    }
    return (ktg_vec2){label->at.x, low + high - label->at.y};
}

bool ktg_label_place(const ktg_page *page, const ktg_pattern_placement *placement,
                     const ktg_pattern_label *label, ktg_placed_label *placed) {
    ktg_text_clean(label->text, sizeof label->text, placed->text, sizeof placed->text);
    if (!*placed->text || !(label->height_mm > 0))
        return false;
    placed->angle = label->rotation + placement->rotation;
    ktg_vec2 spot = label->edge == KTG_NONE ? turned_place(page, placement, label) : label->at;
    placed->at = ktg_page_point(page, ktg_page_motion(placement), spot);
    ktg_text_set(page->cairo, KTG_FACE_PLAIN, label->height_mm);
    placed->width = ktg_text_width(page->cairo, placed->text);
    if (label->edge != KTG_NONE)
        return true;
    placed->angle += upside_down(placed->angle) ? KTG_PI : 0;
    if (page->sheet->kind != KTG_TILE)
        placed->at =
            within_printable(page, placed->at, placed->angle, placed->width, label->height_mm);
    return true;
}

/* Saves cairo's state and moves to the label, so that (0, 0) is its centre; false (and nothing to
 * restore) when it is empty. */
static bool begin_label(const ktg_page *page, const ktg_pattern_placement *placement,
                        const ktg_pattern_label *label, ktg_placed_label *placed) {
    cairo_save(page->cairo);
    if (!ktg_label_place(page, placement, label, placed)) {
        cairo_restore(page->cairo);
        return false;
    }
    cairo_translate(page->cairo, placed->at.x, placed->at.y);
    cairo_rotate(page->cairo, -placed->angle);
    return true;
}

/* The line from a number to its edge, in a colour of its own: neither cut nor fold. */
static void draw_leader(const ktg_page *page, const ktg_pattern_placement *placement,
                        const ktg_pattern_label *label) {
    ktg_motion2 motion = ktg_page_motion(placement);
    ktg_vec2 foot = ktg_page_point(page, motion, label->foot);
    ktg_vec2 at = ktg_page_point(page, motion, label->at);
    cairo_set_source_rgb(page->cairo, 0.5, 0.5, 0.5);
    cairo_set_line_width(page->cairo, LEADER_MM);
    cairo_set_dash(page->cairo, NULL, 0, 0);
    cairo_move_to(page->cairo, at.x, at.y);
    cairo_line_to(page->cairo, foot.x, foot.y);
    cairo_stroke(page->cairo);
    cairo_arc(page->cairo, foot.x, foot.y, 2.5 * LEADER_MM, 0, 2 * KTG_PI);
    cairo_fill(page->cairo);
}

/* What lies under a label: the ends of its middle line. */
static bool ground_of(const ktg_page *page, const ktg_placed_label *placed, double rgb[3]) {
    ktg_vec2 half = {cos(placed->angle) * placed->width / 2,
                     -sin(placed->angle) * placed->width / 2};
    return ktg_ground_of(page, ktg_sub2(placed->at, half), ktg_add2(placed->at, half), rgb);
}

/* White, or the colour that is there. */
static void set_ground(const ktg_page *page, const ktg_placed_label *placed) {
    double rgb[3];
    ground_of(page, placed, rgb);
    cairo_set_source_rgb(page->cairo, rgb[0], rgb[1], rgb[2]);
}

/* Grey, or white where the ground is dark. */
static void set_ink(const ktg_page *page, const ktg_placed_label *placed, double grey) {
    double rgb[3];
    if (ground_of(page, placed, rgb))
        grey = ktg_ground_is_dark(rgb) ? 1 : 0;
    cairo_set_source_rgb(page->cairo, grey, grey, grey);
}

/* Where there is a picture of the model in which pieces have colours. */
static bool has_tinted_names(const ktg_page *page) {
    const ktg_drawing *drawing = page->drawing;
    return drawing->pattern->mode == KTG_PAPER && drawing->pattern->piece_count > 1 &&
           drawing->piece_tints && !page->colours;
}

/* A name lies on the colour its piece has in pictures of the model. */
static void draw_name_ground(const ktg_page *page, uint32_t piece, const ktg_pattern_label *label,
                             double width) {
    uint32_t tint = page->drawing->piece_tints[piece];
    double aside = label->height_mm / 2, high = 1.9 * label->height_mm;
    cairo_set_source_rgb(page->cairo, (tint >> 16 & 255) / 255.0, (tint >> 8 & 255) / 255.0,
                         (tint & 255) / 255.0);
    cairo_rectangle(page->cairo, -width / 2 - aside, -high / 2, width + 2 * aside, high);
    cairo_fill(page->cairo);
}

/* A name may cross folds, and so may a number away from its edge: there they are interrupted. */
void ktg_draw_grounds(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    cairo_t *cairo = page->cairo;
    ktg_placed_label placed;
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        if (label->edge != KTG_NONE && !label->leader)
            continue;
        if (label->leader)
            draw_leader(page, placement, label);
        if (!begin_label(page, placement, label, &placed))
            continue;
        if (label->edge == KTG_NONE && has_tinted_names(page)) {
            draw_name_ground(page, placement->piece, label, placed.width);
        } else {
            set_ground(page, &placed);
            ktg_text_halo(cairo, -placed.width / 2, label->height_mm / 2, placed.text,
                          label->height_mm / 3);
        }
        cairo_restore(cairo);
    }
}

void ktg_draw_labels(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    ktg_placed_label placed;
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        double grey = label->edge == KTG_NONE ? 0.35 : 0.15;
        if (!begin_label(page, placement, label, &placed))
            continue;
        set_ink(page, &placed, grey);
        if (label->edge == KTG_NONE)
            ktg_text_draw(page->cairo, -placed.width / 2, label->height_mm / 2, placed.text);
        else
            ktg_number_draw(page->cairo, placed.angle, label->height_mm, placed.text);
        cairo_restore(page->cairo);
    }
}
