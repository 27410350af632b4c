/* flatten/iterate.h - the parts of the iterative methods and what they hand each other (this room
 * only).
 *
 *     ktg_rests_new            every face as it lies in its own plane
 *     ktg_laplacian_new        a Laplacian with chosen unknowns, factored for any edge weights
 *     ktg_conformal_start      a conformal map whose border keeps its length
 *     ktg_convex_start         a map to a disk, which cannot fold
 *     ktg_energy_value         ARAP or symmetric Dirichlet energy and gradient
 *     ktg_relax                vertex by vertex downhill
 *     ktg_descend              from a start down to a minimum
 */
#ifndef KTG_FLATTEN_ITERATE_H
#define KTG_FLATTEN_ITERATE_H

#include "flatten/kernel.h"

#include <math.h>

/* ---- rest.c ------------------------------------------------------------------------------- */

/* A face in its own plane: first corner in the origin, second on the x axis, third at (x, height).
 */
typedef struct ktg_rest {
    double inverse_length, x, inverse_height;
    double area;
} ktg_rest;

/* face_count; allocated, freed with ktg_free. */
KTG_NODISCARD ktg_status ktg_rests_new(ktg_context *context, const ktg_panel *panel,
                                       ktg_rest **rests);

/* Half the sum of the cotangents opposite to each edge (Pinkall & Polthier 1993), which makes the
 * Laplacian the Dirichlet energy's own: positive definite even where some are negative. weights:
 * edge_count. */
void ktg_cotangent_weights(const ktg_panel *panel, const ktg_rest *rests, double *weights);

/* The same with a metric in each face, made from its map to `flat`, such that a step down the
 * Laplacian tends to make the map rigid as fast as the symmetric Dirichlet energy asks for. */
void ktg_proxy_weights(const ktg_panel *panel, const ktg_rest *rests, const ktg_vec2 *flat,
                       double *weights);

/* The derivative of a face's map as two columns. */
typedef struct ktg_jacobian {
    ktg_vec2 x, y;
} ktg_jacobian;

static inline ktg_jacobian ktg_jacobian_of(const ktg_rest *rest, const uint32_t *corners,
                                           const ktg_vec2 *flat) {
    ktg_vec2 a = flat[corners[0]], b = flat[corners[1]], c = flat[corners[2]];
    ktg_vec2 x = {(b.x - a.x) * rest->inverse_length, (b.y - a.y) * rest->inverse_length};
    ktg_vec2 y = {(c.x - a.x - rest->x * x.x) * rest->inverse_height,
                  (c.y - a.y - rest->x * x.y) * rest->inverse_height};
    return (ktg_jacobian){x, y};
}

/* ---- laplacian.c -------------------------------------------------------------------------- */

typedef struct ktg_laplacian ktg_laplacian;

/* Held vertices are no unknowns. *laplacian: freed by ktg_laplacian_free. */
KTG_NODISCARD ktg_status ktg_laplacian_new(ktg_context *context, const ktg_panel *panel,
                                           const bool *held, ktg_laplacian **laplacian);
void ktg_laplacian_free(ktg_laplacian **laplacian);

/* Factors it for edge weights (edge_count), which it copies; may be called again. */
KTG_NODISCARD ktg_status ktg_laplacian_factor(ktg_context *context, ktg_laplacian *laplacian,
                                              const double *weights);

/* L solution = right at the unknowns; solution is 0 at held vertices. Both vertex_count; may be the
 * same array. */
KTG_NODISCARD ktg_status ktg_laplacian_solve(ktg_context *context, ktg_laplacian *laplacian,
                                             const ktg_vec2 *right, ktg_vec2 *solution);

/* Fills in the unknowns such that L positions = 0 there: the harmonic extension of held positions.
 */
KTG_NODISCARD ktg_status ktg_laplacian_extend(ktg_context *context, ktg_laplacian *laplacian,
                                              ktg_vec2 *positions);

/* ---- start.c ------------------------------------------------------------------------------ */

/* Sawhney & Crane, "Boundary First Flattening" (2017), with scale factor 1 along the border, which
 * of all conformal maps distorts areas least. A developable panel comes out exactly. Positions may
 * be folded, and not finite where the panel is degenerate. */
KTG_NODISCARD ktg_status ktg_conformal_start(ktg_context *context, const ktg_panel *panel,
                                             const ktg_rest *rests, ktg_vec2 *flat);

/* 2 pi (on the border pi) minus the angles around each vertex, in .x (vertex_count). */
void ktg_angle_defects(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *defects);

/* Tutte's map: the border around a circle, every other vertex in the mean of its
 * neighbours, so that no face can fold but by rounding. */
KTG_NODISCARD ktg_status ktg_convex_start(ktg_context *context, const ktg_panel *panel,
                                          const ktg_rest *rests, ktg_vec2 *flat);

/* ---- energy.c ----------------------------------------------------------------------------- */

typedef enum ktg_energy {
    KTG_ENERGY_ARAP,     /* A |J - R|^2 / 2, R the rotation next to J */
    KTG_ENERGY_DIRICHLET /* A (|J|^2 + |J^-1|^2) / 2, infinite where a face is turned over */
} ktg_energy;

/* The sum over all faces and, unless NULL, its gradient (vertex_count). */
double ktg_energy_value(const ktg_panel *panel, const ktg_rest *rests, ktg_energy energy,
                        const ktg_vec2 *flat, ktg_vec2 *gradient);

/* The largest t <= `most` such that no face of flat + s direction has lost its area for s < t. */
double ktg_largest_step(const ktg_panel *panel, const ktg_vec2 *flat, const ktg_vec2 *direction,
                        double most);

/* Scales `flat`, which has no fold, to the size at which the symmetric Dirichlet energy is least.
 */
void ktg_dirichlet_set_size(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *flat);

/* ---- relax.c ------------------------------------------------------------------------------ */

/* The symmetric Dirichlet energy of the faces around a vertex, with its gradient and Hessian for
 * that vertex's position. */
typedef struct ktg_ring_energy {
    double value;
    ktg_vec2 slope;
    double xx, xy, yy;
} ktg_ring_energy;

ktg_ring_energy ktg_ring_energy_of(const ktg_panel *panel, const ktg_rest *rests,
                                   const ktg_vec2 *flat, uint32_t vertex);

/* Moves each vertex once, so that the symmetric Dirichlet energy of its faces falls; `flat` has no
 * fold and gets none. */
void ktg_relax(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *flat);

/* One vertex, which one fan of faces surrounds. */
void ktg_relax_vertex(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *flat,
                      uint32_t vertex);

/* ---- descent.c ---------------------------------------------------------------------------- */

/* Edges that are to have a given length: each adds stiffness / 2 (|edge| - length)^2. */
typedef struct ktg_springs {
    uint32_t count;
    uint32_t *halfedges; /* count: of the panel, one for each edge */
    double *lengths;     /* count: normalised */
    double stiffness;
} ktg_springs;

/* Their energy, which is added to the gradient unless that is NULL. */
double ktg_springs_value(const ktg_panel *panel, const ktg_springs *springs, const ktg_vec2 *flat,
                         ktg_vec2 *gradient);

/* From `flat` down to where the energy, with that of springs (or NULL), no longer falls.
 * KTG_ENERGY_DIRICHLET: `flat` has no fold and gets none. `iterations` is added to. */
KTG_NODISCARD ktg_status ktg_descend(ktg_context *context, const ktg_panel *panel,
                                     const ktg_rest *rests, ktg_energy energy,
                                     const ktg_springs *springs, ktg_vec2 *flat,
                                     uint32_t *iterations);

#endif
