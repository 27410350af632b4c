/* unfold/lay.h - laying a face flat against its neighbour (unfold only). */
#ifndef KTG_UNFOLD_LAY_H
#define KTG_UNFOLD_LAY_H

#include "core/vec.h"
#include "unfold/dual.h"

/* The turn that the face of half-edge `own` has when it lies against half-edge `other`, whose face
 * has the turn `there` (cosine and sine from the dual's flat face): from the edge's vectors in both
 * faces' own frames, which are precise however short the edge is. */
static inline ktg_vec2 ktg_lay_turn(const ktg_dual *dual, ktg_vec2 there, uint32_t other,
                                    uint32_t own) {
    ktg_vec2 from = dual->flat_vectors[own], v = dual->flat_vectors[other];
    ktg_vec2 along = {-(there.x * v.x - there.y * v.y), -(there.y * v.x + there.x * v.y)};
    return ktg_unit2((ktg_vec2){ktg_dot2(from, along), ktg_cross2(from, along)});
}

/* The motion with a given turn that brings the middle of a - b to the middle of A - B. */
static inline ktg_motion2 ktg_lay_motion(ktg_vec2 turn, ktg_vec2 a, ktg_vec2 b, ktg_vec2 A,
                                         ktg_vec2 B) {
    ktg_motion2 m = {turn.x, turn.y, {0, 0}};
    m.t = ktg_sub2(ktg_mul2(ktg_add2(A, B), 0.5), ktg_move2(m, ktg_mul2(ktg_add2(a, b), 0.5)));
    return m;
}

#endif
