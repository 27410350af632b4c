/* flatten/relax.c - vertex after vertex down its own symmetric Dirichlet energy.
 *
 * A global step is as long as its most pressed face allows. Such faces are few and what presses
 * them is next to them, so that a Newton step of each vertex by itself, against its ring of faces,
 * frees them at the cost of about one evaluation. */
#include "core/vec.h"
#include "flatten/iterate.h"

/* The gradient of the hat function of a face's corner, in the face's plane. */
static ktg_vec2 hat_gradient(const ktg_rest *rest, uint32_t corner) {
    ktg_vec2 b = {rest->inverse_length, -rest->x * rest->inverse_length * rest->inverse_height};
    ktg_vec2 c = {0, rest->inverse_height};
    return corner == 1 ? b : corner == 2 ? c : (ktg_vec2){-b.x - c.x, -b.y - c.y};
}

/* E = s p(d) / 2 with s = |J|^2, d = det J, p = 1 + d^-2. When the corner moves by m, J changes by
 * m g^T, s by 2 m . (J g) + m^2 g^2 and d by m . n, linearly. */
static void add_face(const ktg_rest *rest, ktg_jacobian j, uint32_t corner, ktg_ring_energy *e) {
    double s = ktg_dot2(j.x, j.x) + ktg_dot2(j.y, j.y), d = ktg_cross2(j.x, j.y);
    if (!(d > 0)) {
        e->value = INFINITY;
        return;
    }
    double i = 1 / d, p = 1 + i * i, dp = -2 * i * i * i, ddp = 6 * i * i * i * i;
    ktg_vec2 g = hat_gradient(rest, corner);
    ktg_vec2 jg = {j.x.x * g.x + j.y.x * g.y, j.x.y * g.x + j.y.y * g.y};
    ktg_vec2 n = {j.y.y * g.x - j.x.y * g.y, j.x.x * g.y - j.y.x * g.x};
    double a = rest->area, gg = ktg_dot2(g, g);
    e->value += a * s * p / 2;
    e->slope = ktg_madd2(ktg_madd2(e->slope, a * p, jg), a * s * dp / 2, n);
    e->xx += a * (gg * p + 2 * dp * jg.x * n.x + s * ddp * n.x * n.x / 2);
    e->xy += a * (dp * (jg.x * n.y + jg.y * n.x) + s * ddp * n.x * n.y / 2);
    e->yy += a * (gg * p + 2 * dp * jg.y * n.y + s * ddp * n.y * n.y / 2);
}

ktg_ring_energy ktg_ring_energy_of(const ktg_panel *panel, const ktg_rest *rests,
                                   const ktg_vec2 *flat, uint32_t v) {
    ktg_ring_energy e = {0};
    uint32_t h = panel->leaving[v];
    do {
        ktg_jacobian j = ktg_jacobian_of(&rests[h / 3], panel->faces + h - h % 3, flat);
        add_face(&rests[h / 3], j, h % 3, &e);
        h = ktg_panel_around(panel, h);
    } while (h != panel->leaving[v] && h != KTG_NONE);
    return e;
}

/* Newton's step where the Hessian is positive definite, else down the slope. */
static ktg_vec2 newton_step(const ktg_ring_energy *e) {
    double determinant = e->xx * e->yy - e->xy * e->xy, trace = e->xx + e->yy;
    if (!(determinant > 1e-6 * trace * trace))
        return ktg_mul2(e->slope, -1 / fabs(trace));
    return (ktg_vec2){(e->xy * e->slope.y - e->yy * e->slope.x) / determinant,
                      (e->xy * e->slope.x - e->xx * e->slope.y) / determinant};
}

void ktg_relax_vertex(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *flat, uint32_t v) {
    ktg_vec2 from = flat[v];
    ktg_ring_energy e = ktg_ring_energy_of(panel, rests, flat, v);
    ktg_vec2 step = newton_step(&e);
    for (double t = 1; t > 1e-3; t /= 2) {
        flat[v] = ktg_madd2(from, t, step);
        if (ktg_ring_energy_of(panel, rests, flat, v).value < e.value)
            return;
    }
    flat[v] = from;
}

void ktg_relax(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *flat) {
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        ktg_relax_vertex(panel, rests, flat, v);
}
