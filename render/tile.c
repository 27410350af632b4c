/* render/tile.c - the sheets of a poster: which one it is, and where its neighbours join.
 *
 * A sheet is trimmed along its left and upper line, where there is a neighbour, and laid over that
 * one's strip up to the dashed line: there the halves of the crosses meet. */
#include "render/draw.h"
#include "render/poster.h"
#include "render/text.h"

#include <stdio.h>

#define NAME_DIGIT_MM  14.0
#define SMALL_DIGIT_MM 2.0
#define CROSS_MM       2.5 /* half of one */
#define INSIDE_MM      2.2 /* from the join to the neighbour's name */

void ktg_tile_draw_ground(const ktg_page *page) {
    char name[KTG_NAME_SIZE];
    ktg_area area = ktg_page_printable(page);
    double digit = fmin(NAME_DIGIT_MM, fmin(area.x1 - area.x0, area.y1 - area.y0) / 6);
    ktg_tile_name(page->drawing, page->sheet, name);
    ktg_text_set(page->cairo, KTG_FACE_BOLD, digit);
    cairo_set_source_rgb(page->cairo, 0.9, 0.9, 0.9);
    ktg_text_draw(page->cairo, (area.x0 + area.x1 - ktg_text_width(page->cairo, name)) / 2,
                  (area.y0 + area.y1 + digit) / 2, name);
}

/* How far the neighbour's printable area is from this one's, along x and y of the page. */
static ktg_vec2 step_to(const ktg_page *page, const ktg_pattern_sheet *neighbour) {
    const ktg_pattern_placement *mine = page->sheet->placements, *theirs = neighbour->placements;
    ktg_area area = ktg_page_printable(page);
    double left = neighbour->printable[0], top = neighbour->height_mm - neighbour->printable[3];
    double up = page->sheet->height_mm - neighbour->height_mm;
    return (ktg_vec2){mine->x - theirs->x + left - area.x0,
                      up - (mine->y - theirs->y) + top - area.y0};
}

bool ktg_tile_join_find(const ktg_page *page, int side, ktg_tile_join *found) {
    static const int down[] = {0, -1, 0, 1}, right[] = {-1, 0, 1, 0};
    ktg_area area = ktg_page_printable(page);
    const ktg_pattern_sheet *neighbour =
        ktg_tile_neighbour(page->drawing, page->sheet, down[side], right[side]);
    if (!neighbour)
        return false;
    ktg_vec2 step = step_to(page, neighbour);
    double x = side == 2 ? area.x0 + step.x : area.x0;
    double y = side == 3 ? area.y0 + step.y : area.y0;
    bool upright = side % 2 == 0;
    *found = (ktg_tile_join){upright ? (ktg_vec2){x, area.y0} : (ktg_vec2){area.x0, y},
                             upright ? (ktg_vec2){x, area.y1} : (ktg_vec2){area.x1, y},
                             {right[side], down[side]},
                             side < 2,
                             neighbour};
    return true;
}

static void cross(cairo_t *cairo, ktg_vec2 at) {
    for (int k = -1; k <= 1; k += 2) {
        cairo_move_to(cairo, at.x - CROSS_MM, at.y - k * CROSS_MM);
        cairo_line_to(cairo, at.x + CROSS_MM, at.y + k * CROSS_MM);
    }
    cairo_stroke(cairo);
}

/* The neighbour's name with an arrow to it, in the middle of the join, on a white ground. */
static void name_neighbour(const ktg_page *page, const ktg_tile_join *j) {
    cairo_t *cairo = page->cairo;
    char name[KTG_NAME_SIZE];
    double arrow = 1.8, gap = 0.8, inwards = j->trim ? -INSIDE_MM : INSIDE_MM;
    ktg_tile_name(page->drawing, j->neighbour, name);
    ktg_text_set(cairo, KTG_FACE_PLAIN, SMALL_DIGIT_MM);
    double width = ktg_text_width(cairo, name);
    bool upright = j->out.x != 0;
    ktg_vec2 tip = ktg_madd2(ktg_mul2(ktg_add2(j->from, j->to), 0.5), inwards, j->out);
    if (!j->trim)
        tip = ktg_madd2(tip, upright ? width + arrow + gap : SMALL_DIGIT_MM + arrow + gap, j->out);
    ktg_vec2 foot = ktg_madd2(tip, -arrow, j->out);
    double x = upright ? foot.x - j->out.x * gap - (j->out.x > 0 ? width : 0) : foot.x - width / 2;
    double base = upright ? foot.y + SMALL_DIGIT_MM / 2
                          : foot.y - j->out.y * gap + (j->out.y > 0 ? 0 : SMALL_DIGIT_MM);
    ktg_text_ground(cairo, x, base, name, 1.2);
    cairo_set_source_rgb(cairo, 0.4, 0.4, 0.4);
    ktg_draw_arrow_head(cairo, tip, foot, arrow);
    ktg_text_draw(cairo, x, base, name);
}

static void draw_join(const ktg_page *page, const ktg_tile_join *j) {
    cairo_t *cairo = page->cairo;
    ktg_draw_stroke(page->drawing, cairo, j->trim ? KTG_STROKE_TRIM : KTG_STROKE_JOIN, j->from,
                    j->to);
    ktg_vec2 along = ktg_sub2(j->to, j->from);
    ktg_draw_set_stroke(page->drawing, cairo, KTG_STROKE_TRIM);
    cross(cairo, ktg_madd2(j->from, 0.25, along));
    cross(cairo, ktg_madd2(j->from, 0.75, along));
    name_neighbour(page, j);
}

/* Marks may reach into the margins as far as printers do. */
void ktg_tile_draw_joins(const ktg_page *page) {
    ktg_area area = ktg_page_printable(page);
    double edge = KTG_PAPER_EDGE_MM;
    double x0 = fmin(area.x0, edge), y0 = fmin(area.y0, edge);
    cairo_save(page->cairo);
    cairo_rectangle(page->cairo, x0, y0, fmax(area.x1, page->sheet->width_mm - edge) - x0,
                    fmax(area.y1, page->sheet->height_mm - edge) - y0);
    cairo_clip(page->cairo);
    for (int side = 0; side < 4; side++) {
        ktg_tile_join j;
        if (ktg_tile_join_find(page, side, &j))
            draw_join(page, &j);
    }
    cairo_restore(page->cairo);
}
