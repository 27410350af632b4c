/* mesh/repair_join.c - which faces hang together across an edge in space.
 *
 * Two faces at an edge are joined. Of more than two, in this order: those that are a pair by the
 * vertices of the file; those that are a pair within one sheet connected elsewhere (so that a plate
 * stays whole beside its rib, and two solids that touch along the edge stay two); those that
 * enclose a wedge of material; the rest by smoothness. The odd one gets a border. */
#include "core/memory.h"
#include "core/sets.h"
#include "core/vec.h"
#include "mesh/repair.h"

#include <stdlib.h>
#include <string.h>

/* An edge with more faces than this is no shape: what is not paired by then stays open. */
enum { MOST_AT_EDGE = 64 };

/* Neighbours that run the same way cost so much in smoothness (radians): where two sheets are about
 * as smooth, the file's own orientation decides. */
static const double against_orientation = 0.3;

typedef struct spoke {
    double angle; /* of the face around the edge, 0 .. 2 pi */
    uint32_t halfedge;
    bool forward; /* the half-edge runs from the lower to the higher welded vertex */
} spoke;

typedef struct spoke_pair {
    double cost;
    uint32_t a, b;
} spoke_pair;

static void pair_up(ktg_repair *repair, uint32_t h, uint32_t g) {
    repair->mate[h] = g;
    repair->mate[g] = h;
}

/* The half-edge's ends as an unordered pair of the file's vertices. */
static uint64_t ends_of(const ktg_mesh *mesh, uint32_t h) {
    uint32_t a = mesh->faces[h], b = mesh->faces[ktg_halfedge_next(h)];
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static bool is_forward(const ktg_repair *repair, uint32_t h) {
    const uint32_t *faces = repair->mesh->faces;
    return repair->weld[faces[h]] < repair->weld[faces[ktg_halfedge_next(h)]];
}

/* Joins h with g when they are the only free ones of the edge with the same key. */
static void join_twos(ktg_repair *repair, const uint32_t *halfedges, uint32_t count,
                      const uint64_t *keys, bool opposite) {
    for (uint32_t i = 0; i < count; i++) {
        uint32_t same = 0, other = 0;
        for (uint32_t j = 0; j < count; j++)
            if (j != i && repair->mate[halfedges[j]] == KTG_NONE && keys[j] == keys[i]) {
                same++;
                other = j;
            }
        uint32_t h = halfedges[i], g = halfedges[other];
        if (same == 1 && repair->mate[h] == KTG_NONE &&
            (!opposite || is_forward(repair, h) != is_forward(repair, g)))
            pair_up(repair, h, g);
    }
}

static void join_by_vertices(ktg_repair *repair, const uint32_t *halfedges, uint32_t count) {
    uint64_t keys[MOST_AT_EDGE];
    if (count == 2) {
        pair_up(repair, halfedges[0], halfedges[1]);
    } else if (count > 2 && count <= MOST_AT_EDGE) {
        for (uint32_t i = 0; i < count; i++)
            keys[i] = ends_of(repair->mesh, halfedges[i]);
        join_twos(repair, halfedges, count, keys, false);
    }
}

static int by_angle(const void *a, const void *b) {
    const spoke *p = a, *q = b;
    if (p->angle != q->angle)
        return p->angle < q->angle ? -1 : 1;
    return p->halfedge < q->halfedge ? -1 : 1;
}

static int by_cost(const void *a, const void *b) {
    const spoke_pair *p = a, *q = b;
    if (p->cost != q->cost)
        return p->cost < q->cost ? -1 : 1;
    if (p->a != q->a)
        return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : 1;
}

/* The free half-edges of an edge, in order around it; angles from the first one. */
static uint32_t sort_around(const ktg_repair *repair, const uint32_t *halfedges, uint32_t count,
                            spoke *spokes) {
    const ktg_mesh *mesh = repair->mesh;
    ktg_vec3 axis = {0}, first = {0}, second = {0};
    uint32_t free_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t h = halfedges[i], n = ktg_halfedge_next(h);
        if (repair->mate[h] != KTG_NONE)
            continue;
        bool forward = is_forward(repair, h);
        ktg_vec3 start = mesh->positions[mesh->faces[forward ? h : n]];
        ktg_vec3 end = mesh->positions[mesh->faces[forward ? n : h]];
        ktg_vec3 out = ktg_sub3(mesh->positions[mesh->faces[ktg_halfedge_next(n)]], start);
        if (free_count == 0) {
            axis = ktg_unit3(ktg_sub3(end, start));
            first = ktg_unit3(ktg_sub3(out, ktg_mul3(axis, ktg_dot3(out, axis))));
            second = ktg_cross3(axis, first);
        }
        double angle = atan2(ktg_dot3(out, second), ktg_dot3(out, first));
        if (free_count == 0)
            angle = 0; /* exactly */
        spokes[free_count++] = (spoke){angle < 0 ? angle + 2 * KTG_PI : angle, h, forward};
    }
    qsort(spokes, free_count, sizeof *spokes, by_angle);
    return free_count;
}

