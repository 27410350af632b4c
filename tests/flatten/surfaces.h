/* tests/flatten/surfaces.h - generated surfaces that want seams, and their seams. */
#ifndef KTG_TESTS_FLATTEN_SURFACES_H
#define KTG_TESTS_FLATTEN_SURFACES_H

#include "flatten/cut.h"
#include "flatten/kernel.h"
#include "flatten/seams.h"
#include "tests/flatten/panels.h"

/* A surface with its seams. */
typedef struct garment {
    ktg_mesh *mesh;
    ktg_adjacency *adjacency;
    bool *cut;
} garment;

/* Takes the mesh and stitches it where its vertices coincide. */
static inline garment garment_new(ktg_context *context, ktg_mesh *mesh) {
    garment g = {.mesh = mesh};
    ktg_repair_report report;
    assert_int_equal(ktg_mesh_repair(context, mesh, &report), KTG_OK);
    assert_int_equal(ktg_adjacency_new(context, mesh, &g.adjacency), KTG_OK);
    g.cut = calloc(g.adjacency->edge_count, sizeof *g.cut);
    assert_non_null(g.cut);
    return g;
}

static inline void garment_drop(garment *g) {
    ktg_mesh_free(&g->mesh);
    ktg_adjacency_free(&g->adjacency);
    free(g->cut);
}

/* A point of a surface; i and j run from 0 to n: whole numbers, so that sides that meet do so
 * exactly. */
typedef ktg_vec3 lattice(uint32_t i, uint32_t j, uint32_t n);

/* n x n squares. */
static inline void add_lattice(lattice *point, uint32_t n, ktg_vec3 *positions, uint32_t *faces,
                               uint32_t *vertex_count, uint32_t *face_count) {
    uint32_t first = *vertex_count, row = n + 1;
    for (uint32_t j = 0; j < row; j++)
        for (uint32_t i = 0; i < row; i++)
            positions[(*vertex_count)++] = point(i, j, n);
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = first + i + row * j, b = a + 1, c = b + row, d = a + row;
            uint32_t one[6] = {a, b, c, a, c, d}, other[6] = {a, b, d, b, c, d};
            for (int k = 0; k < 6; k++)
                faces[3 * *face_count + k] = (i + j) % 2 ? one[k] : other[k];
            *face_count += 2;
        }
}

/* One or more lattices as one surface. */
static inline garment lattices(ktg_context *context, lattice *const *points, uint32_t count,
                               uint32_t n) {
    size_t vertices = (size_t)count * (n + 1) * (n + 1);
    ktg_vec3 *positions = ktg_new(context, vertices, ktg_vec3);
    uint32_t *faces = ktg_new(context, (size_t)count * 6 * n * n, uint32_t);
    uint32_t vertex_count = 0, face_count = 0;
    for (uint32_t k = 0; k < count; k++)
        add_lattice(points[k], n, positions, faces, &vertex_count, &face_count);
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(context, &positions[0].x, vertex_count, faces, face_count, &mesh),
                     KTG_OK);
    ktg_free(positions);
    ktg_free(faces);
    return garment_new(context, mesh);
}

/* ---- shapes ------------------------------------------------------------------------------- */

/* The six sides of the cube from -1 to 1. */
static inline double side_of(uint32_t i, uint32_t n) {
    return (2 * (double)i - n) / n;
}
static inline ktg_vec3 cube_top(uint32_t i, uint32_t j, uint32_t n) {
    return (ktg_vec3){side_of(i, n), side_of(j, n), 1};
}
static inline ktg_vec3 cube_bottom(uint32_t i, uint32_t j, uint32_t n) {
    return (ktg_vec3){side_of(j, n), side_of(i, n), -1};
}
static inline ktg_vec3 cube_right(uint32_t i, uint32_t j, uint32_t n) {
    return (ktg_vec3){1, side_of(i, n), side_of(j, n)};
}
static inline ktg_vec3 cube_left(uint32_t i, uint32_t j, uint32_t n) {
    return (ktg_vec3){-1, side_of(j, n), side_of(i, n)};
}
static inline ktg_vec3 cube_back(uint32_t i, uint32_t j, uint32_t n) {
    return (ktg_vec3){side_of(j, n), 1, side_of(i, n)};
}
static inline ktg_vec3 cube_front(uint32_t i, uint32_t j, uint32_t n) {
    return (ktg_vec3){side_of(i, n), -1, side_of(j, n)};
}

