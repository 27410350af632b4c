/* tests/unfold/shapes.c - generated models for the tests. */
#include "tests/unfold/shapes.h"
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"

#include <stdlib.h>

int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

ktg_mesh *shape_mesh(ktg_context *context, const ktg_vec3 *positions, uint32_t vertex_count,
                     const uint32_t *faces, uint32_t face_count) {
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(context, &positions[0].x, vertex_count, faces, face_count, &mesh),
                     KTG_OK);
    return mesh;
}

ktg_mesh *shape_triangle(ktg_context *context) {
    static const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0.2}};
    static const uint32_t faces[] = {0, 1, 2};
    return shape_mesh(context, positions, 3, faces, 1);
}

ktg_mesh *shape_two_triangles(ktg_context *context) {
    static const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0}, {0.5, -0.6, -0.4}};
    static const uint32_t faces[] = {0, 1, 2, 1, 0, 3};
    return shape_mesh(context, positions, 4, faces, 2);
}

ktg_mesh *shape_tetrahedron(ktg_context *context) {
    static const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}, {0.5, 0.3, 0.7}};
    static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    return shape_mesh(context, positions, 4, faces, 4);
}

/* ---- the cube: grid points of its surface, each numbered once ---------------------------------
 */

static uint32_t cube_vertex(const int at[3], uint32_t side, uint32_t *numbers, ktg_vec3 *positions,
                            uint32_t *count) {
    uint32_t n = side + 1;
    uint32_t *number = &numbers[((uint32_t)at[0] * n + (uint32_t)at[1]) * n + (uint32_t)at[2]];
    if (*number == 0) {
        positions[*count] =
            (ktg_vec3){(double)at[0] / side, (double)at[1] / side, (double)at[2] / side};
        *number = ++*count;
    }
    return *number - 1;
}

ktg_mesh *shape_cube(ktg_context *context, uint32_t side) {
    uint32_t n = side + 1, vertex_count = 0, face_count = 0;
    uint32_t *numbers = ktg_new(context, (size_t)n * n * n, uint32_t);
    ktg_vec3 *positions = ktg_new(context, (size_t)n * n * n, ktg_vec3);
    uint32_t *faces = ktg_new(context, (size_t)36 * side * side, uint32_t);
    for (int k = 0; k < 6; k++) {
        int axis = k / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (uint32_t i = 0; i < side; i++)
            for (uint32_t j = 0; j < side; j++) {
                uint32_t corner[4];
                for (uint32_t c = 0; c < 4; c++) {
                    int at[3];
                    at[axis] = k % 2 ? (int)side : 0;
                    at[u] = (int)(i + (c == 1 || c == 2));
                    at[v] = (int)(j + (c == 2 || c == 3));
                    /* seen from outside u, v run counter-clockwise on the far side only */
                    corner[k % 2 ? c : 3 - c] =
                        cube_vertex(at, side, numbers, positions, &vertex_count);
                }
                static const int split[6] = {0, 1, 2, 0, 2, 3};
                for (int c = 0; c < 6; c++)
                    faces[6 * face_count + (uint32_t)c] = corner[split[c]];
                face_count++;
            }
    }
    ktg_mesh *mesh = shape_mesh(context, positions, vertex_count, faces, 2 * face_count);
    mesh->face_polygon = ktg_new(context, mesh->face_count, uint32_t);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        mesh->face_polygon[f] = f / 2;
    ktg_free(numbers);
    ktg_free(positions);
    ktg_free(faces);
    return mesh;
}

/* ---- spheres ----------------------------------------------------------------------------------
 */

