/* layout/place.c - pieces onto sheets: one in the middle, several nested from the top. */
#include "layout/pieces.h"

#include "core/memory.h"
#include "core/vec.h"

void ktg_layout_defaults(ktg_layout_options *options) {
    *options = (ktg_layout_options){.gap_mm = 2, .effort = KTG_EFFORT_NORMAL};
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
    if (options->effort > KTG_EFFORT_BEST || !(options->seconds >= 0))
        return ktg_fail(context, KTG_ARGUMENT, "an effort of %d and a time of %g s make no sense",
                        (int)options->effort, options->seconds);
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

double ktg_layout_face_area(const ktg_pattern_piece *piece) {
    double twice = 0;
    for (size_t f = 0; f < piece->face_count; f++) {
        const uint32_t *c = &piece->corners[3 * f];
        ktg_vec2 a = piece->vertices[c[0]];
        twice += fabs(
            ktg_cross2(ktg_sub2(piece->vertices[c[1]], a), ktg_sub2(piece->vertices[c[2]], a)));
    }
    return piece->on_fold ? twice / 4 : twice / 2; /* half of it is there */
}

static double area_of_faces(const ktg_pattern *pattern) {
    double area = 0;
    for (size_t i = 0; i < pattern->piece_count; i++)
        area += ktg_layout_face_area(&pattern->pieces[i]);
    return area;
}

void ktg_layout_free_sheets(ktg_pattern_sheet *sheets, size_t count) {
    for (size_t s = 0; sheets && s < count; s++)
        ktg_free(sheets[s].placements);
    ktg_free(sheets);
}

/* Empty sheets of the wanted format, each with room for as many placements as pieces lie on it. */
static ktg_pattern_sheet *make_sheets(ktg_context *context, const ktg_layout_options *options,
                                      const ktg_laid *laid, size_t piece_count,
                                      size_t sheet_count) {
    const ktg_sheet_format *format = &options->sheet;
    ktg_pattern_sheet *sheets = ktg_new(context, sheet_count, ktg_pattern_sheet);
    if (!sheets)
        return NULL;
    for (size_t i = 0; i < piece_count; i++)
        sheets[laid[i].sheet].placement_count++;
    for (size_t s = 0; s < sheet_count; s++) {
        double margin = format->margin_mm;
        size_t count = sheets[s].placement_count;
        sheets[s] = (ktg_pattern_sheet){
            options->roll ? KTG_ROLL : KTG_SHEET,
            format->width_mm,
            format->height_mm,
            {margin, margin, format->width_mm - margin, format->height_mm - margin},
            0,
            ktg_new(context, count, ktg_pattern_placement)};
        if (!sheets[s].placements) {
            ktg_layout_free_sheets(sheets, sheet_count);
            return NULL;
        }
    }
    return sheets;
}

/* How far down the sheet's printable area its pieces reach. */
static double used_mm(const ktg_pattern *pattern, const ktg_pattern_sheet *sheet) {
    double lowest = sheet->printable[3];
    for (size_t i = 0; i < sheet->placement_count; i++) {
        const ktg_pattern_placement *at = &sheet->placements[i];
        const ktg_pattern_piece *piece = &pattern->pieces[at->piece];
        ktg_turn turn = ktg_turn_points(piece->outline, piece->outline_count, at->rotation);
        lowest = fmin(lowest, turn.low.y + at->y);
    }
    return sheet->printable[3] - lowest;
}

/* Cuts a sheet from the roll where its pieces end. */
static void cut_off(const ktg_pattern *pattern, ktg_pattern_sheet *sheet) {
    double less = sheet->printable[3] - sheet->printable[1] - used_mm(pattern, sheet);
    less = fmax(0, less);
    sheet->height_mm -= less;
    sheet->printable[3] -= less;
    for (size_t i = 0; i < sheet->placement_count; i++)
        sheet->placements[i].y -= less;
}

/* Boxes stand on the floor of the printable area; turned over, the first row is at the top, as one
 * reads, and what is left of a sheet is one strip below. */
static void from_boxes(const ktg_sheet_format *sheet, const ktg_turn *turns,
                       const ktg_row_box *boxes, size_t count, ktg_laid *laid) {
    double margin = sheet->margin_mm;
    for (size_t i = 0; i < count; i++) {
        double top = sheet->height_mm - margin - boxes[i].y;
        laid[i] = (ktg_laid){boxes[i].sheet,
                             {(uint32_t)i, margin + boxes[i].x - turns[i].low.x,
                              top - turns[i].size.y - turns[i].low.y, turns[i].rotation}};
    }
}

/* One piece: centred at the turn with the most room. */
static ktg_status arrange_one(ktg_context *context, const ktg_pattern *pattern,
                              const ktg_layout_options *options, ktg_turn *turn, ktg_row_box *box) {
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    KTG_TRY(ktg_turn_for_most_room(context, pattern->pieces, room, options->keep_grain, turn));
    if (!ktg_turn_fits(turn, room))
        return ktg_layout_too_large(context, pattern, options, 0, turn);
    *box = (ktg_row_box){turn->size.x, turn->size.y, (room.x - turn->size.x) / 2,
                         (room.y - turn->size.y) / 2, 0};
    return KTG_OK;
}

/* Several, and those on a roll: nested, from rows. */
static ktg_status arrange(ktg_context *context, const ktg_pattern *pattern,
                          const ktg_layout_options *options, ktg_laid *laid,
                          ktg_layout_report *report) {
    size_t count = pattern->piece_count;
    bool is_alone = count == 1 && !options->roll;
    ktg_turn *turns = ktg_new(context, count, ktg_turn);
    ktg_row_box *boxes = ktg_new(context, count, ktg_row_box);
    uint32_t sheet_count;
    ktg_status status = turns && boxes ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = count == 1
                     ? arrange_one(context, pattern, options, turns, boxes)
                     : ktg_layout_rows(context, pattern, options, turns, boxes, &sheet_count);
    if (status == KTG_OK)
        from_boxes(&options->sheet, turns, boxes, count, laid);
    if (status == KTG_OK && !is_alone)
        status = ktg_layout_nest(context, pattern, options, laid, report);
    ktg_free(turns);
    ktg_free(boxes);
    return status;
}

/* Puts the pieces on sheets as they are laid. */
static ktg_status put_down(ktg_context *context, ktg_pattern *pattern,
                           const ktg_layout_options *options, const ktg_laid *laid) {
    size_t sheet_count = 0;
    for (size_t i = 0; i < pattern->piece_count; i++)
        if (laid[i].sheet >= sheet_count)
            sheet_count = (size_t)laid[i].sheet + 1;
    ktg_pattern_sheet *sheets =
        make_sheets(context, options, laid, pattern->piece_count, sheet_count);
    if (!sheets)
        return KTG_MEMORY;
    for (size_t i = 0; i < pattern->piece_count; i++) {
        ktg_pattern_sheet *sheet = &sheets[laid[i].sheet];
        sheet->placements[sheet->placement_count++] = laid[i].at;
    }
    for (size_t s = 0; options->roll && s < sheet_count; s++)
        cut_off(pattern, &sheets[s]);
    ktg_layout_free_sheets(pattern->sheets, pattern->sheet_count);
    pattern->sheets = sheets;
    pattern->sheet_count = sheet_count;
    return KTG_OK;
}

static double printable_area(const ktg_pattern *pattern) {
    double area = 0;
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const double *p = pattern->sheets[s].printable;
        area += (p[2] - p[0]) * (p[3] - p[1]);
    }
    return area;
}

ktg_status ktg_layout_place(ktg_context *context, ktg_pattern *pattern,
                            const ktg_layout_options *options, ktg_layout_report *report) {
    ktg_layout_options defaults;
    ktg_layout_report own = {0};
    ktg_layout_defaults(&defaults);
    if (!options)
        options = &defaults;
    KTG_TRY(check_sheet(context, options));
    KTG_TRY(check_pieces(context, pattern));
    ktg_laid *laid = ktg_new(context, pattern->piece_count, ktg_laid);
    ktg_status status = laid ? arrange(context, pattern, options, laid, &own) : KTG_MEMORY;
    if (status == KTG_OK)
        status = put_down(context, pattern, options, laid);
    if (status == KTG_OK && report) {
        own.sheets = (uint32_t)pattern->sheet_count;
        own.fill = area_of_faces(pattern) / printable_area(pattern);
        own.last_mm = used_mm(pattern, &pattern->sheets[pattern->sheet_count - 1]);
        *report = own;
    }
    ktg_free(laid);
    return status;
}
