/* flatten/seams_auto.c - seams where a surface needs them.
 *
 * Panel by panel, as in Julius et al., "D-Charts" (2005), but by trial: a panel that does not fit
 * is cut in each of many ways, the parts are laid flat, and the way that takes most strain away for
 * its length is kept. Of a surface that mirrors itself one half is cut, and its seams are copied.
 * At the end every seam has to show that it is needed. */
#include "core/clock.h"
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/search.h"

#include <string.h>

/* Searches that begin differently are made while all together lay less than this flat; and faces
 * laid flat to see which seams are needed. */
enum { attempts = 12 };
static const double most_attempt_work = 2e6, most_revision_work = 2e6;

/* How much of that, and of what cutting panels may take, by effort. */
static const double budgets[] = {0.1, 1, 4};

/* Of the area that may be beyond the limit, the part that the search makes use of, and the part
 * that smoothing does more: what comes after, sliding seams and making them equally long, strains a
 * little more, in some attempts too much. */
static const double spares[] = {0.5, 0.85, 0.3}, spare_smooth = 0.1;

/* One half, then the other with the same seams. */
static ktg_status refine_mirrored(ktg_context *context, ktg_search *s) {
    memcpy(s->cut, s->plane, s->adjacency->edge_count * sizeof *s->cut);
    KTG_TRY(ktg_search_refine(context, s, true));
    return ktg_mirror_seams(context, s->sheet, &s->mirror, s->plane, s->cut);
}

static ktg_status revise(ktg_context *context, ktg_search *s) {
    ktg_revision revision = {.sheet = s->sheet,
                             .fixed = s->given,
                             .plane = s->plane,
                             .mirror = &s->mirror,
                             .limit = &s->limit,
                             .most_work =
                                 s->limit.work + (uint64_t)(s->budget * most_revision_work)};
    double searched = s->limit.area_part;
    KTG_TRY(ktg_seams_merge(context, &revision, s->cut));
    s->limit.area_part -= spare_smooth * (1 - s->options->area_part);
    ktg_status status = ktg_seams_polish(context, &revision, s->cut);
    s->limit.area_part = searched;
    KTG_TRY(status);
    KTG_TRY(ktg_seams_merge(context, &revision, s->cut));
    revision.small_only = true;
    return ktg_seams_merge(context, &revision, s->cut);
}

static ktg_status attempt(ktg_context *context, ktg_search *s, ktg_outcome *o) {
    memcpy(s->cut, s->given, s->adjacency->edge_count * sizeof *s->cut);
    memset(s->done, 0, s->mesh.face_count * sizeof *s->done);
    s->begun = s->exhausted = false;
    if (s->mirror.found)
        KTG_TRY(refine_mirrored(context, s));
    KTG_TRY(ktg_search_refine(context, s, false));
    KTG_TRY(ktg_sheet_open(context, &s->mesh, s->adjacency, s->cut));
    KTG_TRY(revise(context, s));
    return ktg_search_judge(context, s, o);
}

/* One always, and more as long as all together will not take too long. */
static bool may_attempt(ktg_context *context, ktg_search *s, uint32_t made) {
    if (made == 0)
        return true;
    double expected = (double)s->limit.work / made * (made + 1);
    return expected < s->budget * most_attempt_work && !ktg_wants_finish(context);
}

/* What a greedy search finds depends on its first step most of all: several are tried, with and
 * without darts, as long as there is work left. */
static ktg_status try_all(ktg_context *context, ktg_search *s, bool *best) {
    ktg_outcome least = {.failing = INFINITY, .awkward = INFINITY};
    for (uint32_t i = 0; i < attempts && may_attempt(context, s, i); i++) {
        ktg_outcome its;
        s->limit.area_part = 1 - spares[i % 3] * (1 - s->options->area_part);
        s->lines_last = i / 3 % 2 == 0;
        s->first_rank = i / 6;
        KTG_TRY(attempt(context, s, &its));
        if (!ktg_outcome_is_better(&its, &least))
            continue;
        least = its;
        memcpy(best, s->cut, s->adjacency->edge_count * sizeof *best);
    }
    memcpy(s->cut, best, s->adjacency->edge_count * sizeof *best);
    s->exhausted = least.exhausted;
    return KTG_OK;
}

