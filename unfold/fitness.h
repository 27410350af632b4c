/* unfold/fitness.h - section 5.4: how good a set of patches is (unfold only). */
#ifndef KTG_UNFOLD_FITNESS_H
#define KTG_UNFOLD_FITNESS_H

#include "pattern/pattern.h"
#include "unfold/patches.h"

/* f = N_p - 1 / A_s - T_l / T_t, to be minimised: patches, sheet area over the area of all faces
 * (so that f has no unit), faces in the largest patch over all faces. The sheet is that of rows by
 * height (Igarashi & Cosgrove 2001). `boxes` is scratch for dual->face_count boxes. KTG_MEMORY. */
KTG_NODISCARD ktg_status ktg_fitness(ktg_context *context, const ktg_patches *patches,
                                     ktg_row_box *boxes, double *fitness);

#endif
