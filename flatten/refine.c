/* flatten/refine.c - panels cut until they fit. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/search.h"

/* Faces laid flat in trials, at most: as many, or as many times the faces of the surface. */
static const double most_work = 2e6, most_work_times = 50;

/* A panel of so few faces is not halved any more when work has run out. */
enum { few_faces = 64 };

/* ---- one panel ----------------------------------------------------------------------------- */

/* Sets in the surface's flags what is set in the panel's. False when all was set before. */
static bool carry(ktg_search *s, const ktg_cut_panel *part, const ktg_sheet *sheet,
                  const bool *cut) {
    bool any = false;
    for (uint32_t h = 0; h < sheet->adjacency->halfedge_count; h++)
        if (cut[sheet->adjacency->halfedge_edge[h]] && sheet->adjacency->twin[h] != KTG_NONE) {
            bool *flag = &s->cut[s->adjacency->halfedge_edge[3 * part->face[h / 3] + h % 3]];
            any |= !*flag;
            *flag = true;
        }
    return any;
}

static void set_done(ktg_search *s, const ktg_cut_panel *part) {
    for (uint32_t f = 0; f < part->mesh->face_count; f++)
        s->done[part->face[f]] = true;
}

static bool may_go_on(ktg_search *s) {
    double most = fmax(most_work, most_work_times * s->mesh.face_count);
    bool more = (double)s->limit.work < s->budget * most;
    s->exhausted |= !more;
    return more;
}

static ktg_status try_ways(ktg_context *context, ktg_search *s, const ktg_sheet *sheet, bool *cut) {
    ktg_trial before;
    KTG_TRY(ktg_trial_run(context, sheet, cut, &s->limit, &before));
    return before.good ? KTG_OK : ktg_search_cut_panel(context, s, sheet, &before, cut);
}

/* What to cut when work has run out: what is no disk is opened, and what does not fit is halved
 * across its extent, without trials, down to a few faces. */
static ktg_status halve(ktg_context *context, ktg_search *s, const ktg_sheet *sheet, bool *cut) {
    ktg_fit fit;
    KTG_TRY(ktg_sheet_open(context, sheet->mesh, sheet->adjacency, cut));
    if (ktg_any(cut, sheet->edge_count))
        return KTG_OK;
    KTG_TRY(ktg_search_measure(context, s, sheet, &fit));
    if (fit.good || (fit.flat && sheet->mesh->face_count <= few_faces))
        return KTG_OK;
    return ktg_split_halve(context, sheet, cut);
}

static ktg_status find_cut(ktg_context *context, ktg_search *s, const ktg_cut_surface *parts,
                           uint32_t index, ktg_sheet *sheet, bool *cut) {
    if (!may_go_on(s))
        return halve(context, s, sheet, cut);
    KTG_TRY(ktg_sheet_find_slits(context, parts, index, s->adjacency, sheet));
    return try_ways(context, s, sheet, cut);
}

/* Cuts the panel, or says that it is done. A slit of one edge within it opens nothing, so that the
 * same would be found again: then it is opened as a whole, if it is no disk. */
static ktg_status apply(ktg_context *context, ktg_search *s, const ktg_cut_panel *part,
                        const ktg_sheet *sheet, bool *cut) {
    if (carry(s, part, sheet, cut))
        return KTG_OK;
    KTG_TRY(ktg_sheet_open(context, sheet->mesh, sheet->adjacency, cut));
    if (!carry(s, part, sheet, cut))
        set_done(s, part);
    return KTG_OK;
}

static ktg_status refine_panel(ktg_context *context, ktg_search *s, const ktg_cut_surface *parts,
                               uint32_t index) {
    const ktg_cut_panel *part = &parts->panels[index];
    ktg_sheet *sheet;
    KTG_TRY(ktg_sheet_new(context, part->mesh, NULL, &sheet));
    bool *cut = ktg_new(context, sheet->edge_count, bool);
    ktg_status status = cut ? find_cut(context, s, parts, index, sheet, cut) : KTG_MEMORY;
    if (status == KTG_OK && ktg_any(cut, sheet->edge_count))
        status = apply(context, s, part, sheet, cut);
    else if (status == KTG_OK)
        set_done(s, part);
    ktg_free(cut);
    ktg_sheet_free(&sheet);
    return status;
}

/* ---- all panels ---------------------------------------------------------------------------- */

static bool is_mirrored(const ktg_search *s, const ktg_cut_panel *part) {
    double side = 0;
    for (uint32_t f = 0; f < part->mesh->face_count; f++)
        side += ktg_length3(ktg_sheet_area(part->mesh, f)) *
                ktg_mirror_side(&s->mirror, ktg_face_centre(part->mesh, f));
    return side < 0;
}

/* The first panel with something to do; with `half` on the one side of the mirror only. */
static uint32_t next_panel(const ktg_search *s, const ktg_cut_surface *parts, bool half) {
    for (uint32_t p = 0; p < parts->count; p++)
        if (!s->done[parts->panels[p].face[0]] && !(half && is_mirrored(s, &parts->panels[p])))
            return p;
    return KTG_NONE;
}

static ktg_status refine_next(ktg_context *context, ktg_search *s, bool half, bool *ended) {
    ktg_cut_surface parts;
    KTG_TRY(ktg_cut_apart(context, &s->mesh, s->adjacency, s->cut, &parts));
    uint32_t index = next_panel(s, &parts, half);
    ktg_status status = KTG_OK;
    *ended = index == KTG_NONE;
    if (!*ended)
        status = refine_panel(context, s, &parts, index);
    ktg_cut_surface_free(&parts);
    return status;
}

ktg_status ktg_search_refine(ktg_context *context, ktg_search *s, bool half) {
    bool ended = false;
    for (uint32_t round = 0; !ended && !ktg_wants_finish(context); round++) {
        KTG_TRY(ktg_check_cancel(context));
        ktg_progress(context, "seams", 1 - 10.0 / (10 + round), NULL);
        KTG_TRY(refine_next(context, s, half, &ended));
    }
    s->exhausted |= !ended;
    return KTG_OK;
}
