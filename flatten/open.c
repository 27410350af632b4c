/* flatten/open.c - short cuts that make every panel a disk.
 *
 * Erickson & Whittlesey, "Greedy optimal homotopy and homology generators" (SODA 2005): of the tree
 * of shortest ways to the border, closed by one edge each, take those loops, shortest first, that
 * leave the panel in one part. What is open has arcs from border to border for loops. */
#include "core/memory.h"
#include "core/sets.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <stdlib.h>
#include <string.h>

/* Loops that are cut one after the other. */
enum { most_single_loops = 6 };

/* An edge with the length of the loop that it closes. */
typedef struct loop {
    double length;
    uint32_t edge;
} loop;

typedef struct opening {
    const ktg_cut_panel *part;
    ktg_sheet *sheet;
    bool *roots;      /* vertex_count: where ways lead to */
    double *distance; /* vertex_count */
    uint32_t *via;    /* vertex_count */
    loop *loops;      /* edge_count */
    uint32_t *sets;   /* face_count */
} opening;

static void opening_free(opening *o) {
    ktg_sheet_free(&o->sheet);
    ktg_free(o->roots);
    ktg_free(o->distance);
    ktg_free(o->via);
    ktg_free(o->loops);
    ktg_free(o->sets);
}

static ktg_status opening_new(ktg_context *context, const ktg_cut_panel *part, opening *o) {
    const uint32_t vertex_count = part->mesh->vertex_count;
    *o = (opening){.part = part};
    KTG_TRY(ktg_sheet_new(context, part->mesh, NULL, &o->sheet));
    o->roots = ktg_new(context, vertex_count, bool);
    o->distance = ktg_new(context, vertex_count, double);
    o->via = ktg_new(context, vertex_count, uint32_t);
    o->loops = ktg_new(context, o->sheet->edge_count, loop);
    o->sets = ktg_new(context, part->mesh->face_count, uint32_t);
    return o->roots && o->distance && o->via && o->loops && o->sets ? KTG_OK : KTG_MEMORY;
}

/* V - E + F: 1 of a disk, 2 of a sphere. */
static int64_t euler(const ktg_sheet *s) {
    return (int64_t)s->mesh->vertex_count - s->edge_count + s->mesh->face_count;
}

static int longest_first(const void *a, const void *b) {
    const loop *x = a, *y = b;
    if (x->length != y->length)
        return x->length < y->length ? 1 : -1;
    return (x->edge > y->edge) - (x->edge < y->edge);
}

/* Inner edges that close a loop. */
static uint32_t list_loops(opening *o) {
    const ktg_sheet *s = o->sheet;
    uint32_t count = 0;
    for (uint32_t e = 0; e < s->edge_count; e++) {
        uint32_t a = s->ends[2 * (size_t)e], b = s->ends[2 * (size_t)e + 1];
        if (!ktg_sheet_is_border(s, e) && o->via[a] != e && o->via[b] != e)
            o->loops[count++] = (loop){o->distance[a] + o->distance[b] + s->cost[e], e};
    }
    qsort(o->loops, count, sizeof *o->loops, longest_first);
    return count;
}

/* The loops that together leave the panel in one part, in o->loops, shortest last: joining faces
 * across edges, longest loops first, they are those of the edges that join nothing. */
static uint32_t find_loops(opening *o) {
    uint32_t count = list_loops(o), found = 0;
    for (uint32_t f = 0; f < o->part->mesh->face_count; f++)
        o->sets[f] = f;
    for (uint32_t i = 0; i < count; i++) {
        const ktg_adjacency *a = o->sheet->adjacency;
        uint32_t h = a->edge_halfedges[a->edge_first[o->loops[i].edge]];
        uint32_t one = ktg_set_of(o->sets, h / 3), other = ktg_set_of(o->sets, a->twin[h] / 3);
        if (one == other)
            o->loops[found++] = o->loops[i];
        o->sets[one] = other;
    }
    return found;
}

/* The surface's edge for one of the panel's. */
static uint32_t edge_of(const opening *o, const ktg_adjacency *adjacency, uint32_t edge) {
    const ktg_adjacency *a = o->sheet->adjacency;
    uint32_t h = a->edge_halfedges[a->edge_first[edge]];
    return adjacency->halfedge_edge[3 * o->part->face[h / 3] + h % 3];
}

/* Cuts from v to a root; what both ways of a loop on a closed panel have in common is not cut. */
static void cut_way(const opening *o, const ktg_adjacency *adjacency, uint32_t v, bool closed,
                    bool *cut) {
    while (o->via[v] != KTG_NONE) {
        uint32_t edge = edge_of(o, adjacency, o->via[v]);
        cut[edge] = !(closed && cut[edge]);
        v = ktg_sheet_other_end(o->sheet, o->via[v], v);
    }
}

static uint32_t farthest(const opening *o) {
    uint32_t far = 0;
    for (uint32_t v = 1; v < o->part->mesh->vertex_count; v++)
        if (o->distance[v] > o->distance[far])
            far = v;
    return far;
}

