/* render/plot_marks.c - what stands around the pieces in a file for a machine, each kind in a layer
 * of its own: the sheet's name, a square to measure, marks to align by, the joins of a poster. */
#include "render/plot.h"

#include "core/memory.h"
#include "render/furniture.h"
#include "render/poster.h"
#include "render/text.h"

#include <stdio.h>

#define SQUARE_MM     50.0
#define DIGIT_MM      2.4
#define LEAST_MARGIN  3.0 /* for a line of text or a mark */
#define CIRCLE_PARTS  24
#define CROSS_MM      2.5
#define JOIN_DIGIT_MM 2.0

static double least_margin(const ktg_pattern_sheet *sheet) {
    const double *p = sheet->printable;
    return fmin(fmin(p[0], p[1]), fmin(sheet->width_mm - p[2], sheet->height_mm - p[3]));
}

/* "fox  ·  sheet 1 of 2  ·  12.5 mm per unit" above the printable area. */
static ktg_status add_name(ktg_plot *plot) {
    const ktg_pattern_sheet *sheet = plot->page.sheet;
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE], name[2 * KTG_TITLE_SIZE];
    if (least_margin(sheet) < LEAST_MARGIN)
        return KTG_OK;
    size_t count = ktg_furniture_details(plot->page.drawing, plot->page.number, details);
    size_t used = (size_t)snprintf(name, KTG_TITLE_SIZE, "%s", plot->page.drawing->title);
    for (size_t i = 0; i + 1 < count; i++) /* without "print at 100 %" */
        used += (size_t)snprintf(name + used, sizeof name - used, " \xc2\xb7 %s", details[i]);
    ktg_text_set(plot->page.cairo, KTG_FACE_PLAIN, DIGIT_MM);
    ktg_text_shorten(plot->page.cairo, sheet->printable[2] - sheet->printable[0], name,
                     sizeof name);
    return ktg_plot_write(plot, &(ktg_plot_text){KTG_LAYER_SHEET,
                                                 name,
                                                 {sheet->printable[0], sheet->printable[3] + 1},
                                                 true,
                                                 0,
                                                 DIGIT_MM});
}

/* ---- calibration ---------------------------------------------------------------------------- */

