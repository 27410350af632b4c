/* mesh/intersect.h - triangles that cut each other (mesh only). */
#ifndef KTG_MESH_INTERSECT_H
#define KTG_MESH_INTERSECT_H

#include "mesh/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* True when two triangles have more in common than the corners they share by position: a point
 * where they share none, something besides the corner or the edge where they share that; always
 * when they share all three. Exact. Neither is degenerate. */
bool ktg_triangles_intersect(const ktg_vec3 p[3], const ktg_vec3 q[3]);

/* The number of pairs of faces that intersect, degenerate faces left out, up to
 * KTG_MESH_MOST_INTERSECTIONS. */
KTG_NODISCARD ktg_status ktg_mesh_intersections(ktg_context *context, const ktg_mesh *mesh,
                                                uint32_t *pairs);

/* ---- CGAL (intersect_cgal.cpp) -------------------------------------------------------------- */

bool ktg_exact_triangles_meet(const ktg_vec3 p[3], const ktg_vec3 q[3]);
bool ktg_exact_segment_meets(ktg_vec3 a, ktg_vec3 b, const ktg_vec3 q[3]);
/* Triangles a b c and a b d lie in one plane, c and d on the same side of a b. */
bool ktg_exact_folded(ktg_vec3 a, ktg_vec3 b, ktg_vec3 c, ktg_vec3 d);

#ifdef __cplusplus
}
#endif
#endif
