/* unfold/net_grid.c - a hashed grid with levels. */
#include "unfold/net_grid.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

/* Sizes further than this below the largest share the lowest level. */
#define MOST_LEVELS 20
/* Cells of the lowest level that a face's neighbours lie in, on the average of all faces; a needle
 * beside faces a million times its size would have each of them walk 10^12. */
#define MOST_CELLS 1024.0
/* Farther cells are one, so that level, column and row fit 64 bits: 5, 29 and 29. */
#define FARTHEST 2.5e8
/* Of a cell's width in a box kept as a word: a face reaches from half a cell before its own to half
 * a cell behind it, so that three cells are enough; they must fit 15 bits. */
#define PARTS 8192
/* Looking into a cell costs as much as looking at so many faces. */
#define COST_OF_CELL 12.0

/* The average of (size / cell)^2. */
static double cells_of_level(const double *sizes, uint32_t face_count, int level) {
    double sum = 0;
    for (uint32_t f = 0; f < face_count; f++) {
        double cells = ldexp(sizes[f], -level);
        sum += cells * cells;
    }
    return sum / face_count;
}

static void choose_levels(const double *sizes, uint32_t face_count, ktg_net_grid *grid) {
    double least = INFINITY, most = 0;
    for (uint32_t f = 0; f < face_count; f++) {
        most = fmax(most, sizes[f]);
        least = sizes[f] > 0 ? fmin(least, sizes[f]) : least;
    }
    int highest = most > 0 ? ilogb(most) + 1 : 0;
    grid->lowest = isfinite(least) ? ilogb(least) + 1 : highest;
    if (highest - grid->lowest >= MOST_LEVELS)
        grid->lowest = highest - MOST_LEVELS + 1;
    while (grid->lowest < highest && cells_of_level(sizes, face_count, grid->lowest) > MOST_CELLS)
        grid->lowest++;
    grid->level_count = highest - grid->lowest + 1;
    for (uint32_t f = 0; f < face_count; f++) {
        int level = sizes[f] > 0 ? ilogb(sizes[f]) + 1 - grid->lowest : 0;
        grid->level[f] = (uint8_t)(level > 0 ? level : 0);
    }
}

/* What it costs that this level has cells of its own: those which larger faces look into; and about
 * how many faces those of the level (as `level_now` has it) find in their own cells. */
static void costs_of_level(const ktg_net_grid *grid, const double *sizes, const uint8_t *level_now,
                           int level, double *cells, double *faces) {
    *cells = *faces = 0;
    for (uint32_t f = 0; f < grid->face_count; f++) {
        double size = ldexp(sizes[f], -(grid->lowest + level));
        if (grid->level[f] > level)
            *cells += COST_OF_CELL * (size + 1.5) * (size + 1.5);
        else if (level_now[grid->level[f]] == level && size > 0)
            *faces += 2 / fmax(size * size, 1e-6);
    }
}

/* Moves the faces of a level up to the next one where that costs less: their cells are four times
 * as full there, but the others need not look into cells of their own. */
static void join_levels(const double *sizes, ktg_net_grid *grid) {
    uint8_t level_now[MOST_LEVELS + 1];
    for (int level = 0; level < grid->level_count; level++)
        level_now[level] = (uint8_t)level;
    for (int level = 0; level + 1 < grid->level_count; level++) {
        double cells, faces;
        costs_of_level(grid, sizes, level_now, level, &cells, &faces);
        for (int k = 0; k <= level && 3 * faces < cells; k++)
            level_now[k] = level_now[k] == level ? (uint8_t)(level + 1) : level_now[k];
    }
    for (uint32_t f = 0; f < grid->face_count; f++)
        grid->level[f] = level_now[grid->level[f]];
}

/* Faces sorted by level. */
static void list_levels(ktg_net_grid *grid) {
    uint32_t *next =
        grid->level_first + 1; /* where the next face of a level goes; ends up as its end */
    for (uint32_t f = 0; f < grid->face_count; f++)
        if (grid->level[f] + 1 < grid->level_count)
            next[grid->level[f] + 1]++;
    for (int level = 1; level < grid->level_count; level++)
        next[level] += next[level - 1];
    for (uint32_t f = 0; f < grid->face_count; f++)
        grid->by_level[next[grid->level[f]]++] = f;
}

