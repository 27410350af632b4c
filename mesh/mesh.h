/* mesh/mesh.h - the triangle mesh: reading, checking, repairing, simplifying, writing.
 *
 * A mesh is plain data: an indexed face list that can hold anything a file may contain,
 * non-manifold shapes included. Adjacency is built from it when it is needed. The usual order of
 * calls:
 *
 *     ktg_mesh_read -> ktg_mesh_check (what is wrong?) -> ktg_mesh_repair -> ktg_mesh_simplify
 */
#ifndef KTG_MESH_MESH_H
#define KTG_MESH_MESH_H

#include "core/core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A table of names that faces refer to by index. */
typedef struct ktg_names {
    uint32_t count;
    char **text; /* count strings, UTF-8 as in the file, never NULL */
} ktg_names;

/* Corner k of face f is entry 3 f + k. Faces run counter-clockwise seen from outside. Arrays marked
 * "or NULL" are absent when the file had nothing of the kind. Owned by the caller, freed by
 * ktg_mesh_free. */
typedef struct ktg_mesh {
    uint32_t vertex_count, face_count;
    ktg_vec3 *positions; /* vertex_count; the file's own unit */
    uint32_t *faces;     /* 3 face_count vertex indices */

    /* face_count: the file's polygon a triangle came from; triangles with the same number are one
     * input polygon. Or NULL: every triangle is a polygon of its own. */
    uint32_t *face_polygon;

    /* face_count indices into the name tables (KTG_NONE: none), or NULL. */
    uint32_t *face_object, *face_group, *face_material;
    ktg_names objects, groups, materials;
    char *material_library; /* OBJ's mtllib as written there, a line for each statement; or NULL */

    /* The texture's file as a PLY names it ("comment TextureFile"), or NULL. Where it names
     * several, a line for each, and face_material says which of them is a face's. */
    char *texture_file;

    uint8_t *vertex_colours; /* 3 vertex_count: red, green, blue as sRGB bytes, or NULL */
    uint8_t *face_colours;   /* 3 face_count, likewise, or NULL */

    uint32_t uv_count;
    ktg_vec2 *uvs;     /* uv_count texture coordinates, or NULL */
    uint32_t *face_uv; /* 3 face_count indices into uvs (KTG_NONE: none), or NULL */

    uint32_t marked_count;    /* OBJ `l` elements: edges somebody marked */
    uint32_t *marked_edges;   /* 2 marked_count vertex indices, or NULL */
    uint32_t *marked_numbers; /* marked_count numbers that follow them (ktg_mesh_mark), or NULL */
} ktg_mesh;

KTG_API void ktg_mesh_free(ktg_mesh **mesh);

/* A deep copy. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_copy(ktg_context *context, const ktg_mesh *mesh,
                                               ktg_mesh **copy);

/* A mesh from bare arrays (copied): positions 3 vertex_count doubles, faces 3 face_count indices.
 * KTG_ARGUMENT for an index out of range or a coordinate that is not finite. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_new(ktg_context *context, const double *positions,
                                              uint32_t vertex_count, const uint32_t *faces,
                                              uint32_t face_count, ktg_mesh **mesh);

/* ---- files -------------------------------------------------------------------------------- */

typedef enum ktg_mesh_format {
    KTG_MESH_BY_ENDING, /* and where the content clearly says otherwise, by content */
    KTG_MESH_OBJ,
    KTG_MESH_STL,
    KTG_MESH_PLY,
    KTG_MESH_OFF
} ktg_mesh_format;