static ktg_mesh *icosahedron(ktg_context *context) {
    const double t = 1.6180339887498949;
    const ktg_vec3 corners[12] = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                  {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                  {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
    static const uint32_t faces[60] = {0, 11, 5, 0, 5,  1,  0,  1,  7,  0,  7, 10, 0, 10, 11,
                                       1, 5,  9, 5, 11, 4,  11, 10, 2,  10, 7, 6,  7, 1,  8,
                                       3, 9,  4, 3, 4,  2,  3,  2,  6,  3,  6, 8,  3, 8,  9,
                                       4, 9,  5, 2, 4,  11, 6,  2,  10, 8,  6, 7,  9, 8,  1};
    ktg_vec3 positions[12];
    for (int v = 0; v < 12; v++)
        positions[v] = ktg_mul3(ktg_unit3(corners[v]), 0.5);
    return shape_mesh(context, positions, 12, faces, 20);
}

/* Every edge gets a vertex in its middle, on the sphere; every face becomes four. */
static ktg_mesh *subdivided(ktg_context *context, ktg_mesh *mesh) {
    ktg_adjacency *a;
    assert_int_equal(ktg_adjacency_new(context, mesh, &a), KTG_OK);
    uint32_t old = mesh->vertex_count;
    ktg_vec3 *positions = ktg_new(context, old + a->edge_count, ktg_vec3);
    uint32_t *faces = ktg_new(context, 12 * (size_t)mesh->face_count, uint32_t), count = 0;
    for (uint32_t v = 0; v < old; v++)
        positions[v] = mesh->positions[v];
    for (uint32_t h = 0; h < a->halfedge_count; h++) {
        uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
        ktg_vec3 p = mesh->positions[mesh->faces[h]], q = mesh->positions[mesh->faces[next]];
        positions[old + a->halfedge_edge[h]] = ktg_mul3(ktg_unit3(ktg_add3(p, q)), 0.5);
    }
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->faces + 3 * f, *e = a->halfedge_edge + 3 * f;
        uint32_t m[3] = {old + e[0], old + e[1], old + e[2]};
        uint32_t four[12] = {c[0], m[0], m[2], m[0], c[1], m[1],
                             m[2], m[1], c[2], m[0], m[1], m[2]};
        for (int k = 0; k < 12; k++)
            faces[count++] = four[k];
    }
    ktg_mesh *finer = shape_mesh(context, positions, old + a->edge_count, faces, count / 3);
    ktg_free(positions);
    ktg_free(faces);
    ktg_adjacency_free(&a);
    ktg_mesh_free(&mesh);
    return finer;
}

ktg_mesh *shape_icosphere(ktg_context *context, uint32_t level) {
    ktg_mesh *mesh = icosahedron(context);
    for (uint32_t i = 0; i < level; i++)
        mesh = subdivided(context, mesh);
    return mesh;
}

ktg_mesh *shape_bumpy_sphere(ktg_context *context) {
    ktg_mesh *mesh = shape_icosphere(context, 2);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        ktg_vec3 *p = &mesh->positions[v];
        *p = ktg_mul3(*p, 1 + 0.35 * sin(9 * p->x + 1) * sin(8 * p->y + 2) * sin(7 * p->z + 0.5));
    }
    return mesh;
}

ktg_mesh *shape_star(ktg_context *context, double height) {
    ktg_mesh *core = icosahedron(context);
    ktg_vec3 positions[32];
    uint32_t faces[180], count = 0;
    for (uint32_t v = 0; v < 12; v++)
        positions[v] = core->positions[v];
    for (uint32_t f = 0; f < 20; f++) {
        const uint32_t *c = core->faces + 3 * f;
        ktg_vec3 middle = ktg_add3(ktg_add3(positions[c[0]], positions[c[1]]), positions[c[2]]);
        positions[12 + f] = ktg_mul3(ktg_unit3(middle), 0.4 + height);
        for (int k = 0; k < 3; k++) {
            faces[count++] = c[k];
            faces[count++] = c[(k + 1) % 3];
            faces[count++] = 12 + f;
        }
    }
    ktg_mesh_free(&core);
    return shape_mesh(context, positions, 32, faces, 60);
}

/* ---- grids over (u, v) in [0, 1]^2, closed in a direction or not ------------------------------
 */

typedef ktg_vec3 surface(double u, double v);

