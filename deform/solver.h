/* deform/solver.h - what the files of the deformation share (deform only).
 *
 * rows.c      the surface as rows of a Laplacian, one for each fan of faces around a vertex
 * bodies.c    vertices that move as one: union-find over fixed, handles, rigid parts, pairs
 * links.c     finds pairs, and vertices that follow an edge or a face
 * anchors.c   is every part held by something?
 * system.c    the rows over what is free, factored once; solves
 * update.c    rotations, then positions, in steps
 * refit.c     rotations fitted to what came out
 * measure.c   stretch, flips, errors */
#ifndef KTG_DEFORM_SOLVER_H
#define KTG_DEFORM_SOLVER_H

#include "core/sparse.h"
#include "deform/deform.h"
#include "deform/turn.h"

/* Fails with "file:line: " before the text where the edit has a file, the line where it has one. */
ktg_status ktg_edit_fail(ktg_context *context, const char *file, uint64_t line, const char *format,
                         ...) KTG_PRINTF(4, 5);

/* ---- rows (rows.c) -------------------------------------------------------------------------- */

/* A matrix of count rows over the mesh's vertices. Row m is the fan m of vertex[m]:
 * sqrt(A_m) L_m (equation 11), that is c_i / (4 sqrt(A_m)) for x_0 - x_i. The factor sqrt(A_m)
 * makes the sum of squares an integral, so that small faces do not count more than large ones. */
typedef struct ktg_rows {
    uint32_t count;
    uint32_t *vertex; /* count */
    size_t *first;    /* count + 1: where a row starts in column and value; x_0 comes first */
    uint32_t *column;
    double *value;
} ktg_rows;

/* `corners` are the mesh's faces; positions normalised. A face with a vertex twice counts for
 * nothing. */
KTG_NODISCARD ktg_status ktg_rows_new(ktg_context *context, const ktg_mesh *mesh,
                                      const ktg_adjacency *adjacency, const ktg_vec3 *positions,
                                      ktg_rows **rows);
void ktg_rows_free(ktg_rows **rows);

/* result[m] = row m of x. */
void ktg_rows_apply(const ktg_rows *rows, const ktg_vec3 *x, ktg_vec3 *result);

/* ---- bodies and links (bodies.c, links.c) --------------------------------------------------- */

/* A vertex that follows others: p = sum weights p_masters + R gap, r = sum weights r_masters
 * (equation 9), R being the turn of the vertex. */
typedef struct ktg_follower {
    uint32_t vertex, masters[3]; /* KTG_NONE behind the last one */
    double weights[3];
    ktg_vec3 gap;
} ktg_follower;

typedef struct ktg_pair {
    uint32_t from, to;
} ktg_pair;

/* Vertices that move as one body. */
typedef struct ktg_bodies {
    uint32_t vertex_count;
    uint32_t *parent; /* vertex_count: disjoint sets; a body is named by the vertex at its root */
    uint32_t *hold;   /* of a root: the hold that moves it, or KTG_NONE */
    uint32_t *sized;  /* of a root: the hold that gives its scale, or KTG_NONE */
    uint32_t *size;   /* of a root: vertices */
    bool *follows;    /* vertex_count: follows others (links.c) */
    bool *held; /* of a root that is resized: a vertex of it is fixed or a handle, its pivot */

    /* once finished */
    uint32_t *pivot;         /* of a root: the vertex whose position is the body's */
    uint32_t follower_count; /* masters stand before those who follow them */
    ktg_follower *followers;
    size_t follower_capacity;
    uint32_t pair_count;
    ktg_pair *pairs;
    size_t pair_capacity;
    uint32_t left_out;
} ktg_bodies;

/* Everything one deformation is made from, read by all files. */
typedef struct ktg_frame {
    const ktg_mesh *mesh;
    const ktg_edit *edit;
    ktg_adjacency *adjacency;
    int exponent;        /* positions are the mesh's times 2^-exponent, */
    ktg_vec3 *rest;      /* moved so that they lie in [0, 1]^3; vertex_count */
    ktg_vec3 low;        /* what was taken off, in the mesh's unit times 2^-exponent */
    uint32_t *component; /* vertex_count: which part of the mesh; KTG_NONE for a vertex without
                            faces */
    uint32_t component_count;
} ktg_frame;

KTG_NODISCARD ktg_status ktg_frame_new(ktg_context *context, const ktg_mesh *mesh,
                                       const ktg_edit *edit, ktg_frame **frame);
void ktg_frame_free(ktg_frame **frame);

