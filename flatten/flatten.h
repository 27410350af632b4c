/* flatten/flatten.h - from a curved panel to a flat one that strains as little as it can.
 *
 * As rigid as possible: every face is to be mapped by a rotation, and what is left of that wish is
 * least for the whole panel (Liu et al., "A Local/Global Approach to Mesh Parameterization", 2008).
 * Where that folds faces over, or the panel onto itself, a symmetric Dirichlet energy that forbids
 * folds takes its place (Smith & Schaefer 2015). And the method of Igarashi & Igarashi,
 * "Implementing As-Rigid-As-Possible Shape Manipulation and Surface Flattening" (JGT 2009), section
 * 7: two linear solves. docs/flatten.md says what was chosen and measured. */
#ifndef KTG_FLATTEN_FLATTEN_H
#define KTG_FLATTEN_FLATTEN_H

#include "core/core.h"
#include "mesh/mesh.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ktg_flatten_method {
    KTG_FLATTEN_ARAP,      /* local/global iteration; injective where that folds or overlaps */
    KTG_FLATTEN_INJECTIVE, /* symmetric Dirichlet energy: never a fold, more strain */
    KTG_FLATTEN_TWO_STEP   /* Igarashi & Igarashi 2009 */
} ktg_flatten_method;

/* What a cloth bears, as stretch (> 0) of the flat piece when it takes the shape of the model:
 * woven cloth hardly any along its threads, and some on the bias, where its threads turn against
 * each other; knits a lot. */
typedef struct ktg_fabric {
    double stretch_along, stretch_across; /* most along and across the grain, 0.03: 3 % */
    double shrink_along, shrink_across;   /* most the other way: eased or steamed in */
    double shear;                         /* radians, the most by which the grain's right angle
                                             changes */
} ktg_fabric;

/* "woven" or "knit". KTG_ARGUMENT names what is known. */
KTG_API KTG_NODISCARD ktg_status ktg_fabric_named(ktg_context *context, const char *name,
                                                  ktg_fabric *fabric);
/* Reads lines "stretch_along = 3%", "stretch_across", "shrink_along", "shrink_across", "shear =
 * 10deg"; # begins a comment; what is not said is as in woven cloth. KTG_FILE, KTG_FORMAT with file
 * and line. */
KTG_API KTG_NODISCARD ktg_status ktg_fabric_read(ktg_context *context, const char *path,
                                                 ktg_fabric *fabric);

typedef enum ktg_edge_weight { KTG_WEIGHT_COTANGENT, KTG_WEIGHT_UNIT } ktg_edge_weight;

/* Where seams are. Several may be chosen together. */
enum {
    KTG_SEAMS_OBJECTS = 1,   /* between faces of different objects, */
    KTG_SEAMS_GROUPS = 2,    /* groups, */
    KTG_SEAMS_MATERIALS = 4, /* materials */
    KTG_SEAMS_MARKED = 8,    /* marked edges (OBJ l elements, or a file of edges) */
    KTG_SEAMS_UV = 16,       /* where texture coordinates jump: borders of UV islands */
    KTG_SEAMS_CREASE = 32,   /* edges where the surface turns by `crease` or more */
    KTG_SEAMS_AUTO = 64 /* after these, where panels would strain beyond the limit, or more than
                           the fabric bears */
};

/* A panel whose grain runs otherwise than upright. */
typedef struct ktg_panel_grain {
    const char *panel; /* its name */
    double angle;      /* radians from upright, counter-clockwise on the printed side */
} ktg_panel_grain;

