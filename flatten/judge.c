/* flatten/judge.c - what came of a search for seams: what does not fit, and what is awkward to sew.
 */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/search.h"

/* A panel smaller than this part of the surface costs so much more; a dart, and an end of a seam at
 * another one; seams that cannot be slid smooth; and, more for its length, one that is not
 * mirrored. All as length of seam in square roots of the area of the surface. */
static const double small_part = 0.03, small_cost = 1;
static const double dart_cost = 0.15, corner_cost = 0.12, rough_cost = 7, alone_cost = 2;

/* Seams off the mirror plane that have none like them on its other side. */
static double length_alone(const ktg_search *s, const ktg_chains *chains) {
    double length = 0;
    for (uint32_t c = 0; c < chains->count; c++) {
        const ktg_chain *chain = &chains->chains[c];
        uint32_t e = chains->edges[chain->first + chain->count / 2];
        ktg_vec3 p = s->sheet->mesh->positions[s->sheet->ends[2 * (size_t)e]];
        bool off = fabs(ktg_mirror_side(&s->mirror, p)) > 2 * s->sheet->mean_edge;
        if (off && ktg_mirror_partner(s->sheet, &s->mirror, chains, c) == c)
            length += chain->length;
    }
    return length;
}

static ktg_status judge_seams(ktg_context *context, const ktg_search *s, ktg_outcome *o) {
    ktg_chains chains;
    KTG_TRY(ktg_chains_find(context, s->sheet, s->cut, NULL, &chains));
    for (uint32_t c = 0; c < chains.count; c++)
        o->awkward += chains.chains[c].length / sqrt(s->sheet->area);
    o->awkward += dart_cost * ktg_chains_darts(s->sheet, &chains);
    o->awkward += corner_cost * ktg_chains_corners(s->sheet, &chains);
    if (s->mirror.found)
        o->awkward += alone_cost * length_alone(s, &chains) / sqrt(s->sheet->area);
    ktg_chains_free(&chains);
    return KTG_OK;
}

static void add_panel(const ktg_search *s, const ktg_fit *fit, ktg_outcome *o) {
    o->beyond += !fit->good;
    o->failing += ktg_fit_failing(fit, &s->limit);
    o->worst = ktg_max(o->worst, fit->beyond);
    o->awkward += ktg_fit_shape(fit);
    o->awkward += fit->area < small_part * s->sheet->area ? small_cost : 0;
}

static ktg_status judge_panels(ktg_context *context, ktg_search *s, const ktg_mesh *mesh,
                               ktg_outcome *o) {
    ktg_fit *fits;
    uint32_t count;
    ktg_status status = ktg_fit_matched(context, mesh, s->cut, &s->limit, &fits, &count);
    for (uint32_t p = 0; status == KTG_OK && p < count; p++)
        add_panel(s, &fits[p], o);
    ktg_free(fits);
    return status;
}

static ktg_status judge_slid(ktg_context *context, ktg_search *s, double part, ktg_outcome *o) {
    ktg_mesh slid = s->mesh;
    slid.positions =
        ktg_copy_array(context, s->mesh.positions, s->mesh.vertex_count, sizeof(ktg_vec3));
    if (!slid.positions)
        return KTG_MEMORY;
    *o = (ktg_outcome){.slid = part, .awkward = rough_cost * (1 - part)};
    ktg_status status = KTG_OK;
    if (part > 0)
        status = ktg_seams_slide(context, &slid, s->adjacency, s->cut, s->given, part, NULL);
    if (status == KTG_OK)
        status = judge_panels(context, s, &slid, o);
    ktg_free(slid.positions);
    return status;
}

/* Slid as far as panels fit; where they do not in any way, as they do best. */
static ktg_status judge_all(ktg_context *context, ktg_search *s, ktg_outcome *o) {
    static const double parts[] = {1, 0.75, 0.5, 0};
    enum { count = sizeof parts / sizeof *parts };
    o->failing = INFINITY;
    for (int k = s->options->slide ? 0 : count - 1; k < count && o->failing > 0; k++) {
        ktg_outcome its;
        KTG_TRY(judge_slid(context, s, parts[k], &its));
        if (its.failing < o->failing)
            *o = its;
    }
    return judge_seams(context, s, o);
}

ktg_status ktg_search_judge(ktg_context *context, ktg_search *s, ktg_outcome *o) {
    double searched = s->limit.area_part;
    s->limit.area_part = s->options->area_part;
    ktg_status status = judge_all(context, s, o);
    s->limit.area_part = searched;
    o->exhausted = s->exhausted;
    return status;
}

bool ktg_outcome_is_better(const ktg_outcome *a, const ktg_outcome *b) {
    if (a->failing < 0.9 * b->failing || b->failing < 0.9 * a->failing)
        return a->failing < b->failing;
    return a->awkward < b->awkward;
}
