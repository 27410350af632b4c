/* flatten/chain.c - seams as runs of edges between the places where they meet or end. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

typedef struct walk {
    const ktg_sheet *sheet;
    bool *open;      /* edge_count: still to be walked */
    uint32_t *seams; /* vertex_count: seam edges there */
    ktg_chains *out;
    uint32_t edges; /* written so far */
} walk;

/* Every run ends here: on the border, at a crossing or an end of seams. */
static bool is_node(const walk *w, uint32_t v) {
    return w->sheet->border[v] || w->seams[v] != 2;
}

static uint32_t open_edge_at(const walk *w, uint32_t v) {
    for (uint32_t i = w->sheet->first[v]; i < w->sheet->first[v + 1]; i++)
        if (w->open[w->sheet->around[i]])
            return w->sheet->around[i];
    return KTG_NONE;
}

/* Walks from v along `edge` to the next node or to where there is no way on. */
static void walk_chain(walk *w, uint32_t v, uint32_t edge) {
    ktg_chain *chain = &w->out->chains[w->out->count++];
    *chain = (ktg_chain){.first = w->edges, .ends = {v, v}};
    while (edge != KTG_NONE) {
        w->open[edge] = false;
        w->out->edges[w->edges++] = edge;
        chain->length += w->sheet->length[edge];
        v = ktg_sheet_other_end(w->sheet, edge, v);
        edge = is_node(w, v) ? KTG_NONE : open_edge_at(w, v);
    }
    chain->ends[1] = v;
    chain->count = w->edges - chain->first;
}

/* From the nodes first; what is left are loops. Fixed edges end a run as well: where they are met,
 * a vertex has no open edge on the other side. */
static void walk_all(walk *w) {
    for (uint32_t v = 0; v < w->sheet->mesh->vertex_count; v++)
        for (uint32_t e = KTG_NONE; is_node(w, v) && (e = open_edge_at(w, v)) != KTG_NONE;)
            walk_chain(w, v, e);
    for (uint32_t v = 0; v < w->sheet->mesh->vertex_count; v++) {
        uint32_t open = 0;
        for (uint32_t i = w->sheet->first[v]; i < w->sheet->first[v + 1]; i++)
            open += w->open[w->sheet->around[i]];
        if (open == 1 && w->seams[v] == 2)
            walk_chain(w, v, open_edge_at(w, v));
    }
    for (uint32_t e = 0; e < w->sheet->edge_count; e++)
        if (w->open[e])
            walk_chain(w, w->sheet->ends[2 * (size_t)e], e);
}

static ktg_status find_chains(ktg_context *context, walk *w, const bool *cut, const bool *fixed) {
    const ktg_sheet *s = w->sheet;
    w->open = ktg_new(context, s->edge_count, bool);
    w->seams = ktg_new(context, s->mesh->vertex_count, uint32_t);
    if (!w->open || !w->seams)
        return KTG_MEMORY;
    uint32_t count = 0;
    for (uint32_t e = 0; e < s->edge_count; e++) {
        if (!cut[e] || ktg_sheet_is_border(s, e))
            continue;
        w->seams[s->ends[2 * (size_t)e]]++;
        w->seams[s->ends[2 * (size_t)e + 1]]++;
        w->open[e] = !(fixed && fixed[e]);
        count += w->open[e];
    }
    w->out->edges = ktg_new(context, count, uint32_t);
    w->out->chains = ktg_new(context, count, ktg_chain);
    if (!w->out->edges || !w->out->chains)
        return KTG_MEMORY;
    walk_all(w);
    return KTG_OK;
}

ktg_status ktg_chains_find(ktg_context *context, const ktg_sheet *sheet, const bool *cut,
                           const bool *fixed, ktg_chains *chains) {
    *chains = (ktg_chains){0};
    walk w = {.sheet = sheet, .out = chains};
    ktg_status status = find_chains(context, &w, cut, fixed);
    ktg_free(w.open);
    ktg_free(w.seams);
    if (status != KTG_OK)
        ktg_chains_free(chains);
    return status;
}

void ktg_chains_free(ktg_chains *chains) {
    ktg_free(chains->chains);
    ktg_free(chains->edges);
    *chains = (ktg_chains){0};
}

/* Ends at v of all runs, that one included. */
static uint32_t ends_at(const ktg_chains *chains, uint32_t v) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < chains->count; i++)
        for (int k = 0; k < 2; k++)
            count += chains->chains[i].ends[k] == v;
    return count;
}

static uint32_t count_ends(const ktg_sheet *sheet, const ktg_chains *chains, bool alone) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < chains->count; i++)
        for (int k = 0; k < 2; k++) {
            uint32_t v = chains->chains[i].ends[k];
            count += !sheet->border[v] && (ends_at(chains, v) == 1) == alone;
        }
    return count;
}

uint32_t ktg_chains_darts(const ktg_sheet *sheet, const ktg_chains *chains) {
    return count_ends(sheet, chains, true);
}

uint32_t ktg_chains_corners(const ktg_sheet *sheet, const ktg_chains *chains) {
    return count_ends(sheet, chains, false);
}
