/* unfold/dual.c - the dual graph of one part. */
#include "unfold/dual.h"
#include "core/memory.h"
#include "core/vec.h"

#include <stdlib.h>
#include <string.h>

/* Faces whose unit normals turn by no more than this lie in one plane (radians, about). */
#define COPLANAR 1e-4

void ktg_dual_free(ktg_dual **dual) {
    if (!dual || !*dual)
        return;
    ktg_free((*dual)->mesh_face);
    ktg_free((*dual)->faces);
    ktg_free((*dual)->halfedge_edge);
    ktg_free((*dual)->edge_vectors);
    ktg_free((*dual)->lengths);
    ktg_free((*dual)->flat);
    ktg_free((*dual)->flat_vectors);
    ktg_free((*dual)->edges);
    ktg_free(*dual);
    *dual = NULL;
}

/* Lays a face flat with its longest edge along x. Each edge's vector is a product with that edge's
 * own 3D vector, so that a short edge of a needle keeps its direction. */
static void lay_flat(const ktg_vec3 *vectors, const double *lengths, ktg_vec2 *flat,
                     ktg_vec2 *flat_vectors) {
    int k = 0;
    for (int i = 1; i < 3; i++)
        if (lengths[i] > lengths[k])
            k = i;
    int next = (k + 1) % 3, last = (k + 2) % 3;
    ktg_vec3 along = ktg_unit3(vectors[k]);
    double height = ktg_length3(ktg_cross3(vectors[next], vectors[last]));
    height = lengths[k] > 0 ? height / lengths[k] : 0;
    flat_vectors[k] = (ktg_vec2){lengths[k], 0};
    flat_vectors[next] = (ktg_vec2){ktg_dot3(vectors[next], along), height};
    flat_vectors[last] = (ktg_vec2){ktg_dot3(vectors[last], along), -height};
    flat[k] = (ktg_vec2){0, 0};
    flat[next] = flat_vectors[k];
    flat[last] = lengths[next] < lengths[last] ? ktg_add2(flat[next], flat_vectors[next])
                                               : ktg_mul2(flat_vectors[last], -1);
}

ktg_status ktg_dual_allocate(ktg_context *context, ktg_dual *dual) {
    size_t corners = 3 * (size_t)dual->face_count;
    dual->mesh_face = ktg_new(context, dual->face_count, uint32_t);
    dual->faces = ktg_new(context, corners, uint32_t);
    dual->halfedge_edge = ktg_new(context, corners, uint32_t);
    dual->edge_vectors = ktg_new(context, corners, ktg_vec3);
    dual->lengths = ktg_new(context, corners, double);
    dual->flat = ktg_new(context, corners, ktg_vec2);
    dual->flat_vectors = ktg_new(context, corners, ktg_vec2);
    dual->edges = ktg_new(context, corners + 1, ktg_dual_edge);
    return dual->mesh_face && dual->faces && dual->halfedge_edge && dual->edge_vectors &&
                   dual->lengths && dual->flat && dual->flat_vectors && dual->edges
               ? KTG_OK
               : KTG_MEMORY;
}

static int compare_numbers(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* The place of `number` in a sorted list that holds it. */
static uint32_t place_of(uint32_t number, const uint32_t *sorted, uint32_t count) {
    uint32_t low = 0, high = count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (sorted[middle] <= number)
            low = middle;
        else
            high = middle;
    }
    return low;
}

uint32_t ktg_dual_face(const ktg_dual *dual, uint32_t mesh_face) {
    uint32_t place = place_of(mesh_face, dual->mesh_face, dual->face_count);
    return dual->mesh_face[place] == mesh_face ? place : KTG_NONE;
}

