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

typedef enum ktg_edge_weight { KTG_WEIGHT_COTANGENT, KTG_WEIGHT_UNIT } ktg_edge_weight;

typedef struct ktg_flatten_options {
    ktg_flatten_method method;
    ktg_edge_weight weight; /* two-step: cotangents (default), raised to 1e-3 of the mean where
                               lower, or 1; the other methods know cotangents only */
    double strain_limit;    /* for the report's area_beyond_limit; default 0.05 */
} ktg_flatten_options;

KTG_API void ktg_flatten_defaults(ktg_flatten_options *options);

/* Strain is the larger of |s1 - 1| and |s2 - 1|, s the singular values of the map from the 3D
 * triangle; mean and percentile are weighted by area. */
typedef struct ktg_flatten_report {
    ktg_flatten_method method; /* that made it: injective also where arap failed */
    uint32_t iterations;       /* of that method; two-step: 0 */
    bool interrupted;          /* the caller wanted to finish, so that iterations ended early */
    uint32_t flipped_by_arap;  /* faces that arap folded before injective took its place */
    bool crossed_by_arap;      /* the same: arap folded none, but laid the panel on itself */
    uint32_t faces;
    uint32_t flipped_faces;     /* turned over, or less than a millionth of their area left */
    double arap_energy;         /* sum A ((s1 - 1)^2 + (s2 - 1)^2) / sum A, s2 signed */
    double symmetric_dirichlet; /* sum A (s1^2 + s2^2 + s1^-2 + s2^-2) / sum A, 4 at best; 0 where
                                   faces are flipped */
    double strain_mean, strain_p95, strain_max;
    double strain_limit, area_beyond_limit; /* the option; part of the area strained more, 0 to 1 */
    double border_error;                    /* (2D - 3D) / 3D length of the border */
    double seconds;
} ktg_flatten_report;

/* "arap", "injective", "two-step". */
KTG_API const char *ktg_flatten_method_name(ktg_flatten_method method);

/* Flattens a mesh, as ktg_mesh_repair leaves it, that is one topological disk. NULL options: the
 * defaults; report may be NULL.
 *
 * The pattern (mode KTG_CLOTH) has one component and one piece, both named `name`, in the model's
 * unit, with face_strain. Piece vertices are those of the mesh, in its order; the lower left corner
 * of their box is the origin. The piece is turned so that the model's y points to the piece's +y as
 * well as it can (least squares over the area; of a panel that lies on the ground, the model's -z,
 * as seen from above), and never mirrored. Cloth is neither folded nor cut inside a panel: every
 * inner edge is KTG_EDGE_FLAT, with the surface's true dihedral angle, every other one
 * KTG_EDGE_BORDER.
 *
 * KTG_GEOMETRY says what is wrong: a mesh that is not a disk (closed, several parts, more than one
 * border, a handle), a face without area, a panel a hundred thousand times as long as wide, faces
 * that come out flipped or a flat shape that lies on itself: what is printed never folds over. The
 * report is filled in the last two cases as well.
 * KTG_ARGUMENT for unit weights without the two-step method. When the caller wants to finish,
 * iterations end early. KTG_CANCELLED, KTG_MEMORY. *pattern: freed by ktg_pattern_free, NULL on
 * failure. */
KTG_API KTG_NODISCARD ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh,
                                             const char *name, const ktg_flatten_options *options,
                                             ktg_pattern **pattern, ktg_flatten_report *report);

#ifdef __cplusplus
}
#endif
#endif
