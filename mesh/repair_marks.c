/* mesh/repair_marks.c - marked edges follow their corners through a repair. */
#include "core/memory.h"
#include "mesh/edge_index.h"
#include "mesh/repair.h"

#include <stdlib.h>
#include <string.h>

/* The edges of the result, as they are found. */
typedef struct marks {
    uint32_t *edges, *numbers;
    uint32_t count;
    size_t edge_capacity, number_capacity;
} marks;

static ktg_status append(ktg_repair *repair, marks *m, uint32_t mark, uint32_t from, uint32_t to) {
    const ktg_mesh *mesh = repair->mesh;
    KTG_TRY(ktg_reserve(repair->context, &m->edges, &m->edge_capacity, 2 * (size_t)m->count + 2));
    if (mesh->marked_numbers)
        KTG_TRY(
            ktg_reserve(repair->context, &m->numbers, &m->number_capacity, (size_t)m->count + 1));
    m->edges[2 * (size_t)m->count] = from;
    m->edges[2 * (size_t)m->count + 1] = to;
    if (mesh->marked_numbers)
        m->numbers[m->count] = mesh->marked_numbers[mark];
    m->count++;
    return KTG_OK;
}

/* ---- marks on edges that are cut --------------------------------------------------------------
 */

/* The marks as an index: a face for each, whose first edge it is. */
static ktg_status index_marks(ktg_repair *repair, ktg_edge_index *index) {
    const ktg_mesh *mesh = repair->mesh;
    uint32_t *corners = ktg_new(repair->context, 3 * (size_t)mesh->marked_count, uint32_t);
    if (!corners)
        return KTG_MEMORY;
    for (size_t i = 0; i < mesh->marked_count; i++) {
        corners[3 * i] = mesh->marked_edges[2 * i];
        corners[3 * i + 1] = mesh->marked_edges[2 * i + 1];
        corners[3 * i + 2] = KTG_NONE;
    }
    ktg_status status =
        ktg_edge_index_new(repair->context, corners, mesh->marked_count, NULL, index);
    ktg_free(corners);
    return status;
}

/* The two halves of each mark on the edge u v that is cut at m. */
static ktg_status halve(ktg_repair *repair, const ktg_edge_index *index, const ktg_mark_cut *cut,
                        marks *m) {
    const ktg_edge_entry *entry;
    size_t count = ktg_edge_index_find(index, cut->ends[0], cut->ends[1], &entry);
    for (size_t i = 0; i < count; i++) {
        uint32_t mark = entry[i].halfedge / 3;
        const uint32_t *ends = repair->mesh->marked_edges + 2 * (size_t)mark;
        KTG_TRY(append(repair, m, mark, ends[0], cut->middle));
        KTG_TRY(append(repair, m, mark, cut->middle, ends[1]));
    }
    return KTG_OK;
}

static ktg_status add_marks(ktg_repair *repair, const marks *m) {
    ktg_mesh *mesh = repair->mesh;
    size_t before = mesh->marked_count, all = before + m->count;
    size_t edges = 2 * before, numbers = before;
    KTG_TRY(ktg_reserve(repair->context, &mesh->marked_edges, &edges, 2 * all));
    if (mesh->marked_numbers)
        KTG_TRY(ktg_reserve(repair->context, &mesh->marked_numbers, &numbers, all));
    memcpy(mesh->marked_edges + 2 * before, m->edges, 2 * (size_t)m->count * sizeof *m->edges);
    if (mesh->marked_numbers)
        memcpy(mesh->marked_numbers + before, m->numbers, m->count * sizeof *m->numbers);
    mesh->marked_count = (uint32_t)all;
    return KTG_OK;
}

static int compare_cuts(const void *a, const void *b) {
    return memcmp(a, b, sizeof(ktg_mark_cut));
}

/* Several faces at an edge are cut alike, but its marks are halved once. */
static size_t unite_cuts(ktg_mark_cut *cuts, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t a = cuts[i].ends[0], b = cuts[i].ends[1];
        cuts[i].ends[0] = a < b ? a : b;
        cuts[i].ends[1] = a < b ? b : a;
    }
    qsort(cuts, count, sizeof *cuts, compare_cuts);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || compare_cuts(&cuts[i], &cuts[kept - 1]) != 0)
            cuts[kept++] = cuts[i];
    return kept;
}

ktg_status ktg_repair_cut_marks(ktg_repair *repair, ktg_mark_cut *cuts, size_t count) {
    ktg_edge_index index = {0};
    marks m = {0};
    if (repair->mesh->marked_count == 0 || count == 0)
        return KTG_OK;
    count = unite_cuts(cuts, count);
    ktg_status status = index_marks(repair, &index);
    for (size_t i = 0; status == KTG_OK && i < count; i++)
        status = halve(repair, &index, &cuts[i], &m);
    if (status == KTG_OK && m.count > 0)
        status = add_marks(repair, &m);
    ktg_edge_index_free(&index);
    ktg_free(m.edges);
    ktg_free(m.numbers);
    return status;
}

/* ---- marks on what has become of their vertices -----------------------------------------------
 */

/* A mark becomes the edges that its two vertices' corners are at now; where both sides of an edge
 * bore it, that is one. */
static ktg_status carry(ktg_repair *repair, const uint32_t *before, const ktg_edge_index *index,
                        uint32_t mark, marks *m) {
    const ktg_mesh *mesh = repair->mesh;
    uint32_t a = mesh->marked_edges[2 * (size_t)mark];
    uint32_t b = mesh->marked_edges[2 * (size_t)mark + 1];
    const ktg_edge_entry *entry;
    size_t count = ktg_edge_index_find(index, a, b, &entry);
    for (size_t i = 0; i < count; i++) {
        uint32_t h = entry[i].halfedge, next = ktg_halfedge_next(h), g = repair->mate[h];
        uint32_t g_next = g == KTG_NONE ? KTG_NONE : ktg_halfedge_next(g);
        bool again =
            g != KTG_NONE && g < h &&
            ((before[g] == a && before[g_next] == b) || (before[g] == b && before[g_next] == a));
        if (again)
            continue;
        bool along = before[h] == a;
        KTG_TRY(
            append(repair, m, mark, mesh->faces[along ? h : next], mesh->faces[along ? next : h]));
    }
    return KTG_OK;
}

ktg_status ktg_repair_carry_marks(ktg_repair *repair, const uint32_t *before) {
    ktg_mesh *mesh = repair->mesh;
    ktg_edge_index index;
    marks m = {0};
    KTG_TRY(ktg_edge_index_new(repair->context, before, mesh->face_count, NULL, &index));
    ktg_status status = KTG_OK;
    for (uint32_t i = 0; status == KTG_OK && i < mesh->marked_count; i++)
        status = carry(repair, before, &index, i, &m);
    ktg_edge_index_free(&index);
    if (status != KTG_OK) {
        ktg_free(m.edges);
        ktg_free(m.numbers);
        return status;
    }
    ktg_free(mesh->marked_edges);
    ktg_free(mesh->marked_numbers);
    mesh->marked_edges = m.edges;
    mesh->marked_numbers = m.numbers;
    mesh->marked_count = m.count;
    return KTG_OK;
}
