/* layout/poster.c - what is larger than the paper: one piece over several sheets that overlap. */
#include "layout/poster.h"

#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

/* A tile that shows less of a piece than this is left out; mm2. */
#define LEAST_AREA 1e-6

/* ---- where the tiles lie ------------------------------------------------------------------- */

/* What of a stretch of `count` tiles is the k-th one's own: its neighbour's begins where it ends.
 */
static void own_part(double step, double room, uint32_t k, uint32_t count, double part[2]) {
    part[0] = k * step;
    part[1] = k + 1 == count ? k * step + room : part[0] + step;
}

/* The polygon's part on the side of the line x = at (or y = at) where sign (x - at) is positive
 * (Sutherland & Hodgman 1974). At most half as many points more come out. */
static size_t clip(const ktg_vec2 *in, size_t count, bool along_y, double at, double sign,
                   ktg_vec2 *out) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 a = in[i], b = in[(i + 1) % count];
        double da = sign * ((along_y ? a.y : a.x) - at), db = sign * ((along_y ? b.y : b.x) - at);
        if (da >= 0)
            out[kept++] = a;
        if ((da > 0 && db < 0) || (da < 0 && db > 0))
            out[kept++] = ktg_madd2(a, da / (da - db), ktg_sub2(b, a));
    }
    return kept;
}

static double area_of(const ktg_vec2 *points, size_t count) {
    double twice = 0;
    for (size_t i = 0; i < count; i++)
        twice += ktg_cross2(points[i], points[(i + 1) % count]);
    return fabs(twice) / 2;
}

/* Outlines' worth of points: the placed one, and what four clips in a row can make of it. */
#define WORK (1 + 4 + 3 + 6)

/* Marks the cells in which the placed outline has some area and counts them. Rows are cut off
 * first, cells from them. */
static uint32_t mark_cells(ktg_poster *p, const ktg_vec2 *outline, size_t count, ktg_vec2 *work) {
    ktg_vec2 *low = work, *row = work + 4 * count, *cell = work + 7 * count;
    uint32_t used = 0;
    for (uint32_t r = 0; r < p->rows; r++) {
        double y[2], x[2];
        own_part(p->step.y, p->room.y, p->rows - 1 - r, p->rows, y);
        size_t in_low = clip(outline, count, true, y[0], 1, low);
        size_t in_row = clip(low, in_low, true, y[1], -1, row);
        for (uint32_t c = 0; c < p->columns; c++) {
            own_part(p->step.x, p->room.x, c, p->columns, x);
            size_t in_left = clip(row, in_row, false, x[0], 1, low);
            size_t in_cell = clip(low, in_left, false, x[1], -1, cell);
            bool there = area_of(cell, in_cell) > LEAST_AREA;
            p->used[r * p->columns + c] = there;
            used += there;
        }
    }
    return used;
}

/* One more than are allowed stands for any number beyond. */
static uint32_t tiles_along(double size, double room, double step) {
    double more = ceil((size - room - KTG_LAYOUT_SLACK_MM) / step);
    return more > 0 ? 1 + (uint32_t)fmin(more, KTG_POSTER_TILES) : 1;
}

/* ---- one poster ---------------------------------------------------------------------------- */

static ktg_status too_many(ktg_context *context, const ktg_poster *p, ktg_vec2 size) {
    return ktg_fail(context, KTG_LIMIT,
                    "piece %u of %.0f x %.0f mm would be a poster of more than %d sheets: choose a "
                    "smaller size or a larger sheet",
                    p->piece + 1, size.x, size.y, KTG_POSTER_TILES);
}

/* Puts the turned piece at `at` of the grid; `work` has room for WORK outlines. */
static void lay_at(const ktg_pattern_piece *piece, ktg_vec2 at, ktg_vec2 *work, ktg_poster *p) {
    ktg_motion2 motion = {cos(p->turn.rotation), sin(p->turn.rotation), at};
    size_t count = piece->outline_count;
    for (size_t i = 0; i < count; i++)
        work[i] = ktg_move2(motion, piece->outline[i]);
    p->at = at;
    p->tiles = mark_cells(p, work, count, work + count);
}