ktg_status ktg_net_grid_new(ktg_context *context, const double *sizes, uint32_t face_count,
                            ktg_net_grid *grid) {
    *grid = (ktg_net_grid){.face_count = face_count, .mask = 63};
    while (grid->mask < 2 * (size_t)face_count)
        grid->mask = 2 * grid->mask + 1;
    grid->head = ktg_new(context, grid->mask + 1, uint32_t);
    grid->blocks = ktg_new(context, face_count, ktg_net_block);
    grid->block_of = ktg_new(context, face_count, uint32_t);
    grid->level = ktg_new(context, face_count, uint8_t);
    grid->cells_per_unit = ktg_new(context, MOST_LEVELS + 1, double);
    grid->level_first = ktg_new(context, MOST_LEVELS + 2, uint32_t);
    grid->by_level = ktg_new(context, face_count, uint32_t);
    if (!grid->head || !grid->blocks || !grid->block_of || !grid->level || !grid->cells_per_unit ||
        !grid->level_first || !grid->by_level) {
        ktg_net_grid_free(grid);
        return KTG_MEMORY;
    }
    memset(grid->head, 0xff, (grid->mask + 1) * sizeof *grid->head);
    memset(grid->block_of, 0xff, face_count * sizeof *grid->block_of);
    for (uint32_t f = 0; f < face_count; f++)
        grid->blocks[f].next = f + 1 < face_count ? f + 1 : KTG_NONE;
    choose_levels(sizes, face_count, grid);
    join_levels(sizes, grid);
    for (int level = 0; level < grid->level_count; level++)
        grid->cells_per_unit[level] = ldexp(1, -(grid->lowest + level));
    list_levels(grid);
    return KTG_OK;
}

void ktg_net_grid_free(ktg_net_grid *grid) {
    ktg_free(grid->head);
    ktg_free(grid->blocks);
    ktg_free(grid->block_of);
    ktg_free(grid->level);
    ktg_free(grid->cells_per_unit);
    ktg_free(grid->level_first);
    ktg_free(grid->by_level);
    *grid = (ktg_net_grid){0};
}

/* x and y lie within FARTHEST, 2^28 above that is positive. */
static uint64_t cell_number(int level, int32_t x, int32_t y) {
    return (uint64_t)level << 58 | (uint64_t)(x + (1 << 28)) << 29 | (uint64_t)(y + (1 << 28));
}

static size_t bucket_of(const ktg_net_grid *grid, uint64_t cell) {
    return (size_t)((cell * 0x9e3779b97f4a7c15u) >> 32) & grid->mask;
}

/* Rounded down, without a call: the sum is positive. */
static int32_t round_down(double x) {
    x = x < -FARTHEST ? -FARTHEST : x > FARTHEST ? FARTHEST : x;
    return (int32_t)(x + (1 << 28)) - (1 << 28);
}

static uint32_t slot_of(const ktg_net_block *block, uint32_t face) {
    uint32_t k = 0;
    while (block->faces[k] != face)
        k++;
    return k;
}

static void free_block(ktg_net_grid *grid, uint32_t number) {
    uint32_t *link = &grid->head[bucket_of(grid, grid->blocks[number].cell)];
    while (*link != number)
        link = &grid->blocks[*link].next;
    *link = grid->blocks[number].next;
    grid->blocks[number].next = grid->free_block;
    grid->free_block = number;
}

/* The same for parts of cells, of which there are more. */
static int64_t parts_below(double x) {
    const double most = FARTHEST * PARTS;
    x = x < -most ? -most : x > most ? most : x;
    return (int64_t)(x + 0x1p42) - ((int64_t)1 << 42);
}

static void take_out(ktg_net_grid *grid, uint32_t face) {
    ktg_net_block *block = &grid->blocks[grid->block_of[face]];
    uint32_t k = slot_of(block, face), last = --block->count;
    block->boxes[k] = block->boxes[last];
    block->faces[k] = block->faces[last];
    if (block->count == 0)
        free_block(grid, grid->block_of[face]);
}

