/* flatten/cut.c - a surface taken apart along its seams: faces that hang together make a panel,
 * corners that hang together at a vertex make one vertex of it. */
#include "flatten/cut.h"

#include "core/memory.h"
#include "core/sets.h"

/* ---- sets --------------------------------------------------------------------------------- */

static uint32_t *each_alone(ktg_context *context, size_t count) {
    uint32_t *parent = ktg_new(context, count, uint32_t);
    for (size_t i = 0; parent && i < count; i++)
        parent[i] = (uint32_t)i;
    return parent;
}

static uint32_t next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

/* What holds together: faces across edges that are not cut, and there the corners at both ends. */
static void join_across(const ktg_adjacency *a, const bool *cut, uint32_t *faces,
                        uint32_t *corners) {
    for (uint32_t h = 0; h < a->halfedge_count; h++) {
        uint32_t twin = a->twin[h];
        if (twin == KTG_NONE || twin < h || cut[a->halfedge_edge[h]])
            continue;
        ktg_set_join(faces, h / 3, twin / 3);
        ktg_set_join(corners, h, next_corner(twin));
        ktg_set_join(corners, next_corner(h), twin);
    }
}

/* ---- panels ------------------------------------------------------------------------------- */

/* Numbers the sets of faces and gives each panel room for its own. */
static ktg_status number_panels(ktg_context *context, uint32_t face_count, uint32_t *faces,
                                ktg_cut_surface *s, uint32_t **sizes) {
    for (uint32_t f = 0; f < face_count; f++)
        s->face_panel[f] =
            ktg_set_of(faces, f) == f ? s->count++ : s->face_panel[ktg_set_of(faces, f)];
    s->panels = ktg_new(context, s->count, ktg_cut_panel);
    *sizes = ktg_new(context, s->count, uint32_t);
    if (!s->panels || !*sizes)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < face_count; f++)
        s->face_index[f] = (*sizes)[s->face_panel[f]]++;
    return KTG_OK;
}

static ktg_status take_panel(ktg_context *context, uint32_t face_count, ktg_cut_panel *panel) {
    panel->mesh = ktg_new(context, 1, ktg_mesh);
    panel->face = ktg_new(context, face_count, uint32_t);
    panel->vertex = ktg_new(context, 3 * (size_t)face_count, uint32_t);
    if (!panel->mesh || !panel->face || !panel->vertex)
        return KTG_MEMORY;
    panel->mesh->face_count = face_count;
    panel->mesh->faces = ktg_new(context, 3 * (size_t)face_count, uint32_t);
    return panel->mesh->faces ? KTG_OK : KTG_MEMORY;
}

static void put_faces(const ktg_mesh *mesh, ktg_cut_surface *s) {
    for (uint32_t f = 0; f < mesh->face_count; f++)
        s->panels[s->face_panel[f]].face[s->face_index[f]] = f;
}

/* The corners in the order of their vertices, so that a panel keeps the surface's order. */
static ktg_status sort_corners(ktg_context *context, const ktg_mesh *mesh, uint32_t *sorted) {
    uint32_t *first = ktg_new(context, (size_t)mesh->vertex_count + 1, uint32_t);
    if (!first)
        return KTG_MEMORY;
    for (size_t k = 0; k < 3 * (size_t)mesh->face_count; k++)
        first[mesh->faces[k] + 1]++;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        first[v + 1] += first[v];
    for (uint32_t k = 0; k < 3 * mesh->face_count; k++)
        sorted[first[mesh->faces[k]]++] = k;
    ktg_free(first);
    return KTG_OK;
}

/* A vertex of the panel for each set of corners, met first at the set's first corner. */
static void put_corner(const ktg_mesh *mesh, uint32_t corner, uint32_t first, uint32_t *number,
                       ktg_cut_surface *s) {
    ktg_cut_panel *panel = &s->panels[s->face_panel[corner / 3]];
    if (first == corner) {
        number[corner] = panel->mesh->vertex_count++;
        panel->vertex[number[corner]] = mesh->faces[corner];
    }
    panel->mesh->faces[3 * (size_t)s->face_index[corner / 3] + corner % 3] = number[first];
}

static ktg_status put_corners(ktg_context *context, const ktg_mesh *mesh, uint32_t *corners,
                              ktg_cut_surface *s) {
    uint32_t *sorted = ktg_new(context, 3 * (size_t)mesh->face_count, uint32_t);
    uint32_t *number = ktg_new(context, 3 * (size_t)mesh->face_count, uint32_t);
    ktg_status status = sorted && number ? sort_corners(context, mesh, sorted) : KTG_MEMORY;
    for (size_t k = 0; status == KTG_OK && k < 3 * (size_t)mesh->face_count; k++)
        put_corner(mesh, sorted[k], ktg_set_of(corners, sorted[k]), number, s);
    ktg_free(sorted);
    ktg_free(number);
    return status;
}

static ktg_status put_positions(ktg_context *context, const ktg_mesh *mesh, ktg_cut_panel *panel) {
    panel->mesh->positions = ktg_new(context, panel->mesh->vertex_count, ktg_vec3);
    if (!panel->mesh->positions)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < panel->mesh->vertex_count; v++)
        panel->mesh->positions[v] = mesh->positions[panel->vertex[v]];
    return KTG_OK;
}

static ktg_status make_panels(ktg_context *context, const ktg_mesh *mesh, uint32_t *faces,
                              uint32_t *corners, uint32_t **sizes, ktg_cut_surface *s) {
    KTG_TRY(number_panels(context, mesh->face_count, faces, s, sizes));
    for (uint32_t p = 0; p < s->count; p++)
        KTG_TRY(take_panel(context, (*sizes)[p], &s->panels[p]));
    put_faces(mesh, s);
    KTG_TRY(put_corners(context, mesh, corners, s));
    for (uint32_t p = 0; p < s->count; p++)
        KTG_TRY(put_positions(context, mesh, &s->panels[p]));
    return KTG_OK;
}

ktg_status ktg_cut_apart(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *adjacency,
                         const bool *cut, ktg_cut_surface *surface) {
    *surface = (ktg_cut_surface){.face_panel = ktg_new(context, mesh->face_count, uint32_t),
                                 .face_index = ktg_new(context, mesh->face_count, uint32_t)};
    uint32_t *faces = each_alone(context, mesh->face_count), *sizes = NULL;
    uint32_t *corners = each_alone(context, adjacency->halfedge_count);
    ktg_status status = KTG_MEMORY;
    if (faces && corners && surface->face_panel && surface->face_index) {
        join_across(adjacency, cut, faces, corners);
        status = make_panels(context, mesh, faces, corners, &sizes, surface);
    }
    ktg_free(faces);
    ktg_free(corners);
    ktg_free(sizes);
    if (status != KTG_OK)
        ktg_cut_surface_free(surface);
    return status;
}

void ktg_cut_surface_free(ktg_cut_surface *surface) {
    for (uint32_t p = 0; surface->panels && p < surface->count; p++) {
        ktg_mesh_free(&surface->panels[p].mesh);
        ktg_free(surface->panels[p].vertex);
        ktg_free(surface->panels[p].face);
    }
    ktg_free(surface->panels);
    ktg_free(surface->face_panel);
    ktg_free(surface->face_index);
    *surface = (ktg_cut_surface){0};
}
