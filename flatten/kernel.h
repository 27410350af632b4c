/* flatten/kernel.h - the parts of the flattening kernel and what they hand each other (this room
 * only).
 *
 *     ktg_panel_new            the panel: normalised, with adjacency
 *     ktg_panel_check_disk     is it a disk, and if not, what is it
 *     ktg_lay_flat             by one of the methods
 *     ktg_panel_set_upright    which way is up
 *     ktg_strain_measure       how much the flat shape strains each face
 *     ktg_panel_check_overlap  does it lie on itself
 *
 * and of the two-step method, ktg_neighbourhoods_new (every edge's surroundings laid flat),
 * ktg_similarity_step and ktg_scale_step. The iterative methods are in flatten/iterate.h, the way
 * of a whole surface with seams in flatten/surface.h. */
#ifndef KTG_FLATTEN_KERNEL_H
#define KTG_FLATTEN_KERNEL_H

#include "flatten/flatten.h"

/* ---- panel.c ------------------------------------------------------------------------------ */

/* A mesh as the kernel sees it: moved and scaled by a power of two, so that the largest side of its
 * bounding box lies in [1/2, 1) and nothing below depends on the model's unit. */
typedef struct ktg_panel {
    uint32_t vertex_count, face_count;
    const uint32_t *faces; /* 3 face_count, the mesh's own */
    ktg_vec3 *positions;   /* vertex_count, normalised */
    int exponent;          /* a length here times 2^exponent is one of the model */
    ktg_adjacency *adjacency;
    uint32_t *leaving; /* vertex_count: a half-edge that leaves the vertex, the one on the border
                          where there is one; KTG_NONE of an unused vertex */
} ktg_panel;

/* KTG_ARGUMENT, KTG_GEOMETRY for a face without area. */
KTG_NODISCARD ktg_status ktg_panel_new(ktg_context *context, const ktg_mesh *mesh,
                                       ktg_panel **panel);
void ktg_panel_free(ktg_panel **panel);

/* The edge in the middle of a disk: nearest to its centre of area among those that lie deep enough
 * inside. The choice does not depend on where the model lies. */
KTG_NODISCARD ktg_status ktg_panel_middle(ktg_context *context, const ktg_panel *panel,
                                          uint32_t *edge);

