/* unfold/seam_tabs.h - tabs on the cut edges of an arrangement, kept while its branches move
 * (unfold only).
 *
 * A tab stands on one side of a cut edge and moves with the face that carries it. Placed tabs keep
 * clear of all faces, of each other, and of each other under the face they are glued to; what has
 * no room is missing, and has its price. A move and all tabs it changes are one attempt that is
 * kept or taken back. Shapes are those of pattern/tab_room.h. */
#ifndef KTG_UNFOLD_SEAM_TABS_H
#define KTG_UNFOLD_SEAM_TABS_H

#include "pattern/tab_room.h"
#include "unfold/arrangement.h"
#include "unfold/flats.h"

/* What tabs are wished for, in the arrangement's unit. */
typedef struct ktg_seam_tab_wish {
    double height, least; /* full height, and what is no tab below it */
    double edge;          /* shorter edges go without */
    double inset, air;    /* kept from the borders of the mate's face, and from everything else */
    double cot;           /* cotangent of the steepest flank angle */
    ktg_vec2 half;        /* half of the sheet: tabs that stand out of it cost more */
} ktg_seam_tab_wish;

/* The price of an edge whose tab is missing is 1, of one with a reduced tab between these. */
#define KTG_PRICE_REDUCED_LEAST 0.1
#define KTG_PRICE_REDUCED_MOST  0.35

typedef struct ktg_seam_tab {
    int side; /* which of the edge's half-edges carries it; -1: none */
    double price;
    ktg_trapezoid shape; /* in the edge's frame */
    uint32_t corner_count;
    ktg_vec2 corners[4]; /* on the sheet */
} ktg_seam_tab;

/* The tab a half-edge could carry if nothing stood beside it. */
typedef struct ktg_tab_slot_shape {
    bool usable;
    ktg_trapezoid under;
    ktg_tab_wish wish;
} ktg_tab_slot_shape;

typedef struct ktg_seam_tabs {
    ktg_arrangement *a;
    ktg_seam_tab_wish wish;
    ktg_flats flats;
    ktg_cells cells;           /* of the tabs, by their edges */
    uint32_t edge_count;       /* the dual's edges and its forced cuts */
    uint32_t *edge_of;         /* 3 face_count: edge of a half-edge, KTG_NONE: no seam for tabs */
    ktg_tab_slot_shape *slots; /* 3 face_count: by the half-edge that carries */
    ktg_seam_tab *tabs;        /* edge_count; folds have none and no price */
    double price;              /* of all */
    uint32_t *unhappy;         /* edges with a price */
    uint32_t *unhappy_place;   /* edge_count: KTG_NONE: not in the list */
    uint32_t unhappy_count;
    struct ktg_tab_before {
        uint32_t edge;
        ktg_seam_tab tab;
    } * before; /* what the present attempt has changed, each edge as it was at first */
    size_t before_count, before_capacity;
    uint32_t *stamp; /* edge_count: the attempt that an edge was last changed in */
    uint32_t attempt;
    uint32_t *damaged; /* edges whose tab has to be found anew */
    size_t damaged_count, damaged_capacity;
} ktg_seam_tabs;

/* The face that an edge's tab stands on; it must have one. */
static inline uint32_t ktg_seam_carrier(const ktg_seam_tabs *t, uint32_t e) {
    return t->a->dual->edges[e].halfedge[t->tabs[e].side] / 3;
}

/* Slots are known, but there are no tabs yet: ktg_seam_tabs_renew gives them. */
KTG_NODISCARD ktg_status ktg_seam_tabs_new(ktg_context *context, ktg_arrangement *a,
                                           const ktg_seam_tab_wish *wish, ktg_seam_tabs **tabs);
void ktg_seam_tabs_free(ktg_seam_tabs **tabs);

/* Takes all tabs away and gives every cut edge the best tab there is room for, one after the
 * other, to the wish. */
KTG_NODISCARD ktg_status ktg_seam_tabs_renew(ktg_context *context, ktg_seam_tabs *t,
                                             const ktg_seam_tab_wish *wish);

/* Begins an attempt. */
void ktg_seam_tabs_begin(ktg_seam_tabs *t);
/* Tabs outside the branch that its faces would lie on, moved as the graft says, become damaged. */
KTG_NODISCARD ktg_status ktg_seam_tabs_damage(ktg_context *context, ktg_seam_tabs *t,
                                              const ktg_branch *branch, const ktg_graft *graft);
/* After the branch has been grafted (it lies there now): its tabs follow it; `joined` loses its
 * tab, `cut` wants one; what is damaged is found anew. t->price is what it costs then; once that
 * must be more than `most`, the attempt is given up half-way and has to be taken back. */
KTG_NODISCARD ktg_status ktg_seam_tabs_follow(ktg_context *context, ktg_seam_tabs *t,
                                              const ktg_branch *branch, uint32_t joined,
                                              uint32_t cut, double most);
/* Finds a tab for the edge on that side, at most `part` of the full height, as if there were no
 * other tabs; those in its way are found anew around it. `most` as above. */
KTG_NODISCARD ktg_status ktg_seam_tabs_push(ktg_context *context, ktg_seam_tabs *t, uint32_t edge,
                                            int side, double part, double most);
/* The best tab of the edge beside all others. */
KTG_NODISCARD ktg_status ktg_seam_tabs_choose(ktg_context *context, ktg_seam_tabs *t,
                                              uint32_t edge);
/* Takes the attempt back; branches must lie where they did when it began. */
KTG_NODISCARD ktg_status ktg_seam_tabs_undo(ktg_context *context, ktg_seam_tabs *t);
/* The tabs of a branch's faces, after it has been moved without an attempt. */
KTG_NODISCARD ktg_status ktg_seam_tabs_lay(ktg_context *context, ktg_seam_tabs *t,
                                           const ktg_branch *branch);

#endif
