/* tests/unfold/shapes.h - generated models for the tests. Every mesh is the caller's, freed with
 * ktg_mesh_free; extents are about 1 unless said otherwise. */
#ifndef KTG_TESTS_UNFOLD_SHAPES_H
#define KTG_TESTS_UNFOLD_SHAPES_H

#include "mesh/mesh.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

int make_context(void **state);
int drop_context(void **state);

/* From arrays; asserts that it works. */
ktg_mesh *shape_mesh(ktg_context *context, const ktg_vec3 *positions, uint32_t vertex_count,
                     const uint32_t *faces, uint32_t face_count);

ktg_mesh *shape_triangle(ktg_context *context);
ktg_mesh *shape_two_triangles(ktg_context *context); /* folded along their common edge */
ktg_mesh *shape_tetrahedron(ktg_context *context);
/* `side` x `side` quadrangles on each of the six sides, each cut in two, with face_polygon. */
ktg_mesh *shape_cube(ktg_context *context, uint32_t side);
/* 20 * 4^level faces. */
ktg_mesh *shape_icosphere(ktg_context *context, uint32_t level);
/* 320 faces: an icosphere whose radius swings. */
ktg_mesh *shape_bumpy_sphere(ktg_context *context);
/* A pyramid `height` high on each of the 20 sides of an icosahedron: 60 faces. */
ktg_mesh *shape_star(ktg_context *context, double height);
ktg_mesh *shape_torus(ktg_context *context, uint32_t around, uint32_t across);
/* A tube along a trefoil knot. */
ktg_mesh *shape_knot(ktg_context *context, uint32_t around, uint32_t across);
/* A tube that is open at both ends. */
ktg_mesh *shape_cylinder(ktg_context *context, uint32_t around, uint32_t along);
/* z = x^2 - y^2 over a square. */
ktg_mesh *shape_saddle(ktg_context *context, uint32_t side);
/* A flat square whose vertices lie on multiples of a power of two: all angles sum exactly. */
ktg_mesh *shape_flat(ktg_context *context, uint32_t side);
/* A closed double cone over a polygon with `corners` corners, `thin` wide for 1 high. */
ktg_mesh *shape_needle(ktg_context *context, uint32_t corners, double thin);
/* An icosphere, a torus, a cylinder and a triangle side by side. */
ktg_mesh *shape_several(ktg_context *context);

/* Copies: both in one mesh, b moved; positions times `factor`; turned and moved; vertices and
 * faces in another order and with another first corner. */
ktg_mesh *shape_beside(ktg_context *context, const ktg_mesh *a, const ktg_mesh *b, ktg_vec3 move);
ktg_mesh *shape_scaled(ktg_context *context, const ktg_mesh *mesh, double factor);
ktg_mesh *shape_turned(ktg_context *context, const ktg_mesh *mesh, double angle, ktg_vec3 move);
ktg_mesh *shape_renumbered(ktg_context *context, const ktg_mesh *mesh, uint64_t seed);

#endif
