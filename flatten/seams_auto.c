/* flatten/seams_auto.c - seams where a surface needs them.
 *
 * Panel by panel, as in Julius et al., "D-Charts" (2005) and Poranne et al., "Autocuts" (2017), but by
 * trial: a panel that does not fit is cut in each of some ways, the parts are laid flat, and the way
 * that takes most strain away for its length is kept. Of a surface that mirrors itself one half is
 * cut, and its seams are copied. At the end every seam has to show that it is needed. */
#include "core/clock.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <string.h>

/* Faces laid flat in trials, at most: as many, or as many times the faces of the surface. */
static const uint64_t most_work = 2000000, most_work_times = 50;

/* Further attempts are made while all together lay less than this flat. */
static const uint64_t most_attempt_work = 1500000;

/* In square roots of the area of what is cut: what any cut costs, and what a panel smaller than
 * this part does. */
static const double least_cost = 0.4, small_cost = 1, small_part = 0.06;

/* Of the area that may be beyond the limit, the part that the search makes use of: what comes after,
 * seams made equally long, strains a little more. */
static const double spare = 0.85;

/* A dart, and an end of a seam at another one, as length of seam in square roots of the area of the
 * surface. */
static const double dart_cost = 0.15, corner_cost = 0.12;

/* Seams that cannot be slid smooth. */
static const double rough_cost = 1;

/* Searches that begin differently; faces of a panel that is not halved when work has run out. */
enum { attempts = 8, few_faces = 64 };

/* A cut that takes away less than this part of the excess is not worth making. */
static const double least_gain = 0.03;

typedef struct auto_search {
    const ktg_seams_auto_options *options;
    ktg_mesh mesh; /* positions normalised; borrowed */
    const ktg_adjacency *adjacency;
    ktg_sheet *sheet; /* of the whole */
    ktg_mirror mirror;
    bool *given, *plane, *cut; /* edge_count: as it was; along the mirror plane; as it is */
    bool *done;        /* face_count: its panel fits, or cannot be helped */
    ktg_fit_limit limit;
    bool exhausted;
    uint32_t first_rank; /* which way is taken at the first cut: the best, the second best, ... */
    bool lines_last;     /* darts and the like only where nothing else helps */
    bool begun;          /* the first cut is made */
} auto_search;

/* ---- ways to cut one panel ----------------------------------------------------------------- */

typedef struct way {
    bool *cut; /* NULL where it does not apply */
    ktg_trial trial;
    uint64_t work;
} way;

typedef struct ways {
    const auto_search *search;
    const ktg_sheet *sheet;
    ktg_split *split;
    way list[ktg_split_ways];
} ways;

static bool any(const bool *flags, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (flags[i])
            return true;
    return false;
}

static ktg_status make_smooth(ktg_context *context, const ways *w, uint32_t index, bool *cut) {
    double *cost =
        ktg_copy_array(context, w->sheet->cost, w->sheet->edge_count, sizeof *w->sheet->cost);
    if (!cost)
        return KTG_MEMORY;
    ktg_status status = ktg_split_make(context, w->split, index, cut, cost);
    if (status == KTG_OK)
        status = ktg_seams_smooth(context, w->sheet, cost, NULL, cut);
    ktg_free(cost);
    return status;
}

/* Makes way number `index`, smooths it and tries it. */
static ktg_status try_way(ktg_context *context, uint32_t index, void *user) {
    ways *w = user;
    way *mine = &w->list[index];
    ktg_fit_limit limit = w->search->limit;
    limit.work = 0;
    bool *cut = mine->cut = ktg_new(context, w->sheet->edge_count, bool);
    if (!cut)
        return KTG_MEMORY;
    KTG_TRY(make_smooth(context, w, index, cut));
    if (any(cut, w->sheet->edge_count)) {
        KTG_TRY(ktg_trial_run(context, w->sheet, cut, &limit, &mine->trial));
    } else {
        ktg_free(mine->cut);
        mine->cut = NULL;
    }
    mine->work = limit.work;
    return KTG_OK;
}