typedef struct ktg_flatten_options {
    ktg_flatten_method method;
    ktg_edge_weight weight; /* two-step: cotangents (default), raised to 1e-3 of the mean where
                               lower, or 1; the other methods know cotangents only */
    unsigned seams;         /* KTG_SEAMS_ flags; 0 (default): objects, groups, materials and marked
                               edges; auto as well where these give no seam and the model is no
                               disk, or where a panel folds or lies on itself */
    double crease;          /* radians; default 40 degrees */
    unsigned up;            /* which axis of the model is upright: 0 x, 1 y (default), 2 z */
    ktg_effort effort;      /* work on the choice of seams: quick a tenth of normal (default), best
                               four times as much */
    bool match_seams;       /* both sides of a seam become equally long; default true */
    double strain_limit;    /* of the report's area_beyond_limit and of KTG_SEAMS_AUTO, without
                               fabric; default 0.05 */
    const ktg_fabric *fabric;      /* what the cloth bears along and across the grain, or NULL */
    const ktg_panel_grain *grains; /* grain_count, borrowed */
    size_t grain_count;
} ktg_flatten_options;

KTG_API void ktg_flatten_defaults(ktg_flatten_options *options);

/* Strain is the larger of |s1 - 1| and |s2 - 1|, s the singular values of the map from the 3D
 * triangle; mean and percentile are weighted by area. */
typedef struct ktg_panel_report {
    ktg_flatten_method method; /* that made it: injective also where arap failed */
    uint32_t iterations;       /* of that method; two-step: 0 */
    uint32_t flipped_by_arap;  /* faces that arap folded before injective took its place */
    bool crossed_by_arap;      /* the same: arap folded none, but laid the panel on itself */
    uint32_t faces;
    uint32_t flipped_faces;     /* turned over, or less than a millionth of their area left */
    double area;                /* in the model's unit, in space */
    double arap_energy;         /* sum A ((s1 - 1)^2 + (s2 - 1)^2) / sum A, s2 signed */
    double symmetric_dirichlet; /* sum A (s1^2 + s2^2 + s1^-2 + s2^-2) / sum A, 4 at best; 0 where
                                   faces are flipped */
    double strain_mean, strain_p95, strain_max;
    double area_beyond_limit; /* part of the area strained more than the limit, or than the fabric
                                 bears, 0 to 1 */
    double border_error;      /* (2D - 3D) / 3D length of the border */
    double seconds;
} ktg_panel_report;

typedef struct ktg_flatten_report {
    ktg_panel_report whole;   /* all panels: sums, weighted means, the worst method; the percentile
                                 is of all faces together */
    uint32_t panel_count;     /* the pattern's pieces, in their order */
    ktg_panel_report *panels; /* panel_count; owned */
    double strain_limit;      /* the option */
    uint32_t panels_beyond;   /* with more than 5 % of their area beyond the limit */
    uint32_t seam_edges, opened_edges, auto_edges; /* cuts in all, and those made to open panels to
                                                      disks and by KTG_SEAMS_AUTO */
    double seam_error; /* largest difference of the two sides of an edge that is sewn, by the mean
                          of both */
    bool interrupted;  /* the caller wanted to finish, so that iterations ended early */
    double seconds;
} ktg_flatten_report;

/* Gives the panels back; the other figures stay. */
KTG_API void ktg_flatten_report_free(ktg_flatten_report *report);

/* "arap", "injective", "two-step". */
KTG_API const char *ktg_flatten_method_name(ktg_flatten_method method);

/* Flattens a mesh, as ktg_mesh_repair leaves it: takes it apart along its seams, cuts panels that
 * are no disks open, lays each flat, and makes both sides of every seam equally long. NULL options:
 * the defaults; report may be NULL, else it is freed by ktg_flatten_report_free, whatever the
 * status.
 *
 * The pattern (mode KTG_CLOTH) has a component for each connected part of the mesh and a piece for
 * each panel, in the model's unit, with face_strain. Pieces are named after the objects, groups or
 * materials they are, a single one `name`; ordered by their first faces. The lower left corner of a
 * piece's box is the origin. A piece is turned so that the model's upright axis (options->up)
 * points to its +y as well as it can (least squares over the area; of a panel that lies on the
 * ground, away from one who looks down), or by its grain, and never mirrored. Cloth is not folded
 * inside a panel: every edge there is KTG_EDGE_FLAT, with the surface's true dihedral angle; seams
 * are KTG_EDGE_CUT, forced.
 *
 * KTG_GEOMETRY says what is wrong: a mesh without faces, an edge of three, a face without area, a
 * panel a hundred thousand times as long as wide, faces that come out flipped or a flat shape that
 * lies on itself: what is printed never folds over. The report is filled in the last two cases as
 * well. KTG_ARGUMENT for unit weights without the two-step method, a grain for a panel that is not
 * there. When the caller wants to finish, iterations end early. KTG_CANCELLED, KTG_MEMORY.
 * *pattern: freed by ktg_pattern_free, NULL on failure. */
