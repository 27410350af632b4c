/* pipeline/printed.c - a piece of cloth that is the mirror image of another one is not printed:
 * both are cut by the same paper. */
#include "pipeline/printed.h"

#include "core/memory.h"

ktg_status ktg_printed_view(ktg_context *context, const ktg_pattern *pattern,
                            ktg_printed *printed) {
    *printed = (ktg_printed){.view = *pattern};
    ktg_pattern *view = &printed->view;
    view->sheets = NULL;
    view->sheet_count = view->piece_count = 0;
    view->pieces = ktg_new(context, pattern->piece_count, ktg_pattern_piece);
    printed->pieces = ktg_new(context, pattern->piece_count, uint32_t);
    if (!view->pieces || !printed->pieces)
        return KTG_MEMORY;
    for (uint32_t p = 0; p < pattern->piece_count; p++) {
        if (pattern->pieces[p].cut_count == 0)
            continue;
        printed->pieces[view->piece_count] = p;
        view->pieces[view->piece_count++] = pattern->pieces[p];
    }
    return KTG_OK;
}

static void free_sheets(ktg_pattern *pattern) {
    for (size_t s = 0; s < pattern->sheet_count; s++)
        ktg_free(pattern->sheets[s].placements);
    ktg_free(pattern->sheets);
    pattern->sheets = NULL;
    pattern->sheet_count = 0;
}

void ktg_printed_take_sheets(ktg_printed *printed, ktg_pattern *pattern) {
    ktg_pattern *view = &printed->view;
    free_sheets(pattern);
    for (size_t s = 0; s < view->sheet_count; s++)
        for (size_t i = 0; i < view->sheets[s].placement_count; i++) {
            ktg_pattern_placement *at = &view->sheets[s].placements[i];
            at->piece = printed->pieces[at->piece];
        }
    pattern->sheets = view->sheets;
    pattern->sheet_count = view->sheet_count;
    view->sheets = NULL;
    view->sheet_count = 0;
}

void ktg_printed_drop(ktg_printed *printed) {
    free_sheets(&printed->view);
    ktg_free(printed->view.pieces);
    ktg_free(printed->pieces);
}
