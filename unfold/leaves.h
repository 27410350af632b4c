/* unfold/leaves.h - cut edges that will have no room for a tab wherever the faces lie (unfold
 * only).
 *
 * The cuts of a net form a tree over the surface's vertices. Where it ends, at a leaf, the last cut
 * opens by the vertex's Gaussian curvature and by nothing else: at a nearly flat vertex its two
 * sides stay so close that no tab fits between them. And some edges have no face beside them that
 * a tab would fit under. Both are told by the cuts alone, at the price of looking at four
 * vertices. */
#ifndef KTG_UNFOLD_LEAVES_H
#define KTG_UNFOLD_LEAVES_H

#include "unfold/seam_tabs.h"

typedef struct ktg_leaves {
    const ktg_dual *dual;
    double least, edge; /* height that a tab needs; shorter edges need none */
    double *curvature;  /* vertex_count: 2 pi less the angles */
    bool *open;         /* vertex_count: on a border or a forced cut: no leaf */
    uint32_t *degree;   /* vertex_count: cuts that end there */
    uint32_t *chain;    /* vertex_count: exclusive or of their numbers: the cut where it is one */
    float *hopeless;    /* edge_count: price of a cut that no face has room under */
    double price;       /* of all leaves and hopeless cuts; a missing tab is 1 */
} ktg_leaves;

/* Of the cuts of the arrangement as they are. slots: as ktg_seam_tabs has them. */
KTG_NODISCARD ktg_status ktg_leaves_new(ktg_context *context, const ktg_arrangement *a,
                                        const ktg_seam_tabs *tabs, ktg_leaves *leaves);
void ktg_leaves_free(ktg_leaves *leaves);

/* The fold becomes a cut, the cut a fold; returns what that changes in the price. The other way
 * round takes it back. */
double ktg_leaves_exchange(ktg_leaves *leaves, uint32_t fold, uint32_t cut);

#endif
