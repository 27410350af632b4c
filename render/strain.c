/* render/strain.c - a page that shows how much each place of the cloth is strained, as a map of
 * colours with a scale, and a square by which the printer's scale is checked. */
#include "core/memory.h"
#include "core/text.h"
#include "render/draw.h"
#include "render/more_pages.h"
#include "render/text.h"

#include <stdio.h>
#include <string.h>

#define LEVELS    24 /* of colour; the last one is for all that is above twice the limit */
#define GAP_MM    6.0
#define WORDS_MM  9.0 /* below each piece */
#define SCALE_MM  5.0 /* the height of the scale of colours */
#define SQUARE_MM 50.0
#define INCH_MM   25.4

/* ---- colours ------------------------------------------------------------------------------ */

typedef struct colour {
    double red, green, blue;
} colour;

/* From nearly white over yellow at the limit to dark red at twice the limit; grey without colour.
 */
static colour colour_of(const ktg_drawing *drawing, double level) {
    static const colour stops[] = {{0.93, 0.97, 0.93},
                                   {0.75, 0.90, 0.55},
                                   {0.98, 0.85, 0.25},
                                   {0.92, 0.45, 0.12},
                                   {0.60, 0.05, 0.10}};
    if (!drawing->options.colour)
        return (colour){0.97 - 0.8 * level, 0.97 - 0.8 * level, 0.97 - 0.8 * level};
    double at = level * 4;
    int k = at >= 3 ? 3 : (int)at;
    double t = fmin(at - k, 1);
    const colour *a = &stops[k], *b = a + 1;
    return (colour){a->red + t * (b->red - a->red), a->green + t * (b->green - a->green),
                    a->blue + t * (b->blue - a->blue)};
}

static int level_of(const ktg_drawing *drawing, double strain) {
    double limit = drawing->options.strain_limit;
    double part = limit > 0 ? strain / (2 * limit) : strain > 0;
    return part >= 1 ? LEVELS - 1 : (int)(part * (LEVELS - 1));
}

static void set_level(const ktg_drawing *drawing, cairo_t *cairo, int level) {
    colour c = colour_of(drawing, (double)level / (LEVELS - 1));
    cairo_set_source_rgb(cairo, c.red, c.green, c.blue);
}

/* ---- pieces ------------------------------------------------------------------------------- */

/* Where a piece comes to lie: y down, so many millimetres of the page for one of the piece. */
typedef struct spot {
    ktg_vec2 low, size; /* of the piece */
    ktg_vec2 at;        /* its upper left corner on the page */
    double scale;
} spot;

