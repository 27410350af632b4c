/* flatten/trial.c - what comes of cutting a panel in some way: measured, not guessed. */
#include "core/memory.h"
#include "flatten/sheet.h"

#include <math.h>

static ktg_status add_parts(ktg_context *context, const ktg_cut_surface *parts,
                            ktg_fit_limit *limit, ktg_trial *trial) {
    for (uint32_t p = 0; p < parts->count; p++) {
        ktg_fit fit;
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(ktg_fit_measure(context, parts->panels[p].mesh, limit, &fit));
        trial->excess += fit.excess;
        trial->beyond_area += fit.beyond * fit.area;
        trial->good &= fit.good;
        trial->shape += ktg_fit_shape(&fit);
        trial->least_area = trial->panels ? fmin(trial->least_area, fit.area) : fit.area;
        trial->panels++;
    }
    return KTG_OK;
}

static ktg_status run_trial(ktg_context *context, const ktg_sheet *sheet, bool *cut,
                            ktg_fit_limit *limit, ktg_trial *trial) {
    ktg_cut_surface parts;
    KTG_TRY(ktg_sheet_open(context, sheet->mesh, sheet->adjacency, cut));
    for (uint32_t e = 0; e < sheet->edge_count; e++)
        if (cut[e] && !ktg_sheet_is_border(sheet, e))
            trial->length += sheet->length[e];
    KTG_TRY(ktg_cut_apart(context, sheet->mesh, sheet->adjacency, cut, &parts));
    ktg_status status = add_parts(context, &parts, limit, trial);
    ktg_cut_surface_free(&parts);
    return status;
}

ktg_status ktg_trial_run(ktg_context *context, const ktg_sheet *sheet, const bool *cut,
                         ktg_fit_limit *limit, ktg_trial *trial) {
    *trial = (ktg_trial){.good = true};
    bool *opened = ktg_copy_array(context, cut, sheet->edge_count, sizeof *cut);
    if (!opened)
        return KTG_MEMORY;
    ktg_status status = run_trial(context, sheet, opened, limit, trial);
    ktg_free(opened);
    return status;
}
