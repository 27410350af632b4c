/* mesh/simplify.h - the parts of the simplification (mesh only).
 *
 * Who is next is ours (simplify_collapse.c), what may not be is ours (simplify_rules.c), which
 * vertices and faces are neighbours, and whether a collapse keeps the topology, is OpenMesh's
 * (simplify_openmesh.cpp). */
#ifndef KTG_MESH_SIMPLIFY_H
#define KTG_MESH_SIMPLIFY_H

#include "mesh/boxes.h"
#include "mesh/mesh.h"
#include "mesh/quadric.h"
#include "mesh/simplify_uv.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- OpenMesh (simplify_openmesh.cpp) ------------------------------------------------------- */

typedef struct ktg_halfedges ktg_halfedges;

/* KTG_ARGUMENT when a face does not fit an oriented manifold. */
KTG_NODISCARD ktg_status ktg_halfedges_new(ktg_context *context, const ktg_mesh *mesh,
                                           ktg_halfedges **halfedges);
void ktg_halfedges_free(ktg_halfedges **halfedges);

/* The faces around a vertex, and the vertices; valid until the next call of the same function. */
uint32_t ktg_halfedges_faces(ktg_halfedges *halfedges, uint32_t vertex, const uint32_t **faces);
uint32_t ktg_halfedges_neighbours(ktg_halfedges *halfedges, uint32_t vertex,
                                  const uint32_t **vertices);
bool ktg_halfedges_is_border(const ktg_halfedges *halfedges, uint32_t vertex);

/* Whether `from` may move onto its neighbour `to` without a change of topology. */
KTG_NODISCARD ktg_status ktg_halfedges_may_collapse(ktg_context *context, ktg_halfedges *halfedges,
                                                    uint32_t from, uint32_t to, bool *may);

/* Does it; the faces that were on both are gone. */
KTG_NODISCARD ktg_status ktg_halfedges_collapse(ktg_context *context, ktg_halfedges *halfedges,
                                                uint32_t from, uint32_t to);

/* ---- the state of a simplification ---------------------------------------------------------- */

/* How strictly shapes are looked after; a later stage starts when an earlier one finds nothing. */
typedef enum ktg_strictness { KTG_SHAPELY, KTG_PASSABLE, KTG_STRICTNESS_COUNT } ktg_strictness;

/* An edge in the queue. */
typedef struct ktg_candidate {
    double cost;
    uint32_t from, to; /* `from` goes */
    uint32_t stamp;    /* stamps of both when this was computed, added up */
    uint32_t choice;   /* of position: 0 the best one, 1 and 2 an end */
} ktg_candidate;

typedef struct ktg_simplify {
    ktg_context *context;
    uint32_t vertex_count, face_count; /* of the input */
    uint32_t live_faces;
    ktg_vec3 *positions;   /* vertex_count, current */
    uint32_t *faces;       /* 3 face_count, current */
    bool *alive;           /* face_count */
    ktg_quadric *quadrics; /* vertex_count, in a frame of their own: (p - centre) scale */
    ktg_vec3 centre;
    double scale;     /* a power of two */
    uint32_t *stamps; /* vertex_count: goes up when a vertex changes */
    bool *border;     /* vertex_count; a vertex that stays keeps its state */
    bool *locked;     /* vertex_count: of marked edges; never moves or goes, nor do those edges */
    float *colours;   /* 3 vertex_count, 0 to 255, or NULL */
    ktg_simplify_uv uv;
    ktg_halfedges *halfedges;
    ktg_boxes *boxes;     /* of the living faces */
    uint32_t boxed_faces; /* how many there were when the tree was built */
    ktg_candidate *heap;
    size_t heap_count, heap_capacity;
    ktg_strictness strictness;

    /* scratch of the rules: faces that change, with their old and new corners; those that go */
    uint32_t *changed, *found;
    size_t changed_count, removed_count;
    size_t changed_capacity, found_capacity, shape_capacity, outline_capacity;
    ktg_vec3 *shapes;  /* 6 per changed face: old corners, new corners; removed faces behind them */
    ktg_box *outlines; /* per changed face, of the corners looked at */
} ktg_simplify;

/* How a vertex is bound to seams, while these are kept. */
static inline ktg_seam_bond ktg_simplify_bond(const ktg_simplify *s, uint32_t vertex) {
    return s->uv.kept ? (ktg_seam_bond)s->uv.bonds[vertex] : KTG_OFF_SEAM;
}

/* simplify_rules.c: whether the collapse onto `position` leaves every face around it in good order:
 * none turned, none thin that was not, no new pair of faces that intersect. */
KTG_NODISCARD ktg_status ktg_simplify_allowed(ktg_simplify *s, const ktg_candidate *candidate,
                                              ktg_vec3 position, bool *allowed);

/* simplify_colours.c: colours of vertices, where there are any: taken at the beginning, blended in
 * a collapse (before the vertex moves), and given back, `vertex` becoming vertex `at`. */
KTG_NODISCARD ktg_status ktg_simplify_take_colours(ktg_simplify *s, const ktg_mesh *mesh);
void ktg_simplify_blend_colours(ktg_simplify *s, const ktg_candidate *candidate, ktg_vec3 position);
void ktg_simplify_give_colour(const ktg_simplify *s, uint32_t vertex, ktg_mesh *mesh, uint32_t at);

/* simplify_collapse.c: collapses until `target_faces` are left or nothing more is allowed. */
KTG_NODISCARD ktg_status ktg_simplify_run(ktg_simplify *s, uint32_t target_faces);

/* The box tree over the living faces, built anew. */
KTG_NODISCARD ktg_status ktg_simplify_box_faces(ktg_simplify *s);

#ifdef __cplusplus
}
#endif
#endif
