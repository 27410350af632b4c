/* flatten/pattern.c - the flat panels as a pattern in the model's unit. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/surface.h"

#include <math.h>

static ktg_status set_surface(ktg_context *context, const ktg_flat_surface *s,
                              ktg_pattern *pattern) {
    const ktg_mesh *mesh = s->mesh;
    pattern->mode = KTG_CLOTH;
    pattern->model_faces = mesh->face_count;
    pattern->simplified = s->slid != NULL; /* not the same surface to the bit */
    pattern->vertex_count = mesh->vertex_count;
    pattern->face_count = mesh->face_count;
    pattern->vertices =
        ktg_copy_array(context, mesh->positions, mesh->vertex_count, sizeof(ktg_vec3));
    pattern->faces =
        ktg_copy_array(context, mesh->faces, 3 * (size_t)mesh->face_count, sizeof(uint32_t));
    pattern->face_strain =
        ktg_copy_array(context, s->face_strain, mesh->face_count, sizeof(double));
    bool whole = pattern->vertices && pattern->faces && pattern->face_strain;
    return whole ? KTG_OK : KTG_MEMORY;
}

/* ---- components --------------------------------------------------------------------------- */

static ktg_status name_components(ktg_context *context, const ktg_flat_surface *s,
                                  const uint32_t *component, uint32_t count, ktg_pattern *pattern) {
    ktg_names names = {0};
    pattern->components = ktg_new(context, count, ktg_pattern_component);
    if (!pattern->components)
        return KTG_MEMORY;
    KTG_TRY(ktg_mesh_component_names(context, s->mesh, component, count, s->name, &names));
    pattern->component_count = count;
    for (uint32_t c = 0; c < count; c++) {
        pattern->components[c].name = names.text[c];
        names.text[c] = NULL;
    }
    ktg_names_free(&names);
    return KTG_OK;
}

static ktg_status set_components(ktg_context *context, const ktg_flat_surface *s,
                                 ktg_pattern *pattern) {
    uint32_t *component = NULL, count = 0;
    KTG_TRY(ktg_mesh_components(context, s->mesh, s->adjacency, &component, &count));
    ktg_status status = name_components(context, s, component, count, pattern);
    for (uint32_t p = 0; p < s->apart.count; p++)
        pattern->pieces[p].component = component[s->apart.panels[p].face[0]];
    ktg_free(component);
    return status;
}

/* ---- pieces ------------------------------------------------------------------------------- */

static ktg_status set_piece(ktg_context *context, const ktg_cut_panel *from,
                            const ktg_flat_panel *flat, const char *name,
                            ktg_pattern_piece *piece) {
    const ktg_mesh *mesh = from->mesh;
    piece->name = ktg_copy_text(context, name, SIZE_MAX);
    piece->vertices = ktg_new(context, mesh->vertex_count, ktg_vec2);
    piece->faces = ktg_copy_array(context, from->face, mesh->face_count, sizeof(uint32_t));
    piece->corners =
        ktg_copy_array(context, mesh->faces, 3 * (size_t)mesh->face_count, sizeof(uint32_t));
    if (!piece->name || !piece->vertices || !piece->faces || !piece->corners)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        piece->vertices[v] = (ktg_vec2){ldexp(flat->flat[v].x, flat->panel->exponent),
                                        ldexp(flat->flat[v].y, flat->panel->exponent)};
    piece->vertex_count = mesh->vertex_count;
    piece->face_count = mesh->face_count;
    piece->cut_count = 1;
    return KTG_OK;
}

static ktg_status set_pieces(ktg_context *context, const ktg_flat_surface *s,
                             ktg_pattern *pattern) {
    pattern->pieces = ktg_new(context, s->apart.count, ktg_pattern_piece);
    if (!pattern->pieces)
        return KTG_MEMORY;
    pattern->piece_count = s->apart.count;
    for (uint32_t p = 0; p < s->apart.count; p++)
        KTG_TRY(set_piece(context, &s->apart.panels[p], &s->flats[p], s->names.text[p],
                          &pattern->pieces[p]));
    return set_components(context, s, pattern);
}

/* ---- edges -------------------------------------------------------------------------------- */

static ktg_vec3 face_normal(const ktg_mesh *mesh, uint32_t face) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    const ktg_vec3 *p = mesh->positions;
    double size = ktg_length3(ktg_sub3(p[v[1]], p[v[0]])); /* squares of tiny lengths vanish */
    return ktg_unit3(ktg_cross3(ktg_mul3(ktg_sub3(p[v[1]], p[v[0]]), 1 / size),
                                ktg_mul3(ktg_sub3(p[v[2]], p[v[0]]), 1 / size)));
}

/* The signed turn between the outward normals over half-edge h, + where the surface is convex. */
static double turn_over_edge(const ktg_mesh *mesh, uint32_t h, uint32_t twin) {
    ktg_vec3 here = face_normal(mesh, h / 3), there = face_normal(mesh, twin / 3);
    ktg_vec3 along = ktg_unit3(ktg_sub3(mesh->positions[mesh->faces[ktg_halfedge_next(h)]],
                                        mesh->positions[mesh->faces[h]]));
    return atan2(ktg_dot3(ktg_cross3(here, there), along), ktg_dot3(here, there));
}

static ktg_pattern_side side_of(const ktg_flat_surface *s, uint32_t h) {
    return (ktg_pattern_side){.piece = s->apart.face_panel[h / 3], .face = h / 3, .corner = h % 3};
}

/* Cloth is not folded inside a panel: an edge there is flat, whatever angle the surface has. Seams
 * are somebody's wish, even where they close by themselves. */
static ktg_pattern_edge edge_of(const ktg_flat_surface *s, uint32_t e) {
    const ktg_adjacency *a = s->adjacency;
    const uint32_t *faces = s->mesh->faces;
    uint32_t h = a->edge_halfedges[a->edge_first[e]], twin = a->twin[h];
    ktg_pattern_edge edge = {.vertices = {faces[h], faces[ktg_halfedge_next(h)]},
                             .kind = KTG_EDGE_BORDER,
                             .side_count = 1,
                             .sides = {side_of(s, h)},
                             .tab_on = -1,
                             .seam = KTG_NONE};
    if (twin == KTG_NONE)
        return edge;
    edge.kind = s->cut[e] ? KTG_EDGE_CUT : KTG_EDGE_FLAT;
    edge.forced = s->cut[e];
    edge.side_count = 2;
    edge.sides[1] = side_of(s, twin);
    edge.angle = turn_over_edge(s->mesh, h, twin);
    return edge;
}

static ktg_status set_edges(ktg_context *context, const ktg_flat_surface *s, ktg_pattern *pattern) {
    pattern->edges = ktg_new(context, s->adjacency->edge_count, ktg_pattern_edge);
    if (!pattern->edges)
        return KTG_MEMORY;
    pattern->edge_count = s->adjacency->edge_count;
    for (uint32_t e = 0; e < pattern->edge_count; e++)
        pattern->edges[e] = edge_of(s, e);
    return KTG_OK;
}

ktg_status ktg_flat_pattern(ktg_context *context, const ktg_flat_surface *surface,
                            ktg_pattern **pattern) {
    ktg_pattern *made = ktg_new(context, 1, ktg_pattern);
    if (!made)
        return KTG_MEMORY;
    ktg_status status = set_surface(context, surface, made);
    if (status == KTG_OK)
        status = set_pieces(context, surface, made);
    if (status == KTG_OK)
        status = set_edges(context, surface, made);
    if (status != KTG_OK)
        ktg_pattern_free(&made);
    *pattern = made;
    return status;
}
