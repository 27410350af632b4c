/* flatten/mirror.c - the plane in which a surface mirrors itself, and seams copied across it. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <string.h>

/* A mirror image lies on the surface when it is no further from it than this on the mean, and for
 * nearly all points; parts of the surface's extent. */
static const double most_mean = 0.01, most_far = 0.03, few = 0.05;

/* So much better must a plane be to come before one that is earlier in the order. */
static const double clearly_better = 0.5;

enum { sample_count = 300 };

static ktg_vec3 reflect(const ktg_mirror *m, ktg_vec3 p) {
    return ktg_madd3(p, -2 * ktg_mirror_side(m, p), m->normal);
}

/* ---- closest ------------------------------------------------------------------------------- */

/* The vertex nearest to p among those allowed (NULL: all), or KTG_NONE. */
static uint32_t nearest_vertex(const ktg_mesh *mesh, ktg_vec3 p, const bool *allowed) {
    uint32_t nearest = KTG_NONE;
    double least = INFINITY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        ktg_vec3 d = ktg_sub3(mesh->positions[v], p);
        double square = ktg_dot3(d, d);
        if (square < least && (!allowed || allowed[v])) {
            least = square;
            nearest = v;
        }
    }
    return nearest;
}

static double distance_from_segment(ktg_vec3 p, ktg_vec3 a, ktg_vec3 b) {
    ktg_vec3 along = ktg_sub3(b, a), from = ktg_sub3(p, a);
    double t = ktg_dot3(from, along) / ktg_max(1e-300, ktg_dot3(along, along));
    return ktg_length3(ktg_madd3(from, -ktg_max(0, ktg_min(1, t)), along));
}

/* From a face: its plane where p is above it, else its edges. */
static double distance_from_face(const ktg_mesh *mesh, uint32_t face, ktg_vec3 p) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    ktg_vec3 normal = ktg_unit3(ktg_sheet_area(mesh, face));
    double least = INFINITY;
    bool above = true;
    for (int k = 0; k < 3; k++) {
        ktg_vec3 a = mesh->positions[v[k]], b = mesh->positions[v[(k + 1) % 3]];
        least = ktg_min(least, distance_from_segment(p, a, b));
        above &= ktg_dot3(ktg_cross3(normal, ktg_sub3(b, a)), ktg_sub3(p, a)) >= 0;
    }
    return above ? fabs(ktg_dot3(normal, ktg_sub3(p, mesh->positions[v[0]]))) : least;
}

/* Near enough: from the faces around the nearest vertex. */
static double distance_from_surface(const ktg_sheet *sheet, ktg_vec3 p) {
    uint32_t v = nearest_vertex(sheet->mesh, p, NULL);
    double least = INFINITY;
    for (uint32_t i = sheet->first[v]; i < sheet->first[v + 1]; i++) {
        const ktg_adjacency *a = sheet->adjacency;
        for (uint32_t k = a->edge_first[sheet->around[i]]; k < a->edge_first[sheet->around[i] + 1];
             k++)
            least = ktg_min(least, distance_from_face(sheet->mesh, a->edge_halfedges[k] / 3, p));
    }
    return least;
}

/* ---- the plane ----------------------------------------------------------------------------- */

/* Mean distance of mirror images from the surface, INFINITY where too many are far. */
static double misfit(const ktg_sheet *sheet, const ktg_mirror *mirror) {
    uint32_t count = sheet->mesh->face_count, step = count / sample_count + 1, tried = 0, far = 0;
    double sum = 0;
    for (uint32_t f = 0; f < count; f += step) {
        ktg_vec3 image = reflect(mirror, ktg_face_centre(sheet->mesh, f));
        double distance = distance_from_surface(sheet, image);
        sum += distance;
        far += distance > most_far;
        tried++;
    }
    return far > few * tried || sum > most_mean * tried ? INFINITY : sum / tried;
}

static ktg_vec3 box_middle(const ktg_mesh *mesh) {
    ktg_vec3 low = mesh->positions[0], high = low;
    for (uint32_t v = 1; v < mesh->vertex_count; v++) {
        ktg_vec3 p = mesh->positions[v];
        low = (ktg_vec3){ktg_min(low.x, p.x), ktg_min(low.y, p.y), ktg_min(low.z, p.z)};
        high = (ktg_vec3){ktg_max(high.x, p.x), ktg_max(high.y, p.y), ktg_max(high.z, p.z)};
    }
    return ktg_mul3(ktg_add3(low, high), 0.5);
}

static void choose(const ktg_sheet *sheet, const ktg_vec3 *normals, int normal_count,
                   const ktg_vec3 *points, int point_count, ktg_mirror *best) {
    double least = INFINITY;
    for (int n = 0; n < normal_count; n++)
        for (int p = 0; p < point_count; p++) {
            ktg_mirror mirror = {true, normals[n], ktg_dot3(normals[n], points[p])};
            double its = misfit(sheet, &mirror);
            if (its < least * clearly_better - 1e-9 || (least == INFINITY && its < INFINITY)) {
                least = its;
                *best = mirror;
            }
        }
}

