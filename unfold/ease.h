/* unfold/ease.h - how easy an arrangement is to glue (unfold only): the two copies of a cut edge
 * lie near each other, seams are few and long, nothing hangs by a short edge.
 *
 * The price is, times a weight,
 *     mean over the cut edges of the distance of their copies, over half of the sheet (1 where they
 *       are in two pieces)
 *     + LEAF / n times the ends of cuts inside the surface (each ends a seam)
 *     + WEAK / n times (1 - l / l0)^2 over the folds of a length l below l0,
 * where n is the number of faces. The distance is the published measure of how easy a net is to
 * assemble. */
#ifndef KTG_UNFOLD_EASE_H
#define KTG_UNFOLD_EASE_H

#include "unfold/arrangement.h"

typedef struct ktg_ease {
    const ktg_arrangement *a;
    double weight;
    double half;         /* of the sheet */
    double per_distance; /* weight over the number of cuts and half of the sheet */
    double leaf;         /* the price of an end of a cut, weighted */
    float *weak;         /* edge_count: the price of an edge as a fold, weighted */
    uint32_t *degree;    /* vertex_count: cuts at a vertex; those on a border count as many */
} ktg_ease;

/* For the cuts as they are. weight 0: everything costs nothing, and nothing is taken. short_edge:
 * l0. */
KTG_NODISCARD ktg_status ktg_ease_new(ktg_context *context, const ktg_arrangement *a, double weight,
                                      ktg_vec2 half, double short_edge, ktg_ease *ease);
void ktg_ease_free(ktg_ease *ease);

/* What it changes that the fold becomes a cut and the cut a fold, distances aside. */
double ktg_ease_cuts(const ktg_ease *ease, uint32_t fold, uint32_t cut);
/* That has happened. */
void ktg_ease_follow(ktg_ease *ease, uint32_t fold, uint32_t cut);

/* What a graft changes in the distances. */
double ktg_ease_distances(const ktg_ease *ease, const ktg_branch *branch, const ktg_graft *graft);

/* The whole price. */
double ktg_ease_price(const ktg_ease *ease);

#endif