/* Numbers the part's vertices 0, 1, ... in the order of their numbers in the mesh. */
static ktg_status take_faces(ktg_context *context, const ktg_mesh *mesh, ktg_dual *dual) {
    size_t corners = 3 * (size_t)dual->face_count;
    uint32_t *used = ktg_new(context, corners, uint32_t);
    if (!used)
        return KTG_MEMORY;
    for (size_t c = 0; c < corners; c++)
        used[c] = mesh->faces[3 * (size_t)dual->mesh_face[c / 3] + c % 3];
    qsort(used, corners, sizeof *used, compare_numbers);
    for (size_t c = 0; c < corners; c++)
        if (c == 0 || used[c] != used[c - 1])
            used[dual->vertex_count++] = used[c];
    for (size_t c = 0; c < corners; c++)
        dual->faces[c] = place_of(mesh->faces[3 * (size_t)dual->mesh_face[c / 3] + c % 3], used,
                                  dual->vertex_count);
    ktg_free(used);
    return KTG_OK;
}

static void measure_faces(const ktg_mesh *mesh, double scale, ktg_dual *dual) {
    for (uint32_t f = 0; f < dual->face_count; f++) {
        const uint32_t *corner = mesh->faces + 3 * (size_t)dual->mesh_face[f];
        for (int k = 0; k < 3; k++) {
            ktg_vec3 from = mesh->positions[corner[k]], to = mesh->positions[corner[(k + 1) % 3]];
            dual->edge_vectors[3 * f + k] = ktg_mul3(ktg_sub3(to, from), scale);
            dual->lengths[3 * f + k] = ktg_length3(dual->edge_vectors[3 * f + k]);
        }
        lay_flat(dual->edge_vectors + 3 * f, dual->lengths + 3 * f, dual->flat + 3 * f,
                 dual->flat_vectors + 3 * f);
    }
}

/* True when both faces of the edge are parts of one input polygon and lie in one plane. */
static bool is_rigid(const ktg_mesh *mesh, const ktg_dual *dual, const ktg_dual_edge *edge) {
    uint32_t a = edge->halfedge[0] / 3, b = edge->halfedge[1] / 3;
    if (!mesh->face_polygon ||
        mesh->face_polygon[dual->mesh_face[a]] != mesh->face_polygon[dual->mesh_face[b]])
        return false;
    const ktg_vec3 *u = dual->edge_vectors + 3 * a, *v = dual->edge_vectors + 3 * b;
    ktg_vec3 m = ktg_unit3(ktg_cross3(u[0], u[1])), n = ktg_unit3(ktg_cross3(v[0], v[1]));
    return ktg_dot3(m, n) > 0 && ktg_length3(ktg_cross3(m, n)) <= COPLANAR;
}

static void take_edges(const ktg_mesh *mesh, const ktg_adjacency *adjacency, ktg_dual *dual) {
    memset(dual->halfedge_edge, 0xff, 3 * (size_t)dual->face_count * sizeof(uint32_t));
    for (uint32_t h = 0; h < 3 * dual->face_count; h++) {
        uint32_t twin = adjacency->twin[3 * dual->mesh_face[h / 3] + h % 3];
        uint32_t face = twin == KTG_NONE ? KTG_NONE : ktg_dual_face(dual, twin / 3);
        if (face == KTG_NONE || 3 * face + twin % 3 < h)
            continue;
        uint32_t other = 3 * face + twin % 3;
        uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
        ktg_dual_edge *edge = &dual->edges[dual->edge_count];
        *edge = (ktg_dual_edge){.halfedge = {h, other},
                                .vertices = {dual->faces[h], dual->faces[next]},
                                .length = dual->lengths[h]};
        edge->rigid = is_rigid(mesh, dual, edge);
        dual->halfedge_edge[h] = dual->halfedge_edge[other] = dual->edge_count++;
    }
}

ktg_status ktg_dual_new(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *adjacency,
                        const uint32_t *mesh_faces, uint32_t face_count, double scale,
                        ktg_dual **dual) {
    *dual = ktg_new(context, 1, ktg_dual);
    if (!*dual)
        return KTG_MEMORY;
    (*dual)->face_count = face_count;
    ktg_status status = ktg_dual_allocate(context, *dual);
    if (status == KTG_OK) {
        memcpy((*dual)->mesh_face, mesh_faces, face_count * sizeof *mesh_faces);
        status = take_faces(context, mesh, *dual);
    }
    if (status != KTG_OK) {
        ktg_dual_free(dual);
        return status;
    }
    measure_faces(mesh, scale, *dual);
    take_edges(mesh, adjacency, *dual);
    return KTG_OK;
}