/* Reads a model ("-": from standard input). OBJ: polygons, negative indices, groups, objects,
 * materials, texture coordinates, colours behind a vertex's position, `l` elements. STL, ASCII and
 * binary: vertices welded where they coincide. PLY, ASCII and both binary orders: colours of
 * vertices and faces, texture coordinates of vertices or corners, the texture's name. OFF: colours
 * of vertices and faces. Colours are numbers from 0 to 1, or to 255 where one of the file's is
 * larger than 1; what is beyond that is clamped; what has none among others that have is white.
 * Polygons are cut into triangles (constrained
 * Delaunay in their plane; a quadrangle along its better diagonal). Every face of the file is kept
 * or the call fails: KTG_FILE, KTG_FORMAT (with file, line and reason: truncated, index out of
 * range, not a number, NaN or infinite, no faces, a count the file cannot hold), KTG_LIMIT. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_read(ktg_context *context, const char *path,
                                               ktg_mesh_format format, ktg_mesh **mesh);

/* Appends the model to an output, in the format of its path's ending (or `format`): OBJ with
 * everything the mesh holds but colours of faces, binary STL, ASCII PLY (positions, triangles,
 * colours, texture coordinates, texture_file), OFF (positions and triangles). Numbers read back to
 * the same double (STL: float). Input polygons are not restored: triangles are written. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_write(ktg_context *context, const ktg_mesh *mesh,
                                                ktg_mesh_format format, ktg_output *output);

/* KTG_MESH_BY_ENDING when the path's ending (any case) is not that of a model format. */
KTG_API ktg_mesh_format ktg_mesh_format_of(const char *path);

/* ---- edges and faces that somebody names ---------------------------------------------------- */

/* Edges of a mesh, as a file names them. */
typedef struct ktg_edge_list {
    uint32_t count;
    uint32_t *vertices; /* 2 count vertex indices, as the file orders them */
    uint64_t *lines;    /* count: where each stands */
    char *file;         /* its name, for messages */
} ktg_edge_list;

/* Reads the names of edges from a file ("-": from standard input). Either text: on each line the
 * numbers of two or more vertices, from 1 in the order of the model file, that follow each other
 * along edges; # begins a comment. Or OBJ with `l` elements, whose vertices are those of its own
 * `v` lines, found in the mesh by their position (1e-5 of its size), or, without `v` lines, the
 * mesh's by number. The mesh must be as it was read. KTG_FILE, KTG_FORMAT with file and line: not a
 * number, out of range, no edge of the mesh, no edge at all. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_read_edges(ktg_context *context, const char *path,
                                                     const ktg_mesh *mesh, ktg_edge_list *list);
KTG_API void ktg_edge_list_free(ktg_edge_list *list);

/* Marks these edges (2 count vertices) and no others. marked_numbers says which of them, from 0,
 * each mark stands for: an edge between coincident vertices is marked wherever it lies. Marks and
 * their numbers follow the mesh through repair (which may lose those of faces without area) and
 * simplification. KTG_ARGUMENT when two vertices have no edge between them. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_mark(ktg_context *context, ktg_mesh *mesh,
                                               const uint32_t *edges, uint32_t count);

/* True when the name is `wanted`, or when that is one of its words: an OBJ face may be in several
 * groups. */
KTG_API bool ktg_name_has(const char *name, const char *wanted);

/* Leaves out all faces of the groups, objects or materials named, with the vertices and marks that
 * only they had; what they leave open stays open. A name may be one of several words of a group.
 * KTG_ARGUMENT when nothing has a name (the message says what there is), KTG_GEOMETRY when no face
 * is left. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_omit(ktg_context *context, ktg_mesh *mesh,
                                               const char *const *names, size_t count);

/* ---- adjacency ---------------------------------------------------------------------------- */

/* Half-edge h = 3 f + k runs from corner k of face f to the next one. Edges are undirected pairs of
 * vertices, numbered in the order in which half-edges first show them; any number of half-edges may
 * share an edge. */
typedef struct ktg_adjacency {
    uint32_t halfedge_count; /* 3 face_count */
    uint32_t edge_count;
    uint32_t *halfedge_edge; /* halfedge_count: the edge of each half-edge */
    uint32_t *edge_first; /* edge_count + 1: where an edge's half-edges start in edge_halfedges */
    uint32_t *edge_halfedges; /* halfedge_count */
    uint32_t *twin; /* halfedge_count: the other half-edge where an edge has exactly two that
                       run in opposite directions, else KTG_NONE */
} ktg_adjacency;

