/* unfold/net_tree.h - the tree of a net, kept so that either side of a fold is found at once
 * (unfold only).
 *
 * Faces are listed in preorder: what hangs from a face follows it in one run. So one side of a fold
 * is a run, the other is the rest, and whether a face belongs to it is a comparison. Hanging a part
 * elsewhere costs what the part has, the ways to the root, and moving numbers in the list.
 * There may be several trees, one after the other. */
#ifndef KTG_UNFOLD_NET_TREE_H
#define KTG_UNFOLD_NET_TREE_H

#include "unfold/dual.h"

typedef struct ktg_net_tree {
    const ktg_dual *dual;
    bool *folded;        /* edge_count: the edges of the tree */
    uint32_t *neighbour; /* 3 face_count: the face across each fold, KTG_NONE where there is none */
    uint32_t *parent;    /* face_count: KTG_NONE at a root */
    uint32_t *parent_edge; /* face_count: the dual edge to it */
    uint32_t *below;       /* face_count: how many hang from this one, itself included */
    uint32_t *order;       /* face_count: preorder */
    uint32_t *place;       /* face_count: where a face is in it */
    uint32_t *scratch;     /* face_count */
} ktg_net_tree;

/* Some faces of the list: `count` of them from place `first` on, leaving out `gap` places from
 * place `gap_first` on. */
typedef struct ktg_net_part {
    uint32_t first, count, gap_first, gap;
} ktg_net_part;

/* folded: edge_count flags, copied. */
KTG_NODISCARD ktg_status ktg_net_tree_new(ktg_context *context, const ktg_dual *dual,
                                          const bool *folded, ktg_net_tree *tree);
void ktg_net_tree_free(ktg_net_tree *tree);

static inline bool ktg_net_part_has(const ktg_net_tree *tree, const ktg_net_part *part,
                                    uint32_t face) {
    uint32_t place = tree->place[face];
    return (place - part->first < part->count + part->gap) & !(place - part->gap_first < part->gap);
}

/* Its k-th face. */
static inline uint32_t ktg_net_part_face(const ktg_net_tree *tree, const ktg_net_part *part,
                                         uint32_t k) {
    uint32_t place = part->first + k;
    return tree->order[place < part->gap_first ? place : place + part->gap];
}

/* The smaller side of a fold. */
ktg_net_part ktg_net_tree_side(const ktg_net_tree *tree, uint32_t fold);

/* The folds on the way from face a to face b of the same tree into path (room for face_count);
 * returns how many. */
uint32_t ktg_net_tree_path(const ktg_net_tree *tree, uint32_t a, uint32_t b, uint32_t *path);

/* Cuts `fold`, one of whose sides the part is, and joins `edge`, which leads from the part to
 * another face. */
void ktg_net_tree_hang(ktg_net_tree *tree, const ktg_net_part *part, uint32_t fold, uint32_t edge);

#endif
