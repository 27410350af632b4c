/* flatten/pattern.c - the flat panel turned upright, then as a pattern of one piece in the model's
 * unit. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>
#include <string.h>

/* ---- upright ------------------------------------------------------------------------------ */

/* Where the model's `direction` points on the flat panel: sum A J direction / sum A, the vector
 * whose turn to +y leaves sum A |R J direction - y|^2 least. */
static ktg_vec2 image_of_direction(const ktg_panel *panel, const ktg_vec2 *flat,
                                   ktg_vec3 direction) {
    ktg_vec2 sum = {0, 0};
    double total = 0;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        ktg_face_map map = ktg_face_map_of(panel, f, flat);
        sum = ktg_madd2(sum, map.area, ktg_face_map_direction(&map, direction));
        total += map.area;
    }
    return ktg_mul2(sum, 1 / total);
}

/* The direction of the flat panel that is to point up: the model's y; of a panel that lies (or a
 * dome, whose sides cancel) -z, as one sees it from above; of one that lies in that direction too,
 * x. */
static ktg_vec2 upward(const ktg_panel *panel, const ktg_vec2 *flat) {
    static const ktg_vec3 directions[] = {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}};
    for (size_t k = 0; k < sizeof directions / sizeof *directions; k++) {
        ktg_vec2 image = image_of_direction(panel, flat, directions[k]);
        if (ktg_length2(image) > 1e-3)
            return ktg_unit2(image);
    }
    return (ktg_vec2){0, 1};
}

void ktg_panel_set_upright(const ktg_panel *panel, ktg_vec2 *flat) {
    ktg_vec2 up = upward(panel, flat), low = {INFINITY, INFINITY};
    for (uint32_t v = 0; v < panel->vertex_count; v++) {
        flat[v] = (ktg_vec2){ktg_cross2(flat[v], up), ktg_dot2(flat[v], up)};
        low = (ktg_vec2){fmin(low.x, flat[v].x), fmin(low.y, flat[v].y)};
    }
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        flat[v] = ktg_sub2(flat[v], low);
}

/* ---- the pattern -------------------------------------------------------------------------- */

static ktg_status set_surface(ktg_context *context, const ktg_mesh *mesh, const double *face_strain,
                              ktg_pattern *pattern) {
    pattern->mode = KTG_CLOTH;
    pattern->model_faces = mesh->face_count;
    pattern->vertex_count = mesh->vertex_count;
    pattern->face_count = mesh->face_count;
    pattern->vertices =
        ktg_copy_array(context, mesh->positions, mesh->vertex_count, sizeof(ktg_vec3));
    pattern->faces =
        ktg_copy_array(context, mesh->faces, 3 * (size_t)mesh->face_count, sizeof(uint32_t));
    pattern->face_strain = ktg_copy_array(context, face_strain, mesh->face_count, sizeof(double));
    bool whole = pattern->vertices && pattern->faces && pattern->face_strain;
    return whole ? KTG_OK : KTG_MEMORY;
}

static ktg_status set_piece(ktg_context *context, const ktg_mesh *mesh, const ktg_panel *panel,
                            const char *name, const ktg_vec2 *flat, ktg_pattern *pattern) {
    ktg_pattern_piece *piece = pattern->pieces = ktg_new(context, 1, ktg_pattern_piece);
    pattern->components = ktg_new(context, 1, ktg_pattern_component);
    if (!piece || !pattern->components)
        return KTG_MEMORY;
    pattern->piece_count = pattern->component_count = 1;
    pattern->components[0].name = ktg_copy_text(context, name, SIZE_MAX);
    piece->name = ktg_copy_text(context, name, SIZE_MAX);
    piece->vertices = ktg_new(context, mesh->vertex_count, ktg_vec2);
    piece->faces = ktg_new(context, mesh->face_count, uint32_t);
    piece->corners =
        ktg_copy_array(context, mesh->faces, 3 * (size_t)mesh->face_count, sizeof(uint32_t));
    if (!pattern->components[0].name || !piece->name || !piece->vertices || !piece->faces ||
        !piece->corners)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        piece->faces[f] = f;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        piece->vertices[v] =
            (ktg_vec2){ldexp(flat[v].x, panel->exponent), ldexp(flat[v].y, panel->exponent)};
    piece->vertex_count = mesh->vertex_count;
    piece->face_count = mesh->face_count;
    piece->cut_count = 1;
    return KTG_OK;
}

static ktg_vec3 face_normal(const ktg_panel *panel, uint32_t face) {
    const uint32_t *v = panel->faces + 3 * (size_t)face;
    const ktg_vec3 *p = panel->positions;
    return ktg_unit3(ktg_cross3(ktg_sub3(p[v[1]], p[v[0]]), ktg_sub3(p[v[2]], p[v[0]])));
}

/* The signed turn between the outward normals over half-edge h, + where the surface is convex. */
static double turn_over_edge(const ktg_panel *panel, uint32_t h) {
    ktg_vec3 here = face_normal(panel, h / 3);
    ktg_vec3 there = face_normal(panel, panel->adjacency->twin[h] / 3);
    ktg_vec3 along = ktg_unit3(ktg_sub3(panel->positions[panel->faces[ktg_halfedge_next(h)]],
                                        panel->positions[panel->faces[h]]));
    return atan2(ktg_dot3(ktg_cross3(here, there), along), ktg_dot3(here, there));
}

static ktg_pattern_side side_of(uint32_t h) {
    return (ktg_pattern_side){.piece = 0, .face = h / 3, .corner = h % 3};
}

/* Cloth is neither folded nor cut at an inner edge: it is flat, whatever angle the surface has
 * there. */
static ktg_status set_edges(ktg_context *context, const ktg_panel *panel, ktg_pattern *pattern) {
    const ktg_adjacency *a = panel->adjacency;
    pattern->edges = ktg_new(context, a->edge_count, ktg_pattern_edge);
    if (!pattern->edges)
        return KTG_MEMORY;
    pattern->edge_count = a->edge_count;
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t h = a->edge_halfedges[a->edge_first[e]], twin = a->twin[h];
        ktg_pattern_edge *edge = &pattern->edges[e];
        *edge =
            (ktg_pattern_edge){.vertices = {panel->faces[h], panel->faces[ktg_halfedge_next(h)]},
                               .kind = KTG_EDGE_BORDER,
                               .side_count = 1,
                               .tab_on = -1,
                               .seam = KTG_NONE};
        edge->sides[0] = side_of(h);
        if (twin == KTG_NONE)
            continue;
        edge->kind = KTG_EDGE_FLAT;
        edge->side_count = 2;
        edge->sides[1] = side_of(twin);
        edge->angle = turn_over_edge(panel, h);
    }
    return KTG_OK;
}

ktg_status ktg_flat_pattern(ktg_context *context, const ktg_mesh *mesh, const ktg_panel *panel,
                            const char *name, const ktg_vec2 *flat, const double *face_strain,
                            ktg_pattern **pattern) {
    ktg_pattern *made = ktg_new(context, 1, ktg_pattern);
    if (!made)
        return KTG_MEMORY;
    ktg_status status = set_surface(context, mesh, face_strain, made);
    if (status == KTG_OK)
        status = set_piece(context, mesh, panel, name, flat, made);
    if (status == KTG_OK)
        status = set_edges(context, panel, made);
    if (status != KTG_OK)
        ktg_pattern_free(&made);
    *pattern = made;
    return status;
}
