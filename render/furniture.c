/* render/furniture.c - title, legend and rulers in the strips between the printable area and the
 * paper's edge. They never take room from the pieces. */
#include "render/furniture.h"
#include "core/text.h"
#include "render/draw.h"
#include "render/more_pages.h"
#include "render/poster.h"
#include "render/text.h"

#include <stdio.h>
#include <string.h>

#define TITLE_DIGIT_MM  2.4
#define DETAIL_DIGIT_MM 2.0
/* Strip and text are 0.2 mm short of filling the margin. */
#define BASELINE_MM 1.0
#define SEPARATOR   "  \xc2\xb7  "

/* The extent of the finished model along x, y, z. */
static ktg_vec3 finished_size(const ktg_pattern *pattern) {
    ktg_vec3 low = {0, 0, 0}, high = {0, 0, 0};
    for (uint32_t v = 0; v < pattern->vertex_count; v++) {
        ktg_vec3 p = pattern->vertices[v];
        if (v == 0)
            low = high = p;
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    return ktg_sub3(high, low);
}

size_t ktg_furniture_details(const ktg_drawing *drawing, size_t sheet,
                             char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE]) {
    const ktg_pattern *pattern = drawing->pattern;
    size_t count = 0, sheets = pattern->sheet_count;
    char tile[KTG_NAME_SIZE];
    if (sheet != SIZE_MAX && ktg_is_tile(&pattern->sheets[sheet])) {
        ktg_tile_name(drawing, &pattern->sheets[sheet], tile);
        snprintf(details[count++], KTG_DETAIL_SIZE, "%.40s, sheet %zu of %zu", tile, sheet + 1,
                 sheets);
    } else if (sheet != SIZE_MAX)
        snprintf(details[count++], KTG_DETAIL_SIZE, "sheet %zu of %zu", sheet + 1, sheets);
    else
        snprintf(details[count++], KTG_DETAIL_SIZE, "%zu sheet%s", sheets, sheets == 1 ? "" : "s");
    if (pattern->mm_per_unit > 0)
        ktg_format(details[count++], KTG_DETAIL_SIZE, "%.4g mm per unit", pattern->mm_per_unit);
    if (pattern->vertex_count > 0) {
        ktg_vec3 size = finished_size(pattern);
        ktg_format(details[count++], KTG_DETAIL_SIZE,
                   "finished size %.4g \xc3\x97 %.4g \xc3\x97 %.4g mm", round(size.x),
                   round(size.y), round(size.z));
    }
    if (drawing->options.marker && sheet != SIZE_MAX)
        ktg_marker_tell(&pattern->sheets[sheet], details[count++]);
    snprintf(details[count++], KTG_DETAIL_SIZE, "print at 100 %%");
    return count;
}

/* The details in one line, no wider than `width`: what is known elsewhere gives way first, which
 * sheet it is last. */
static void join_details(const ktg_page *page, double width, char *text, size_t size) {
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE];
    size_t count = ktg_furniture_details(page->drawing, page->number, details);
    for (;;) {
        size_t used = 0;
        for (size_t i = 0; i < count && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? SEPARATOR : "",
                                     details[i]);
        if (count == 1 || ktg_text_width(page->cairo, text) <= width)
            break;
        if (--count > 1) /* "print at 100 %" stays with the sheet's number */
            memcpy(details[count - 1], details[count], KTG_DETAIL_SIZE);
    }
    ktg_text_shorten(page->cairo, width, text, size);
}

