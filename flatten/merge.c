/* flatten/merge.c - seams that are not needed, taken away: every run of seams has to show that the
 * panels beside it do not fit without it. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <stdlib.h>
#include <string.h>

enum { most_rounds = 40 };

typedef struct merging {
    const ktg_sheet *sheet;
    const bool *fixed;
    const ktg_mirror *mirror;
    ktg_fit_limit *limit;
    uint64_t most_work;
    bool *cut, *trial; /* edge_count */
    ktg_chains chains;
} merging;

/* ---- one trial ----------------------------------------------------------------------------- */

static void set_chain(const merging *m, uint32_t chain, bool *flags, bool value) {
    const ktg_chain *c = &m->chains.chains[chain];
    for (uint32_t i = 0; i < c->count; i++)
        flags[m->chains.edges[c->first + i]] = value;
}

/* Marks the panels on either side of a run. */
static void mark_panels(const merging *m, const ktg_cut_surface *parts, uint32_t chain,
                        bool *marked) {
    const ktg_adjacency *a = m->sheet->adjacency;
    const ktg_chain *c = &m->chains.chains[chain];
    for (uint32_t i = 0; i < c->count; i++) {
        uint32_t e = m->chains.edges[c->first + i];
        for (uint32_t k = a->edge_first[e]; k < a->edge_first[e + 1]; k++)
            marked[parts->face_panel[a->edge_halfedges[k] / 3]] = true;
    }
}

static ktg_status fits(ktg_context *context, const merging *m, const ktg_mesh *panel, bool *good) {
    ktg_sheet *sheet;
    ktg_fit fit = {0};
    KTG_TRY(ktg_sheet_new(context, panel, NULL, &sheet));
    ktg_status status = KTG_OK;
    bool disk = (int64_t)panel->vertex_count - sheet->edge_count + panel->face_count == 1;
    if (disk)
        status = ktg_fit_measure(context, panel, m->limit, &fit);
    *good = disk && fit.good;
    ktg_sheet_free(&sheet);
    return status;
}

/* Do all panels beside the runs fit with the seams of m->trial? */
static ktg_status all_fit(ktg_context *context, const merging *m, const ktg_cut_surface *parts,
                          const uint32_t *pair, bool *good) {
    bool *marked = ktg_new(context, parts->count, bool);
    if (!marked)
        return KTG_MEMORY;
    mark_panels(m, parts, pair[0], marked);
    mark_panels(m, parts, pair[1], marked);
    ktg_status status = KTG_OK;
    for (uint32_t p = 0; status == KTG_OK && *good && p < parts->count; p++)
        if (marked[p])
            status = fits(context, m, parts->panels[p].mesh, good);
    ktg_free(marked);
    return status;
}

/* Takes away a run and its mirror image (which may be itself), if what they part fits then. */
static ktg_status try_without(ktg_context *context, merging *m, const uint32_t *pair, bool *taken) {
    ktg_cut_surface parts;
    *taken = true;
    memcpy(m->trial, m->cut, m->sheet->edge_count * sizeof *m->cut);
    set_chain(m, pair[0], m->trial, false);
    set_chain(m, pair[1], m->trial, false);
    KTG_TRY(ktg_cut_apart(context, m->sheet->mesh, m->sheet->adjacency, m->trial, &parts));
    ktg_status status = all_fit(context, m, &parts, pair, taken);
    ktg_cut_surface_free(&parts);
    if (status == KTG_OK && *taken)
        memcpy(m->cut, m->trial, m->sheet->edge_count * sizeof *m->cut);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

typedef struct turn {
    double key;
    uint32_t chain;
} turn;

static int highest_first(const void *a, const void *b) {
    const turn *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? 1 : -1;
    return (x->chain > y->chain) - (x->chain < y->chain);
}

/* Long seams first; of two alike the one in front, where it is seen. */
static double importance(const merging *m, uint32_t chain) {
    const ktg_chain *c = &m->chains.chains[chain];
    uint32_t e = m->chains.edges[c->first + c->count / 2];
    return c->length * (1 + 0.3 * m->sheet->mesh->positions[m->sheet->ends[2 * (size_t)e]].z);
}

static ktg_status merge_round(ktg_context *context, merging *m, turn *turns, bool *taken) {
    for (uint32_t i = 0; i < m->chains.count; i++)
        turns[i] = (turn){importance(m, i), i};
    qsort(turns, m->chains.count, sizeof *turns, highest_first);
    *taken = false;
    for (uint32_t i = 0; i < m->chains.count && !*taken && m->limit->work < m->most_work; i++) {
        uint32_t pair[2] = {turns[i].chain, turns[i].chain};
        KTG_TRY(ktg_check_cancel(context));
        if (ktg_wants_finish(context))
            break;
        if (m->mirror->found)
            pair[1] = ktg_mirror_partner(m->sheet, m->mirror, &m->chains, pair[0]);
        KTG_TRY(try_without(context, m, pair, taken));
    }
    return KTG_OK;
}

static ktg_status merge_all(ktg_context *context, merging *m) {
    bool taken = true;
    for (int round = 0; taken && round < most_rounds; round++) {
        KTG_TRY(ktg_chains_find(context, m->sheet, m->cut, m->fixed, &m->chains));
        turn *turns = ktg_new(context, m->chains.count, turn);
        ktg_status status = turns ? merge_round(context, m, turns, &taken) : KTG_MEMORY;
        ktg_free(turns);
        ktg_chains_free(&m->chains);
        KTG_TRY(status);
    }
    return KTG_OK;
}

ktg_status ktg_seams_merge(ktg_context *context, const ktg_sheet *sheet, const bool *fixed,
                           const ktg_mirror *mirror, ktg_fit_limit *limit, uint64_t most_work,
                           bool *cut) {
    merging m = {.sheet = sheet, .fixed = fixed, .mirror = mirror, .limit = limit, .cut = cut};
    m.most_work = limit->work + most_work;
    m.trial = ktg_new(context, sheet->edge_count, bool);
    ktg_status status = m.trial ? merge_all(context, &m) : KTG_MEMORY;
    ktg_free(m.trial);
    return status;
}
