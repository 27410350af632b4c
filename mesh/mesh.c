/* mesh/mesh.c - the mesh as plain data: making, copying, freeing. */
#include "mesh/mesh.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

void ktg_names_free(ktg_names *names) {
    if (!names)
        return;
    for (uint32_t i = 0; names->text && i < names->count; i++)
        ktg_free(names->text[i]);
    ktg_free(names->text);
    *names = (ktg_names){0};
}

void ktg_mesh_free(ktg_mesh **mesh) {
    if (!mesh || !*mesh)
        return;
    ktg_mesh *m = *mesh;
    ktg_free(m->positions);
    ktg_free(m->faces);
    ktg_free(m->face_polygon);
    ktg_free(m->face_object);
    ktg_free(m->face_group);
    ktg_free(m->face_material);
    ktg_names_free(&m->objects);
    ktg_names_free(&m->groups);
    ktg_names_free(&m->materials);
    ktg_free(m->material_library);
    ktg_free(m->texture_file);
    ktg_free(m->vertex_colours);
    ktg_free(m->face_colours);
    ktg_free(m->uvs);
    ktg_free(m->face_uv);
    ktg_free(m->marked_edges);
    ktg_free(m->marked_numbers);
    ktg_free(m);
    *mesh = NULL;
}

static ktg_status names_copy(ktg_context *context, const ktg_names *from, ktg_names *to) {
    if (from->count == 0)
        return KTG_OK;
    to->text = ktg_new(context, from->count, char *);
    if (!to->text)
        return KTG_MEMORY;
    to->count = from->count;
    for (uint32_t i = 0; i < from->count; i++) {
        to->text[i] = ktg_copy_text(context, from->text[i], SIZE_MAX);
        if (!to->text[i])
            return KTG_MEMORY;
    }
    return KTG_OK;
}

/* Copies an array that may be absent. */
static ktg_status array_copy(ktg_context *context, const void *from, size_t count, size_t size,
                             void *to) {
    if (!from)
        return KTG_OK;
    void *copy = ktg_copy_array(context, from, count, size);
    if (!copy)
        return KTG_MEMORY;
    memcpy(to, &copy, sizeof copy);
    return KTG_OK;
}

static ktg_status text_copy(ktg_context *context, const char *from, char **to) {
    return array_copy(context, from, from ? strlen(from) + 1 : 0, 1, to);
}

static ktg_status fill_copy(ktg_context *context, const ktg_mesh *m, ktg_mesh *c) {
    size_t faces = m->face_count, index = sizeof(uint32_t);
    c->vertex_count = m->vertex_count;
    c->face_count = m->face_count;
    c->uv_count = m->uv_count;
    c->marked_count = m->marked_count;
    KTG_TRY(array_copy(context, m->positions, m->vertex_count, sizeof(ktg_vec3), &c->positions));
    KTG_TRY(array_copy(context, m->faces, 3 * faces, index, &c->faces));
    KTG_TRY(array_copy(context, m->face_polygon, faces, index, &c->face_polygon));
    KTG_TRY(array_copy(context, m->face_object, faces, index, &c->face_object));
    KTG_TRY(array_copy(context, m->face_group, faces, index, &c->face_group));
    KTG_TRY(array_copy(context, m->face_material, faces, index, &c->face_material));
    KTG_TRY(array_copy(context, m->uvs, m->uv_count, sizeof(ktg_vec2), &c->uvs));
    KTG_TRY(array_copy(context, m->face_uv, 3 * faces, index, &c->face_uv));
    KTG_TRY(
        array_copy(context, m->marked_edges, 2 * (size_t)m->marked_count, index, &c->marked_edges));
    KTG_TRY(array_copy(context, m->marked_numbers, m->marked_count, index, &c->marked_numbers));
    KTG_TRY(
        array_copy(context, m->vertex_colours, 3 * (size_t)m->vertex_count, 1, &c->vertex_colours));
    KTG_TRY(array_copy(context, m->face_colours, 3 * faces, 1, &c->face_colours));
    KTG_TRY(text_copy(context, m->material_library, &c->material_library));
    KTG_TRY(text_copy(context, m->texture_file, &c->texture_file));
    KTG_TRY(names_copy(context, &m->objects, &c->objects));
    KTG_TRY(names_copy(context, &m->groups, &c->groups));
    return names_copy(context, &m->materials, &c->materials);
}

ktg_status ktg_mesh_copy(ktg_context *context, const ktg_mesh *mesh, ktg_mesh **copy) {
    *copy = ktg_new(context, 1, ktg_mesh);
    if (!*copy)
        return KTG_MEMORY;
    ktg_status status = fill_copy(context, mesh, *copy);
    if (status != KTG_OK)
        ktg_mesh_free(copy);
    return status;
}

static ktg_status check_arrays(ktg_context *context, const double *positions, uint32_t vertex_count,
                               const uint32_t *faces, uint32_t face_count) {
    for (size_t i = 0; i < 3 * (size_t)vertex_count; i++)
        if (!isfinite(positions[i]))
            return ktg_fail(context, KTG_ARGUMENT, "vertex %zu has a coordinate that is not finite",
                            i / 3);
    for (size_t i = 0; i < 3 * (size_t)face_count; i++)
        if (faces[i] >= vertex_count)
            return ktg_fail(context, KTG_ARGUMENT, "face %zu refers to vertex %u of %u", i / 3,
                            faces[i], vertex_count);
    return KTG_OK;
}

ktg_status ktg_mesh_new(ktg_context *context, const double *positions, uint32_t vertex_count,
                        const uint32_t *faces, uint32_t face_count, ktg_mesh **mesh) {
    *mesh = NULL;
    KTG_TRY(check_arrays(context, positions, vertex_count, faces, face_count));
    *mesh = ktg_new(context, 1, ktg_mesh);
    if (!*mesh)
        return KTG_MEMORY;
    (*mesh)->vertex_count = vertex_count;
    (*mesh)->face_count = face_count;
    (*mesh)->positions = ktg_copy_array(context, positions, vertex_count, sizeof(ktg_vec3));
    (*mesh)->faces = ktg_copy_array(context, faces, 3 * (size_t)face_count, sizeof(uint32_t));
    if ((*mesh)->positions && (*mesh)->faces)
        return KTG_OK;
    ktg_mesh_free(mesh);
    return KTG_MEMORY;
}
