/* unfold/net.h - one spanning tree laid flat, with the pairs of faces that overlap (unfold only).
 *
 * The state of the transplant search: one piece always, conflicts allowed. Cutting a fold and
 * joining another edge moves one of the two sides as a rigid body. */
#ifndef KTG_UNFOLD_NET_H
#define KTG_UNFOLD_NET_H

#include "core/vec.h"
#include "unfold/dual.h"
#include "unfold/net_grid.h"
#include "unfold/net_tree.h"

/* Two overlapping faces, in the lists of both. */
typedef struct ktg_conflict {
    uint32_t faces[2];
    uint32_t next[2], previous[2]; /* in the list of faces[i]; KTG_NONE at the ends */
    uint32_t place;                /* where it stands in ktg_net.live */
} ktg_conflict;

typedef struct ktg_net {
    const ktg_dual *dual;
    ktg_net_tree tree;
    bool *folded;      /* edge_count: the tree's */
    ktg_vec2 *corners; /* 3 face_count */
    ktg_vec2 *turn;    /* face_count: cosine and sine from the dual's flat face to the one here */
    ktg_net_grid grid;
    ktg_conflict *conflicts; /* freed ones are chained through next[0] */
    size_t conflict_count, conflict_capacity;
    uint32_t free_conflict;
    uint32_t *live; /* live_count numbers of conflicts, so that one can be drawn at random */
    size_t live_count, live_capacity;
    uint32_t *first;  /* face_count: first conflict of each face */
    uint32_t *weight; /* face_count: a conflict counts 1 and what its two faces weigh; at first 0 */
    uint32_t *mark;   /* face_count: stamps */
    uint32_t stamp;
    uint32_t *queue; /* scratch, face_count: one side of a fold */
} ktg_net;

/* The net of the spanning tree `folded` (edge_count flags, copied), laid flat from face 0;
 * conflicts found. */
KTG_NODISCARD ktg_status ktg_net_new(ktg_context *context, const ktg_dual *dual, const bool *folded,
                                     ktg_net **net);
void ktg_net_free(ktg_net **net);

/* The half-edge of a dual edge that lies in the face, and the one across. */
static inline uint32_t ktg_net_own(const ktg_net *net, uint32_t edge, uint32_t face) {
    const uint32_t *pair = net->dual->edges[edge].halfedge;
    return pair[0] / 3 == face ? pair[0] : pair[1];
}
static inline uint32_t ktg_net_across(const ktg_net *net, uint32_t edge, uint32_t face) {
    const uint32_t *pair = net->dual->edges[edge].halfedge;
    return pair[0] / 3 == face ? pair[1] : pair[0];
}

/* A fresh number that no face is marked with. */
uint32_t ktg_net_stamp(ktg_net *net);

/* The folds on the way from face a to face b into path (room for face_count); returns how many. */
uint32_t ktg_net_path(const ktg_net *net, uint32_t a, uint32_t b, uint32_t *path);

/* One side of a fold, until the next transplant. */
typedef struct ktg_body {
    ktg_net_part part;
    uint32_t count;
    const uint32_t *faces; /* those of ktg_net_smaller_side: listed in the net's scratch ... */
    uint32_t stamp;        /* ... and marked */
} ktg_body;

static inline bool ktg_net_has(const ktg_net *net, const ktg_body *body, uint32_t face) {
    return ktg_net_part_has(&net->tree, &body->part, face);
}

/* The smaller side of a fold, whatever its size at the same cost. */
ktg_body ktg_net_side(const ktg_net *net, uint32_t fold);

/* The same with its faces listed and marked, until the next call. False, without that, when it has
 * more than `most` faces. */
bool ktg_net_smaller_side(ktg_net *net, uint32_t fold, uint32_t most, ktg_body *body);

/* The cut edges between the body, one side of `fold`, and the rest: where it could hang instead.
 * edges: room for three times the body's faces; returns how many. */
uint32_t ktg_net_rims(const ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t *edges);

/* One of those edges drawn at random; KTG_NONE when a few draws found none. */
uint32_t ktg_net_draw_rim(const ktg_net *net, const ktg_body *body, uint32_t fold,
                          ktg_random *random);

/* The edge `steps` further along the line where the body and the rest meet, from the fold on, in
 * one direction or the other: hung there the body moves little. KTG_NONE where the line ends at a
 * border before. */
uint32_t ktg_net_near_rim(const ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t steps,
                          bool forwards);

/* How many conflicts the body has with the rest now; more when its faces have weights. */
uint32_t ktg_net_conflicts_now(const ktg_net *net, const ktg_body *body);

/* The motion that brings the body's side of `edge` onto the rest's side. */
ktg_motion2 ktg_net_motion(const ktg_net *net, const ktg_body *body, uint32_t edge);

/* The same after the motion; stops counting above `most`. */
uint32_t ktg_net_conflicts_moved(const ktg_net *net, const ktg_body *body,
                                 const ktg_motion2 *motion, uint32_t most);

/* The same, but when a sample of a large body shows that there would be many more than `most` it is
 * taken at its word: anything above `most` is returned. */
uint32_t ktg_net_conflicts_guess(const ktg_net *net, const ktg_body *body,
                                 const ktg_motion2 *motion, uint32_t most);

/* Cuts `fold`, one of whose sides the body is, joins `edge` and moves the body. KTG_MEMORY only. */
KTG_NODISCARD ktg_status ktg_net_transplant(ktg_context *context, ktg_net *net,
                                            const ktg_body *body, uint32_t fold, uint32_t edge);

/* Lays everything flat anew from the tree and finds all conflicts: takes away the rounding of many
 * motions. */
KTG_NODISCARD ktg_status ktg_net_refresh(ktg_context *context, ktg_net *net);

#endif
