/* mesh/check.c - what a mesh is and what is wrong with it, in linear time. */
#include "core/memory.h"
#include "core/sets.h"
#include "core/vec.h"
#include "mesh/intersect.h"
#include "mesh/weld.h"

#include <string.h>

typedef struct check_work {
    uint32_t *weld;
    uint32_t *faces; /* those with three different corners; topology is counted on them */
    ktg_mesh view;   /* the mesh with these faces only; borrows everything */
    ktg_adjacency *adjacency;
    uint32_t *part; /* per face of the view: faces connected through edges of any kind */
    uint32_t *fan;  /* per corner of the view: corners of a vertex connected through edges */
    uint32_t *loop; /* per corner of the view: border edges connected at the ends of fans */
    bool *duplicate, *seen, *open;
    double *volume;
} check_work;

static uint32_t next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

/* The half-edges of edge e, and how many they are. */
static const uint32_t *edge_halfedges(const ktg_adjacency *a, uint32_t e, uint32_t *count) {
    *count = a->edge_first[e + 1] - a->edge_first[e];
    return a->edge_halfedges + a->edge_first[e];
}

static ktg_status count_faces(ktg_context *context, const ktg_mesh *mesh, check_work *w,
                              ktg_mesh_report *report) {
    w->faces = ktg_new(context, 3 * (size_t)mesh->face_count, uint32_t);
    w->duplicate = ktg_new(context, mesh->face_count, bool);
    w->seen = ktg_new(context, mesh->vertex_count, bool);
    if (!w->faces || !w->duplicate || !w->seen)
        return KTG_MEMORY;
    KTG_TRY(ktg_mesh_duplicates(context, mesh->faces, mesh->face_count, w->weld, w->duplicate));
    w->view = *mesh;
    w->view.faces = w->faces;
    w->view.face_count = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->faces + 3 * (size_t)f;
        report->degenerate_faces += ktg_mesh_is_degenerate(mesh, f, w->weld);
        report->duplicate_faces += w->duplicate[f];
        w->seen[c[0]] = w->seen[c[1]] = w->seen[c[2]] = true;
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
            memcpy(w->faces + 3 * (size_t)w->view.face_count++, c, 3 * sizeof *c);
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        report->unreferenced_vertices += !w->seen[v];
    return KTG_OK;
}

/* Joins faces and corners across an edge; corners of the same vertex only. */
static void join_across(check_work *w, uint32_t h, uint32_t g) {
    uint32_t h_end = next_corner(h), g_end = next_corner(g);
    bool same_way = w->faces[h] == w->faces[g];
    ktg_set_join(w->part, h / 3, g / 3);
    ktg_set_join(w->fan, h, same_way ? g : g_end);
    ktg_set_join(w->fan, h_end, same_way ? g_end : g);
}

static ktg_status connect(ktg_context *context, check_work *w) {
    uint32_t corners = 3 * w->view.face_count;
    KTG_TRY(ktg_adjacency_new(context, &w->view, &w->adjacency));
    w->part = ktg_new(context, w->view.face_count, uint32_t);
    w->fan = ktg_new(context, corners, uint32_t);
    w->loop = ktg_new(context, 2 * (size_t)corners, uint32_t);
    w->open = ktg_new(context, w->view.face_count, bool);
    w->volume = ktg_new(context, w->view.face_count, double);
    if (!w->part || !w->fan || !w->loop || !w->open || !w->volume)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < w->view.face_count; f++)
        w->part[f] = f;
    for (uint32_t h = 0; h < corners; h++)
        w->fan[h] = h;
    for (uint32_t e = 0; e < w->adjacency->edge_count; e++) {
        uint32_t count;
        const uint32_t *halfedges = edge_halfedges(w->adjacency, e, &count);
        for (uint32_t i = 1; i < count; i++)
            join_across(w, halfedges[0], halfedges[i]);
    }
    return KTG_OK;
}

static void count_edges(check_work *w, ktg_mesh_report *report) {
    bool balanced = true;
    report->edges = w->adjacency->edge_count;
    for (uint32_t e = 0; e < w->adjacency->edge_count; e++) {
        uint32_t count, same_way = 0;
        const uint32_t *halfedges = edge_halfedges(w->adjacency, e, &count);
        for (uint32_t i = 0; i < count; i++)
            same_way += w->faces[halfedges[i]] == w->faces[halfedges[0]];
        report->border_edges += count == 1;
        report->nonmanifold_edges += count > 2;
        report->misoriented_edges += count == 2 && same_way == 2;
        balanced = balanced && (count == 1 || 2 * same_way == count);
        for (uint32_t i = 0; i < count && (count != 2 || same_way != 1); i++)
            w->open[ktg_set_of(w->part, halfedges[i] / 3)] = true;
    }
    report->oriented = balanced;
    report->closed = report->border_edges == 0 && w->view.face_count > 0;
}

/* A vertex whose corners do not hang together through edges has several fans. `seen` marks
 * vertices with one fan found, then is wiped. */
static void count_vertices(check_work *w, ktg_mesh_report *report) {
    uint32_t corners = 3 * w->view.face_count, referenced = 0;
    memset(w->seen, 0, w->view.vertex_count * sizeof *w->seen);
    for (uint32_t h = 0; h < corners; h++) {
        if (ktg_set_of(w->fan, h) != h)
            continue;
        referenced += !w->seen[w->faces[h]];
        report->nonmanifold_vertices += w->seen[w->faces[h]];
        w->seen[w->faces[h]] = true;
    }
    report->euler = (int64_t)referenced - report->edges + w->view.face_count;
    report->manifold = report->nonmanifold_edges == 0 && report->nonmanifold_vertices == 0;
}

