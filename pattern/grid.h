/* pattern/grid.h - a uniform grid of boxes: which of them may touch this one? (pattern only) */
#ifndef KTG_PATTERN_GRID_H
#define KTG_PATTERN_GRID_H

#include "core/vec.h"

typedef struct ktg_box {
    ktg_vec2 low, high; /* low.x > high.x: empty */
} ktg_box;

static inline ktg_box ktg_box_of(const ktg_vec2 *points, size_t count) {
    ktg_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < count; i++) {
        box.low = (ktg_vec2){fmin(box.low.x, points[i].x), fmin(box.low.y, points[i].y)};
        box.high = (ktg_vec2){fmax(box.high.x, points[i].x), fmax(box.high.y, points[i].y)};
    }
    return box;
}

static inline ktg_box ktg_box_grown(ktg_box box, double by) {
    return (ktg_box){{box.low.x - by, box.low.y - by}, {box.high.x + by, box.high.y + by}};
}

static inline bool ktg_boxes_meet(const ktg_box *a, const ktg_box *b) {
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y &&
           b->low.y <= a->high.y;
}

typedef struct ktg_grid {
    const ktg_box *boxes; /* count, borrowed; empty ones are never found */
    uint32_t count;
    ktg_vec2 low;
    double cell;
    uint32_t columns, rows;
    uint32_t *first; /* columns rows + 1: where a cell's boxes start in `items` */
    uint32_t *items;
    uint32_t *stamps; /* count: the last query that found a box */
    uint32_t stamp;
    uint32_t *found; /* count: what the last query found, each once, in a fixed order */
} ktg_grid;

/* The cells are about as large as the boxes on average, and about as many as there are boxes. */
KTG_NODISCARD ktg_status ktg_grid_build(ktg_context *context, const ktg_box *boxes, uint32_t count,
                                        ktg_grid *grid);
/* Leaves the numbers of the boxes that meet `box` in grid->found and returns how many they are. */
uint32_t ktg_grid_query(ktg_grid *grid, ktg_box box);
void ktg_grid_drop(ktg_grid *grid);

#endif