/* A block of the cell with room for one more face. */
static uint32_t find_room(ktg_net_grid *grid, uint64_t cell) {
    uint32_t *head = &grid->head[bucket_of(grid, cell)];
    for (uint32_t b = *head; b != KTG_NONE; b = grid->blocks[b].next)
        if (grid->blocks[b].cell == cell && grid->blocks[b].count < KTG_NET_BLOCK)
            return b;
    uint32_t number = grid->free_block;
    ktg_net_block *block = &grid->blocks[number];
    grid->free_block = block->next;
    block->cell = cell;
    block->count = 0;
    block->next = *head;
    *head = number;
    return number;
}

/* ---- boxes in one word ------------------------------------------------------------------------
 */

#define LANES(a, b, c, d)                                                                          \
    ((uint64_t)(a) | (uint64_t)(b) << 16 | (uint64_t)(c) << 32 | (uint64_t)(d) << 48)
#define LANE 0x7fff
#define HIGH LANES(0x8000, 0x8000, 0x8000, 0x8000)

/* In parts, from one cell before `cell` on. Clamping keeps the order of two numbers or makes them
 * equal. */
static uint64_t lane(int64_t parts, int32_t cell) {
    int64_t x = parts - (int64_t)(cell - 1) * PARTS;
    return (uint64_t)(x < 0 ? 0 : x > LANE ? LANE : x);
}

static ktg_net_parts parts_of(const ktg_net_box *box, double cells_per_unit) {
    double scale = PARTS * cells_per_unit;
    return (ktg_net_parts){parts_below(box->low.x * scale), parts_below(box->low.y * scale),
                           parts_below(box->high.x * scale) + 1,
                           parts_below(box->high.y * scale) + 1};
}

/* Of a face: no lane may be above that of a word made by `reach`. */
static uint64_t extent(const ktg_net_parts *box, int32_t x, int32_t y) {
    return LANES(lane(box->x0, x), lane(box->y0, y), LANE - lane(box->x1, x),
                 LANE - lane(box->y1, y));
}

static uint64_t reach(const ktg_net_parts *box, int32_t x, int32_t y) {
    return HIGH | LANES(lane(box->x1, x), lane(box->y1, y), LANE - lane(box->x0, x),
                        LANE - lane(box->y0, y));
}

static bool meet(uint64_t reach, uint64_t extent) {
    return ((reach - extent) & HIGH) == HIGH;
}

/* ---- putting faces ----------------------------------------------------------------------------
 */

/* extent: all lanes 0 meet any box. */
static void put(ktg_net_grid *grid, uint32_t face, int32_t x, int32_t y, uint64_t extent) {
    uint64_t cell = cell_number(grid->level[face], x, y);
    uint32_t *number = &grid->block_of[face];
    if (*number != KTG_NONE && grid->blocks[*number].cell == cell) {
        ktg_net_block *block = &grid->blocks[*number];
        block->boxes[slot_of(block, face)] = extent;
        return;
    }
    if (*number != KTG_NONE)
        take_out(grid, face);
    *number = find_room(grid, cell);
    ktg_net_block *block = &grid->blocks[*number];
    block->boxes[block->count] = extent;
    block->faces[block->count++] = face;
}

void ktg_net_grid_put(ktg_net_grid *grid, uint32_t face, ktg_vec2 centre) {
    double scale = grid->cells_per_unit[grid->level[face]];
    put(grid, face, round_down(centre.x * scale), round_down(centre.y * scale), 0);
}

void ktg_net_grid_put_face(ktg_net_grid *grid, uint32_t face, const ktg_vec2 corners[3]) {
    ktg_net_box box = ktg_net_box_of(corners);
    double scale = grid->cells_per_unit[grid->level[face]];
    ktg_net_parts parts = parts_of(&box, scale);
    int32_t x = round_down(0.5 * (box.low.x + box.high.x) * scale);
    int32_t y = round_down(0.5 * (box.low.y + box.high.y) * scale);
    put(grid, face, x, y, extent(&parts, x, y));
}

