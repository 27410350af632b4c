/* flatten/shape.h - the inside of a shape with handles, and what its parts hand each other (this
 * room only).
 *
 * Positions are normalised as in ktg_panel: moved and scaled by a power of two. A shape whose faces
 * run clockwise is seen from behind (y negated), so that inside they run counter-clockwise.
 *
 * Both steps minimise a sum of squares E(z) under B z = c, B the handles' rows. With E = z* H z and
 * a solution operator H- of the system with an anchor or two removed, z = Z l + N a, where Z = H-
 * B* and N spans what costs nothing: similarities in step 1, shifts in step 2. The numbers l, a
 * solve the dense system
 *
 *     ( B Z + 1/w  B N ) (l)   (c)
 *     ( (B N)*     0   ) (a) = (0)
 *
 * in which 1/w is 0 for an exact handle. So the factors depend on the rest shape alone, and step 1
 * needs no solve when handles move. */
#ifndef KTG_FLATTEN_SHAPE_H
#define KTG_FLATTEN_SHAPE_H

#include "core/sparse.h"
#include "core/vec.h"
#include "flatten/iterate.h"

/* ---- dense.c ------------------------------------------------------------------------------ */

/* A small complex matrix, factored with row pivoting. */
typedef struct ktg_dense {
    uint32_t n;
    ktg_vec2 *a;   /* n x n, row by row: L and U */
    uint32_t *row; /* n: which row of the right-hand side comes k-th */
} ktg_dense;

/* Factors `dense` (n and a are set). *singular: the first column that depends on those before it,
 * or KTG_NONE. */
KTG_NODISCARD ktg_status ktg_dense_factor(ktg_context *context, ktg_dense *dense,
                                          uint32_t *singular);
void ktg_dense_solve(const ktg_dense *dense, const ktg_vec2 *right, ktg_vec2 *solution);
void ktg_dense_drop(ktg_dense *dense);

/* ---- the shape ---------------------------------------------------------------------------- */

/* An edge for step 2: the turn that positions z give it is sum factors[k] z[vertices[k]], up to a
 * positive factor, and its flat vector, turned, pulls with `pull` = 2 weight length. */
typedef struct ktg_shape_edge {
    uint32_t vertices[4];
    ktg_vec2 factors[4];
    double pull;
} ktg_shape_edge;

struct ktg_shape {
    ktg_mesh *mesh;              /* a copy, counter-clockwise */
    ktg_panel *panel;            /* of it */
    ktg_rest *rests;             /* face_count */
    double side;                 /* -1: seen from behind */
    ktg_vec2 origin;             /* a position p is origin + scale x (normalised), y times side */
    double scale;                /* a power of two */
    ktg_vec2 *given;             /* vertex_count: rest positions as they came */
    ktg_vec2 *rest;              /* vertex_count, normalised */
    ktg_vec2 *centred;           /* vertex_count: the same about their middle, 0 where unused */
    uint32_t *number1, *number2; /* vertex_count: unknowns of both steps; KTG_NONE for anchors and
                                    for vertices without faces */
    uint32_t count1, count2;
    ktg_shape_edge *edges; /* edge_count of the panel's adjacency */
    ktg_factor *factor1, *factor2;

    uint32_t handle_count;
    ktg_handle *handles;  /* handle_count */
    ktg_vec2 *responses1; /* vertex_count x handle_count, column by column: Z of step 1 */
    double *responses2;   /* the same of step 2 */
    double size1, size2;  /* by which they were multiplied */
    ktg_dense dense1, dense2;

    double *right;    /* 2 vertex_count, workspace */
    ktg_vec2 *pulls;  /* vertex_count, workspace */
    ktg_vec2 *now;    /* vertex_count, workspace */
    ktg_vec2 *wanted; /* handle_count, workspace */
    ktg_vec2 *forces; /* 2 (handle_count + 2), workspace */
};

/* handles.c */
void ktg_shape_drop_handles(ktg_shape *shape);

/* Two handles in the same place of the rest shape, or KTG_NONE. */
KTG_NODISCARD ktg_status ktg_handles_find_twice(ktg_context *context, const ktg_shape *shape,
                                                const ktg_handle *handles, uint32_t count,
                                                uint32_t twice[2]);

/* update.c: targets, normalised, to shape->wanted; */
KTG_NODISCARD ktg_status ktg_shape_take_targets(ktg_context *context, ktg_shape *shape,
                                                const ktg_vec2 *targets);
/* y: L y = shape->pulls, which add up to 0, with the anchor in the origin; */
KTG_NODISCARD ktg_status ktg_shape_answer_pulls(ktg_context *context, ktg_shape *shape,
                                                ktg_vec2 *y);
/* adds to y what brings the handles from where it has them to shape->wanted; */
void ktg_shape_bring_handles(ktg_shape *shape, ktg_vec2 *y);
/* positions as the caller knows them. */
void ktg_shape_give(const ktg_shape *shape, const ktg_vec2 *z, ktg_vec2 *positions);

static inline ktg_vec2 ktg_shape_inward(const ktg_shape *s, ktg_vec2 p) {
    return (ktg_vec2){(p.x - s->origin.x) / s->scale, s->side * (p.y - s->origin.y) / s->scale};
}
static inline ktg_vec2 ktg_shape_outward(const ktg_shape *s, ktg_vec2 p) {
    return (ktg_vec2){s->origin.x + s->scale * p.x, s->origin.y + s->side * s->scale * p.y};
}
static inline ktg_vec2 ktg_handle_place(const ktg_handle *h, const ktg_vec2 *z) {
    ktg_vec2 sum = ktg_mul2(z[h->vertices[0]], h->parts[0]);
    sum = ktg_madd2(sum, h->parts[1], z[h->vertices[1]]);
    return ktg_madd2(sum, h->parts[2], z[h->vertices[2]]);
}

#endif
