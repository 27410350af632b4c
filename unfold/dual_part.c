/* unfold/dual_part.c - some faces of a dual graph as a dual graph of their own. */
#include "unfold/dual_part.h"
#include "core/memory.h"

#include <string.h>

static void copy_faces(const ktg_dual *dual, const uint32_t *faces, ktg_dual *part) {
    for (size_t i = 0; i < part->face_count; i++) {
        size_t from = 3 * (size_t)faces[i], to = 3 * i;
        part->mesh_face[i] = dual->mesh_face[faces[i]];
        memcpy(part->faces + to, dual->faces + from, 3 * sizeof *part->faces);
        memcpy(part->edge_vectors + to, dual->edge_vectors + from, 3 * sizeof *part->edge_vectors);
        memcpy(part->lengths + to, dual->lengths + from, 3 * sizeof *part->lengths);
        memcpy(part->flat + to, dual->flat + from, 3 * sizeof *part->flat);
        memcpy(part->flat_vectors + to, dual->flat_vectors + from, 3 * sizeof *part->flat_vectors);
    }
}

/* Edges whose faces are both here, in their old order. place: of each face of the dual in the part,
 * KTG_NONE outside. */
static void copy_edges(const ktg_dual *dual, const uint32_t *place, ktg_dual *part,
                       uint32_t *edge_of) {
    memset(part->halfedge_edge, 0xff, 3 * (size_t)part->face_count * sizeof(uint32_t));
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        ktg_dual_edge edge = dual->edges[e];
        uint32_t a = place[edge.halfedge[0] / 3], b = place[edge.halfedge[1] / 3];
        if (a == KTG_NONE || b == KTG_NONE)
            continue;
        edge.halfedge[0] = 3 * a + edge.halfedge[0] % 3;
        edge.halfedge[1] = 3 * b + edge.halfedge[1] % 3;
        part->halfedge_edge[edge.halfedge[0]] = part->halfedge_edge[edge.halfedge[1]] =
            part->edge_count;
        edge_of[part->edge_count] = e;
        part->edges[part->edge_count++] = edge;
    }
}

static ktg_status fill(ktg_context *context, const ktg_dual *dual, const uint32_t *faces,
                       ktg_dual *part, uint32_t *edge_of) {
    uint32_t *place = ktg_new(context, dual->face_count, uint32_t);
    ktg_status status = place && edge_of ? ktg_dual_allocate(context, part) : KTG_MEMORY;
    if (status == KTG_OK) {
        memset(place, 0xff, dual->face_count * sizeof *place);
        for (uint32_t i = 0; i < part->face_count; i++)
            place[faces[i]] = i;
        copy_faces(dual, faces, part);
        copy_edges(dual, place, part, edge_of);
    }
    ktg_free(place);
    return status;
}

ktg_status ktg_dual_part(ktg_context *context, const ktg_dual *dual, const uint32_t *faces,
                         uint32_t face_count, ktg_dual **part, uint32_t **edge_of) {
    *edge_of = ktg_new(context, 3 * (size_t)face_count + 1, uint32_t);
    *part = ktg_new(context, 1, ktg_dual);
    if (!*part || !*edge_of)
        return KTG_MEMORY;
    (*part)->vertex_count = dual->vertex_count;
    (*part)->face_count = face_count;
    ktg_status status = fill(context, dual, faces, *part, *edge_of);
    if (status != KTG_OK)
        ktg_dual_free(part);
    return status;
}