KTG_API KTG_NODISCARD ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh,
                                             const char *name, const ktg_flatten_options *options,
                                             ktg_pattern **pattern, ktg_flatten_report *report);

/* ---- handles ------------------------------------------------------------------------------ */

/* A flat shape that follows a few points of it, as rigidly as it can: sections 3 to 6 of the same
 * paper. docs/warp.md says what is done otherwise.
 *
 *     ktg_shape_register   the rest shape: both linear systems are factored
 *     ktg_shape_compile    which points are handles
 *     ktg_shape_update     where the handles are now: no factor, a few products and one solve
 *
 * A shape is used by one thread at a time. */
typedef struct ktg_shape ktg_shape;

/* A point of the shape: its place in a triangle, as parts of three vertices that add up to 1 (a
 * vertex itself: parts 1, 0, 0). */
typedef struct ktg_handle {
    uint32_t vertices[3];
    double parts[3];
    double weight; /* 0: the point is exactly where it is wanted; > 0: w of the paper's equation 1
                      (which says 1000), and the point is nearly there */
} ktg_handle;

/* Takes a mesh with z = 0 (or any other constant): one sheet of triangles in one part, holes are
 * fine, no face turned over. It is copied. Vertices that belong to no face stay where they are.
 * KTG_GEOMETRY says what it is instead. *shape: freed by ktg_shape_free, NULL on failure. */
KTG_API KTG_NODISCARD ktg_status ktg_shape_register(ktg_context *context, const ktg_mesh *rest,
                                                    ktg_edge_weight weight, ktg_shape **shape);
KTG_API void ktg_shape_free(ktg_shape **shape);

/* The handle at a point of the rest shape; a point outside by no more than 1e-6 of the shape's size
 * counts as on its border. KTG_GEOMETRY where it is further outside. */
KTG_API KTG_NODISCARD ktg_status ktg_shape_handle_at(ktg_context *context, const ktg_shape *shape,
                                                     ktg_vec2 point, ktg_handle *handle);
KTG_API ktg_handle ktg_handle_at_vertex(uint32_t vertex);

/* The handles (count, copied) take the place of those before. With one handle the shape is only
 * moved, with none it stays. KTG_ARGUMENT for a vertex that is not there, parts that do not add up
 * to 1, a weight below 0; KTG_GEOMETRY for handles in the same place; KTG_LIMIT where vertices x
 * handles go beyond 2^25. After a failure there are no handles. */
KTG_API KTG_NODISCARD ktg_status ktg_shape_compile(ktg_context *context, ktg_shape *shape,
                                                   const ktg_handle *handles, uint32_t count);

/* targets: where each handle is wanted; positions: vertex_count, out. KTG_ARGUMENT for a target
 * that is not finite. */
KTG_API KTG_NODISCARD ktg_status ktg_shape_update(ktg_context *context, ktg_shape *shape,
                                                  const ktg_vec2 *targets, ktg_vec2 *positions);

/* The first step alone, which lets the shape grow and shrink (the paper's figure 2, middle). */
KTG_API KTG_NODISCARD ktg_status ktg_shape_update_similar(ktg_context *context, ktg_shape *shape,
                                                          const ktg_vec2 *targets,
                                                          ktg_vec2 *positions);

/* Makes positions more rigid, by up to `rounds` steps of local/global iteration with the same
 * factor; handles keep their places. Ends early when the energy no longer falls. Most faces that
 * the two steps fold over come back. `rounds_done` may be NULL. */
