/* pattern/topology.h - who lies beside whom in a pattern (pattern only).
 *
 * Half-edge h = 3 f + k runs from corner k of surface face f to the next one, as it lies in the
 * face's piece. Faces are glued along folds; a vertex of a piece may be passed by the border
 * several times, so the border is walked by turning through folds, never by vertex numbers. */
#ifndef KTG_PATTERN_TOPOLOGY_H
#define KTG_PATTERN_TOPOLOGY_H

#include "core/vec.h"
#include "pattern/pattern.h"

typedef struct ktg_topology {
    const ktg_pattern *pattern;
    uint32_t *edge_of;      /* 3 face_count: the pattern's edge of a half-edge */
    uint8_t *side_of;       /* 3 face_count: and which of its sides */
    uint32_t *piece_of;     /* face_count; KTG_NONE for a face in no piece */
    uint32_t *slot_of;      /* face_count: the face's place in its piece */
    uint32_t *region_of;    /* face_count: a face that stands for the flat region */
    uint32_t *region_size;  /* face_count: faces in the region a face stands for */
    uint32_t *border_first; /* piece_count + 1: where a piece's border starts in `border` */
    uint32_t *border;       /* half-edges in counter-clockwise order, piece after piece */
    uint32_t *place_of;     /* 3 face_count: a half-edge's place in `border`, or KTG_NONE */
    uint32_t border_count;
} ktg_topology;

/* KTG_ARGUMENT for a pattern that does not hang together: a side without an edge or with two, a
 * fold between pieces, a face in two pieces, a piece whose border is not one closed walk. */
KTG_NODISCARD ktg_status ktg_topology_build(ktg_context *context, const ktg_pattern *pattern,
                                            ktg_topology *topology);
/* Frees the arrays; fine on a zeroed one. */
void ktg_topology_drop(ktg_topology *topology);

static inline uint32_t ktg_side_halfedge(const ktg_pattern_side *side) {
    return 3 * side->face + side->corner;
}

static inline const ktg_pattern_edge *ktg_edge_at(const ktg_topology *t, uint32_t h) {
    return &t->pattern->edges[t->edge_of[h]];
}

/* The other side's half-edge; KTG_NONE on a border. */
static inline uint32_t ktg_mate(const ktg_topology *t, uint32_t h) {
    const ktg_pattern_edge *edge = ktg_edge_at(t, h);
    return edge->side_count == 2 ? ktg_side_halfedge(&edge->sides[1 - t->side_of[h]]) : KTG_NONE;
}

static inline bool ktg_kind_is_fold(ktg_edge_kind kind) {
    return kind == KTG_EDGE_MOUNTAIN || kind == KTG_EDGE_VALLEY || kind == KTG_EDGE_FLAT;
}

static inline uint32_t ktg_next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

/* Where corner h % 3 of face h / 3 lies in its piece. */
static inline ktg_vec2 ktg_corner_at(const ktg_topology *t, uint32_t h) {
    const ktg_pattern_piece *piece = &t->pattern->pieces[t->piece_of[h / 3]];
    return piece->vertices[piece->corners[3 * t->slot_of[h / 3] + h % 3]];
}

static inline ktg_vec2 ktg_start_of(const ktg_topology *t, uint32_t h) {
    return ktg_corner_at(t, h);
}

static inline ktg_vec2 ktg_end_of(const ktg_topology *t, uint32_t h) {
    return ktg_corner_at(t, ktg_next_corner(h));
}

/* The border half-edges after and before the border half-edge h. */
static inline uint32_t ktg_border_next(const ktg_topology *t, uint32_t h) {
    uint32_t piece = t->piece_of[h / 3], place = t->place_of[h] + 1;
    return t->border[place == t->border_first[piece + 1] ? t->border_first[piece] : place];
}

static inline uint32_t ktg_border_previous(const ktg_topology *t, uint32_t h) {
    uint32_t piece = t->piece_of[h / 3], place = t->place_of[h];
    return t->border[(place == t->border_first[piece] ? t->border_first[piece + 1] : place) - 1];
}

#endif
