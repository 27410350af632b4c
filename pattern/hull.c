/* pattern/hull.c - the convex hull (Andrew's monotone chain) with exact turns. */
#include "pattern/hull.h"

#include "core/memory.h"
#include "core/predicate.h"
#include "pattern/pattern.h"

#include <stdlib.h>

/* Further out than this, products of two differences would overflow. */
#define MOST 1e150

static int by_place(const void *left, const void *right) {
    const ktg_vec2 *a = left, *b = right;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    return (a->y > b->y) - (a->y < b->y);
}

/* Adds p to the chain that starts at `base`, taking away corners that do not turn left. */
static size_t add_to_chain(ktg_vec2 *hull, size_t base, size_t count, ktg_vec2 p) {
    while (count > base + 1 && ktg_orientation2(hull[count - 2], hull[count - 1], p) <= 0)
        count--;
    hull[count] = p;
    return count + 1;
}

/* The hull of sorted, different points. */
static size_t chains(const ktg_vec2 *points, size_t count, ktg_vec2 *hull) {
    size_t corners = 0;
    for (size_t i = 0; i < count; i++)
        corners = add_to_chain(hull, 0, corners, points[i]);
    size_t lower = corners - 1;
    for (size_t i = count - 1; i-- > 0;)
        corners = add_to_chain(hull, lower, corners, points[i]);
    return corners > 1 ? corners - 1 : corners; /* the last one is the first */
}

ktg_status ktg_hull(ktg_context *context, const ktg_vec2 *points, size_t point_count,
                    ktg_vec2 **hull, size_t *count) {
    *hull = NULL;
    for (size_t i = 0; i < point_count; i++)
        if (!(fabs(points[i].x) <= MOST) || !(fabs(points[i].y) <= MOST))
            return ktg_fail(context, KTG_ARGUMENT, "a point of a piece is not within %g", MOST);
    if (point_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "there are no points to put a box around");
    ktg_vec2 *sorted = ktg_copy_array(context, points, point_count, sizeof *points);
    *hull = ktg_new(context, point_count + 1, ktg_vec2);
    if (!sorted || !*hull) {
        ktg_free(sorted);
        ktg_free(*hull);
        *hull = NULL;
        return KTG_MEMORY;
    }
    qsort(sorted, point_count, sizeof *sorted, by_place);
    size_t different = 1;
    for (size_t i = 1; i < point_count; i++)
        if (by_place(&sorted[different - 1], &sorted[i]) != 0)
            sorted[different++] = sorted[i];
    *count = chains(sorted, different, *hull);
    ktg_free(sorted);
    return KTG_OK;
}
