/* mesh/write_ply.c - ASCII PLY: positions, triangles, colours, and the texture as MeshLab has it.
 */
#include "mesh/write.h"

#include <string.h>

#define COLOUR "property uchar red\nproperty uchar green\nproperty uchar blue\n"

/* Item `index` of an array of colours (NULL: none), behind what stands on the line already. */
static void put_colour(ktg_writer *writer, const uint8_t *colours, size_t index) {
    for (size_t k = 0; colours && k < 3; k++) {
        ktg_put_text(writer, " ");
        ktg_put_integer(writer, colours[3 * index + k]);
    }
}

/* The coordinates of a face's corners, an empty list where it has none. */
static void put_uvs(ktg_writer *writer, const ktg_mesh *mesh, size_t face) {
    const uint32_t *uv = mesh->face_uv + 3 * face;
    bool none = uv[0] == KTG_NONE || uv[1] == KTG_NONE || uv[2] == KTG_NONE;
    ktg_put_text(writer, none ? " 0" : " 6");
    for (size_t k = 0; k < 3 && !none; k++) {
        ktg_put_text(writer, " ");
        ktg_put_number(writer, mesh->uvs[uv[k]].x);
        ktg_put_text(writer, " ");
        ktg_put_number(writer, mesh->uvs[uv[k]].y);
    }
}

static bool has_several_textures(const ktg_mesh *mesh) {
    return mesh->face_material && mesh->texture_file && strchr(mesh->texture_file, '\n');
}

/* The number of the line of texture_file that is the name of the face's material; 0 for none. */
static uint64_t texture_of(const ktg_mesh *mesh, size_t face) {
    uint32_t material = mesh->face_material[face];
    const char *name = material < mesh->materials.count ? mesh->materials.text[material] : "";
    uint64_t number = 0;
    for (const char *line = mesh->texture_file; *line; number++) {
        size_t length = strcspn(line, "\n");
        if (length == strlen(name) && memcmp(line, name, length) == 0)
            return number;
        line += length + (line[length] == '\n');
    }
    return 0;
}

static void put_head(ktg_writer *writer, const ktg_mesh *mesh) {
    ktg_put_text(writer, "ply\nformat ascii 1.0\ncomment written by Katagami\n");
    ktg_put_names(writer, "comment TextureFile", mesh->texture_file);
    ktg_put_text(writer, "element vertex ");
    ktg_put_integer(writer, mesh->vertex_count);
    ktg_put_text(writer, "\nproperty double x\nproperty double y\nproperty double z\n");
    ktg_put_text(writer, mesh->vertex_colours ? COLOUR : "");
    ktg_put_text(writer, "element face ");
    ktg_put_integer(writer, mesh->face_count);
    ktg_put_text(writer, "\nproperty list uchar uint vertex_indices\n");
    ktg_put_text(writer, mesh->face_uv ? "property list uchar double texcoord\n" : "");
    ktg_put_text(writer, has_several_textures(mesh) ? "property int texnumber\n" : "");
    ktg_put_text(writer, mesh->face_colours ? COLOUR : "");
    ktg_put_text(writer, "end_header\n");
}

static void put_face(ktg_writer *writer, const ktg_mesh *mesh, size_t face) {
    ktg_put_triangle(writer, mesh, face);
    if (mesh->face_uv)
        put_uvs(writer, mesh, face);
    if (has_several_textures(mesh)) {
        ktg_put_text(writer, " ");
        ktg_put_integer(writer, texture_of(mesh, face));
    }
    put_colour(writer, mesh->face_colours, face);
    ktg_put_text(writer, "\n");
}

void ktg_write_ply(ktg_writer *writer, const ktg_mesh *mesh) {
    put_head(writer, mesh);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        ktg_put_point(writer, mesh->positions[i]);
        put_colour(writer, mesh->vertex_colours, i);
        ktg_put_text(writer, "\n");
    }
    for (size_t f = 0; f < mesh->face_count; f++)
        put_face(writer, mesh, f);
}