KTG_API KTG_NODISCARD ktg_status ktg_shape_refine(ktg_context *context, ktg_shape *shape,
                                                  const ktg_vec2 *targets, uint32_t rounds,
                                                  ktg_vec2 *positions, uint32_t *rounds_done);

/* A way around folds: from the rest shape, turned as the handles ask for, these are led to their
 * targets such that no face loses its area, while the shape relaxes under the symmetric Dirichlet
 * energy. Slower (seconds at 20,000 vertices) and less rigid; ends early, without having arrived,
 * when the caller wants to finish. *arrived is false, and positions are as they were, where the
 * handles could not be brought there. */
KTG_API KTG_NODISCARD ktg_status ktg_shape_lead(ktg_context *context, ktg_shape *shape,
                                                const ktg_vec2 *targets, ktg_vec2 *positions,
                                                bool *arrived);

/* What positions do to the rest shape. */
typedef struct ktg_shape_report {
    uint32_t faces, folded_faces; /* turned over, or less than a millionth of their area left */
    uint32_t first_folded;        /* its number, or KTG_NONE */
    double energy;                /* sum A ((s1 - 1)^2 + (s2 - 1)^2) / sum A, s2 signed */
    double stretch_least, stretch_most; /* over all faces: s2 and s1 */
    double handle_error; /* the largest distance of a handle from where it is wanted */
} ktg_shape_report;

/* `folded`: face_count, true for folded faces, or NULL. */
KTG_API void ktg_shape_measure(const ktg_shape *shape, const ktg_vec2 *targets,
                               const ktg_vec2 *positions, bool *folded, ktg_shape_report *report);

/* Handles as a file names them, and where they are to go. */
typedef struct ktg_handle_list {
    uint32_t count;
    ktg_handle *handles;
    ktg_vec2 *targets;
    uint32_t *lines; /* where each stands */
} ktg_handle_list;

/* Reads a file of handles ("-": standard input), one on each line; # begins a comment:
 *
 *     vertex 17 -> 120 40          a vertex, numbered from 1, goes there
 *     at 30 55 -> 35 60            the point of the rest shape at 30 55 goes there
 *     vertex 17 by 10 -5           goes so far
 *     hold vertex 3                stays; also: hold at 30 55
 *     ... weight 1000              nearly, not exactly
 *
 * KTG_FILE, KTG_FORMAT with file and line: an unknown word, not a finite number, a number a million
 * times as large as the shape, no such vertex, outside the shape, the same place twice, no handle
 * at all. *list: freed by ktg_handle_list_free, whatever the status. */
KTG_API KTG_NODISCARD ktg_status ktg_handles_read(ktg_context *context, const char *path,
                                                  const ktg_shape *shape, ktg_handle_list *list);
KTG_API void ktg_handle_list_free(ktg_handle_list *list);

/* How a mesh is warped by a file of handles. */
typedef struct ktg_warp_options {
    ktg_edge_weight weight; /* cotangents (default), or 1 as in the paper */
    uint32_t refine;        /* rounds of refinement; KTG_NONE (default): only where faces fold over,
                               200 at most, and ktg_shape_lead where that does not help */
} ktg_warp_options;

KTG_API void ktg_warp_defaults(ktg_warp_options *options);

typedef struct ktg_warp_report {
    ktg_shape_report shape;
    uint32_t handles;
    uint32_t folded_before; /* faces that the two steps folded over */
    uint32_t rounds;        /* of refinement */
    bool led;               /* it took ktg_shape_lead to be without folds */
    bool crossed;           /* no face is folded, but the border crosses itself */
} ktg_warp_report;

/* Reads handles and moves the vertices of a flat mesh: register, compile, update, and refinement.
 * NULL options: the defaults; report may be NULL. Folded faces are only reported. On failure the
 * mesh is as it was. */
KTG_API KTG_NODISCARD ktg_status ktg_warp(ktg_context *context, ktg_mesh *mesh, const char *handles,
                                          const ktg_warp_options *options, ktg_warp_report *report);

#ifdef __cplusplus
}
#endif
#endif