/* Left and right first, then front and back, then the surface's own axes. */
ktg_status ktg_mirror_find(ktg_context *context, const ktg_sheet *sheet, ktg_mirror *mirror) {
    const ktg_mesh *mesh = sheet->mesh;
    ktg_vec3 normals[6] = {{1, 0, 0}, {0, 0, 1}}, points[2];
    ktg_vec3 *centres = ktg_new(context, mesh->face_count, ktg_vec3);
    *mirror = (ktg_mirror){0};
    if (!centres)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        centres[f] = ktg_face_centre(mesh, f);
    ktg_axes_of_vectors(mesh, centres, &points[1], normals + 2);
    points[0] = box_middle(mesh);
    normals[5] = (ktg_vec3){0, 1, 0};
    choose(sheet, normals, 6, points, 2, mirror);
    ktg_free(centres);
    return KTG_OK;
}

/* Between the faces of either side, and then as straight as edges allow. */
static ktg_status cut_straight(ktg_context *context, const ktg_sheet *sheet,
                               const ktg_mirror *mirror, bool *side, double *cost, bool *plane) {
    for (uint32_t f = 0; f < sheet->mesh->face_count; f++)
        side[f] = ktg_mirror_side(mirror, ktg_face_centre(sheet->mesh, f)) > 0;
    KTG_TRY(ktg_label_clean(context, sheet, side));
    ktg_label_edges(sheet, side, plane);
    ktg_plane_cost(sheet, mirror->normal, mirror->offset, cost);
    return ktg_seams_smooth(context, sheet, cost, NULL, plane);
}

ktg_status ktg_mirror_cut(ktg_context *context, const ktg_sheet *sheet, const ktg_mirror *mirror,
                          bool *plane) {
    bool *side = ktg_new(context, sheet->mesh->face_count, bool);
    double *cost = ktg_new(context, sheet->edge_count, double);
    ktg_status status = KTG_MEMORY;
    if (side && cost)
        status = cut_straight(context, sheet, mirror, side, cost, plane);
    ktg_free(side);
    ktg_free(cost);
    return status;
}

/* ---- seams --------------------------------------------------------------------------------- */

typedef struct copying {
    const ktg_sheet *sheet;
    const ktg_mirror *mirror;
    const bool *plane; /* edges along the plane */
    bool *cut;
    ktg_chains chains;
    /* vertex_count each */
    bool *on_plane, *border, *inner; /* border, inner: those of the far side */
    uint32_t *image;                 /* of a vertex, or KTG_NONE: not asked for yet */
    bool *from, *to, *forbidden;
    uint32_t *path;
    double *away; /* from the mirrored seam */
    double *cost; /* edge_count */
} copying;

static void copying_free(copying *c) {
    ktg_chains_free(&c->chains);
    ktg_free(c->on_plane);
    ktg_free(c->border);
    ktg_free(c->inner);
    ktg_free(c->image);
    ktg_free(c->from);
    ktg_free(c->to);
    ktg_free(c->forbidden);
    ktg_free(c->path);
    ktg_free(c->away);
    ktg_free(c->cost);
}

static void set_kinds(copying *c) {
    const ktg_sheet *s = c->sheet;
    for (uint32_t e = 0; e < s->edge_count; e++)
        if (c->plane[e])
            c->on_plane[s->ends[2 * (size_t)e]] = c->on_plane[s->ends[2 * (size_t)e + 1]] = true;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        bool far = !c->on_plane[v] && ktg_mirror_side(c->mirror, s->mesh->positions[v]) < 0;
        c->border[v] = far && s->border[v];
        c->inner[v] = far && !s->border[v];
        c->image[v] = c->on_plane[v] ? v : KTG_NONE;
    }
}

static ktg_status copying_new(ktg_context *context, copying *c) {
    const uint32_t count = c->sheet->mesh->vertex_count;
    c->on_plane = ktg_new(context, count, bool);
    c->border = ktg_new(context, count, bool);
    c->inner = ktg_new(context, count, bool);
    c->image = ktg_new(context, count, uint32_t);
    c->from = ktg_new(context, count, bool);
    c->to = ktg_new(context, count, bool);
    c->forbidden = ktg_new(context, count, bool);
    c->path = ktg_new(context, count, uint32_t);
    c->away = ktg_new(context, count, double);
    c->cost = ktg_new(context, c->sheet->edge_count, double);
    if (!c->on_plane || !c->border || !c->inner || !c->image || !c->from || !c->to ||
        !c->forbidden || !c->path || !c->away || !c->cost)
        return KTG_MEMORY;
    set_kinds(c);
    return ktg_chains_find(context, c->sheet, c->cut, c->plane, &c->chains);
}

