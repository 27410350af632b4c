/* layout/nest_state.h - what the nesting search works on (layout/nest*.c only).
 *
 * The search is guided local search on overlaps (Egeblad, Nielsen & Odgaard 2007; Umetani et al.
 * 2009; Gardeyn, Vanden Berghe & Wauters 2025): covers may overlap, each overlapping pair has a
 * loss, and weights on the pairs rise until it is resolved. */
#ifndef KTG_LAYOUT_NEST_STATE_H
#define KTG_LAYOUT_NEST_STATE_H

#include "core/random.h"
#include "core/vec.h"
#include "layout/nest.h"

#define NEST_MOST_POLES 32

/* Inscribed circles that stand for a polygon when an overlap is measured. */
typedef struct nest_poles {
    float *x, *y, *radius;  /* padded: far away and of radius 0 from count on */
    uint32_t count, padded; /* padded is a multiple of 4 */
} nest_poles;

/* A shape in its own frame, with the middle of its box in the origin. */
typedef struct nest_shape {
    ktg_vec2 middle;   /* of the frame, in the caller's */
    ktg_vec2 *corners; /* corner_count + 1: the cover, closed */
    uint32_t corner_count;
    ktg_vec2 *hull; /* hull_count: of the outline */
    uint32_t hull_count;
    nest_poles poles;
    double diameter; /* of the cover's box */
    double size;     /* square root of the area of the cover's box */
    double area;     /* of the cover */
    const double *turns;
    uint32_t turn_count;
    double box_turn; /* where the box is smallest, for shapes that turn freely */
} nest_shape;

/* A turn of a shape and the boxes around its outline and its cover then. */
typedef struct nest_turn {
    double angle, c, s;
    ktg_vec2 low, high, cover_low, cover_high;
} nest_turn;

/* A place for an item: turn and the position of its frame's origin. */
typedef struct nest_pose {
    uint32_t bin;
    nest_turn turn;
    ktg_vec2 at;
} nest_pose;

typedef struct nest_box {
    ktg_vec2 low, high;
} nest_box;

/* A shape as it lies. */
typedef struct nest_body {
    const nest_shape *shape;
    nest_pose pose;
    ktg_vec2 *corners; /* corner_count + 1 */
    float pole_x[NEST_MOST_POLES], pole_y[NEST_MOST_POLES];
} nest_body;

typedef struct nest_state {
    ktg_context *context;
    const ktg_nest_problem *problem;
    nest_shape *shapes;
    uint32_t item_count;
    nest_body *bodies; /* item_count, and one more to try positions with */
    nest_box *boxes;   /* likewise: of the covers */
    uint32_t *bins;    /* item_count */
    uint32_t *doubts;  /* item_count: pairs whose poles do not tell whether they overlap */
    float *depths;     /* item_count: their losses, if they do */
    uint32_t bin_count;
    double last_length; /* of the last bin */
    float *losses;      /* item_count^2, symmetric: of each pair as it lies */
    float *weights;     /* likewise */
    uint32_t *order;    /* item_count */
    uint32_t *window;   /* sides of a polygon that lie where two boxes meet */
    nest_pose *kept;    /* item_count: the best of a separation */
    ktg_random random;
    uint64_t work, work_limit;
    double started; /* clock */
    bool finish;    /* the caller, or the clock, wants an end */
} nest_state;

/* ---- shapes (nest_shape.c, nest_poles.c) -------------------------------------------------- */

KTG_NODISCARD ktg_status ktg_nest_shape_make(ktg_context *context, const ktg_nest_shape *from,
                                             nest_shape *shape);
void ktg_nest_shape_drop(nest_shape *shape);
KTG_NODISCARD ktg_status ktg_nest_poles_find(ktg_context *context, const nest_shape *shape,
                                             nest_poles *poles);
/* The turn with the box around the outline; that around the cover is for turns that fit. */
nest_turn ktg_nest_turn_by(const nest_shape *shape, double angle);
void ktg_nest_turn_cover(const nest_shape *shape, nest_turn *turn);

/* ---- bodies and overlaps (nest_body.c, nest_overlap.c) ------------------------------------ */

KTG_NODISCARD ktg_status ktg_nest_body_make(ktg_context *context, const nest_shape *shape,
                                            uint32_t most_corners, nest_body *body);
void ktg_nest_body_drop(nest_body *body);
/* Puts the poles; the corners are put when somebody needs them. */
void ktg_nest_body_put(nest_body *body, const nest_pose *pose);
void ktg_nest_body_put_corners(nest_body *body);
/* The loss of two covers if they overlap: more, the further they would have to move. *deep: they
 * do, by their poles. */
float ktg_nest_loss(const nest_body *a, const nest_body *b, bool *deep);
/* Whether two covers have a point in common; the corners are put. */
bool ktg_nest_covers_meet(nest_state *state, const nest_body *a, const nest_body *b,
                          const nest_box *a_box, const nest_box *b_box);

static inline nest_box nest_box_at(const nest_pose *pose) {
    return (nest_box){ktg_add2(pose->at, pose->turn.cover_low),
                      ktg_add2(pose->at, pose->turn.cover_high)};
}

static inline bool nest_boxes_meet(const nest_box *a, const nest_box *b) {
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y &&
           b->low.y <= a->high.y;
}

/* ---- the state (nest_state.c) ------------------------------------------------------------- */

KTG_NODISCARD ktg_status ktg_nest_state_make(ktg_context *context, const ktg_nest_problem *problem,
                                             nest_state *state);
void ktg_nest_state_drop(nest_state *state);

static inline double nest_bin_length(const nest_state *state, uint32_t bin) {
    return bin + 1 == state->bin_count ? state->last_length : state->problem->length;
}
/* Moves `at` into the bin; false when the shape does not fit there with that turn. */
bool ktg_nest_clamp(const nest_state *state, nest_pose *pose);
void ktg_nest_save(const nest_state *state, nest_pose *poses);
/* These two leave the losses as they are; a move measures those of the item. */
void ktg_nest_load(nest_state *state, const nest_pose *poses);
void ktg_nest_put(nest_state *state, uint32_t item, const nest_pose *pose);
void ktg_nest_move(nest_state *state, uint32_t item, const nest_pose *pose);
/* All losses anew. */
void ktg_nest_measure(nest_state *state);
void ktg_nest_forget_weights(nest_state *state);
double ktg_nest_total_loss(const nest_state *state);
/* True when the search must end: work, time or the caller's wish. */
bool ktg_nest_is_over(nest_state *state);

/* ---- the search --------------------------------------------------------------------------- */

/* Looks for a place with less weighted overlap and moves the item there (nest_search.c). */
void ktg_nest_improve(nest_state *state, uint32_t item);
/* Tries to resolve all overlaps: rounds until `patience` of them in a row brought no progress, and
 * again from the best until `strikes` times in a row did not; *done: it did (nest_separate.c). */
KTG_NODISCARD ktg_status ktg_nest_separate(nest_state *state, uint32_t strikes, uint32_t patience,
                                           bool *done);
/* A random pose in the bins; false when none was found that fits. */
bool ktg_nest_random_pose(nest_state *state, const nest_shape *shape, int tries, nest_pose *pose);

#endif
