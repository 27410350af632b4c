/* layout/place.c - pieces onto sheets: one in the middle, several in rows from the top. */
#include "layout/turn.h"

#include "core/memory.h"
#include "core/vec.h"

void ktg_layout_defaults(ktg_layout_options *options) {
    *options = (ktg_layout_options){.gap_mm = 2, .keep_grain = false};
    ktg_sheet_defaults(&options->sheet);
}

static ktg_status check_sheet(ktg_context *context, const ktg_layout_options *options) {
    const ktg_sheet_format *sheet = &options->sheet;
    if (!(sheet->width_mm > 0) || !(sheet->height_mm > 0) || !isfinite(sheet->width_mm) ||
        !isfinite(sheet->height_mm))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a sheet of %g x %g mm: width and height must be larger than 0",
                        sheet->width_mm, sheet->height_mm);
    if (!(sheet->margin_mm >= 0) || !(options->gap_mm >= 0) || !isfinite(options->gap_mm))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a margin of %g mm and a gap of %g mm: neither may be negative",
                        sheet->margin_mm, options->gap_mm);
    ktg_vec2 room = ktg_layout_room(sheet);
    if (!(room.x > 0) || !(room.y > 0))
        return ktg_fail(context, KTG_GEOMETRY,
                        "margins of %g mm leave nothing of a sheet of %g x %g mm: choose smaller "
                        "margins or a larger sheet",
                        sheet->margin_mm, sheet->width_mm, sheet->height_mm);
    return KTG_OK;
}

static ktg_status check_pieces(ktg_context *context, const ktg_pattern *pattern) {
    if (pattern->piece_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "the pattern has no pieces to lay on a sheet");
    for (size_t i = 0; i < pattern->piece_count; i++)
        if (pattern->pieces[i].outline_count == 0)
            return ktg_fail(context, KTG_ARGUMENT,
                            "piece %zu has no outline: the pattern must be finished before it is "
                            "laid out",
                            i + 1);
    return KTG_OK;
}

/* The area of the faces as they lie in the pieces. */
static double area_of_faces(const ktg_pattern *pattern) {
    double twice = 0;
    for (size_t i = 0; i < pattern->piece_count; i++) {
        const ktg_pattern_piece *piece = &pattern->pieces[i];
        for (size_t f = 0; f < piece->face_count; f++) {
            const uint32_t *c = &piece->corners[3 * f];
            ktg_vec2 a = piece->vertices[c[0]];
            twice += fabs(
                ktg_cross2(ktg_sub2(piece->vertices[c[1]], a), ktg_sub2(piece->vertices[c[2]], a)));
        }
    }
    return twice / 2;
}

static void free_sheets(ktg_pattern_sheet *sheets, size_t count) {
    for (size_t s = 0; sheets && s < count; s++)
        ktg_free(sheets[s].placements);
    ktg_free(sheets);
}

/* Empty sheets of the wanted format, each with room for as many placements as boxes lie on it. */
static ktg_pattern_sheet *make_sheets(ktg_context *context, const ktg_sheet_format *format,
                                      const ktg_row_box *boxes, size_t box_count,
                                      uint32_t sheet_count) {
    ktg_pattern_sheet *sheets = ktg_new(context, sheet_count, ktg_pattern_sheet);
    if (!sheets)
        return NULL;
    for (size_t i = 0; i < box_count; i++)
        sheets[boxes[i].sheet].placement_count++;
    for (uint32_t s = 0; s < sheet_count; s++) {
        double margin = format->margin_mm;
        size_t count = sheets[s].placement_count;
        sheets[s] = (ktg_pattern_sheet){
            KTG_SHEET,
            format->width_mm,
            format->height_mm,
            {margin, margin, format->width_mm - margin, format->height_mm - margin},
            0,
            ktg_new(context, count, ktg_pattern_placement)};
        if (!sheets[s].placements) {
            free_sheets(sheets, sheet_count);
            return NULL;
        }
    }
    return sheets;
}

/* One piece: centred at the turn with the most room. Several: as the rows lie. */
static ktg_status arrange(ktg_context *context, const ktg_pattern *pattern,
                          const ktg_layout_options *options, ktg_turn *turns, ktg_row_box *boxes,
                          uint32_t *sheet_count) {
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    if (pattern->piece_count > 1)
        return ktg_layout_rows(context, pattern, options, turns, boxes, sheet_count);
    KTG_TRY(ktg_turn_for_most_room(context, pattern->pieces, room, options->keep_grain, turns));
    if (!ktg_turn_fits(turns, room))
        return ktg_layout_too_large(context, pattern, options, 0, turns);
    *boxes = (ktg_row_box){turns->size.x, turns->size.y, (room.x - turns->size.x) / 2,
                           (room.y - turns->size.y) / 2, 0};
    *sheet_count = 1;
    return KTG_OK;
}

/* Boxes stand on the floor of the printable area; turned over, the first row is at the top, as one
 * reads, and what is left of a sheet is one strip below. */
static void put_down(const ktg_turn *turns, const ktg_row_box *boxes, size_t count,
                     ktg_pattern_sheet *sheets) {
    for (size_t i = 0; i < count; i++) {
        ktg_pattern_sheet *sheet = &sheets[boxes[i].sheet];
        double top = sheet->printable[3] - boxes[i].y;
        sheet->placements[sheet->placement_count++] =
            (ktg_pattern_placement){(uint32_t)i, sheet->printable[0] + boxes[i].x - turns[i].low.x,
                                    top - turns[i].size.y - turns[i].low.y, turns[i].rotation};
    }
}

static ktg_status place(ktg_context *context, ktg_pattern *pattern,
                        const ktg_layout_options *options, ktg_turn *turns, ktg_row_box *boxes) {
    uint32_t sheet_count = 0;
    KTG_TRY(arrange(context, pattern, options, turns, boxes, &sheet_count));
    ktg_pattern_sheet *sheets =
        make_sheets(context, &options->sheet, boxes, pattern->piece_count, sheet_count);
    if (!sheets)
        return KTG_MEMORY;
    put_down(turns, boxes, pattern->piece_count, sheets);
    free_sheets(pattern->sheets, pattern->sheet_count);
    pattern->sheets = sheets;
    pattern->sheet_count = sheet_count;
    return KTG_OK;
}

ktg_status ktg_layout_place(ktg_context *context, ktg_pattern *pattern,
                            const ktg_layout_options *options, ktg_layout_report *report) {
    ktg_layout_options defaults;
    ktg_layout_defaults(&defaults);
    if (!options)
        options = &defaults;
    KTG_TRY(check_sheet(context, options));
    KTG_TRY(check_pieces(context, pattern));
    ktg_turn *turns = ktg_new(context, pattern->piece_count, ktg_turn);
    ktg_row_box *boxes = ktg_new(context, pattern->piece_count, ktg_row_box);
    ktg_status status =
        turns && boxes ? place(context, pattern, options, turns, boxes) : KTG_MEMORY;
    if (status == KTG_OK && report) {
        ktg_vec2 room = ktg_layout_room(&options->sheet);
        report->sheets = (uint32_t)pattern->sheet_count;
        report->fill = area_of_faces(pattern) / ((double)pattern->sheet_count * room.x * room.y);
    }
    ktg_free(turns);
    ktg_free(boxes);
    return status;
}
