/* unfold/seam_tab_room.h - the room that seams of an arrangement have for tabs (unfold/seam_tab*.c
 * only). */
#ifndef KTG_UNFOLD_SEAM_TAB_ROOM_H
#define KTG_UNFOLD_SEAM_TAB_ROOM_H

#include "unfold/seam_tabs.h"

/* p = origin + x along + y perp(along) */
typedef struct ktg_seam_frame {
    ktg_vec2 origin, along;
} ktg_seam_frame;

/* A shape in the way of a tab, in the tab's frame. */
typedef struct ktg_seam_obstacle {
    ktg_vec2 corners[4];
    uint32_t count;
} ktg_seam_obstacle;

static inline uint32_t ktg_seam_next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

static inline ktg_vec2 ktg_seam_from_frame(const ktg_seam_frame *f, ktg_vec2 p) {
    return ktg_madd2(ktg_madd2(f->origin, p.x, f->along), p.y, ktg_perp2(f->along));
}

static inline ktg_vec2 ktg_seam_to_frame(const ktg_seam_frame *f, ktg_vec2 p) {
    ktg_vec2 v = ktg_sub2(p, f->origin);
    return (ktg_vec2){ktg_dot2(v, f->along), ktg_cross2(f->along, v)};
}

/* Beside the face that carries the tab: against its half-edge. */
ktg_seam_frame ktg_seam_outer_frame(const ktg_arrangement *a, uint32_t halfedge);
/* Under the mate, in its flat region: along its half-edge. */
ktg_seam_frame ktg_seam_under_frame(const ktg_seam_tabs *t, uint32_t mate);

/* A face, or the tab of an edge, seen from a frame beside a piece. */
ktg_seam_obstacle ktg_seam_face_at(const ktg_seam_tabs *t, const ktg_seam_frame *f, uint32_t face);
ktg_seam_obstacle ktg_seam_tab_at(const ktg_seam_tabs *t, const ktg_seam_frame *f, uint32_t edge);
/* The tab glued under the region's side `side`, seen from a frame in the region; false when there
 * is none. */
bool ktg_seam_tab_under(const ktg_seam_tabs *t, const ktg_seam_frame *f, uint32_t side,
                        ktg_seam_obstacle *o);

/* True when the tab, in its own frame, comes near the obstacle. */
bool ktg_seam_is_hit(const ktg_seam_tabs *t, const ktg_trapezoid *shape,
                     const ktg_seam_obstacle *o);

/* The box of the shape on the sheet, `air` larger on all sides. */
ktg_flat_box ktg_seam_box_around(const ktg_trapezoid *shape, const ktg_seam_frame *outer,
                                 double air);

/* Fills t->slots to the wish. */
void ktg_seam_shape_slots(ktg_seam_tabs *t);

/* The best shape on one side of the edge, at most `part` of the height, beside faces and, on
 * request, other tabs; returns its price, 1 where there is none. */
double ktg_seam_find_shape(const ktg_seam_tabs *t, uint32_t edge, int side, bool by_tabs,
                           double part, ktg_trapezoid *shape);

/* The tab of edge e, on a face of the branch, lies on something outside of the branch. */
bool ktg_seam_lies_badly(const ktg_seam_tabs *t, const ktg_branch *branch, uint32_t e);

#endif