static uint32_t image_of(copying *c, uint32_t v) {
    const ktg_mesh *mesh = c->sheet->mesh;
    if (c->image[v] == KTG_NONE)
        c->image[v] = nearest_vertex(mesh, reflect(c->mirror, mesh->positions[v]),
                                     c->sheet->border[v] ? c->border : c->inner);
    return c->image[v];
}

/* Edges cost more the further they lie from the mirror image of the run. */
static void set_cost(copying *c, const ktg_chain *chain) {
    const ktg_sheet *s = c->sheet;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        c->away[v] = INFINITY;
    for (uint32_t i = 0; i < chain->count; i++) {
        const uint32_t *ends = s->ends + 2 * (size_t)c->chains.edges[chain->first + i];
        ktg_vec3 a = reflect(c->mirror, s->mesh->positions[ends[0]]);
        ktg_vec3 b = reflect(c->mirror, s->mesh->positions[ends[1]]);
        for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
            c->away[v] = ktg_min(c->away[v], distance_from_segment(s->mesh->positions[v], a, b));
    }
    for (uint32_t e = 0; e < s->edge_count; e++) {
        double away = (c->away[s->ends[2 * (size_t)e]] + c->away[s->ends[2 * (size_t)e + 1]]) / 2;
        double edges = away / s->mean_edge;
        c->cost[e] = s->length[e] * (1 + 4 * edges * edges);
    }
}

/* Not on the near side, the plane or the border, nor where there is a seam already. */
static void set_forbidden(copying *c) {
    const ktg_sheet *s = c->sheet;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        c->from[v] = c->to[v] = false;
        c->forbidden[v] = !c->inner[v];
    }
    for (uint32_t e = 0; e < s->edge_count; e++)
        if (c->cut[e])
            c->forbidden[s->ends[2 * (size_t)e]] = c->forbidden[s->ends[2 * (size_t)e + 1]] = true;
}

static bool is_near_side(const copying *c, const ktg_chain *chain) {
    double side = 0;
    for (uint32_t i = 0; i < chain->count; i++)
        for (int k = 0; k < 2; k++)
            side += ktg_mirror_side(
                c->mirror,
                c->sheet->mesh
                    ->positions[c->sheet->ends[2 * (size_t)c->chains.edges[chain->first + i] + k]]);
    return side > 0;
}

static ktg_status copy_chain(ktg_context *context, copying *c, const ktg_chain *chain) {
    uint32_t a = image_of(c, chain->ends[0]), b = image_of(c, chain->ends[1]), count;
    if (a == b || a == KTG_NONE || b == KTG_NONE)
        return KTG_OK;
    set_cost(c, chain);
    set_forbidden(c);
    c->from[a] = c->to[b] = true;
    ktg_path_query query = {.sheet = c->sheet,
                            .cost = c->cost,
                            .from = c->from,
                            .to = c->to,
                            .forbidden = c->forbidden,
                            .straight_on = KTG_NONE};
    KTG_TRY(ktg_path_find(context, &query, c->path, &count));
    for (uint32_t i = 0; i < count; i++)
        c->cut[c->path[i]] = true;
    return KTG_OK;
}

ktg_status ktg_mirror_seams(ktg_context *context, const ktg_sheet *sheet, const ktg_mirror *mirror,
                            const bool *plane, bool *cut) {
    copying c = {.sheet = sheet, .mirror = mirror, .plane = plane, .cut = cut};
    ktg_status status = copying_new(context, &c);
    for (uint32_t i = 0; status == KTG_OK && i < c.chains.count; i++)
        if (is_near_side(&c, &c.chains.chains[i]))
            status = copy_chain(context, &c, &c.chains.chains[i]);
    copying_free(&c);
    return status;
}

/* ---- partners ------------------------------------------------------------------------------ */

static ktg_vec3 middle_of(const ktg_sheet *s, const ktg_chains *chains, uint32_t i) {
    uint32_t e = chains->edges[chains->chains[i].first + chains->chains[i].count / 2];
    const ktg_vec3 *p = s->mesh->positions;
    return ktg_mul3(ktg_add3(p[s->ends[2 * (size_t)e]], p[s->ends[2 * (size_t)e + 1]]), 0.5);
}

uint32_t ktg_mirror_partner(const ktg_sheet *sheet, const ktg_mirror *mirror,
                            const ktg_chains *chains, uint32_t chain) {
    uint32_t partner = chain;
    double least = INFINITY, length = chains->chains[chain].length;
    ktg_vec3 image = reflect(mirror, middle_of(sheet, chains, chain));
    for (uint32_t i = 0; i < chains->count; i++) {
        double ratio = chains->chains[i].length / length;
        double away = ktg_length3(ktg_sub3(middle_of(sheet, chains, i), image));
        if (ratio > 0.8 && ratio < 1.25 && away < least) {
            least = away;
            partner = i;
        }
    }
    return least < ktg_max(0.15 * length, 2 * sheet->mean_edge) ? partner : chain;
}
