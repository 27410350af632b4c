/* unfold/cells.h - which flat shapes lie near a box: sheets divided into square cells, each with a
 * list of what touches it (unfold only).
 *
 * Made for a search that asks a hundred times before it moves anything: asking reads short lists
 * that lie together in memory, moving edits them. Every piece has a sheet of its own, whose middle
 * is the origin; what lies beyond its edge counts as in the outermost cells. */
#ifndef KTG_UNFOLD_CELLS_H
#define KTG_UNFOLD_CELLS_H

#include "core/core.h"
#include "unfold/overlap.h"

typedef struct ktg_cell {
    uint32_t *items;
    size_t count, capacity;
} ktg_cell;

/* Columns x0 .. x1 and rows y0 .. y1. */
typedef struct ktg_cell_range {
    uint16_t x0, y0, x1, y1;
} ktg_cell_range;

typedef struct ktg_cells {
    uint32_t columns, rows, sheets, item_count;
    double per_unit;        /* cells in a unit of length */
    ktg_vec2 low;           /* lower left corner of each sheet's cells */
    ktg_cell *cells;        /* sheets x rows x columns */
    uint32_t *sheet;        /* item_count: where an item is; KTG_NONE: nowhere */
    ktg_cell_range *ranges; /* item_count */
    ktg_flat_box *boxes;    /* item_count */
} ktg_cells;

/* Room for item_count items on sheets that reach from -half to +half; a cell is about `size`
 * large. */
KTG_NODISCARD ktg_status ktg_cells_new(ktg_context *context, uint32_t item_count, uint32_t sheets,
                                       ktg_vec2 half, double size, ktg_cells *cells);
void ktg_cells_free(ktg_cells *cells);

ktg_cell_range ktg_cells_range(const ktg_cells *cells, const ktg_flat_box *box);

/* Puts an item where its box is, from wherever it was. KTG_MEMORY only. */
KTG_NODISCARD ktg_status ktg_cells_put(ktg_context *context, ktg_cells *cells, uint32_t item,
                                       uint32_t sheet, const ktg_flat_box *box);
void ktg_cells_take_out(ktg_cells *cells, uint32_t item);

/* Larger on all sides. */
static inline ktg_flat_box ktg_flat_box_grown(ktg_flat_box box, double by) {
    float b = (float)by;
    return (ktg_flat_box){box.x0 - b, box.y0 - b, box.x1 + b, box.y1 + b};
}

static inline const ktg_cell *ktg_cells_at(const ktg_cells *cells, uint32_t sheet, uint32_t x,
                                           uint32_t y) {
    return &cells->cells[((size_t)sheet * cells->rows + y) * cells->columns + x];
}

#endif
