/* flatten/panel.c - the panel as the kernel sees it: normalised, with adjacency and a middle. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>

/* A face lower than this part of its longest edge has no area to speak of: the cotangents of its
 * angles, and with them the linear systems, lose all digits. */
static const double least_height = 1e-10;

/* Scales first, so that the differences cannot overflow, then moves, then scales to size. */
static void normalise(const ktg_mesh *mesh, ktg_panel *panel) {
    double largest = 0, extent = 0;
    int first, second;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        largest = fmax(largest, ktg_largest3(mesh->positions[v]));
    (void)frexp(largest, &first);
    ktg_vec3 low = {1, 1, 1};
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        ktg_vec3 p = panel->positions[v] = ktg_ldexp3(mesh->positions[v], -first);
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        panel->positions[v] = ktg_sub3(panel->positions[v], low);
        extent = fmax(extent, ktg_largest3(panel->positions[v]));
    }
    (void)frexp(extent, &second);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        panel->positions[v] = ktg_ldexp3(panel->positions[v], -second);
    panel->exponent = first + second;
}

static ktg_status check_areas(ktg_context *context, const ktg_mesh *mesh, const ktg_panel *panel) {
    for (uint32_t f = 0; f < panel->face_count; f++) {
        const uint32_t *corners = panel->faces + 3 * (size_t)f;
        const ktg_vec3 *p = panel->positions;
        ktg_vec3 ab = ktg_sub3(p[corners[1]], p[corners[0]]),
                 bc = ktg_sub3(p[corners[2]], p[corners[1]]),
                 ca = ktg_sub3(p[corners[0]], p[corners[2]]);
        double longest = fmax(ktg_dot3(ab, ab), fmax(ktg_dot3(bc, bc), ktg_dot3(ca, ca)));
        ktg_vec3 at = mesh->positions[corners[0]];
        if (!(ktg_length3(ktg_cross3(ab, bc)) > least_height * longest))
            return ktg_fail(context, KTG_GEOMETRY,
                            "the face at (%g, %g, %g) has no area: its corners lie on a line; "
                            "repair or remesh the panel before flattening it",
                            at.x, at.y, at.z);
    }
    return KTG_OK;
}

static void find_leaving(ktg_panel *panel) {
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        panel->leaving[v] = KTG_NONE;
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++) {
        uint32_t *leaving = &panel->leaving[panel->faces[h]];
        if (*leaving == KTG_NONE || panel->adjacency->twin[h] == KTG_NONE)
            *leaving = h;
    }
}

static ktg_status fill_panel(ktg_context *context, const ktg_mesh *mesh, ktg_panel *panel) {
    panel->vertex_count = mesh->vertex_count;
    panel->face_count = mesh->face_count;
    panel->faces = mesh->faces;
    panel->positions = ktg_new(context, mesh->vertex_count, ktg_vec3);
    panel->leaving = ktg_new(context, mesh->vertex_count, uint32_t);
    if (!panel->positions || !panel->leaving)
        return KTG_MEMORY;
    normalise(mesh, panel);
    KTG_TRY(check_areas(context, mesh, panel));
    KTG_TRY(ktg_adjacency_new(context, mesh, &panel->adjacency));
    find_leaving(panel);
    return KTG_OK;
}

ktg_status ktg_panel_new(ktg_context *context, const ktg_mesh *mesh, ktg_panel **panel) {
    *panel = NULL;
    if (mesh->face_count == 0)
        return ktg_fail(context, KTG_GEOMETRY,
                        "there is nothing to flatten: the model has no "
                        "faces");
    ktg_panel *made = ktg_new(context, 1, ktg_panel);
    if (!made)
        return KTG_MEMORY;
    ktg_status status = fill_panel(context, mesh, made);
    if (status != KTG_OK)
        ktg_panel_free(&made);
    *panel = made;
    return status;
}

void ktg_panel_free(ktg_panel **panel) {
    if (!panel || !*panel)
        return;
    ktg_free((*panel)->positions);
    ktg_free((*panel)->leaving);
    ktg_adjacency_free(&(*panel)->adjacency);
    ktg_free(*panel);
    *panel = NULL;
}

/* ---- the middle --------------------------------------------------------------------------- */