static ktg_status add_square(ktg_plot *plot, ktg_area area) {
    double top = plot->page.sheet->height_mm - area.y0, bottom = top - SQUARE_MM;
    double left = area.x0, right = left + SQUARE_MM;
    const ktg_vec2 corners[] = {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
    KTG_TRY(ktg_plot_add(plot, KTG_LAYER_CALIBRATION, KTG_STROKE_INTERNAL, corners, 4, true));
    return ktg_plot_write(plot, &(ktg_plot_text){KTG_LAYER_CALIBRATION,
                                                 (char[]){"50 mm"},
                                                 {(left + right) / 2, bottom + 4},
                                                 false,
                                                 0,
                                                 DIGIT_MM});
}

/* Two sides of the square in the lower right margin: no piece lies there. */
static ktg_status add_corner(ktg_plot *plot) {
    const ktg_pattern_sheet *sheet = plot->page.sheet;
    double in = least_margin(sheet) / 2, x = sheet->width_mm - in;
    const ktg_vec2 corners[] = {{x - SQUARE_MM, in}, {x, in}, {x, in + SQUARE_MM}};
    if (2 * in < LEAST_MARGIN || fmin(sheet->width_mm, sheet->height_mm) < SQUARE_MM + 4 * in)
        return KTG_OK;
    return ktg_plot_add(plot, KTG_LAYER_CALIBRATION, KTG_STROKE_INTERNAL, corners, 3, false);
}

static ktg_status add_calibration(ktg_plot *plot) {
    const ktg_page *page = &plot->page;
    ktg_pockets pockets;
    ktg_area area;
    KTG_TRY(ktg_pockets_find(page, ktg_page_printable(page), &pockets));
    bool free =
        page->sheet->kind != KTG_TILE && ktg_pockets_take(&pockets, SQUARE_MM, SQUARE_MM, &area);
    ktg_pockets_drop(&pockets);
    return free ? add_square(plot, area) : add_corner(plot);
}

/* ---- registration -----------------------------------------------------------------------------
 */

static ktg_status add_mark(ktg_plot *plot, ktg_vec2 at, double reach) {
    const ktg_vec2 across[] = {{at.x - reach, at.y}, {at.x + reach, at.y}},
                   up[] = {{at.x, at.y - reach}, {at.x, at.y + reach}};
    ktg_vec2 circle[CIRCLE_PARTS];
    for (int k = 0; k < CIRCLE_PARTS; k++) {
        double angle = 2 * KTG_PI * k / CIRCLE_PARTS;
        circle[k] = ktg_madd2(at, reach / 2, (ktg_vec2){cos(angle), sin(angle)});
    }
    ktg_layer layer = KTG_LAYER_REGISTRATION;
    KTG_TRY(ktg_plot_add(plot, layer, KTG_STROKE_INTERNAL, across, 2, false));
    KTG_TRY(ktg_plot_add(plot, layer, KTG_STROKE_INTERNAL, up, 2, false));
    return ktg_plot_add(plot, layer, KTG_STROKE_INTERNAL, circle, CIRCLE_PARTS, true);
}

static ktg_status add_registration(ktg_plot *plot) {
    ktg_vec2 marks[KTG_REGISTRATION_MARKS];
    double reach;
    if (!plot->page.drawing->options.registration)
        return KTG_OK;
    if (!ktg_registration_find(plot->page.sheet, marks, &reach)) {
        ktg_log(plot->page.drawing->context, KTG_LOG_WARNING,
                "the margins are too narrow for registration marks: 5 mm will do");
        return KTG_OK;
    }
    for (int k = 0; k < KTG_REGISTRATION_MARKS; k++)
        KTG_TRY(add_mark(plot, marks[k], reach));
    return KTG_OK;
}

/* ---- the joins of a poster ------------------------------------------------------------------ */

static ktg_status add_cross(ktg_plot *plot, ktg_vec2 at) {
    for (int k = -1; k <= 1; k += 2) {
        const ktg_vec2 way[] = {{at.x - CROSS_MM, at.y - k * CROSS_MM},
                                {at.x + CROSS_MM, at.y + k * CROSS_MM}};
        KTG_TRY(ktg_plot_add(plot, KTG_LAYER_POSTER, KTG_STROKE_TRIM, way, 2, false));
    }
    return KTG_OK;
}

/* The line, crosses whose halves meet the neighbour's, and what that is called. */
static ktg_status add_join(ktg_plot *plot, const ktg_tile_join *join) {
    double height = plot->page.sheet->height_mm;
    ktg_vec2 way[] = {{join->from.x, height - join->from.y}, {join->to.x, height - join->to.y}};
    ktg_vec2 along = ktg_sub2(way[1], way[0]), out = {join->out.x, -join->out.y};
    char name[KTG_NAME_SIZE];
    KTG_TRY(ktg_plot_add(plot, KTG_LAYER_POSTER, join->trim ? KTG_STROKE_TRIM : KTG_STROKE_JOIN,
                         way, 2, false));
    KTG_TRY(add_cross(plot, ktg_madd2(way[0], 0.25, along)));
    KTG_TRY(add_cross(plot, ktg_madd2(way[0], 0.75, along)));
    ktg_tile_name(plot->page.drawing, join->neighbour, name);
    ktg_vec2 at = ktg_madd2(ktg_madd2(way[0], 0.5, along), 4, out);
    return ktg_plot_write(plot,
                          &(ktg_plot_text){KTG_LAYER_POSTER, name, at, false, 0, JOIN_DIGIT_MM});
}

static ktg_status add_joins(ktg_plot *plot) {
    ktg_tile_join join;
    for (int side = 0; side < 4 && ktg_is_tile(plot->page.sheet); side++)
        if (ktg_tile_join_find(&plot->page, side, &join))
            KTG_TRY(add_join(plot, &join));
    return KTG_OK;
}

/* The edges of the fabric. */
static ktg_status add_fabric(ktg_plot *plot) {
    double width = plot->page.sheet->width_mm, height = plot->page.sheet->height_mm;
    const ktg_vec2 corners[] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    if (!ktg_is_marker(&plot->page))
        return KTG_OK;
    return ktg_plot_add(plot, KTG_LAYER_SHEET, KTG_STROKE_INTERNAL, corners, 4, true);
}

ktg_status ktg_plot_marks(ktg_plot *plot) {
    KTG_TRY(add_name(plot));
    KTG_TRY(add_fabric(plot));
    KTG_TRY(add_calibration(plot));
    KTG_TRY(add_registration(plot));
    return add_joins(plot);
}
