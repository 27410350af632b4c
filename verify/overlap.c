/* verify/overlap.c - which convex polygons of the plane overlap, by a grid for the candidates and
 * separating axes for the depth.
 *
 * The depth of two convex polygons is the length of the smallest translation that parts them; it is
 * along a normal of one of their edges. Polygons without area (lines, points) are welcome. */
#include "core/memory.h"
#include "verify/check.h"

#include <string.h>

#define MOST_SIDE  65536 /* cells along one side of the grid */
#define MOST_CELLS 4     /* for each shape */
#define MOST_FOUND 10000 /* a heap of faces has a pair for each two: enough is enough */

/* ---- shapes ------------------------------------------------------------------------------- */

ktg_status ktg_check_add_shape(ktg_context *context, ktg_check_shapes *shapes,
                               const ktg_vec2 *points, uint32_t count, uint32_t group,
                               uint32_t number, bool tab) {
    KTG_TRY(ktg_reserve(context, &shapes->shapes, &shapes->count_capacity, shapes->count + 1));
    KTG_TRY(ktg_reserve(context, &shapes->points, &shapes->point_capacity,
                        shapes->point_count + count));
    memcpy(shapes->points + shapes->point_count, points, count * sizeof *points);
    shapes->shapes[shapes->count++] =
        (ktg_check_shape){shapes->point_count, count, group, number, tab};
    shapes->point_count += count;
    return KTG_OK;
}

void ktg_check_clear_shapes(ktg_check_shapes *shapes) {
    shapes->count = 0;
    shapes->point_count = 0;
}

void ktg_check_free_shapes(ktg_check_shapes *shapes) {
    ktg_free(shapes->shapes);
    ktg_free(shapes->points);
    memset(shapes, 0, sizeof *shapes);
}

/* ---- depth -------------------------------------------------------------------------------- */

typedef struct range {
    double low, high;
} range;

static range project(const ktg_vec2 *points, uint32_t count, ktg_vec2 origin, ktg_vec2 axis) {
    range r = {INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        double d = ktg_dot2(ktg_sub2(points[i], origin), axis);
        r.low = d < r.low ? d : r.low;
        r.high = d > r.high ? d : r.high;
    }
    return r;
}

/* The least of `depth` and the overlaps along the normals of a's edges. */
static double depth_along(const ktg_vec2 *a, uint32_t a_count, const ktg_vec2 *b, uint32_t b_count,
                          double depth) {
    for (uint32_t i = 0; i < a_count && depth > 0; i++) {
        ktg_vec2 edge = ktg_sub2(a[i + 1 < a_count ? i + 1 : 0], a[i]);
        double length = ktg_length2(edge);
        if (!(length > 0))
            continue;
        ktg_vec2 axis = ktg_mul2(ktg_perp2(edge), 1 / length);
        range p = project(a, a_count, a[i], axis), q = project(b, b_count, a[i], axis);
        depth = fmin(depth, fmin(p.high - q.low, q.high - p.low));
    }
    return depth;
}

static double depth_of(const ktg_check_shapes *shapes, const ktg_check_shape *a,
                       const ktg_check_shape *b) {
    const ktg_vec2 *p = shapes->points + a->first, *q = shapes->points + b->first;
    double depth = depth_along(p, a->count, q, b->count, INFINITY);
    depth = depth_along(q, b->count, p, a->count, depth);
    return depth > 0 && isfinite(depth) ? depth : 0; /* infinite: both are points */
}

/* ---- the grid ----------------------------------------------------------------------------- */

typedef struct box {
    ktg_vec2 low, high;
} box;

typedef struct grid {
    const ktg_check_shapes *shapes;
    box *boxes; /* of each shape */
    ktg_vec2 low;
    ktg_vec2 cell; /* its width and height */
    uint32_t columns, rows;
    size_t *first; /* columns * rows + 1: where a cell's shapes start in `entries` */
    uint32_t *entries;
    uint32_t *stamp; /* of each shape: the last one it was compared with, plus 1 */
} grid;

/* Called for each cell a shape touches. */
typedef void cell_visitor(grid *g, size_t cell, uint32_t shape, void *user);

