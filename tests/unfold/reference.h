/* tests/unfold/reference.h - slow and plain forms of what unfold/ computes, to compare with; they
 * share nothing with it. */
#ifndef KTG_TESTS_UNFOLD_REFERENCE_H
#define KTG_TESTS_UNFOLD_REFERENCE_H

#include "mesh/mesh.h"
#include "pattern/pattern.h"

/* How far two triangles (either way round) must be moved to be apart: the distance of the origin
 * from the border of their Minkowski difference, negative where they are apart already. */
double reference_depth(const ktg_vec2 a[3], const ktg_vec2 b[3]);

/* Area of what two counter-clockwise triangles have in common, by clipping. */
double reference_common_area(const ktg_vec2 a[3], const ktg_vec2 b[3]);

/* The largest depth over all pairs of `count` triangles. */
double reference_deepest(const ktg_vec2 *corners, uint32_t count);

/* Lays flat all faces that folds (flags per edge of the adjacency) connect to `seed`, from 3D
 * lengths alone. corners: 3 face_count; reached: face_count flags, set. */
void reference_lay(const ktg_mesh *mesh, const ktg_adjacency *adjacency, const bool *is_fold,
                   uint32_t seed, ktg_vec2 *corners, bool *reached);

/* The sum of face angles at each vertex (vertex_count). */
void reference_angle_sums(const ktg_mesh *mesh, double *sums);

/* Asserts all that a pattern of ktg_unfold promises: each face once, lengths, folds that share
 * vertices, no overlap, kinds, angles and sides of edges, pieces without holes, the largest first
 * in each component. */
void assert_sound_net(ktg_context *context, const ktg_mesh *mesh, const ktg_pattern *pattern);

/* Asserts that every number of the two patterns is the same, lengths of b `factor` times as long.
 */
void assert_same_net(const ktg_pattern *a, const ktg_pattern *b, double factor);
bool same_folds(const ktg_pattern *a, const ktg_pattern *b);

#endif
