/* mesh/simplify_seams.c - where the seams of a texture are, and which vertices are bound to them.
 */
#include "core/memory.h"
#include "core/sets.h"
#include "core/vec.h"
#include "mesh/repair.h"
#include "mesh/simplify.h"

#include <string.h>

static uint32_t corner_at(const uint32_t *faces, uint32_t f, uint32_t vertex) {
    const uint32_t *corner = faces + 3 * (size_t)f;
    return 3 * f + (corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2);
}

static bool same_uv(const ktg_simplify *s, uint32_t f, uint32_t g, uint32_t vertex) {
    ktg_vec2 p = s->uv.corners[corner_at(s->faces, f, vertex)];
    ktg_vec2 q = s->uv.corners[corner_at(s->faces, g, vertex)];
    return (p.x == q.x && p.y == q.y) || (ktg_uv_is_none(p) && ktg_uv_is_none(q));
}

/* Whether the faces may be of one chart at all. */
static bool alike(const ktg_simplify *s, uint32_t f, uint32_t g) {
    const uint32_t *material = s->uv.mesh->face_material;
    return (!material || material[f] == material[g]) && s->uv.turn[f] * s->uv.turn[g] >= 0;
}

bool ktg_uv_joined(const ktg_simplify *s, uint32_t f, uint32_t g, uint32_t a, uint32_t b) {
    return !s->uv.spare[f] && !s->uv.spare[g] && alike(s, f, g) && same_uv(s, f, g, a) &&
           same_uv(s, f, g, b);
}

bool ktg_uv_seam(const ktg_simplify *s, uint32_t f, uint32_t g, uint32_t a, uint32_t b) {
    return !s->uv.spare[f] && !s->uv.spare[g] && !ktg_uv_joined(s, f, g, a, b);
}

/* Where seams meet in more points than this part of the faces that are wished for, half of the
 * vertices, they are not kept: little else would be left of the surface. */
enum { junction_share = 4 };

/* A chart of less than this part of what a face will have in the mean is spare: as a face of its
 * own it would be too small to be cut out. */
static const double least_chart = 0.25;

/* ---- bonds ---------------------------------------------------------------------------------- */

typedef struct seam_count {
    uint32_t seams;  /* edges at this vertex */
    uint32_t closed; /* of these, such that the texture is one at the other end again */
} seam_count;

/* A vertex that each face of a fan sees in another place of the texture, as the pole of a globe:
 * its edges are seams only there. */
static bool is_pole(const seam_count *count) {
    return count->closed >= 3;
}

static void count_seams(const ktg_simplify *s, const ktg_adjacency *adjacency, bool closed_pass,
                        seam_count *counts) {
    for (uint32_t h = 0; h < adjacency->halfedge_count; h++) {
        uint32_t t = adjacency->twin[h], a = s->faces[h], b = s->faces[ktg_halfedge_next(h)];
        if (t == KTG_NONE || t < h || !ktg_uv_seam(s, h / 3, t / 3, a, b))
            continue;
        bool whole = !alike(s, h / 3, t / 3);
        bool at_a = whole || !same_uv(s, h / 3, t / 3, a);
        bool at_b = whole || !same_uv(s, h / 3, t / 3, b);
        if (closed_pass) {
            counts[a].closed += at_a && !at_b;
            counts[b].closed += at_b && !at_a;
        } else {
            counts[a].seams += at_a || !is_pole(&counts[b]);
            counts[b].seams += at_b || !is_pole(&counts[a]);
        }
    }
}

static void bind(ktg_simplify *s, const seam_count *counts, uint32_t target_faces) {
    uint32_t junctions = 0;
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        const seam_count *count = &counts[v];
        bool junction = count->seams > 0 && (count->seams != 2 || s->border[v] || is_pole(count));
        s->uv.bonds[v] = junction            ? KTG_SEAM_JUNCTION
                         : count->seams == 2 ? KTG_ON_SEAM
                                             : KTG_OFF_SEAM;
        junctions += junction;
    }
    s->uv.kept = junctions <= target_faces / junction_share;
}

