/* unfold/kept.c - can the folds that are to be kept be laid flat at all?
 *
 * They hold faces together, and so do inner edges of coplanar polygons. Where these edges close a
 * ring of faces, the ring must close by itself when it is laid flat, which it does around flat
 * vertices only. Faces held together by kept folds lie fixed to each other in every net: when two
 * of them overlap, no net is sound. */
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/net.h"
#include "unfold/pieces.h"
#include "unfold/rules.h"

#include <string.h>

static uint32_t root_of(uint32_t *parent, uint32_t face) {
    while (parent[face] != face)
        face = parent[face] = parent[parent[face]];
    return face;
}

/* Joins what edges of one sort hold together, as long as they close no ring; sets their flags. */
static void join_edges(const ktg_dual *dual, bool kept, uint32_t *parent, bool *joined) {
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        const ktg_dual_edge *edge = &dual->edges[e];
        if (!edge->rigid || edge->kept != kept)
            continue;
        uint32_t a = root_of(parent, edge->halfedge[0] / 3);
        uint32_t b = root_of(parent, edge->halfedge[1] / 3);
        joined[e] = joined[e] || a != b;
        parent[a < b ? b : a] = a < b ? a : b;
    }
}

/* ---- rings ---------------------------------------------------------------------------------- */

static double corner_angle(const ktg_dual *dual, uint32_t h) {
    ktg_vec3 out = dual->edge_vectors[h];
    ktg_vec3 in = dual->edge_vectors[h % 3 == 0 ? h + 2 : h - 1];
    return atan2(ktg_length3(ktg_cross3(in, out)), -ktg_dot3(in, out));
}

/* The sum of the angles around a vertex all of whose edges are rigid, else 0. */
static double ring_angle(const ktg_dual *dual, uint32_t vertex) {
    double sum = 0;
    for (uint32_t h = 0; h < 3 * dual->face_count; h++) {
        uint32_t e = dual->halfedge_edge[h];
        bool touches =
            dual->faces[h] == vertex || dual->faces[h % 3 == 2 ? h - 2 : h + 1] == vertex;
        if (touches && (e == KTG_NONE || !dual->edges[e].rigid))
            return 0;
        if (dual->faces[h] == vertex)
            sum += corner_angle(dual, h);
    }
    return sum;
}

/* What the rule calls the dual's vertex. */
static uint32_t number_of(const ktg_edge_rule *rule, const ktg_mesh *mesh, const ktg_dual *dual,
                          const ktg_dual_edge *edge, int end) {
    uint32_t h = edge->halfedge[0];
    uint32_t corner = end == 0 ? h % 3 : (h + 1) % 3;
    uint32_t vertex = mesh->faces[3 * (size_t)dual->mesh_face[h / 3] + corner];
    return rule->numbers[rule->vertices[0] == vertex ? 0 : 1];
}

static ktg_status fail_ring(ktg_context *context, const ktg_mesh *mesh, const ktg_rules *rules,
                            const ktg_dual *dual, const ktg_dual_edge *edge) {
    const ktg_edge_rule *rule = ktg_rules_of_dual(rules, dual, edge);
    char name[KTG_RULE_NAME_SIZE];
    ktg_rule_name(rule, name);
    for (int end = 0; end < 2; end++) {
        double angle = ring_angle(dual, edge->vertices[end]);
        if (angle > 0 && fabs(angle - 2 * KTG_PI) > 1e-9)
            return ktg_fail(context, KTG_GEOMETRY,
                            "all folds around vertex %u are to be kept, but its angles add up to "
                            "%.6g degrees and only 360 lie flat; do not keep one of them, for "
                            "example %s",
                            number_of(rule, mesh, dual, edge, end), angle * 180 / KTG_PI, name);
    }
    return ktg_fail(context, KTG_GEOMETRY,
                    "the folds to be kept close a ring of faces, and no net does without a cut "
                    "through it; do not keep one of them, for example %s",
                    name);
}

static ktg_status check_rings(ktg_context *context, const ktg_mesh *mesh, const ktg_rules *rules,
                              const ktg_dual *dual, uint32_t *parent, bool *joined) {
    join_edges(dual, false, parent, joined);
    join_edges(dual, true, parent, joined);
    KTG_TRY(ktg_pieces_close(context, dual, joined));
    for (uint32_t e = 0; e < dual->edge_count; e++)
        if (dual->edges[e].kept && !joined[e])
            return fail_ring(context, mesh, rules, dual, &dual->edges[e]);
    return KTG_OK;
}

/* ---- overlaps ------------------------------------------------------------------------------- */

static ktg_status fail_overlap(ktg_context *context, const ktg_rules *rules, ktg_net *net) {
    const uint32_t *faces = net->conflicts[net->live[0]].faces;
    uint32_t *path = ktg_new(context, net->dual->face_count, uint32_t);
    char name[KTG_RULE_NAME_SIZE];
    if (!path)
        return KTG_MEMORY;
    uint32_t length = ktg_net_path(net, faces[0], faces[1], path);
    const ktg_dual_edge *edge = &net->dual->edges[path[length / 2]];
    ktg_rule_name(ktg_rules_of_dual(rules, net->dual, edge), name);
    ktg_free(path);
    return ktg_fail(context, KTG_GEOMETRY,
                    "the folds to be kept hold %u faces together that overlap when they are laid "
                    "flat; do not keep one of the folds between them, for example %s",
                    net->dual->face_count, name);
}

