/* unfold/strips.c - section 4.2 of the paper: from the spanning tree to strips. */
#include "unfold/strips.h"
#include "core/memory.h"

#include <string.h>

/* The forest of polygons: each polygon's faces as a list, and how many tree edges leave it. */
typedef struct forest {
    const ktg_dual *dual;
    bool *in_tree;
    uint32_t *polygon;   /* per face: the first face of its polygon */
    uint32_t *next_face; /* per face: the next one of its polygon, KTG_NONE at the end */
    uint32_t *degree;    /* per polygon (first face): tree edges to other polygons */
    bool *walked;        /* per polygon */
} forest;

/* Gathers into one polygon all faces that tree edges of rigid kind join to `seed`. */
static void gather_polygon(forest *f, uint32_t seed) {
    uint32_t last = seed;
    f->polygon[seed] = seed;
    for (uint32_t face = seed; face != KTG_NONE; face = f->next_face[face]) {
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = f->dual->halfedge_edge[h];
            if (e == KTG_NONE || !f->in_tree[e] || !f->dual->edges[e].rigid)
                continue;
            const uint32_t *pair = f->dual->edges[e].halfedge;
            uint32_t other = (pair[0] == h ? pair[1] : pair[0]) / 3;
            if (f->polygon[other] != KTG_NONE)
                continue;
            f->polygon[other] = seed;
            f->next_face[last] = other;
            last = other;
        }
    }
}

static void count_degrees(forest *f) {
    for (uint32_t e = 0; e < f->dual->edge_count; e++) {
        const ktg_dual_edge *edge = &f->dual->edges[e];
        if (!f->in_tree[e] || edge->rigid)
            continue;
        f->degree[f->polygon[edge->halfedge[0] / 3]]++;
        f->degree[f->polygon[edge->halfedge[1] / 3]]++;
    }
}

static uint32_t polygon_across(const forest *f, uint32_t e, uint32_t polygon) {
    const uint32_t *pair = f->dual->edges[e].halfedge;
    uint32_t a = f->polygon[pair[0] / 3];
    return a != polygon ? a : f->polygon[pair[1] / 3];
}

static void cut(forest *f, uint32_t e) {
    f->in_tree[e] = false;
    f->degree[f->polygon[f->dual->edges[e].halfedge[0] / 3]]--;
    f->degree[f->polygon[f->dual->edges[e].halfedge[1] / 3]]--;
}

/* At a polygon reached through `entry`: cuts every other tree edge but the longest and returns that
 * one, KTG_NONE where the way ends. */
static uint32_t choose_way(forest *f, uint32_t polygon, uint32_t entry) {
    uint32_t way = KTG_NONE;
    for (uint32_t face = polygon; face != KTG_NONE; face = f->next_face[face]) {
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = f->dual->halfedge_edge[h];
            if (e == KTG_NONE || e == entry || !f->in_tree[e] || f->dual->edges[e].rigid)
                continue;
            uint32_t shorter = e;
            if (way == KTG_NONE || f->dual->edges[e].length > f->dual->edges[way].length) {
                shorter = way;
                way = e;
            }
            if (shorter != KTG_NONE)
                cut(f, shorter);
        }
    }
    return way;
}

static void walk_from_leaf(forest *f, uint32_t polygon) {
    uint32_t entry = KTG_NONE;
    for (;;) {
        f->walked[polygon] = true;
        uint32_t way = choose_way(f, polygon, entry);
        if (way == KTG_NONE)
            return;
        polygon = polygon_across(f, way, polygon);
        entry = way;
    }
}

/* Walks from leaves in the order of their numbers. Cutting makes new leaves, some with lower
 * numbers, hence the repetition; every round walks at least one leaf of what is left. */
static void walk_all(forest *f) {
    bool found = true;
    while (found) {
        found = false;
        for (uint32_t p = 0; p < f->dual->face_count; p++) {
            if (f->polygon[p] != p || f->walked[p] || f->degree[p] > 1)
                continue;
            walk_from_leaf(f, p);
            found = true;
        }
    }
}

ktg_status ktg_strips_cut(ktg_context *context, const ktg_dual *dual, bool *in_tree) {
    uint32_t n = dual->face_count;
    forest f = {.dual = dual,
                .in_tree = in_tree,
                .polygon = ktg_new(context, n, uint32_t),
                .next_face = ktg_new(context, n, uint32_t),
                .degree = ktg_new(context, n, uint32_t),
                .walked = ktg_new(context, n, bool)};
    ktg_status status = f.polygon && f.next_face && f.degree && f.walked ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        memset(f.polygon, 0xff, n * sizeof *f.polygon);
        memset(f.next_face, 0xff, n * sizeof *f.next_face);
        for (uint32_t face = 0; face < n; face++)
            if (f.polygon[face] == KTG_NONE)
                gather_polygon(&f, face);
        count_degrees(&f);
        walk_all(&f);
    }
    ktg_free(f.polygon);
    ktg_free(f.next_face);
    ktg_free(f.degree);
    ktg_free(f.walked);
    return status;
}
