/* mesh/repair.h - the steps of a repair (mesh only).
 *
 * The mesh under repair keeps the vertices of the input at its corners until the last step; what
 * is connected with what is known by half-edges: 3 f + k runs from corner k of face f to the next.
 */
#ifndef KTG_MESH_REPAIR_H
#define KTG_MESH_REPAIR_H

#include "mesh/mesh.h"

typedef struct ktg_repair {
    ktg_context *context;
    ktg_mesh *mesh; /* a copy of the caller's, owned */
    uint32_t *weld; /* vertex_count: the lowest vertex at the same position */
    uint32_t *mate; /* 3 face_count: the half-edge joined to each, KTG_NONE at a border */
    bool unsettled; /* a step undid or added something that earlier steps should see */
    ktg_repair_report report;
} ktg_repair;

/* repair_clean.c: no duplicate and no degenerate face is left; `weld` is made. */
KTG_NODISCARD ktg_status ktg_repair_clean(ktg_repair *repair);

/* repair_join.c: `mate` is made; an edge in space is joined in pairs. */
KTG_NODISCARD ktg_status ktg_repair_join(ktg_repair *repair);

/* repair_orient.c: joined faces are turned alike; joins that cannot agree are cut. */
KTG_NODISCARD ktg_status ktg_repair_orient(ktg_repair *repair);

/* repair_fans.c: each fan of corners gets a vertex of its own, and each pair of vertices at most
 * one edge; marked edges follow; vertices without faces go. */
KTG_NODISCARD ktg_status ktg_repair_fans(ktg_repair *repair);

/* An edge of faces that is cut at a vertex. */
typedef struct ktg_mark_cut {
    uint32_t ends[2], middle;
} ktg_mark_cut;

/* repair_marks.c: marks on edges that are cut get company: their halves. Sorts the cuts. */
KTG_NODISCARD ktg_status ktg_repair_cut_marks(ktg_repair *repair, ktg_mark_cut *cuts, size_t count);

/* repair_marks.c: marks become the edges that their vertices' corners are at now. before: 3
 * face_count vertices as the marks name them, KTG_NONE where a corner had none. */
KTG_NODISCARD ktg_status ktg_repair_carry_marks(ktg_repair *repair, const uint32_t *before);

/* ---- helpers (repair_faces.c) --------------------------------------------------------------- */

static inline uint32_t ktg_halfedge_next(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

/* The adjacency of the faces with each vertex replaced by `weld` of it. */
KTG_NODISCARD ktg_status ktg_repair_welded(ktg_repair *repair, ktg_adjacency **adjacency);

/* Removes the faces that are not to be kept; the others close up in order. */
void ktg_repair_keep_faces(ktg_mesh *mesh, const bool *keep);

/* Appends `extra` zeroed faces and vertices (the counts grow). */
KTG_NODISCARD ktg_status ktg_repair_grow(ktg_context *context, ktg_mesh *mesh, uint32_t faces,
                                         uint32_t vertices);

/* Vertex `to` gets the position and the colour of `from`. */
void ktg_repair_copy_vertex(ktg_mesh *mesh, uint32_t from, uint32_t to);

/* Cuts face f = (u, v, w), u at corner k, at a point of its edge u v where vertex m is: f becomes
 * (u, m, w) and `added` (m, v, w), with f's attributes and the texture coordinate at the fraction
 * `t` from u to v. */
KTG_NODISCARD ktg_status ktg_repair_cut_face(ktg_context *context, ktg_mesh *mesh, uint32_t f,
                                             uint32_t k, uint32_t m, double t, uint32_t added);

#endif
