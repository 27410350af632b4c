/* pattern/tab_room.h - the room a tab has: a trapezoid that is cut back by obstacles (shared
 * with unfold, which places tabs while it searches; not installed).
 *
 * Everything is said in the edge's own frame: the edge runs from (0, 0) to (length, 0), the tab
 * stands on it, y > 0. Seen from the piece that carries the tab that is outside; moved under the
 * mate's face it is inside: the same numbers in both places. */
#ifndef KTG_PATTERN_TAB_ROOM_H
#define KTG_PATTERN_TAB_ROOM_H

#include "core/vec.h"

/* Corners (left, 0), (right, 0), (right - right_cot height, height), (left + left_cot height,
 * height); cotangents of the flank angles, at least 0. */
typedef struct ktg_trapezoid {
    double left, right, left_cot, right_cot, height;
} ktg_trapezoid;

/* What is asked of a tab, to weigh one trapezoid against another. */
typedef struct ktg_tab_wish {
    double length; /* of the edge */
    double height; /* full height */
    double least;  /* lower ones are no tabs */
} ktg_tab_wish;

/* Parts of an edge that must be covered by a full tab, and by any (docs/print.md). */
#define KTG_TAB_COVER_FULL  0.8
#define KTG_TAB_COVER_LEAST 0.5

/* The most corners an obstacle can have. */
#define KTG_OBSTACLE_CORNERS 8

/* The wished tab on an edge, before anything stands in its way: `inset` from both ends, as high as
 * flanks with the cotangent `cot` allow. */
ktg_trapezoid ktg_trapezoid_wished(double length, double height, double cot, double inset);

/* Counter-clockwise; returns 3 (pointed) or 4. The first corner is the left one of the base. */
uint32_t ktg_trapezoid_corners(const ktg_trapezoid *t, ktg_vec2 corners[4]);

/* Both KTG_TAB_COVER_FULL of the edge and the full height. */
bool ktg_trapezoid_is_full(const ktg_trapezoid *t, const ktg_tab_wish *wish);
/* High enough, and on enough of the edge, to be a tab at all. */
bool ktg_trapezoid_is_tab(const ktg_trapezoid *t, const ktg_tab_wish *wish);
/* Larger is better: 0 .. 0.5 where it is no tab, 1 .. 2.5 where it is. */
double ktg_trapezoid_value(const ktg_trapezoid *t, const ktg_tab_wish *wish);

/* True when the convex obstacle may come nearer than `clearance` (never false when it does). */
bool ktg_trapezoid_meets(const ktg_trapezoid *t, const ktg_vec2 *obstacle, uint32_t corner_count,
                         double clearance);

/* Cuts *t back so that it keeps `clearance` from the convex obstacle (2 .. KTG_OBSTACLE_CORNERS
 * corners), in the way that leaves the most value: a flank leans or moves in, or the top comes
 * down. The part of an obstacle below the edge's line does not count: the face is there. The result
 * lies inside what it was before. */
void ktg_trapezoid_cut(ktg_trapezoid *t, const ktg_tab_wish *wish, const ktg_vec2 *obstacle,
                       uint32_t corner_count, double clearance);

/* True when no part of the convex obstacle above the edge's line is nearer than `clearance`. */
bool ktg_trapezoid_is_clear(const ktg_trapezoid *t, const ktg_vec2 *obstacle, uint32_t corner_count,
                            double clearance);
/* True when both flanks are steep enough to be cut and glued. */
bool ktg_trapezoid_is_gluable(const ktg_trapezoid *t);

/* A line that a tab must keep away from. */
typedef struct ktg_tab_wall {
    ktg_vec2 ends[2];
    double clearance;
} ktg_tab_wall;

/* The best of many triangles that are tabs and keep clear of all walls (tab_low.c); false when
 * there is none. The walls' order is changed. */
bool ktg_trapezoid_search(ktg_trapezoid *room, const ktg_tab_wish *wish, double inset,
                          ktg_tab_wall *walls, uint32_t count);

#endif
