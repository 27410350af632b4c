/* flatten/revise.c - seams looked at again when all is cut: every run of them has to show that it
 * is needed, and may run straighter.
 *
 * A change is tried together with its mirror image, and kept when all panels beside it fit and are,
 * with the seams, not more awkward to sew than before. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <stdlib.h>
#include <string.h>

enum { most_passes = 8, cache_size = 4096 };

/* A panel of less than this part of the surface is small. */
static const double small_part = 0.02;

/* What a panel was measured to be, found by its faces and vertices. */
typedef struct cached_fit {
    uint64_t hash; /* 0: empty */
    bool disk;
    ktg_fit fit;
} cached_fit;

typedef struct revising {
    const ktg_revision *about;
    bool *cut, *trial; /* edge_count */
    cached_fit *cache; /* cache_size */
    ktg_chains chains;
    double unit; /* of length: square root of the surface's area */
} revising;

/* ---- judging ------------------------------------------------------------------------------- */

/* FNV-1a over what makes the panel. */
static uint64_t hash_of(const ktg_cut_panel *panel) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (uint32_t f = 0; f < panel->mesh->face_count; f++) {
        hash = (hash ^ panel->face[f]) * 0x100000001b3u;
        for (int k = 0; k < 3; k++)
            hash = (hash ^ panel->mesh->faces[3 * (size_t)f + k]) * 0x100000001b3u;
    }
    return hash ? hash : 1;
}

static ktg_status measure(ktg_context *context, const revising *r, const ktg_cut_panel *panel,
                          cached_fit *measured) {
    ktg_sheet *sheet;
    KTG_TRY(ktg_sheet_new(context, panel->mesh, NULL, &sheet));
    ktg_status status = KTG_OK;
    measured->disk = ktg_sheet_is_disk(sheet);
    if (measured->disk)
        status = ktg_fit_measure(context, panel->mesh, r->about->limit, &measured->fit);
    ktg_sheet_free(&sheet);
    return status;
}

static ktg_status recall(ktg_context *context, const revising *r, const ktg_cut_panel *panel,
                         const cached_fit **known) {
    uint64_t hash = hash_of(panel);
    cached_fit *slot = &r->cache[hash % cache_size];
    *known = slot;
    if (slot->hash == hash)
        return KTG_OK;
    *slot = (cached_fit){0};
    KTG_TRY(measure(context, r, panel, slot));
    slot->hash = hash;
    return KTG_OK;
}

/* Marks the panels on either side of these edges. */
static void mark_panels(const revising *r, const ktg_cut_surface *parts, const uint32_t *edges,
                        uint32_t count, bool *marked) {
    const ktg_adjacency *a = r->about->sheet->adjacency;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = a->edge_first[edges[i]]; k < a->edge_first[edges[i] + 1]; k++)
            marked[parts->face_panel[a->edge_halfedges[k] / 3]] = true;
}

typedef struct judgement {
    bool good;      /* disks that can be laid flat */
    double failing; /* area that is beyond the limit and should not be */
    double awkward; /* panels' shapes and the seams' length */
    double least;   /* area of the smallest panel */
} judgement;

static ktg_status judge_panels(ktg_context *context, const revising *r,
                               const ktg_cut_surface *parts, const uint32_t *pair, bool *marked,
                               judgement *j) {
    for (int k = 0; k < 2; k++) {
        const ktg_chain *c = &r->chains.chains[pair[k]];
        mark_panels(r, parts, r->chains.edges + c->first, c->count, marked);
    }
    for (uint32_t p = 0; p < parts->count; p++) {
        const cached_fit *known;
        if (!marked[p])
            continue;
        KTG_TRY(recall(context, r, &parts->panels[p], &known));
        j->good &= known->disk && known->fit.known && known->fit.flat;
        j->failing += ktg_fit_failing(&known->fit, r->about->limit);
        j->awkward += ktg_fit_shape(&known->fit);
        j->least = ktg_min(j->least, known->fit.area);
    }
    return KTG_OK;
}

static double seam_cost(const ktg_sheet *sheet, const bool *cut) {
    double cost = 0;
    for (uint32_t e = 0; e < sheet->edge_count; e++)
        cost += cut[e] ? sheet->length[e] : 0;
    return cost;
}

/* The panels beside a pair of runs, with the seams of `cut`. */
static ktg_status judge(ktg_context *context, const revising *r, const bool *cut,
                        const uint32_t *pair, judgement *j) {
    const ktg_sheet *s = r->about->sheet;
    ktg_cut_surface parts;
    *j = (judgement){true, 0, seam_cost(s, cut) / r->unit, s->area};
    KTG_TRY(ktg_cut_apart(context, s->mesh, s->adjacency, cut, &parts));
    bool *marked = ktg_new(context, parts.count, bool);
    ktg_status status = marked ? judge_panels(context, r, &parts, pair, marked, j) : KTG_MEMORY;
    ktg_free(marked);
    ktg_cut_surface_free(&parts);
    return status;
}

/* ---- changes ------------------------------------------------------------------------------- */

/* Makes a change to one run in r->trial. */
typedef ktg_status change(ktg_context *context, revising *r, uint32_t chain);

