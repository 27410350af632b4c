/* unfold/edges.c - what each edge of the surface has become. */
#include "unfold/edges.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/crease.h"

/* The unit normal of a face, from its two shorter edges: the product of short edges keeps its
 * direction in a needle. */
static ktg_vec3 unit_normal(const ktg_pattern *p, uint32_t face) {
    const uint32_t *corner = p->faces + 3 * (size_t)face;
    ktg_vec3 edge[3];
    int longest = 0;
    for (int k = 0; k < 3; k++) {
        edge[k] = ktg_sub3(p->vertices[corner[(k + 1) % 3]], p->vertices[corner[k]]);
        if (ktg_dot3(edge[k], edge[k]) > ktg_dot3(edge[longest], edge[longest]))
            longest = k;
    }
    return ktg_unit3(
        ktg_cross3(ktg_unit3(edge[(longest + 1) % 3]), ktg_unit3(edge[(longest + 2) % 3])));
}

/* Positive where the surface is convex: a mountain seen from outside. */
static double fold_angle(const ktg_pattern *p, const ktg_pattern_edge *edge) {
    ktg_vec3 m = unit_normal(p, edge->sides[0].face), n = unit_normal(p, edge->sides[1].face);
    ktg_vec3 along =
        ktg_unit3(ktg_sub3(p->vertices[edge->vertices[1]], p->vertices[edge->vertices[0]]));
    return atan2(ktg_dot3(ktg_cross3(m, n), along), ktg_dot3(m, n));
}

static ktg_edge_kind kind_of(const ktg_pattern_edge *edge, bool is_fold) {
    if (edge->side_count == 1)
        return KTG_EDGE_BORDER;
    if (!is_fold)
        return KTG_EDGE_CUT;
    if (fabs(edge->angle) < KTG_FLAT_FOLD)
        return KTG_EDGE_FLAT;
    return edge->angle > 0 ? KTG_EDGE_MOUNTAIN : KTG_EDGE_VALLEY;
}

ktg_status ktg_edges_fill(ktg_context *context, const ktg_adjacency *a, const bool *is_fold,
                          ktg_pattern *p) {
    uint32_t *face_piece = ktg_new(context, p->face_count, uint32_t);
    p->edges = ktg_new(context, a->edge_count, ktg_pattern_edge);
    if (!face_piece || !p->edges) {
        ktg_free(face_piece);
        return KTG_MEMORY;
    }
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t f = 0; f < p->pieces[i].face_count; f++)
            face_piece[p->pieces[i].faces[f]] = (uint32_t)i;
    p->edge_count = a->edge_count;
    for (uint32_t e = 0; e < a->edge_count; e++) {
        ktg_pattern_edge *edge = &p->edges[e];
        const uint32_t *halfedge = a->edge_halfedges + a->edge_first[e];
        edge->side_count = a->edge_first[e + 1] - a->edge_first[e];
        edge->tab_on = -1;
        edge->seam = KTG_NONE;
        for (uint32_t i = 0; i < edge->side_count; i++)
            edge->sides[i] =
                (ktg_pattern_side){face_piece[halfedge[i] / 3], halfedge[i] / 3, halfedge[i] % 3};
        edge->vertices[0] = p->faces[halfedge[0]];
        edge->vertices[1] = p->faces[halfedge[0] % 3 == 2 ? halfedge[0] - 2 : halfedge[0] + 1];
        edge->angle = edge->side_count == 2 ? fold_angle(p, edge) : 0;
        edge->kind = kind_of(edge, is_fold[e]);
    }
    ktg_free(face_piece);
    return KTG_OK;
}