/* ---- walking ----------------------------------------------------------------------------------
 */

static double least_of(double a, double b, double c) {
    double m = a < b ? a : b;
    return m < c ? m : c;
}

static double most_of(double a, double b, double c) {
    double m = a > b ? a : b;
    return m > c ? m : c;
}

ktg_net_box ktg_net_box_of(const ktg_vec2 c[3]) {
    return (ktg_net_box){{least_of(c[0].x, c[1].x, c[2].x), least_of(c[0].y, c[1].y, c[2].y)},
                         {most_of(c[0].x, c[1].x, c[2].x), most_of(c[0].y, c[1].y, c[2].y)}};
}

/* True when looking into every cell of the range costs more than looking at every face of the
 * level: a large face over small cells. */
static bool is_wide(const ktg_net_range *range, uint32_t faces) {
    double columns = (double)range->x1 - range->x0 + 1, rows = (double)range->y1 - range->y0 + 1;
    return columns * rows > faces;
}

static void enter_cell(ktg_net_walk *w) {
    w->cell = cell_number(w->level, w->x, w->y);
    w->block = w->grid->head[bucket_of(w->grid, w->cell)];
    w->slot = 0;
    w->meets = reach(&w->parts, w->x, w->y);
}

/* A face of a level reaches half a cell beyond its centre at most. */
static void find_range(ktg_net_walk *w) {
    double scale = w->grid->cells_per_unit[w->level];
    w->range.x0 = round_down(w->box.low.x * scale - 0.5);
    w->range.y0 = round_down(w->box.low.y * scale - 0.5);
    w->range.x1 = round_down(w->box.high.x * scale + 0.5);
    w->range.y1 = round_down(w->box.high.y * scale + 0.5);
    w->parts = parts_of(&w->box, scale);
}

/* Moves on to the next level that holds faces; false when there is none. */
static bool next_level(ktg_net_walk *w) {
    const ktg_net_grid *grid = w->grid;
    while (++w->level < grid->level_count) {
        uint32_t begin = grid->level_first[w->level], end = grid->level_first[w->level + 1];
        if (begin == end)
            continue;
        find_range(w);
        w->listed = w->listed_end = end;
        w->x = w->range.x0;
        w->y = w->range.y0;
        if (is_wide(&w->range, end - begin)) {
            w->listed = begin;
            w->block = KTG_NONE;
            w->x = w->range.x1;
            w->y = w->range.y1;
        } else {
            enter_cell(w);
        }
        return true;
    }
    return false;
}

static bool next_cell(ktg_net_walk *w) {
    if (++w->x > w->range.x1) {
        w->x = w->range.x0;
        if (++w->y > w->range.y1)
            return next_level(w);
    }
    enter_cell(w);
    return true;
}

bool ktg_net_walk_start(ktg_net_walk *w, const ktg_net_grid *grid, const ktg_vec2 corners[3]) {
    w->grid = grid;
    w->box = ktg_net_box_of(corners);
    w->level = -1;
    return next_level(w);
}

/* The next face of the present bucket; KTG_NONE at its end. */
static uint32_t next_in_bucket(ktg_net_walk *w) {
    while (w->block != KTG_NONE) {
        const ktg_net_block *block = &w->grid->blocks[w->block];
        uint32_t count = block->cell == w->cell ? block->count : 0;
        while (w->slot < count) {
            uint32_t k = w->slot++;
            if (meet(w->meets, block->boxes[k]))
                return block->faces[k];
        }
        w->block = block->next;
        w->slot = 0;
    }
    return KTG_NONE;
}

/* The next face near the box, KTG_NONE at the end. */
uint32_t ktg_net_walk_next(ktg_net_walk *w) {
    for (;;) {
        if (w->listed < w->listed_end)
            return w->grid->by_level[w->listed++];
        uint32_t face = next_in_bucket(w);
        if (face != KTG_NONE)
            return face;
        if (w->level >= w->grid->level_count || !next_cell(w))
            return KTG_NONE;
    }
}