/* Border edges that end at the same fan belong to one loop. Where many meet they are all one. */
static ktg_status count_loops(ktg_context *context, check_work *w, ktg_mesh_report *report) {
    uint32_t corners = 3 * w->view.face_count;
    uint32_t *at_fan = ktg_new(context, corners, uint32_t); /* a border half-edge at each fan */
    if (!at_fan)
        return KTG_MEMORY;
    memset(at_fan, 0xff, corners * sizeof *at_fan);
    for (uint32_t h = 0; h < corners; h++)
        w->loop[h] = h;
    for (uint32_t e = 0; e < w->adjacency->edge_count; e++) {
        uint32_t count, h = *edge_halfedges(w->adjacency, e, &count);
        uint32_t ends[2] = {h, next_corner(h)};
        for (int k = 0; k < 2 && count == 1; k++) {
            uint32_t fan = ktg_set_of(w->fan, ends[k]);
            if (at_fan[fan] == KTG_NONE)
                at_fan[fan] = h;
            else
                ktg_set_join(w->loop, at_fan[fan], h);
        }
    }
    for (uint32_t e = 0; e < w->adjacency->edge_count; e++) {
        uint32_t count, h = *edge_halfedges(w->adjacency, e, &count);
        report->border_loops += count == 1 && ktg_set_of(w->loop, h) == h;
    }
    ktg_free(at_fan);
    return KTG_OK;
}

/* Volumes are taken from a vertex of the part, so that a far origin costs no digits. */
static void measure(check_work *w, ktg_mesh_report *report) {
    const ktg_vec3 *at = w->view.positions;
    for (uint32_t f = 0; f < w->view.face_count; f++) {
        const uint32_t *c = w->faces + 3 * (size_t)f;
        uint32_t part = ktg_set_of(w->part, f);
        ktg_vec3 origin = at[w->faces[3 * (size_t)part]];
        ktg_vec3 normal = ktg_cross3(ktg_sub3(at[c[1]], at[c[0]]), ktg_sub3(at[c[2]], at[c[0]]));
        report->area += ktg_length3(normal) / 2;
        w->volume[part] += ktg_dot3(normal, ktg_sub3(at[c[0]], origin)) / 6;
    }
    for (uint32_t f = 0; f < w->view.face_count; f++) {
        if (ktg_set_of(w->part, f) != f)
            continue;
        report->components++;
        report->inward_components += !w->open[f] && w->volume[f] < 0;
        if (report->closed && report->oriented)
            report->volume += w->volume[f];
    }
    for (uint32_t v = 0; v < w->view.vertex_count; v++) {
        ktg_vec3 p = at[v], *low = &report->low, *high = &report->high;
        if (v == 0)
            *low = *high = p;
        *low = (ktg_vec3){fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z)};
        *high = (ktg_vec3){fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z)};
    }
}

/* Border edges that would find exactly one partner if coincident vertices were one. */
static ktg_status count_unstitched(ktg_context *context, check_work *w, ktg_mesh_report *report) {
    uint32_t corners = 3 * w->view.face_count;
    ktg_mesh welded = w->view;
    ktg_adjacency *adjacency = NULL;
    welded.faces = ktg_new(context, corners, uint32_t);
    ktg_status status = welded.faces ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t h = 0; h < corners; h++)
            welded.faces[h] = w->weld[w->faces[h]];
        status = ktg_adjacency_new(context, &welded, &adjacency);
    }
    for (uint32_t e = 0; status == KTG_OK && e < adjacency->edge_count; e++) {
        uint32_t count, sides[2];
        const uint32_t *halfedges = edge_halfedges(adjacency, e, &count);
        for (uint32_t i = 0; i < count && count == 2; i++)
            (void)edge_halfedges(w->adjacency, w->adjacency->halfedge_edge[halfedges[i]],
                                 &sides[i]);
        report->unstitched_edges += count == 2 && sides[0] == 1 && sides[1] == 1 ? 2 : 0;
    }
    ktg_free(welded.faces);
    ktg_adjacency_free(&adjacency);
    return status;
}

static ktg_status check(ktg_context *context, const ktg_mesh *mesh, check_work *w,
                        ktg_mesh_report *report) {
    report->vertices = mesh->vertex_count;
    report->faces = mesh->face_count;
    KTG_TRY(ktg_mesh_weld(context, mesh->positions, mesh->vertex_count, &w->weld));
    KTG_TRY(count_faces(context, mesh, w, report));
    KTG_TRY(connect(context, w));
    count_edges(w, report);
    count_vertices(w, report);
    KTG_TRY(count_loops(context, w, report));
    measure(w, report);
    KTG_TRY(count_unstitched(context, w, report));
    /* Euler: V - E + F + loops = 2 parts - 2 genus */
    int64_t twice = 2 * (int64_t)report->components - report->border_loops - report->euler;
    report->genus = report->manifold && report->oriented ? (int32_t)(twice / 2) : -1;
    return KTG_OK;
}

ktg_status ktg_mesh_check(ktg_context *context, const ktg_mesh *mesh, bool intersections,
                          ktg_mesh_report *report) {
    check_work work = {0};
    memset(report, 0, sizeof *report);
    ktg_status status = check(context, mesh, &work, report);
    if (status == KTG_OK && intersections) {
        status = ktg_mesh_intersections(context, mesh, &report->self_intersections);
        report->intersections_known = status == KTG_OK;
    }
    ktg_free(work.weld);
    ktg_free(work.faces);
    ktg_adjacency_free(&work.adjacency);
    ktg_free(work.part);
    ktg_free(work.fan);
    ktg_free(work.loop);
    ktg_free(work.duplicate);
    ktg_free(work.seen);
    ktg_free(work.open);
    ktg_free(work.volume);
    return status;
}