static ktg_mesh *grid(ktg_context *context, surface *point, uint32_t nu, uint32_t nv, bool close_u,
                      bool close_v) {
    uint32_t rows = close_u ? nu : nu + 1, row = close_v ? nv : nv + 1, count = 0;
    ktg_vec3 *positions = ktg_new(context, (size_t)rows * row, ktg_vec3);
    uint32_t *faces = ktg_new(context, (size_t)6 * nu * nv, uint32_t);
    for (uint32_t i = 0; i < rows; i++)
        for (uint32_t j = 0; j < row; j++)
            positions[i * row + j] = point((double)i / nu, (double)j / nv);
    for (uint32_t i = 0; i < nu; i++)
        for (uint32_t j = 0; j < nv; j++) {
            uint32_t i1 = (i + 1) % rows, j1 = (j + 1) % row;
            uint32_t a = i * row + j, b = i1 * row + j, c = i1 * row + j1, d = i * row + j1;
            uint32_t one[6] = {a, b, c, a, c, d}, other[6] = {a, b, d, b, c, d};
            for (int k = 0; k < 6; k++)
                faces[count++] = (i + j) % 2 ? one[k] : other[k];
        }
    ktg_mesh *mesh = shape_mesh(context, positions, rows * row, faces, count / 3);
    ktg_free(positions);
    ktg_free(faces);
    return mesh;
}

static ktg_vec3 torus_point(double u, double v) {
    double a = 2 * KTG_PI * u, b = 2 * KTG_PI * v, r = 0.35 + 0.15 * cos(b);
    return (ktg_vec3){r * cos(a), r * sin(a), 0.15 * sin(b)};
}

static ktg_vec3 knot_at(double u) {
    double a = 2 * KTG_PI * u, r = 0.4 + 0.2 * cos(3 * a);
    return (ktg_vec3){r * cos(2 * a), r * sin(2 * a), 0.25 * sin(3 * a)};
}

static ktg_vec3 knot_point(double u, double v) {
    ktg_vec3 along = ktg_unit3(ktg_sub3(knot_at(u + 1e-5), knot_at(u - 1e-5)));
    ktg_vec3 side = ktg_unit3(ktg_cross3((ktg_vec3){0, 0, 1}, along));
    ktg_vec3 up = ktg_cross3(along, side);
    double b = 2 * KTG_PI * v;
    return ktg_madd3(ktg_madd3(knot_at(u), 0.08 * cos(b), side), 0.08 * sin(b), up);
}

static ktg_vec3 cylinder_point(double u, double v) {
    double a = 2 * KTG_PI * u;
    return (ktg_vec3){0.5 * cos(a), 0.5 * sin(a), v};
}

static ktg_vec3 saddle_point(double u, double v) {
    double x = 2 * u - 1, y = 2 * v - 1;
    return (ktg_vec3){x, y, x * x - y * y};
}

static ktg_vec3 flat_point(double u, double v) {
    return (ktg_vec3){u, v, 0};
}

ktg_mesh *shape_torus(ktg_context *context, uint32_t around, uint32_t across) {
    return grid(context, torus_point, around, across, true, true);
}

ktg_mesh *shape_knot(ktg_context *context, uint32_t around, uint32_t across) {
    return grid(context, knot_point, around, across, true, true);
}

ktg_mesh *shape_cylinder(ktg_context *context, uint32_t around, uint32_t along) {
    return grid(context, cylinder_point, around, along, true, false);
}

ktg_mesh *shape_saddle(ktg_context *context, uint32_t side) {
    return grid(context, saddle_point, side, side, false, false);
}

ktg_mesh *shape_flat(ktg_context *context, uint32_t side) {
    return grid(context, flat_point, side, side, false, false);
}

ktg_mesh *shape_needle(ktg_context *context, uint32_t corners, double thin) {
    ktg_vec3 positions[64] = {{0, 0, 1}, {0, 0, -1}};
    uint32_t faces[6 * 62], count = 0;
    assert_true(corners <= 62);
    for (uint32_t i = 0; i < corners; i++) {
        double a = 2 * KTG_PI * i / corners;
        uint32_t here = 2 + i, next = 2 + (i + 1) % corners;
        positions[here] = (ktg_vec3){thin * cos(a), thin * sin(a), 0.1 * cos(3 * a)};
        uint32_t two[6] = {here, next, 0, next, here, 1};
        for (int k = 0; k < 6; k++)
            faces[count++] = two[k];
    }
    return shape_mesh(context, positions, corners + 2, faces, count / 3);
}