/* Makes the vertex that is farthest from the roots the only root. */
static ktg_status root_far_away(ktg_context *context, opening *o) {
    uint32_t far = farthest(o);
    memset(o->roots, 0, o->part->mesh->vertex_count * sizeof *o->roots);
    o->roots[far] = true;
    return ktg_path_distances(context, o->sheet, o->sheet->cost, o->roots, o->distance, o->via);
}

/* Ways lead to the border; on a closed panel to one end of its longest extent. */
static ktg_status find_ways(ktg_context *context, opening *o, bool closed) {
    const uint32_t vertex_count = o->part->mesh->vertex_count;
    memcpy(o->roots, o->sheet->border, vertex_count * sizeof *o->roots);
    o->roots[0] |= closed;
    KTG_TRY(ktg_path_distances(context, o->sheet, o->sheet->cost, o->roots, o->distance, o->via));
    return closed ? root_far_away(context, o) : KTG_OK;
}

static bool has_border(const ktg_sheet *s) {
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        if (s->border[v])
            return true;
    return false;
}

static void cut_loop(const opening *o, const ktg_adjacency *adjacency, uint32_t edge, bool closed,
                     bool *cut) {
    cut[edge_of(o, adjacency, edge)] = true;
    for (int k = 0; k < 2; k++)
        cut_way(o, adjacency, o->sheet->ends[2 * (size_t)edge + k], closed, cut);
}

/* The cheapest edge that leads on from one of two vertices. */
static uint32_t way_on(const ktg_sheet *s, uint32_t one, uint32_t other) {
    uint32_t best = KTG_NONE;
    for (uint32_t e = 0; e < s->edge_count; e++) {
        uint32_t a = s->ends[2 * (size_t)e], b = s->ends[2 * (size_t)e + 1];
        bool from_a = a == one || a == other, from_b = b == one || b == other;
        if (from_a != from_b && (best == KTG_NONE || s->cost[e] < s->cost[best]))
            best = e;
    }
    return best;
}

/* Cuts a sphere from its root to the vertex farthest away. A slit of one edge opens nothing, as
 * both its sides run between the same two vertices; it is made longer by an edge. */
static void slit_sphere(const opening *o, const ktg_adjacency *adjacency, bool *cut) {
    const ktg_sheet *s = o->sheet;
    uint32_t far = farthest(o), next = ktg_sheet_other_end(s, o->via[far], far);
    cut_way(o, adjacency, far, false, cut);
    if (o->via[next] == KTG_NONE)
        cut[edge_of(o, adjacency, way_on(s, far, next))] = true;
}

/* Nearer to a disk: by the shortest loop, as what is cut makes others shorter; by all of them at
 * once, which makes it a disk, where there are many. */
static ktg_status open_once(ktg_context *context, const ktg_adjacency *adjacency, opening *o,
                            bool *cut) {
    bool closed = !has_border(o->sheet);
    KTG_TRY(find_ways(context, o, closed));
    uint32_t count = find_loops(o);
    if (count == 0) {
        slit_sphere(o, adjacency, cut);
        return KTG_OK;
    }
    uint32_t first = count > most_single_loops && !closed ? 0 : count - 1;
    for (uint32_t i = first; i < count; i++)
        cut_loop(o, adjacency, o->loops[i].edge, closed, cut);
    return KTG_OK;
}

/* *opened: whether anything had to be done. */
static ktg_status open_panel(ktg_context *context, const ktg_adjacency *adjacency,
                             const ktg_cut_panel *part, bool *cut, bool *opened) {
    opening o;
    ktg_status status = opening_new(context, part, &o);
    if (status == KTG_OK && euler(o.sheet) != 1) {
        *opened = true;
        status = open_once(context, adjacency, &o, cut);
    }
    opening_free(&o);
    return status;
}

ktg_status ktg_sheet_open(ktg_context *context, const ktg_mesh *mesh,
                          const ktg_adjacency *adjacency, bool *cut) {
    bool opened = true;
    while (opened) { /* each round lowers the sum of borders and twice the handles */
        ktg_cut_surface parts;
        opened = false;
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(ktg_cut_apart(context, mesh, adjacency, cut, &parts));
        ktg_status status = KTG_OK;
        for (uint32_t p = 0; status == KTG_OK && p < parts.count; p++)
            status = open_panel(context, adjacency, &parts.panels[p], cut, &opened);
        ktg_cut_surface_free(&parts);
        KTG_TRY(status);
    }
    return KTG_OK;
}

ktg_status ktg_seams_open(ktg_context *context, const ktg_mesh *mesh,
                          const ktg_adjacency *adjacency, bool *cut) {
    bool *opened = ktg_copy_array(context, cut, adjacency->edge_count, sizeof *cut);
    if (!opened)
        return KTG_MEMORY;
    ktg_status status = ktg_sheet_open(context, mesh, adjacency, opened);
    if (status == KTG_OK)
        memcpy(cut, opened, adjacency->edge_count * sizeof *cut);
    ktg_free(opened);
    return status;
}