static ktg_status take_away(ktg_context *context, revising *r, uint32_t chain) {
    const ktg_chain *c = &r->chains.chains[chain];
    (void)context;
    for (uint32_t i = 0; i < c->count; i++)
        r->trial[r->chains.edges[c->first + i]] = false;
    return KTG_OK;
}

/* What runs along the mirror plane is straight already, and is to stay there. */
static ktg_status straighten(ktg_context *context, revising *r, uint32_t chain) {
    const ktg_chain *c = &r->chains.chains[chain];
    if (r->about->plane && r->about->plane[r->chains.edges[c->first + c->count / 2]])
        return KTG_OK;
    const ktg_sheet *s = r->about->sheet;
    return ktg_chain_smooth(context, s, s->cost, &r->chains, chain, r->trial);
}

/* Tries a change on a run and its mirror image (which may be itself). */
static ktg_status try_change(ktg_context *context, revising *r, change *make, const uint32_t *pair,
                             bool *kept) {
    const size_t size = r->about->sheet->edge_count * sizeof *r->cut;
    judgement before, after;
    *kept = false;
    memcpy(r->trial, r->cut, size);
    KTG_TRY(make(context, r, pair[0]));
    if (pair[1] != pair[0])
        KTG_TRY(make(context, r, pair[1]));
    if (memcmp(r->trial, r->cut, size) == 0)
        return KTG_OK;
    KTG_TRY(judge(context, r, r->trial, pair, &after));
    if (!after.good)
        return KTG_OK;
    KTG_TRY(judge(context, r, r->cut, pair, &before));
    if (r->about->small_only && before.least > small_part * r->about->sheet->area)
        return KTG_OK;
    *kept = !before.good || (after.failing <= before.failing && after.awkward < before.awkward);
    if (*kept)
        memcpy(r->cut, r->trial, size);
    return KTG_OK;
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

/* Long seams first, those along creases last; of two alike the one in front, where it is seen. */
static double importance(const revising *r, uint32_t chain) {
    const ktg_sheet *s = r->about->sheet;
    const ktg_chain *c = &r->chains.chains[chain];
    uint32_t e = r->chains.edges[c->first + c->count / 2];
    double cost = 0;
    for (uint32_t i = 0; i < c->count; i++)
        cost += s->cost[r->chains.edges[c->first + i]];
    return cost * (1 + 0.3 * s->mesh->positions[s->ends[2 * (size_t)e]].z);
}

static ktg_status find_turns(ktg_context *context, revising *r, turn **turns) {
    KTG_TRY(ktg_chains_find(context, r->about->sheet, r->cut, r->about->fixed, &r->chains));
    *turns = ktg_new(context, r->chains.count, turn);
    if (!*turns)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < r->chains.count; i++)
        (*turns)[i] = (turn){importance(r, i), i};
    qsort(*turns, r->chains.count, sizeof **turns, highest_first);
    return KTG_OK;
}

/* The first change that is kept from turn *next on, where the next one to try is then. */
static ktg_status revise_once(ktg_context *context, revising *r, change *make, const turn *turns,
                              uint32_t *next, bool *kept) {
    *kept = false;
    for (; *next < r->chains.count && !*kept; *next += !*kept) {
        uint32_t pair[2] = {turns[*next].chain, turns[*next].chain};
        KTG_TRY(ktg_check_cancel(context));
        if (r->about->limit->work > r->about->most_work || ktg_wants_finish(context))
            *next = r->chains.count;
        else {
            if (r->about->mirror->found && !r->about->small_only)
                pair[1] =
                    ktg_mirror_partner(r->about->sheet, r->about->mirror, &r->chains, pair[0]);
            KTG_TRY(try_change(context, r, make, pair, kept));
        }
    }
    return KTG_OK;
}

/* Looks at every run once; after a change the runs are others, and it goes on among those. */
static ktg_status revise_pass(ktg_context *context, revising *r, change *make, bool *any) {
    bool kept = true;
    uint32_t next = 0;
    *any = false;
    while (kept) {
        turn *turns = NULL;
        ktg_status status = find_turns(context, r, &turns);
        if (status == KTG_OK)
            status = revise_once(context, r, make, turns, &next, &kept);
        *any |= kept;
        next += kept && make == straighten; /* that run is still there */
        ktg_free(turns);
        ktg_chains_free(&r->chains);
        KTG_TRY(status);
    }
    return KTG_OK;
}

static ktg_status revise(ktg_context *context, const ktg_revision *revision, change *make,
                         int passes, bool *cut) {
    revising r = {.about = revision, .cut = cut, .unit = sqrt(revision->sheet->area)};
    r.trial = ktg_new(context, revision->sheet->edge_count, bool);
    r.cache = ktg_new(context, cache_size, cached_fit);
    ktg_status status = r.trial && r.cache ? KTG_OK : KTG_MEMORY;
    bool any = true;
    for (int pass = 0; status == KTG_OK && any && pass < passes; pass++)
        status = revise_pass(context, &r, make, &any);
    ktg_free(r.trial);
    ktg_free(r.cache);
    return status;
}

ktg_status ktg_seams_merge(ktg_context *context, const ktg_revision *revision, bool *cut) {
    return revise(context, revision, take_away, most_passes, cut);
}

ktg_status ktg_seams_polish(ktg_context *context, const ktg_revision *revision, bool *cut) {
    return revise(context, revision, straighten, 1, cut);
}
