/* mesh/weld.h - vertices at exactly the same position (mesh only). */
#ifndef KTG_MESH_WELD_H
#define KTG_MESH_WELD_H

#include "mesh/mesh.h"

/* first[v] is the lowest vertex at the position of v (-0 is 0). Allocated, `count` entries, freed
 * with ktg_free. */
KTG_NODISCARD ktg_status ktg_mesh_weld(ktg_context *context, const ktg_vec3 *positions,
                                       uint32_t count, uint32_t **first);

/* duplicate[f]: an earlier face has the same three vertices, in any order, where `weld` says which
 * vertices are the same. Faces with two equal corners are never duplicates. */
KTG_NODISCARD ktg_status ktg_mesh_duplicates(ktg_context *context, const uint32_t *faces,
                                             uint32_t face_count, const uint32_t *weld,
                                             bool *duplicate);

/* A face whose height is below this part of its longest edge counts as degenerate. */
#define KTG_MESH_FLAT 1e-10

/* The height of a triangle over its longest edge as a part of that edge (0 when all corners are
 * equal), the same at every scale; *longest is the corner where that edge starts. */
double ktg_mesh_flatness(const ktg_vec3 corners[3], int *longest);

/* True when two corners are one, or the triangle is flat as above. */
bool ktg_mesh_is_degenerate(const ktg_mesh *mesh, uint32_t face, const uint32_t *weld);

#endif