/* How many times less excess there is, as a logarithm, for what that costs: seams, and panels that
 * are awkward or small. When everything fits there is next to none. */
static double rate(const ktg_sheet *sheet, const ktg_trial *before, const ktg_trial *after) {
    double none = 0.02 * sheet->area, left = after->good ? none : after->excess + none;
    double length = ktg_max(0, after->length - before->length) / sqrt(sheet->area);
    double shape = ktg_max(0, after->shape - before->shape);
    double small = after->least_area < small_part * sheet->area && after->panels > 1 ? small_cost : 0;
    return log((before->excess + none) / left) / (least_cost + length + shape + small);
}

/* The best way below a rate; of all, or without lines. */
static const way *next_way(const ways *w, const ktg_trial *before, double below,
                           bool no_lines) {
    const way *best = NULL;
    double highest = 0;
    for (uint32_t i = 0; i < ktg_split_ways; i++) {
        const way *one = &w->list[i];
        if (!one->cut || (no_lines && ktg_split_is_line(i)) ||
            (!one->trial.good && one->trial.excess > (1 - least_gain) * before->excess))
            continue;
        double its = rate(w->sheet, before, &one->trial);
        if (its < below && its > highest) {
            best = one;
            highest = its;
        }
    }
    return best;
}

/* The best; at the first cut the one of the rank that is asked for, if there are so many. */
static const way *choose_way(auto_search *s, const ways *w, const ktg_trial *before) {
    uint32_t rank = s->begun ? 0 : s->first_rank;
    const way *best = next_way(w, before, INFINITY, s->lines_last);
    for (; best && rank > 0; rank--) {
        const way *next =
            next_way(w, before, 0.97 * rate(w->sheet, before, &best->trial), s->lines_last);
        if (!next)
            break;
        best = next;
    }
    s->begun = true;
    return best ? best : next_way(w, before, INFINITY, false);
}

/* ---- one panel ----------------------------------------------------------------------------- */

/* Sets in the surface's flags what is set in the panel's. */
static void carry(auto_search *s, const ktg_cut_panel *part, const ktg_sheet *sheet,
                  const bool *cut) {
    for (uint32_t h = 0; h < sheet->adjacency->halfedge_count; h++)
        if (cut[sheet->adjacency->halfedge_edge[h]] && sheet->adjacency->twin[h] != KTG_NONE)
            s->cut[s->adjacency->halfedge_edge[3 * part->face[h / 3] + h % 3]] = true;
}

static void set_done(auto_search *s, const ktg_cut_panel *part) {
    for (uint32_t f = 0; f < part->mesh->face_count; f++)
        s->done[part->face[f]] = true;
}

/* Measures a panel even where it is far beyond the limit; one that is no disk is not flat. */
static ktg_status measure_panel(ktg_context *context, auto_search *s, const ktg_cut_panel *part,
                                ktg_fit *fit) {
    ktg_sheet *sheet;
    KTG_TRY(ktg_sheet_new(context, part->mesh, NULL, &sheet));
    *fit = (ktg_fit){0};
    ktg_status status = KTG_OK;
    s->limit.thorough = true;
    if ((int64_t)part->mesh->vertex_count - sheet->edge_count + part->mesh->face_count == 1)
        status = ktg_fit_measure(context, part->mesh, &s->limit, fit);
    s->limit.thorough = false;
    ktg_sheet_free(&sheet);
    return status;
}

/* Where no way gains anything, but the panel lies on itself: the one that leaves least excess in
 * more than one part. */
static const way *any_way(const ways *w) {
    const way *best = NULL;
    for (uint32_t i = 0; i < ktg_split_ways; i++) {
        const way *one = &w->list[i];
        if (one->cut && one->trial.panels > 1 &&
            (!best || one->trial.excess < best->trial.excess))
            best = one;
    }
    return best;
}