static box box_of(const ktg_check_shapes *shapes, const ktg_check_shape *s) {
    box b = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < s->count; i++) {
        ktg_vec2 p = shapes->points[s->first + i];
        b.low = (ktg_vec2){fmin(b.low.x, p.x), fmin(b.low.y, p.y)};
        b.high = (ktg_vec2){fmax(b.high.x, p.x), fmax(b.high.y, p.y)};
    }
    return b;
}

static uint32_t cell_index(double offset, double cell, uint32_t count) {
    double k = floor(offset / cell);
    return k <= 0 ? 0 : k >= count - 1.0 ? count - 1 : (uint32_t)k;
}

/* The stretch of x that a polygon covers between two heights; empty: low > high. */
static range stretch(const ktg_vec2 *points, uint32_t count, double bottom, double top) {
    range r = {INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        ktg_vec2 a = points[i], b = points[i + 1 < count ? i + 1 : 0];
        if (a.y > b.y) {
            ktg_vec2 swap = a;
            a = b;
            b = swap;
        }
        if (a.y > top || b.y < bottom)
            continue;
        double rise = b.y - a.y;
        double from = rise > 0 && a.y < bottom ? (bottom - a.y) / rise : 0;
        double to = rise > 0 && b.y > top ? (top - a.y) / rise : 1;
        double x0 = a.x + from * (b.x - a.x), x1 = a.x + to * (b.x - a.x);
        r.low = fmin(r.low, fmin(x0, x1));
        r.high = fmax(r.high, fmax(x0, x1));
    }
    return r;
}

/* Row by row, so that a long slanting needle touches few cells. Cells are taken a little larger
 * than they are, against rounding. */
static void visit_cells(grid *g, uint32_t shape, cell_visitor *visit, void *user) {
    const ktg_check_shape *s = &g->shapes->shapes[shape];
    const ktg_vec2 *points = g->shapes->points + s->first;
    ktg_vec2 margin = ktg_mul2(g->cell, 1e-6);
    uint32_t r0 = cell_index(g->boxes[shape].low.y - margin.y - g->low.y, g->cell.y, g->rows);
    uint32_t r1 = cell_index(g->boxes[shape].high.y + margin.y - g->low.y, g->cell.y, g->rows);
    for (uint32_t row = r0; row <= r1; row++) {
        double bottom = g->low.y + row * g->cell.y;
        range x = stretch(points, s->count, row == r0 ? -INFINITY : bottom - margin.y,
                          row == r1 ? INFINITY : bottom + g->cell.y + margin.y);
        if (x.low > x.high)
            continue;
        uint32_t c0 = cell_index(x.low - margin.x - g->low.x, g->cell.x, g->columns);
        uint32_t c1 = cell_index(x.high + margin.x - g->low.x, g->cell.x, g->columns);
        for (uint32_t column = c0; column <= c1; column++)
            visit(g, (size_t)row * g->columns + column, shape, user);
    }
}

static void count_entry(grid *g, size_t cell, uint32_t shape, void *user) {
    (void)shape;
    (void)user;
    g->first[cell + 1]++;
}

static void fill_entry(grid *g, size_t cell, uint32_t shape, void *user) {
    size_t *next = user;
    g->entries[next[cell]++] = shape;
}

/* Cells of the size of an average shape, so that a strip of needles lies in a row of narrow ones;
 * not many more cells than shapes. */
static void choose_cells(grid *g) {
    box all = g->boxes[0];
    double n = (double)g->shapes->count;
    ktg_vec2 mean = {0, 0};
    for (size_t i = 0; i < g->shapes->count; i++) {
        const box *b = &g->boxes[i];
        all.low = (ktg_vec2){fmin(all.low.x, b->low.x), fmin(all.low.y, b->low.y)};
        all.high = (ktg_vec2){fmax(all.high.x, b->high.x), fmax(all.high.y, b->high.y)};
        mean = ktg_madd2(mean, 1 / n, ktg_sub2(b->high, b->low));
    }
    ktg_vec2 size = ktg_sub2(all.high, all.low);
    g->low = all.low;
    g->cell = (ktg_vec2){fmax(mean.x, size.x / MOST_SIDE), fmax(mean.y, size.y / MOST_SIDE)};
    if (!(g->cell.x > 0))
        g->cell.x = 1;
    if (!(g->cell.y > 0))
        g->cell.y = 1;
    double cells = size.x / g->cell.x * (size.y / g->cell.y);
    if (cells > MOST_CELLS * n)
        g->cell = ktg_mul2(g->cell, sqrt(cells / (MOST_CELLS * n)));
    g->columns = (uint32_t)(size.x / g->cell.x) + 1;
    g->rows = (uint32_t)(size.y / g->cell.y) + 1;
}

