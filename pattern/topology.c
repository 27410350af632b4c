/* pattern/topology.c - half-edges, borders and flat regions of a pattern. */
#include "pattern/topology.h"

#include "core/memory.h"

#include <string.h>

static ktg_status allocate(ktg_context *context, const ktg_pattern *pattern, ktg_topology *t) {
    size_t faces = pattern->face_count;
    t->edge_of = ktg_new(context, 3 * faces, uint32_t);
    t->side_of = ktg_new(context, 3 * faces, uint8_t);
    t->piece_of = ktg_new(context, faces, uint32_t);
    t->slot_of = ktg_new(context, faces, uint32_t);
    t->region_of = ktg_new(context, faces, uint32_t);
    t->region_size = ktg_new(context, faces, uint32_t);
    t->border_first = ktg_new(context, pattern->piece_count + 1, uint32_t);
    t->border = ktg_new(context, 3 * faces, uint32_t);
    t->place_of = ktg_new(context, 3 * faces, uint32_t);
    if (!t->edge_of || !t->side_of || !t->piece_of || !t->slot_of || !t->region_of ||
        !t->region_size || !t->border_first || !t->border || !t->place_of)
        return KTG_MEMORY;
    for (size_t h = 0; h < 3 * faces; h++)
        t->edge_of[h] = t->place_of[h] = KTG_NONE;
    for (size_t f = 0; f < faces; f++)
        t->piece_of[f] = KTG_NONE;
    return KTG_OK;
}

static ktg_status index_faces(ktg_context *context, ktg_topology *t) {
    const ktg_pattern *pattern = t->pattern;
    for (uint32_t p = 0; p < pattern->piece_count; p++) {
        const ktg_pattern_piece *piece = &pattern->pieces[p];
        for (uint32_t slot = 0; slot < piece->face_count; slot++) {
            uint32_t face = piece->faces[slot];
            if (face >= pattern->face_count || t->piece_of[face] != KTG_NONE)
                return ktg_fail(context, KTG_ARGUMENT,
                                "face %u of piece %u is not on the surface or lies in a second "
                                "piece: the pattern does not hang together",
                                face, p + 1);
            t->piece_of[face] = p;
            t->slot_of[face] = slot;
        }
    }
    return KTG_OK;
}

/* True when side `s` of the edge is a half-edge of its piece that no other edge has taken. */
static bool side_is_sound(const ktg_topology *t, const ktg_pattern_edge *edge, uint32_t s) {
    const ktg_pattern_side *side = &edge->sides[s];
    return side->face < t->pattern->face_count && side->corner < 3 &&
           t->piece_of[side->face] == side->piece && side->piece != KTG_NONE &&
           t->edge_of[ktg_side_halfedge(side)] == KTG_NONE;
}

static bool counts_are_sound(const ktg_pattern_edge *edge) {
    if (edge->kind == KTG_EDGE_BORDER)
        return edge->side_count == 1;
    return edge->side_count == 2 &&
           (edge->kind == KTG_EDGE_CUT || edge->sides[0].piece == edge->sides[1].piece);
}

static ktg_status index_edges(ktg_context *context, ktg_topology *t) {
    for (uint32_t e = 0; e < t->pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &t->pattern->edges[e];
        bool sound = counts_are_sound(edge);
        for (uint32_t s = 0; sound && s < edge->side_count; s++) {
            sound = side_is_sound(t, edge, s);
            if (sound) {
                t->edge_of[ktg_side_halfedge(&edge->sides[s])] = e;
                t->side_of[ktg_side_halfedge(&edge->sides[s])] = (uint8_t)s;
            }
        }
        if (!sound)
            return ktg_fail(context, KTG_ARGUMENT,
                            "edge %u of the pattern has a wrong number of sides, or a side that "
                            "belongs to another edge or piece",
                            e + 1);
    }
    for (uint32_t h = 0; h < 3 * t->pattern->face_count; h++)
        if (t->piece_of[h / 3] != KTG_NONE && t->edge_of[h] == KTG_NONE)
            return ktg_fail(context, KTG_ARGUMENT,
                            "no edge of the pattern names corner %u of face %u", h % 3, h / 3);
    return KTG_OK;
}

