/* flatten/neighbourhood.c - the neighbourhood of each edge laid flat, and the similarity fitted to
 * it.
 *
 * Igarashi & Igarashi 2009, section 7 (figure 5) for the flat corners, section 6 for the cotangent
 * weights, section 4.2, equations 2 and 3, for the fit, which is made relative to one end of the
 * edge instead of to the origin (docs/flatten.md). */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>

/* Below this part of the mean weight a cotangent weight is raised: obtuse triangles make them
 * negative, and the systems would no longer be positive definite. */
static const double least_weight = 1e-3;

/* Cotangents are cut off here (an angle of half a degree), so that a few slivers do not own the
 * mean. */
static const double largest_cotangent = 100;

/* The corner `p` opposite of the edge from a to b (of `length`), in the plane: x along the edge, y
 * away from it. */
static ktg_vec2 lay_flat(ktg_vec3 a, ktg_vec3 b, double length, ktg_vec3 p) {
    ktg_vec3 ab = ktg_sub3(b, a), ap = ktg_sub3(p, a);
    return (ktg_vec2){ktg_dot3(ab, ap) / length, ktg_length3(ktg_cross3(ab, ap)) / length};
}

/* Of the angle at a flat corner, over an edge of `length`. */
static double cotangent(ktg_vec2 corner, double length) {
    double value = (corner.x * (corner.x - length) + corner.y * corner.y) / (length * corner.y);
    return fmax(-largest_cotangent, fmin(largest_cotangent, value));
}

static ktg_neighbourhood lay_neighbourhood_flat(const ktg_panel *panel, uint32_t h) {
    uint32_t next = ktg_halfedge_next(h), twin = panel->adjacency->twin[h];
    ktg_neighbourhood n = {.count = twin == KTG_NONE ? 3 : 4};
    n.vertices[0] = panel->faces[h];
    n.vertices[1] = panel->faces[next];
    n.vertices[2] = panel->faces[ktg_halfedge_next(next)];
    ktg_vec3 a = panel->positions[n.vertices[0]], b = panel->positions[n.vertices[1]];
    double length = ktg_length3(ktg_sub3(b, a));
    n.flat[1] = (ktg_vec2){length, 0};
    n.flat[2] = lay_flat(a, b, length, panel->positions[n.vertices[2]]);
    n.weight = cotangent(n.flat[2], length) / 2;
    if (twin != KTG_NONE) {
        n.vertices[3] = panel->faces[ktg_halfedge_next(ktg_halfedge_next(twin))];
        n.flat[3] = lay_flat(a, b, length, panel->positions[n.vertices[3]]);
        n.weight += cotangent(n.flat[3], length) / 2;
        n.flat[3].y = -n.flat[3].y;
    }
    return n;
}

static void set_weights(ktg_neighbourhood *neighbourhoods, uint32_t count, ktg_edge_weight kind) {
    double sum = 0;
    for (uint32_t e = 0; e < count; e++)
        sum += neighbourhoods[e].weight;
    double least = least_weight * sum / count;
    for (uint32_t e = 0; e < count; e++) {
        double *weight = &neighbourhoods[e].weight;
        *weight = kind == KTG_WEIGHT_UNIT ? 1 : fmax(*weight, least);
    }
}

ktg_status ktg_neighbourhoods_new(ktg_context *context, const ktg_panel *panel,
                                  ktg_edge_weight weight, ktg_neighbourhood **neighbourhoods) {
    const ktg_adjacency *a = panel->adjacency;
    *neighbourhoods = ktg_new(context, a->edge_count, ktg_neighbourhood);
    if (!*neighbourhoods)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < a->edge_count; e++)
        (*neighbourhoods)[e] = lay_neighbourhood_flat(panel, a->edge_halfedges[a->edge_first[e]]);
    set_weights(*neighbourhoods, a->edge_count, weight);
    return KTG_OK;
}

/* With q_v = flat_v - flat_base and z the positions: sum |T q_v - (z_v - z_base)|^2 is least for
 * T = sum conj(q_v) (z_v - z_base) / sum |q_v|^2. */
void ktg_neighbourhood_similarity(const ktg_neighbourhood *neighbourhood, uint32_t base,
                                  ktg_vec2 factors[4]) {
    double sum = 0;
    for (uint32_t v = 0; v < neighbourhood->count; v++) {
        ktg_vec2 q = ktg_sub2(neighbourhood->flat[v], neighbourhood->flat[base]);
        factors[v] = (ktg_vec2){q.x, -q.y};
        sum += ktg_dot2(q, q);
    }
    ktg_vec2 rest = {0, 0};
    for (uint32_t v = 0; v < neighbourhood->count; v++) {
        factors[v] = ktg_mul2(factors[v], 1 / sum);
        rest = ktg_sub2(rest, factors[v]);
    }
    factors[base] = rest;
}

void ktg_neighbourhood_residual(const ktg_neighbourhood *n, uint32_t base, ktg_vec2 factors[4]) {
    ktg_neighbourhood_similarity(n, base, factors);
    for (uint32_t v = 0; v < n->count; v++)
        factors[v] = ktg_mul2(factors[v], -n->flat[1].x);
    factors[0].x -= 1;
    factors[1].x += 1;
}