static void measure(const ktg_pattern_piece *piece, spot *s) {
    ktg_vec2 high = {-INFINITY, -INFINITY};
    s->low = (ktg_vec2){INFINITY, INFINITY};
    for (size_t v = 0; v < piece->vertex_count; v++) {
        ktg_vec2 p = piece->vertices[v];
        s->low = (ktg_vec2){fmin(s->low.x, p.x), fmin(s->low.y, p.y)};
        high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    s->size = ktg_sub2(high, s->low);
}

static ktg_vec2 on_page(const spot *s, ktg_vec2 p) {
    return (ktg_vec2){s->at.x + s->scale * (p.x - s->low.x),
                      s->at.y + s->scale * (s->low.y + s->size.y - p.y)};
}

/* Faces of one level as one shape; a thin stroke closes the seams between neighbours. */
static void draw_level(const ktg_drawing *drawing, cairo_t *cairo, const ktg_pattern_piece *piece,
                       const spot *s, int level) {
    bool any = false;
    for (size_t f = 0; f < piece->face_count; f++) {
        if (level_of(drawing, drawing->pattern->face_strain[piece->faces[f]]) != level)
            continue;
        for (size_t k = 0; k < 3; k++) {
            ktg_vec2 p = on_page(s, piece->vertices[piece->corners[3 * f + k]]);
            if (k == 0)
                cairo_move_to(cairo, p.x, p.y);
            else
                cairo_line_to(cairo, p.x, p.y);
        }
        cairo_close_path(cairo);
        any = true;
    }
    if (!any)
        return;
    set_level(drawing, cairo, level);
    cairo_set_line_width(cairo, 0.05);
    cairo_fill_preserve(cairo);
    cairo_stroke(cairo);
}

/* Mean and largest strain of a piece, by area. */
static void describe(const ktg_pattern *pattern, const ktg_pattern_piece *piece, char *text,
                     size_t size) {
    double sum = 0, area = 0, most = 0;
    for (size_t f = 0; f < piece->face_count; f++) {
        const uint32_t *c = piece->corners + 3 * f;
        ktg_vec2 a = piece->vertices[c[0]];
        double twice =
            ktg_cross2(ktg_sub2(piece->vertices[c[1]], a), ktg_sub2(piece->vertices[c[2]], a));
        double strain = pattern->face_strain[piece->faces[f]];
        sum += twice * strain;
        area += twice;
        most = fmax(most, strain);
    }
    ktg_format(text, size, "mean %.1f %%, most %.1f %%", area > 0 ? 100 * sum / area : 0,
               100 * most);
}

static void draw_piece(const ktg_drawing *drawing, cairo_t *cairo, uint32_t number, const spot *s) {
    const ktg_pattern_piece *piece = &drawing->pattern->pieces[number];
    char text[KTG_NAME_SIZE], name[KTG_NAME_SIZE];
    for (int level = 0; level < LEVELS; level++)
        draw_level(drawing, cairo, piece, s, level);
    double y = s->at.y + s->scale * s->size.y + 3, width = fmax(s->scale * s->size.x, 24);
    ktg_drawing_piece_name(drawing, number, name);
    cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
    ktg_text_set(cairo, KTG_FACE_BOLD, 2);
    ktg_text_shorten(cairo, width, name, sizeof name);
    ktg_text_draw(cairo, s->at.x, y, name);
    describe(drawing->pattern, piece, text, sizeof text);
    ktg_text_set(cairo, KTG_FACE_PLAIN, 1.7);
    ktg_text_draw(cairo, s->at.x, y + 3, text);
}

/* ---- laying out --------------------------------------------------------------------------- */

/* Boxes of all pieces at that scale in rows; true when they fit the room. */
static bool fits(const ktg_drawing *drawing, const spot *spots, double scale, ktg_vec2 room,
                 ktg_row_box *boxes) {
    size_t count = drawing->pattern->piece_count;
    uint32_t sheets = 0;
    for (size_t p = 0; p < count; p++) {
        boxes[p].width = fmax(scale * spots[p].size.x, 34); /* the words below it */
        boxes[p].height = scale * spots[p].size.y + WORDS_MM;
        if (boxes[p].width > room.x || boxes[p].height > room.y)
            return false;
    }
    return ktg_rows_pack(drawing->context, room.x, room.y, GAP_MM, boxes, count, &sheets) ==
               KTG_OK &&
           sheets == 1;
}

/* The largest scale, of some tries, at which all fit; 0 where none does. */
static double best_scale(const ktg_drawing *drawing, const spot *spots, ktg_vec2 room,
                         ktg_row_box *boxes) {
    double low = 0, high = 1;
    if (fits(drawing, spots, high, room, boxes))
        return high;
    for (int k = 0; k < 24; k++) {
        double middle = (low + high) / 2;
        if (fits(drawing, spots, middle, room, boxes))
            low = middle;
        else
            high = middle;
    }
    return low > 0 && fits(drawing, spots, low, room, boxes) ? low : 0;
}

static ktg_status draw_pieces(const ktg_column *at) {
    const ktg_drawing *drawing = at->drawing;
    size_t count = drawing->pattern->piece_count;
    ktg_vec2 room = {at->width, at->floor - at->y - SQUARE_MM - 8};
    spot *spots = ktg_new(drawing->context, count, spot);
    ktg_row_box *boxes = ktg_new(drawing->context, count, ktg_row_box);
    ktg_status status = spots && boxes ? KTG_OK : KTG_MEMORY;
    for (size_t p = 0; status == KTG_OK && p < count; p++)
        measure(&drawing->pattern->pieces[p], &spots[p]);
    double scale = status == KTG_OK && room.y > 0 ? best_scale(drawing, spots, room, boxes) : 0;
    for (uint32_t p = 0; scale > 0 && p < count; p++) {
        double top = at->y + room.y - boxes[p].y - boxes[p].height;
        spots[p].at = (ktg_vec2){at->x + boxes[p].x, top};
        spots[p].scale = scale;
        draw_piece(drawing, at->cairo, p, &spots[p]);
    }
    ktg_free(spots);
    ktg_free(boxes);
    return status;
}

/* ---- the scale of colours, and the square ------------------------------------------------- */

static void draw_scale(ktg_column *at) {
    const ktg_drawing *drawing = at->drawing;
    double width = fmin(at->width, 100), step = width / LEVELS;
    static const double ticks[] = {0, 0.5, 1, 2};
    char text[32];
    for (int level = 0; level < LEVELS; level++) {
        set_level(drawing, at->cairo, level);
        cairo_rectangle(at->cairo, at->x + level * step, at->y, step + 0.02, SCALE_MM);
        cairo_fill(at->cairo);
    }
    cairo_set_source_rgb(at->cairo, 0.15, 0.15, 0.15);
    ktg_text_set(at->cairo, KTG_FACE_PLAIN, 2);
    for (size_t k = 0; k < sizeof ticks / sizeof *ticks; k++) {
        double x = at->x + width * ticks[k] / 2;
        ktg_format(text, sizeof text, "%.3g %%%s", 100 * ticks[k] * drawing->options.strain_limit,
                   ticks[k] == 2 ? " and more" : "");
        ktg_text_draw(at->cairo, k == 0 ? x : x - ktg_text_width(at->cairo, text) / 2,
                      at->y + SCALE_MM + 3.2, text);
    }
    at->y += SCALE_MM + 7;
}

void ktg_test_square_draw(cairo_t *cairo, double x, double y) {
    cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
    cairo_set_line_width(cairo, 0.2);
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_rectangle(cairo, x, y, SQUARE_MM, SQUARE_MM);
    cairo_stroke(cairo);
    cairo_move_to(cairo, x + 2 * INCH_MM, y + SQUARE_MM - 3);
    cairo_line_to(cairo, x + 2 * INCH_MM, y + SQUARE_MM + 1);
    cairo_stroke(cairo);
    ktg_text_set(cairo, KTG_FACE_PLAIN, 2.4);
    ktg_text_draw(cairo, x + 3, y + 8, "Test square 50 x 50 mm");
    ktg_text_set(cairo, KTG_FACE_PLAIN, 1.8);
    ktg_text_draw(cairo, x + 3, y + 13, "the tick at its lower right is 2 in");
    ktg_text_draw(cairo, x + 3, y + 16.5, "from the left side");
}

/* ---- the page ----------------------------------------------------------------------------- */

bool ktg_strain_is_wanted(const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    return pattern->mode == KTG_CLOTH && pattern->face_strain && drawing->options.strain_map;
}

ktg_status ktg_strain_draw(const ktg_drawing *drawing, cairo_t *cairo, double width_mm,
                           double height_mm) {
    char text[160];
    ktg_column at = ktg_column_begin(drawing, cairo, width_mm, height_mm);
    ktg_column_write(&at, KTG_FACE_BOLD, 4.2, 0, "Where the cloth strains");
    snprintf(text, sizeof text,
             "How much each place of a piece is longer or shorter flat than on the finished thing; "
             "the limit is %.3g %%.",
             100 * drawing->options.strain_limit);
    ktg_column_write(&at, KTG_FACE_PLAIN, 2.4, 0, text);
    ktg_column_skip(&at, 2);
    draw_scale(&at);
    KTG_TRY(draw_pieces(&at));
    if (at.floor - at.y > SQUARE_MM)
        ktg_test_square_draw(cairo, at.x, at.floor - SQUARE_MM - 1);
    return KTG_OK;
}
