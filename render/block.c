/* render/block.c - the furniture in free pockets between the pieces, for margins too narrow for
 * strips: all of it as one block where there is room, else part by part. */
#include "render/draw.h"
#include "render/furniture.h"
#include "render/more_pages.h"
#include "render/text.h"

#include "core/memory.h"

#include <string.h>

#define TITLE_DIGIT_MM  2.4
#define DETAIL_DIGIT_MM 1.75
#define LINE_MM         3.6
#define SOLID_GAP_MM    2.0

/* A part is drawn from its upper left corner, or with `dry` only measured; returns its height. */
typedef double part(const ktg_page *page, double x, double y, double width, bool dry);

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

static double caption(const ktg_page *page, double x, double y, double width, bool dry) {
    cairo_t *cairo = page->cairo;
    char title[KTG_TITLE_SIZE];
    memcpy(title, page->drawing->title, sizeof title);
    ktg_text_set(cairo, KTG_FACE_BOLD, TITLE_DIGIT_MM);
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    ktg_text_shorten(cairo, width, title, sizeof title);
    if (!dry)
        ktg_text_draw(cairo, x, y + TITLE_DIGIT_MM, title);
    double height = TITLE_DIGIT_MM + 1.6;
    return height +
           LINE_MM * (double)draw_details(page, x, y + height + DETAIL_DIGIT_MM, width, dry);
}

/* Only what tells the sheets apart. */
static double brief_caption(const ktg_page *page, double x, double y, double width, bool dry) {
    char title[KTG_TITLE_SIZE], details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE];
    memcpy(title, page->drawing->title, sizeof title);
    (void)ktg_furniture_details(page->drawing, page->number, details);
    ktg_text_set(page->cairo, KTG_FACE_BOLD, DETAIL_DIGIT_MM);
    cairo_set_source_rgb(page->cairo, 0.1, 0.1, 0.1);
    ktg_text_shorten(page->cairo, width, title, sizeof title);
    if (!dry)
        ktg_text_draw(page->cairo, x, y + DETAIL_DIGIT_MM, title);
    ktg_text_set(page->cairo, KTG_FACE_PLAIN, DETAIL_DIGIT_MM);
    ktg_text_shorten(page->cairo, width, details[0], sizeof details[0]);
    if (!dry)
        ktg_text_draw(page->cairo, x, y + LINE_MM + DETAIL_DIGIT_MM, details[0]);
    return 2 * LINE_MM;
}

static double legend(const ktg_page *page, double x, double y, double width, bool dry) {
    return KTG_LEGEND_LINE_MM * (double)ktg_legend_draw(page, x, y + 1.2, width, false, dry);
}

static double ruler(const ktg_page *page, double x, double y, double width, bool dry) {
    if (!dry)
        ktg_ruler_draw(page->cairo, x, y + KTG_STRIP_MM / 2, width >= ktg_ruler_length(true),
                       false);
    return KTG_STRIP_MM;
}

static double whole(const ktg_page *page, double x, double y, double width, bool dry) {
    double height = caption(page, x, y, width, dry);
    height += legend(page, x, y + height, width, dry);
    return height + ruler(page, x, y + height, width, dry);
}

/* Draws a part in a pocket, at the first of the widths at which there is one. */
static bool place(const ktg_page *page, ktg_pockets *pockets, part *draw, const double *widths,
                  size_t count) {
    for (size_t i = 0; i < count; i++) {
        ktg_area area;
        double height = draw(page, 0, 0, widths[i], true);
        if (!ktg_pockets_take(pockets, widths[i], height, &area))
            continue;
        draw(page, area.x0, area.y0, widths[i], false);
        return true;
    }
    return false;
}

/* The upright ruler in a pocket of its own. */
static void place_upright(const ktg_page *page, ktg_pockets *pockets) {
    for (int long_one = 1; long_one >= 0; long_one--) {
        ktg_area area;
        if (!ktg_pockets_take(pockets, KTG_STRIP_MM, ktg_ruler_length(long_one), &area))
            continue;
        ktg_ruler_draw(page->cairo, area.x0 + KTG_STRIP_MM / 2, area.y1, long_one, true);
        return;
    }
}

bool ktg_block_draw(const ktg_page *page, ktg_pockets *pockets) {
    const double lengths[] = {ktg_ruler_length(true), ktg_ruler_length(false)};
    const double wide[] = {lengths[0], 150, 75, lengths[1]}, narrow[] = {150, 101.6, 75, 50.8, 36};
    if (place(page, pockets, whole, wide, sizeof wide / sizeof *wide)) {
        place_upright(page, pockets);
        return true;
    }
    bool named = place(page, pockets, caption, narrow, 5);
    if (!named)
        (void)place(page, pockets, brief_caption, narrow + 2, 3);
    bool told = place(page, pockets, legend, narrow, 5);
    bool measured = place(page, pockets, ruler, lengths, 2);
    place_upright(page, pockets);
    return named && told && measured;
}

bool ktg_block_legend(const ktg_page *page, ktg_pockets *pockets) {
    const double narrow[] = {150, 101.6, 75, 50.8, 36, 25};
    return place(page, pockets, legend, narrow, sizeof narrow / sizeof *narrow);
}

/* Two views side by side or above each other, or one; large, or small. */
ktg_status ktg_block_solid(const ktg_page *page, ktg_pockets *pockets) {
    static const struct {
        int across, down;
        double size;
    } choices[] = {{2, 1, 88}, {1, 2, 88}, {2, 1, 60}, {1, 2, 60}, {1, 1, 88}, {1, 1, 60},
                   {2, 1, 45}, {1, 2, 45}, {1, 1, 45}, {2, 1, 35}, {1, 2, 35}, {1, 1, 35}};
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        int across = choices[i].across, down = choices[i].down;
        double size = choices[i].size, side = size - 2 * SOLID_GAP_MM;
        ktg_area area;
        if (!ktg_pockets_take(pockets, across * size, down * size, &area))
            continue;
        for (int k = 0; k < across * down; k++) {
            double x = area.x0 + (across > 1 ? k * size : 0) + SOLID_GAP_MM;
            double y = area.y0 + (down > 1 ? k * size : 0) + SOLID_GAP_MM;
            KTG_TRY(ktg_solid_draw(page->drawing, page->cairo, (ktg_area){x, y, x + side, y + side},
                                   k > 0));
        }
        return KTG_OK;
    }
    return KTG_OK;
}
