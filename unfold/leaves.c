/* unfold/leaves.c - cuts that will have no room for a tab. */
#include "unfold/leaves.h"
#include "core/memory.h"

/* A leaf's last cut has room where its ends are this much further apart than a tab is high. */
#define ROOMY 1.3

/* A vertex is flat below this curvature: a cut that ends there closes by itself. */
#define FLAT 1e-6

/* The price of a cut with room under one of its faces only. */
#define ONE_SIDED 0.2

static double leaf_price(const ktg_leaves *l, uint32_t v) {
    if (l->degree[v] != 1 || l->open[v] || fabs(l->curvature[v]) < FLAT)
        return 0;
    double length = l->dual->edges[l->chain[v]].length;
    double room = length * l->curvature[v] / (ROOMY * l->least);
    return length >= l->edge && room < 1 ? 1 - room : 0;
}

static void toggle(ktg_leaves *l, uint32_t e, uint32_t change) {
    for (int i = 0; i < 2; i++) {
        uint32_t v = l->dual->edges[e].vertices[i];
        l->degree[v] += change;
        l->chain[v] ^= e;
    }
}

static double price_around(const ktg_leaves *l, const uint32_t p[2], const uint32_t q[2]) {
    double sum = leaf_price(l, p[0]) + leaf_price(l, p[1]);
    for (int i = 0; i < 2; i++)
        if (q[i] != p[0] && q[i] != p[1])
            sum += leaf_price(l, q[i]);
    return sum;
}

double ktg_leaves_exchange(ktg_leaves *l, uint32_t fold, uint32_t cut) {
    const uint32_t *p = l->dual->edges[fold].vertices, *q = l->dual->edges[cut].vertices;
    double before = price_around(l, p, q);
    toggle(l, fold, 1);
    toggle(l, cut, -1u);
    double change = price_around(l, p, q) - before + l->hopeless[fold] - l->hopeless[cut];
    l->price += change;
    return change;
}

static void measure_vertices(ktg_leaves *l) {
    const ktg_dual *dual = l->dual;
    for (uint32_t v = 0; v < dual->vertex_count; v++)
        l->curvature[v] = 2 * KTG_PI;
    for (uint32_t h = 0; h < 3 * dual->face_count; h++) {
        uint32_t next = h % 3 == 2 ? h - 2 : h + 1, last = h % 3 == 0 ? h + 2 : h - 1;
        ktg_vec2 u = dual->flat_vectors[h], w = ktg_mul2(dual->flat_vectors[last], -1);
        l->curvature[dual->faces[h]] -= fabs(atan2(ktg_cross2(u, w), ktg_dot2(u, w)));
        if (dual->halfedge_edge[h] == KTG_NONE)
            l->open[dual->faces[h]] = l->open[dual->faces[next]] = true;
    }
}

static void measure_edges(ktg_leaves *l, const ktg_arrangement *a, const ktg_seam_tabs *tabs) {
    for (uint32_t e = 0; e < l->dual->edge_count; e++) {
        const uint32_t *pair = l->dual->edges[e].halfedge;
        int sides = tabs->slots[pair[0]].usable + tabs->slots[pair[1]].usable;
        l->hopeless[e] = l->dual->edges[e].length < l->edge ? 0
                         : sides == 0                       ? 1
                         : sides == 1                       ? (float)ONE_SIDED
                                                            : 0;
        if (a->folded[e])
            continue;
        toggle(l, e, 1);
        l->price += l->hopeless[e];
    }
    for (uint32_t v = 0; v < l->dual->vertex_count; v++)
        l->price += leaf_price(l, v);
}

ktg_status ktg_leaves_new(ktg_context *context, const ktg_arrangement *a, const ktg_seam_tabs *tabs,
                          ktg_leaves *l) {
    const ktg_dual *dual = a->dual;
    *l = (ktg_leaves){.dual = dual,
                      .least = tabs->wish.least,
                      .edge = tabs->wish.edge,
                      .curvature = ktg_new(context, dual->vertex_count, double),
                      .open = ktg_new(context, dual->vertex_count, bool),
                      .degree = ktg_new(context, dual->vertex_count, uint32_t),
                      .chain = ktg_new(context, dual->vertex_count, uint32_t),
                      .hopeless = ktg_new(context, dual->edge_count, float)};
    if (!l->curvature || !l->open || !l->degree || !l->chain || !l->hopeless)
        return KTG_MEMORY;
    measure_vertices(l);
    measure_edges(l, a, tabs);
    return KTG_OK;
}

void ktg_leaves_free(ktg_leaves *l) {
    ktg_free(l->curvature);
    ktg_free(l->open);
    ktg_free(l->degree);
    ktg_free(l->chain);
    ktg_free(l->hopeless);
    *l = (ktg_leaves){0};
}
