/* tests/mesh/shapes.h - small meshes made by formula, and what any repaired mesh has to be. */
#ifndef TESTS_MESH_SHAPES_H
#define TESTS_MESH_SHAPES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/vec.h"
#include "mesh/mesh.h"

#define OK(call) assert_int_equal(call, KTG_OK)

static inline ktg_context *context_of(void **state) {
    return *state;
}

static inline int start(void **state) {
    ktg_context *context = NULL;
    ktg_status status = ktg_context_new(&context);
    *state = context;
    return status == KTG_OK ? 0 : 1;
}

static inline int stop(void **state) {
    ktg_context *context = *state;
    ktg_context_free(&context);
    return 0;
}

static inline ktg_mesh *make(void **state, const double *positions, uint32_t vertices,
                             const uint32_t *faces, uint32_t face_count) {
    ktg_mesh *mesh = NULL;
    OK(ktg_mesh_new(context_of(state), positions, vertices, faces, face_count, &mesh));
    return mesh;
}

/* make(state, POINTS(points), FACES(faces)) for plain arrays */
#define POINTS(array) (array), sizeof(array) / sizeof *(array) / 3
#define FACES(array)  (array), sizeof(array) / sizeof *(array) / 3

/* A mesh under construction. */
typedef struct builder {
    double positions[3 * 20000];
    uint32_t faces[3 * 40000];
    uint32_t vertex_count, face_count;
} builder;

static inline builder *build(void) {
    builder *b = calloc(1, sizeof *b);
    assert_non_null(b);
    return b;
}

static inline ktg_mesh *finish(void **state, builder *b) {
    ktg_mesh *mesh = make(state, b->positions, b->vertex_count, b->faces, b->face_count);
    free(b);
    return mesh;
}

static inline uint32_t add_point(builder *b, double x, double y, double z) {
    double *p = b->positions + 3 * (size_t)b->vertex_count;
    p[0] = x, p[1] = y, p[2] = z;
    return b->vertex_count++;
}

static inline void add_face(builder *b, uint32_t i, uint32_t j, uint32_t k) {
    uint32_t *f = b->faces + 3 * (size_t)b->face_count++;
    f[0] = i, f[1] = j, f[2] = k;
}

static inline void add_quad(builder *b, uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
    add_face(b, i, j, k);
    add_face(b, i, k, l);
}

/* A cube of side `size` from (x, y, z), with vertices and 12 faces of its own, outwards. */
static inline void add_cube(builder *b, double x, double y, double z, double size) {
    uint32_t v[8];
    for (int i = 0; i < 8; i++)
        v[i] = add_point(b, x + size * (i & 1), y + size * (i >> 1 & 1), z + size * (i >> 2));
    add_quad(b, v[0], v[2], v[3], v[1]);
    add_quad(b, v[4], v[5], v[7], v[6]);
    add_quad(b, v[0], v[1], v[5], v[4]);
    add_quad(b, v[2], v[6], v[7], v[3]);
    add_quad(b, v[0], v[4], v[6], v[2]);
    add_quad(b, v[1], v[3], v[7], v[5]);
}

/* Vertices at equal positions become one. */
static inline void weld_builder(builder *b) {
    for (uint32_t h = 0; h < 3 * b->face_count; h++)
        for (uint32_t v = 0; v < b->faces[h]; v++)
            if (memcmp(b->positions + 3 * (size_t)v, b->positions + 3 * (size_t)b->faces[h],
                       3 * sizeof(double)) == 0) {
                b->faces[h] = v;
                break;
            }
}

/* A flat square of n x n quadrangles, each 1 x 1. */
static inline void add_plate(builder *b, uint32_t n) {
    uint32_t first = b->vertex_count;
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t j = 0; j <= n; j++)
            add_point(b, j, i, 0);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t at = first + (n + 1) * i + j;
            add_quad(b, at, at + 1, at + n + 2, at + n + 1);
        }
}

/* A sphere of `rings` x `around` quadrangles and two fans, whose radius waves by `bumps`. */
static inline void add_sphere(builder *b, double x, double y, double z, double radius, double bumps,
                              uint32_t rings, uint32_t around) {
    uint32_t south = add_point(b, x, y, z - radius), first = b->vertex_count;
    for (uint32_t i = 1; i < rings; i++)
        for (uint32_t j = 0; j < around; j++) {
            double t = KTG_PI * i / rings, p = 2 * KTG_PI * j / around;
            double r = radius * (1 + bumps * sin(5 * t) * sin(4 * p));
            add_point(b, x + r * sin(t) * cos(p), y + r * sin(t) * sin(p), z - r * cos(t));
        }
    uint32_t north = add_point(b, x, y, z + radius), last = first + (rings - 2) * around;
    for (uint32_t j = 0; j < around; j++) {
        uint32_t k = (j + 1) % around;
        add_face(b, south, first + k, first + j);
        for (uint32_t i = 0; i + 2 < rings; i++)
            add_quad(b, first + i * around + j, first + i * around + k,
                     first + (i + 1) * around + k, first + (i + 1) * around + j);
        add_face(b, north, last + j, last + k);
    }
}