static ktg_status cut_panel(ktg_context *context, auto_search *s, const ktg_cut_panel *part,
                            const ktg_sheet *sheet, const ktg_trial *before) {
    ways w = {.search = s, .sheet = sheet};
    ktg_status status = ktg_split_new(context, sheet, &w.split);
    if (status == KTG_OK)
        status = ktg_parallel_run(context, ktg_split_ways, try_way, &w);
    const way *best = status == KTG_OK ? choose_way(s, &w, before) : NULL;
    ktg_fit fit;
    if (status == KTG_OK && !best) {
        status = measure_panel(context, s, part, &fit);
        best = status == KTG_OK && !fit.flat ? any_way(&w) : NULL;
    }
    if (best)
        carry(s, part, sheet, best->cut);
    else
        set_done(s, part);
#ifdef SEAMS_TRACE
    for (uint32_t i = 0; i < ktg_split_ways; i++)
        if (w.list[i].cut)
            printf("   %c way %2u: panels %u excess %.4f -> %.4f length %.3f good %d\n", best == &w.list[i] ? '*' : ' ',
                   i, w.list[i].trial.panels, before->excess / sheet->area,
                   w.list[i].trial.excess / sheet->area, w.list[i].trial.length / sqrt(sheet->area), w.list[i].trial.good);
    printf("\n");
#endif
    for (uint32_t i = 0; i < ktg_split_ways; i++) {
        s->limit.work += w.list[i].work;
        ktg_free(w.list[i].cut);
    }
    ktg_split_free(&w.split);
    return status;
}

static ktg_status refine_panel(ktg_context *context, auto_search *s, const ktg_cut_surface *parts,
                               uint32_t index) {
    const ktg_cut_panel *part = &parts->panels[index];
    ktg_sheet *sheet;
    ktg_trial before;
    KTG_TRY(ktg_sheet_new(context, part->mesh, NULL, &sheet));
    bool *nothing = ktg_new(context, sheet->edge_count, bool);
    ktg_status status = nothing ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_sheet_find_slits(context, parts, index, s->adjacency, sheet);
    if (status == KTG_OK)
        status = ktg_trial_run(context, sheet, nothing, &s->limit, &before);
    if (status == KTG_OK && before.good)
        set_done(s, part);
    else if (status == KTG_OK)
        status = cut_panel(context, s, part, sheet, &before);
    ktg_free(nothing);
    ktg_sheet_free(&sheet);
    return status;
}

/* ---- all panels ---------------------------------------------------------------------------- */

static bool is_mirrored(const auto_search *s, const ktg_cut_panel *part) {
    double side = 0;
    for (uint32_t f = 0; f < part->mesh->face_count; f++)
        side += ktg_length3(ktg_sheet_area(part->mesh, f)) *
                ktg_mirror_side(&s->mirror, ktg_face_centre(part->mesh, f));
    return side < 0;
}

/* The first panel with something to do; with `half` on the one side of the mirror only. */
static uint32_t next_panel(const auto_search *s, const ktg_cut_surface *parts, bool half) {
    for (uint32_t p = 0; p < parts->count; p++)
        if (!s->done[parts->panels[p].face[0]] && !(half && is_mirrored(s, &parts->panels[p])))
            return p;
    return KTG_NONE;
}

static bool may_go_on(auto_search *s) {
    uint64_t times = most_work_times * s->mesh.face_count;
    bool more = s->limit.work < (times > most_work ? times : most_work);
    s->exhausted |= !more;
    return more;
}

/* What to cut when work has run out: what is no disk is opened, and what does not fit is halved
 * across its extent, without trials, down to a few faces. */
