/* layout/cover.c - a simple polygon with few corners around a piece and half the gap. */
#include "layout/pieces.h"

#include "core/memory.h"
#include "core/vec.h"
#include "pattern/offset.h"

#include <string.h>

/* What a cover may reach further out than it must, at first, and for outlines with many corners. */
#define LEAST_EXCESS_MM 0.05
#define MOST_EXCESS_MM  0.8
#define MANY_CORNERS    60

static double distance_to_side(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a), v = ktg_sub2(p, a);
    double n = ktg_dot2(d, d), t = n > 0 ? fmin(1, fmax(0, ktg_dot2(v, d) / n)) : 0;
    return ktg_length2(ktg_madd2(v, -t, d));
}

/* The corner between `first` and `last` that is furthest from the line between them. */
static size_t furthest(const ktg_vec2 *points, size_t count, size_t first, size_t last,
                       double *distance) {
    size_t at = first;
    *distance = -1;
    for (size_t i = first + 1; i < last; i++) {
        double d = distance_to_side(points[i], points[first], points[last % count]);
        if (d > *distance) {
            *distance = d;
            at = i;
        }
    }
    return at;
}

/* Marks the corners that are needed to stay within `near` of the walk from first to last (Ramer
 * 1972, Douglas & Peucker 1973); `stack` has room for 2 count. */
static void mark_needed(const ktg_vec2 *points, size_t count, size_t first, size_t last,
                        double near, size_t *stack, bool *needed) {
    size_t top = 0;
    stack[top++] = first;
    stack[top++] = last;
    while (top > 0) {
        size_t end = stack[--top], start = stack[--top];
        double distance;
        size_t at = furthest(points, count, start, end, &distance);
        if (!(distance > near))
            continue;
        needed[at] = true;
        stack[top++] = start;
        stack[top++] = at;
        stack[top++] = at;
        stack[top++] = end;
    }
}

/* Leaves out corners, in place; what is left lies within `near` of what was there. */
static ktg_status simplify(ktg_context *context, double near, ktg_vec2 *points, size_t *count) {
    size_t n = *count, far = 0, kept = 0;
    size_t *stack = ktg_new(context, 2 * n + 4, size_t);
    bool *needed = ktg_new(context, n + 1, bool);
    if (stack && needed) {
        for (size_t i = 1; i < n; i++)
            if (ktg_length2(ktg_sub2(points[i], points[0])) >
                ktg_length2(ktg_sub2(points[far], points[0])))
                far = i;
        needed[0] = needed[far] = true;
        mark_needed(points, n, 0, far, near, stack, needed);
        mark_needed(points, n, far, n, near, stack, needed);
        for (size_t i = 0; i < n; i++)
            if (needed[i])
                points[kept++] = points[i];
        *count = kept;
    }
    bool good = stack && needed;
    ktg_free(stack);
    ktg_free(needed);
    return good ? KTG_OK : KTG_MEMORY;
}

/* Grown by `excess` more than it must and simplified within that, so that it stays a cover. */
static ktg_status try_cover(ktg_context *context, const ktg_vec2 *outline, size_t outline_count,
                            double distance, double excess, ktg_vec2 **cover, size_t *count) {
    KTG_TRY(ktg_offset_outward(context, outline, outline_count, distance + excess, cover, count));
    ktg_status status = simplify(context, excess * (1 - 1e-6), *cover, count);
    if (status != KTG_OK) {
        ktg_free(*cover);
        *cover = NULL;
    }
    return status;
}

/* The box around the piece, for outlines that cannot be grown. */
static ktg_status cover_box(ktg_context *context, const ktg_pattern_piece *piece, double distance,
                            ktg_vec2 **cover, size_t *count) {
    ktg_turn box = ktg_turn_points(piece->outline, piece->outline_count, 0);
    double x0 = box.low.x - distance, x1 = box.low.x + box.size.x + distance;
    double y0 = box.low.y - distance, y1 = box.low.y + box.size.y + distance;
    const ktg_vec2 corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    *cover = ktg_copy_array(context, corners, 4, sizeof *corners);
    *count = 4;
    return *cover ? KTG_OK : KTG_MEMORY;
}

ktg_status ktg_layout_cover(ktg_context *context, const ktg_pattern_piece *piece, double gap_mm,
                            ktg_vec2 **cover, size_t *count) {
    *cover = NULL;
    for (double excess = LEAST_EXCESS_MM; excess <= MOST_EXCESS_MM; excess *= 2) {
        ktg_free(*cover);
        ktg_status status = try_cover(context, piece->outline, piece->outline_count, gap_mm / 2,
                                      excess, cover, count);
        if (status == KTG_GEOMETRY)
            return cover_box(context, piece, gap_mm / 2 + excess, cover, count);
        KTG_TRY(status);
        if (*count <= MANY_CORNERS)
            return KTG_OK;
    }
    return KTG_OK;
}