KTG_API KTG_NODISCARD ktg_status ktg_adjacency_new(ktg_context *context, const ktg_mesh *mesh,
                                                   ktg_adjacency **adjacency);
KTG_API void ktg_adjacency_free(ktg_adjacency **adjacency);

/* Faces connected through twins. face_component: face_count numbers 0 .. *count - 1 in order of
 * first appearance, allocated, freed with ktg_free. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_components(ktg_context *context, const ktg_mesh *mesh,
                                                     const ktg_adjacency *adjacency,
                                                     uint32_t **face_component, uint32_t *count);

/* The name of each component, after the object, else group, that most of its faces belong to, else
 * "part 1", "part 2" (or `fallback` when there is only one); made unique by a number behind it.
 * *names is allocated; free it with ktg_names_free. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_component_names(ktg_context *context,
                                                          const ktg_mesh *mesh,
                                                          const uint32_t *face_component,
                                                          uint32_t component_count,
                                                          const char *fallback, ktg_names *names);
KTG_API void ktg_names_free(ktg_names *names);

/* A name as the readers make it: control characters become "_", bytes that are not UTF-8 are taken
 * for Latin-1. Free with ktg_free; NULL on KTG_MEMORY. */
KTG_API char *ktg_mesh_clean_name(ktg_context *context, const char *name);

/* Makes each connected component a group of its own, named as above, in place of the mesh's groups:
 * what is apart in a file can be told apart after ktg_mesh_repair has joined it. On failure the
 * mesh is as it was. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_group_components(ktg_context *context, ktg_mesh *mesh,
                                                           const char *fallback);

/* ---- checking and repair ------------------------------------------------------------------ */

/* What a mesh is and what is wrong with it. Counts refer to the mesh as it is, except
 * `unstitched_edges`: borders that would close if coincident vertices were one. Faces are duplicate
 * (the second and later ones count) or degenerate by where their corners are, not by their numbers.
 * Faces with the same vertex twice take no part in edges, borders and what follows from them.
 * `oriented`: every edge has as many faces that run one way as the other, or one face. */
typedef struct ktg_mesh_report {
    uint32_t vertices, faces, edges, components;
    uint32_t border_edges, border_loops;
    int64_t euler; /* V - E + F of referenced vertices */
    int32_t genus; /* of all components together; -1 where non-manifold or not oriented */
    bool closed, manifold, oriented;
    uint32_t duplicate_faces, degenerate_faces, unreferenced_vertices;
    uint32_t nonmanifold_edges, nonmanifold_vertices;
    uint32_t misoriented_edges; /* edges both of whose faces run the same way */
    uint32_t unstitched_edges;
    uint32_t inward_components;  /* closed components that are inside out */
    bool intersections_known;    /* self-intersections were looked for and counted */
    uint32_t self_intersections; /* pairs of faces; counting stops at KTG_MESH_MOST_INTERSECTIONS */
    ktg_vec3 low, high;          /* bounding box */
    double area, volume;         /* volume is 0 unless closed and oriented */
} ktg_mesh_report;

#define KTG_MESH_MOST_INTERSECTIONS 1000000

/* `intersections`: also look for self-intersections (CGAL; a second or so at 100,000 faces). */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_check(ktg_context *context, const ktg_mesh *mesh,
                                                bool intersections, ktg_mesh_report *report);

/* How many times its own extent a model may be away from the origin: beyond, the rounding of its
 * coordinates is more than patterns are proven to (1e-9). */
#define KTG_MESH_MOST_AWAY 1e7

