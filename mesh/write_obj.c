/* mesh/write_obj.c - Wavefront OBJ with everything a mesh holds. */
#include "mesh/write.h"

#include <math.h>
#include <string.h>

/* Writes "keyword name" where a face's name differs from the one before it. */
static void put_change(ktg_writer *writer, const char *keyword, const uint32_t *face_name,
                       const ktg_names *names, size_t face, uint32_t *current) {
    if (!face_name || face_name[face] == *current)
        return;
    *current = face_name[face];
    const char *name = *current < names->count ? names->text[*current] : "";
    ktg_put_name(writer, keyword, name, strlen(name));
}

static void put_face(ktg_writer *writer, const ktg_mesh *mesh, size_t face) {
    ktg_put_text(writer, "f");
    for (size_t k = 0; k < 3; k++) {
        ktg_put_text(writer, " ");
        ktg_put_integer(writer, (uint64_t)mesh->faces[3 * face + k] + 1);
        if (!mesh->face_uv || mesh->face_uv[3 * face + k] == KTG_NONE)
            continue;
        ktg_put_text(writer, "/");
        ktg_put_integer(writer, (uint64_t)mesh->face_uv[3 * face + k] + 1);
    }
    ktg_put_text(writer, "\n");
}

static void put_faces(ktg_writer *writer, const ktg_mesh *mesh) {
    uint32_t object = KTG_NONE, group = KTG_NONE, material = KTG_NONE;
    for (size_t f = 0; f < mesh->face_count; f++) {
        put_change(writer, "o", mesh->face_object, &mesh->objects, f, &object);
        put_change(writer, "g", mesh->face_group, &mesh->groups, f, &group);
        put_change(writer, "usemtl", mesh->face_material, &mesh->materials, f, &material);
        put_face(writer, mesh, f);
    }
}

/* A colour is written as so few digits that bytes come back. */
static void put_vertex(ktg_writer *writer, const ktg_mesh *mesh, size_t vertex) {
    ktg_put_text(writer, "v ");
    ktg_put_point(writer, mesh->positions[vertex]);
    for (size_t k = 0; mesh->vertex_colours && k < 3; k++) {
        ktg_put_text(writer, " ");
        ktg_put_number(writer, round(mesh->vertex_colours[3 * vertex + k] / 255.0 * 1e4) / 1e4);
    }
    ktg_put_text(writer, "\n");
}

void ktg_write_obj(ktg_writer *writer, const ktg_mesh *mesh) {
    ktg_put_text(writer, "# written by Katagami\n");
    ktg_put_names(writer, "mtllib", mesh->material_library);
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        put_vertex(writer, mesh, i);
    for (uint32_t i = 0; i < mesh->uv_count; i++) {
        ktg_put_text(writer, "vt ");
        ktg_put_number(writer, mesh->uvs[i].x);
        ktg_put_text(writer, " ");
        ktg_put_number(writer, mesh->uvs[i].y);
        ktg_put_text(writer, "\n");
    }
    put_faces(writer, mesh);
    for (size_t i = 0; i < mesh->marked_count; i++) {
        ktg_put_text(writer, "l ");
        ktg_put_integer(writer, (uint64_t)mesh->marked_edges[2 * i] + 1);
        ktg_put_text(writer, " ");
        ktg_put_integer(writer, (uint64_t)mesh->marked_edges[2 * i + 1] + 1);
        ktg_put_text(writer, "\n");
    }
}
