/* layout/page.c - one page as large as the pattern needs, for a copy shop. */
#include "layout/turn.h"

#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

/* Rulers of 4 in have room on the page, whatever the pattern. */
#define LEAST_ROOM_MM 110.0

bool ktg_layout_is_page(const ktg_sheet_format *sheet) {
    return isinf(sheet->width_mm);
}

/* ---- how wide it should be ----------------------------------------------------------------- */

/* The box of a piece as it will lie: the smallest one, or that along the grain. */
static ktg_status box_of(ktg_context *context, const ktg_pattern_piece *piece, bool keep_grain,
                         ktg_vec2 *size) {
    ktg_vec2 low;
    double rotation;
    if (!keep_grain)
        return ktg_smallest_box(context, piece->outline, piece->outline_count, &rotation, &low,
                                size);
    *size = ktg_turn_points(piece->outline, piece->outline_count, 0).size;
    return KTG_OK;
}

/* What the boxes hold together, and the width that each of them needs. */
static ktg_status measure(ktg_context *context, const ktg_pattern *pattern,
                          const ktg_layout_options *options, double *area, double *least_width) {
    *area = 0;
    *least_width = 0;
    for (size_t p = 0; p < pattern->piece_count; p++) {
        ktg_vec2 size;
        if (pattern->pieces[p].outline_count == 0)
            continue; /* ktg_layout_place refuses it */
        KTG_TRY(box_of(context, &pattern->pieces[p], options->keep_grain, &size));
        *area += (size.x + options->gap_mm) * (size.y + options->gap_mm);
        *least_width = fmax(*least_width, options->keep_grain ? size.x : fmin(size.x, size.y));
    }
    return KTG_OK;
}

/* ---- laid on a long sheet, then cut to what is used ------------------------------------------ */

typedef struct extent {
    ktg_vec2 low, high;
} extent;

static extent used_by(const ktg_pattern *pattern, const ktg_pattern_sheet *sheet) {
    extent used = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < sheet->placement_count; i++) {
        const ktg_pattern_placement *at = &sheet->placements[i];
        const ktg_pattern_piece *piece = &pattern->pieces[at->piece];
        ktg_turn turn = ktg_turn_points(piece->outline, piece->outline_count, at->rotation);
        double x = turn.low.x + at->x, y = turn.low.y + at->y;
        used.low = (ktg_vec2){fmin(used.low.x, x), fmin(used.low.y, y)};
        used.high =
            (ktg_vec2){fmax(used.high.x, x + turn.size.x), fmax(used.high.y, y + turn.size.y)};
    }
    return used;
}

/* Cuts the sheet to what is used and its margins. */
static void crop(ktg_pattern *pattern, double margin) {
    ktg_pattern_sheet *sheet = &pattern->sheets[0];
    extent used = used_by(pattern, sheet);
    ktg_vec2 size = ktg_sub2(used.high, used.low);
    double width = fmax(LEAST_ROOM_MM, size.x), height = fmax(LEAST_ROOM_MM, size.y);
    double right = margin + (width - size.x) / 2 - used.low.x, up = margin + height - used.high.y;
    for (size_t i = 0; i < sheet->placement_count; i++) {
        sheet->placements[i].x += right;
        sheet->placements[i].y += up;
    }
    sheet->width_mm = width + 2 * margin;
    sheet->height_mm = height + 2 * margin;
    const double printable[4] = {margin, margin, margin + width, margin + height};
    memcpy(sheet->printable, printable, sizeof printable);
}

static ktg_status lay(ktg_context *context, ktg_pattern *pattern, const ktg_layout_options *options,
                      double width_mm, ktg_layout_report *report) {
    ktg_layout_options longest = *options;
    longest.sheet =
        (ktg_sheet_format){"one page", width_mm, KTG_LAYOUT_PAGE_MM, options->sheet.margin_mm};
    KTG_TRY(ktg_layout_place(context, pattern, &longest, report));
    if (pattern->sheet_count > 1)
        return ktg_fail(context, KTG_LIMIT,
                        "one page of %.0f mm width would be longer than %.0f mm: choose a smaller "
                        "size, or sheets",
                        width_mm, KTG_LAYOUT_PAGE_MM);
    ktg_vec2 room = ktg_layout_room(&longest.sheet);
    double area = report->fill * room.x * room.y;
    crop(pattern, options->sheet.margin_mm);
    const double *r = pattern->sheets[0].printable;
    report->fill = area / ((r[2] - r[0]) * (r[3] - r[1]));
    return KTG_OK;
}

/* Of some widths the one that makes the smallest page. One that makes too long a page is none. */
static ktg_status lay_free(ktg_context *context, ktg_pattern *pattern,
                           const ktg_layout_options *options, ktg_layout_report *report) {
    static const double tries[] = {1, 0.85, 1.2, 1.4};
    double area, least, best = INFINITY, margin = options->sheet.margin_mm;
    KTG_TRY(measure(context, pattern, options, &area, &least));
    least = least * (1 + 1e-9) + 2 * margin;
    if (pattern->piece_count == 1)
        return lay(context, pattern, options, fmin(least, KTG_LAYOUT_PAGE_MM), report);
    ktg_layout_options quick = *options;
    quick.effort = KTG_EFFORT_QUICK;
    double best_width = fmin(fmax(least, sqrt(area) + 2 * margin), KTG_LAYOUT_PAGE_MM);
    for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
        double width = fmin(fmax(least, tries[k] * sqrt(area) + 2 * margin), KTG_LAYOUT_PAGE_MM);
        ktg_status status = lay(context, pattern, &quick, width, report);
        if (status == KTG_LIMIT)
            continue;
        KTG_TRY(status);
        double size = pattern->sheets[0].width_mm * pattern->sheets[0].height_mm;
        if (size < best * (1 - 1e-9)) {
            best = size;
            best_width = width;
        }
    }
    return lay(context, pattern, options, best_width, report);
}

ktg_status ktg_layout_page(ktg_context *context, ktg_pattern *pattern,
                           const ktg_layout_options *options, ktg_layout_report *report) {
    ktg_layout_report own;
    if (!report)
        report = &own;
    if (!ktg_layout_is_page(&options->sheet))
        return ktg_layout_place(context, pattern, options, report);
    if (!(options->sheet.margin_mm >= 0) || !(options->gap_mm >= 0))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a margin of %g mm and a gap of %g mm: neither may be negative",
                        options->sheet.margin_mm, options->gap_mm);
    return lay_free(context, pattern, options, report);
}
