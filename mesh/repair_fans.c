/* mesh/repair_fans.c - one vertex for each fan of corners.
 *
 * Corners that meet across joins form a fan: a whole disk or, at a border, a part of one. The first
 * fan to ask keeps a vertex of the file, others get copies, so that a clean mesh stays as it is.
 * Two edges of different joins may still have both ends in common (a slit one edge long, two sheets
 * that touch along an edge inside): all but the first are then cut in the middle. */
#include "core/memory.h"
#include "core/sets.h"
#include "core/vec.h"
#include "mesh/repair.h"

#include <string.h>

typedef struct fans_work {
    uint32_t file_vertices, file_corners; /* before anything is added */
    uint32_t *fan;                        /* per corner */
    uint32_t *vertex;                     /* per fan (a corner's number): its vertex */
    uint32_t *before; /* per corner: the file's vertex, KTG_NONE where a cut made one */
    uint32_t *holder; /* per file vertex: the first fan that keeps it */
    bool *flag;
} fans_work;

static void gather_fans(const ktg_repair *repair, fans_work *w) {
    for (uint32_t h = 0; h < w->file_corners; h++)
        w->fan[h] = h;
    for (uint32_t h = 0; h < w->file_corners; h++) {
        uint32_t g = repair->mate[h];
        if (g == KTG_NONE)
            continue;
        ktg_set_join(w->fan, h, ktg_halfedge_next(g));
        ktg_set_join(w->fan, ktg_halfedge_next(h), g);
    }
}

/* Gives vertices to fans; returns how many have to be made anew. */
static uint32_t share_vertices(const ktg_repair *repair, fans_work *w) {
    const uint32_t *faces = repair->mesh->faces;
    uint32_t missing = 0;
    memset(w->vertex, 0xff, w->file_corners * sizeof *w->vertex);
    memset(w->holder, 0xff, w->file_vertices * sizeof *w->holder);
    for (uint32_t h = 0; h < w->file_corners; h++) {
        uint32_t fan = ktg_set_of(w->fan, h);
        if (w->vertex[fan] == KTG_NONE && w->holder[faces[h]] == KTG_NONE) {
            w->vertex[fan] = faces[h];
            w->holder[faces[h]] = fan;
        }
    }
    for (uint32_t h = 0; h < w->file_corners; h++)
        missing += ktg_set_of(w->fan, h) == h && w->vertex[h] == KTG_NONE;
    return missing;
}

/* Vertices of the file whose corners went to several fans, and those that another one stands for.
 */
static void count_changes(ktg_repair *repair, fans_work *w) {
    const uint32_t *faces = repair->mesh->faces;
    uint32_t *some_fan = w->holder; /* no longer needed as such */
    memset(some_fan, 0xff, w->file_vertices * sizeof *some_fan);
    memset(w->flag, 0, w->file_vertices * sizeof *w->flag);
    for (uint32_t h = 0; h < w->file_corners; h++) {
        uint32_t fan = ktg_set_of(w->fan, h), v = faces[h];
        if (some_fan[v] == KTG_NONE)
            some_fan[v] = fan;
        else if (some_fan[v] != fan && !w->flag[v]) {
            w->flag[v] = true;
            repair->report.nonmanifold_vertices_split++;
        }
    }
    memset(w->flag, 0, w->file_vertices * sizeof *w->flag);
    for (uint32_t h = 0; h < w->file_corners; h++) {
        uint32_t v = w->vertex[ktg_set_of(w->fan, h)];
        if (v < w->file_vertices)
            w->flag[v] = true;
    }
    for (uint32_t v = 0; v < w->file_vertices; v++) {
        repair->report.vertices_welded += some_fan[v] != KTG_NONE && !w->flag[v];
        repair->report.unreferenced_vertices_removed += some_fan[v] == KTG_NONE;
    }
}