static ktg_status fill_grid(ktg_context *context, grid *g) {
    size_t cells = (size_t)g->columns * g->rows;
    g->first = ktg_new(context, cells + 1, size_t);
    size_t *next = ktg_new(context, cells, size_t);
    if (!g->first || !next) {
        ktg_free(next);
        return KTG_MEMORY;
    }
    for (uint32_t i = 0; i < g->shapes->count; i++)
        visit_cells(g, i, count_entry, NULL);
    for (size_t i = 0; i < cells; i++) {
        g->first[i + 1] += g->first[i];
        next[i] = g->first[i];
    }
    g->entries = ktg_new(context, g->first[cells], uint32_t);
    for (uint32_t i = 0; g->entries && i < g->shapes->count; i++)
        visit_cells(g, i, fill_entry, next);
    ktg_free(next);
    return g->entries ? KTG_OK : KTG_MEMORY;
}

/* ---- pairs -------------------------------------------------------------------------------- */

typedef struct search {
    ktg_check *check;
    ktg_check_overlap_found *found;
    void *user;
    size_t count; /* found so far */
} search;

static bool boxes_apart(const box *a, const box *b) {
    return a->high.x <= b->low.x || b->high.x <= a->low.x || a->high.y <= b->low.y ||
           b->high.y <= a->low.y;
}

static void compare(grid *g, search *s, uint32_t i, uint32_t j) {
    const ktg_check_shape *a = &g->shapes->shapes[i], *b = &g->shapes->shapes[j];
    if ((g->shapes->by_group && a->group == b->group) || boxes_apart(&g->boxes[i], &g->boxes[j]))
        return;
    double depth = depth_of(g->shapes, a, b);
    s->check->report->deepest_overlap_mm =
        fmax(s->check->report->deepest_overlap_mm, depth / s->check->mm);
    if (!(depth > KTG_VERIFY_DEPTH * s->check->mm))
        return;
    s->count++;
    s->found(s->check, a, b, depth / s->check->mm, s->user);
}

/* Compares a shape with the later ones of one cell, each once. */
static void compare_in_cell(grid *g, size_t cell, uint32_t shape, void *user) {
    const search *s = user;
    for (size_t k = g->first[cell]; k < g->first[cell + 1] && s->count < MOST_FOUND; k++) {
        uint32_t other = g->entries[k];
        if (other <= shape || g->stamp[other] == shape + 1)
            continue;
        g->stamp[other] = shape + 1;
        compare(g, user, shape, other);
    }
}

static ktg_status search_grid(ktg_context *context, grid *g, search *s) {
    g->boxes = ktg_new(context, g->shapes->count, box);
    g->stamp = ktg_new(context, g->shapes->count, uint32_t);
    if (!g->boxes || !g->stamp)
        return KTG_MEMORY;
    for (size_t i = 0; i < g->shapes->count; i++)
        g->boxes[i] = box_of(g->shapes, &g->shapes->shapes[i]);
    choose_cells(g);
    KTG_TRY(fill_grid(context, g));
    for (uint32_t i = 0; i < g->shapes->count && s->count < MOST_FOUND; i++) {
        if (i % 1024 == 0)
            KTG_TRY(ktg_check_cancel(context));
        visit_cells(g, i, compare_in_cell, s);
    }
    return KTG_OK;
}

ktg_status ktg_check_overlaps(ktg_check *check, const ktg_check_shapes *shapes,
                              ktg_check_overlap_found *found, void *user) {
    grid g = {.shapes = shapes};
    search s = {check, found, user, 0};
    if (shapes->count < 2)
        return KTG_OK;
    ktg_status status = search_grid(check->context, &g, &s);
    ktg_free(g.boxes);
    ktg_free(g.stamp);
    ktg_free(g.first);
    ktg_free(g.entries);
    return status;
}
