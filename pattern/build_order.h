/* pattern/build_order.h - the order in which the seams of a paper model are glued (pattern only).
 *
 * The cuts of a piece are a tree on the surface: a seam at its leaf closes like a zip, and where
 * all seams but one at a node are closed that one is a leaf in its turn. So seams are glued from
 * the leaves towards a root, and the root is where the model is closed: on a large, flat face. Of
 * several pieces each is closed so towards its border, and then joined to what is built; pieces far
 * from the last one come first, so that limbs are whole before the trunk they join. */
#ifndef KTG_PATTERN_BUILD_ORDER_H
#define KTG_PATTERN_BUILD_ORDER_H

#include "pattern/topology.h"

/* Numbers under keys: items of key k are items[first[k]] .. items[first[k + 1] - 1], rising. */
typedef struct ktg_groups {
    uint32_t *first, *items;
} ktg_groups;

/* Seams that wait for a step of their own: a chain through ktg_build.next. */
typedef struct ktg_chain {
    uint32_t first, last;
    uint32_t weight, numbered; /* of its seams; how many of them have numbers */
} ktg_chain;

#define KTG_EMPTY_CHAIN ((ktg_chain){KTG_NONE, KTG_NONE, 0, 0})

/* Seams the model is closed with, all at once. */
#define KTG_CLOSING_MOST 4

/* Faces in nearly one plane, joined by folds. */
typedef struct ktg_patch {
    double area, low; /* low: 0 to 1, how much it looks down */
} ktg_patch;

typedef struct ktg_build {
    ktg_context *context;
    const ktg_topology *topology;
    const ktg_pattern *pattern;
    unsigned up;
    uint32_t part_count;             /* bodies: pieces that hang together by seams */
    uint32_t *part_of;               /* piece_count */
    ktg_groups pieces, seams, edges; /* of the parts; edges of the surface */
    ktg_groups edges_at;             /* of the surface's vertices */
    ktg_groups own;                  /* of the pieces: the seams of each with itself */
    uint32_t *patch_of;              /* face_count */
    ktg_patch *patches;              /* face_count */
    double *far;     /* vertex_count: over the surface's edges, from where the part is closed */
    bool *is_ground; /* vertex_count: on the border of the model or of its piece */

    /* the part being ordered */
    bool is_open; /* it has a border wide enough for a hand */
    uint32_t closing_count, closing[KTG_CLOSING_MOST];
    uint32_t last_piece;

    /* what has been ordered */
    uint32_t *next;       /* seam_count: chains */
    uint32_t *section_of; /* seam_count */
    uint32_t *order;      /* seam_count */
    bool *is_last;        /* seam_count: closes its part */
    uint32_t order_count, section_count;
    uint32_t least; /* weight of a step */
} ktg_build;

/* Puts the pattern's seams into that order, the obvious ones behind the others, and gives them
 * numbers and sections. */
KTG_NODISCARD ktg_status ktg_build_order(ktg_context *context, const ktg_topology *topology,
                                         unsigned up, ktg_pattern *pattern);

/* ---- groups: build_groups.c --------------------------------------------------------------- */

/* keys: item_count numbers below key_count, or KTG_NONE for items that belong nowhere. */
KTG_NODISCARD ktg_status ktg_groups_fill(ktg_context *context, const uint32_t *keys,
                                         uint32_t item_count, uint32_t key_count,
                                         ktg_groups *groups);
void ktg_groups_drop(ktg_groups *groups);

/* ---- chains: build_order.c ---------------------------------------------------------------- */

void ktg_chain_add(ktg_build *b, ktg_chain *chain, uint32_t seam);
/* `tail` goes behind `chain`, and is empty. */
void ktg_chain_join(ktg_build *b, ktg_chain *chain, ktg_chain *tail);
/* The chain's seams become a step, unless none has a number; it is empty then. */
void ktg_chain_flush(ktg_build *b, ktg_chain *chain);
/* What is left of a part, seams without numbers, goes to its last step, or makes one where all
 * steps up to `first_section` belong to other parts. */
void ktg_chain_end(ktg_build *b, ktg_chain *chain, uint32_t first_section);

/* ---- where a part is closed: build_closing.c, build_far.c --------------------------------- */

/* Fills patch_of and patches. */
KTG_NODISCARD ktg_status ktg_build_find_patches(ktg_build *b);
/* Chooses the seams that close a part and its last piece. */
void ktg_build_find_closing(ktg_build *b, uint32_t part);
/* Fills `far` for the vertices of a part. */
KTG_NODISCARD ktg_status ktg_build_find_far(ktg_build *b, uint32_t part);

bool ktg_build_is_closing(const ktg_build *b, uint32_t seam);
/* The surface's vertices at which a seam begins and ends. */
uint32_t ktg_seam_begin(const ktg_pattern *pattern, uint32_t seam);
uint32_t ktg_seam_end(const ktg_pattern *pattern, uint32_t seam);

/* ---- build_tree.c, build_pieces.c --------------------------------------------------------- */

/* Orders the seams of a piece with itself, from the leaves to the roots; what is too little for a
 * step is left in `rest`. */
KTG_NODISCARD ktg_status ktg_build_piece(ktg_build *b, uint32_t piece, ktg_chain *rest);
/* Orders the seams of all parts. */
KTG_NODISCARD ktg_status ktg_build_parts(ktg_build *b);

#endif
