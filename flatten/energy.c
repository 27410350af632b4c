/* flatten/energy.c - the two energies of a flat shape and their gradients in closed form.
 *
 * As rigid as possible: Liu et al., "A Local/Global Approach to Mesh Parameterization" (2008).
 * Symmetric Dirichlet: Smith & Schaefer, "Bijective Parameterization with Free Boundaries" (2015),
 * which also has the largest step that turns no face over. In the plane |J^-1|^2 = |J|^2 / det^2,
 * so that neither needs singular values. */
#include "core/vec.h"
#include "flatten/iterate.h"

#include <string.h>

/* The energy of a map per area of its face; *slope: its derivative. */
typedef double face_energy(ktg_jacobian j, ktg_jacobian *slope);

/* The rotation next to J is that of its conformal part. */
static inline double arap(ktg_jacobian j, ktg_jacobian *slope) {
    double c = j.x.x + j.y.y, s = j.x.y - j.y.x, length = sqrt(c * c + s * s);
    c = length > 0 ? c / length : 1;
    s = length > 0 ? s / length : 0;
    *slope = (ktg_jacobian){{j.x.x - c, j.x.y - s}, {j.y.x + s, j.y.y - c}};
    return (ktg_dot2(slope->x, slope->x) + ktg_dot2(slope->y, slope->y)) / 2;
}

static inline double dirichlet(ktg_jacobian j, ktg_jacobian *slope) {
    double determinant = ktg_cross2(j.x, j.y);
    if (!(determinant > 0)) {
        *slope = (ktg_jacobian){{0, 0}, {0, 0}};
        return INFINITY;
    }
    double square = ktg_dot2(j.x, j.x) + ktg_dot2(j.y, j.y);
    double inverse = 1 / determinant;
    double along = 1 + inverse * inverse, across = -square * inverse * inverse * inverse;
    *slope = (ktg_jacobian){{along * j.x.x + across * j.y.y, along * j.x.y - across * j.y.x},
                            {along * j.y.x - across * j.x.y, along * j.y.y + across * j.x.x}};
    return square * along / 2;
}

static inline void add_slope(const ktg_rest *rest, const uint32_t *v, ktg_jacobian slope,
                             ktg_vec2 *gradient) {
    ktg_vec2 c = ktg_mul2(slope.y, rest->area * rest->inverse_height);
    ktg_vec2 b =
        ktg_mul2(ktg_madd2(ktg_mul2(slope.x, rest->area), -rest->x, c), rest->inverse_length);
    gradient[v[0]] = ktg_sub2(gradient[v[0]], ktg_add2(b, c));
    gradient[v[1]] = ktg_add2(gradient[v[1]], b);
    gradient[v[2]] = ktg_add2(gradient[v[2]], c);
}

static inline double sum(const ktg_panel *panel, const ktg_rest *rests, face_energy *energy,
                         const ktg_vec2 *flat, ktg_vec2 *gradient) {
    double total = 0;
    for (uint32_t f = 0; f < panel->face_count && total < INFINITY; f++) {
        const uint32_t *corners = panel->faces + 3 * (size_t)f;
        ktg_jacobian slope;
        total += rests[f].area * energy(ktg_jacobian_of(&rests[f], corners, flat), &slope);
        if (gradient)
            add_slope(&rests[f], corners, slope, gradient);
    }
    return total;
}

double ktg_energy_value(const ktg_panel *panel, const ktg_rest *rests, ktg_energy energy,
                        const ktg_vec2 *flat, ktg_vec2 *gradient) {
    if (gradient)
        memset(gradient, 0, panel->vertex_count * sizeof *gradient);
    return energy == KTG_ENERGY_ARAP ? sum(panel, rests, arap, flat, gradient)
                                     : sum(panel, rests, dirichlet, flat, gradient);
}

double ktg_springs_value(const ktg_panel *panel, const ktg_springs *springs, const ktg_vec2 *flat,
                         ktg_vec2 *gradient) {
    double total = 0;
    for (uint32_t k = 0; k < springs->count; k++) {
        uint32_t h = springs->halfedges[k];
        uint32_t a = panel->faces[h], b = panel->faces[ktg_halfedge_next(h)];
        ktg_vec2 along = ktg_sub2(flat[b], flat[a]);
        double length = ktg_length2(along), off = length - springs->lengths[k];
        total += springs->stiffness * off * off / 2;
        if (!gradient || !(length > 0))
            continue;
        ktg_vec2 pull = ktg_mul2(along, springs->stiffness * off / length);
        gradient[a] = ktg_sub2(gradient[a], pull);
        gradient[b] = ktg_add2(gradient[b], pull);
    }
    return total;
}

/* The smallest t > 0 at which a t^2 + b t + c, c > 0, is no longer positive, or `most`. */
static double first_root(double a, double b, double c, double most) {
    if (b >= 0 && a >= 0)
        return most;
    double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return most;
    double root = sqrt(discriminant);
    double t = b < 0 ? 2 * c / (root - b) : (-b - root) / (2 * a);
    return t < most ? t : most;
}

double ktg_largest_step(const ktg_panel *panel, const ktg_vec2 *flat, const ktg_vec2 *direction,
                        double most) {
    for (uint32_t f = 0; f < panel->face_count; f++) {
        const uint32_t *v = panel->faces + 3 * (size_t)f;
        ktg_vec2 p = ktg_sub2(flat[v[1]], flat[v[0]]), q = ktg_sub2(flat[v[2]], flat[v[0]]);
        ktg_vec2 dp = ktg_sub2(direction[v[1]], direction[v[0]]);
        ktg_vec2 dq = ktg_sub2(direction[v[2]], direction[v[0]]);
        most = first_root(ktg_cross2(dp, dq), ktg_cross2(p, dq) + ktg_cross2(dp, q),
                          ktg_cross2(p, q), most);
    }
    return most;
}

/* s^2 sum A |J|^2 + s^-2 sum A |J^-1|^2 is least for the fourth root of the sums' quotient. */
void ktg_dirichlet_set_size(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *flat) {
    double squares = 0, inverses = 0;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        ktg_jacobian j = ktg_jacobian_of(&rests[f], panel->faces + 3 * (size_t)f, flat);
        double square = ktg_dot2(j.x, j.x) + ktg_dot2(j.y, j.y);
        double determinant = ktg_cross2(j.x, j.y);
        squares += rests[f].area * square;
        inverses += rests[f].area * square / (determinant * determinant);
    }
    double size = sqrt(sqrt(inverses / squares));
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        flat[v] = ktg_mul2(flat[v], size);
}