/* The parts of a mesh: vertices joined by faces, numbered by their first vertex; a vertex without
 * faces is in none. *component has vertex_count numbers; free it with ktg_free. */
KTG_NODISCARD ktg_status ktg_find_parts(ktg_context *context, const ktg_mesh *mesh,
                                        uint32_t **component, uint32_t *count);
/* What they are called, as ktg_mesh_component_names says. */
KTG_NODISCARD ktg_status ktg_name_parts(ktg_context *context, const ktg_mesh *mesh,
                                        const uint32_t *component, uint32_t count,
                                        ktg_names *names);

/* The two vertices of an edge. */
void ktg_edge_ends(const ktg_mesh *mesh, const ktg_adjacency *adjacency, uint32_t edge,
                   uint32_t ends[2]);

/* Takes holds and links into bodies. */
KTG_NODISCARD ktg_status ktg_bodies_new(ktg_context *context, const ktg_frame *frame,
                                        ktg_bodies **bodies);
void ktg_bodies_free(ktg_bodies **bodies);

/* Makes a and b, neither of which follows another, one body; what asks for it is named in the
 * message when they are moved or scaled in two ways. */
KTG_NODISCARD ktg_status ktg_bodies_join(ktg_context *context, const ktg_frame *frame,
                                         ktg_bodies *bodies, uint32_t a, uint32_t b,
                                         const char *kind, const char *name, uint64_t line);

/* Adds the pairs and followers of all links. */
KTG_NODISCARD ktg_status ktg_links_find(ktg_context *context, const ktg_frame *frame,
                                        ktg_bodies *bodies);

/* Fails when a part of the mesh hangs on nothing that is fixed or a handle. */
KTG_NODISCARD ktg_status ktg_anchors_check(ktg_context *context, const ktg_frame *frame,
                                           const ktg_bodies *bodies);

/* ---- the linear system (system.c) ----------------------------------------------------------- */

/* Vertex values x = C y + d over what is free; minimises |A x - target|^2 over y. */
typedef struct ktg_system ktg_system;

/* `known`: of roots, whether the body's value is given. The rows are borrowed. */
KTG_NODISCARD ktg_status ktg_system_new(ktg_context *context, const ktg_rows *rows,
                                        const ktg_bodies *bodies, const bool *known,
                                        ktg_system **system);
void ktg_system_free(ktg_system **system);
/* The same with rows of the same mesh in another shape. After a failure only this may be called. */
KTG_NODISCARD ktg_status ktg_system_refill(ktg_context *context, ktg_system *system,
                                           const ktg_rows *rows);
uint32_t ktg_system_unknowns(const ktg_system *system);

/* x (vertex_count) satisfies all constraints, and does so afterwards; target has a value for each
 * row. Solves for the change of x, and where the matrix is so ill-conditioned that it matters
 * (long thin parts), again for what is left: the residual has lost no digits. */
KTG_NODISCARD ktg_status ktg_system_solve(ktg_context *context, ktg_system *system,
                                          const ktg_vec3 *target, ktg_vec3 *x);

/* ---- solving (update.c, refit.c) ------------------------------------------------------------ */

/* Columns of sum w e' e^T over edges e that became e'. */
typedef struct ktg_spread {
    ktg_vec3 columns[3];
} ktg_spread;

struct ktg_deform {
    bool stale; /* the factor of system is not that of rows */
    ktg_frame *frame;
    ktg_bodies *bodies;
    ktg_rows *rows;      /* of the rest shape */
    ktg_rows *step_rows; /* of the base, from the second step on, else NULL */
    ktg_system *system;  /* of step_rows, or else of rows */
    bool *known;         /* of roots */
    double *log_scale;   /* vertex_count, or NULL: nothing is resized */
    uint32_t steps;      /* of the last update */

    ktg_deform_motion *motions; /* hold_count, normalised: of the update that runs */
    ktg_vec3 *base, *now;       /* vertex_count: positions before and after the step */
    ktg_turn *turns;            /* vertex_count: from rest to now */
    ktg_turn *base_turns;       /* vertex_count: from rest to base */
    ktg_turn *step_turns;       /* vertex_count: from base to now */
    ktg_vec3 *logs;             /* vertex_count: logarithms of step_turns */
    ktg_vec3 *targets;          /* rows->count */
    ktg_spread *spreads;        /* vertex_count, or NULL: nothing is refined */
};

/* Fits step_turns of what is free to the way from base to now around each body. */
void ktg_refit_turns(ktg_deform *deform);

#endif