static inline uint32_t ktg_halfedge_next(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

/* The next half-edge counter-clockwise that leaves the same vertex, or KTG_NONE at the border. */
static inline uint32_t ktg_panel_around(const ktg_panel *panel, uint32_t h) {
    return panel->adjacency->twin[ktg_halfedge_next(ktg_halfedge_next(h))];
}

/* ---- disk.c ------------------------------------------------------------------------------- */

/* KTG_GEOMETRY for an edge of three faces, or of two that are not oriented alike. */
KTG_NODISCARD ktg_status ktg_check_sheet(ktg_context *context, const ktg_mesh *mesh,
                                         const ktg_adjacency *adjacency);

/* KTG_GEOMETRY with what it is instead, unless the panel is one topological disk. */
KTG_NODISCARD ktg_status ktg_panel_check_disk(ktg_context *context, const ktg_mesh *mesh,
                                              const ktg_panel *panel);

/* ---- neighbourhood.c ---------------------------------------------------------------------- */

/* An edge's end points a, b and the opposite corners c, d of its two triangles (on a border: c
 * only), laid flat. The plane is that of complex numbers: a similarity is a product. */
typedef struct ktg_neighbourhood {
    uint32_t count; /* 4, or 3 on a border */
    uint32_t vertices[4];
    ktg_vec2 flat[4]; /* a' = (0, 0), b' = (|ab|, 0), c' above, d' below */
    double weight;
} ktg_neighbourhood;

/* One for each edge of the adjacency; allocated, freed with ktg_free. */
KTG_NODISCARD ktg_status ktg_neighbourhoods_new(ktg_context *context, const ktg_panel *panel,
                                                ktg_edge_weight weight,
                                                ktg_neighbourhood **neighbourhoods);

/* The similarity T that maps the neighbourhood best (least squares, equation 3) to `positions` when
 * the vertex `vertices[base]` stays where it is: T = sum of factors[v] positions[vertices[v]]. The
 * factors add up to 0. */
void ktg_neighbourhood_similarity(const ktg_neighbourhood *neighbourhood, uint32_t base,
                                  ktg_vec2 factors[4]);

/* The residual (z_b - z_a) - T (b' - a') of equation 4, as factors of the neighbourhood's z. */
void ktg_neighbourhood_residual(const ktg_neighbourhood *neighbourhood, uint32_t base,
                                ktg_vec2 factors[4]);

/* Products of complex numbers: a b, and conj(a) b. */
static inline ktg_vec2 ktg_turn(ktg_vec2 a, ktg_vec2 b) {
    return (ktg_vec2){a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}
static inline ktg_vec2 ktg_turn_back(ktg_vec2 a, ktg_vec2 b) {
    return (ktg_vec2){a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x};
}

/* ---- two_step.c --------------------------------------------------------------------------- */

/* Vertices held where they are: one per handle of a manipulated shape, two for a flattened panel.
 */
typedef struct ktg_pins {
    uint32_t count;
    const uint32_t *vertices;
    const ktg_vec2 *positions;
} ktg_pins;

/* Edge neighbourhoods and how many vertices they speak of. */
typedef struct ktg_edges {
    uint32_t vertex_count, edge_count;
    const ktg_neighbourhood *neighbourhoods; /* edge_count */
} ktg_edges;

/* Section 4.2: positions (vertex_count) that are as similar as possible; at least two pins. */
KTG_NODISCARD ktg_status ktg_similarity_step(ktg_context *context, const ktg_edges *edges,
                                             const ktg_pins *pins, ktg_vec2 *positions);

/* Section 4.3: from the rotations of `positions`, positions of the right size, in place; at least
 * one pin. */
KTG_NODISCARD ktg_status ktg_scale_step(ktg_context *context, const ktg_edges *edges,
                                        const ktg_pins *pins, ktg_vec2 *positions);

/* ---- method.c ----------------------------------------------------------------------------- */

/* Lays the panel flat (upright) by the method that is asked for, or by one that does not fold it
 * where the default does. Fills in the report how that was done. */
KTG_NODISCARD ktg_status ktg_lay_flat(ktg_context *context, const ktg_panel *panel,
                                      const ktg_flatten_options *options, ktg_vec2 *flat,
                                      ktg_panel_report *report);

/* ---- strain.c ----------------------------------------------------------------------------- */

/* The map of one face from 3D to 2D: its signed singular values s1 >= |s2| and the image of a
 * direction of space, projected into the face. */
typedef struct ktg_face_map {
    ktg_vec2 columns[2]; /* images of an orthonormal frame of the face */
    ktg_vec3 frame[2];
    double s1, s2;
    double area; /* in 3D */
} ktg_face_map;

ktg_face_map ktg_face_map_of(const ktg_panel *panel, uint32_t face, const ktg_vec2 *flat);
ktg_vec2 ktg_face_map_direction(const ktg_face_map *map, ktg_vec3 direction);

/* Fills what *report says about the flat shape, by the options' fabric or strain_limit; face_strain
 * (face_count) may be NULL. *first_flipped: the first face that came out turned over or without
 * area, or KTG_NONE. */
KTG_NODISCARD ktg_status ktg_strain_measure(ktg_context *context, const ktg_panel *panel,
                                            const ktg_vec2 *flat,
                                            const ktg_flatten_options *options, double *face_strain,
                                            ktg_panel_report *report, uint32_t *first_flipped);

/* The strain that `part` of a mesh's area does not exceed. face_strain: face_count. */
KTG_NODISCARD ktg_status ktg_strain_percentile(ktg_context *context, const ktg_mesh *mesh,
                                               const double *face_strain, double part,
                                               double *strain);

/* Faces that are turned over, have less than a millionth of their area or are not finite. */
uint32_t ktg_panel_count_flipped(const ktg_panel *panel, const ktg_vec2 *flat);

/* The same, however little area is left: a start may be squeezed that much. */
uint32_t ktg_panel_count_turned_over(const ktg_panel *panel, const ktg_vec2 *flat);

/* ---- overlap.c ---------------------------------------------------------------------------- */

/* Does the border of the flat panel cross itself, and near which two vertices? */
KTG_NODISCARD ktg_status ktg_panel_find_crossing(ktg_context *context, const ktg_panel *panel,
                                                 const ktg_vec2 *flat, bool *crossed,
                                                 uint32_t vertices[2]);

/* KTG_GEOMETRY when the border of the flat panel, of which no face is flipped, crosses itself.
 * names: the number by which a message is to call each vertex. */
KTG_NODISCARD ktg_status ktg_panel_check_overlap(ktg_context *context, const ktg_panel *panel,
                                                 const ktg_vec2 *flat, const uint32_t *names);

/* ---- upright.c ---------------------------------------------------------------------------- */

/* The direction of the flat panel, a unit vector, that is to point to +y. */
ktg_vec2 ktg_panel_upward(const ktg_panel *panel, const ktg_vec2 *flat, unsigned axis);

/* Turns `flat` upright, by the model's axis (0 x, 1 y, 2 z), and `grain` radians back, so that a
 * grain at that angle points to +y, and moves its box to the origin. */
void ktg_panel_set_upright(const ktg_panel *panel, ktg_vec2 *flat, unsigned axis, double grain);

/* ---- fabric.c ----------------------------------------------------------------------------- */

/* Whether the fabric, grain along +y, takes the shape of the face in space; and how much of what it
 * bears that asks for: 1 is the limit. */
double ktg_fabric_load(const ktg_fabric *fabric, const ktg_face_map *map);
bool ktg_fabric_bears(const ktg_fabric *fabric, const ktg_face_map *map);

#endif