static inline void add_torus(builder *b, double R, double r, uint32_t m, uint32_t n) {
    uint32_t first = b->vertex_count;
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++) {
            double p = 2 * KTG_PI * i / m, t = 2 * KTG_PI * j / n;
            add_point(b, (R + r * cos(t)) * cos(p), (R + r * cos(t)) * sin(p), r * sin(t));
        }
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t k = (i + 1) % m, l = (j + 1) % n;
            add_quad(b, first + i * n + j, first + k * n + j, first + k * n + l, first + i * n + l);
        }
}

/* A tube of radius 1 along z, open at both ends. */
static inline void add_cylinder(builder *b, double height, uint32_t rings, uint32_t around) {
    uint32_t first = b->vertex_count;
    for (uint32_t i = 0; i <= rings; i++)
        for (uint32_t j = 0; j < around; j++)
            add_point(b, cos(2 * KTG_PI * j / around), sin(2 * KTG_PI * j / around),
                      height * i / rings);
    for (uint32_t i = 0; i < rings; i++)
        for (uint32_t j = 0; j < around; j++) {
            uint32_t k = (j + 1) % around, at = first + i * around, up = at + around;
            add_quad(b, at + j, at + k, up + k, up + j);
        }
}

/* A strip of `length` quadrangles with `twists` half turns, its ends joined. */
static inline void add_band(builder *b, uint32_t length, int twists) {
    for (uint32_t i = 0; i < length; i++) {
        double p = 2 * KTG_PI * i / length, t = twists * p / 2;
        for (int side = -1; side <= 1; side += 2) {
            double r = 3 + side * cos(t);
            add_point(b, r * cos(p), r * sin(p), side * sin(t));
        }
    }
    for (uint32_t i = 0; i < length; i++) {
        uint32_t k = 2 * (i + 1), a = k, c = k + 1;
        if (i + 1 == length) {
            a = twists % 2 ? 1 : 0;
            c = twists % 2 ? 0 : 1;
        }
        add_quad(b, 2 * i, 2 * i + 1, c, a);
    }
}

/* Whether the corners of vertex `v` are one fan: from any of them all are reached across twins. */
static inline bool has_one_fan(const ktg_mesh *mesh, const ktg_adjacency *a, uint32_t v,
                               uint32_t corner) {
    uint32_t reached = 1, corners = 0, h = corner;
    for (uint32_t i = 0; i < a->halfedge_count; i++)
        corners += mesh->faces[i] == v;
    for (;;) { /* out along h, back along the twin of the one before */
        uint32_t twin = a->twin[h % 3 == 0 ? h + 2 : h - 1];
        if (twin == KTG_NONE || twin == corner)
            break;
        h = twin;
        reached++;
    }
    bool round = a->twin[h % 3 == 0 ? h + 2 : h - 1] == corner;
    for (h = corner; !round && a->twin[h] != KTG_NONE;) {
        h = a->twin[h] % 3 == 2 ? a->twin[h] - 2 : a->twin[h] + 1;
        reached++;
    }
    return reached == corners;
}

/* What a repair promises, told by the adjacency alone. */
static inline void assert_oriented_manifold(void **state, const ktg_mesh *mesh) {
    ktg_adjacency *a;
    OK(ktg_adjacency_new(context_of(state), mesh, &a));
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t count = a->edge_first[e + 1] - a->edge_first[e];
        assert_in_range(count, 1, 2);
        if (count == 2)
            assert_int_not_equal(a->twin[a->edge_halfedges[a->edge_first[e]]], KTG_NONE);
    }
    uint32_t *corner = malloc(mesh->vertex_count * sizeof *corner);
    memset(corner, 0xff, mesh->vertex_count * sizeof *corner);
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        corner[mesh->faces[h]] = h;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        assert_int_not_equal(corner[v], KTG_NONE);
        assert_true(has_one_fan(mesh, a, v, corner[v]));
    }
    free(corner);
    ktg_adjacency_free(&a);
}

static inline ktg_mesh_report report_of(void **state, const ktg_mesh *mesh) {
    ktg_mesh_report report;
    OK(ktg_mesh_check(context_of(state), mesh, true, &report));
    return report;
}

#endif
