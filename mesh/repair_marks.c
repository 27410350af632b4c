/* mesh/repair_marks.c - marked edges follow their corners through a repair. */
#include "core/memory.h"
#include "mesh/edge_index.h"
#include "mesh/repair.h"

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
