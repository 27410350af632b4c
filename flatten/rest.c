/* flatten/rest.c - every face as it lies in its own plane, and the edge weights that follow. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/iterate.h"

static ktg_rest rest_of(const ktg_panel *panel, uint32_t face) {
    const uint32_t *v = panel->faces + 3 * (size_t)face;
    const ktg_vec3 *p = panel->positions;
    ktg_vec3 along = ktg_sub3(p[v[1]], p[v[0]]), third = ktg_sub3(p[v[2]], p[v[0]]);
    double length = ktg_length3(along);
    double height = ktg_length3(ktg_cross3(along, third)) / length;
    return (ktg_rest){1 / length, ktg_dot3(third, along) / length, 1 / height, length * height / 2};
}

ktg_status ktg_rests_new(ktg_context *context, const ktg_panel *panel, ktg_rest **rests) {
    *rests = ktg_new(context, panel->face_count, ktg_rest);
    if (!*rests)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < panel->face_count; f++)
        (*rests)[f] = rest_of(panel, f);
    return KTG_OK;
}

/* A symmetric 2 x 2 matrix. */
typedef struct metric {
    double xx, xy, yy;
} metric;

/* Adds -A grad_i . M grad_j of each pair of corners to the weight of their edge. */
static void add_face(const ktg_panel *panel, const ktg_rest *rest, uint32_t face, metric m,
                     double *weights) {
    const uint32_t *edges = panel->adjacency->halfedge_edge + 3 * (size_t)face;
    ktg_vec2 b = {rest->inverse_length, -rest->x * rest->inverse_length * rest->inverse_height};
    ktg_vec2 c = {0, rest->inverse_height};
    ktg_vec2 mb = {m.xx * b.x + m.xy * b.y, m.xy * b.x + m.yy * b.y};
    ktg_vec2 mc = {m.xy * c.y, m.yy * c.y};
    double bc = ktg_dot2(b, mc), bb = ktg_dot2(b, mb), cc = ktg_dot2(c, mc);
    weights[edges[0]] += rest->area * (bb + bc);
    weights[edges[1]] -= rest->area * bc;
    weights[edges[2]] += rest->area * (cc + bc);
}

static void clear_weights(const ktg_panel *panel, double *weights) {
    for (uint32_t e = 0; e < panel->adjacency->edge_count; e++)
        weights[e] = 0;
}

void ktg_cotangent_weights(const ktg_panel *panel, const ktg_rest *rests, double *weights) {
    clear_weights(panel, weights);
    for (uint32_t f = 0; f < panel->face_count; f++)
        add_face(panel, &rests[f], f, (metric){1, 0, 1}, weights);
}

/* E'(s) / (s - 1) for E = (s^2 + s^-2) / 2. */
static double stiffness(double s) {
    return (s + 1) * (s * s + 1) / (s * s * s);
}

/* The symmetric matrix with the eigenvectors of J^T J and, for its eigenvalues s^2, stiffness(s):
 * the reweighting of Rabinovich et al., "Scalable Locally Injective Mappings" (2017), on the side
 * of the rest shape instead of the flat one, so that x and y share one matrix. */
static metric proxy_metric(ktg_jacobian j) {
    double conformal = hypot(j.x.x + j.y.y, j.x.y - j.y.x) / 2;
    double anticonformal = hypot(j.x.x - j.y.y, j.x.y + j.y.x) / 2;
    double s1 = conformal + anticonformal;
    double s2 = ktg_dot2(j.x, (ktg_vec2){j.y.y, -j.y.x}) / s1;
    double m1 = stiffness(s1), m2 = stiffness(s2), apart = s1 * s1 - s2 * s2;
    double slope = apart > 1e-9 * s1 * s1 ? (m1 - m2) / apart : 0;
    double rest = m1 - slope * s1 * s1;
    return (metric){rest + slope * ktg_dot2(j.x, j.x), slope * ktg_dot2(j.x, j.y),
                    rest + slope * ktg_dot2(j.y, j.y)};
}

void ktg_proxy_weights(const ktg_panel *panel, const ktg_rest *rests, const ktg_vec2 *flat,
                       double *weights) {
    clear_weights(panel, weights);
    for (uint32_t f = 0; f < panel->face_count; f++) {
        ktg_jacobian j = ktg_jacobian_of(&rests[f], panel->faces + 3 * (size_t)f, flat);
        add_face(panel, &rests[f], f, proxy_metric(j), weights);
    }
}
