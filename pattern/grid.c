/* pattern/grid.c - a uniform grid of boxes. */
#include "pattern/grid.h"

#include "core/memory.h"

#include <string.h>

static bool is_empty(const ktg_box *box) {
    return !(box->low.x <= box->high.x && box->low.y <= box->high.y);
}

/* Extent and cell size. */
static void measure(ktg_grid *grid) {
    ktg_vec2 high = {-INFINITY, -INFINITY};
    double side = 0;
    uint32_t full = 0;
    grid->low = (ktg_vec2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < grid->count; i++) {
        const ktg_box *box = &grid->boxes[i];
        if (is_empty(box))
            continue;
        grid->low = (ktg_vec2){fmin(grid->low.x, box->low.x), fmin(grid->low.y, box->low.y)};
        high = (ktg_vec2){fmax(high.x, box->high.x), fmax(high.y, box->high.y)};
        side += fmax(box->high.x - box->low.x, box->high.y - box->low.y);
        full++;
    }
    if (full == 0) {
        grid->low = high = (ktg_vec2){0, 0};
        full = 1;
    }
    ktg_vec2 size = ktg_sub2(high, grid->low);
    double fewest = fmax(sqrt(size.x * size.y / (4.0 * full)), fmax(size.x, size.y) / (4.0 * full));
    grid->cell = fmax(side / full, fewest);
    if (!(grid->cell > 0))
        grid->cell = 1;
    grid->columns = (uint32_t)(size.x / grid->cell) + 1;
    grid->rows = (uint32_t)(size.y / grid->cell) + 1;
}

/* The cell of a coordinate, clamped to the grid. */
static uint32_t cell_at(double x, double low, double cell, uint32_t count) {
    double c = floor((x - low) / cell);
    return c <= 0 ? 0 : c >= count - 1 ? count - 1 : (uint32_t)c;
}

typedef struct cells {
    uint32_t x0, x1, y0, y1;
} cells;

static cells cells_of(const ktg_grid *grid, const ktg_box *box) {
    return (cells){cell_at(box->low.x, grid->low.x, grid->cell, grid->columns),
                   cell_at(box->high.x, grid->low.x, grid->cell, grid->columns),
                   cell_at(box->low.y, grid->low.y, grid->cell, grid->rows),
                   cell_at(box->high.y, grid->low.y, grid->cell, grid->rows)};
}

/* Counts per cell into first[cell + 1], or, with `items`, fills them in, moving first[cell] on. */
static void visit_cells(ktg_grid *grid, uint32_t *items) {
    for (uint32_t i = 0; i < grid->count; i++) {
        if (is_empty(&grid->boxes[i]))
            continue;
        cells c = cells_of(grid, &grid->boxes[i]);
        for (uint32_t y = c.y0; y <= c.y1; y++)
            for (uint32_t x = c.x0; x <= c.x1; x++) {
                size_t cell = (size_t)y * grid->columns + x;
                if (items)
                    items[grid->first[cell]++] = i;
                else
                    grid->first[cell + 1]++;
            }
    }
}

static ktg_status fill(ktg_context *context, ktg_grid *grid) {
    size_t cell_count = (size_t)grid->columns * grid->rows;
    grid->first = ktg_new(context, cell_count + 1, uint32_t);
    grid->stamps = ktg_new(context, grid->count, uint32_t);
    grid->found = ktg_new(context, grid->count, uint32_t);
    if (!grid->first || !grid->stamps || !grid->found)
        return KTG_MEMORY;
    visit_cells(grid, NULL);
    for (size_t c = 0; c < cell_count; c++)
        grid->first[c + 1] += grid->first[c];
    grid->items = ktg_new(context, grid->first[cell_count], uint32_t);
    if (!grid->items)
        return KTG_MEMORY;
    visit_cells(grid, grid->items);
    memmove(grid->first + 1, grid->first, cell_count * sizeof *grid->first);
    grid->first[0] = 0;
    return KTG_OK;
}

ktg_status ktg_grid_build(ktg_context *context, const ktg_box *boxes, uint32_t count,
                          ktg_grid *grid) {
    *grid = (ktg_grid){.boxes = boxes, .count = count};
    measure(grid);
    ktg_status status = fill(context, grid);
    if (status != KTG_OK)
        ktg_grid_drop(grid);
    return status;
}

uint32_t ktg_grid_query(ktg_grid *grid, ktg_box box) {
    uint32_t found = 0;
    if (is_empty(&box))
        return 0;
    grid->stamp++;
    cells c = cells_of(grid, &box);
    for (uint32_t y = c.y0; y <= c.y1; y++)
        for (uint32_t x = c.x0; x <= c.x1; x++) {
            size_t cell = (size_t)y * grid->columns + x;
            for (uint32_t k = grid->first[cell]; k < grid->first[cell + 1]; k++) {
                uint32_t i = grid->items[k];
                if (grid->stamps[i] == grid->stamp || !ktg_boxes_meet(&grid->boxes[i], &box))
                    continue;
                grid->stamps[i] = grid->stamp;
                grid->found[found++] = i;
            }
        }
    return found;
}

void ktg_grid_drop(ktg_grid *grid) {
    ktg_free(grid->first);
    ktg_free(grid->items);
    ktg_free(grid->stamps);
    ktg_free(grid->found);
    memset(grid, 0, sizeof *grid);
}
