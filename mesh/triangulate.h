/* mesh/triangulate.h - cutting polygons into triangles (mesh only). */
#ifndef KTG_MESH_TRIANGULATE_H
#define KTG_MESH_TRIANGULATE_H

#include "core/core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Cuts a polygon of `count` >= 3 corners (finite, consecutive ones at different vertices) into
 * count - 2 triangles that run the way the polygon does. triangles: 3 (count - 2) corner numbers.
 * A quadrangle is cut along its better diagonal; more corners by constrained Delaunay in their
 * plane, or as a fan from corner 0 where their outline crosses or touches itself in that plane
 * (other than along a bridge to a hole, walked in both directions). */
KTG_NODISCARD ktg_status ktg_triangulate(ktg_context *context, const ktg_vec3 *corners,
                                         uint32_t count, uint32_t *triangles);

/* The constrained Delaunay triangulation of a counter-clockwise polygon in the plane (CGAL).
 * *simple is false, and triangles undefined, where the outline crosses or touches itself, other
 * than along a bridge. */
KTG_NODISCARD ktg_status ktg_triangulate_plane(ktg_context *context, const ktg_vec2 *corners,
                                               uint32_t count, uint32_t *triangles, bool *simple);

#ifdef __cplusplus
}
#endif
#endif