static ktg_status set_vertices(ktg_repair *repair, fans_work *w) {
    ktg_mesh *mesh = repair->mesh;
    uint32_t next = mesh->vertex_count;
    KTG_TRY(ktg_repair_grow(repair->context, mesh, 0, share_vertices(repair, w)));
    for (uint32_t h = 0; h < w->file_corners; h++)
        if (ktg_set_of(w->fan, h) == h && w->vertex[h] == KTG_NONE) {
            ktg_repair_copy_vertex(mesh, mesh->faces[h], next);
            w->vertex[h] = next++;
        }
    count_changes(repair, w);
    for (uint32_t h = 0; h < w->file_corners; h++) {
        w->before[h] = mesh->faces[h];
        mesh->faces[h] = w->vertex[ktg_set_of(w->fan, h)];
    }
    return KTG_OK;
}

/* ---- pairs of vertices with several edges --------------------------------------------------- */

/* The half-edge and its mate, if any, get a vertex in the middle. Each of their faces becomes two:
 * (u, v, w) turns into (u, m, w) and (m, v, w). */
static ktg_status cut_side(ktg_repair *repair, fans_work *w, uint32_t h, uint32_t m,
                           uint32_t added) {
    uint32_t n = ktg_halfedge_next(h), far = repair->mate[n];
    KTG_TRY(ktg_repair_cut_face(repair->context, repair->mesh, h / 3, h % 3, m, 0.5, added));
    w->before[3 * added] = KTG_NONE;
    w->before[3 * added + 1] = w->before[n];
    w->before[3 * added + 2] = w->before[ktg_halfedge_next(n)];
    w->before[n] = KTG_NONE;
    repair->mate[3 * added] = KTG_NONE;
    repair->mate[3 * added + 1] = far;
    if (far != KTG_NONE)
        repair->mate[far] = 3 * added + 1;
    repair->mate[3 * added + 2] = n;
    repair->mate[n] = 3 * added + 2;
    return KTG_OK;
}

static void set_middle(ktg_mesh *mesh, uint32_t u, uint32_t v, uint32_t m) {
    const ktg_vec3 *p = mesh->positions;
    uint8_t *colours = mesh->vertex_colours;
    mesh->positions[m] = ktg_add3(ktg_mul3(p[u], 0.5), ktg_mul3(p[v], 0.5));
    for (size_t k = 0; colours && k < 3; k++)
        colours[3 * (size_t)m + k] =
            (uint8_t)((colours[3 * (size_t)u + k] + colours[3 * (size_t)v + k] + 1) / 2);
}

static ktg_status cut_edge(ktg_repair *repair, fans_work *w, uint32_t h) {
    ktg_mesh *mesh = repair->mesh;
    uint32_t g = repair->mate[h], added = mesh->face_count, m = mesh->vertex_count;
    uint32_t sides = g == KTG_NONE ? 1 : 2;
    repair->unsettled = true;
    size_t capacity = 3 * (size_t)added, same = capacity, needed = capacity + 3 * (size_t)sides;
    KTG_TRY(ktg_reserve(repair->context, &repair->mate, &capacity, needed));
    KTG_TRY(ktg_reserve(repair->context, &w->before, &same, needed));
    KTG_TRY(ktg_repair_grow(repair->context, mesh, sides, 1));
    set_middle(mesh, mesh->faces[h], mesh->faces[ktg_halfedge_next(h)], m);
    KTG_TRY(cut_side(repair, w, h, m, added));
    if (g == KTG_NONE)
        return KTG_OK;
    KTG_TRY(cut_side(repair, w, g, m, added + 1));
    repair->mate[h] = 3 * (added + 1);
    repair->mate[3 * (added + 1)] = h;
    repair->mate[g] = 3 * added;
    repair->mate[3 * added] = g;
    return KTG_OK;
}

/* Cuts those edges whose ends belong to an earlier one too. Faces already cut in this round wait
 * for the next. */
