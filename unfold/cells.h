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

typedef struct ktg_cell_item {
    ktg_flat_box box; /* a copy of the item's, so that asking looks nowhere else */
    uint32_t item;
} ktg_cell_item;

typedef struct ktg_cell {
    ktg_cell_item *items;
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

/* Grows *box to hold everything on a sheet. */
void ktg_cells_add_boxes(const ktg_cells *cells, uint32_t sheet, ktg_flat_box *box);

/* The items near a box, one call after the other; an item in several cells comes several times. The
 * present item may be taken out. */
typedef struct ktg_cell_walk {
    const ktg_cells *cells;
    const ktg_cell *cell;
    ktg_flat_box box;
    ktg_cell_range range;
    uint32_t sheet, x, y; /* the present cell */
    size_t left;          /* items of it that are still to come */
} ktg_cell_walk;

/* Larger on all sides. */
static inline ktg_flat_box ktg_flat_box_grown(ktg_flat_box box, double by) {
    float b = (float)by;
    return (ktg_flat_box){box.x0 - b, box.y0 - b, box.x1 + b, box.y1 + b};
}

static inline const ktg_cell *ktg_cells_at(const ktg_cells *cells, uint32_t sheet, uint32_t x,
                                           uint32_t y) {
    return &cells->cells[((size_t)sheet * cells->rows + y) * cells->columns + x];
}

static inline ktg_cell_walk ktg_cells_walk(const ktg_cells *cells, uint32_t sheet,
                                           const ktg_flat_box *box) {
    ktg_cell_walk w = {.cells = cells, .box = *box, .sheet = sheet};
    w.range = ktg_cells_range(cells, box);
    w.x = w.range.x0;
    w.y = w.range.y0;
    w.cell = ktg_cells_at(cells, sheet, w.x, w.y);
    w.left = w.cell->count;
    return w;
}

/* KTG_NONE at the end. */
static inline uint32_t ktg_cells_next(ktg_cell_walk *w) {
    for (;;) {
        while (w->left > 0) {
            const ktg_cell_item *item = &w->cell->items[--w->left];
            if (ktg_flat_boxes_meet(&w->box, &item->box))
                return item->item;
        }
        if (w->x++ == w->range.x1) {
            w->x = w->range.x0;
            if (w->y++ == w->range.y1)
                return KTG_NONE;
        }
        w->cell = ktg_cells_at(w->cells, w->sheet, w->x, w->y);
        w->left = w->cell->count;
    }
}

#endif