static ktg_status halve(ktg_context *context, auto_search *s, const ktg_cut_panel *part,
                        const ktg_sheet *sheet, bool *cut) {
    ktg_fit fit;
    KTG_TRY(ktg_sheet_open(context, part->mesh, sheet->adjacency, cut));
    if (any(cut, sheet->edge_count))
        return KTG_OK;
    KTG_TRY(measure_panel(context, s, part, &fit));
    if (fit.good || (fit.flat && part->mesh->face_count <= few_faces))
        return KTG_OK;
    return ktg_split_halve(context, sheet, cut);
}

static ktg_status halve_panel(ktg_context *context, auto_search *s, const ktg_cut_surface *parts,
                              uint32_t index) {
    const ktg_cut_panel *part = &parts->panels[index];
    ktg_sheet *sheet;
    KTG_TRY(ktg_sheet_new(context, part->mesh, NULL, &sheet));
    bool *cut = ktg_new(context, sheet->edge_count, bool);
    ktg_status status = cut ? halve(context, s, part, sheet, cut) : KTG_MEMORY;
    if (status == KTG_OK && any(cut, sheet->edge_count))
        carry(s, part, sheet, cut);
    else if (status == KTG_OK)
        set_done(s, part);
    ktg_free(cut);
    ktg_sheet_free(&sheet);
    return status;
}

static ktg_status refine_next(ktg_context *context, auto_search *s, bool half, bool *ended) {
    ktg_cut_surface parts;
    KTG_TRY(ktg_cut_apart(context, &s->mesh, s->adjacency, s->cut, &parts));
    uint32_t index = next_panel(s, &parts, half);
    ktg_status status = KTG_OK;
    *ended = index == KTG_NONE;
    if (!*ended)
        status = may_go_on(s) ? refine_panel(context, s, &parts, index)
                                       : halve_panel(context, s, &parts, index);
    ktg_cut_surface_free(&parts);
    return status;
}

static ktg_status refine(ktg_context *context, auto_search *s, bool half) {
    bool ended = false;
    for (uint32_t round = 0; !ended && !ktg_wants_finish(context); round++) {
        KTG_TRY(ktg_check_cancel(context));
        ktg_progress(context, "seams", 1 - 10.0 / (10 + round), NULL);
        KTG_TRY(refine_next(context, s, half, &ended));
    }
    s->exhausted |= !ended;
    return KTG_OK;
}

/* One half, then the other with the same seams. */
static ktg_status refine_mirrored(ktg_context *context, auto_search *s) {
    memcpy(s->cut, s->plane, s->adjacency->edge_count * sizeof *s->cut);
    KTG_TRY(refine(context, s, true));
    return ktg_mirror_seams(context, s->sheet, &s->mirror, s->plane, s->cut);
}

static ktg_status revise(ktg_context *context, auto_search *s) {
    ktg_revision revision = {.sheet = s->sheet,
                             .fixed = s->given,
                             .plane = s->plane,
                             .mirror = &s->mirror,
                             .limit = &s->limit,
                             .most_work = s->limit.work + most_work};
    KTG_TRY(ktg_seams_merge(context, &revision, s->cut));
    KTG_TRY(ktg_seams_polish(context, &revision, s->cut));
    KTG_TRY(ktg_seams_merge(context, &revision, s->cut));
    revision.small_only = true;
    return ktg_seams_merge(context, &revision, s->cut);
}

/* ---- attempts ------------------------------------------------------------------------------ */

/* What came of an attempt. */
typedef struct outcome {
    bool slid;       /* judged as ktg_seams_slide leaves the surface */
    uint32_t beyond; /* panels that do not fit */
    double failing;  /* area that is beyond the limit and should not be */
    double worst;    /* of all panels the largest part of the area beyond */
    double awkward;  /* shapes of panels, darts, and length of seams */
} outcome;

static ktg_status judge_seams(ktg_context *context, const auto_search *s, outcome *o) {
    ktg_chains chains;
    KTG_TRY(ktg_chains_find(context, s->sheet, s->cut, NULL, &chains));
    for (uint32_t c = 0; c < chains.count; c++)
        o->awkward += chains.chains[c].length / sqrt(s->sheet->area);
    o->awkward += dart_cost * ktg_chains_darts(s->sheet, &chains);
    o->awkward += corner_cost * ktg_chains_corners(s->sheet, &chains);
    ktg_chains_free(&chains);
    return KTG_OK;
}

