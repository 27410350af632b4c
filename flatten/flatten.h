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
    ktg_edge_weight weight; /* default: cotangent, clamped from below at 1e-3 of the mean */
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

/* Flattens a mesh that is one topological disk (KTG_GEOMETRY says what it is instead: closed,
 * several components, more than one border, a handle) by the two-step method. The pattern (mode
 * KTG_CLOTH) has one piece, in the model's unit, named `name`, with face_strain; its largest extent
 * lies along y, upright as in the model. KTG_GEOMETRY when faces come out flipped: what is printed
 * never folds over. */
KTG_API KTG_NODISCARD ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh,
                                             const char *name, const ktg_flatten_options *options,
                                             ktg_pattern **pattern, ktg_flatten_report *report);

#ifdef __cplusplus
}
#endif
#endif
