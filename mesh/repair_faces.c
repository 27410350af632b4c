/* mesh/repair_faces.c - removing, adding and cutting faces with all they carry. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/repair.h"

#include <string.h>

ktg_status ktg_repair_welded(ktg_repair *repair, ktg_adjacency **adjacency) {
    ktg_mesh view = *repair->mesh;
    *adjacency = NULL;
    view.faces = ktg_new(repair->context, 3 * (size_t)view.face_count, uint32_t);
    if (!view.faces)
        return KTG_MEMORY;
    for (size_t h = 0; h < 3 * (size_t)view.face_count; h++)
        view.faces[h] = repair->weld[repair->mesh->faces[h]];
    ktg_status status = ktg_adjacency_new(repair->context, &view, adjacency);
    ktg_free(view.faces);
    return status;
}

/* Items of `size` bytes per face; the array may be absent. */
static void keep_items(void *items, size_t size, uint32_t count, const bool *keep) {
    uint8_t *bytes = items;
    uint32_t kept = 0;
    for (uint32_t f = 0; bytes && f < count; f++)
        if (keep[f])
            memmove(bytes + size * kept++, bytes + size * f, size);
}

void ktg_repair_keep_faces(ktg_mesh *mesh, const bool *keep) {
    uint32_t kept = 0;
    const size_t index = sizeof *mesh->faces;
    keep_items(mesh->faces, 3 * index, mesh->face_count, keep);
    keep_items(mesh->face_uv, 3 * index, mesh->face_count, keep);
    keep_items(mesh->face_polygon, index, mesh->face_count, keep);
    keep_items(mesh->face_object, index, mesh->face_count, keep);
    keep_items(mesh->face_group, index, mesh->face_count, keep);
    keep_items(mesh->face_material, index, mesh->face_count, keep);
    keep_items(mesh->face_colours, 3, mesh->face_count, keep);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        kept += keep[f];
    mesh->face_count = kept;
}

static ktg_status grow_items(ktg_context *context, uint32_t **items, size_t count, size_t extra) {
    size_t capacity = count;
    return *items ? ktg_reserve(context, items, &capacity, count + extra) : KTG_OK;
}

static ktg_status grow_colours(ktg_context *context, uint8_t **colours, size_t count,
                               size_t extra) {
    size_t capacity = 3 * count;
    return *colours ? ktg_reserve(context, colours, &capacity, 3 * (count + extra)) : KTG_OK;
}

ktg_status ktg_repair_grow(ktg_context *context, ktg_mesh *mesh, uint32_t faces,
                           uint32_t vertices) {
    size_t n = mesh->face_count, capacity = mesh->vertex_count;
    if (faces > UINT32_MAX / 4 - mesh->face_count || vertices > UINT32_MAX - 1 - mesh->vertex_count)
        return ktg_fail(context, KTG_LIMIT, "the repaired mesh would have more than %u faces",
                        UINT32_MAX / 4);
    KTG_TRY(grow_items(context, &mesh->faces, 3 * n, 3 * (size_t)faces));
    KTG_TRY(grow_items(context, &mesh->face_uv, 3 * n, 3 * (size_t)faces));
    KTG_TRY(grow_items(context, &mesh->face_polygon, n, faces));
    KTG_TRY(grow_items(context, &mesh->face_object, n, faces));
    KTG_TRY(grow_items(context, &mesh->face_group, n, faces));
    KTG_TRY(grow_items(context, &mesh->face_material, n, faces));
    KTG_TRY(grow_colours(context, &mesh->face_colours, n, faces));
    KTG_TRY(grow_colours(context, &mesh->vertex_colours, mesh->vertex_count, vertices));
    KTG_TRY(ktg_reserve(context, &mesh->positions, &capacity, capacity + vertices));
    mesh->face_count += faces;
    mesh->vertex_count += vertices;
    return KTG_OK;
}

void ktg_repair_copy_vertex(ktg_mesh *mesh, uint32_t from, uint32_t to) {
    mesh->positions[to] = mesh->positions[from];
    if (mesh->vertex_colours && from != to)
        memcpy(mesh->vertex_colours + 3 * (size_t)to, mesh->vertex_colours + 3 * (size_t)from, 3);
}

/* A new texture coordinate between two, or KTG_NONE where one of them is none. */
static ktg_status uv_between(ktg_context *context, ktg_mesh *mesh, uint32_t from, uint32_t to,
                             double t, uint32_t *index) {
    size_t capacity = mesh->uv_count;
    *index = from == to ? from : KTG_NONE;
    if (from == to || from == KTG_NONE || to == KTG_NONE)
        return KTG_OK;
    KTG_TRY(ktg_reserve(context, &mesh->uvs, &capacity, capacity + 1));
    ktg_vec2 along = ktg_sub2(mesh->uvs[to], mesh->uvs[from]);
    mesh->uvs[mesh->uv_count] = ktg_madd2(mesh->uvs[from], t, along);
    *index = mesh->uv_count++;
    return KTG_OK;
}

static void cut_corners(uint32_t *corners, uint32_t f, uint32_t k, uint32_t m, uint32_t added) {
    uint32_t *old = corners + 3 * (size_t)f, *new = corners + 3 * (size_t)added;
    new[0] = m;
    new[1] = old[(k + 1) % 3];
    new[2] = old[(k + 2) % 3];
    old[(k + 1) % 3] = m;
}

static void copy_item(uint32_t *items, uint32_t from, uint32_t to) {
    if (items)
        items[to] = items[from];
}

ktg_status ktg_repair_cut_face(ktg_context *context, ktg_mesh *mesh, uint32_t f, uint32_t k,
                               uint32_t m, double t, uint32_t added) {
    cut_corners(mesh->faces, f, k, m, added);
    copy_item(mesh->face_polygon, f, added);
    copy_item(mesh->face_object, f, added);
    copy_item(mesh->face_group, f, added);
    copy_item(mesh->face_material, f, added);
    if (mesh->face_colours)
        memcpy(mesh->face_colours + 3 * (size_t)added, mesh->face_colours + 3 * (size_t)f, 3);
    if (!mesh->face_uv)
        return KTG_OK;
    const uint32_t *uv = mesh->face_uv + 3 * (size_t)f;
    uint32_t between;
    KTG_TRY(uv_between(context, mesh, uv[k], uv[(k + 1) % 3], t, &between));
    cut_corners(mesh->face_uv, f, k, between, added);
    return KTG_OK;
}
