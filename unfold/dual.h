/* unfold/dual.h - one part's surface seen as its dual graph (unfold only).
 *
 * A part is a component, or what forced cuts leave of it. Nodes are faces, dual edges the inner
 * edges of the surface. Coordinates are normalised: multiplied by a power of two so that the whole
 * model's largest extent lies in [1, 2). */
#ifndef KTG_UNFOLD_DUAL_H
#define KTG_UNFOLD_DUAL_H

#include "core/core.h"
#include "core/random.h"
#include "mesh/mesh.h"

/* Two faces of one piece overlap when they must be moved by more than this to be apart (normalised
 * units): far above the rounding of a chain of rigid motions, far below the micrometre that paper
 * shows. */
#define KTG_OVERLAP_DEPTH 1e-7

typedef struct ktg_dual_edge {
    uint32_t halfedge[2]; /* 3 face + corner, in the two faces; halfedge[0] < halfedge[1] */
    uint32_t vertices[2]; /* as halfedge[0] runs */
    double length;
    bool rigid; /* stays a fold in every search: inside a coplanar input polygon, or kept */
    bool kept;  /* somebody wants this fold: no splitting cuts it either */
} ktg_dual_edge;

typedef struct ktg_dual {
    uint32_t vertex_count, face_count;
    uint32_t edge_count;     /* edges that may be joined; in `edges` two kinds follow them: */
    uint32_t forced_count;   /* cuts somebody wants, both sides here: never joined, but seams */
    uint32_t outer_count;    /* such cuts to another part: halfedge[1] is KTG_NONE */
    uint32_t *mesh_face;     /* face_count: the face's number in the whole mesh */
    uint32_t *faces;         /* 3 face_count local vertices */
    uint32_t *halfedge_edge; /* 3 face_count: dual edge, KTG_NONE on a border and a forced cut */
    ktg_vec3 *edge_vectors;  /* 3 face_count: from corner to corner, normalised */
    double *lengths;         /* 3 face_count: of those */
    ktg_vec2 *flat;          /* 3 face_count: corners of the face laid flat, counter-clockwise */
    ktg_vec2 *flat_vectors;  /* 3 face_count: its edges in the same frame, short ones precise too */
    ktg_dual_edge *edges;    /* edge_count + forced_count + outer_count */
} ktg_dual;

/* The dual of the faces listed in mesh_faces (rising numbers; twins that are not listed are a
 * border); `scale` is the normalising power of two. No edge is kept or forced (rules.h does that).
 */
KTG_NODISCARD ktg_status ktg_dual_new(ktg_context *context, const ktg_mesh *mesh,
                                      const ktg_adjacency *adjacency, const uint32_t *mesh_faces,
                                      uint32_t face_count, double scale, ktg_dual **dual);
void ktg_dual_free(ktg_dual **dual);

/* Arrays for `face_count` faces, zeros; on KTG_MEMORY some may be NULL, and ktg_dual_free does. */
KTG_NODISCARD ktg_status ktg_dual_allocate(ktg_context *context, ktg_dual *dual);

/* The dual's number of a face of the mesh, KTG_NONE when it is not in it. */
uint32_t ktg_dual_face(const ktg_dual *dual, uint32_t mesh_face);

/* Minimum spanning tree (section 4.1): weight w(e) = (l_max - l) / (l_max - l_min), so that long
 * edges stay folds; rigid edges come first. `jitter` times a random number from 0 to 1 is added to
 * each weight (0: the paper's tree; random may be NULL then). in_tree: edge_count flags, set. */
KTG_NODISCARD ktg_status ktg_dual_spanning_tree(ktg_context *context, const ktg_dual *dual,
                                                double jitter, ktg_random *random, bool *in_tree);

#endif
