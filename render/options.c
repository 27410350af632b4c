/* render/options.c - the defaults, and what is checked before anything is drawn. */
#include "render/draw.h"
#include "render/poster.h"
#include "render/text.h"

#include "core/memory.h"

#include <string.h>

void ktg_render_defaults(ktg_render_options *options) {
    *options = (ktg_render_options){.title = NULL,
                                    .folds = KTG_FOLDS_DASHED,
                                    .flat_below = KTG_PI / 180,
                                    .dots_per_inch = 150,
                                    .up = 1,
                                    .colour = true,
                                    .guide = true,
                                    .strain_map = true,
                                    .strain_limit = 0.05,
                                    .bleed_mm = 1.5};
}

/* The title asked for, or the model's file name without its ending. */
static void choose_title(const ktg_pattern *pattern, const char *asked, char *title) {
    if (asked && *asked) {
        ktg_text_clean(asked, SIZE_MAX, title, KTG_TITLE_SIZE);
        return;
    }
    const char *file =
        pattern->model_file && *pattern->model_file ? pattern->model_file : "pattern";
    const char *dot = strrchr(file, '.');
    ktg_text_clean(file, dot && dot != file ? (size_t)(dot - file) : SIZE_MAX, title,
                   KTG_TITLE_SIZE);
}

static ktg_status check_sheets(ktg_context *context, const ktg_pattern *pattern) {
    if (pattern->sheet_count == 0)
        return ktg_fail(context, KTG_ARGUMENT,
                        "the pattern has no sheets to draw: lay it out first");
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &pattern->sheets[s];
        if (!(sheet->width_mm > 0) || !(sheet->height_mm > 0) || !isfinite(sheet->width_mm) ||
            !isfinite(sheet->height_mm))
            return ktg_fail(context, KTG_ARGUMENT, "sheet %zu is %g x %g mm: nothing to draw on",
                            s + 1, sheet->width_mm, sheet->height_mm);
        for (size_t i = 0; i < sheet->placement_count; i++) {
            uint32_t piece = sheet->placements[i].piece;
            if (piece >= pattern->piece_count)
                return ktg_fail(context, KTG_ARGUMENT,
                                "sheet %zu holds piece %u, but the pattern has %zu", s + 1,
                                piece + 1, pattern->piece_count);
            if (pattern->pieces[piece].outline_count == 0)
                return ktg_fail(context, KTG_ARGUMENT,
                                "piece %u has no outline: the pattern must be finished before it "
                                "is drawn",
                                piece + 1);
        }
    }
    return KTG_OK;
}

/* Which strokes the reader will meet. Folds and joints are known already. */
static unsigned find_kinds(const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    unsigned kinds = 1u << KTG_STROKE_CUT;
    if (drawing->joint_count > 0)
        kinds |= 1u << KTG_STROKE_JOINT;
    for (size_t i = 0; i < pattern->piece_count; i++) {
        const ktg_pattern_piece *piece = &pattern->pieces[i];
        if (piece->tab_count > 0)
            kinds |= 1u << KTG_STROKE_TAB;
        for (size_t k = 0; k < piece->line_count; k++)
            kinds |= 1u << ktg_stroke_of_line(piece->lines[k].kind);
    }
    for (size_t s = 0; s < pattern->sheet_count; s++)
        if (ktg_is_tile(&pattern->sheets[s]))
            kinds |= 1u << KTG_STROKE_TRIM | 1u << KTG_STROKE_JOIN;
    for (size_t i = 0; i < drawing->first_fold[pattern->piece_count]; i++)
        kinds |= 1u << drawing->folds[i].stroke;
    return kinds;
}

static ktg_status check_options(ktg_context *context, const ktg_pattern *pattern,
                                const ktg_render_options *options) {
    if (!(options->flat_below >= 0))
        return ktg_fail(context, KTG_ARGUMENT,
                        "folds flatter than %g radians cannot be left out: the angle must not be "
                        "negative",
                        options->flat_below);
    if (!(options->bleed_mm >= 0 && options->bleed_mm <= 20))
        return ktg_fail(context, KTG_ARGUMENT,
                        "colours cannot reach %g mm beyond edges: 0 to 20 are possible",
                        options->bleed_mm);
    if (options->paint && ktg_paint_face_count(options->paint) != pattern->face_count)
        return ktg_fail(context, KTG_ARGUMENT,
                        "the paint is laid on %u faces, but the pattern has %u: lay it on those",
                        ktg_paint_face_count(options->paint), pattern->face_count);
    if (options->up > 2)
        return ktg_fail(context, KTG_ARGUMENT, "there is no axis %u: 0, 1 or 2 is up", options->up);
    return KTG_OK;
}

ktg_status ktg_drawing_new(ktg_context *context, const ktg_pattern *pattern,
                           const ktg_render_options *options, ktg_drawing **drawing) {
    *drawing = NULL;
    KTG_TRY(check_sheets(context, pattern));
    ktg_drawing *made = ktg_new(context, 1, ktg_drawing);
    if (!made)
        return KTG_MEMORY;
    made->context = context;
    made->pattern = pattern;
    if (options)
        made->options = *options;
    else
        ktg_render_defaults(&made->options);
    choose_title(pattern, made->options.title, made->title);
    ktg_status status = check_options(context, pattern, &made->options);
    if (status == KTG_OK)
        status = ktg_drawing_find_folds(made);
    if (status == KTG_OK)
        status = ktg_drawing_find_joints(made);
    if (status == KTG_OK)
        status = ktg_drawing_find_tints(made);
    if (status != KTG_OK) {
        ktg_drawing_free(&made);
        return status;
    }
    made->kinds = find_kinds(made);
    *drawing = made;
    return KTG_OK;
}

ktg_status ktg_drawing_of_sheet(ktg_context *context, const ktg_pattern *pattern,
                                const ktg_render_options *options, size_t sheet,
                                ktg_drawing **drawing) {
    KTG_TRY(ktg_drawing_new(context, pattern, options, drawing));
    if (sheet < pattern->sheet_count)
        return KTG_OK;
    ktg_drawing_free(drawing);
    return ktg_fail(context, KTG_ARGUMENT, "there is no sheet %zu: the pattern has %zu", sheet + 1,
                    pattern->sheet_count);
}

void ktg_drawing_free(ktg_drawing **drawing) {
    if (!drawing || !*drawing)
        return;
    ktg_free((*drawing)->first_fold);
    ktg_free((*drawing)->folds);
    ktg_free((*drawing)->joints);
    ktg_free((*drawing)->piece_tints);
    ktg_free(*drawing);
    *drawing = NULL;
}
