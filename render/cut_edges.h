/* render/cut_edges.h - the edges of the outlines on a sheet, split where they touch (render only).
 */
#ifndef KTG_RENDER_CUT_EDGES_H
#define KTG_RENDER_CUT_EDGES_H

#include "render/plot.h"
#include "render/weld.h"

/* Cuts nearer to each other than this are one: a blade or a beam is wider. */
#define KTG_CUT_TOGETHER_MM 0.02

typedef enum ktg_cut_state {
    KTG_CUT_LOOP, /* of an outline or a hole */
    KTG_CUT_SLIT, /* walked on both sides: the first time */
    KTG_CUT_DONE  /* or cut elsewhere */
} ktg_cut_state;

typedef struct ktg_cut_edge {
    uint32_t a, b; /* points of the weld */
    uint32_t walk; /* whose outline it is of */
    ktg_cut_state state;
} ktg_cut_edge;

/* Starts with the weld's context and tolerance set, the rest 0; free with ktg_cut_edges_drop. */
typedef struct ktg_cut_edges {
    ktg_weld weld;
    size_t count, capacity;
    ktg_cut_edge *items; /* walk after walk, as they are walked */
} ktg_cut_edges;

/* Appends the outline of a placed piece. */
KTG_NODISCARD ktg_status ktg_cut_edges_enter(ktg_cut_edges *edges, uint32_t walk,
                                             const ktg_pattern_placement *at,
                                             const ktg_pattern_piece *piece);
/* Splits edges where another edge's end lies on them. */
KTG_NODISCARD ktg_status ktg_cut_edges_split(ktg_cut_edges *edges);
/* Tells slits and what is cut already from the rest. */
KTG_NODISCARD ktg_status ktg_cut_edges_match(ktg_cut_edges *edges);
void ktg_cut_edges_drop(ktg_cut_edges *edges);

#endif