static ktg_status judge_panels(ktg_context *context, auto_search *s, const ktg_mesh *mesh,
                               outcome *o) {
    ktg_cut_surface parts;
    KTG_TRY(ktg_cut_apart(context, mesh, s->adjacency, s->cut, &parts));
    ktg_status status = KTG_OK;
    for (uint32_t p = 0; status == KTG_OK && p < parts.count; p++) {
        ktg_fit fit = {0};
        status = ktg_fit_measure(context, parts.panels[p].mesh, &s->limit, &fit);
        o->beyond += !fit.good;
        o->failing += ktg_fit_failing(&fit, &s->limit);
        o->worst = ktg_max(o->worst, fit.beyond);
        o->awkward += ktg_fit_shape(&fit);
        o->awkward += fit.area < small_part / 2 * s->sheet->area ? small_cost : 0;
    }
    ktg_cut_surface_free(&parts);
    return status;
}

static ktg_status judge_slid(ktg_context *context, auto_search *s, outcome *o) {
    ktg_mesh slid = s->mesh;
    slid.positions =
        ktg_copy_array(context, s->mesh.positions, s->mesh.vertex_count, sizeof(ktg_vec3));
    if (!slid.positions)
        return KTG_MEMORY;
    ktg_status status =
        ktg_seams_slide(context, &slid, s->adjacency, s->cut, s->given, NULL);
    if (status == KTG_OK)
        status = judge_panels(context, s, &slid, o);
    ktg_free(slid.positions);
    return status;
}

/* As ktg_seams_slide will leave the surface, unless that spoils what fits without. */
static ktg_status judge_both(ktg_context *context, auto_search *s, outcome *o) {
    outcome slid = {.slid = true}, rough = {.awkward = rough_cost};
    if (s->options->slide)
        KTG_TRY(judge_slid(context, s, &slid));
    if (!s->options->slide || slid.failing > 0)
        KTG_TRY(judge_panels(context, s, &s->mesh, &rough));
    bool take = s->options->slide && !(slid.failing > 0 && rough.failing < slid.failing);
    *o = take ? slid : rough;
    return judge_seams(context, s, o);
}

/* By the limit that was asked for. */
static ktg_status judge(ktg_context *context, auto_search *s, outcome *o) {
    double searched = s->limit.area_part;
    s->limit.area_part = s->options->area_part;
    s->limit.thorough = true;
    ktg_status status = judge_both(context, s, o);
    s->limit.area_part = searched;
    s->limit.thorough = false;
    return status;
}

static ktg_status attempt(ktg_context *context, auto_search *s, outcome *o) {
    memcpy(s->cut, s->given, s->adjacency->edge_count * sizeof *s->cut);
    memset(s->done, 0, s->mesh.face_count * sizeof *s->done);
    s->begun = false;
    if (s->mirror.found)
        KTG_TRY(refine_mirrored(context, s));
    KTG_TRY(refine(context, s, false));
    KTG_TRY(ktg_sheet_open(context, &s->mesh, s->adjacency, s->cut));
    KTG_TRY(revise(context, s));
    return judge(context, s, o);
}

/* First what fails the limit, if that differs clearly, then what is awkward to sew. */
static bool is_better(const outcome *a, const outcome *b) {
    if (a->failing < 0.9 * b->failing || b->failing < 0.9 * a->failing)
        return a->failing < b->failing;
    return a->awkward < b->awkward;
}

/* One always, and more as long as all together will not take too long. */
static bool may_attempt(ktg_context *context, auto_search *s, uint32_t made) {
    if (made == 0)
        return true;
    return s->limit.work / made * (made + 1) < most_attempt_work && !ktg_wants_finish(context);
}

