/* paint/looks.c - what each face of a mesh looks like. */
#include "paint/look.h"

#include "core/memory.h"

#include <math.h>
#include <string.h>

/* Texture coordinates further out than this are nobody's wish. */
#define MOST_UV 1e6

/* The one image of a PLY is that of all faces. */
static uint32_t source_of(const ktg_paint *paint, const ktg_mesh *mesh, uint32_t face) {
    uint32_t none = paint->source_count - 1, of_all = paint->model->face_material ? none : 0;
    uint32_t material = mesh->face_material ? mesh->face_material[face] : of_all;
    return material < none ? material : none;
}

/* The corners' places in the image; false where the face has none. */
static bool place_corners(const ktg_mesh *mesh, uint32_t face, const ktg_source *source,
                          ktg_look *look) {
    const ktg_image_level *level = &source->image->levels[0];
    for (size_t k = 0; k < 3; k++) {
        uint32_t at = mesh->face_uv ? mesh->face_uv[3 * (size_t)face + k] : KTG_NONE;
        if (at >= mesh->uv_count)
            return false;
        double u = mesh->uvs[at].x * source->scale.x + source->offset.x;
        double v = mesh->uvs[at].y * source->scale.y + source->offset.y;
        if (!(fabs(u) < MOST_UV) || !(fabs(v) < MOST_UV))
            return false;
        look->dots[k] = (ktg_vec2){u * level->width, (1 - v) * level->height};
    }
    return true;
}

/* Colours of faces and vertices are finer on the model than on what it was simplified to. */
static void take_colours(const ktg_mesh *mesh, uint32_t face, bool whole, ktg_look *look) {
    if (!whole) {
        look->kind = KTG_LOOK_CLOSEST;
    } else if (mesh->face_colours) {
        memcpy(look->rgb[0], mesh->face_colours + 3 * (size_t)face, 3);
    } else {
        look->kind = KTG_LOOK_CORNERS;
        for (size_t k = 0; k < 3; k++)
            memcpy(look->rgb[k],
                   mesh->vertex_colours + 3 * (size_t)mesh->faces[3 * (size_t)face + k], 3);
    }
}

static void find_look(const ktg_paint *paint, const ktg_mesh *mesh, uint32_t face, bool whole,
                      ktg_look *look) {
    look->source = source_of(paint, mesh, face);
    const ktg_source *source = &paint->sources[look->source];
    memcpy(look->rgb[0], source->rgb, 3);
    look->kind = KTG_LOOK_PLAIN;
    if (source->image && place_corners(mesh, face, source, look))
        look->kind = KTG_LOOK_IMAGE;
    else if (source->image)
        look->kind = whole ? KTG_LOOK_PLAIN : KTG_LOOK_CLOSEST;
    else if (ktg_paint_has_own_colours(paint->model))
        take_colours(mesh, face, whole, look);
}

static bool same_dot(ktg_vec2 a, ktg_vec2 b) {
    return fabs(a.x - b.x) < 1e-3 && fabs(a.y - b.y) < 1e-3;
}

/* Beyond an edge the image goes on when the neighbour shows it from the same places. */
static bool goes_on(const ktg_look *looks, uint32_t h, uint32_t twin) {
    const ktg_look *a = &looks[h / 3], *b = &looks[twin / 3];
    return a->source == b->source && b->kind == KTG_LOOK_IMAGE &&
           same_dot(a->dots[h % 3], b->dots[(twin % 3 + 1) % 3]) &&
           same_dot(a->dots[(h % 3 + 1) % 3], b->dots[twin % 3]);
}

static ktg_status find_borders(ktg_context *context, const ktg_mesh *mesh, ktg_look *looks) {
    ktg_adjacency *adjacency;
    bool *at_border = ktg_new(context, mesh->vertex_count, bool);
    ktg_status status = at_border ? ktg_adjacency_new(context, mesh, &adjacency) : KTG_MEMORY;
    if (status != KTG_OK) {
        ktg_free(at_border);
        return status;
    }
    for (uint32_t h = 0; h < adjacency->halfedge_count; h++) {
        uint32_t twin = adjacency->twin[h];
        if (looks[h / 3].kind != KTG_LOOK_IMAGE || (twin != KTG_NONE && goes_on(looks, h, twin)))
            continue;
        looks[h / 3].borders |= (uint8_t)(1u << h % 3);
        at_border[mesh->faces[h]] = at_border[mesh->faces[h - h % 3 + (h % 3 + 1) % 3]] = true;
    }
    for (uint32_t h = 0; h < adjacency->halfedge_count; h++)
        if (at_border[mesh->faces[h]])
            looks[h / 3].borders |= (uint8_t)(8u << h % 3);
    ktg_adjacency_free(&adjacency);
    ktg_free(at_border);
    return KTG_OK;
}

ktg_status ktg_paint_find_looks(ktg_context *context, const ktg_paint *paint, const ktg_mesh *mesh,
                                bool whole, ktg_look **looks) {
    *looks = ktg_new(context, mesh->face_count, ktg_look);
    if (!*looks)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        find_look(paint, mesh, f, whole, &(*looks)[f]);
    ktg_status status = paint->image_count > 0 ? find_borders(context, mesh, *looks) : KTG_OK;
    if (status != KTG_OK) {
        ktg_free(*looks);
        *looks = NULL;
    }
    return status;
}
