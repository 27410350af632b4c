/* mesh/closest.h - the closest point of a surface (shared with paint, not installed). */
#ifndef KTG_MESH_CLOSEST_H
#define KTG_MESH_CLOSEST_H

#include "mesh/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ktg_closest ktg_closest;

/* A search tree over the faces (at least one); borrows nothing. */
KTG_NODISCARD ktg_status ktg_closest_new(ktg_context *context, const ktg_mesh *mesh,
                                         ktg_closest **closest);
void ktg_closest_free(ktg_closest **closest);

/* The point of the surface closest to `query`. *face, if not NULL, is where it is, and before the
 * call a face that may be near, which makes the search shorter, or KTG_NONE. */
KTG_NODISCARD ktg_status ktg_closest_point(ktg_context *context, const ktg_closest *closest,
                                           ktg_vec3 query, ktg_vec3 *point, uint32_t *face);

#ifdef __cplusplus
}
#endif
#endif
