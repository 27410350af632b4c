/* render/plot_folds.c - the folds of each piece, joined to long paths. */
#include "render/plot.h"
#include "render/weld.h"

#include "core/memory.h"

#define TOGETHER_MM 1e-6

/* Where joined folds go. */
typedef struct target {
    ktg_plot *plot;
    ktg_layer layer;
    ktg_stroke stroke;
} target;

static ktg_status add(void *user, const ktg_vec2 *points, size_t count, bool closed) {
    const target *t = user;
    return ktg_plot_add(t->plot, t->layer, t->stroke, points, count, closed);
}

static ktg_layer layer_of_fold(const ktg_fold_segment *fold) {
    if (fold->is_foot)
        return KTG_LAYER_TAB_FOLD;
    return fold->stroke == KTG_STROKE_MOUNTAIN ? KTG_LAYER_MOUNTAIN : KTG_LAYER_VALLEY;
}

/* Points of a piece's folds of one kind, and the segments between them. */
static ktg_status weld_folds(const target *t, const ktg_pattern_placement *at, ktg_weld *weld,
                             ktg_segment *segments, size_t *count) {
    const ktg_drawing *drawing = t->plot->page.drawing;
    for (size_t i = drawing->first_fold[at->piece]; i < drawing->first_fold[at->piece + 1]; i++) {
        const ktg_fold_segment *fold = &drawing->folds[i];
        ktg_segment s;
        if (fold->stroke != t->stroke || layer_of_fold(fold) != t->layer)
            continue;
        KTG_TRY(ktg_weld_point(weld, ktg_plot_point(at, fold->from), &s.a));
        KTG_TRY(ktg_weld_point(weld, ktg_plot_point(at, fold->to), &s.b));
        if (s.a != s.b)
            segments[(*count)++] = s;
    }
    return KTG_OK;
}

static ktg_status add_folds(target *t, const ktg_pattern_placement *at) {
    const ktg_drawing *drawing = t->plot->page.drawing;
    size_t most = drawing->first_fold[at->piece + 1] - drawing->first_fold[at->piece], count = 0;
    ktg_weld weld = {.context = drawing->context, .tolerance = TOGETHER_MM};
    ktg_segment *segments = ktg_new(drawing->context, most, ktg_segment);
    ktg_status status = segments ? weld_folds(t, at, &weld, segments, &count) : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_trails_join(&weld, segments, count, add, t);
    ktg_free(segments);
    ktg_weld_drop(&weld);
    return status;
}

ktg_status ktg_plot_folds(ktg_plot *plot) {
    target targets[] = {{plot, KTG_LAYER_MOUNTAIN, KTG_STROKE_MOUNTAIN},
                        {plot, KTG_LAYER_VALLEY, KTG_STROKE_VALLEY},
                        {plot, KTG_LAYER_TAB_FOLD, KTG_STROKE_MOUNTAIN},
                        {plot, KTG_LAYER_TAB_FOLD, KTG_STROKE_VALLEY}};
    const ktg_pattern_sheet *sheet = plot->page.sheet;
    for (size_t i = 0; i < sheet->placement_count; i++)
        for (size_t k = 0; k < sizeof targets / sizeof *targets; k++)
            KTG_TRY(add_folds(&targets[k], &sheet->placements[i]));
    return KTG_OK;
}
