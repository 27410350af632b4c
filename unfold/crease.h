/* unfold/crease.h - how sharply a surface folds at its edges (unfold only). */
#ifndef KTG_UNFOLD_CREASE_H
#define KTG_UNFOLD_CREASE_H

#include "unfold/dual.h"

/* Faces that turn by less are in one plane (radians): more than single precision makes of a plane,
 * less than paper shows. */
#define KTG_FLAT_FOLD 1e-3

/* The signed turn between the outward normals of an edge's two faces; positive: a mountain. */
double ktg_dual_angle(const ktg_dual *dual, const ktg_dual_edge *edge);

/* How natural a border between pieces is there: from 0 on a flat edge to 1; valleys count twice, as
 * people see the parts of a thing divided by them (the minima rule). */
double ktg_dual_crease(const ktg_dual *dual, const ktg_dual_edge *edge);

#endif
