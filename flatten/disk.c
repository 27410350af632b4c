/* flatten/disk.c - is the panel a disk: one manifold sheet in one part with one border and no
 * handle? If not, what is it? */
#include "core/memory.h"
#include "flatten/kernel.h"

ktg_status ktg_check_sheet(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *a) {
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t h = a->edge_halfedges[a->edge_first[e]];
        uint32_t sides = a->edge_first[e + 1] - a->edge_first[e];
        if (sides > 2 || (sides == 2 && a->twin[h] == KTG_NONE))
            return ktg_fail(context, KTG_GEOMETRY,
                            "the edge between vertices %u and %u joins %u faces that do not form "
                            "one oriented sheet; repair the mesh first",
                            mesh->faces[h] + 1, mesh->faces[ktg_halfedge_next(h)] + 1, sides);
    }
    return KTG_OK;
}

static uint32_t fan_size(const ktg_panel *panel, uint32_t v) {
    uint32_t h = panel->leaving[v], count = 0;
    do {
        count++;
        h = ktg_panel_around(panel, h);
    } while (h != panel->leaving[v] && h != KTG_NONE);
    return count;
}

/* Every vertex used, by one fan of faces. */
static ktg_status check_vertices(ktg_context *context, const ktg_panel *panel) {
    uint32_t *fans = ktg_new(context, panel->vertex_count, uint32_t);
    if (!fans)
        return KTG_MEMORY;
    ktg_status status = KTG_OK;
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++)
        fans[panel->faces[h]]++;
    for (uint32_t v = 0; status == KTG_OK && v < panel->vertex_count; v++) {
        if (fans[v] == 0)
            status = ktg_fail(context, KTG_GEOMETRY,
                              "vertex %u belongs to no face; repair the mesh first", v + 1);
        else if (fan_size(panel, v) != fans[v])
            status = ktg_fail(context, KTG_GEOMETRY,
                              "at vertex %u sheets touch in a point; repair the mesh first", v + 1);
    }
    ktg_free(fans);
    return status;
}

static ktg_status check_parts(ktg_context *context, const ktg_mesh *mesh, const ktg_panel *panel) {
    uint32_t *component = NULL, count = 0;
    ktg_status status = ktg_mesh_components(context, mesh, panel->adjacency, &component, &count);
    ktg_free(component);
    if (status == KTG_OK && count > 1)
        status = ktg_fail(context, KTG_GEOMETRY,
                          "the model has %u separate parts, and a panel is one; flatten each part "
                          "by itself",
                          count);
    return status;
}

/* The half-edge of the border that follows h. */
static uint32_t next_on_border(const ktg_panel *panel, uint32_t h) {
    return panel->leaving[panel->faces[ktg_halfedge_next(h)]];
}

static ktg_status count_borders(ktg_context *context, const ktg_panel *panel, uint32_t *loops) {
    bool *seen = ktg_new(context, panel->adjacency->halfedge_count, bool);
    if (!seen)
        return KTG_MEMORY;
    *loops = 0;
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++) {
        if (panel->adjacency->twin[h] != KTG_NONE || seen[h])
            continue;
        ++*loops;
        for (uint32_t g = h; !seen[g]; g = next_on_border(panel, g))
            seen[g] = true;
    }
    ktg_free(seen);
    return KTG_OK;
}

ktg_status ktg_panel_check_disk(ktg_context *context, const ktg_mesh *mesh,
                                const ktg_panel *panel) {
    uint32_t loops;
    KTG_TRY(ktg_check_sheet(context, mesh, panel->adjacency));
    KTG_TRY(check_vertices(context, panel));
    KTG_TRY(check_parts(context, mesh, panel));
    KTG_TRY(count_borders(context, panel, &loops));
    if (loops == 0)
        return ktg_fail(context, KTG_GEOMETRY,
                        "the surface is closed: it has no border, and cannot be laid flat before "
                        "it is cut open along seams");
    if (loops > 1)
        return ktg_fail(context, KTG_GEOMETRY,
                        "the panel has %u borders, and one that can be laid flat has one; cut it "
                        "from border to border by a seam",
                        loops);
    /* Euler: V - E + F = 2 - 2 genus - borders */
    int64_t euler = (int64_t)panel->vertex_count - panel->adjacency->edge_count + panel->face_count;
    if (euler != 1)
        return ktg_fail(context, KTG_GEOMETRY,
                        "the panel has %lld handle%s, so that it cannot be laid flat; cut each "
                        "open by seams",
                        (long long)(1 - euler) / 2, euler == -1 ? "" : "s");
    return KTG_OK;
}