/* ---- made from other shapes -------------------------------------------------------------------
 */

ktg_mesh *shape_beside(ktg_context *context, const ktg_mesh *a, const ktg_mesh *b, ktg_vec3 move) {
    uint32_t vertices = a->vertex_count + b->vertex_count, faces = a->face_count + b->face_count;
    ktg_vec3 *positions = ktg_new(context, vertices, ktg_vec3);
    uint32_t *corners = ktg_new(context, 3 * (size_t)faces, uint32_t);
    for (uint32_t v = 0; v < vertices; v++)
        positions[v] = v < a->vertex_count ? a->positions[v]
                                           : ktg_add3(b->positions[v - a->vertex_count], move);
    for (uint32_t c = 0; c < 3 * faces; c++)
        corners[c] =
            c < 3 * a->face_count ? a->faces[c] : b->faces[c - 3 * a->face_count] + a->vertex_count;
    ktg_mesh *mesh = shape_mesh(context, positions, vertices, corners, faces);
    ktg_free(positions);
    ktg_free(corners);
    return mesh;
}

ktg_mesh *shape_several(ktg_context *context) {
    ktg_mesh *part[4] = {shape_icosphere(context, 1), shape_torus(context, 8, 5),
                         shape_cylinder(context, 9, 2), shape_triangle(context)};
    ktg_mesh *all = part[0];
    for (int i = 1; i < 4; i++) {
        ktg_mesh *more = shape_beside(context, all, part[i], (ktg_vec3){1.5 * i, 0, 0});
        ktg_mesh_free(&all);
        ktg_mesh_free(&part[i]);
        all = more;
    }
    return all;
}

ktg_mesh *shape_scaled(ktg_context *context, const ktg_mesh *mesh, double factor) {
    ktg_mesh *copy;
    assert_int_equal(ktg_mesh_copy(context, mesh, &copy), KTG_OK);
    for (uint32_t v = 0; v < copy->vertex_count; v++)
        copy->positions[v] = ktg_mul3(copy->positions[v], factor);
    return copy;
}

ktg_mesh *shape_turned(ktg_context *context, const ktg_mesh *mesh, double angle, ktg_vec3 move) {
    ktg_mesh *copy = shape_scaled(context, mesh, 1);
    double c = cos(angle), s = sin(angle);
    for (uint32_t v = 0; v < copy->vertex_count; v++) {
        ktg_vec3 p = copy->positions[v];
        ktg_vec3 once = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
        copy->positions[v] =
            ktg_add3((ktg_vec3){once.x, c * once.y - s * once.z, s * once.y + c * once.z}, move);
    }
    return copy;
}

static uint32_t *shuffled(ktg_context *context, uint32_t count, ktg_random *random) {
    uint32_t *order = ktg_new(context, count, uint32_t);
    for (uint32_t i = 0; i < count; i++) {
        size_t j = ktg_random_below(random, i + 1);
        order[i] = order[j];
        order[j] = i;
    }
    return order;
}

ktg_mesh *shape_renumbered(ktg_context *context, const ktg_mesh *mesh, uint64_t seed) {
    ktg_random random;
    ktg_random_seed(&random, seed);
    ktg_mesh *copy = shape_scaled(context, mesh, 1);
    uint32_t *vertex = shuffled(context, mesh->vertex_count, &random);
    uint32_t *face = shuffled(context, mesh->face_count, &random);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        copy->positions[vertex[v]] = mesh->positions[v];
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        size_t turn = ktg_random_below(&random, 3);
        for (size_t k = 0; k < 3; k++)
            copy->faces[3 * face[f] + k] = vertex[mesh->faces[3 * f + (k + turn) % 3]];
        if (mesh->face_polygon)
            copy->face_polygon[face[f]] = mesh->face_polygon[f];
    }
    ktg_free(vertex);
    ktg_free(face);
    return copy;
}
