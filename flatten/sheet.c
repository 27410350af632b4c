/* flatten/sheet.c - a surface, or a panel of it, as paths see it. */
#include "flatten/sheet.h"
#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

/* A seam along a crease of this angle or more costs this part of its length: that is where the
 * cloth bends anyhow, and where a seam is not seen. */
static const double full_crease = 60 * KTG_PI / 180, crease_cost = 0.6;

ktg_vec3 ktg_sheet_area(const ktg_mesh *mesh, uint32_t face) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    ktg_vec3 a = mesh->positions[v[0]];
    return ktg_mul3(
        ktg_cross3(ktg_sub3(mesh->positions[v[1]], a), ktg_sub3(mesh->positions[v[2]], a)), 0.5);
}

static double crease_factor(const ktg_mesh *mesh, const ktg_adjacency *adjacency, uint32_t edge) {
    uint32_t h = adjacency->edge_halfedges[adjacency->edge_first[edge]], twin = adjacency->twin[h];
    if (twin == KTG_NONE)
        return 1;
    ktg_vec3 a = ktg_sheet_area(mesh, h / 3), b = ktg_sheet_area(mesh, twin / 3);
    double angle = atan2(ktg_length3(ktg_cross3(a, b)), ktg_dot3(a, b));
    return 1 - (1 - crease_cost) * ktg_min(1, angle / full_crease);
}

static void set_edges(ktg_sheet *s) {
    for (uint32_t e = 0; e < s->edge_count; e++) {
        uint32_t h = s->adjacency->edge_halfedges[s->adjacency->edge_first[e]];
        uint32_t a = s->mesh->faces[h], b = s->mesh->faces[ktg_halfedge_next(h)];
        s->ends[2 * (size_t)e] = a;
        s->ends[2 * (size_t)e + 1] = b;
        s->length[e] = ktg_length3(ktg_sub3(s->mesh->positions[b], s->mesh->positions[a]));
        s->cost[e] = s->length[e] * crease_factor(s->mesh, s->adjacency, e);
        s->mean_edge += s->length[e] / s->edge_count;
        if (ktg_sheet_is_border(s, e))
            s->border[a] = s->border[b] = true;
    }
}

static void set_around(ktg_sheet *s) {
    const uint32_t vertex_count = s->mesh->vertex_count;
    for (size_t i = 0; i < 2 * (size_t)s->edge_count; i++)
        s->first[s->ends[i] + 1]++;
    for (uint32_t v = 0; v < vertex_count; v++)
        s->first[v + 1] += s->first[v];
    for (size_t i = 2 * (size_t)s->edge_count; i-- > 0;)
        s->around[--s->first[s->ends[i] + 1]] = (uint32_t)(i / 2);
    /* every entry moved one place: first[v + 1] is now where v starts */
    for (uint32_t v = 0; v < vertex_count; v++)
        s->first[v] = s->first[v + 1];
    s->first[vertex_count] = 2 * s->edge_count;
}

static ktg_status fill_sheet(ktg_context *context, ktg_sheet *s) {
    if (!s->adjacency) {
        KTG_TRY(ktg_adjacency_new(context, s->mesh, &s->own));
        s->adjacency = s->own;
    }
    const size_t edges = s->edge_count = s->adjacency->edge_count;
    s->ends = ktg_new(context, 2 * edges, uint32_t);
    s->around = ktg_new(context, 2 * edges, uint32_t);
    s->first = ktg_new(context, (size_t)s->mesh->vertex_count + 1, uint32_t);
    s->length = ktg_new(context, edges, double);
    s->cost = ktg_new(context, edges, double);
    s->border = ktg_new(context, s->mesh->vertex_count, bool);
    s->outer = ktg_new(context, s->mesh->vertex_count, bool);
    if (!s->ends || !s->around || !s->first || !s->length || !s->cost || !s->border || !s->outer)
        return KTG_MEMORY;
    set_edges(s);
    memcpy(s->outer, s->border, s->mesh->vertex_count * sizeof *s->outer);
    set_around(s);
    for (uint32_t f = 0; f < s->mesh->face_count; f++)
        s->area += ktg_length3(ktg_sheet_area(s->mesh, f));
    return KTG_OK;
}

ktg_status ktg_sheet_new(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *adjacency,
                         ktg_sheet **sheet) {
    ktg_sheet *made = ktg_new(context, 1, ktg_sheet);
    *sheet = NULL;
    if (!made)
        return KTG_MEMORY;
    made->mesh = mesh;
    made->adjacency = adjacency;
    ktg_status status = fill_sheet(context, made);
    if (status != KTG_OK)
        ktg_sheet_free(&made);
    *sheet = made;
    return status;
}

void ktg_sheet_free(ktg_sheet **sheet) {
    if (!sheet || !*sheet)
        return;
    ktg_adjacency_free(&(*sheet)->own);
    ktg_free((*sheet)->ends);
    ktg_free((*sheet)->around);
    ktg_free((*sheet)->first);
    ktg_free((*sheet)->length);
    ktg_free((*sheet)->cost);
    ktg_free((*sheet)->border);
    ktg_free((*sheet)->outer);
    ktg_free(*sheet);
    *sheet = NULL;
}

static bool is_slit(const ktg_cut_surface *parts, uint32_t index, const ktg_adjacency *surface,
                    uint32_t h) {
    uint32_t twin = surface->twin[3 * parts->panels[index].face[h / 3] + h % 3];
    return twin != KTG_NONE && parts->face_panel[twin / 3] == index;
}

/* Where a closed panel was slit there is nothing but slits: darts begin there after all. */
ktg_status ktg_sheet_find_slits(ktg_context *context, const ktg_cut_surface *parts, uint32_t index,
                                const ktg_adjacency *surface, ktg_sheet *sheet) {
    const uint32_t vertex_count = sheet->mesh->vertex_count;
    bool *outer = ktg_copy_array(context, sheet->border, vertex_count, sizeof *outer), any = false;
    if (!outer)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < sheet->adjacency->halfedge_count; h++)
        if (sheet->adjacency->twin[h] == KTG_NONE && is_slit(parts, index, surface, h))
            outer[sheet->mesh->faces[h]] = outer[sheet->mesh->faces[ktg_halfedge_next(h)]] = false;
    for (uint32_t v = 0; v < vertex_count; v++)
        any |= outer[v];
    if (any)
        memcpy(sheet->outer, outer, vertex_count * sizeof *outer);
    ktg_free(outer);
    return KTG_OK;
}
