/* unfold/arrangement.h - pieces without overlaps on their sheets, as annealing sees them: a forest
 * of the dual graph laid flat, and tabs on its cut edges (unfold only).
 *
 * The faces of each tree stand in preorder, so that whatever hangs below a fold is one stretch of
 * `order`: a body costs nothing to find, a face is in it when its place is in the stretch. Each
 * piece lies on a sheet of its own, whose middle is the origin. Lengths are normalised as in
 * unfold/dual.h. */
#ifndef KTG_UNFOLD_ARRANGEMENT_H
#define KTG_UNFOLD_ARRANGEMENT_H

#include "core/vec.h"
#include "unfold/cells.h"
#include "unfold/dual.h"

/* Faces may overlap by this much: less than KTG_OVERLAP_DEPTH, so that laying flat anew at the end
 * finds nothing that rounding has hidden. */
#define KTG_ARRANGEMENT_DEPTH 3e-8

typedef struct ktg_arrangement {
    const ktg_dual *dual;
    uint32_t piece_count;
    bool *folded;          /* edge_count: the forest */
    uint32_t *parent_edge; /* face_count: dual edge towards the root; KTG_NONE at a root */
    uint32_t *order;       /* face_count: faces in preorder, piece after piece */
    uint32_t *place;       /* face_count: where a face stands in `order` */
    uint32_t *size;        /* face_count: faces in the subtree */
    uint32_t *piece;       /* face_count */
    ktg_vec2 *corners;     /* 3 face_count: on the piece's sheet */
    ktg_vec2 *turn;        /* face_count: cosine and sine from the dual's flat face */
    ktg_vec2 half;         /* half of the region that cells are made for */
    ktg_cells cells;       /* of the faces */
    uint32_t *scratch;     /* 3 face_count */
    double gap; /* faces without a common vertex conflict when they are nearer than this; 0: when
                   they overlap */
} ktg_arrangement;

/* A subtree that may be hung elsewhere: faces order[first] .. order[first + count - 1]. */
typedef struct ktg_branch {
    uint32_t top; /* its uppermost face; parent_edge[top] is its fold */
    uint32_t first, count;
} ktg_branch;

/* Where it could hang: across `edge`, whose half-edge `own` is in the branch. */
typedef struct ktg_graft {
    uint32_t edge, own, other;
    ktg_motion2 motion;
} ktg_graft;

/* How a branch lay; the arrays have room for face_count. */
typedef struct ktg_saved {
    uint32_t fold, own, other; /* the edge it hung from, and that edge's half-edges */
    uint32_t *faces;
    ktg_vec2 *corners; /* 3 for each face */
    ktg_vec2 *turns;
} ktg_saved;

/* The trees of `folded` (edge_count flags, a forest, copied), each laid flat on a sheet of its own
 * with its middle in the sheet's. Trees are pieces in the order of their lowest faces. half: half
 * of the region that cells are made for. */
KTG_NODISCARD ktg_status ktg_arrangement_new(ktg_context *context, const ktg_dual *dual,
                                             const bool *folded, ktg_vec2 half,
                                             ktg_arrangement **arrangement);
void ktg_arrangement_free(ktg_arrangement **arrangement);

/* Empty cells like those of the faces, for other things on the same sheets. */
KTG_NODISCARD ktg_status ktg_arrangement_cells(ktg_context *context, const ktg_arrangement *a,
                                               uint32_t item_count, ktg_cells *cells);

static inline uint32_t ktg_arrangement_across(const ktg_arrangement *a, uint32_t edge,
                                              uint32_t halfedge) {
    const uint32_t *pair = a->dual->edges[edge].halfedge;
    return pair[0] == halfedge ? pair[1] : pair[0];
}

static inline ktg_branch ktg_branch_at(const ktg_arrangement *a, uint32_t face) {
    return (ktg_branch){face, a->place[face], a->size[face]};
}

static inline bool ktg_branch_holds(const ktg_arrangement *a, const ktg_branch *b, uint32_t face) {
    return a->place[face] - b->first < b->count; /* wraps where it stands before */
}

/* Middle of the area of a piece's faces. */
ktg_vec2 ktg_arrangement_middle(const ktg_arrangement *a, uint32_t piece);

/* Computes graft->motion from edge, own and other. */
void ktg_graft_motion(const ktg_arrangement *a, ktg_graft *graft);

/* How many pairs of a face of the branch, moved to where the graft hangs it, and a face outside
 * would overlap; stops counting above `most`. Without a graft: how many do now. Starts with the
 * faces next to the graft, which are the most likely. */
uint32_t ktg_graft_conflicts(const ktg_arrangement *a, const ktg_branch *branch,
                             const ktg_graft *graft, uint32_t most);

/* Hangs the branch there: tree, coordinates, cells; *branch is its new stretch. The old fold
 * becomes a cut. KTG_MEMORY only. */
KTG_NODISCARD ktg_status ktg_arrangement_graft(ktg_context *context, ktg_arrangement *a,
                                               ktg_branch *branch, const ktg_graft *graft);

/* Takes a graft back: the branch hangs from the edge that was its fold again, and its faces lie
 * where they did to the last digit. saved: what ktg_branch_save kept before the graft. */
KTG_NODISCARD ktg_status ktg_arrangement_ungraft(ktg_context *context, ktg_arrangement *a,
                                                 ktg_branch *branch, const ktg_saved *saved);
void ktg_branch_save(const ktg_arrangement *a, const ktg_branch *branch, ktg_saved *saved);

/* Moves a whole piece on its sheet. */
KTG_NODISCARD ktg_status ktg_arrangement_move(ktg_context *context, ktg_arrangement *a,
                                              uint32_t piece, ktg_motion2 motion);

/* The tree alone (arrange_tree.c): gives every tree a root from which no subtree holds more than
 * half of it, and lists everything anew. */
void ktg_arrangement_order(ktg_arrangement *a);
/* Numbers the pieces by the order of their trees. */
void ktg_arrangement_number(ktg_arrangement *a);
/* Hangs the branch, whose face `own` goes below the face `other`, elsewhere; updates parents,
 * order, places, sizes, pieces. */
void ktg_arrangement_rehang(ktg_arrangement *a, ktg_branch *branch, uint32_t edge, uint32_t own,
                            uint32_t other);

/* Lays every face flat anew from the roots, which stay where they are: takes away the rounding of
 * many motions. */
KTG_NODISCARD ktg_status ktg_arrangement_settle(ktg_context *context, ktg_arrangement *a);

#endif