static inline garment cube(ktg_context *context, uint32_t n) {
    lattice *const sides[] = {cube_top, cube_bottom, cube_right, cube_left, cube_back, cube_front};
    return lattices(context, sides, 6, n);
}

static inline garment sphere(ktg_context *context, uint32_t n) {
    garment g = cube(context, n);
    for (uint32_t v = 0; v < g.mesh->vertex_count; v++)
        g.mesh->positions[v] = ktg_unit3(g.mesh->positions[v]);
    return g;
}

/* Once around: exactly back at the start. */
static inline ktg_vec2 around(uint32_t i, uint32_t n) {
    double angle = 2 * KTG_PI * (i % n) / n;
    return (ktg_vec2){cos(angle), sin(angle)};
}

static inline ktg_vec3 tube(uint32_t i, uint32_t j, uint32_t n) {
    ktg_vec2 a = around(i, n);
    return (ktg_vec3){a.y, 4 * (double)j / n, a.x};
}

static inline ktg_vec3 ring(uint32_t i, uint32_t j, uint32_t n) {
    ktg_vec2 a = around(i, n), b = around(j, n);
    return (ktg_vec3){(3 + b.x) * a.y, b.y, (3 + b.x) * a.x};
}

/* A square with a round bump of this height in the middle of its left half, or of both. */
static inline ktg_vec3 bumps(double u, double v, int count, double height) {
    double x = 4 * u - 2, y = 2 * v - 1, z = 0;
    for (int k = 0; k < count; k++) {
        double d = x - (k == 0 ? -1 : 1);
        z += height * exp(-6 * (d * d + y * y));
    }
    return (ktg_vec3){x, y, z};
}
static inline ktg_vec3 one_bump(double u, double v) {
    return bumps(u, v, 1, 0.6);
}
static inline ktg_vec3 two_bumps(double u, double v) {
    return bumps(u, v, 2, 0.8);
}

/* ---- what came of it ---------------------------------------------------------------------- */

/* Every panel is a disk, laid flat without fold or overlap; the largest part of the area of one
 * that is beyond 5 %. */
static inline double worst_of_panels(ktg_context *context, const garment *g, uint32_t *count) {
    ktg_cut_surface parts;
    double worst = 0;
    assert_int_equal(ktg_cut_apart(context, g->mesh, g->adjacency, g->cut, &parts), KTG_OK);
    *count = parts.count;
    for (uint32_t p = 0; p < parts.count; p++) {
        ktg_flatten_report report;
        ktg_pattern *pattern;
        ktg_status status =
            ktg_flatten(context, parts.panels[p].mesh, "panel", NULL, &pattern, &report);
        assert_int_equal(status, KTG_OK);
        worst = fmax(worst, report.whole.area_beyond_limit);
        ktg_flatten_report_free(&report);
        ktg_pattern_free(&pattern);
    }
    ktg_cut_surface_free(&parts);
    return worst;
}

static inline ktg_vec3 edge_vertex(const garment *g, uint32_t edge, int end) {
    uint32_t h = g->adjacency->edge_halfedges[g->adjacency->edge_first[edge]];
    return g->mesh->positions[g->mesh->faces[end ? ktg_halfedge_next(h) : h]];
}

static inline ktg_vec3 edge_middle(const garment *g, uint32_t edge) {
    return ktg_mul3(ktg_add3(edge_vertex(g, edge, 0), edge_vertex(g, edge, 1)), 0.5);
}

static inline double seam_length(const garment *g) {
    double length = 0;
    for (uint32_t e = 0; e < g->adjacency->edge_count; e++)
        if (g->cut[e])
            length += ktg_length3(ktg_sub3(edge_vertex(g, e, 1), edge_vertex(g, e, 0)));
    return length;
}

#endif
