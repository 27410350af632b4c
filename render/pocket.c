/* render/pocket.c - where on a sheet nothing lies: a coarse picture of the pieces, and sums over it
 * that tell at once whether a rectangle is free (Crow 1984). */
#include "render/draw.h"
#include "render/furniture.h"

#include "core/memory.h"

#define DOTS_PER_MM 2.0
#define MOST_DOTS   2400
#define CLEAR_MM    2.0
#define STEP_MM     2.0

/* Pieces, filled, and a rim around them. */
static void draw_taken(const ktg_page *page, cairo_t *cairo) {
    cairo_set_line_width(cairo, 2 * CLEAR_MM);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (size_t i = 0; i < page->sheet->placement_count; i++) {
        const ktg_pattern_placement *at = &page->sheet->placements[i];
        const ktg_pattern_piece *piece = &page->drawing->pattern->pieces[at->piece];
        ktg_motion2 motion = ktg_page_motion(at);
        for (size_t k = 0; k < piece->outline_count; k++) {
            ktg_vec2 p = ktg_page_point(page, motion, piece->outline[k]);
            cairo_line_to(cairo, p.x, p.y);
        }
        cairo_close_path(cairo);
        cairo_fill_preserve(cairo);
        cairo_stroke(cairo);
    }
}

/* sums[y][x]: how many dots are taken above and to the left of (x, y). */
static void add_up(cairo_surface_t *surface, ktg_pockets *pockets) {
    cairo_surface_flush(surface);
    const unsigned char *dots = cairo_image_surface_get_data(surface);
    int stride = cairo_image_surface_get_stride(surface), wide = pockets->width + 1;
    for (int y = 0; dots && y < pockets->height; y++) {
        uint32_t row = 0;
        for (int x = 0; x < pockets->width; x++) {
            row += dots[(ptrdiff_t)y * stride + x] != 0;
            pockets->sums[(size_t)(y + 1) * (size_t)wide + (size_t)x + 1] =
                pockets->sums[(size_t)y * (size_t)wide + (size_t)x + 1] + row;
        }
    }
}

ktg_status ktg_pockets_find(const ktg_page *page, ktg_area within, ktg_pockets *pockets) {
    ktg_context *context = page->drawing->context;
    double longest = fmax(page->sheet->width_mm, page->sheet->height_mm);
    double scale = fmin(DOTS_PER_MM, MOST_DOTS / longest);
    *pockets = (ktg_pockets){.width = (int)ceil(page->sheet->width_mm * scale),
                             .height = (int)ceil(page->sheet->height_mm * scale),
                             .scale = scale,
                             .within = within};
    pockets->sums =
        ktg_new(context, ((size_t)pockets->width + 1) * ((size_t)pockets->height + 1), uint32_t);
    if (!pockets->sums)
        return KTG_MEMORY;
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_A8, pockets->width, pockets->height);
    cairo_t *cairo = cairo_create(surface);
    cairo_scale(cairo, scale, scale);
    draw_taken(page, cairo);
    cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    if (drawn == CAIRO_STATUS_SUCCESS)
        add_up(surface, pockets);
    cairo_surface_destroy(surface);
    return ktg_cairo_status(context, NULL, drawn, "the sheet");
}

void ktg_pockets_drop(ktg_pockets *pockets) {
    ktg_free(pockets->sums);
    pockets->sums = NULL;
}

static bool meet(ktg_area a, ktg_area b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

static bool is_free(const ktg_pockets *pockets, ktg_area area) {
    int x0 = (int)floor(area.x0 * pockets->scale), y0 = (int)floor(area.y0 * pockets->scale);
    int x1 = (int)ceil(area.x1 * pockets->scale), y1 = (int)ceil(area.y1 * pockets->scale);
    size_t wide = (size_t)pockets->width + 1;
    if (x0 < 0 || y0 < 0 || x1 > pockets->width || y1 > pockets->height)
        return false;
    const uint32_t *above = pockets->sums + (size_t)y0 * wide,
                   *below = pockets->sums + (size_t)y1 * wide;
    if (below[x1] - below[x0] - above[x1] + above[x0] > 0)
        return false;
    for (size_t i = 0; i < pockets->taken_count; i++)
        if (meet(area, pockets->taken[i]))
            return false;
    return true;
}

/* From the lower left corner to the right and up. */
bool ktg_pockets_take(ktg_pockets *pockets, double width, double height, ktg_area *area) {
    ktg_area within = pockets->within;
    if (pockets->taken_count == KTG_POCKETS)
        return false;
    for (double y = within.y1 - height; y >= within.y0 - 1e-9; y -= STEP_MM)
        for (double x = within.x0; x + width <= within.x1 + 1e-9; x += STEP_MM) {
            *area = (ktg_area){x, y, x + width, y + height};
            if (!is_free(pockets, *area))
                continue;
            pockets->taken[pockets->taken_count++] =
                (ktg_area){x - CLEAR_MM, y - CLEAR_MM, x + width + CLEAR_MM, y + height + CLEAR_MM};
            return true;
        }
    return false;
}
