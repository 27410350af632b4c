/* render/cover.c - the first page where there are posters: how to put them together, and maps. */
#include "render/draw.h"
#include "render/furniture.h"
#include "render/more_pages.h"
#include "render/poster.h"
#include "render/text.h"

#include <stdio.h>

#define MAPS_A_PAGE 6
#define GAP_MM      6.0
#define HEAD_MM     6.0 /* a map's heading */

/* What the test square takes. */
#define SQUARE_ROOM_MM 58.0

size_t ktg_cover_count(const ktg_drawing *drawing) {
    uint32_t posters = ktg_poster_count(drawing->pattern);
    return (posters + MAPS_A_PAGE - 1) / MAPS_A_PAGE;
}

static void write_head(ktg_column *at) {
    static const char *const steps[] = {
        "1.  Print all sheets at 100 % (actual size) and measure the rulers.",
        "2.  Trim each sheet along the grey line at its left and upper side, where there is one.",
        "3.  Lay it on its neighbour up to the dashed line, so that the halves of the crosses "
        "meet.",
        "4.  Glue or tape it there. First the sheets of each row (A, B, ...), then the rows.",
    };
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE];
    ktg_column_write(at, KTG_FACE_BOLD, 4.2, 0, at->drawing->title);
    ktg_column_skip(at, 1);
    size_t count = ktg_furniture_details(at->drawing, SIZE_MAX, details);
    for (size_t i = 0; i + 1 < count; i++) /* that it is printed at 100 % comes below */
        ktg_column_write(at, KTG_FACE_PLAIN, 2.4, 0, details[i]);
    ktg_column_skip(at, 4);
    ktg_column_write(at, KTG_FACE_BOLD, 2.8, 0, "Putting the sheets together");
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        ktg_column_write(at, KTG_FACE_PLAIN, 2.4, 0, steps[i]);
    ktg_column_skip(at, 4);
}

/* "Poster 2, body 1 of 3: 12 sheets". */
static void write_map_head(ktg_column *at, uint32_t poster) {
    const ktg_pattern *pattern = at->drawing->pattern;
    char name[KTG_NAME_SIZE] = "", text[2 * KTG_NAME_SIZE];
    size_t sheets = 0;
    for (size_t s = 0; s < pattern->sheet_count; s++)
        if (ktg_is_tile(&pattern->sheets[s]) && pattern->sheets[s].poster == poster) {
            ktg_drawing_piece_name(at->drawing, pattern->sheets[s].placements->piece, name);
            sheets++;
        }
    snprintf(text, sizeof text, "Poster %u, %s: %zu sheet%s", poster, name, sheets,
             sheets == 1 ? "" : "s");
    ktg_column_write(at, KTG_FACE_BOLD, 2.4, 0, text);
}

/* The scale at which each of the posters from `first` on fits a cell of the given size. */
static double scale_for(const ktg_drawing *drawing, uint32_t first, uint32_t count, double width,
                        double height) {
    double scale = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
        ktg_vec2 size = ktg_map_size(drawing, first + k);
        if (size.x > 0 && size.y > 0)
            scale = fmin(scale, fmin(width / size.x, height / size.y));
    }
    return isfinite(scale) && scale > 0 ? scale : 0;
}

/* The maps in as many columns as make them largest. */
static void draw_maps(const ktg_column *at, uint32_t first, uint32_t count) {
    double room = at->floor - at->y, head = HEAD_MM * at->scale, best = -1;
    double cell_width = at->width, cell_height = room;
    uint32_t columns = 1;
    for (uint32_t c = 1; c <= count; c++) {
        uint32_t rows = (count + c - 1) / c;
        double width = (at->width - (c - 1) * GAP_MM) / c;
        double height = (room - (rows - 1) * GAP_MM) / rows;
        double scale = scale_for(at->drawing, first, count, width, height - head);
        if (scale > best) {
            best = scale;
            columns = c;
            cell_width = width;
            cell_height = height;
        }
    }
    for (uint32_t k = 0; k < count; k++) {
        ktg_column cell = *at;
        cell.x += (k % columns) * (cell_width + GAP_MM);
        cell.y += (k / columns) * (cell_height + GAP_MM);
        cell.width = cell_width;
        write_map_head(&cell, first + k);
        ktg_map_draw(at->drawing, at->cairo, first + k, (ktg_vec2){cell.x, cell.y}, best);
    }
}

void ktg_cover_draw(const ktg_drawing *drawing, cairo_t *cairo, size_t number) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[0];
    ktg_column at = ktg_column_begin(drawing, cairo, sheet->width_mm, sheet->height_mm);
    uint32_t first = 1 + (uint32_t)number * MAPS_A_PAGE;
    uint32_t left = ktg_poster_count(drawing->pattern) + 1 - first;
    if (number == 0)
        write_head(&at);
    if (number == 0 && drawing->pattern->mode == KTG_CLOTH) {
        ktg_test_square_draw(cairo, at.x, at.y);
        at.y += SQUARE_ROOM_MM;
    }
    draw_maps(&at, first, left < MAPS_A_PAGE ? left : MAPS_A_PAGE);
}
