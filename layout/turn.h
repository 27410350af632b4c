/* layout/turn.h - a piece's outline turned, and the box around it (layout only). */
#ifndef KTG_LAYOUT_TURN_H
#define KTG_LAYOUT_TURN_H

#include "layout/layout.h"

/* How far a box may reach over the printable area: what rounding costs a piece scaled to fit it
 * exactly. */
#define KTG_LAYOUT_SLACK_MM 1e-7

/* The outline turned by `rotation` lies in [low, low + size]. */
typedef struct ktg_turn {
    double rotation;
    ktg_vec2 low, size;
} ktg_turn;

/* The box of `count` points (at least 1) turned by `rotation` about the origin. */
ktg_turn ktg_turn_points(const ktg_vec2 *points, size_t count, double rotation);

/* True when the turned outline fits a width x height rectangle (with the slack). */
bool ktg_turn_fits(const ktg_turn *turn, ktg_vec2 room);

/* The turn that leaves the most room around the piece in a rectangle of size `room`; no turn at all
 * with keep_grain. */
KTG_NODISCARD ktg_status ktg_turn_for_most_room(ktg_context *context,
                                                const ktg_pattern_piece *piece, ktg_vec2 room,
                                                bool keep_grain, ktg_turn *turn);

/* The turn that needs the smallest box, with the box's longer side across the sheet or up; where
 * only the other way fits `room` that one, and where neither does, the turn with the most room. */
KTG_NODISCARD ktg_status ktg_turn_for_rows(ktg_context *context, const ktg_pattern_piece *piece,
                                           ktg_vec2 room, bool keep_grain, bool longer_up,
                                           ktg_turn *turn);

/* Says that `piece` (an index), turned by `turn` at best, is larger than the sheet, and at which
 * scale every piece would fit. Always a failure. */
ktg_status ktg_layout_too_large(ktg_context *context, const ktg_pattern *pattern,
                                const ktg_layout_options *options, size_t piece,
                                const ktg_turn *turn);

/* The rows of several pieces: turns[i] and boxes[i] (both piece_count) of piece i. */
KTG_NODISCARD ktg_status ktg_layout_rows(ktg_context *context, const ktg_pattern *pattern,
                                         const ktg_layout_options *options, ktg_turn *turns,
                                         ktg_row_box *boxes, uint32_t *sheet_count);

/* What the margins leave of a sheet; may be negative. */
static inline ktg_vec2 ktg_layout_room(const ktg_sheet_format *sheet) {
    return (ktg_vec2){sheet->width_mm - 2 * sheet->margin_mm,
                      sheet->height_mm - 2 * sheet->margin_mm};
}

#endif
