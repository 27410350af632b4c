/* pattern/corner.h - how the cut runs around a corner of a piece of cloth (pattern only). */
#ifndef KTG_PATTERN_CORNER_H
#define KTG_PATTERN_CORNER_H

#include "pattern/cloth.h"

/* Two edges of the border, in its direction: [0] comes to the corner, [1] leaves it. */
typedef struct ktg_corner {
    ktg_vec2 at;
    ktg_vec2 along[2]; /* unit vectors */
    double width[2];   /* of the allowance, mm */
    double reach[2];   /* how far beyond the corner, along its edge, each strip of cloth may go */
    bool hem[2];       /* turned up along the edge, not sewn to another one */
} ktg_corner;

#define KTG_CORNER_POINTS 8

typedef struct ktg_corner_path {
    ktg_vec2 points[KTG_CORNER_POINTS];
    uint32_t count;
} ktg_corner_path;

/* Where a + s d meets the line through b along e; not finite where they are parallel. */
ktg_vec2 ktg_meeting_point(ktg_vec2 a, ktg_vec2 d, ktg_vec2 b, ktg_vec2 e);

/* How far beyond the corner there is cloth along the edge of one side: as far as the mitre of a
 * sharp corner reaches, and as much as anybody wants where the border goes on. */
double ktg_corner_reach(const ktg_corner *corner, int side);

/* From the end of the one strip of cloth to the start of the other, crossing itself at a concave
 * corner. */
void ktg_corner_go(const ktg_corner *corner, ktg_corner_path *path);

/* The cut over the mouth of a dart that is folded away: out along one leg, to the dart's middle,
 * back to the other leg. `before`: side 0 is the edge before the dart, at its first mouth; `after`:
 * side 1 is the edge after it, at the second one; legs: unit vectors from mouth to point. False
 * where there is no such shape. */
bool ktg_dart_cap(const ktg_corner *before, const ktg_corner *after, ktg_vec2 leg_in,
                  ktg_vec2 leg_out, ktg_vec2 point, ktg_vec2 cap[3]);

#endif
