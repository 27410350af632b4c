/* layout/sheets.c - every piece onto paper, whatever its size: what fits a sheet as usual, the rest
 * as posters. */
#include "layout/pieces.h"
#include "layout/poster.h"

#include "core/memory.h"
#include "core/vec.h"

/* Which pieces fit a sheet. */
typedef struct sorting {
    uint32_t *fitting, *large; /* indices, piece_count each */
    size_t fitting_count, large_count;
    ktg_poster *posters; /* large_count */
} sorting;

ktg_status ktg_layout_fits(ktg_context *context, const ktg_pattern *pattern,
                           const ktg_layout_options *options, size_t piece, bool *fits) {
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    ktg_turn turn;
    *fits = true;
    if (!(room.x > 0) || !(room.y > 0) || pattern->pieces[piece].outline_count == 0)
        return KTG_OK; /* ktg_layout_place refuses these */
    KTG_TRY(
        ktg_turn_for_most_room(context, &pattern->pieces[piece], room, options->keep_grain, &turn));
    *fits = ktg_turn_fits(&turn, room);
    return KTG_OK;
}

static ktg_status sort(ktg_context *context, const ktg_pattern *pattern,
                       const ktg_layout_options *options, sorting *sorted) {
    sorted->fitting = ktg_new(context, pattern->piece_count, uint32_t);
    sorted->large = ktg_new(context, pattern->piece_count, uint32_t);
    if (!sorted->fitting || !sorted->large)
        return KTG_MEMORY;
    for (uint32_t p = 0; p < pattern->piece_count; p++) {
        bool fits;
        KTG_TRY(ktg_layout_fits(context, pattern, options, p, &fits));
        if (fits)
            sorted->fitting[sorted->fitting_count++] = p;
        else
            sorted->large[sorted->large_count++] = p;
    }
    sorted->posters = ktg_new(context, sorted->large_count, ktg_poster);
    return sorted->posters ? KTG_OK : KTG_MEMORY;
}

/* The pieces that fit, laid out on their own. */
static ktg_status place_fitting(ktg_context *context, const ktg_pattern *pattern,
                                const ktg_layout_options *options, const sorting *sorted,
                                ktg_pattern *view, ktg_layout_report *report) {
    *view = *pattern;
    view->sheets = NULL;
    view->sheet_count = 0;
    view->piece_count = sorted->fitting_count;
    view->pieces = ktg_new(context, sorted->fitting_count, ktg_pattern_piece);
    if (!view->pieces)
        return KTG_MEMORY;
    for (size_t i = 0; i < sorted->fitting_count; i++)
        view->pieces[i] = pattern->pieces[sorted->fitting[i]];
    if (sorted->fitting_count > 0)
        KTG_TRY(ktg_layout_place(context, view, options, report));
    for (size_t s = 0; s < view->sheet_count; s++)
        for (size_t i = 0; i < view->sheets[s].placement_count; i++) {
            ktg_pattern_placement *at = &view->sheets[s].placements[i];
            at->piece = sorted->fitting[at->piece];
        }
    return KTG_OK;
}

/* The sheets of the view, then the posters; the view's sheets move over. */
static ktg_status join(ktg_context *context, const ktg_layout_options *options,
                       const sorting *sorted, ktg_pattern *view, ktg_pattern *pattern) {
    size_t count = view->sheet_count, next = view->sheet_count;
    for (size_t i = 0; i < sorted->large_count; i++)
        count += sorted->posters[i].tiles;
    ktg_pattern_sheet *sheets = ktg_new(context, count, ktg_pattern_sheet);
    ktg_status status = sheets ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < sorted->large_count; i++) {
        status = ktg_poster_write(context, &sorted->posters[i], &options->sheet, (uint32_t)i + 1,
                                  sheets + next);
        next += sorted->posters[i].tiles;
    }
    if (status != KTG_OK) {
        ktg_layout_free_sheets(sheets, count);
        return status;
    }
    for (size_t s = 0; s < view->sheet_count; s++)
        sheets[s] = view->sheets[s];
    view->sheet_count = 0;
    ktg_layout_free_sheets(pattern->sheets, pattern->sheet_count);
    pattern->sheets = sheets;
    pattern->sheet_count = count;
    return KTG_OK;
}

static ktg_status place(ktg_context *context, ktg_pattern *pattern,
                        const ktg_layout_options *options, double overlap_mm, sorting *sorted,
                        ktg_pattern *view, ktg_layout_report *report) {
    ktg_layout_report fitting = {0};
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    KTG_TRY(sort(context, pattern, options, sorted));
    if (sorted->large_count == 0)
        return ktg_layout_place(context, pattern, options, report);
    KTG_TRY(place_fitting(context, pattern, options, sorted, view, &fitting));
    double area = fitting.fill * fitting.sheets * room.x * room.y;
    for (size_t i = 0; i < sorted->large_count; i++) {
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(ktg_poster_lay(context, pattern, options, overlap_mm, sorted->large[i],
                               &sorted->posters[i]));
        area += ktg_layout_face_area(&pattern->pieces[sorted->large[i]]);
    }
    KTG_TRY(join(context, options, sorted, view, pattern));
    if (report) {
        *report = fitting;
        report->sheets = (uint32_t)pattern->sheet_count;
        report->fill = area / ((double)pattern->sheet_count * room.x * room.y);
    }
    return KTG_OK;
}

ktg_status ktg_layout_tile(ktg_context *context, ktg_pattern *pattern,
                           const ktg_layout_options *options, double overlap_mm,
                           ktg_layout_report *report) {
    ktg_layout_options defaults;
    ktg_layout_defaults(&defaults);
    if (!options)
        options = &defaults;
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    if (!(room.x > 0) || !(room.y > 0))
        return ktg_layout_place(context, pattern, options, report);
    if (!(overlap_mm >= 0) || !(2 * overlap_mm <= fmin(room.x, room.y)))
        return ktg_fail(context, KTG_ARGUMENT,
                        "sheets of a poster cannot overlap by %g mm: choose 0 to %g mm", overlap_mm,
                        fmax(0, floor(fmin(room.x, room.y) / 2)));
    sorting sorted = {0};
    ktg_pattern view = {0};
    ktg_status status = place(context, pattern, options, overlap_mm, &sorted, &view, report);
    for (size_t i = 0; sorted.posters && i < sorted.large_count; i++)
        ktg_poster_drop(&sorted.posters[i]);
    ktg_layout_free_sheets(view.sheets, view.sheet_count);
    ktg_free(view.pieces);
    ktg_free(sorted.fitting);
    ktg_free(sorted.large);
    ktg_free(sorted.posters);
    return status;
}
