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
/* Farther cells are one, so that numbers of cells fit their type. */
#define FARTHEST 1e9

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
    grid->next = ktg_new(context, face_count, uint32_t);
    grid->previous = ktg_new(context, face_count, uint32_t);
    grid->bucket = ktg_new(context, face_count, uint32_t);
    grid->cell = ktg_new(context, 2 * (size_t)face_count, int32_t);
    grid->level = ktg_new(context, face_count, uint8_t);
    grid->level_first = ktg_new(context, MOST_LEVELS + 2, uint32_t);
    grid->by_level = ktg_new(context, face_count, uint32_t);
    if (!grid->head || !grid->next || !grid->previous || !grid->bucket || !grid->cell ||
        !grid->level || !grid->level_first || !grid->by_level) {
        ktg_net_grid_free(grid);
        return KTG_MEMORY;
    }
    memset(grid->head, 0xff, (grid->mask + 1) * sizeof *grid->head);
    memset(grid->bucket, 0xff, face_count * sizeof *grid->bucket);
    choose_levels(sizes, face_count, grid);
    list_levels(grid);
    return KTG_OK;
}

void ktg_net_grid_free(ktg_net_grid *grid) {
    ktg_free(grid->head);
    ktg_free(grid->next);
    ktg_free(grid->previous);
    ktg_free(grid->bucket);
    ktg_free(grid->cell);
    ktg_free(grid->level);
    ktg_free(grid->level_first);
    ktg_free(grid->by_level);
    *grid = (ktg_net_grid){0};
}

static size_t bucket_of(const ktg_net_grid *grid, int level, int32_t x, int32_t y) {
    uint64_t key =
        ((uint64_t)(uint32_t)x << 32 | (uint32_t)y) + (uint64_t)level * 0x632be59bd9b4e019u;
    key *= 0x9e3779b97f4a7c15u;
    return (size_t)(key >> 32) & grid->mask;
}

static int32_t cell_at(const ktg_net_grid *grid, int level, double x) {
    return (int32_t)fmax(-FARTHEST, fmin(FARTHEST, floor(ldexp(x, -(grid->lowest + level)))));
}

static void take_out(ktg_net_grid *grid, uint32_t face) {
    uint32_t next = grid->next[face], previous = grid->previous[face];
    if (previous != KTG_NONE)
        grid->next[previous] = next;
    else
        grid->head[grid->bucket[face]] = next;
    if (next != KTG_NONE)
        grid->previous[next] = previous;
}

void ktg_net_grid_put(ktg_net_grid *grid, uint32_t face, ktg_vec2 centre) {
    int level = grid->level[face];
    int32_t x = cell_at(grid, level, centre.x), y = cell_at(grid, level, centre.y);
    if (grid->bucket[face] != KTG_NONE)
        take_out(grid, face);
    size_t bucket = bucket_of(grid, level, x, y);
    grid->cell[2 * face] = x;
    grid->cell[2 * face + 1] = y;
    grid->bucket[face] = (uint32_t)bucket;
    grid->previous[face] = KTG_NONE;
    grid->next[face] = grid->head[bucket];
    if (grid->head[bucket] != KTG_NONE)
        grid->previous[grid->head[bucket]] = face;
    grid->head[bucket] = face;
}

/* A face of this level reaches half a cell beyond its centre at most. */
static ktg_net_range range_of(const ktg_net_grid *grid, int level, ktg_vec2 low, ktg_vec2 high) {
    double half = ldexp(0.5, grid->lowest + level);
    return (ktg_net_range){cell_at(grid, level, low.x - half), cell_at(grid, level, low.y - half),
                           cell_at(grid, level, high.x + half),
                           cell_at(grid, level, high.y + half)};
}

static uint32_t head_of(const ktg_net_grid *grid, int level, int32_t x, int32_t y) {
    return grid->head[bucket_of(grid, level, x, y)];
}

ktg_net_box ktg_net_box_of(const ktg_vec2 c[3]) {
    return (ktg_net_box){{fmin(c[0].x, fmin(c[1].x, c[2].x)), fmin(c[0].y, fmin(c[1].y, c[2].y))},
                         {fmax(c[0].x, fmax(c[1].x, c[2].x)), fmax(c[0].y, fmax(c[1].y, c[2].y))}};
}

/* True when looking into every cell of the range costs more than looking at every face of the
 * level: a large face over small cells. */
static bool is_wide(const ktg_net_walk *w, uint32_t faces) {
    double columns = (double)w->range.x1 - w->range.x0 + 1,
           rows = (double)w->range.y1 - w->range.y0 + 1;
    return columns * rows > faces;
}

/* Moves on to the next level that holds faces; false when there is none. */
static bool next_level(ktg_net_walk *w) {
    const ktg_net_grid *grid = w->grid;
    while (++w->level < grid->level_count) {
        uint32_t begin = grid->level_first[w->level], end = grid->level_first[w->level + 1];
        if (begin == end)
            continue;
        w->range = range_of(grid, w->level, w->box.low, w->box.high);
        w->listed = w->listed_end = end;
        w->face = KTG_NONE;
        if (is_wide(w, end - begin)) {
            w->listed = begin;
            w->x = w->range.x1;
            w->y = w->range.y1;
            return true;
        }
        w->x = w->range.x0;
        w->y = w->range.y0;
        w->face = head_of(grid, w->level, w->x, w->y);
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
    w->face = head_of(w->grid, w->level, w->x, w->y);
    return true;
}

bool ktg_net_walk_start(ktg_net_walk *w, const ktg_net_grid *grid, const ktg_vec2 corners[3]) {
    *w = (ktg_net_walk){.grid = grid, .box = ktg_net_box_of(corners), .level = -1};
    return next_level(w);
}

/* The next face near the box, KTG_NONE at the end. */
uint32_t ktg_net_walk_next(ktg_net_walk *w) {
    for (;;) {
        if (w->listed < w->listed_end)
            return w->grid->by_level[w->listed++];
        while (w->face != KTG_NONE) {
            uint32_t face = w->face;
            w->face = w->grid->next[face];
            if (w->grid->cell[2 * face] == w->x && w->grid->cell[2 * face + 1] == w->y &&
                w->grid->level[face] == w->level)
                return face;
        }
        if (w->level >= w->grid->level_count || !next_cell(w))
            return KTG_NONE;
    }
}
