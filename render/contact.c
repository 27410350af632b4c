/* render/contact.c - all pages in one picture, side by side, for a quick look. */
#include "render/draw.h"
#include "render/poster.h"

#define MOST_PIXELS 3000
#define GAP_MM      8.0
#define ASPECT      1.4
#define EMPTY_COST  1.5

/* The grid: as many cells as there are pages, each as large as the largest of them. */
typedef struct grid {
    size_t pages, covers, columns, rows;
    ktg_vec2 cell; /* with a gap at its right and below */
    double scale;  /* pixels for a millimetre */
} grid;

/* A picture of the shape of a screen, without many empty cells. */
static double cost_of(const grid *g, size_t columns, size_t rows) {
    double aspect = (double)columns * g->cell.x / ((double)rows * g->cell.y);
    double cells = (double)(columns * rows);
    return fabs(log(aspect / ASPECT)) + EMPTY_COST * (cells - (double)g->pages) / cells;
}

static void choose_columns(grid *g) {
    double best = INFINITY;
    for (size_t columns = 1; columns <= g->pages; columns++) {
        size_t rows = (g->pages + columns - 1) / columns;
        double cost = cost_of(g, columns, rows);
        if (cost < best) {
            best = cost;
            g->columns = columns;
            g->rows = rows;
        }
    }
}

static grid make_grid(const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    grid g = {.covers = ktg_cover_count(drawing)};
    g.pages = g.covers + pattern->sheet_count;
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        g.cell.x = fmax(g.cell.x, pattern->sheets[s].width_mm + GAP_MM);
        g.cell.y = fmax(g.cell.y, pattern->sheets[s].height_mm + GAP_MM);
    }
    choose_columns(&g);
    double width = (double)g.columns * g.cell.x + GAP_MM,
           height = (double)g.rows * g.cell.y + GAP_MM;
    g.scale = fmin(drawing->options.dots_per_inch / 25.4, MOST_PIXELS / fmax(width, height));
    return g;
}

/* White paper with a thin edge; what is drawn on it does not reach beyond. */
static void lay_paper(cairo_t *cairo, double width, double height) {
    cairo_rectangle(cairo, 0, 0, width, height);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgb(cairo, 0.45, 0.45, 0.45);
    cairo_set_line_width(cairo, 0.5);
    cairo_stroke_preserve(cairo);
    cairo_clip(cairo);
}

static ktg_status draw_page(const ktg_drawing *drawing, cairo_t *cairo, const grid *g,
                            size_t page) {
    bool is_cover = page < g->covers, furnished;
    size_t number = is_cover ? 0 : page - g->covers;
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[number];
    cairo_save(cairo);
    cairo_translate(cairo, GAP_MM + (double)(page % g->columns) * g->cell.x,
                    GAP_MM + (double)(page / g->columns) * g->cell.y);
    lay_paper(cairo, sheet->width_mm, sheet->height_mm);
    ktg_status status = KTG_OK;
    if (is_cover)
        ktg_cover_draw(drawing, cairo, page);
    else
        status = ktg_page_draw(drawing, number, cairo, &furnished);
    cairo_restore(cairo);
    return status;
}

static ktg_status draw_pages(const ktg_drawing *drawing, cairo_t *cairo, const void *what) {
    const grid *g = what;
    ktg_status status = KTG_OK;
    cairo_set_source_rgb(cairo, 0.8, 0.8, 0.8);
    cairo_paint(cairo);
    cairo_scale(cairo, g->scale, g->scale);
    for (size_t page = 0; status == KTG_OK && page < g->pages; page++)
        status = draw_page(drawing, cairo, g, page);
    return status;
}

ktg_status ktg_render_contact(ktg_context *context, const ktg_pattern *pattern,
                              const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    ktg_status status = ktg_drawing_new(context, pattern, options, &drawing);
    if (status != KTG_OK)
        return status;
    grid g = make_grid(drawing);
    if (!(g.scale > 0))
        status = ktg_fail(context, KTG_ARGUMENT, "%g dots per inch: it must be more than 0",
                          drawing->options.dots_per_inch);
    double width = ((double)g.columns * g.cell.x + GAP_MM) * g.scale;
    double height = ((double)g.rows * g.cell.y + GAP_MM) * g.scale;
    if (status == KTG_OK)
        status = ktg_png_make(drawing, (int)fmax(1, round(width)), (int)fmax(1, round(height)),
                              draw_pages, &g, output);
    ktg_drawing_free(&drawing);
    return status;
}
