/* flatten/given.c - seams that the model itself speaks of, and what its panels are called. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/surface.h"

#include <stdio.h>
#include <stdlib.h>

/* ---- what tells the two faces at an edge apart -------------------------------------------- */

static bool differ(const uint32_t *names, uint32_t h, uint32_t twin) {
    return names && names[h / 3] != names[twin / 3];
}

static bool same_uv(const ktg_mesh *mesh, uint32_t a, uint32_t b) {
    uint32_t u = mesh->face_uv[a], v = mesh->face_uv[b];
    if (u == KTG_NONE || v == KTG_NONE)
        return u == v;
    return mesh->uvs[u].x == mesh->uvs[v].x && mesh->uvs[u].y == mesh->uvs[v].y;
}

static bool uv_jumps(const ktg_mesh *mesh, uint32_t h, uint32_t twin) {
    return mesh->face_uv && !(same_uv(mesh, h, ktg_halfedge_next(twin)) &&
                              same_uv(mesh, ktg_halfedge_next(h), twin));
}

static ktg_vec3 normal_of(const ktg_mesh *mesh, uint32_t face) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    const ktg_vec3 *p = mesh->positions;
    return ktg_cross3(ktg_sub3(p[v[1]], p[v[0]]), ktg_sub3(p[v[2]], p[v[0]]));
}

static bool turns(const ktg_mesh *mesh, uint32_t h, uint32_t twin, double crease) {
    ktg_vec3 a = normal_of(mesh, h / 3), b = normal_of(mesh, twin / 3);
    return atan2(ktg_length3(ktg_cross3(a, b)), ktg_dot3(a, b)) >= crease;
}

static bool is_seam(const ktg_mesh *mesh, uint32_t h, uint32_t twin, unsigned seams,
                    double crease) {
    return ((seams & KTG_SEAMS_OBJECTS) && differ(mesh->face_object, h, twin)) ||
           ((seams & KTG_SEAMS_GROUPS) && differ(mesh->face_group, h, twin)) ||
           ((seams & KTG_SEAMS_MATERIALS) && differ(mesh->face_material, h, twin)) ||
           ((seams & KTG_SEAMS_UV) && uv_jumps(mesh, h, twin)) ||
           ((seams & KTG_SEAMS_CREASE) && turns(mesh, h, twin, crease));
}

/* ---- marked edges ------------------------------------------------------------------------- */

static uint64_t ends_key(uint32_t a, uint32_t b) {
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare_keys(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static ktg_status cut_marked(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *a,
                             bool *cut) {
    uint64_t *keys = ktg_new(context, mesh->marked_count, uint64_t);
    if (!keys)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < mesh->marked_count; i++)
        keys[i] =
            ends_key(mesh->marked_edges[2 * (size_t)i], mesh->marked_edges[2 * (size_t)i + 1]);
    qsort(keys, mesh->marked_count, sizeof *keys, compare_keys);
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t h = a->edge_halfedges[a->edge_first[e]];
        uint64_t key = ends_key(mesh->faces[h], mesh->faces[ktg_halfedge_next(h)]);
        if (a->twin[h] != KTG_NONE &&
            bsearch(&key, keys, mesh->marked_count, sizeof key, compare_keys))
            cut[e] = true;
    }
    ktg_free(keys);
    return KTG_OK;
}

/* ---- marks that part nothing -------------------------------------------------------------- */

static uint32_t previous(uint32_t h) {
    return ktg_halfedge_next(ktg_halfedge_next(h));
}

/* Whether the faces around the start of half-edge h are parted there by h's own edge alone. */
static bool goes_all_around(const ktg_adjacency *a, const bool *cut, uint32_t h) {
    uint32_t g = previous(h);
    while (a->twin[g] != KTG_NONE && !cut[a->halfedge_edge[g]])
        g = previous(a->twin[g]);
    return a->halfedge_edge[g] == a->halfedge_edge[h];
}

/* A single cut edge with cloth all around it has two sides between the same two vertices: nothing
 * opens there, so it is no seam. */