/* depth[v]: edges between v and the border (breadth first). */
static ktg_status find_depths(ktg_context *context, const ktg_panel *panel, uint32_t *depth) {
    uint32_t *queue = ktg_new(context, panel->vertex_count, uint32_t);
    if (!queue)
        return KTG_MEMORY;
    uint32_t last = 0;
    for (uint32_t v = 0; v < panel->vertex_count; v++) {
        bool border = panel->adjacency->twin[panel->leaving[v]] == KTG_NONE;
        depth[v] = border ? 0 : KTG_NONE;
        if (border)
            queue[last++] = v;
    }
    for (uint32_t first = 0; first < last; first++) {
        uint32_t start = panel->leaving[queue[first]], h = start;
        do {
            uint32_t w = panel->faces[ktg_halfedge_next(h)];
            if (depth[w] == KTG_NONE) {
                depth[w] = depth[queue[first]] + 1;
                queue[last++] = w;
            }
            h = ktg_panel_around(panel, h);
        } while (h != start && h != KTG_NONE);
    }
    ktg_free(queue);
    return KTG_OK;
}

static ktg_vec3 area_centre(const ktg_panel *panel) {
    ktg_vec3 sum = {0, 0, 0};
    double total = 0;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        const uint32_t *corners = panel->faces + 3 * (size_t)f;
        ktg_vec3 a = panel->positions[corners[0]], b = panel->positions[corners[1]],
                 c = panel->positions[corners[2]];
        double area = ktg_length3(ktg_cross3(ktg_sub3(b, a), ktg_sub3(c, a)));
        sum = ktg_madd3(sum, area / 3, ktg_add3(a, ktg_add3(b, c)));
        total += area;
    }
    return ktg_mul3(sum, 1 / total);
}

/* What choose_middle compares the edges by. */
typedef struct middle_search {
    const ktg_panel *panel;
    const uint32_t *depth;
    uint32_t deepest; /* the largest sum of an edge's two depths */
    ktg_vec3 centre;
} middle_search;

static void edge_ends(const ktg_panel *panel, uint32_t edge, uint32_t ends[2]) {
    uint32_t h = panel->adjacency->edge_halfedges[panel->adjacency->edge_first[edge]];
    ends[0] = panel->faces[h];
    ends[1] = panel->faces[ktg_halfedge_next(h)];
}

static uint32_t edge_depth(const middle_search *search, uint32_t edge) {
    uint32_t ends[2];
    edge_ends(search->panel, edge, ends);
    return search->depth[ends[0]] + search->depth[ends[1]];
}

/* Squared distance of an edge's middle from the centre; infinite when the edge is too close to the
 * border. */
static double distance_from_centre(const middle_search *search, uint32_t edge) {
    if (2 * (uint64_t)edge_depth(search, edge) < search->deepest)
        return INFINITY;
    uint32_t ends[2];
    edge_ends(search->panel, edge, ends);
    ktg_vec3 sum = ktg_add3(search->panel->positions[ends[0]], search->panel->positions[ends[1]]);
    ktg_vec3 away = ktg_sub3(ktg_mul3(sum, 0.5), search->centre);
    return ktg_dot3(away, away);
}

/* Equally near edges of a symmetric panel differ by rounding only, which depends on where the model
 * lies: the first of all that are nearest within a margin is taken. */
static uint32_t choose_middle(middle_search *search) {
    const uint32_t count = search->panel->adjacency->edge_count;
    for (uint32_t e = 0; e < count; e++)
        if (edge_depth(search, e) > search->deepest)
            search->deepest = edge_depth(search, e);
    double nearest = INFINITY;
    for (uint32_t e = 0; e < count; e++)
        nearest = fmin(nearest, distance_from_centre(search, e));
    uint32_t chosen = 0;
    while (distance_from_centre(search, chosen) > nearest + 1e-9)
        chosen++;
    return chosen;
}

ktg_status ktg_panel_middle(ktg_context *context, const ktg_panel *panel, uint32_t *edge) {
    uint32_t *depth = ktg_new(context, panel->vertex_count, uint32_t);
    if (!depth)
        return KTG_MEMORY;
    ktg_status status = find_depths(context, panel, depth);
    if (status == KTG_OK) {
        middle_search search = {panel, depth, 0, area_centre(panel)};
        *edge = choose_middle(&search);
    }
    ktg_free(depth);
    return status;
}
