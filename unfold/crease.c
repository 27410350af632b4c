/* unfold/crease.c - how sharply a surface folds at its edges. */
#include "unfold/crease.h"
#include "core/vec.h"

/* From the two shorter edges, which keep their direction in a needle. */
static ktg_vec3 normal_of(const ktg_dual *dual, uint32_t face) {
    const ktg_vec3 *v = dual->edge_vectors + 3 * (size_t)face;
    const double *l = dual->lengths + 3 * (size_t)face;
    int longest = l[1] > l[0] ? 1 : 0;
    longest = l[2] > l[longest] ? 2 : longest;
    return ktg_unit3(ktg_cross3(ktg_unit3(v[(longest + 1) % 3]), ktg_unit3(v[(longest + 2) % 3])));
}

double ktg_dual_angle(const ktg_dual *dual, const ktg_dual_edge *edge) {
    ktg_vec3 m = normal_of(dual, edge->halfedge[0] / 3), n = normal_of(dual, edge->halfedge[1] / 3);
    ktg_vec3 along = ktg_unit3(dual->edge_vectors[edge->halfedge[0]]);
    return atan2(ktg_dot3(ktg_cross3(m, n), along), ktg_dot3(m, n));
}

double ktg_dual_crease(const ktg_dual *dual, const ktg_dual_edge *edge) {
    double angle = ktg_dual_angle(dual, edge) / (KTG_PI / 2);
    return fmin(1, angle < 0 ? -angle : 0.5 * angle);
}
