/* render/page.c - one sheet: where its pieces come to lie on the page, layer by layer. */
#include "render/colours.h"
#include "render/furniture.h"
#include "render/poster.h"

ktg_motion2 ktg_page_motion(const ktg_pattern_placement *placement) {
    return (ktg_motion2){
        cos(placement->rotation), sin(placement->rotation), {placement->x, placement->y}};
}

ktg_vec2 ktg_page_point(const ktg_page *page, ktg_motion2 motion, ktg_vec2 point) {
    ktg_vec2 on_sheet = ktg_move2(motion, point);
    return (ktg_vec2){on_sheet.x, page->sheet->height_mm - on_sheet.y};
}

ktg_area ktg_page_printable(const ktg_page *page) {
    const ktg_pattern_sheet *sheet = page->sheet;
    return (ktg_area){sheet->printable[0], sheet->height_mm - sheet->printable[3],
                      sheet->printable[2], sheet->height_mm - sheet->printable[1]};
}

void ktg_page_begin(cairo_t *cairo) {
    cairo_font_options_t *fonts = cairo_font_options_create();
    cairo_font_options_set_hint_style(fonts, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(fonts, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(fonts, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cairo, fonts);
    cairo_font_options_destroy(fonts);
}

/* A tile shows its printable area and no more; what lies beyond is on its neighbours. */
static void clip_tile(const ktg_page *page) {
    ktg_area area = ktg_page_printable(page);
    if (page->sheet->kind != KTG_TILE)
        return;
    cairo_rectangle(page->cairo, area.x0, area.y0, area.x1 - area.x0, area.y1 - area.y0);
    cairo_clip(page->cairo);
}

static void draw_sheet(const ktg_page *page) {
    typedef void layer(const ktg_page *, const ktg_pattern_placement *);
    static layer *const layers[] = {ktg_draw_tabs,    ktg_draw_folds,   ktg_draw_lines,
                                    ktg_draw_grounds, ktg_draw_outline, ktg_draw_joints,
                                    ktg_draw_labels};
    cairo_save(page->cairo);
    clip_tile(page);
    for (size_t k = 0; k < sizeof layers / sizeof *layers; k++)
        for (size_t i = 0; i < page->sheet->placement_count; i++)
            layers[k](page, &page->sheet->placements[i]);
    cairo_restore(page->cairo);
    if (ktg_is_tile(page->sheet))
        ktg_tile_draw_joins(page);
    ktg_registration_draw(page);
    ktg_marker_draw(page);
}

ktg_status ktg_page_draw(const ktg_drawing *drawing, size_t number, cairo_t *cairo,
                         bool *furnished) {
    ktg_page page = {drawing, &drawing->pattern->sheets[number], number, cairo, NULL};
    ktg_status status = ktg_check_cancel(drawing->context);
    if (status != KTG_OK)
        return status;
    ktg_page_begin(cairo);
    if (ktg_is_tile(page.sheet))
        ktg_tile_draw_ground(&page);
    status = ktg_colours_begin(&page);
    if (status == KTG_OK)
        status = ktg_furniture_draw(&page, furnished);
    if (status == KTG_OK)
        draw_sheet(&page);
    ktg_colours_free(&page.colours);
    ktg_progress(drawing->context, "render",
                 (double)(number + 1) / (double)drawing->pattern->sheet_count, NULL);
    return status;
}