static void forget_lone_cuts(ktg_context *context, const ktg_adjacency *a, bool *cut) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < a->halfedge_count; h++) {
        uint32_t twin = a->twin[h], e = a->halfedge_edge[h];
        if (twin == KTG_NONE || !cut[e] || !goes_all_around(a, cut, h) ||
            !goes_all_around(a, cut, twin))
            continue;
        cut[e] = false;
        count++;
    }
    if (count > 0)
        ktg_log(context, KTG_LOG_WARNING,
                "%u of the edges given as seams lie alone inside a panel, where they part nothing, "
                "and are left uncut; lead them on to another seam or to a border",
                count);
}

ktg_status ktg_seams_given(ktg_context *context, const ktg_mesh *mesh,
                           const ktg_adjacency *adjacency, unsigned seams, double crease,
                           bool *cut) {
    for (uint32_t h = 0; h < adjacency->halfedge_count; h++) {
        uint32_t twin = adjacency->twin[h];
        if (twin != KTG_NONE && h < twin && is_seam(mesh, h, twin, seams, crease))
            cut[adjacency->halfedge_edge[h]] = true;
    }
    if ((seams & KTG_SEAMS_MARKED) && mesh->marked_count > 0)
        KTG_TRY(cut_marked(context, mesh, adjacency, cut));
    forget_lone_cuts(context, adjacency, cut);
    return KTG_OK;
}

/* ---- names -------------------------------------------------------------------------------- */

/* How many names of a table some face has. */
static ktg_status count_used(ktg_context *context, const ktg_mesh *mesh, const uint32_t *face_name,
                             const ktg_names *names, uint32_t *count) {
    *count = 0;
    if (!face_name)
        return KTG_OK;
    bool *used = ktg_new(context, names->count, bool);
    if (!used)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        if (face_name[f] == KTG_NONE || used[face_name[f]])
            continue;
        used[face_name[f]] = true;
        ++*count;
    }
    ktg_free(used);
    return KTG_OK;
}

/* The mesh as if it had only the names of the table that has most of them; objects before groups
 * before materials where they have equally many. */
static ktg_status with_best_names(ktg_context *context, const ktg_mesh *mesh, ktg_mesh *view,
                                  uint32_t *most) {
    uint32_t *const faces[] = {mesh->face_object, mesh->face_group, mesh->face_material};
    const ktg_names *const names[] = {&mesh->objects, &mesh->groups, &mesh->materials};
    uint32_t best = 0;
    *most = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t count;
        KTG_TRY(count_used(context, mesh, faces[k], names[k], &count));
        if (count > *most) {
            *most = count;
            best = k;
        }
    }
    *view = *mesh;
    view->face_object = faces[best];
    view->objects = *names[best];
    view->face_group = NULL;
    return KTG_OK;
}

/* "panel 1", "panel 2", ...; a single one has the fallback. */
static ktg_status number_names(ktg_context *context, uint32_t count, const char *fallback,
                               ktg_names *names) {
    names->text = ktg_new(context, count, char *);
    if (!names->text)
        return KTG_MEMORY;
    names->count = count;
    for (uint32_t p = 0; p < count; p++) {
        char text[32];
        snprintf(text, sizeof text, "panel %u", p + 1);
        names->text[p] = ktg_copy_text(context, count == 1 ? fallback : text, SIZE_MAX);
        if (!names->text[p])
            return KTG_MEMORY;
    }
    return KTG_OK;
}

ktg_status ktg_panel_names(ktg_context *context, const ktg_mesh *mesh, const ktg_cut_surface *apart,
                           const char *fallback, ktg_names *names) {
    ktg_mesh view;
    uint32_t named;
    *names = (ktg_names){0};
    KTG_TRY(with_best_names(context, mesh, &view, &named));
    if (apart->count > 1 && named > 0)
        return ktg_mesh_component_names(context, &view, apart->face_panel, apart->count, fallback,
                                        names);
    return number_names(context, apart->count, fallback, names);
}