/* The border half-edge that follows border half-edge h: on around its end, through folds. The map
 * is one to one and h has no way into it, so the turning ends. */
static uint32_t turn_to_border(const ktg_topology *t, uint32_t h) {
    uint32_t next = ktg_next_corner(h);
    while (ktg_kind_is_fold(ktg_edge_at(t, next)->kind))
        next = ktg_next_corner(ktg_mate(t, next));
    return next;
}

/* Walks the border of piece p from its first border half-edge; all of it must be passed. */
static ktg_status walk_border(ktg_context *context, ktg_topology *t, uint32_t p) {
    const ktg_pattern_piece *piece = &t->pattern->pieces[p];
    uint32_t first = KTG_NONE, total = 0, start = t->border_count;
    for (size_t i = 0; i < 3 * piece->face_count; i++) {
        uint32_t h = 3 * piece->faces[i / 3] + (uint32_t)(i % 3);
        if (ktg_kind_is_fold(ktg_edge_at(t, h)->kind))
            continue;
        if (first == KTG_NONE)
            first = h;
        total++;
    }
    for (uint32_t h = first; h != KTG_NONE && t->place_of[h] == KTG_NONE;
         h = turn_to_border(t, h)) {
        t->place_of[h] = t->border_count;
        t->border[t->border_count++] = h;
    }
    t->border_first[p + 1] = t->border_count;
    if (total == 0 || t->border_count - start != total)
        return ktg_fail(context, KTG_ARGUMENT,
                        "piece %u has %s: a piece must be a disk with one closed border", p + 1,
                        total ? "more than one border" : "no border");
    return KTG_OK;
}

static uint32_t find_root(uint32_t *parent, uint32_t f) {
    while (parent[f] != f)
        f = parent[f] = parent[parent[f]];
    return f;
}

/* Flat regions: faces connected by folds that need no folding. */
static void join_regions(ktg_topology *t) {
    const ktg_pattern *pattern = t->pattern;
    for (uint32_t f = 0; f < pattern->face_count; f++)
        t->region_of[f] = f;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        if (edge->kind != KTG_EDGE_FLAT)
            continue;
        uint32_t a = find_root(t->region_of, edge->sides[0].face);
        uint32_t b = find_root(t->region_of, edge->sides[1].face);
        t->region_of[a > b ? a : b] = a > b ? b : a;
    }
    for (uint32_t f = 0; f < pattern->face_count; f++) {
        t->region_of[f] = find_root(t->region_of, f);
        t->region_size[t->region_of[f]]++;
    }
}

static ktg_status build(ktg_context *context, const ktg_pattern *pattern, ktg_topology *t) {
    if (pattern->face_count > (KTG_NONE - 3) / 3)
        return ktg_fail(context, KTG_LIMIT, "a surface of %u faces is too large",
                        pattern->face_count);
    KTG_TRY(allocate(context, pattern, t));
    KTG_TRY(index_faces(context, t));
    KTG_TRY(index_edges(context, t));
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        KTG_TRY(walk_border(context, t, p));
    join_regions(t);
    return KTG_OK;
}

ktg_status ktg_topology_build(ktg_context *context, const ktg_pattern *pattern,
                              ktg_topology *topology) {
    *topology = (ktg_topology){.pattern = pattern};
    ktg_status status = build(context, pattern, topology);
    if (status != KTG_OK)
        ktg_topology_drop(topology);
    return status;
}

void ktg_topology_drop(ktg_topology *t) {
    ktg_free(t->edge_of);
    ktg_free(t->side_of);
    ktg_free(t->piece_of);
    ktg_free(t->slot_of);
    ktg_free(t->region_of);
    ktg_free(t->region_size);
    ktg_free(t->border_first);
    ktg_free(t->border);
    ktg_free(t->place_of);
    memset(t, 0, sizeof *t);
}
