/* unfold/cells.c - sheets divided into cells. */
#include "unfold/cells.h"
#include "core/memory.h"

#include <math.h>

/* Cells along one side of a sheet, at most. */
#define MOST_CELLS 400.0

ktg_status ktg_cells_new(ktg_context *context, uint32_t item_count, uint32_t sheets, ktg_vec2 half,
                         double size, ktg_cells *cells) {
    double least = 2 * fmax(half.x, half.y) / MOST_CELLS;
    size = fmax(size, least);
    *cells = (ktg_cells){.columns = (uint32_t)ceil(2 * half.x / size),
                         .rows = (uint32_t)ceil(2 * half.y / size),
                         .sheets = sheets,
                         .item_count = item_count,
                         .per_unit = 1 / size,
                         .low = {-half.x, -half.y}};
    cells->cells = ktg_new(context, (size_t)sheets * cells->rows * cells->columns, ktg_cell);
    cells->sheet = ktg_new(context, item_count, uint32_t);
    cells->ranges = ktg_new(context, item_count, ktg_cell_range);
    cells->boxes = ktg_new(context, item_count, ktg_flat_box);
    if (!cells->cells || !cells->sheet || !cells->ranges || !cells->boxes)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < item_count; i++)
        cells->sheet[i] = KTG_NONE;
    return KTG_OK;
}

void ktg_cells_free(ktg_cells *cells) {
    size_t count = (size_t)cells->sheets * cells->rows * cells->columns;
    for (size_t i = 0; cells->cells && i < count; i++)
        ktg_free(cells->cells[i].items);
    ktg_free(cells->cells);
    ktg_free(cells->sheet);
    ktg_free(cells->ranges);
    ktg_free(cells->boxes);
    *cells = (ktg_cells){0};
}

static uint16_t cell_at(double offset, double per_unit, uint32_t count) {
    double at = offset * per_unit;
    if (!(at > 0))
        return 0;
    return at >= count ? (uint16_t)(count - 1) : (uint16_t)at;
}

ktg_cell_range ktg_cells_range(const ktg_cells *c, const ktg_flat_box *box) {
    return (ktg_cell_range){cell_at(box->x0 - c->low.x, c->per_unit, c->columns),
                            cell_at(box->y0 - c->low.y, c->per_unit, c->rows),
                            cell_at(box->x1 - c->low.x, c->per_unit, c->columns),
                            cell_at(box->y1 - c->low.y, c->per_unit, c->rows)};
}

static void forget(ktg_cell *cell, uint32_t item) {
    size_t i = 0;
    while (cell->items[i].item != item)
        i++;
    cell->items[i] = cell->items[--cell->count];
}

void ktg_cells_take_out(ktg_cells *cells, uint32_t item) {
    ktg_cell_range r = cells->ranges[item];
    if (cells->sheet[item] == KTG_NONE)
        return;
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++)
            forget((ktg_cell *)ktg_cells_at(cells, cells->sheet[item], x, y), item);
    cells->sheet[item] = KTG_NONE;
}

ktg_status ktg_cells_put(ktg_context *context, ktg_cells *cells, uint32_t item, uint32_t sheet,
                         const ktg_flat_box *box) {
    ktg_cell_range r = ktg_cells_range(cells, box);
    ktg_cells_take_out(cells, item);
    for (uint32_t y = r.y0; y <= r.y1; y++) /* room first, so that a failure leaves no half */
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            ktg_cell *cell = (ktg_cell *)ktg_cells_at(cells, sheet, x, y);
            if (cell->count == cell->capacity)
                KTG_TRY(ktg_reserve(context, &cell->items, &cell->capacity, cell->count + 8));
        }
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            ktg_cell *cell = (ktg_cell *)ktg_cells_at(cells, sheet, x, y);
            cell->items[cell->count++] = (ktg_cell_item){*box, item};
        }
    cells->sheet[item] = sheet;
    cells->ranges[item] = r;
    cells->boxes[item] = *box;
    return KTG_OK;
}

void ktg_cells_add_boxes(const ktg_cells *cells, uint32_t sheet, ktg_flat_box *box) {
    for (uint32_t i = 0; i < cells->item_count; i++)
        if (cells->sheet[i] == sheet)
            ktg_flat_box_add(box, &cells->boxes[i]);
}
