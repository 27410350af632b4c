/* deform/deform.h - changing a model before it is cut: constraint-based deformation of models of
 * several parts (after K. Ogawa & H. Masuda, "A constraint-based mesh deformation technique for
 * assembly models").
 *
 * An edit says which vertices stay, which are moved, which keep their shape, which become larger
 * and which parts hang together; the rest of the surface follows smoothly. Any mesh will do: open,
 * of several parts, with more than two faces at an edge. In one call:
 *
 *     ktg_edit *edit;
 *     ktg_edit_read(context, "raise-arm.edit", mesh, &edit);
 *     ktg_deform_mesh(context, mesh, edit, &report);
 *     ktg_edit_free(&edit);
 *
 * or, where somebody drags: ktg_deform_new once (it factors a matrix), then ktg_deform_update as
 * often as a handle moves (back-substitutions only). docs/deform.md tells the form of the file and
 * how it works. */
#ifndef KTG_DEFORM_DEFORM_H
#define KTG_DEFORM_DEFORM_H

#include "core/core.h"
#include "mesh/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- edits -------------------------------------------------------------------------------- */

/* A rigid motion, lengths in the mesh's unit: a turn about `axis` through `centre`, then `move`.
 * Where the angle is not 0 the axis must not be (0, 0, 0); its length does not matter. */
typedef struct ktg_deform_motion {
    ktg_vec3 axis, centre, move;
    double angle; /* radians, right-handed; may be more than half a turn, or several */
} ktg_deform_motion;

typedef enum ktg_hold_kind {
    KTG_HOLD_FIXED,  /* stays where it is */
    KTG_HOLD_HANDLE, /* moves by `motion` */
    KTG_HOLD_RIGID,  /* keeps its shape, wherever it goes */
    KTG_HOLD_RESIZE  /* keeps its shape but for its size, which becomes `scale` times as large */
} ktg_hold_kind;

/* What is to happen to some vertices. In rigid and resized ones, each part that hangs together by
 * edges is a body of its own, unless they are held `together`. A resized part of which exactly one
 * vertex is fixed or a handle is resized about that vertex. */
typedef struct ktg_hold {
    ktg_hold_kind kind;
    char *name;    /* for messages; may be NULL, as all texts of an edit */
    uint64_t line; /* where it stands in the file; 0: nowhere */
    uint32_t vertex_count;
    uint32_t *vertices; /* vertex_count */
    ktg_deform_motion motion;
    double scale; /* more than 0; 0: free, it follows the scales of what it hangs on */
    bool together;
} ktg_hold;

/* How vertices of one part are tied to another: to a vertex, with which they form a rigid pair
 * (each vertex in one pair at most, the nearest pairs first), or, following them, to the nearest
 * point of an edge or face. */
typedef enum ktg_link_kind {
    KTG_LINK_AUTO,   /* pairs; then what is left of `from` follows faces, or edges where `to` has no
                        faces */
    KTG_LINK_VERTEX, /* pairs only */
    KTG_LINK_EDGE,   /* all follow edges */
    KTG_LINK_FACE    /* all follow faces */
} ktg_link_kind;

/* Virtual links between two sets of vertices, no longer than `most` (in the mesh's unit). Where the
 * sets share vertices, links lie between different parts, or between vertices at one place. */
typedef struct ktg_edit_link {
    ktg_link_kind kind;
    char *name;
    uint64_t line;
    uint32_t from_count, to_count;
    uint32_t *from, *to;
    double most;
} ktg_edit_link;

/* A named selection. */
typedef struct ktg_edit_set {
    char *name;
    uint64_t line;
    uint32_t vertex_count;
    uint32_t *vertices; /* ascending */
} ktg_edit_set;

/* The whole edit, plain data: read from a file, or put together by the caller, who then owns it.
 * Vertex indices are those of the mesh it is for. */
typedef struct ktg_edit {
    char *file;
    size_t set_count, hold_count, link_count;
    ktg_edit_set *sets; /* for ktg_edit_write_sets only */
    ktg_hold *holds;
    ktg_edit_link *links;
    uint32_t steps;  /* looked at in each update: a large motion is made in so many equal ones; 0:
                        one for each 30 degrees of  the largest turn */
    uint32_t refine; /* passes in each step that fit the rotations to what came out; 0 */
} ktg_edit;

