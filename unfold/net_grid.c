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
/* Looking into a cell costs this part of looking at a face. */
#define COST_OF_CELL 0.5

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
    grid->place = ktg_new(context, face_count, ktg_net_place);
    grid->level = ktg_new(context, face_count, uint8_t);
    grid->cells_per_unit = ktg_new(context, MOST_LEVELS + 1, double);
    grid->level_first = ktg_new(context, MOST_LEVELS + 2, uint32_t);
    grid->by_level = ktg_new(context, face_count, uint32_t);
    if (!grid->head || !grid->place || !grid->level || !grid->cells_per_unit ||
        !grid->level_first || !grid->by_level) {
        ktg_net_grid_free(grid);
        return KTG_MEMORY;
    }
    memset(grid->head, 0xff, (grid->mask + 1) * sizeof *grid->head);
    for (uint32_t f = 0; f < face_count; f++)
        grid->place[f].cell = KTG_NET_NOWHERE;
    choose_levels(sizes, face_count, grid);
    join_levels(sizes, grid);
    for (int level = 0; level < grid->level_count; level++)
        grid->cells_per_unit[level] = ldexp(1, -(grid->lowest + level));
    list_levels(grid);
    return KTG_OK;
}

void ktg_net_grid_free(ktg_net_grid *grid) {
    ktg_free(grid->head);
    ktg_free(grid->place);
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

static void take_out(ktg_net_grid *grid, uint32_t face) {
    const ktg_net_place *place = &grid->place[face];
    if (place->previous != KTG_NONE)
        grid->place[place->previous].next = place->next;
    else
        grid->head[bucket_of(grid, place->cell)] = place->next;
    if (place->next != KTG_NONE)
        grid->place[place->next].previous = place->previous;
}

static void put(ktg_net_grid *grid, uint32_t face, const ktg_flat_box *box, double x, double y) {
    int level = grid->level[face];
    double scale = grid->cells_per_unit[level];
    uint64_t cell = cell_number(level, round_down(x * scale), round_down(y * scale));
    ktg_net_place *place = &grid->place[face];
    place->box = *box;
    if (place->cell == cell)
        return;
    if (place->cell != KTG_NET_NOWHERE)
        take_out(grid, face);
    size_t bucket = bucket_of(grid, cell);
    place->cell = cell;
    place->previous = KTG_NONE;
    place->next = grid->head[bucket];
    if (place->next != KTG_NONE)
        grid->place[place->next].previous = face;
    grid->head[bucket] = face;
}

void ktg_net_grid_put(ktg_net_grid *grid, uint32_t face, ktg_vec2 centre) {
    static const ktg_flat_box everywhere = {-INFINITY, -INFINITY, INFINITY, INFINITY};
    put(grid, face, &everywhere, centre.x, centre.y);
}

void ktg_net_grid_put_face(ktg_net_grid *grid, uint32_t face, const ktg_vec2 corners[3]) {
    ktg_net_box box = ktg_net_box_of(corners);
    ktg_flat_box flat = ktg_flat_box_around(box.low, box.high);
    put(grid, face, &flat, 0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y));
}

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
    w->face = w->grid->head[bucket_of(w->grid, w->cell)];
}

/* A face of a level reaches half a cell beyond its centre at most. */
static void find_range(ktg_net_walk *w) {
    double scale = w->grid->cells_per_unit[w->level];
    w->range.x0 = round_down(w->box.low.x * scale - 0.5);
    w->range.y0 = round_down(w->box.low.y * scale - 0.5);
    w->range.x1 = round_down(w->box.high.x * scale + 0.5);
    w->range.y1 = round_down(w->box.high.y * scale + 0.5);
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
            w->face = KTG_NONE;
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
    w->flat = ktg_flat_box_around(w->box.low, w->box.high);
    w->level = -1;
    return next_level(w);
}

/* The next face near the box, KTG_NONE at the end. */
uint32_t ktg_net_walk_next(ktg_net_walk *w) {
    const ktg_net_place *place = w->grid->place;
    for (;;) {
        while (w->listed < w->listed_end) {
            uint32_t face = w->grid->by_level[w->listed++];
            if (ktg_flat_boxes_meet(&place[face].box, &w->flat))
                return face;
        }
        while (w->face != KTG_NONE) {
            uint32_t face = w->face;
            w->face = place[face].next;
            if (ktg_flat_boxes_meet(&place[face].box, &w->flat) && place[face].cell == w->cell)
                return face;
        }
        if (w->level >= w->grid->level_count || !next_cell(w))
            return KTG_NONE;
    }
}
