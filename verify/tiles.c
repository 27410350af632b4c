/* verify/tiles.c - the tiles of a poster together show all of their piece, without a gap. */
#include "core/memory.h"
#include "verify/check.h"

/* A convex polygon clipped by the four sides of some tiles: one corner more for each side. */
#define MOST_CORNERS 24
/* No face or tab is cut by more tiles; the rest of it counts as unseen. */
#define MOST_CUTS 500
/* Less than this of a face or tab may be on no tile, mm2: what rounding leaves. */
#define LEAST_AREA 1e-6

/* One place of the piece: the tile's printable rectangle, in whose frame the piece is moved. */
typedef struct window {
    ktg_motion2 motion;
    const double *printable;
} window;

typedef struct polygon {
    size_t count;
    ktg_vec2 points[MOST_CORNERS];
} polygon;

/* How far a point of the piece is inside side `side` (left, right, bottom, top) of the window. */
static double inside(const window *w, int side, ktg_vec2 p) {
    ktg_vec2 at = ktg_move2(w->motion, p);
    const double *r = w->printable;
    double depths[4] = {at.x - r[0], r[2] - at.x, at.y - r[1], r[3] - at.y};
    return depths[side];
}

/* The part of `from` inside (sign 1) or outside (sign -1) of a window's side. */
static void part_of(const polygon *from, const window *w, int side, double sign, polygon *part) {
    part->count = 0;
    for (size_t i = 0; i < from->count && part->count + 2 <= MOST_CORNERS; i++) {
        ktg_vec2 a = from->points[i], b = from->points[(i + 1) % from->count];
        double da = sign * inside(w, side, a), db = sign * inside(w, side, b);
        if (da >= 0)
            part->points[part->count++] = a;
        if ((da > 0 && db < 0) || (da < 0 && db > 0))
            part->points[part->count++] = ktg_madd2(a, da / (da - db), ktg_sub2(b, a));
    }
}

/* False when the polygon is wholly beside the window. */
static bool meets(const polygon *p, const window *w) {
    for (int side = 0; side < 4; side++) {
        bool any = false;
        for (size_t i = 0; i < p->count && !any; i++)
            any = inside(w, side, p->points[i]) > 0;
        if (!any)
            return false;
    }
    return true;
}

/* The area of the polygon that no window shows: what lies beside one is looked for in those that
 * follow. `cuts` have been made already. */
static double unseen(const polygon *p, const window *windows, uint32_t count, int cuts) {
    double area = fabs(ktg_check_area2(p->points, p->count)) / 2, missing = 0;
    if (p->count < 3 || area <= LEAST_AREA / 16)
        return 0;
    while (count > 0 && !meets(p, windows)) {
        windows++;
        count--;
    }
    if (count == 0 || cuts == MOST_CUTS)
        return area;
    polygon left = *p, beside, within;
    for (int side = 0; side < 4; side++) {
        part_of(&left, windows, side, -1, &beside);
        part_of(&left, windows, side, 1, &within);
        missing += unseen(&beside, windows + 1, count - 1, cuts + 1);
        left = within;
    }
    return missing;
}

static bool is_seen(ktg_vec2 p, const window *windows, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        double depth = INFINITY;
        for (int side = 0; side < 4; side++)
            depth = fmin(depth, inside(&windows[k], side, p));
        if (depth >= -KTG_VERIFY_TOUCH)
            return true;
    }
    return false;
}

/* Where the piece lies on tiles, all in one turn. */
static uint32_t find_windows(ktg_check *check, uint32_t piece, window *windows) {
    uint32_t count = 0;
    double rotation = 0;
    bool turned = false;
    for (size_t s = 0; s < check->pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &check->pattern->sheets[s];
        for (size_t i = 0; sheet->kind == KTG_TILE && i < sheet->placement_count; i++) {
            const ktg_pattern_placement *at = &sheet->placements[i];
            if (at->piece != piece)
                continue;
            turned = turned || (count > 0 && at->rotation != rotation);
            rotation = at->rotation;
            windows[count++] =
                (window){{cos(rotation), sin(rotation), {at->x, at->y}}, sheet->printable};
        }
    }
    if (turned)
        ktg_check_problem(check, "The tiles of piece %u hold it in different turns.", piece + 1);
    return count;
}

static void check_piece(ktg_check *check, uint32_t piece, const window *windows, uint32_t count) {
    const ktg_pattern_piece *p = &check->pattern->pieces[piece];
    double missing = 0;
    polygon shape = {.count = 0};
    for (size_t f = 0; f < p->face_count; f++) {
        shape.count = ktg_check_drawn_face(p, f, shape.points);
        missing += unseen(&shape, windows, count, 0);
    }
    for (size_t t = 0; t < p->tab_count; t++) {
        shape.count = p->tabs[t].corner_count;
        for (size_t k = 0; k < shape.count; k++)
            shape.points[k] = p->tabs[t].corners[k];
        missing += unseen(&shape, windows, count, 0);
    }
    if (!(missing <= LEAST_AREA))
        ktg_check_problem(check, "%.3g mm2 of piece %u are on none of its tiles.", missing,
                          piece + 1);
    for (size_t i = 0; i < p->outline_count; i++)
        if (!is_seen(p->outline[i], windows, count)) {
            ktg_check_problem(check, "A corner of piece %u's outline is on none of its tiles.",
                              piece + 1);
            return;
        }
}

ktg_status ktg_check_tiles(ktg_check *check, const uint32_t *tiled) {
    for (uint32_t p = 0; p < check->pattern->piece_count; p++) {
        if (tiled[p] == 0)
            continue;
        window *windows = ktg_new(check->context, tiled[p], window);
        if (!windows)
            return KTG_MEMORY;
        check_piece(check, p, windows, find_windows(check, p, windows));
        ktg_free(windows);
    }
    return KTG_OK;
}