/* The turned piece on a grid of sheets, moved by parts of what it leaves free until most of them
 * are empty; in the middle where that is as good. */
static ktg_status lay_turned(ktg_context *context, const ktg_pattern_piece *piece, double rotation,
                             ktg_vec2 *work, ktg_poster *p) {
    static const double parts[] = {0.5, 0, 0.25, 0.75, 1};
    enum { PARTS = sizeof parts / sizeof *parts };
    ktg_turn turn = ktg_turn_points(piece->outline, piece->outline_count, rotation);
    p->turn = turn;
    p->columns = tiles_along(turn.size.x, p->room.x, p->step.x);
    p->rows = tiles_along(turn.size.y, p->room.y, p->step.y);
    if ((double)p->columns * p->rows > KTG_POSTER_TILES)
        return too_many(context, p, turn.size);
    ktg_vec2 slack = {(p->columns - 1) * p->step.x + p->room.x - turn.size.x,
                      (p->rows - 1) * p->step.y + p->room.y - turn.size.y};
    ktg_vec2 best = {0, 0};
    uint32_t fewest = UINT32_MAX;
    for (int k = 0; k < PARTS * PARTS; k++) {
        ktg_vec2 at = {parts[k / PARTS] * slack.x - turn.low.x,
                       parts[k % PARTS] * slack.y - turn.low.y};
        lay_at(piece, at, work, p);
        if (p->tiles < fewest) {
            fewest = p->tiles;
            best = at;
        }
    }
    lay_at(piece, best, work, p);
    return KTG_OK;
}

ktg_status ktg_poster_lay(ktg_context *context, const ktg_pattern *pattern,
                          const ktg_layout_options *options, double overlap_mm, uint32_t index,
                          ktg_poster *p) {
    const ktg_pattern_piece *piece = &pattern->pieces[index];
    ktg_vec2 room = ktg_layout_room(&options->sheet), low, size;
    double rotation = 0;
    *p = (ktg_poster){
        .piece = index, .room = room, .step = {room.x - overlap_mm, room.y - overlap_mm}};
    if (!options->keep_grain)
        KTG_TRY(ktg_smallest_box(context, piece->outline, piece->outline_count, &rotation, &low,
                                 &size));
    ktg_poster other = *p;
    p->used = ktg_new(context, KTG_POSTER_TILES, bool);
    other.used = ktg_new(context, KTG_POSTER_TILES, bool);
    ktg_vec2 *work = ktg_new(context, WORK * piece->outline_count, ktg_vec2);
    ktg_status status = p->used && other.used && work ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = lay_turned(context, piece, rotation, work, p);
    if (status == KTG_OK)
        status = lay_turned(context, piece, rotation + KTG_PI / 2, work, &other);
    ktg_free(work);
    if (status == KTG_OK && other.tiles < p->tiles) {
        ktg_poster swap = *p;
        *p = other;
        other = swap;
    }
    ktg_poster_drop(&other);
    return status;
}

void ktg_poster_drop(ktg_poster *p) {
    ktg_free(p->used);
    p->used = NULL;
}

ktg_status ktg_poster_write(ktg_context *context, const ktg_poster *p,
                            const ktg_sheet_format *format, uint32_t number,
                            ktg_pattern_sheet *sheets) {
    double margin = format->margin_mm;
    for (uint32_t r = 0; r < p->rows; r++)
        for (uint32_t c = 0; c < p->columns; c++) {
            if (!p->used[r * p->columns + c])
                continue;
            ktg_pattern_placement *at = ktg_new(context, 1, ktg_pattern_placement);
            if (!at)
                return KTG_MEMORY;
            *at = (ktg_pattern_placement){p->piece, margin + p->at.x - c * p->step.x,
                                          margin + p->at.y - (p->rows - 1 - r) * p->step.y,
                                          p->turn.rotation};
            *sheets++ = (ktg_pattern_sheet){
                KTG_TILE,
                format->width_mm,
                format->height_mm,
                {margin, margin, format->width_mm - margin, format->height_mm - margin},
                1,
                at,
                number,
                r,
                c};
        }
    return KTG_OK;
}
