/* flatten/flatten.c - the whole way from a mesh to a flat pattern. */
#include "flatten/flatten.h"
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/surface.h"

#include <string.h>

void ktg_flatten_defaults(ktg_flatten_options *options) {
    *options = (ktg_flatten_options){.method = KTG_FLATTEN_ARAP,
                                     .weight = KTG_WEIGHT_COTANGENT,
                                     .crease = 40 * KTG_PI / 180,
                                     .effort = KTG_EFFORT_NORMAL,
                                     .match_seams = true,
                                     .strain_limit = 0.05,
                                     .up = 1};
}

const char *ktg_flatten_method_name(ktg_flatten_method method) {
    static const char *const names[] = {"arap", "injective", "two-step"};
    return names[method];
}

void ktg_flatten_report_free(ktg_flatten_report *report) {
    if (!report)
        return;
    ktg_free(report->panels);
    report->panels = NULL;
    report->panel_count = 0;
}

static ktg_status check_options(ktg_context *context, const ktg_flatten_options *options) {
    if (options->effort > KTG_EFFORT_BEST)
        return ktg_fail(context, KTG_ARGUMENT, "there is no such effort");
    if (options->method > KTG_FLATTEN_TWO_STEP || options->weight > KTG_WEIGHT_UNIT)
        return ktg_fail(context, KTG_ARGUMENT, "there is no such way to flatten");
    if (!(options->strain_limit >= 0))
        return ktg_fail(context, KTG_ARGUMENT, "a limit of strain is 0 or more");
    if (options->weight == KTG_WEIGHT_UNIT && options->method != KTG_FLATTEN_TWO_STEP)
        return ktg_fail(context, KTG_ARGUMENT,
                        "unit weights are for the two-step method only (--method two-step)");
    return KTG_OK;
}

/* Turns every panel by its grain; what seams did to its shape may have turned it, too. */
static ktg_status set_grain(ktg_context *context, ktg_flat_surface *s) {
    const ktg_flatten_options *options = s->options;
    for (size_t k = 0; k < options->grain_count; k++) {
        uint32_t p = 0;
        while (p < s->apart.count && strcmp(s->names.text[p], options->grains[k].panel) != 0)
            p++;
        if (p == s->apart.count)
            return ktg_fail(context, KTG_ARGUMENT, "there is no panel \"%s\" to give a grain to",
                            options->grains[k].panel);
        s->flats[p].grain = options->grains[k].angle;
    }
    for (uint32_t p = 0; p < s->apart.count; p++)
        ktg_panel_set_upright(s->flats[p].panel, s->flats[p].flat, options->up, s->flats[p].grain);
    return KTG_OK;
}

static ktg_status flatten_once(ktg_context *context, ktg_flat_surface *surface,
                               ktg_pattern **pattern) {
    KTG_TRY(ktg_flat_surface_open(context, surface));
    KTG_TRY(ktg_flat_surface_lay(context, surface));
    KTG_TRY(ktg_seams_match(context, surface));
    KTG_TRY(set_grain(context, surface));
    ktg_progress(context, "flatten", 0.95, "strain");
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_flat_surface_judge(context, surface));
    KTG_TRY(ktg_seams_check(context, surface));
    return ktg_flat_pattern(context, surface, pattern);
}

/* One try, from nothing. */
static ktg_status attempt(ktg_context *context, ktg_flat_surface *surface, ktg_pattern **pattern) {
    ktg_pattern_free(pattern);
    ktg_flatten_report_free(surface->report);
    *surface->report = (ktg_flatten_report){.strain_limit = surface->options->strain_limit};
    ktg_progress(context, "flatten", 0, NULL);
    ktg_status status = ktg_check_cancel(context);
    if (status == KTG_OK)
        status = flatten_once(context, surface, pattern);
    ktg_flat_surface_drop(surface);
    return status;
}

/* Nobody said where seams are to be, and some panel was laid flat and folds or lies on itself; what
 * the two-step method folds is refused. */
static bool may_choose(const ktg_flat_surface *surface) {
    return surface->options->seams == 0 && surface->options->method != KTG_FLATTEN_TWO_STEP &&
           surface->report->whole.faces > 0;
}

/* Making both sides of a seam equally long strains a panel a little more than it was when its seams
 * were chosen: where that is too much, they are chosen again with more to spare. And where nobody
 * said where seams are to be, a panel that cannot be laid flat gets some. */
static ktg_status flatten(ktg_context *context, ktg_flat_surface *surface, ktg_pattern **pattern) {
    static const double parts[] = {0.951, 0.965, 0.98};
    size_t k = 0;
    KTG_TRY(check_options(context, surface->options));
    for (;;) {
        surface->area_part = parts[k];
        ktg_status status = attempt(context, surface, pattern);
        bool beyond = status == KTG_OK && surface->chosen && surface->report->panels_beyond > 0;
        bool folds = status == KTG_GEOMETRY && !surface->chosen && may_choose(surface);
        surface->choose = surface->choose || folds;
        k += beyond;
        if ((!beyond && !folds) || k == sizeof parts / sizeof *parts || ktg_wants_finish(context))
            return status;
    }
}

ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh, const char *name,
                       const ktg_flatten_options *options, ktg_pattern **pattern,
                       ktg_flatten_report *report) {
    double start = ktg_clock_seconds();
    ktg_flatten_options defaults;
    ktg_flatten_report measured = {0};
    ktg_flatten_defaults(&defaults);
    *pattern = NULL;
    ktg_flat_surface surface = {
        .options = options ? options : &defaults, .model = mesh, .name = name, .report = &measured};
    ktg_status status = flatten(context, &surface, pattern);
    if (status == KTG_OK) /* "stop" may have been the answer to who asked about finishing only */
        status = ktg_check_cancel(context);
    if (status != KTG_OK)
        ktg_pattern_free(pattern);
    ktg_progress(context, "flatten", 1, NULL);
    measured.seconds = ktg_clock_seconds() - start;
    if (report)
        *report = measured;
    else
        ktg_flatten_report_free(&measured);
    return status;
}
