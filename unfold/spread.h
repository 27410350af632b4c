/* unfold/spread.h - how far the faces of an arrangement lie from the middle of their sheets (unfold
 * only).
 *
 * The spread is the mean over the area of |x / a|^p + |y / b|^p, where 2 a x 2 b is the sheet's
 * printable area. A low power draws everything to the middle; a high one lets the inner faces be
 * and pushes what stands out. */
#ifndef KTG_UNFOLD_SPREAD_H
#define KTG_UNFOLD_SPREAD_H

#include "unfold/arrangement.h"

typedef struct ktg_spread {
    const ktg_arrangement *a;
    ktg_vec2 per; /* 1 / a, 1 / b */
    int power;    /* of two, at least 2 */
    double *area; /* face_count: over the area of all */
    double *cost; /* face_count: what each face costs where it lies */
    double total;
} ktg_spread;

/* The area of all faces of a dual graph. */
double ktg_dual_area(const ktg_dual *dual);

/* half: a and b. Costs are those of power 4. */
KTG_NODISCARD ktg_status ktg_spread_new(ktg_context *context, const ktg_arrangement *a,
                                        ktg_vec2 half, ktg_spread *spread);
void ktg_spread_free(ktg_spread *spread);

/* Counts everything anew, with another power. */
void ktg_spread_recount(ktg_spread *spread, int power);

/* What a graft would change. False when that is more than `allowed`, which is found out early.
 * Adds the faces looked at to *work. */
bool ktg_spread_allows(const ktg_spread *spread, const ktg_branch *branch, const ktg_graft *graft,
                       double allowed, double *change, uint64_t *work);
/* The branch lies elsewhere now. */
void ktg_spread_follow(ktg_spread *spread, const ktg_branch *branch);

/* Turns every piece as it spreads least. */
KTG_NODISCARD ktg_status ktg_spread_pose(ktg_context *context, ktg_arrangement *a,
                                         ktg_spread *spread);

#endif
