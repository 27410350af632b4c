/* render/block.c - the furniture as one block in a free corner, for margins too narrow for strips.
 */
#include "render/draw.h"

#include <string.h>

#define TITLE_DIGIT_MM  2.4
#define DETAIL_DIGIT_MM 1.75
#define LINE_MM         3.6
#define CLEARANCE_MM    2.0

/* Cuts the segment a-b to the area (Liang & Barsky 1984); true when something is left. */
static bool segment_meets(ktg_vec2 a, ktg_vec2 b, ktg_area area) {
    double enter = 0, leave = 1, from[] = {a.x, a.y}, along[] = {b.x - a.x, b.y - a.y};
    double low[] = {area.x0, area.y0}, high[] = {area.x1, area.y1};
    for (int k = 0; k < 2; k++) {
        if (along[k] == 0) {
            if (from[k] < low[k] || from[k] > high[k])
                return false;
            continue;
        }
        double t0 = (low[k] - from[k]) / along[k], t1 = (high[k] - from[k]) / along[k];
        enter = fmax(enter, fmin(t0, t1));
        leave = fmin(leave, fmax(t0, t1));
    }
    return enter <= leave;
}

/* True when the placed outline crosses the area or goes around it. */
static bool outline_meets(const ktg_page *page, const ktg_pattern_placement *placement,
                          ktg_area area) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    ktg_motion2 motion = ktg_page_motion(placement);
    ktg_vec2 centre = {(area.x0 + area.x1) / 2, (area.y0 + area.y1) / 2};
    ktg_vec2 a = ktg_page_point(page, motion, piece->outline[piece->outline_count - 1]);
    bool inside = false;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 b = ktg_page_point(page, motion, piece->outline[i]);
        if (segment_meets(a, b, area))
            return true;
        if ((a.y > centre.y) != (b.y > centre.y) &&
            centre.x < a.x + (b.x - a.x) * (centre.y - a.y) / (b.y - a.y))
            inside = !inside;
        a = b;
    }
    return inside;
}

bool ktg_page_is_free(const ktg_page *page, ktg_area area, double clearance) {
    ktg_area wide = {area.x0 - clearance, area.y0 - clearance, area.x1 + clearance,
                     area.y1 + clearance};
    for (size_t i = 0; i < page->sheet->placement_count; i++)
        if (outline_meets(page, &page->sheet->placements[i], wide))
            return false;
    return true;
}

/* The details one after the other, wrapped like words; returns the number of lines. */
static size_t draw_details(const ktg_page *page, double x, double baseline, double width,
                           bool dry) {
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE];
    size_t count = ktg_furniture_details(page->drawing, page->number, details), lines = 1;
    double at = 0, gap = 4;
    ktg_text_set(page->cairo, KTG_FACE_PLAIN, DETAIL_DIGIT_MM);
    cairo_set_source_rgb(page->cairo, 0.25, 0.25, 0.25);
    for (size_t i = 0; i < count; i++) {
        double entry = ktg_text_width(page->cairo, details[i]);
        if (at > 0 && at + entry > width) {
            at = 0;
            lines++;
        }
        if (!dry)
            ktg_text_draw(page->cairo, x + at, baseline + (double)(lines - 1) * LINE_MM,
                          details[i]);
        at += entry + gap;
    }
    return lines;
}

/* Draws the block from its upper left corner; returns its height. */
static double draw_block(const ktg_page *page, double x, double y, bool whole, bool dry) {
    cairo_t *cairo = page->cairo;
    double width = ktg_ruler_length(whole), start = y;
    if (!dry) {
        char title[KTG_TITLE_SIZE];
        memcpy(title, page->drawing->title, sizeof title);
        ktg_text_set(cairo, KTG_FACE_BOLD, TITLE_DIGIT_MM);
        cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
        ktg_text_shorten(cairo, width, title, sizeof title);
        ktg_text_draw(cairo, x, y + TITLE_DIGIT_MM, title);
    }
    y += TITLE_DIGIT_MM + 1.6;
    y += (double)draw_details(page, x, y + DETAIL_DIGIT_MM, width, dry) * LINE_MM;
    y += (double)ktg_legend_draw(page->drawing, cairo, x, y + 1.2, width, false, dry) *
         KTG_LEGEND_LINE_MM;
    if (!dry)
        ktg_ruler_draw(cairo, x, y + KTG_STRIP_MM / 2, whole, false);
    return y + KTG_STRIP_MM - start;
}

/* Where the furniture may be: a printer's reach, and a little inside what the pieces fill. */
static ktg_area reach(const ktg_page *page) {
    double edge = KTG_PAPER_EDGE_MM;
    return (ktg_area){edge, edge, page->sheet->width_mm - edge, page->sheet->height_mm - edge};
}

/* Puts an area of the given size into the corner `corner` (0 lower left, 1 lower right, 2 upper
 * left, 3 upper right); false when it does not fit the page or is not free. */
static bool in_corner(const ktg_page *page, int corner, double width, double height,
                      ktg_area *area) {
    ktg_area all = reach(page);
    double x = corner & 1 ? all.x1 - width : all.x0, y = corner & 2 ? all.y0 : all.y1 - height;
    *area = (ktg_area){x, y, x + width, y + height};
    return x >= all.x0 && y >= all.y0 && x + width <= all.x1 && y + height <= all.y1 &&
           ktg_page_is_free(page, *area, CLEARANCE_MM);
}

static bool meet(ktg_area a, ktg_area b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/* The upright ruler wherever an edge of the page is free, away from the block. */
static void draw_upright(const ktg_page *page, ktg_area block) {
    for (int whole = 1; whole >= 0; whole--)
        for (int corner = 0; corner < 4; corner++) {
            ktg_area area;
            if (!in_corner(page, corner, KTG_STRIP_MM, ktg_ruler_length(whole), &area) ||
                meet(area, block))
                continue;
            ktg_ruler_draw(page->cairo, area.x0 + KTG_STRIP_MM / 2, area.y1, whole, true);
            return;
        }
}

bool ktg_block_draw(const ktg_page *page) {
    for (int whole = 1; whole >= 0; whole--)
        for (int corner = 0; corner < 4; corner++) {
            ktg_area area;
            double height = draw_block(page, 0, 0, whole, true);
            if (!in_corner(page, corner, ktg_ruler_length(whole), height, &area))
                continue;
            draw_block(page, area.x0, area.y0, whole, false);
            draw_upright(page, area);
            return true;
        }
    return false;
}