/* The title, and what is told beside it, which leaves the title some room. */
static void draw_title(const ktg_page *page, ktg_area printable) {
    cairo_t *cairo = page->cairo;
    double baseline = printable.y0 - BASELINE_MM, width = printable.x1 - printable.x0, gap = 4;
    char title[KTG_TITLE_SIZE], details[KTG_DETAIL_COUNT * (KTG_DETAIL_SIZE + 8)];
    memcpy(title, page->drawing->title, sizeof title);

    ktg_text_set(cairo, KTG_FACE_BOLD, TITLE_DIGIT_MM);
    double wanted = fmin(ktg_text_width(cairo, title), fmin(width / 3, 40));
    ktg_text_set(cairo, KTG_FACE_PLAIN, DETAIL_DIGIT_MM);
    cairo_set_source_rgb(cairo, 0.25, 0.25, 0.25);
    join_details(page, width - wanted - gap, details, sizeof details);
    double beside = ktg_text_width(cairo, details);
    ktg_text_draw(cairo, printable.x1 - beside, baseline, details);

    ktg_text_set(cairo, KTG_FACE_BOLD, TITLE_DIGIT_MM);
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    ktg_text_shorten(cairo, width - gap - beside, title, sizeof title);
    ktg_text_draw(cairo, printable.x0, baseline, title);
}

/* The bottom strip: a ruler from the left, the legend from the right, as much as there is room for.
 * False when the legend had none. */
static bool draw_bottom(const ktg_page *page, ktg_area printable) {
    static const struct {
        bool ruler, whole, brief;
    } choices[] = {{true, true, false}, {true, true, true},    {true, false, false},
                   {true, false, true}, {false, false, false}, {false, false, true}};
    cairo_t *cairo = page->cairo;
    double room = printable.x1 - printable.x0, gap = 4, y = printable.y1 + KTG_STRIP_MM / 2;
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        double ruler = choices[i].ruler ? ktg_ruler_length(choices[i].whole) + gap : 0;
        double legend = ktg_legend_width(page, choices[i].brief);
        if (ruler + legend > room)
            continue;
        if (choices[i].ruler)
            ktg_ruler_draw(cairo, printable.x0, y, choices[i].whole, false);
        ktg_legend_draw(page, printable.x1 - legend, y, legend, choices[i].brief, false);
        return true;
    }
    if (ktg_ruler_length(false) <= room)
        ktg_ruler_draw(cairo, printable.x0, y, ktg_ruler_length(true) <= room, false);
    return false;
}

static void draw_left(const ktg_page *page, ktg_area printable) {
    double room = printable.y1 - printable.y0, x = printable.x0 - KTG_STRIP_MM / 2;
    if (ktg_ruler_length(false) <= room)
        ktg_ruler_draw(page->cairo, x, printable.y1, ktg_ruler_length(true) <= room, true);
}

/* Title, rulers and legend in the strips; false where the legend had no room. */
static bool draw_strips(const ktg_page *page, ktg_area printable) {
    draw_title(page, printable);
    draw_left(page, printable);
    return draw_bottom(page, printable);
}

/* A picture of the model goes onto the last sheet, which has most room. */
static bool wants_solid(const ktg_page *page) {
    return page->number + 1 == page->drawing->pattern->sheet_count &&
           ktg_solid_is_wanted(page->drawing);
}

ktg_status ktg_furniture_draw(const ktg_page *page, bool *complete) {
    ktg_area printable = ktg_page_printable(page);
    double edge = KTG_PAPER_EDGE_MM, least = edge + KTG_STRIP_MM - 1e-6;
    ktg_area reach = {edge, edge, page->sheet->width_mm - edge, page->sheet->height_mm - edge};
    bool strips = printable.y0 >= least && printable.x0 >= least &&
                  page->sheet->height_mm - printable.y1 >= least;
    *complete = strips && draw_strips(page, printable);
    if (*complete && !wants_solid(page))
        return KTG_OK;
    ktg_pockets pockets;
    ktg_status status = ktg_pockets_find(page, strips ? printable : reach, &pockets);
    if (status == KTG_OK && !*complete)
        *complete = strips ? ktg_block_legend(page, &pockets) : ktg_block_draw(page, &pockets);
    if (status == KTG_OK && wants_solid(page))
        status = ktg_block_solid(page, &pockets);
    ktg_pockets_drop(&pockets);
    return status;
}
