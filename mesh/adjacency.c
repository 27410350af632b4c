/* mesh/adjacency.c - which half-edges share an edge; any number may. */
#include "core/memory.h"
#include "mesh/mesh.h"

/* Open addressing over undirected vertex pairs; a slot holds an edge number. */
typedef struct edge_table {
    size_t mask;
    uint32_t *slots;
} edge_table;

static uint64_t pair_hash(uint32_t low, uint32_t high) {
    uint64_t key = ((uint64_t)high << 32 | low) * 0x9e3779b97f4a7c15u;
    return key ^ (key >> 29);
}

/* The edge between two vertices; `count` (a new one) when it is not there yet. `ends` holds two
 * vertices, lower first, for each edge so far. */
static uint32_t table_find(edge_table *table, uint32_t *ends, uint32_t count, uint32_t a,
                           uint32_t b) {
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t slot = pair_hash(low, high) & table->mask;
    while (table->slots[slot] != 0) {
        uint32_t edge = table->slots[slot] - 1;
        if (ends[2 * edge] == low && ends[2 * edge + 1] == high)
            return edge;
        slot = (slot + 1) & table->mask;
    }
    table->slots[slot] = count + 1;
    ends[2 * count] = low;
    ends[2 * count + 1] = high;
    return count;
}

static ktg_status number_edges(ktg_context *context, const ktg_mesh *mesh, ktg_adjacency *a) {
    edge_table table = {.mask = 15};
    while (table.mask < 2 * (size_t)a->halfedge_count)
        table.mask = 2 * table.mask + 1;
    table.slots = ktg_new(context, table.mask + 1, uint32_t);
    uint32_t *ends = ktg_new(context, 2 * (size_t)a->halfedge_count, uint32_t);
    ktg_status status = table.slots && ends ? KTG_OK : KTG_MEMORY;
    for (uint32_t h = 0; status == KTG_OK && h < a->halfedge_count; h++) {
        uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
        uint32_t edge = table_find(&table, ends, a->edge_count, mesh->faces[h], mesh->faces[next]);
        a->halfedge_edge[h] = edge;
        a->edge_count += edge == a->edge_count;
    }
    ktg_free(table.slots);
    ktg_free(ends);
    return status;
}

static ktg_status group_by_edge(ktg_context *context, ktg_adjacency *a) {
    a->edge_first = ktg_new(context, (size_t)a->edge_count + 2, uint32_t);
    if (!a->edge_first)
        return KTG_MEMORY;
    uint32_t *next =
        a->edge_first + 1; /* where the next half-edge of an edge goes; ends up as its end */
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        if (a->halfedge_edge[h] + 1 < a->edge_count)
            next[a->halfedge_edge[h] + 1]++;
    for (uint32_t e = 1; e < a->edge_count; e++)
        next[e] += next[e - 1];
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        a->edge_halfedges[next[a->halfedge_edge[h]]++] = h;
    return KTG_OK;
}

static void find_twins(const ktg_mesh *mesh, ktg_adjacency *a) {
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        a->twin[h] = KTG_NONE;
    for (uint32_t e = 0; e < a->edge_count; e++) {
        const uint32_t *pair = a->edge_halfedges + a->edge_first[e];
        bool two = a->edge_first[e + 1] - a->edge_first[e] == 2;
        if (two && mesh->faces[pair[0]] != mesh->faces[pair[1]]) {
            a->twin[pair[0]] = pair[1];
            a->twin[pair[1]] = pair[0];
        }
    }
}

static ktg_status fill(ktg_context *context, const ktg_mesh *mesh, ktg_adjacency *a) {
    a->halfedge_count = 3 * mesh->face_count;
    a->halfedge_edge = ktg_new(context, a->halfedge_count, uint32_t);
    a->edge_halfedges = ktg_new(context, a->halfedge_count, uint32_t);
    a->twin = ktg_new(context, a->halfedge_count, uint32_t);
    if (!a->halfedge_edge || !a->edge_halfedges || !a->twin)
        return KTG_MEMORY;
    KTG_TRY(number_edges(context, mesh, a));
    KTG_TRY(group_by_edge(context, a));
    find_twins(mesh, a);
    return KTG_OK;
}

ktg_status ktg_adjacency_new(ktg_context *context, const ktg_mesh *mesh,
                             ktg_adjacency **adjacency) {
    *adjacency = NULL;
    if (mesh->face_count > UINT32_MAX / 4)
        return ktg_fail(context, KTG_LIMIT, "more than %u faces", UINT32_MAX / 4);
    *adjacency = ktg_new(context, 1, ktg_adjacency);
    if (!*adjacency)
        return KTG_MEMORY;
    ktg_status status = fill(context, mesh, *adjacency);
    if (status != KTG_OK)
        ktg_adjacency_free(adjacency);
    return status;
}

void ktg_adjacency_free(ktg_adjacency **adjacency) {
    if (!adjacency || !*adjacency)
        return;
    ktg_free((*adjacency)->halfedge_edge);
    ktg_free((*adjacency)->edge_first);
    ktg_free((*adjacency)->edge_halfedges);
    ktg_free((*adjacency)->twin);
    ktg_free(*adjacency);
    *adjacency = NULL;
}
