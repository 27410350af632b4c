/* unfold/check.c - can this surface be unfolded at all? */
#include "unfold/check.h"
#include "core/memory.h"
#include "core/vec.h"

static ktg_status check_edges(ktg_context *context, const ktg_adjacency *a) {
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t h = a->edge_halfedges[a->edge_first[e]];
        uint32_t count = a->edge_first[e + 1] - a->edge_first[e];
        if (count > 2 || (count == 2 && a->twin[h] == KTG_NONE))
            return ktg_fail(context, KTG_ARGUMENT,
                            "face %u has an edge that is not manifold; repair the mesh first",
                            h / 3);
    }
    return KTG_OK;
}

static ktg_status check_faces(ktg_context *context, const ktg_mesh *mesh) {
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->faces + 3 * (size_t)f;
        ktg_vec3 p = mesh->positions[corner[0]];
        ktg_vec3 to_1 = ktg_unit3(ktg_sub3(mesh->positions[corner[1]], p));
        ktg_vec3 to_2 = ktg_unit3(ktg_sub3(mesh->positions[corner[2]], p));
        if (!(ktg_length3(ktg_cross3(to_1, to_2)) > 0))
            return ktg_fail(context, KTG_ARGUMENT, "face %u has no area; repair the mesh first", f);
    }
    return KTG_OK;
}

/* How many faces lie around the vertex at which half-edge `start` begins, from edge to edge. */
static uint32_t fan_size(const ktg_adjacency *a, uint32_t start) {
    uint32_t count = 1, h = start;
    while ((h = a->twin[h % 3 == 0 ? h + 2 : h - 1]) != KTG_NONE && h != start)
        count++;
    if (h == start)
        return count;
    for (h = a->twin[start]; h != KTG_NONE; count++)
        h = a->twin[h % 3 == 2 ? h - 2 : h + 1];
    return count;
}

/* All faces at a vertex must be one fan; where two only touch there, it is two vertices. */
static ktg_status check_vertices(ktg_context *context, const ktg_mesh *mesh,
                                 const ktg_adjacency *a) {
    uint32_t *left = ktg_new(context, mesh->vertex_count, uint32_t);
    if (!left)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        left[mesh->faces[h]]++;
    ktg_status status = KTG_OK;
    for (uint32_t h = 0; status == KTG_OK && h < a->halfedge_count; h++) {
        uint32_t v = mesh->faces[h];
        if (left[v] > 0 && left[v] != fan_size(a, h))
            status = ktg_fail(context, KTG_ARGUMENT,
                              "at a corner of face %u other faces touch in a mere point; repair "
                              "the mesh first",
                              h / 3);
        left[v] = 0;
    }
    ktg_free(left);
    return status;
}

ktg_status ktg_unfold_check(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *a) {
    KTG_TRY(check_edges(context, a));
    KTG_TRY(check_faces(context, mesh));
    return check_vertices(context, mesh, a);
}
