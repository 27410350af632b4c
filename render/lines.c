/* render/lines.c - what a placed piece is drawn with: tabs, folds, lines, outline, labels. */
#include "render/draw.h"

/* The grey of cuts on dark grounds. */
#define LIGHT_CUT 0.75

typedef struct look {
    double width_mm;
    ktg_dashes dashes; /* before fitting */
    double grey;
} look;

static const look looks[KTG_STROKE_COUNT] = {
    [KTG_STROKE_CUT] = {KTG_CUT_MM, {0, 0, 0}, 0},
    [KTG_STROKE_MOUNTAIN] = {KTG_FOLD_MM, {2.2, 1.1, 0}, 0},
    [KTG_STROKE_VALLEY] = {KTG_FOLD_MM, {4.2, 0.9, 0.5}, 0},
    [KTG_STROKE_TAB] = {KTG_CUT_MM, {0, 0, 0}, 0},
    [KTG_STROKE_JOINT] = {KTG_FOLD_MM, {0, 0, 0}, 0},
    [KTG_STROKE_SEW] = {0.2, {3, 1.5, 0}, 0},
    [KTG_STROKE_GRAIN] = {0.2, {0, 0, 0}, 0.25},
    [KTG_STROKE_PLACE_FOLD] = {0.25, {8, 1.5, 1}, 0},
    [KTG_STROKE_DART] = {0.2, {1.6, 1.2, 0}, 0},
    [KTG_STROKE_NOTCH] = {KTG_CUT_MM, {0, 0, 0}, 0},
    [KTG_STROKE_INTERNAL] = {0.15, {0, 0, 0}, 0.45},
    [KTG_STROKE_TRIM] = {0.15, {0, 0, 0}, 0.55},
    [KTG_STROKE_JOIN] = {0.15, {1, 1, 0}, 0.55},
};

ktg_dashes ktg_stroke_dashes(const ktg_drawing *drawing, ktg_stroke stroke) {
    if (drawing->options.folds == KTG_FOLDS_SOLID) {
        if (stroke == KTG_STROKE_MOUNTAIN)
            return (ktg_dashes){0, 0, 0};
        if (stroke == KTG_STROKE_VALLEY)
            return looks[KTG_STROKE_MOUNTAIN].dashes;
    }
    return looks[stroke].dashes;
}

double ktg_stroke_width_mm(ktg_stroke stroke) {
    return looks[stroke].width_mm;
}

ktg_dashes ktg_dashes_fit(ktg_dashes wished, double length) {
    if (!(wished.dash > 0) || !(length > 0))
        return (ktg_dashes){0, 0, 0};
    double between = wished.dot > 0 ? 2 * wished.gap + wished.dot : wished.gap;
    double count = fmax(2, round((length + between) / (wished.dash + between)));
    double stretch = length / (count * wished.dash + (count - 1) * between);
    return (ktg_dashes){stretch * wished.dash, stretch * wished.gap, stretch * wished.dot};
}

static void set_dashes(cairo_t *cairo, ktg_dashes wished, double length) {
    ktg_dashes fitted = ktg_dashes_fit(wished, length);
    double lengths[] = {fitted.dash, fitted.gap, fitted.dot, fitted.gap};
    cairo_set_dash(cairo, lengths, fitted.dash <= 0 ? 0 : fitted.dot > 0 ? 4 : 2, 0);
}

void ktg_draw_set_stroke(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke) {
    double grey = looks[stroke].grey;
    bool colour = drawing->options.colour && !drawing->options.paint;
    if (colour && stroke == KTG_STROKE_MOUNTAIN)
        cairo_set_source_rgb(cairo, 0xb3 / 255.0, 0x26 / 255.0, 0x1e / 255.0);
    else if (colour && stroke == KTG_STROKE_VALLEY)
        cairo_set_source_rgb(cairo, 0x1f / 255.0, 0x5f / 255.0, 0xbf / 255.0);
    else
        cairo_set_source_rgb(cairo, grey, grey, grey);
    cairo_set_line_width(cairo, looks[stroke].width_mm);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cairo, NULL, 0, 0);
}

void ktg_draw_set_tint(cairo_t *cairo) {
    cairo_set_source_rgb(cairo, 0.925, 0.925, 0.925);
}

static void stroke_line(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke,
                        ktg_vec2 from, ktg_vec2 to) {
    set_dashes(cairo, ktg_stroke_dashes(drawing, stroke), ktg_length2(ktg_sub2(to, from)));
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
    cairo_stroke(cairo);
}

void ktg_draw_stroke(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke, ktg_vec2 from,
                     ktg_vec2 to) {
    ktg_draw_set_stroke(drawing, cairo, stroke);
    stroke_line(drawing, cairo, stroke, from, to);
}

static void polygon(const ktg_page *page, ktg_motion2 motion, const ktg_vec2 *points, size_t count,
                    bool closed) {
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 p = ktg_page_point(page, motion, points[i]);
        if (i == 0)
            cairo_move_to(page->cairo, p.x, p.y);
        else
            cairo_line_to(page->cairo, p.x, p.y);
    }
    if (closed)
        cairo_close_path(page->cairo);
}

/* A tab's polygon without the strip along its foot that has colours. */
static size_t beyond_strip(const ktg_pattern_tab *tab, double strip, ktg_vec2 *rest) {
    ktg_vec2 foot = tab->corners[0], end = tab->corners[tab->corner_count - 1];
    ktg_vec2 away = ktg_mul2(ktg_perp2(ktg_unit2(ktg_sub2(end, foot))), -1);
    size_t count = 0;
    for (uint32_t i = 0; i < tab->corner_count; i++) {
        ktg_vec2 a = tab->corners[i], b = tab->corners[(i + 1) % tab->corner_count];
        double from = ktg_dot2(ktg_sub2(a, foot), away) - strip,
               to = ktg_dot2(ktg_sub2(b, foot), away) - strip;
        if (from >= 0)
            rest[count++] = a;
        if ((from < 0) != (to < 0))
            rest[count++] = ktg_madd2(a, from / (from - to), ktg_sub2(b, a));
    }
    return count;
}

