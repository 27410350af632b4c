/* tests/pattern/nets.h - small patterns to test with, made without unfold/. */
#ifndef KTG_TESTS_PATTERN_NETS_H
#define KTG_TESTS_PATTERN_NETS_H

#include "pattern/pattern.h"

/* A surface of triangles. */
typedef struct surface {
    uint32_t vertex_count, face_count;
    ktg_vec3 vertices[2000];
    uint32_t faces[3 * 4000];
} surface;

surface *make_tetrahedron(double side);
/* Twelve triangles: the diagonals are flat. */
surface *make_cube(double side);
/* A prism over a polygon of n sides; its lids are fans of flat triangles. */
surface *make_prism(uint32_t n, double side, double height);
/* An octahedron cut into 8 * 4^level triangles, its vertices at random distances from the middle.
 */
surface *make_bumpy_ball(double radius, double bumps, int level, uint64_t seed);
/* A flat, open strip of 2 n triangles, `width` wide and n `step`s long. */
surface *make_strip(uint32_t n, double step, double width);

/* Grows pieces over the surface, a random border edge at a time, as long as the faces of a piece do
 * not overlap; what cannot be reached starts the next piece, as does every face past `most_faces`.
 * In millimetres: mm_per_unit is 1. The surface is freed. */
ktg_pattern *grow_net(ktg_context *context, surface *s, uint32_t most_faces, uint64_t seed);

/* The same, finished. */
ktg_pattern *net_finished(ktg_context *context, surface *s, uint32_t most_faces, uint64_t seed,
                          const ktg_finish_options *options);

/* Whether a label of any piece says just that. */
bool net_has_text(const ktg_pattern *p, const char *text);

#endif