/* The largest side of the box around the faces. KTG_GEOMETRY where it is nothing, beyond 1e75, or
 * less than a KTG_MESH_MOST_AWAY-th of the largest coordinate: no pattern can be made of that. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_check_extent(ktg_context *context, const ktg_mesh *mesh,
                                                       double *extent);

/* What a repair did. */
typedef struct ktg_repair_report {
    uint32_t duplicate_faces_removed, degenerate_faces_removed, unreferenced_vertices_removed;
    uint32_t vertices_welded; /* coincident vertices made one along unstitched borders */
    uint32_t faces_turned;    /* faces whose orientation was reversed */
    uint32_t nonmanifold_edges_split, nonmanifold_vertices_split;
    uint32_t seams_opened; /* edges cut because their sides cannot be oriented alike (Moebius) */
    bool changed;
} ktg_repair_report;

/* Makes the mesh an oriented manifold, with or without border, in place of what it was: duplicate
 * and degenerate faces go (a sliver whose three corners lie on a line splits its neighbour, so that
 * no hole opens), borders whose vertices coincide exactly are stitched, faces are oriented alike
 * and closed components outwards, edges with more than two faces are split so that the pair that
 * forms the smoothest sheet stays together, vertices are split so that each has one fan. (An edge
 * that still has both its vertices in common with another gets a vertex in its middle, and its
 * faces become two each.) Object, group, material, polygon, texture coordinates, colours and marked
 * edges follow; of vertices that become one the first one's colour stays. Self-intersections stay.
 * A mesh with nothing to repair stays the same to the bit, and so does a repaired one. KTG_GEOMETRY
 * when no face is left; on failure the mesh is as it was. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_repair(ktg_context *context, ktg_mesh *mesh,
                                                 ktg_repair_report *report);

/* ---- simplification ----------------------------------------------------------------------- */

typedef struct ktg_simplify_report {
    uint32_t faces_before, faces_after;
    bool target_reached;
    uint32_t faces_without_uv; /* which had texture coordinates before */
} ktg_simplify_report;

/* Collapses edges by quadric error (Garland & Heckbert 1997; on OpenMesh's half-edges, with its
 * decimater's test of legality) to at most `target_faces`, in place. Topology and borders keep, no
 * normal flips, no degenerate face and no self-intersection that was not there before comes into
 * being; where these rules forbid every further collapse it stops early (report->target_reached =
 * false). Objects, groups, materials and colours follow the surviving faces, and the lines between
 * them are kept to like edges; colours of vertices are blended. Marked edges stay as they are:
 * their vertices do not move. Polygons are dropped when anything changed.
 *
 * Texture coordinates follow, too. Their seams (and in a model that has any, the lines between
 * materials and between mirrored halves) stay: vertices on them move along them only, and those
 * where seams meet or end stay, but for a move along their normal, which changes nothing in the
 * texture. No face turns over in the texture. Where this would leave more faces than wished for, or
 * seams meet in more than a quarter as many vertices as there shall be faces, the wish weighs more
 * than the seams; and what seams enclose that is smaller than a quarter of a face to come is given
 * up anyway. Faces whose coordinates then hold no longer have KTG_NONE at their corners, and are
 * counted (report->faces_without_uv).
 *
 * The mesh must be a manifold (as ktg_mesh_repair leaves it), else KTG_ARGUMENT. On failure it is
 * as it was. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_simplify(ktg_context *context, ktg_mesh *mesh,
                                                   uint32_t target_faces,
                                                   ktg_simplify_report *report);

/* ---- measuring ---------------------------------------------------------------------------- */

/* Symmetric Hausdorff distance between two surfaces, in their unit, by closest points (CGAL AABB
 * tree) from samples: vertices and points spread over the faces so that no point of either surface
 * is further than `spacing` from a sample (0: 1/200 of the diagonal). A lower bound that is off by
 * `spacing` at most. */
KTG_API KTG_NODISCARD ktg_status ktg_mesh_hausdorff(ktg_context *context, const ktg_mesh *a,
                                                    const ktg_mesh *b, double spacing,
                                                    double *distance);

#ifdef __cplusplus
}
#endif
#endif
