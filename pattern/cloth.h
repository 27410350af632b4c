/* pattern/cloth.h - what a piece of cloth gets before it is cut (pattern only).
 *
 *     ktg_darts_find      seams that are folded away instead of cut out
 *     ktg_mirrors_find    pieces that are mirror images or copies of each other, or of themselves
 *     ktg_clearances_find where pieces come near themselves
 *     ktg_cutting_line    the outline with its allowances
 *     ktg_notches_choose  where marks go, the same on both sides of a seam
 *     ktg_notches_draw
 *     ktg_pieces_halve    halves for the fold of the cloth
 *
 * The border of a piece runs counter-clockwise, so that outside is on the right. */
#ifndef KTG_PATTERN_CLOTH_H
#define KTG_PATTERN_CLOTH_H

#include "pattern/topology.h"

/* How a piece comes to lie on another one: mirrored across an upright line, or as it is, then
 * moved. */
typedef struct ktg_likeness {
    uint32_t piece; /* the other one, or the same; KTG_NONE: there is none */
    bool mirrored;
    ktg_vec2 moved;
} ktg_likeness;

static inline ktg_vec2 ktg_likeness_point(const ktg_likeness *mirror, ktg_vec2 p) {
    return (ktg_vec2){(mirror->mirrored ? -p.x : p.x) + mirror->moved.x, p.y + mirror->moved.y};
}

/* What the steps share. */
typedef struct ktg_cloth {
    const ktg_topology *topology;
    const ktg_finish_options *options;
    ktg_pattern *pattern;
    ktg_likeness *twins; /* piece_count: on the piece it is cut with */
    double *room;        /* topology->border_count: how much cloth there can be at the start of each
                            half-edge of the border; infinite where nothing is near */
    ktg_likeness *selves; /* piece_count: on itself, mirrored, where it is symmetric */
} ktg_cloth;

/* ---- edges -------------------------------------------------------------------------------- */

/* A half-edge of the border that is a leg of a dart. */
static inline bool ktg_is_dart(const ktg_topology *t, uint32_t h) {
    uint32_t seam = ktg_edge_at(t, h)->seam;
    return seam != KTG_NONE && t->pattern->seams[seam].dart;
}

/* How much cloth lies outside a border half-edge. */
static inline double ktg_allowance_at(const ktg_topology *t, const ktg_finish_options *options,
                                      uint32_t h) {
    return ktg_edge_at(t, h)->kind == KTG_EDGE_BORDER ? options->hem_mm : options->allowance_mm;
}

/* Its unit vector, and the one outwards from it. */
static inline ktg_vec2 ktg_along(const ktg_topology *t, uint32_t h) {
    return ktg_unit2(ktg_sub2(ktg_end_of(t, h), ktg_start_of(t, h)));
}
static inline ktg_vec2 ktg_outward(ktg_vec2 along) {
    return (ktg_vec2){along.y, -along.x};
}

/* The half-edge of a seam's k-th edge on one of its sides. */
static inline uint32_t ktg_seam_halfedge(const ktg_pattern *pattern, const ktg_pattern_seam *seam,
                                         uint32_t k, uint32_t side) {
    const ktg_pattern_edge *edge = &pattern->edges[seam->edges[k]];
    return ktg_side_halfedge(&edge->sides[seam->first_side[k] ^ side]);
}

static inline double ktg_distance_to_segment(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 ab = ktg_sub2(b, a), ap = ktg_sub2(p, a);
    double square = ktg_dot2(ab, ab);
    double t = square > 0 ? fmax(0, fmin(1, ktg_dot2(ap, ab) / square)) : 0;
    return ktg_length2(ktg_sub2(ap, ktg_mul2(ab, t)));
}

/* Appends a line to a piece and takes over its points. */
KTG_NODISCARD ktg_status ktg_piece_add_line(ktg_context *context, ktg_pattern_piece *piece,
                                            ktg_line_kind kind, ktg_vec2 *points,
                                            size_t point_count);
/* The same from a to b. */
KTG_NODISCARD ktg_status ktg_piece_add_segment(ktg_context *context, ktg_pattern_piece *piece,
                                               ktg_line_kind kind, ktg_vec2 a, ktg_vec2 b);

/* ---- the steps ---------------------------------------------------------------------------- */

KTG_NODISCARD ktg_status ktg_darts_find(ktg_context *context, const ktg_topology *topology,
                                        ktg_pattern *pattern);

/* Darts over whose mouth no cut can be found, or that lie side by side, are cut out after all. */
void ktg_darts_keep_foldable(const ktg_cloth *cloth);

/* Fills twins and selves, and the pieces' cut_count, cut_mirrored and twin_of; gives seams that lie
 * on each other the same number. */
KTG_NODISCARD ktg_status ktg_mirrors_find(ktg_context *context, ktg_cloth *cloth);

/* Fills room. */
KTG_NODISCARD ktg_status ktg_clearances_find(ktg_context *context, ktg_cloth *cloth);

/* The piece's outline, and lines for its darts. KTG_GEOMETRY where it crosses itself. */
KTG_NODISCARD ktg_status ktg_cutting_line(ktg_context *context, const ktg_cloth *cloth,
                                          uint32_t piece);

KTG_NODISCARD ktg_status ktg_notches_choose(ktg_context *context, ktg_cloth *cloth);
KTG_NODISCARD ktg_status ktg_notches_draw(ktg_context *context, const ktg_cloth *cloth);

/* Makes halves of symmetric pieces whose names options->on_fold has. */
KTG_NODISCARD ktg_status ktg_pieces_halve(ktg_context *context, ktg_cloth *cloth);

#endif