void ktg_draw_tabs(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    ktg_motion2 motion = ktg_page_motion(placement);
    ktg_draw_set_tint(page->cairo);
    for (size_t t = 0; t < piece->tab_count; t++) {
        const ktg_pattern_tab *tab = &piece->tabs[t];
        ktg_vec2 rest[2 * KTG_TAB_CORNERS];
        if (page->colours) {
            size_t count = beyond_strip(tab, page->drawing->options.bleed_mm, rest);
            polygon(page, motion, rest, count, count > 0);
        } else {
            polygon(page, motion, tab->corners, tab->corner_count, true);
        }
    }
    cairo_fill(page->cairo);
}

void ktg_draw_folds(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_drawing *drawing = page->drawing;
    ktg_motion2 motion = ktg_page_motion(placement);
    for (size_t i = drawing->first_fold[placement->piece];
         i < drawing->first_fold[placement->piece + 1]; i++) {
        const ktg_fold_segment *fold = &drawing->folds[i];
        ktg_vec2 from = ktg_page_point(page, motion, fold->from),
                 to = ktg_page_point(page, motion, fold->to);
        ktg_draw_set_stroke(drawing, page->cairo, fold->stroke);
        ktg_ground_set_fold_ink(page, from, to);
        stroke_line(drawing, page->cairo, fold->stroke, from, to);
    }
}

/* On dark grounds a black line would not be seen. */
static void lighten_outline(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    ktg_motion2 motion = ktg_page_motion(placement);
    double rgb[3];
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 from = ktg_page_point(page, motion, piece->outline[i]),
                 to = ktg_page_point(page, motion, piece->outline[(i + 1) % piece->outline_count]);
        if (!ktg_ground_of(page, from, to, rgb) || !ktg_ground_is_dark(rgb))
            continue;
        cairo_move_to(page->cairo, from.x, from.y);
        cairo_line_to(page->cairo, to.x, to.y);
    }
    cairo_set_source_rgb(page->cairo, LIGHT_CUT, LIGHT_CUT, LIGHT_CUT);
    cairo_stroke(page->cairo);
}

/* One stroke for the whole walk: where it runs along itself (the two sides of a slit that has not
 * opened) the line is no heavier than elsewhere. */
void ktg_draw_outline(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    polygon(page, ktg_page_motion(placement), piece->outline, piece->outline_count, true);
    ktg_draw_set_stroke(page->drawing, page->cairo, KTG_STROKE_CUT);
    cairo_stroke(page->cairo);
    if (page->colours)
        lighten_outline(page, placement);
}

ktg_stroke ktg_stroke_of_line(ktg_line_kind kind) {
    switch (kind) {
    case KTG_LINE_SEW:
        return KTG_STROKE_SEW;
    case KTG_LINE_GRAIN:
        return KTG_STROKE_GRAIN;
    case KTG_LINE_FOLD:
        return KTG_STROKE_PLACE_FOLD;
    case KTG_LINE_DART:
        return KTG_STROKE_DART;
    case KTG_LINE_NOTCH:
        return KTG_STROKE_NOTCH;
    default:
        return KTG_STROKE_INTERNAL;
    }
}

void ktg_draw_arrow_head(cairo_t *cairo, ktg_vec2 tip, ktg_vec2 from, double length) {
    ktg_vec2 back = ktg_unit2(ktg_sub2(from, tip)), side = ktg_perp2(back);
    ktg_vec2 foot = ktg_madd2(tip, length, back);
    ktg_vec2 left = ktg_madd2(foot, length / 3, side), right = ktg_madd2(foot, -length / 3, side);
    cairo_move_to(cairo, tip.x, tip.y);
    cairo_line_to(cairo, left.x, left.y);
    cairo_line_to(cairo, right.x, right.y);
    cairo_close_path(cairo);
    cairo_fill(cairo);
}

static void draw_line(const ktg_page *page, ktg_motion2 motion, const ktg_pattern_line *line) {
    ktg_stroke stroke = ktg_stroke_of_line(line->kind);
    double length = 0;
    for (size_t i = 1; i < line->point_count; i++)
        length += ktg_length2(ktg_sub2(line->points[i], line->points[i - 1]));
    ktg_draw_set_stroke(page->drawing, page->cairo, stroke);
    set_dashes(page->cairo, ktg_stroke_dashes(page->drawing, stroke), length);
    polygon(page, motion, line->points, line->point_count, false);
    cairo_stroke(page->cairo);
    if (line->kind == KTG_LINE_GRAIN && line->point_count > 1) {
        size_t last = line->point_count - 1;
        double head = fmin(4, length / 4);
        ktg_vec2 a = ktg_page_point(page, motion, line->points[0]),
                 b = ktg_page_point(page, motion, line->points[last]);
        ktg_draw_arrow_head(page->cairo, a, ktg_page_point(page, motion, line->points[1]), head);
        ktg_draw_arrow_head(page->cairo, b, ktg_page_point(page, motion, line->points[last - 1]),
                            head);
    }
}

void ktg_draw_lines(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[placement->piece];
    for (size_t i = 0; i < piece->line_count; i++)
        draw_line(page, ktg_page_motion(placement), &piece->lines[i]);
}
