/* flatten/smooth.c - seams led anew, near where they were, so that they can be sewn. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <string.h>

/* How far a seam may move: edges, or part of its length where that is more. */
static const double reach_edges = 2.5, reach_length = 0.1;

/* A piece of a run that is led anew. */
typedef struct stretch {
    const ktg_sheet *sheet;
    const double *cost;
    bool *cut;
    const uint32_t *old; /* edges in order */
    uint32_t count;
    uint32_t ends[2];
    double reach;
    /* workspace: vertex_count each */
    bool *on, *from, *to, *forbidden;
    double *distance;
    uint32_t *edges;
    uint32_t *seams; /* seam edges at each vertex */
} stretch;

static ktg_status take_memory(ktg_context *context, stretch *s) {
    const uint32_t count = s->sheet->mesh->vertex_count;
    s->on = ktg_new(context, count, bool);
    s->from = ktg_new(context, count, bool);
    s->to = ktg_new(context, count, bool);
    s->forbidden = ktg_new(context, count, bool);
    s->distance = ktg_new(context, count, double);
    s->edges = ktg_new(context, count, uint32_t);
    s->seams = ktg_new(context, count, uint32_t);
    return s->on && s->from && s->to && s->forbidden && s->distance && s->edges && s->seams
               ? KTG_OK
               : KTG_MEMORY;
}

static void free_memory(stretch *s) {
    ktg_free(s->on);
    ktg_free(s->from);
    ktg_free(s->to);
    ktg_free(s->forbidden);
    ktg_free(s->distance);
    ktg_free(s->edges);
    ktg_free(s->seams);
}

static void set_edges(const stretch *s, const uint32_t *edges, uint32_t count, bool value) {
    for (uint32_t i = 0; i < count; i++)
        s->cut[edges[i]] = value;
}

static void count_seams(stretch *s) {
    memset(s->seams, 0, s->sheet->mesh->vertex_count * sizeof *s->seams);
    for (uint32_t e = 0; e < s->sheet->edge_count; e++)
        if (s->cut[e] && !ktg_sheet_is_border(s->sheet, e))
            for (int k = 0; k < 2; k++)
                s->seams[s->sheet->ends[2 * (size_t)e + k]]++;
}

/* Where the path may start (or end): the old end, and where that is the border and no other seam
 * ends there, the border nearby. */
static void set_ends(const stretch *s, uint32_t end, bool slides, bool *flags) {
    const ktg_vec3 *p = s->sheet->mesh->positions;
    memset(flags, 0, s->sheet->mesh->vertex_count * sizeof *flags);
    flags[end] = true;
    if (!slides || !s->sheet->border[end] || s->seams[end] > 0)
        return;
    for (uint32_t v = 0; v < s->sheet->mesh->vertex_count; v++)
        if (s->sheet->border[v] && s->seams[v] == 0 && s->distance[v] <= s->reach &&
            ktg_length3(ktg_sub3(p[v], p[end])) <= s->reach)
            flags[v] = true;
}

static bool ends_are_apart(const stretch *s) {
    for (uint32_t v = 0; v < s->sheet->mesh->vertex_count; v++)
        if (s->from[v] && s->to[v])
            return false;
    return true;
}

static ktg_status find_corridor(ktg_context *context, stretch *s) {
    const ktg_sheet *sheet = s->sheet;
    memset(s->on, 0, sheet->mesh->vertex_count * sizeof *s->on);
    for (uint32_t i = 0; i < s->count; i++)
        s->on[sheet->ends[2 * (size_t)s->old[i]]] = s->on[sheet->ends[2 * (size_t)s->old[i] + 1]] =
            true;
    KTG_TRY(ktg_path_distances(context, sheet, sheet->length, s->on, s->distance, NULL));
    count_seams(s);
    for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++)
        s->forbidden[v] = s->distance[v] > s->reach || sheet->border[v] || s->seams[v] > 0;
    for (int slides = 1; slides >= 0; slides--) {
        set_ends(s, s->ends[0], slides, s->from);
        set_ends(s, s->ends[1], slides, s->to);
        if (ends_are_apart(s))
            break;
    }
    return KTG_OK;
}

/* The old edges are out of `cut` meanwhile. */
static ktg_status lead_anew(ktg_context *context, stretch *s, uint32_t *count) {
    *count = 0;
    KTG_TRY(find_corridor(context, s));
    if (s->ends[0] == s->ends[1])
        return KTG_OK;
    ktg_path_query query = {.sheet = s->sheet,
                            .cost = s->cost,
                            .from = s->from,
                            .to = s->to,
                            .forbidden = s->forbidden,
                            .straight_on = KTG_NONE};
    return ktg_path_find(context, &query, s->edges, count);
}

static ktg_status smooth_stretch(ktg_context *context, stretch *s) {
    uint32_t count = 0;
    set_edges(s, s->old, s->count, false);
    ktg_status status = take_memory(context, s);
    if (status == KTG_OK)
        status = lead_anew(context, s, &count);
    bool found = status == KTG_OK && count > 0;
    set_edges(s, found ? s->edges : s->old, found ? count : s->count, true);
    free_memory(s);
    return status;
}

/* The vertex between edges i - 1 and i of a run. */
static uint32_t vertex_at(const ktg_sheet *sheet, const uint32_t *edges, uint32_t start,
                          uint32_t i) {
    uint32_t v = start;
    for (uint32_t k = 0; k < i; k++)
        v = ktg_sheet_other_end(sheet, edges[k], v);
    return v;
}

/* What comes back to its start is led anew half by half. */
ktg_status ktg_chain_smooth(ktg_context *context, const ktg_sheet *sheet, const double *cost,
                            const ktg_chains *chains, uint32_t chain, bool *cut) {
    const ktg_chain *c = &chains->chains[chain];
    const uint32_t *edges = chains->edges + c->first;
    uint32_t middle = c->ends[0] == c->ends[1] ? c->count / 2 : c->count;
    stretch s = {.sheet = sheet, .cost = cost, .cut = cut, .old = edges, .count = middle};
    s.reach = ktg_max(reach_edges * sheet->mean_edge, reach_length * c->length);
    s.ends[0] = c->ends[0];
    s.ends[1] = vertex_at(sheet, edges, c->ends[0], middle);
    if (middle > 0)
        KTG_TRY(smooth_stretch(context, &s));
    if (middle == c->count)
        return KTG_OK;
    stretch rest = {.sheet = sheet, .cost = cost, .cut = cut, .reach = s.reach};
    rest.old = edges + middle;
    rest.count = c->count - middle;
    rest.ends[0] = s.ends[1];
    rest.ends[1] = c->ends[1];
    return smooth_stretch(context, &rest);
}

ktg_status ktg_seams_smooth(ktg_context *context, const ktg_sheet *sheet, const double *cost,
                            const bool *fixed, bool *cut) {
    for (int round = 0; round < 2; round++) {
        ktg_chains chains;
        KTG_TRY(ktg_chains_find(context, sheet, cut, fixed, &chains));
        ktg_status status = KTG_OK;
        for (uint32_t c = 0; status == KTG_OK && c < chains.count; c++)
            status = ktg_chain_smooth(context, sheet, cost, &chains, c, cut);
        ktg_chains_free(&chains);
        KTG_TRY(status);
    }
    return KTG_OK;
}
