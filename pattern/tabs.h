/* pattern/tabs.h - glue tabs: the places they could take, and which take them (pattern only).
 *
 * A slot is one side of one cut edge: slot 2 c + s is side s of the c-th cut edge. Its room is what
 * the faces leave of the tab that is wished for; two slots are in conflict where their rooms come
 * near each other, outside their piece or under the flat region they are glued to. Placing then
 * only has to look at rooms and conflicts. */
#ifndef KTG_PATTERN_TABS_H
#define KTG_PATTERN_TABS_H

#include "pattern/grid.h"
#include "pattern/tab_room.h"
#include "pattern/topology.h"

/* What scissors need between a tab and anything else of its piece, and what they like, in mm. The
 * same is kept between two tabs under one face. */
#define KTG_TAB_AIR_LEAST_MM 0.1
#define KTG_TAB_AIR_MM       0.3

typedef enum ktg_tab_layer {
    KTG_LAYER_OUTSIDE, /* where the tab is cut: beside the piece that carries it */
    KTG_LAYER_UNDER    /* where it is glued: under the mate's piece */
} ktg_tab_layer;

/* The edge's frame in a piece: p = origin + x along + y perp(along). */
typedef struct ktg_tab_frame {
    ktg_vec2 origin, along;
    uint32_t piece;
} ktg_tab_frame;

static inline ktg_vec2 ktg_from_frame(const ktg_tab_frame *f, ktg_vec2 p) {
    return ktg_madd2(ktg_madd2(f->origin, p.x, f->along), p.y, ktg_perp2(f->along));
}

static inline ktg_vec2 ktg_to_frame(const ktg_tab_frame *f, ktg_vec2 p) {
    ktg_vec2 v = ktg_sub2(p, f->origin);
    return (ktg_vec2){ktg_dot2(v, f->along), ktg_cross2(f->along, v)};
}

typedef struct ktg_tab_slot {
    bool usable;             /* room holds a tab */
    uint32_t halfedge, mate; /* of the side that would carry the tab, and of the other one */
    ktg_tab_frame frames[2]; /* by layer */
    ktg_tab_wish wish;       /* the height is what fits under the mate's face */
    ktg_trapezoid room;      /* what the faces leave */
    uint32_t conflict_first; /* its conflicts: conflict_first .. the next slot's */
} ktg_tab_slot;

typedef struct ktg_tab_conflict {
    uint32_t slot;
    ktg_tab_layer layer;
} ktg_tab_conflict;

/* Which tabs there are: one entry per cut edge. */
typedef struct ktg_tab_choice {
    int side; /* -1: no tab */
    ktg_trapezoid shape;
    double score;
} ktg_tab_choice;

typedef struct ktg_tab_plan {
    const ktg_topology *topology;
    const ktg_finish_options *options;
    uint32_t cut_count;
    uint32_t *cuts;      /* cut_count: index into edges */
    ktg_tab_slot *slots; /* 2 cut_count + 1, the last one only ends the conflicts */
    ktg_tab_conflict *conflicts;
    uint8_t *preferred;      /* cut_count: the side the policy wants */
    ktg_tab_choice *choices; /* cut_count */
    ktg_vec2 *shifts;        /* piece_count: moves the pieces apart, for the grids */
} ktg_tab_plan;

/* Slots and their rooms (tab_slots.c), conflicts (tab_conflicts.c), choices (tab_place.c). */
KTG_NODISCARD ktg_status ktg_tab_plan_slots(ktg_context *context, ktg_tab_plan *plan);
KTG_NODISCARD ktg_status ktg_tab_plan_conflicts(ktg_context *context, ktg_tab_plan *plan);
KTG_NODISCARD ktg_status ktg_tab_plan_place(ktg_context *context, ktg_tab_plan *plan);

/* Places the tabs of a paper pattern whose seams are known: pieces' tabs (in the order of their
 * borders) and edges' tab_on, replacing what was there; counts them into *report. */
KTG_NODISCARD ktg_status ktg_tabs_place(ktg_context *context, const ktg_topology *topology,
                                        const ktg_finish_options *options, ktg_pattern *pattern,
                                        ktg_finish_report *report);

#endif
