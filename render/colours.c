/* render/colours.c - the dots of a sheet, coloured. */
#include "render/colours.h"

#include "core/memory.h"
#include "core/parallel.h"

#include <string.h>

/* About 470 x 470 mm at 300 dots per inch. */
#define MOST_DOTS 32e6
#define BAND      64 /* rows that are coloured at a time */
#define WHITE     0xffffffu

/* ---- its extent ---------------------------------------------------------------------------- */

/* What the faces of the sheet's pieces cover, with the strip beside them, on the page; of a
 * poster's sheet only what is printed. False when there are none. */
static bool find_area(const ktg_drawing *drawing, const ktg_pattern_sheet *sheet, ktg_area *area) {
    double bleed = drawing->options.bleed_mm, high = sheet->height_mm;
    ktg_area found = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < sheet->placement_count; i++) {
        const ktg_pattern_piece *piece = &drawing->pattern->pieces[sheet->placements[i].piece];
        ktg_motion2 motion = ktg_page_motion(&sheet->placements[i]);
        for (size_t v = 0; !piece->on_fold && v < piece->vertex_count; v++) {
            ktg_vec2 p = ktg_move2(motion, piece->vertices[v]);
            found = (ktg_area){fmin(found.x0, p.x - bleed), fmin(found.y0, high - p.y - bleed),
                               fmax(found.x1, p.x + bleed), fmax(found.y1, high - p.y + bleed)};
        }
    }
    bool tile = sheet->kind == KTG_TILE;
    *area = (ktg_area){fmax(found.x0, tile ? sheet->printable[0] : 0),
                       fmax(found.y0, tile ? high - sheet->printable[3] : 0),
                       fmin(found.x1, tile ? sheet->printable[2] : sheet->width_mm),
                       fmin(found.y1, tile ? high - sheet->printable[1] : high)};
    return area->x1 > area->x0 && area->y1 > area->y0;
}

/* Dots begin where those of a picture of the whole page do. */
static void set_extent(ktg_colours *colours, ktg_area area, double dots_per_mm) {
    double dots = (area.x1 - area.x0) * (area.y1 - area.y0) * dots_per_mm * dots_per_mm;
    dots_per_mm *= dots > MOST_DOTS ? sqrt(MOST_DOTS / dots) : 1;
    double left = floor(area.x0 * dots_per_mm), top = floor(area.y0 * dots_per_mm);
    colours->dots_per_mm = dots_per_mm;
    colours->corner = (ktg_vec2){left / dots_per_mm, top / dots_per_mm};
    colours->width = (uint32_t)fmax(1, ceil(area.x1 * dots_per_mm) - left);
    colours->height = (uint32_t)fmax(1, ceil(area.y1 * dots_per_mm) - top);
}

/* ---- colouring ----------------------------------------------------------------------------- */

/* The point of a triangle that is nearest to one outside. */
static ktg_vec2 nearest_in(const ktg_vec2 corners[3], ktg_vec2 point) {
    ktg_vec2 best = corners[0];
    double least = INFINITY;
    for (size_t k = 0; k < 3; k++) {
        ktg_vec2 from = corners[k], along = ktg_sub2(corners[(k + 1) % 3], from);
        double square = ktg_dot2(along, along);
        double t = square > 0 ? ktg_dot2(ktg_sub2(point, from), along) / square : 0;
        ktg_vec2 at = ktg_madd2(from, ktg_max(0, ktg_min(1, t)), along);
        double away = ktg_length2(ktg_sub2(at, point));
        if (away < least) {
            least = away;
            best = at;
        }
    }
    return best;
}

static void weights_at(const ktg_laid_face *laid, ktg_vec2 at, double weights[3]) {
    for (size_t k = 0; k < 3; k++)
        weights[k] = laid->at[k] + at.x * laid->right[k] + at.y * laid->down[k];
}

static ktg_status colour_dot(ktg_context *context, const ktg_drawing *drawing,
                             const ktg_laid_face *laid, ktg_vec2 at, uint32_t *near,
                             uint32_t *dot) {
    ktg_paint_dot asked = {.face = laid->face, .near = *near};
    uint8_t rgb[3];
    memcpy(asked.right, laid->right, sizeof asked.right);
    memcpy(asked.down, laid->down, sizeof asked.down);
    weights_at(laid, at, asked.weights);
    if (asked.weights[0] < 0 || asked.weights[1] < 0 || asked.weights[2] < 0)
        weights_at(laid, nearest_in(laid->corners, at), asked.weights);
    KTG_TRY(ktg_paint_colour(context, drawing->options.paint, &asked, rgb));
    *near = asked.near;
    *dot = ktg_drawing_colour(drawing, (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2]);
    return KTG_OK;
}

static ktg_status colour_band(ktg_context *context, uint32_t band, void *user) {
    const ktg_colour_plan *plan = user;
    const ktg_colours *colours = plan->colours;
    uint32_t end = band * BAND + BAND < colours->height ? band * BAND + BAND : colours->height;
    uint32_t near = KTG_NONE;
    KTG_TRY(ktg_check_cancel(context));
    for (uint32_t y = band * BAND; y < end; y++)
        for (uint32_t x = 0; x < colours->width; x++) {
            size_t at = (size_t)y * colours->width + x;
            if (plan->owners[at] != KTG_NONE)
                KTG_TRY(colour_dot(context, plan->drawing, &plan->faces[plan->owners[at]],
                                   (ktg_vec2){x + 0.5, y + 0.5}, &near, &colours->dots[at]));
        }
    return KTG_OK;
}

/* ---- the whole ----------------------------------------------------------------------------- */

static ktg_status make(const ktg_drawing *drawing, const ktg_pattern_sheet *sheet,
                       ktg_colours *colours) {
    size_t count = (size_t)colours->width * colours->height;
    ktg_colour_plan plan = {.drawing = drawing, .sheet = sheet, .colours = colours};
    colours->dots = ktg_new(drawing->context, count, uint32_t);
    ktg_status status = colours->dots ? ktg_colours_lay(&plan) : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < count; i++)
        colours->dots[i] = WHITE;
    if (status == KTG_OK)
        status = ktg_parallel_run(drawing->context, (colours->height + BAND - 1) / BAND,
                                  colour_band, &plan);
    ktg_free(plan.faces);
    ktg_free(plan.owners);
    return status;
}

ktg_status ktg_colours_make(const ktg_drawing *drawing, size_t number, double dots_per_mm,
                            ktg_colours **colours) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[number];
    ktg_area area;
    *colours = NULL;
    if (!drawing->options.paint || !find_area(drawing, sheet, &area))
        return KTG_OK;
    ktg_colours *made = ktg_new(drawing->context, 1, ktg_colours);
    if (!made)
        return KTG_MEMORY;
    set_extent(made, area, dots_per_mm);
    ktg_status status = make(drawing, sheet, made);
    if (status != KTG_OK)
        ktg_colours_free(&made);
    *colours = made;
    return status;
}

void ktg_colours_free(ktg_colours **colours) {
    if (!colours || !*colours)
        return;
    ktg_free((*colours)->dots);
    ktg_free(*colours);
    *colours = NULL;
}