/* Reads an edit file for this mesh ("-": from standard input). KTG_FILE; KTG_FORMAT with file, line
 * and reason: no such section or key, not a number (NaN, infinite, out of bounds), no such name,
 * an empty set, sets that are made of each other. */
KTG_API KTG_NODISCARD ktg_status ktg_edit_read(ktg_context *context, const char *path,
                                               const ktg_mesh *mesh, ktg_edit **edit);

/* Frees what ktg_edit_read made. */
KTG_API void ktg_edit_free(ktg_edit **edit);

/* Appends an OBJ of the mesh to an output in which each set, and what each section takes hold of,
 * is a group: its faces, and edges (l) and vertices (p) where there are no faces. */
KTG_API KTG_NODISCARD ktg_status ktg_edit_write_sets(ktg_context *context, const ktg_edit *edit,
                                                     const ktg_mesh *mesh, ktg_output *output);

/* ---- deforming ---------------------------------------------------------------------------- */

/* A mesh under an edit, ready to be updated. Used by one thread at a time. */
typedef struct ktg_deform ktg_deform;

/* Checks the edit, finds links, factors. Mesh and edit are borrowed until ktg_deform_free. The
 * factor's size is that of the surface, some 0.2 s and 60 MB at 20,000 faces. KTG_FORMAT, with the
 * sections' names and lines: two motions for one vertex or for what is rigid with it, two scales, a
 * motion of more than 10,000 times the model's size, a link without a pair, a rigid part without an
 * edge, a part of the model that nothing holds (with its name and size). KTG_GEOMETRY: no faces;
 * KTG_LIMIT: a vertex with so many neighbours that there is no factor. */
KTG_API KTG_NODISCARD ktg_status ktg_deform_new(ktg_context *context, const ktg_mesh *mesh,
                                                const ktg_edit *edit, ktg_deform **deform);
KTG_API void ktg_deform_free(ktg_deform **deform);

/* Where the vertices go: positions, vertex_count of the mesh (not its own array). `motions`: one
 * for each hold of the edit, looked at for handles only; NULL: the holds' own. The result depends
 * on the motions alone, not on updates before. KTG_ARGUMENT for a motion that is not finite. */
KTG_API KTG_NODISCARD ktg_status ktg_deform_update(ktg_context *context, ktg_deform *deform,
                                                   const ktg_deform_motion *motions,
                                                   ktg_vec3 *positions);

/* What came out. */
typedef struct ktg_deform_report {
    uint32_t vertices, faces, components;
    uint32_t unknowns;       /* of the linear system: bodies that are free to move */
    uint32_t vertex_links;   /* rigid pairs */
    uint32_t follower_links; /* vertices that follow edges or faces */
    uint32_t links_left_out; /* their two ends depend on each other already */
    uint32_t steps;
    double stretch_min, stretch_max;      /* of edges: length after over length before */
    uint32_t flipped_faces;               /* turned over against what is around them */
    uint32_t degenerate_faces;            /* squeezed to less than a thousandth of their area */
    double feature_error;                 /* of rigid and resized parts: largest change of a
                                             distance in them, over their size */
    double link_error;                    /* largest change of a link's length, mesh's unit */
    double moved;                         /* furthest way of a vertex, mesh's unit */
    double seconds_setup, seconds_update; /* ktg_deform_mesh only */
} ktg_deform_report;

/* Measures positions that the last update made. */
KTG_API KTG_NODISCARD ktg_status ktg_deform_measure(ktg_context *context, const ktg_deform *deform,
                                                    const ktg_vec3 *positions,
                                                    ktg_deform_report *report);

/* All of it: moves the mesh's vertices. Everything else of the mesh stays as it is. `report` may be
 * NULL. On failure the mesh is as it was. */
KTG_API KTG_NODISCARD ktg_status ktg_deform_mesh(ktg_context *context, ktg_mesh *mesh,
                                                 const ktg_edit *edit, ktg_deform_report *report);

#ifdef __cplusplus
}
#endif
#endif
