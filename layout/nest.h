/* layout/nest.h - polygons into each other's bays: true-shape nesting (layout only).
 *
 * It knows polygons only. Bins are rectangles that lie along x: x runs over a bin's length, y over
 * its width. What is minimised is the total length: all bins but the last are used in full, the
 * last one from x = 0 as far as needed. One bin without an end is a strip, or a roll. */
#ifndef KTG_LAYOUT_NEST_H
#define KTG_LAYOUT_NEST_H

#include "core/core.h"

/* A polygon to be laid down, perhaps several times. All arrays are borrowed. */
typedef struct ktg_nest_shape {
    const ktg_vec2 *outline; /* outline_count: what stays inside the bin, and is proven apart */
    size_t outline_count;
    const ktg_vec2 *cover; /* cover_count: a simple polygon around everything nearer to the outline
                              than half the gap; covers do not touch */
    size_t cover_count;
    const double *turns; /* turn_count, radians; none: any turn is allowed */
    size_t turn_count;
} ktg_nest_shape;

/* Where an item lies: turned about its origin, counter-clockwise, then moved; x and y from the
 * bin's corner. */
typedef struct ktg_nest_place {
    uint32_t bin;
    double x, y, turn;
} ktg_nest_place;

typedef struct ktg_nest_problem {
    const ktg_nest_shape *shapes; /* shape_count */
    size_t shape_count;
    const uint32_t *items; /* item_count: which shape each is */
    size_t item_count;
    double width, length; /* of a bin; length may be infinite */
    double gap;           /* between outlines; 0: they may touch */
    double enough;        /* the search ends once the total length is no more than this */
    uint64_t work;        /* how long to search, in evaluated positions; 0: not at all */
    double seconds;       /* an upper bound; 0: none */
} ktg_nest_problem;

typedef struct ktg_nest_report {
    double length;    /* total */
    uint64_t work;    /* spent */
    uint32_t records; /* how often something better was found */
} ktg_nest_report;

/* `places` (item_count) hold a placement without overlaps and leave with the best one that was
 * found: proven free of overlaps with ktg_nest_apart, or as it came. A cancel callback that says
 * KTG_FINISH ends the search with the best so far. */
KTG_NODISCARD ktg_status ktg_nest(ktg_context *context, const ktg_nest_problem *problem,
                                  ktg_nest_place *places, ktg_nest_report *report);

/* True when the interiors of two polygons have no point in common and, for a gap above 0, no two
 * points of them are nearer than the gap (less 1e-9 of it). Touching is allowed without a gap.
 * Polygons may be weakly simple and run either way round. Exact for the coordinates given, but for
 * distances, which are rounded. */
bool ktg_nest_apart(const ktg_vec2 *a, size_t a_count, const ktg_vec2 *b, size_t b_count,
                    double gap);

#endif