static ktg_status cut_round(ktg_repair *repair, fans_work *w, const ktg_adjacency *a, bool *cut,
                            bool *any) {
    for (uint32_t e = 0; e < a->edge_count; e++) {
        const uint32_t *halfedges = a->edge_halfedges + a->edge_first[e];
        uint32_t count = a->edge_first[e + 1] - a->edge_first[e];
        uint32_t first = halfedges[0], its_mate = repair->mate[first];
        if (count == 1 || (count == 2 && its_mate == halfedges[1]))
            continue;
        *any = true;
        for (uint32_t i = 1; i < count; i++) {
            uint32_t h = halfedges[i], g = repair->mate[h];
            bool busy = cut[h / 3] || (g != KTG_NONE && (g >= a->halfedge_count || cut[g / 3]));
            if (h == its_mate || busy || (g != KTG_NONE && g < h))
                continue;
            cut[h / 3] = true;
            if (g != KTG_NONE)
                cut[g / 3] = true;
            KTG_TRY(cut_edge(repair, w, h));
        }
    }
    return KTG_OK;
}

static ktg_status separate_edges(ktg_repair *repair, fans_work *w) {
    for (bool any = true; any;) {
        ktg_adjacency *adjacency;
        any = false;
        KTG_TRY(ktg_adjacency_new(repair->context, repair->mesh, &adjacency));
        bool *cut = ktg_new(repair->context, repair->mesh->face_count, bool);
        ktg_status status = cut ? cut_round(repair, w, adjacency, cut, &any) : KTG_MEMORY;
        ktg_free(cut);
        ktg_adjacency_free(&adjacency);
        KTG_TRY(status);
    }
    return KTG_OK;
}

/* ---- unused vertices ------------------------------------------------------------------------ */

static ktg_status drop_unused_vertices(ktg_repair *repair) {
    ktg_mesh *mesh = repair->mesh;
    uint32_t *renamed = ktg_new(repair->context, mesh->vertex_count, uint32_t), kept = 0;
    if (!renamed)
        return KTG_MEMORY;
    for (size_t h = 0; h < 3 * (size_t)mesh->face_count; h++)
        renamed[mesh->faces[h]] = 1;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        if (renamed[v]) {
            ktg_repair_copy_vertex(mesh, v, kept);
            renamed[v] = kept++;
        }
    for (size_t h = 0; h < 3 * (size_t)mesh->face_count; h++)
        mesh->faces[h] = renamed[mesh->faces[h]];
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++)
        mesh->marked_edges[i] = renamed[mesh->marked_edges[i]];
    mesh->vertex_count = kept;
    ktg_free(renamed);
    return KTG_OK;
}

static ktg_status make_fans(ktg_repair *repair, fans_work *w) {
    gather_fans(repair, w);
    KTG_TRY(set_vertices(repair, w));
    KTG_TRY(separate_edges(repair, w));
    if (repair->mesh->marked_edges)
        KTG_TRY(ktg_repair_carry_marks(repair, w->before));
    return drop_unused_vertices(repair);
}

ktg_status ktg_repair_fans(ktg_repair *repair) {
    uint32_t corners = 3 * repair->mesh->face_count, vertices = repair->mesh->vertex_count;
    fans_work w = {.file_vertices = vertices, .file_corners = corners};
    w.fan = ktg_new(repair->context, corners, uint32_t);
    w.vertex = ktg_new(repair->context, corners, uint32_t);
    w.before = ktg_new(repair->context, corners, uint32_t);
    w.holder = ktg_new(repair->context, vertices, uint32_t);
    w.flag = ktg_new(repair->context, vertices, bool);
    bool ready = w.fan && w.vertex && w.before && w.holder && w.flag;
    ktg_status status = ready ? make_fans(repair, &w) : KTG_MEMORY;
    ktg_free(w.fan);
    ktg_free(w.vertex);
    ktg_free(w.before);
    ktg_free(w.holder);
    ktg_free(w.flag);
    return status;
}