/* What a greedy search finds depends on its first step most of all: several are tried, with and
 * without darts, as long as there is work left. */
static ktg_status try_all(ktg_context *context, auto_search *s, bool *best) {
    outcome least = {.failing = INFINITY, .awkward = INFINITY};
    for (uint32_t i = 0; i < attempts && may_attempt(context, s, i); i++) {
        outcome its;
        s->first_rank = i / 2;
        s->lines_last = i % 2 == 0;
        KTG_TRY(attempt(context, s, &its));
#ifdef SEAMS_TRACE
        printf("attempt %u: beyond %u awkward %.3f work %.2fM\n", i, its.beyond, its.awkward, s->limit.work / 1e6);
#endif
        if (!is_better(&its, &least))
            continue;
        least = its;
        memcpy(best, s->cut, s->adjacency->edge_count * sizeof *best);
    }
    memcpy(s->cut, best, s->adjacency->edge_count * sizeof *best);
    return KTG_OK;
}

static ktg_status search_seams(ktg_context *context, auto_search *s) {
    if (s->options->symmetric && !any(s->given, s->adjacency->edge_count))
        KTG_TRY(ktg_mirror_find(context, s->sheet, &s->mirror));
    if (s->mirror.found)
        KTG_TRY(ktg_mirror_cut(context, s->sheet, &s->mirror, s->plane));
    bool *best = ktg_new(context, s->adjacency->edge_count, bool);
    ktg_status status = best ? try_all(context, s, best) : KTG_MEMORY;
    ktg_free(best);
    return status;
}

/* ---- the whole ----------------------------------------------------------------------------- */

static ktg_status fill_report(ktg_context *context, auto_search *s, double unit,
                              ktg_seams_report *report) {
    ktg_cut_surface parts;
    ktg_chains chains;
    outcome its;
    KTG_TRY(judge(context, s, &its));
    KTG_TRY(ktg_cut_apart(context, &s->mesh, s->adjacency, s->cut, &parts));
    *report = (ktg_seams_report){.panels = parts.count,
                                 .panels_beyond = its.beyond,
                                 .worst_area_beyond = its.worst,
                                 .slide = its.slid,
                                 .mirrored = s->mirror.found,
                                 .exhausted = s->exhausted};
    ktg_cut_surface_free(&parts);
    KTG_TRY(ktg_chains_find(context, s->sheet, s->cut, NULL, &chains));
    for (uint32_t c = 0; c < chains.count; c++)
        report->seam_length += chains.chains[c].length * unit;
    report->darts = ktg_chains_darts(s->sheet, &chains);
    ktg_chains_free(&chains);
    return KTG_OK;
}

static ktg_status start_search(ktg_context *context, const ktg_panel *whole, const bool *cut,
                               auto_search *s) {
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

static ktg_status run_search(ktg_context *context, const ktg_mesh *mesh, auto_search *s, bool *cut,
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
    *options = (ktg_seams_auto_options){.max_strain = 0.05, .area_part = 0.95, .symmetric = true, .slide = true};
}

ktg_status ktg_seams_auto(ktg_context *context, const ktg_mesh *mesh,
                          const ktg_adjacency *adjacency, const ktg_seams_auto_options *options,
                          bool *cut, ktg_seams_report *report) {
    double start = ktg_clock_seconds();
    ktg_seams_auto_options defaults;
    ktg_seams_report found = {0};
    ktg_seams_auto_defaults(&defaults);
    auto_search s = {.options = options ? options : &defaults, .adjacency = adjacency};
    if (!(s.options->max_strain > 0) || !(s.options->area_part > 0 && s.options->area_part <= 1))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a limit of strain for seams is more than 0, and the part of the area that "
                        "it is for more than 0 and at most 1");
    s.limit = (ktg_fit_limit){s.options->max_strain, 1 - spare * (1 - s.options->area_part), false, 0};
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
