/* layout/rows.c - several pieces in rows of their smallest boxes (Igarashi & Cosgrove 2001). */
#include "layout/turn.h"

#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

/* A way to lay the pieces, and how good it is: fewer sheets, then less height in all. */
typedef struct attempt {
    ktg_turn *turns;
    ktg_row_box *boxes;
    uint32_t sheet_count;
    double height;
} attempt;

/* The heights of the sheets' used parts, added up. The rows of a sheet are stacked from 0, and
 * packing fills one sheet after the other. */
static double used_height(const ktg_row_box *boxes, size_t count, uint32_t sheet_count,
                          double *tops) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        tops[boxes[i].sheet] = fmax(tops[boxes[i].sheet], boxes[i].y + boxes[i].height);
    for (uint32_t s = 0; s < sheet_count; s++)
        sum += tops[s];
    return sum;
}

static ktg_status turn_pieces(ktg_context *context, const ktg_pattern *pattern,
                              const ktg_layout_options *options, bool longer_up, attempt *way) {
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    for (size_t i = 0; i < pattern->piece_count; i++) {
        ktg_turn *turn = &way->turns[i];
        KTG_TRY(ktg_turn_for_rows(context, &pattern->pieces[i], room, options->keep_grain,
                                  longer_up, turn));
        if (!ktg_turn_fits(turn, room))
            return ktg_layout_too_large(context, pattern, options, i, turn);
        way->boxes[i] = (ktg_row_box){turn->size.x, turn->size.y, 0, 0, 0};
    }
    return KTG_OK;
}

static ktg_status pack(ktg_context *context, const ktg_pattern *pattern,
                       const ktg_layout_options *options, bool longer_up, attempt *way) {
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    KTG_TRY(turn_pieces(context, pattern, options, longer_up, way));
    KTG_TRY(ktg_rows_pack(context, room.x + KTG_LAYOUT_SLACK_MM, room.y + KTG_LAYOUT_SLACK_MM,
                          options->gap_mm, way->boxes, pattern->piece_count, &way->sheet_count));
    double *tops = ktg_new(context, way->sheet_count, double);
    if (!tops)
        return KTG_MEMORY;
    way->height = used_height(way->boxes, pattern->piece_count, way->sheet_count, tops);
    ktg_free(tops);
    return KTG_OK;
}

static bool better(const attempt *a, const attempt *b) {
    if (a->sheet_count != b->sheet_count)
        return a->sheet_count < b->sheet_count;
    return a->height < b->height;
}

ktg_status ktg_layout_rows(ktg_context *context, const ktg_pattern *pattern,
                           const ktg_layout_options *options, ktg_turn *turns, ktg_row_box *boxes,
                           uint32_t *sheet_count) {
    size_t count = pattern->piece_count;
    attempt across = {turns, boxes, 0, 0};
    attempt up = {ktg_new(context, count, ktg_turn), ktg_new(context, count, ktg_row_box), 0, 0};
    ktg_status status = up.turns && up.boxes ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = pack(context, pattern, options, false, &across);
    if (status == KTG_OK && !options->keep_grain)
        status = pack(context, pattern, options, true, &up);
    if (status == KTG_OK && !options->keep_grain && better(&up, &across)) {
        memcpy(turns, up.turns, count * sizeof *turns);
        memcpy(boxes, up.boxes, count * sizeof *boxes);
        across.sheet_count = up.sheet_count;
    }
    *sheet_count = across.sheet_count;
    ktg_free(up.turns);
    ktg_free(up.boxes);
    return status;
}
