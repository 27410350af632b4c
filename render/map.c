/* render/map.c - a poster in small: its tiles with their names, and what is drawn on them. */
#include "render/draw.h"
#include "render/poster.h"
#include "render/text.h"

#include <stdio.h>

#define LEAST_DIGIT_MM 1.2

static const ktg_pattern_sheet *first_tile(const ktg_drawing *drawing, uint32_t poster) {
    for (size_t s = 0; s < drawing->pattern->sheet_count; s++)
        if (ktg_is_tile(&drawing->pattern->sheets[s]) &&
            drawing->pattern->sheets[s].poster == poster)
            return &drawing->pattern->sheets[s];
    return NULL;
}

/* The tile's printable area on the poster: y down, in the frame of the poster's first sheet. */
static ktg_area area_of(const ktg_pattern_sheet *first, const ktg_pattern_sheet *tile) {
    double dx = first->placements->x - tile->placements->x;
    double dy = first->placements->y - tile->placements->y;
    const double *r = tile->printable;
    return (ktg_area){r[0] + dx, -r[3] - dy, r[2] + dx, -r[1] - dy};
}

static ktg_area whole_area(const ktg_drawing *drawing, const ktg_pattern_sheet *first) {
    ktg_area all = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t s = 0; s < drawing->pattern->sheet_count; s++) {
        const ktg_pattern_sheet *tile = &drawing->pattern->sheets[s];
        if (!ktg_is_tile(tile) || tile->poster != first->poster)
            continue;
        ktg_area a = area_of(first, tile);
        all = (ktg_area){fmin(all.x0, a.x0), fmin(all.y0, a.y0), fmax(all.x1, a.x1),
                         fmax(all.y1, a.y1)};
    }
    return all;
}

ktg_vec2 ktg_map_size(const ktg_drawing *drawing, uint32_t poster) {
    const ktg_pattern_sheet *first = first_tile(drawing, poster);
    if (!first)
        return (ktg_vec2){0, 0};
    ktg_area all = whole_area(drawing, first);
    return (ktg_vec2){all.x1 - all.x0, all.y1 - all.y0};
}

/* From the poster to the page. */
typedef struct frame {
    ktg_area all;
    ktg_vec2 corner;
    double scale;
} frame;

static ktg_vec2 to_page(const frame *f, double x, double y) {
    return (ktg_vec2){f->corner.x + f->scale * (x - f->all.x0),
                      f->corner.y + f->scale * (y - f->all.y0)};
}

static void draw_piece(const ktg_drawing *drawing, cairo_t *cairo, const frame *f,
                       const ktg_pattern_placement *at) {
    const ktg_pattern_piece *piece = &drawing->pattern->pieces[at->piece];
    ktg_motion2 motion = ktg_page_motion(at);
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 p = ktg_move2(motion, piece->outline[i]);
        p = to_page(f, p.x, -p.y);
        cairo_line_to(cairo, p.x, p.y);
    }
    cairo_close_path(cairo);
    cairo_set_source_rgb(cairo, 0.93, 0.93, 0.93);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgb(cairo, 0.2, 0.2, 0.2);
    cairo_set_line_width(cairo, 0.15);
    cairo_stroke(cairo);
}

static void write_centred(cairo_t *cairo, double x, double baseline, const char *text) {
    ktg_text_draw(cairo, x - ktg_text_width(cairo, text) / 2, baseline, text);
}

/* A tile ends where its right and lower neighbours begin. */
static void draw_tile(const ktg_drawing *drawing, cairo_t *cairo, const frame *f,
                      const ktg_pattern_sheet *first, size_t number) {
    const ktg_pattern_sheet *tile = &drawing->pattern->sheets[number];
    const ktg_pattern_sheet *right = ktg_tile_neighbour(drawing, tile, 0, 1);
    const ktg_pattern_sheet *below = ktg_tile_neighbour(drawing, tile, 1, 0);
    ktg_area area = area_of(first, tile);
    char name[KTG_NAME_SIZE], sheet[32];
    if (right)
        area.x1 = area_of(first, right).x0;
    if (below)
        area.y1 = area_of(first, below).y0;
    ktg_vec2 a = to_page(f, area.x0, area.y0), b = to_page(f, area.x1, area.y1);
    cairo_set_source_rgb(cairo, 0.45, 0.45, 0.45);
    cairo_set_line_width(cairo, 0.15);
    cairo_rectangle(cairo, a.x, a.y, b.x - a.x, b.y - a.y);
    cairo_stroke(cairo);
    double digit = fmin(4, fmin((b.x - a.x) / 4.5, (b.y - a.y) / 4)), x = (a.x + b.x) / 2,
           y = (a.y + b.y) / 2;
    if (digit < LEAST_DIGIT_MM)
        return;
    ktg_tile_name(drawing, tile, name);
    snprintf(sheet, sizeof sheet, "sheet %zu", number + 1);
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    ktg_text_set(cairo, KTG_FACE_BOLD, digit);
    write_centred(cairo, x, y, name);
    ktg_text_set(cairo, KTG_FACE_PLAIN, digit / 2);
    write_centred(cairo, x, y + digit, sheet);
}

void ktg_map_draw(const ktg_drawing *drawing, cairo_t *cairo, uint32_t poster, ktg_vec2 corner,
                  double scale) {
    const ktg_pattern_sheet *first = first_tile(drawing, poster);
    if (!first)
        return;
    frame f = {whole_area(drawing, first), corner, scale};
    draw_piece(drawing, cairo, &f, first->placements);
    for (size_t s = 0; s < drawing->pattern->sheet_count; s++)
        if (ktg_is_tile(&drawing->pattern->sheets[s]) &&
            drawing->pattern->sheets[s].poster == poster)
            draw_tile(drawing, cairo, &f, first, s);
}
