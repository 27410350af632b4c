/* flatten/flatten.h - from a curved panel to a flat one that strains as little as it can.
 *
 * Igarashi & Igarashi, "Implementing As-Rigid-As-Possible Shape Manipulation and Surface
 * Flattening" (JGT 2009), section 7: every edge's neighbourhood is laid flat, then two linear
 * solves: similarities, then scale adjustment. docs/flatten.md lists the paper's misprints and what
 * is done instead. */
#ifndef KTG_FLATTEN_FLATTEN_H
#define KTG_FLATTEN_FLATTEN_H

#include "core/core.h"
#include "mesh/mesh.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ktg_edge_weight { KTG_WEIGHT_COTANGENT, KTG_WEIGHT_UNIT } ktg_edge_weight;

typedef struct ktg_flatten_options {
    ktg_edge_weight weight; /* default: cotangent, raised to 1e-3 of the mean where lower */
} ktg_flatten_options;

KTG_API void ktg_flatten_defaults(ktg_flatten_options *options);

/* Strain is the larger of |s1 - 1| and |s2 - 1|, s the singular values of the map from the 3D
 * triangle; mean and percentile are weighted by area. */
typedef struct ktg_flatten_report {
    uint32_t faces, flipped_faces;
    double arap_energy; /* sum A ((s1 - 1)^2 + (s2 - 1)^2) / sum A, s2 signed */
    double strain_mean, strain_p95, strain_max;
    double border_error; /* (2D - 3D) / 3D length of the border */
    double seconds;
} ktg_flatten_report;

/* Flattens a mesh, as ktg_mesh_repair leaves it, that is one topological disk by the two-step
 * method. NULL options: the defaults; report may be NULL.
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
 * KTG_CANCELLED, KTG_MEMORY. *pattern: freed by ktg_pattern_free, NULL on failure. */
KTG_API KTG_NODISCARD ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh,
                                             const char *name, const ktg_flatten_options *options,
                                             ktg_pattern **pattern, ktg_flatten_report *report);

#ifdef __cplusplus
}
#endif
#endif
