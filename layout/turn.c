/* layout/turn.c - how a piece is turned before it is laid down. */
#include "layout/turn.h"

#include "core/memory.h"
#include "core/vec.h"

ktg_turn ktg_turn_points(const ktg_vec2 *points, size_t count, double rotation) {
    ktg_motion2 turn = {cos(rotation), sin(rotation), {0, 0}};
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 p = ktg_move2(turn, points[i]);
        low = (ktg_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    return (ktg_turn){rotation, low, ktg_sub2(high, low)};
}

bool ktg_turn_fits(const ktg_turn *turn, ktg_vec2 room) {
    return turn->size.x <= room.x + KTG_LAYOUT_SLACK_MM &&
           turn->size.y <= room.y + KTG_LAYOUT_SLACK_MM;
}

ktg_status ktg_turn_for_most_room(ktg_context *context, const ktg_pattern_piece *piece,
                                  ktg_vec2 room, bool keep_grain, ktg_turn *turn) {
    double rotation = 0, magnification;
    ktg_vec2 low;
    if (!keep_grain)
        KTG_TRY(ktg_best_fit(context, piece->outline, piece->outline_count, room.x, room.y,
                             &rotation, &low, &magnification));
    *turn = ktg_turn_points(piece->outline, piece->outline_count, rotation);
    return KTG_OK;
}

ktg_status ktg_turn_for_rows(ktg_context *context, const ktg_pattern_piece *piece, ktg_vec2 room,
                             bool keep_grain, bool longer_up, ktg_turn *turn) {
    double rotation;
    ktg_vec2 low, size;
    if (keep_grain)
        return ktg_turn_for_most_room(context, piece, room, true, turn);
    KTG_TRY(
        ktg_smallest_box(context, piece->outline, piece->outline_count, &rotation, &low, &size));
    if ((size.y > size.x) != longer_up)
        rotation += KTG_PI / 2;
    *turn = ktg_turn_points(piece->outline, piece->outline_count, rotation);
    if (ktg_turn_fits(turn, room))
        return KTG_OK;
    *turn = ktg_turn_points(piece->outline, piece->outline_count, rotation + KTG_PI / 2);
    if (ktg_turn_fits(turn, room))
        return KTG_OK;
    return ktg_turn_for_most_room(context, piece, room, false, turn);
}