/* Lays one cluster of faces flat. */
static ktg_status check_cluster(ktg_context *context, const ktg_mesh *mesh, const ktg_rules *rules,
                                const uint32_t *mesh_faces, uint32_t count, double scale) {
    ktg_dual *dual = NULL;
    ktg_net *net = NULL;
    KTG_TRY(ktg_dual_new(context, mesh, &rules->adjacency, mesh_faces, count, scale, &dual));
    uint32_t *parent = ktg_new(context, count, uint32_t);
    bool *folded = ktg_new(context, dual->edge_count, bool);
    ktg_status status = parent && folded ? KTG_OK : KTG_MEMORY;
    for (uint32_t f = 0; status == KTG_OK && f < count; f++)
        parent[f] = f;
    for (uint32_t e = 0; status == KTG_OK && e < dual->edge_count; e++)
        dual->edges[e].kept = dual->edges[e].rigid =
            ktg_rules_of_dual(rules, dual, &dual->edges[e]) != NULL;
    if (status == KTG_OK) {
        join_edges(dual, true, parent, folded);
        status = ktg_net_new(context, dual, folded, &net);
    }
    if (status == KTG_OK && net->live_count > 0)
        status = fail_overlap(context, rules, net);
    ktg_net_free(&net);
    ktg_free(parent);
    ktg_free(folded);
    ktg_dual_free(&dual);
    return status;
}

/* Sorts the faces by cluster: first[r] .. first[r + 1] are those of root r. */
static void group_faces(const ktg_dual *dual, uint32_t *parent, uint32_t *first, uint32_t *faces) {
    for (uint32_t f = 0; f < dual->face_count; f++)
        first[root_of(parent, f) + 1]++;
    for (uint32_t r = 0; r < dual->face_count; r++)
        first[r + 1] += first[r];
    for (uint32_t f = dual->face_count; f-- > 0;)
        faces[--first[root_of(parent, f) + 1]] = dual->mesh_face[f];
    /* each first[r + 1] went down to where r begins: shift them back */
    memmove(first, first + 1, dual->face_count * sizeof *first);
    first[dual->face_count] = dual->face_count;
}

/* Two faces at one fold lie on its two sides, so only larger clusters are of interest. */
static ktg_status check_overlaps(ktg_context *context, const ktg_mesh *mesh, const ktg_rules *rules,
                                 const ktg_dual *dual, double scale, uint32_t *parent,
                                 bool *joined) {
    uint32_t *first = ktg_new(context, (size_t)dual->face_count + 2, uint32_t);
    uint32_t *faces = ktg_new(context, dual->face_count, uint32_t);
    ktg_status status = first && faces ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        join_edges(dual, true, parent, joined);
        group_faces(dual, parent, first, faces);
    }
    for (uint32_t r = 0; status == KTG_OK && r < dual->face_count; r++)
        if (first[r + 1] - first[r] > 2)
            status = check_cluster(context, mesh, rules, faces + first[r], first[r + 1] - first[r],
                                   scale);
    ktg_free(first);
    ktg_free(faces);
    return status;
}

/* ---- the check ------------------------------------------------------------------------------ */

static bool any_kept(const ktg_dual *dual) {
    for (uint32_t e = 0; e < dual->edge_count; e++)
        if (dual->edges[e].kept)
            return true;
    return false;
}

static void start_alone(const ktg_dual *dual, uint32_t *parent, bool *joined) {
    for (uint32_t f = 0; f < dual->face_count; f++)
        parent[f] = f;
    memset(joined, 0, dual->edge_count * sizeof *joined);
}

ktg_status ktg_kept_check(ktg_context *context, const ktg_mesh *mesh, const ktg_rules *rules,
                          const ktg_dual *dual, double scale) {
    if (!any_kept(dual))
        return KTG_OK;
    uint32_t *parent = ktg_new(context, dual->face_count, uint32_t);
    bool *joined = ktg_new(context, dual->edge_count, bool);
    ktg_status status = parent && joined ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        start_alone(dual, parent, joined);
        status = check_rings(context, mesh, rules, dual, parent, joined);
    }
    if (status == KTG_OK) {
        start_alone(dual, parent, joined);
        status = check_overlaps(context, mesh, rules, dual, scale, parent, joined);
    }
    ktg_free(parent);
    ktg_free(joined);
    return status;
}

ktg_status ktg_kept_are_folds(ktg_context *context, const ktg_rules *rules, const ktg_dual *dual,
                              const bool *joined) {
    char name[KTG_RULE_NAME_SIZE];
    for (uint32_t e = 0; e < dual->edge_count; e++)
        if (dual->edges[e].kept && !joined[e])
            return ktg_fail(context, KTG_GEOMETRY,
                            "%s cannot stay a fold: its faces do not lie flat together with "
                            "others that are to be kept; do not keep it",
                            ktg_rule_name(ktg_rules_of_dual(rules, dual, &dual->edges[e]), name));
    return KTG_OK;
}