/* Where directions alternate around the edge, each backward face and the forward one after it have
 * the material between them. */
static bool join_wedges(ktg_repair *repair, const spoke *spokes, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (spokes[i].forward == spokes[(i + 1) % count].forward)
            return false;
    for (uint32_t i = 0; i < count; i++)
        if (!spokes[i].forward)
            pair_up(repair, spokes[i].halfedge, spokes[(i + 1) % count].halfedge);
    return true;
}

static ktg_status join_smoothest(ktg_repair *repair, const spoke *spokes, uint32_t count) {
    spoke_pair *pairs = ktg_new(repair->context, (size_t)count * count / 2, spoke_pair);
    size_t pair_count = 0;
    if (!pairs)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++) {
            double bend = fabs(KTG_PI - (spokes[j].angle - spokes[i].angle));
            if (spokes[i].forward == spokes[j].forward)
                bend += against_orientation;
            uint32_t a = spokes[i].halfedge, b = spokes[j].halfedge;
            pairs[pair_count++] = (spoke_pair){bend, a < b ? a : b, a < b ? b : a};
        }
    qsort(pairs, pair_count, sizeof *pairs, by_cost);
    for (size_t i = 0; i < pair_count; i++)
        if (repair->mate[pairs[i].a] == KTG_NONE && repair->mate[pairs[i].b] == KTG_NONE)
            pair_up(repair, pairs[i].a, pairs[i].b);
    ktg_free(pairs);
    return KTG_OK;
}

/* `sheet` tells which faces hang together through the joins made so far. */
static ktg_status join_rest(ktg_repair *repair, const uint32_t *halfedges, uint32_t count,
                            uint32_t *sheet) {
    uint64_t keys[MOST_AT_EDGE];
    spoke spokes[MOST_AT_EDGE];
    if (count <= 2 || count > MOST_AT_EDGE)
        return KTG_OK;
    for (uint32_t i = 0; i < count; i++)
        keys[i] = ktg_set_of(sheet, halfedges[i] / 3);
    join_twos(repair, halfedges, count, keys, true);
    uint32_t free_count = sort_around(repair, halfedges, count, spokes);
    if (free_count < 2 || (free_count > 2 && join_wedges(repair, spokes, free_count)))
        return KTG_OK;
    return join_smoothest(repair, spokes, free_count);
}

static ktg_status join_all(ktg_repair *repair, const ktg_adjacency *a, uint32_t *sheet) {
    for (uint32_t e = 0; e < a->edge_count; e++)
        join_by_vertices(repair, a->edge_halfedges + a->edge_first[e],
                         a->edge_first[e + 1] - a->edge_first[e]);
    for (uint32_t f = 0; f < repair->mesh->face_count; f++)
        sheet[f] = f;
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        if (repair->mate[h] != KTG_NONE)
            ktg_set_join(sheet, h / 3, repair->mate[h] / 3);
    for (uint32_t e = 0; e < a->edge_count; e++)
        KTG_TRY(join_rest(repair, a->edge_halfedges + a->edge_first[e],
                          a->edge_first[e + 1] - a->edge_first[e], sheet));
    return KTG_OK;
}

/* Edges of the file's own vertices with more than two faces. */
static ktg_status count_nonmanifold(ktg_repair *repair) {
    ktg_adjacency *a;
    KTG_TRY(ktg_adjacency_new(repair->context, repair->mesh, &a));
    for (uint32_t e = 0; e < a->edge_count; e++)
        repair->report.nonmanifold_edges_split += a->edge_first[e + 1] - a->edge_first[e] > 2;
    ktg_adjacency_free(&a);
    return KTG_OK;
}

ktg_status ktg_repair_join(ktg_repair *repair) {
    size_t halfedges = 3 * (size_t)repair->mesh->face_count;
    ktg_adjacency *adjacency = NULL;
    uint32_t *sheet = ktg_new(repair->context, repair->mesh->face_count, uint32_t);
    ktg_free(repair->mate);
    repair->mate = ktg_new(repair->context, halfedges, uint32_t);
    ktg_status status = sheet && repair->mate ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        memset(repair->mate, 0xff, halfedges * sizeof *repair->mate);
        status = count_nonmanifold(repair);
    }
    if (status == KTG_OK)
        status = ktg_repair_welded(repair, &adjacency);
    if (status == KTG_OK)
        status = join_all(repair, adjacency, sheet);
    ktg_adjacency_free(&adjacency);
    ktg_free(sheet);
    return status;
}
