/* flatten/judge.c - what came of a search for seams: what does not fit, and what is awkward to sew.
 */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/search.h"

/* A panel smaller than this part of the surface costs so much more; a dart, and an end of a seam at
 * another one; seams that cannot be slid smooth. All as length of seam in square roots of the area
 * of the surface. */
static const double small_part = 0.03, small_cost = 1;
static const double dart_cost = 0.15, corner_cost = 0.12, rough_cost = 2;

static ktg_status judge_seams(ktg_context *context, const ktg_search *s, ktg_outcome *o) {
    ktg_chains chains;
    KTG_TRY(ktg_chains_find(context, s->sheet, s->cut, NULL, &chains));
    for (uint32_t c = 0; c < chains.count; c++)
        o->awkward += chains.chains[c].length / sqrt(s->sheet->area);
    o->awkward += dart_cost * ktg_chains_darts(s->sheet, &chains);
    o->awkward += corner_cost * ktg_chains_corners(s->sheet, &chains);
    ktg_chains_free(&chains);
    return KTG_OK;
}

static ktg_status judge_panels(ktg_context *context, ktg_search *s, const ktg_mesh *mesh,
                               ktg_outcome *o) {
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
        o->awkward += fit.area < small_part * s->sheet->area ? small_cost : 0;
    }
    ktg_cut_surface_free(&parts);
    return status;
}

static ktg_status judge_slid(ktg_context *context, ktg_search *s, ktg_outcome *o) {
    ktg_mesh slid = s->mesh;
    slid.positions =
        ktg_copy_array(context, s->mesh.positions, s->mesh.vertex_count, sizeof(ktg_vec3));
    if (!slid.positions)
        return KTG_MEMORY;
    ktg_status status = ktg_seams_slide(context, &slid, s->adjacency, s->cut, s->given, NULL);
    if (status == KTG_OK)
        status = judge_panels(context, s, &slid, o);
    ktg_free(slid.positions);
    return status;
}

/* As ktg_seams_slide will leave the surface, unless that spoils what fits without. */
static ktg_status judge_both(ktg_context *context, ktg_search *s, ktg_outcome *o) {
    ktg_outcome slid = {.slid = true}, rough = {.awkward = rough_cost};
    if (s->options->slide)
        KTG_TRY(judge_slid(context, s, &slid));
    if (!s->options->slide || slid.failing > 0)
        KTG_TRY(judge_panels(context, s, &s->mesh, &rough));
    bool take = s->options->slide && !(slid.failing > 0 && rough.failing < slid.failing);
    *o = take ? slid : rough;
    return judge_seams(context, s, o);
}

ktg_status ktg_search_judge(ktg_context *context, ktg_search *s, ktg_outcome *o) {
    double searched = s->limit.area_part;
    s->limit.area_part = s->options->area_part;
    s->limit.thorough = true;
    ktg_status status = judge_both(context, s, o);
    s->limit.area_part = searched;
    s->limit.thorough = false;
    o->exhausted = s->exhausted;
    return status;
}

bool ktg_outcome_is_better(const ktg_outcome *a, const ktg_outcome *b) {
    if (a->failing < 0.9 * b->failing || b->failing < 0.9 * a->failing)
        return a->failing < b->failing;
    return a->awkward < b->awkward;
}
