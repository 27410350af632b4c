/* unfold/ease.c - how easy an arrangement is to glue. */
#include "unfold/ease.h"
#include "core/memory.h"

#define LEAF 0.5
#define WEAK 1.0

/* A vertex on a border has so many cuts that none of them ends there. */
#define OPEN 0x10000

static ktg_status price_folds(ktg_context *context, double short_edge, ktg_ease *ease) {
    const ktg_dual *dual = ease->a->dual;
    ease->weak = ktg_new(context, dual->edge_count, float);
    if (!ease->weak)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        double lacks = fmax(0, 1 - dual->edges[e].length / short_edge);
        ease->weak[e] = (float)(ease->weight * WEAK / dual->face_count * lacks * lacks);
    }
    return KTG_OK;
}

static ktg_status count_ends(ktg_context *context, ktg_ease *ease) {
    const ktg_dual *dual = ease->a->dual;
    ease->degree = ktg_new(context, dual->vertex_count, uint32_t);
    if (!ease->degree)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < 3 * dual->face_count; h++)
        if (dual->halfedge_edge[h] == KTG_NONE) {
            ease->degree[dual->faces[h]] = OPEN;
            ease->degree[dual->faces[h % 3 == 2 ? h - 2 : h + 1]] = OPEN;
        }
    for (uint32_t e = 0; e < dual->edge_count; e++)
        for (int i = 0; i < 2; i++)
            ease->degree[dual->edges[e].vertices[i]] += !ease->a->folded[e];
    return KTG_OK;
}

ktg_status ktg_ease_new(ktg_context *context, const ktg_arrangement *a, double weight,
                        ktg_vec2 half, double short_edge, ktg_ease *ease) {
    const ktg_dual *dual = a->dual;
    uint32_t cuts = dual->edge_count - (dual->face_count - a->piece_count);
    *ease = (ktg_ease){.a = a, .weight = weight, .half = fmax(half.x, half.y)};
    ease->leaf = weight * LEAF / dual->face_count;
    ease->per_distance = weight / ((cuts > 0 ? cuts : 1) * ease->half);
    if (!(weight > 0))
        return KTG_OK;
    KTG_TRY(price_folds(context, short_edge, ease));
    return count_ends(context, ease);
}

void ktg_ease_free(ktg_ease *ease) {
    ktg_free(ease->weak);
    ktg_free(ease->degree);
    *ease = (ktg_ease){0};
}

/* Cuts that end at the two vertices if each had `more` cuts more. */
static int ends_at(const ktg_ease *ease, const uint32_t v[2], uint32_t more) {
    return (ease->degree[v[0]] + more == 1) + (ease->degree[v[1]] + more == 1);
}

static void add_cut(ktg_ease *ease, uint32_t e, uint32_t more) {
    const uint32_t *v = ease->a->dual->edges[e].vertices;
    ease->degree[v[0]] += more;
    ease->degree[v[1]] += more;
}

double ktg_ease_cuts(const ktg_ease *ease, uint32_t fold, uint32_t cut) {
    if (!(ease->weight > 0))
        return 0;
    const uint32_t *p = ease->a->dual->edges[fold].vertices;
    const uint32_t *q = ease->a->dual->edges[cut].vertices;
    int ends = ends_at(ease, p, 1) - ends_at(ease, p, 0);
    for (int i = 0; i < 2; i++) { /* the fold is a cut by then */
        uint32_t had = ease->degree[q[i]] + (q[i] == p[0] || q[i] == p[1]);
        ends += (had == 2) - (had == 1);
    }
    return ease->leaf * ends + ease->weak[cut] - ease->weak[fold];
}

void ktg_ease_follow(ktg_ease *ease, uint32_t fold, uint32_t cut) {
    if (!(ease->weight > 0))
        return;
    add_cut(ease, fold, 1);
    add_cut(ease, cut, -1u);
}

static ktg_vec2 middle_of(const ktg_arrangement *a, uint32_t h) {
    return ktg_mul2(ktg_add2(a->corners[h], a->corners[h % 3 == 2 ? h - 2 : h + 1]), 0.5);
}

/* Of half-edge `other` from a point in a piece. */
static double distance(const ktg_ease *ease, ktg_vec2 here, uint32_t piece, uint32_t other) {
    return piece == ease->a->piece[other / 3]
               ? ktg_length2(ktg_sub2(here, middle_of(ease->a, other)))
               : ease->half;
}

double ktg_ease_distances(const ktg_ease *ease, const ktg_branch *branch, const ktg_graft *graft) {
    const ktg_arrangement *a = ease->a;
    uint32_t to = a->piece[graft->other / 3];
    double change = 0;
    if (!(ease->weight > 0))
        return 0;
    for (uint32_t i = 0; i < branch->count; i++)
        for (uint32_t h = 3 * a->order[branch->first + i], end = h + 3; h < end; h++) {
            uint32_t e = a->dual->halfedge_edge[h];
            if (e == KTG_NONE)
                continue;
            uint32_t across = ktg_arrangement_across(a, e, h);
            if (ktg_branch_holds(a, branch, across / 3))
                continue;
            ktg_vec2 moved = ktg_move2(graft->motion, middle_of(a, h));
            change += distance(ease, moved, to, across) -
                      distance(ease, middle_of(a, h), a->piece[h / 3], across);
        }
    return ease->per_distance * change;
}

double ktg_ease_price(const ktg_ease *ease) {
    const ktg_arrangement *a = ease->a;
    double price = 0;
    if (!(ease->weight > 0))
        return 0;
    for (uint32_t e = 0; e < a->dual->edge_count; e++) {
        const uint32_t *pair = a->dual->edges[e].halfedge;
        price += a->folded[e] ? ease->weak[e]
                              : ease->per_distance * distance(ease, middle_of(a, pair[0]),
                                                              a->piece[pair[0] / 3], pair[1]);
    }
    for (uint32_t v = 0; v < a->dual->vertex_count; v++)
        price += ease->degree[v] == 1 ? ease->leaf : 0;
    return price;
}
