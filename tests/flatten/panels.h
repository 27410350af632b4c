/* tests/flatten/panels.h - generated panels for the tests. */
#ifndef KTG_TESTS_FLATTEN_PANELS_H
#define KTG_TESTS_FLATTEN_PANELS_H

#include "core/memory.h"
#include "core/vec.h"
#include "flatten/flatten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static inline int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static inline int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

/* A point of a surface; u and v run from 0 to 1. */
typedef ktg_vec3 surface(double u, double v);

/* A `side` x `side` grid of squares on a surface, each cut into two triangles, diagonals taking
 * turns; faces are counter-clockwise in (u, v). Vertex (i, j) is i + (side + 1) j. */
static inline ktg_mesh *grid_panel(ktg_context *context, surface *point, uint32_t side) {
    uint32_t row = side + 1, count = 0;
    ktg_vec3 *positions = ktg_new(context, (size_t)row * row, ktg_vec3);
    uint32_t *faces = ktg_new(context, (size_t)6 * side * side, uint32_t);
    for (uint32_t j = 0; j < row; j++)
        for (uint32_t i = 0; i < row; i++)
            positions[i + row * j] = point((double)i / side, (double)j / side);
    for (uint32_t j = 0; j < side; j++)
        for (uint32_t i = 0; i < side; i++) {
            uint32_t a = i + row * j, b = a + 1, c = b + row, d = a + row;
            uint32_t one[6] = {a, b, c, a, c, d}, other[6] = {a, b, d, b, c, d};
            for (int k = 0; k < 6; k++)
                faces[count++] = (i + j) % 2 ? one[k] : other[k];
        }
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(context, &positions[0].x, row * row, faces, count / 3, &mesh),
                     KTG_OK);
    ktg_free(positions);
    ktg_free(faces);
    return mesh;
}

static inline ktg_vec3 plane(double u, double v) {
    return (ktg_vec3){3 * u + 0.5 * v, 2 * v, 0};
}

/* Folded along lines u = k / 4 by 60 degrees up and down. */
static inline ktg_vec3 zigzag(double u, double v) {
    double within = fmod(4 * u, 2);
    return (ktg_vec3){2 * u, v, 0.8 * (within < 1 ? within : 2 - within)};
}

/* The right half lies on the left one. */
static inline ktg_vec3 folded_in_two(double u, double v) {
    return (ktg_vec3){fabs(2 * u - 1), v, 0};
}

static inline ktg_vec3 cylinder(double u, double v) {
    return (ktg_vec3){sin(4 * u), v, cos(4 * u)};
}

static inline ktg_vec3 cone(double u, double v) {
    double r = 0.2 + v;
    return (ktg_vec3){r * sin(3 * u), -2 * v, r * cos(3 * u)};
}

/* A square around the pole of the unit sphere, spread to `reach` radians all around. */
static inline ktg_vec3 cap(double u, double v, double reach) {
    double x = 2 * u - 1, y = 2 * v - 1, far = fmax(fabs(x), fabs(y)), length = hypot(x, y);
    double polar = reach * far, scale = length > 0 ? sin(polar) / length : 0;
    return (ktg_vec3){scale * x, scale * y, cos(polar)};
}

static inline ktg_vec3 shallow_cap(double u, double v) {
    return cap(u, v, 0.5);
}

static inline ktg_vec3 almost_sphere(double u, double v) {
    return cap(u, v, 3);
}

static inline ktg_vec3 hemisphere(double u, double v) {
    return cap(u, v, KTG_PI / 2);
}

static inline ktg_vec3 saddle(double u, double v) {
    double x = 2 * u - 1, y = 2 * v - 1;
    return (ktg_vec3){x, y, x * x - y * y};
}

/* So steep that it is laid on itself when every face is as rigid as possible. */
static inline ktg_vec3 monkey_saddle(double u, double v) {
    double x = 2 * u - 1, y = 2 * v - 1;
    return (ktg_vec3){x, y, 3 * (x * x * x - 3 * x * y * y)};
}

static inline ktg_vec3 ripples(double u, double v) {
    return (ktg_vec3){3 * u, 2 * v, 0.15 * sin(9 * u) * sin(7 * v)};
}

/* Four thin spikes, one of them bent, out of a square. */
static inline ktg_vec3 spikes(double u, double v) {
    double x = 2 * u - 1, y = 2 * v - 1, z = 0;
    const double bumps[][4] = {
        {0, 0, 2, 0.12}, {0.5, 0.5, 1.5, 0.1}, {-0.5, 0.4, 3, 0.1}, {0.5, -0.5, 2.5, 0.15}};
    for (int k = 0; k < 4; k++)
        z += bumps[k][2] *
             exp(-((x - bumps[k][0]) * (x - bumps[k][0]) + (y - bumps[k][1]) * (y - bumps[k][1])) /
                 (2 * bumps[k][3] * bumps[k][3]));
    return (ktg_vec3){x + 0.2 * z * z, y, z};
}

/* Faces from 1e-10 to 1/10 of its size. */
static inline ktg_vec3 uneven(double u, double v) {
    return (ktg_vec3){pow(u, 6), pow(v, 6), 0.3 * sin(6 * u) * sin(5 * v)};
}

/* A tube of radius 1 and length 8, closed by a hemisphere. */
static inline ktg_vec3 sock(double u, double v) {
    double x = 2 * u - 1, y = 2 * v - 1, far = fmax(fabs(x), fabs(y)), length = hypot(x, y);
    double along = far * (8 + KTG_PI / 2), r = along < KTG_PI / 2 ? sin(along) : 1;
    double scale = length > 0 ? r / length : 0;
    double z = along < KTG_PI / 2 ? cos(along) : KTG_PI / 2 - along;
    return (ktg_vec3){scale * x, scale * y, z};
}

/* A flat ring that is slit open. */
static inline ktg_vec3 slit_ring(double u, double v) {
    double angle = 2 * KTG_PI * u, r = 2 - v;
    return (ktg_vec3){r * cos(angle), r * sin(angle), 0};
}

/* A ramp that winds more than once around. */
static inline ktg_vec3 ramp(double u, double v) {
    ktg_vec3 p = slit_ring(1.2 * u, v);
    p.z = 0.3 * u;
    return p;
}

/* A mesh from literals. */
static inline ktg_mesh *small_mesh(ktg_context *context, const ktg_vec3 *positions,
                                   uint32_t vertex_count, const uint32_t *faces,
                                   uint32_t face_count) {
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(context, &positions[0].x, vertex_count, faces, face_count, &mesh),
                     KTG_OK);
    return mesh;
}

/* Flattens with the defaults; the mesh is freed. */
static inline ktg_pattern *flat_panel(ktg_context *context, ktg_mesh *mesh,
                                      ktg_flatten_report *report) {
    ktg_pattern *pattern;
    ktg_status status = ktg_flatten(context, mesh, "panel", NULL, &pattern, report);
    assert_string_equal(ktg_context_message(context), "");
    assert_int_equal(status, KTG_OK);
    ktg_flatten_report_free(report);
    ktg_mesh_free(&mesh);
    return pattern;
}

#endif