static void join_charts(ktg_simplify *s, const ktg_adjacency *adjacency) {
    for (uint32_t f = 0; f < s->face_count; f++)
        s->uv.chart[f] = f;
    for (uint32_t h = 0; h < adjacency->halfedge_count; h++) {
        uint32_t t = adjacency->twin[h], a = s->faces[h], b = s->faces[ktg_halfedge_next(h)];
        if (t != KTG_NONE && t > h && ktg_uv_joined(s, h / 3, t / 3, a, b))
            ktg_set_join(s->uv.chart, h / 3, t / 3);
    }
    for (uint32_t f = 0; f < s->face_count; f++)
        s->uv.chart[f] = ktg_set_of(s->uv.chart, f);
}

/* ---- spare charts --------------------------------------------------------------------------- */

static double area_of(const ktg_simplify *s, uint32_t f) {
    const uint32_t *c = s->faces + 3 * (size_t)f;
    ktg_vec3 p = s->positions[c[0]];
    ktg_vec3 u = ktg_mul3(ktg_sub3(s->positions[c[1]], p), s->scale);
    ktg_vec3 v = ktg_mul3(ktg_sub3(s->positions[c[2]], p), s->scale);
    return ktg_length3(ktg_cross3(u, v));
}

static void find_spare(ktg_simplify *s, uint32_t target_faces, double *areas) {
    double whole = 0;
    for (uint32_t f = 0; f < s->face_count; f++) {
        areas[s->uv.chart[f]] += area_of(s, f);
        whole += area_of(s, f);
    }
    for (size_t f = 0; f < s->face_count; f++) {
        s->uv.spare[f] = !ktg_uv_is_none(s->uv.corners[3 * f]) &&
                         areas[s->uv.chart[f]] * target_faces < least_chart * whole;
        for (size_t k = 0; k < 3 && s->uv.spare[f]; k++)
            s->uv.corners[3 * f + k] = (ktg_vec2){NAN, NAN};
    }
}

/* ---- taking --------------------------------------------------------------------------------- */

static void copy_corners(ktg_simplify *s, const ktg_mesh *mesh) {
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *uv = mesh->face_uv + 3 * f;
        bool none = uv[0] == KTG_NONE || uv[1] == KTG_NONE || uv[2] == KTG_NONE;
        ktg_vec2 *corner = s->uv.corners + 3 * f;
        for (size_t k = 0; k < 3; k++)
            corner[k] = none ? (ktg_vec2){NAN, NAN} : mesh->uvs[uv[k]];
        double area = ktg_cross2(ktg_sub2(corner[1], corner[0]), ktg_sub2(corner[2], corner[0]));
        s->uv.turn[f] = (int8_t)((area > 0) - (area < 0));
    }
}

ktg_status ktg_simplify_take_uvs(ktg_simplify *s, const ktg_mesh *mesh,
                                 const ktg_adjacency *adjacency, uint32_t target_faces) {
    if (!mesh->face_uv)
        return KTG_OK;
    seam_count *counts = ktg_new(s->context, mesh->vertex_count, seam_count);
    double *areas = ktg_new(s->context, mesh->face_count, double);
    s->uv.mesh = mesh;
    s->uv.corners = ktg_new(s->context, 3 * (size_t)mesh->face_count, ktg_vec2);
    s->uv.turn = ktg_new(s->context, mesh->face_count, int8_t);
    s->uv.spare = ktg_new(s->context, mesh->face_count, bool);
    s->uv.bonds = ktg_new(s->context, mesh->vertex_count, uint8_t);
    s->uv.chart = ktg_new(s->context, mesh->face_count, uint32_t);
    bool ready =
        counts && areas && s->uv.corners && s->uv.turn && s->uv.spare && s->uv.bonds && s->uv.chart;
    if (ready) {
        copy_corners(s, mesh);
        join_charts(s, adjacency);
        find_spare(s, target_faces, areas);
        count_seams(s, adjacency, true, counts);
        count_seams(s, adjacency, false, counts);
        bind(s, counts, target_faces);
    }
    ktg_free(counts);
    ktg_free(areas);
    return ready ? KTG_OK : KTG_MEMORY;
}

void ktg_simplify_free_uvs(ktg_simplify *s) {
    ktg_free(s->uv.corners);
    ktg_free(s->uv.turn);
    ktg_free(s->uv.spare);
    ktg_free(s->uv.bonds);
    ktg_free(s->uv.chart);
    ktg_free(s->uv.parts);
    ktg_free(s->uv.moved);
    ktg_free(s->uv.stack);
}