static ktg_status search_seams(ktg_context *context, ktg_search *s) {
    if (s->options->symmetric && !ktg_any(s->given, s->adjacency->edge_count))
        KTG_TRY(ktg_mirror_find(context, s->sheet, &s->mirror));
    if (s->mirror.found)
        KTG_TRY(ktg_mirror_cut(context, s->sheet, &s->mirror, s->plane));
    bool *best = ktg_new(context, s->adjacency->edge_count, bool);
    ktg_status status = best ? try_all(context, s, best) : KTG_MEMORY;
    ktg_free(best);
    return status;
}

/* ---- the whole ----------------------------------------------------------------------------- */

static ktg_status fill_report(ktg_context *context, ktg_search *s, double unit,
                              ktg_seams_report *report) {
    ktg_cut_surface parts;
    ktg_chains chains;
    ktg_outcome its;
    KTG_TRY(ktg_search_judge(context, s, &its));
    KTG_TRY(ktg_cut_apart(context, &s->mesh, s->adjacency, s->cut, &parts));
    *report = (ktg_seams_report){.panels = parts.count,
                                 .panels_beyond = its.beyond,
                                 .worst_area_beyond = its.worst,
                                 .slide = its.slid,
                                 .mirrored = s->mirror.found,
                                 .exhausted = its.exhausted,
                                 .work = s->limit.work};
    ktg_cut_surface_free(&parts);
    KTG_TRY(ktg_chains_find(context, s->sheet, s->cut, NULL, &chains));
    for (uint32_t c = 0; c < chains.count; c++)
        report->seam_length += chains.chains[c].length * unit;
    report->darts = ktg_chains_darts(s->sheet, &chains);
    ktg_chains_free(&chains);
    return KTG_OK;
}

static ktg_status start_search(ktg_context *context, const ktg_panel *whole, const bool *cut,
                               ktg_search *s) {
    const size_t edges = s->adjacency->edge_count;
    s->given = ktg_copy_array(context, cut, edges, sizeof *cut);
    s->cut = ktg_copy_array(context, cut, edges, sizeof *cut);
    s->plane = ktg_new(context, edges, bool);
    s->done = ktg_new(context, s->mesh.face_count, bool);
    if (!s->given || !s->plane || !s->cut || !s->done)
        return KTG_MEMORY;
    s->mesh.positions = whole->positions;
    return ktg_sheet_new(context, &s->mesh, s->adjacency, &s->sheet);
}

static ktg_status run_search(ktg_context *context, const ktg_mesh *mesh, ktg_search *s, bool *cut,
                             ktg_seams_report *report) {
    ktg_panel *whole;
    KTG_TRY(ktg_panel_new(context, mesh, &whole));
    ktg_status status = start_search(context, whole, cut, s);
    if (status == KTG_OK)
        status = search_seams(context, s);
    if (status == KTG_OK)
        status = fill_report(context, s, ldexp(1, whole->exponent), report);
    if (status == KTG_OK)
        memcpy(cut, s->cut, s->adjacency->edge_count * sizeof *cut);
    ktg_panel_free(&whole);
    return status;
}

void ktg_seams_auto_defaults(ktg_seams_auto_options *options) {
    *options = (ktg_seams_auto_options){.max_strain = 0.05,
                                        .area_part = 0.95,
                                        .effort = KTG_EFFORT_NORMAL,
                                        .symmetric = true,
                                        .slide = true,
                                        .up = 1};
}

ktg_status ktg_seams_auto(ktg_context *context, const ktg_mesh *mesh,
                          const ktg_adjacency *adjacency, const ktg_seams_auto_options *options,
                          bool *cut, ktg_seams_report *report) {
    double start = ktg_clock_seconds();
    ktg_seams_auto_options defaults;
    ktg_seams_report found = {0};
    ktg_seams_auto_defaults(&defaults);
    ktg_search s = {.options = options ? options : &defaults, .adjacency = adjacency};
    if (!(s.options->max_strain > 0) || !(s.options->area_part > 0 && s.options->area_part <= 1))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a limit of strain for seams is more than 0, and the part of the area that "
                        "it is for more than 0 and at most 1");
    s.budget = budgets[s.options->effort];
    s.limit = (ktg_fit_limit){
        .max_strain = s.options->max_strain, .fabric = s.options->fabric, .up = s.options->up};
    s.mesh.vertex_count = mesh->vertex_count;
    s.mesh.face_count = mesh->face_count;
    s.mesh.faces = mesh->faces;
    ktg_status status = run_search(context, mesh, &s, cut, &found);
    ktg_sheet_free(&s.sheet);
    ktg_free(s.given);
    ktg_free(s.plane);
    ktg_free(s.cut);
    ktg_free(s.done);
    found.seconds = ktg_clock_seconds() - start;
    if (report)
        *report = found;
    return status;
}
