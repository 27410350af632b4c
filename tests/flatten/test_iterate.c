/* The parts of the iterative methods by themselves: energies, Laplacian, starts, steps. */
#include "core/random.h"
#include "flatten/iterate.h"
#include "tests/flatten/panels.h"

#include <string.h>

/* A panel, its rests and a flat shape to work on. */
typedef struct bench_panel {
    ktg_context *context;
    ktg_mesh *mesh;
    ktg_panel *panel;
    ktg_rest *rests;
    ktg_vec2 *flat;
    double area;
} bench_panel;

static bench_panel lay_out(ktg_context *context, ktg_mesh *mesh) {
    bench_panel b = {.context = context, .mesh = mesh};
    assert_int_equal(ktg_panel_new(context, mesh, &b.panel), KTG_OK);
    assert_int_equal(ktg_rests_new(context, b.panel, &b.rests), KTG_OK);
    b.flat = ktg_new(context, mesh->vertex_count, ktg_vec2);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        b.area += b.rests[f].area;
    return b;
}

static void clear_away(bench_panel *b) {
    ktg_free(b->flat);
    ktg_free(b->rests);
    ktg_panel_free(&b->panel);
    ktg_mesh_free(&b->mesh);
}

/* Seen from above, pulled about a little: no face is flipped. */
static void pull_about(bench_panel *b, double amount) {
    ktg_random random;
    ktg_random_seed(&random, 7);
    for (uint32_t v = 0; v < b->panel->vertex_count; v++) {
        ktg_vec3 p = b->panel->positions[v];
        b->flat[v] = (ktg_vec2){1.2 * p.x + 0.3 * p.y + amount * ktg_random_unit(&random),
                                0.7 * p.y - 0.2 * p.x + amount * ktg_random_unit(&random)};
    }
    assert_int_equal(ktg_panel_count_turned_over(b->panel, b->flat), 0);
}

/* ---- energies ----------------------------------------------------------------------------- */

static double value(const bench_panel *b, ktg_energy energy) {
    return ktg_energy_value(b->panel, b->rests, energy, b->flat, NULL);
}

static void energies_are_those_of_the_singular_values(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, shallow_cap, 5));
    pull_about(&b, 0.02);
    double arap = 0, dirichlet = 0;
    for (uint32_t f = 0; f < b.panel->face_count; f++) {
        ktg_face_map m = ktg_face_map_of(b.panel, f, b.flat);
        arap += m.area * ((m.s1 - 1) * (m.s1 - 1) + (m.s2 - 1) * (m.s2 - 1)) / 2;
        dirichlet +=
            m.area * (m.s1 * m.s1 + m.s2 * m.s2 + 1 / (m.s1 * m.s1) + 1 / (m.s2 * m.s2)) / 2;
    }
    assert_true(fabs(value(&b, KTG_ENERGY_ARAP) - arap) < 1e-12);
    assert_true(fabs(value(&b, KTG_ENERGY_DIRICHLET) - dirichlet) < 1e-12);
    b.flat[0] = (ktg_vec2){9, 9}; /* turns a face over */
    assert_true(isinf(value(&b, KTG_ENERGY_DIRICHLET)) && isfinite(value(&b, KTG_ENERGY_ARAP)));
    clear_away(&b);
}

static void gradients_agree_with_finite_differences(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, shallow_cap, 5));
    ktg_vec2 gradient[36];
    pull_about(&b, 0.02);
    for (ktg_energy energy = KTG_ENERGY_ARAP; energy <= KTG_ENERGY_DIRICHLET; energy++) {
        (void)ktg_energy_value(b.panel, b.rests, energy, b.flat, gradient);
        for (uint32_t k = 0; k < 72; k++) {
            double *x = &(&b.flat[0].x)[k], at = *x, h = 1e-6;
            *x = at + h;
            double above = value(&b, energy);
            *x = at - h;
            double below = value(&b, energy);
            *x = at;
            assert_true(fabs((above - below) / (2 * h) - (&gradient[0].x)[k]) <
                        1e-7 * (1 + fabs((&gradient[0].x)[k])));
        }
    }
    clear_away(&b);
}

static void a_vertex_and_its_ring_have_the_right_slope_and_hessian(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, shallow_cap, 5));
    ktg_vec2 gradient[36];
    pull_about(&b, 0.02);
    (void)ktg_energy_value(b.panel, b.rests, KTG_ENERGY_DIRICHLET, b.flat, gradient);
    for (uint32_t v = 0; v < 36; v++) {
        ktg_ring_energy e = ktg_ring_energy_of(b.panel, b.rests, b.flat, v);
        assert_true(ktg_length2(ktg_sub2(e.slope, gradient[v])) < 1e-12);
        double h = 1e-6;
        ktg_vec2 at = b.flat[v], slopes[4];
        const ktg_vec2 moves[] = {{h, 0}, {-h, 0}, {0, h}, {0, -h}};
        for (int k = 0; k < 4; k++) {
            b.flat[v] = ktg_add2(at, moves[k]);
            slopes[k] = ktg_ring_energy_of(b.panel, b.rests, b.flat, v).slope;
        }
        b.flat[v] = at;
        ktg_vec2 x = ktg_mul2(ktg_sub2(slopes[0], slopes[1]), 1 / (2 * h));
        ktg_vec2 y = ktg_mul2(ktg_sub2(slopes[2], slopes[3]), 1 / (2 * h));
        double size = fabs(e.xx) + fabs(e.yy);
        assert_true(fabs(x.x - e.xx) + fabs(x.y - e.xy) < 1e-6 * size);
        assert_true(fabs(y.x - e.xy) + fabs(y.y - e.yy) < 1e-6 * size);
    }
    clear_away(&b);
}

static void a_sweep_lowers_the_energy_and_turns_nothing_over(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, shallow_cap, 8));
    pull_about(&b, 0.01);
    double before = value(&b, KTG_ENERGY_DIRICHLET);
    for (int k = 0; k < 300; k++) {
        ktg_relax(b.panel, b.rests, b.flat);
        double now = value(&b, KTG_ENERGY_DIRICHLET);
        assert_true(now <= before);
        before = now;
    }
    assert_true(before < 2.01 * b.area); /* 2 per area at best */
    clear_away(&b);
}

static void a_step_ends_where_the_first_face_loses_its_area(void **state) {
    const ktg_vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const uint32_t faces[] = {0, 1, 2, 2, 1, 3};
    bench_panel b = lay_out(*state, small_mesh(*state, corners, 4, faces, 2));
    ktg_vec2 direction[4] = {{0, 0}, {0, 0}, {0, 0}, {-2, -2}};
    for (int v = 0; v < 4; v++)
        b.flat[v] = (ktg_vec2){corners[v].x, corners[v].y};
    /* the last corner meets the diagonal when it is at (1/2, 1/2) */
    assert_true(fabs(ktg_largest_step(b.panel, b.flat, direction, 9) - 0.25) < 1e-15);
    assert_true(ktg_largest_step(b.panel, b.flat, direction, 0.2) == 0.2);
    /* both legs of the first face turn; it is flat when they have turned by a right angle */
    direction[3] = (ktg_vec2){0, 0};
    direction[1] = (ktg_vec2){-1, 0};
    direction[2] = (ktg_vec2){0, -1};
    assert_true(fabs(ktg_largest_step(b.panel, b.flat, direction, 9) - 1) < 1e-15);
    direction[1] = direction[2] = (ktg_vec2){5, -3}; /* away from it, never flat */
    direction[0] = direction[3] = direction[1];
    assert_true(ktg_largest_step(b.panel, b.flat, direction, 9) == 9);
    clear_away(&b);
}

static void the_best_size_is_found(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, shallow_cap, 5));
    pull_about(&b, 0.02);
    for (uint32_t v = 0; v < 36; v++)
        b.flat[v] = ktg_mul2(b.flat[v], 17);
    ktg_dirichlet_set_size(b.panel, b.rests, b.flat);
    double best = value(&b, KTG_ENERGY_DIRICHLET);
    const double factors[] = {0.99, 1 / 0.9999, 1.01};
    for (int k = 0; k < 3; k++) {
        for (uint32_t v = 0; v < 36; v++)
            b.flat[v] = ktg_mul2(b.flat[v], factors[k]);
        assert_true(value(&b, KTG_ENERGY_DIRICHLET) > best);
        for (uint32_t v = 0; v < 36; v++)
            b.flat[v] = ktg_mul2(b.flat[v], 1 / factors[k]);
    }
    clear_away(&b);
}

/* ---- Laplacian ---------------------------------------------------------------------------- */

static double quadratic_form(const bench_panel *b, const double *weights) {
    double sum = 0;
    for (uint32_t e = 0; e < b->panel->adjacency->edge_count; e++) {
        uint32_t h = b->panel->adjacency->edge_halfedges[b->panel->adjacency->edge_first[e]];
        ktg_vec2 d =
            ktg_sub2(b->flat[b->panel->faces[ktg_halfedge_next(h)]], b->flat[b->panel->faces[h]]);
        sum += weights[e] * ktg_dot2(d, d);
    }
    return sum;
}

static void cotangents_make_the_dirichlet_energy(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, shallow_cap, 5));
    double *weights = ktg_new(*state, b.panel->adjacency->edge_count, double), wanted = 0;
    pull_about(&b, 0.02);
    for (uint32_t f = 0; f < b.panel->face_count; f++) {
        ktg_face_map m = ktg_face_map_of(b.panel, f, b.flat);
        wanted += m.area * (m.s1 * m.s1 + m.s2 * m.s2);
    }
    ktg_cotangent_weights(b.panel, b.rests, weights);
    assert_true(fabs(quadratic_form(&b, weights) - wanted) < 1e-12);
    ktg_free(weights);
    clear_away(&b);
}

/* A map that is 2 along the model's x and 1/2 along y, on a plane: stiffness (s + 1) (s^2 + 1) /
 * s^3 is 15/8 and 15, so that the quadratic form of any map has these factors. */
static void the_proxy_weighs_each_direction_by_its_stiffness(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, plane, 5));
    double *weights = ktg_new(*state, b.panel->adjacency->edge_count, double);
    ktg_vec2 stretched[36];
    for (uint32_t v = 0; v < 36; v++) {
        ktg_vec3 p = b.panel->positions[v];
        stretched[v] = (ktg_vec2){2 * p.x, 0.5 * p.y};
        b.flat[v] = (ktg_vec2){3 * p.x, 5 * p.y};
    }
    ktg_proxy_weights(b.panel, b.rests, stretched, weights);
    double wanted = b.area * (15.0 / 8 * 9 + 15.0 * 25);
    assert_true(fabs(quadratic_form(&b, weights) / wanted - 1) < 1e-12);
    ktg_free(weights);
    clear_away(&b);
}

static void a_laplacian_is_solved_around_held_vertices_for_any_weights(void **state) {
    bench_panel b = lay_out(*state, grid_panel(*state, plane, 5));
    bool held[36] = {false};
    double *weights = ktg_new(*state, b.panel->adjacency->edge_count, double);
    ktg_laplacian *laplacian;
    for (uint32_t v = 0; v < 36; v++)
        held[v] = v % 6 == 0 || v % 6 == 5 || v / 6 == 0 || v / 6 == 5;
    assert_int_equal(ktg_laplacian_new(*state, b.panel, held, &laplacian), KTG_OK);
    for (int round = 1; round <= 3; round++) {
        ktg_cotangent_weights(b.panel, b.rests, weights);
        for (uint32_t e = 0; e < b.panel->adjacency->edge_count; e++)
            weights[e] *= round;
        assert_int_equal(ktg_laplacian_factor(*state, laplacian, weights), KTG_OK);
        /* linear functions are harmonic */
        for (uint32_t v = 0; v < 36; v++) {
            ktg_vec3 p = b.panel->positions[v];
            b.flat[v] = held[v] ? (ktg_vec2){p.x - p.y, round * p.y} : (ktg_vec2){99, 99};
        }
        assert_int_equal(ktg_laplacian_extend(*state, laplacian, b.flat), KTG_OK);
        for (uint32_t v = 0; v < 36; v++) {
            ktg_vec3 p = b.panel->positions[v];
            assert_true(fabs(b.flat[v].x - p.x + p.y) + fabs(b.flat[v].y - round * p.y) < 1e-13);
        }
        /* one unit of force: the answer falls as the weights grow, and is 0 where it is held */
        memset(b.flat, 0, 36 * sizeof *b.flat);
        b.flat[14].x = round;
        assert_int_equal(ktg_laplacian_solve(*state, laplacian, b.flat, b.flat), KTG_OK);
        assert_true(b.flat[0].x == 0 && b.flat[14].y == 0 && b.flat[14].x > 0);
        double once = b.flat[14].x;
        static double first;
        first = round == 1 ? once : first;
        assert_true(fabs(once - first) < 1e-13);
    }
    ktg_laplacian_free(&laplacian);
    ktg_laplacian_free(&laplacian);
    ktg_free(weights);
    clear_away(&b);
}

/* ---- starts ------------------------------------------------------------------------------- */

/* The conformal map of a cap of the unit sphere onto a disk whose border keeps its length shrinks
 * the pole by cos^2(reach / 2). */
static void the_conformal_start_of_a_cap_is_the_stereographic_map(void **state) {
    enum { side = 64 };
    bench_panel b = lay_out(*state, grid_panel(*state, hemisphere, side));
    assert_int_equal(ktg_conformal_start(*state, b.panel, b.rests, b.flat), KTG_OK);
    assert_int_equal(ktg_panel_count_turned_over(b.panel, b.flat), 0);
    double skew = 0, length = 0, centre = (side + 1) * (side / 2) + side / 2;
    for (uint32_t f = 0; f < b.panel->face_count; f++) {
        ktg_face_map m = ktg_face_map_of(b.panel, f, b.flat);
        skew += m.area * (m.s1 / m.s2 - 1) / b.area;
        const uint32_t *v = b.panel->faces + 3 * (size_t)f;
        if (v[0] == centre || v[1] == centre || v[2] == centre)
            assert_true(fabs(m.s1 - 0.5) < 0.01 && fabs(m.s2 - 0.5) < 0.01);
    }
    assert_true(skew < 0.02);
    for (uint32_t i = 0; i < side; i++)
        length += ktg_length2(ktg_sub2(b.flat[i + 1], b.flat[i]));
    assert_true(fabs(ldexp(length, b.panel->exponent) - KTG_PI / 2) < 0.002);
    clear_away(&b);
}

static void the_convex_start_turns_nothing_over(void **state) {
    surface *const surfaces[] = {almost_sphere, spikes, ramp, zigzag, sock, uneven};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        bench_panel b = lay_out(*state, grid_panel(*state, surfaces[k], 24));
        assert_int_equal(ktg_convex_start(*state, b.panel, b.rests, b.flat), KTG_OK);
        assert_int_equal(ktg_panel_count_turned_over(b.panel, b.flat), 0);
        double radius = ktg_length2(b.flat[0]);
        for (uint32_t i = 0; i < 24; i++)
            assert_true(fabs(ktg_length2(b.flat[i]) - radius) < 1e-14);
        assert_true(fabs(KTG_PI * radius * radius - b.area) < 1e-12 * b.area);
        clear_away(&b);
    }
}

/* ---- descent ------------------------------------------------------------------------------ */

/* Plain local/global iteration, as the book has it: rotations, then L positions = their sum. */
static void iterate_plainly(bench_panel *b, int iterations) {
    bool *held = ktg_new(b->context, b->panel->vertex_count, bool);
    ktg_vec2 *gradient = ktg_new(b->context, b->panel->vertex_count, ktg_vec2);
    double *weights = ktg_new(b->context, b->panel->adjacency->edge_count, double);
    ktg_laplacian *laplacian;
    held[0] = true;
    ktg_cotangent_weights(b->panel, b->rests, weights);
    assert_int_equal(ktg_laplacian_new(b->context, b->panel, held, &laplacian), KTG_OK);
    assert_int_equal(ktg_laplacian_factor(b->context, laplacian, weights), KTG_OK);
    for (int i = 0; i < iterations; i++) {
        (void)ktg_energy_value(b->panel, b->rests, KTG_ENERGY_ARAP, b->flat, gradient);
        assert_int_equal(ktg_laplacian_solve(b->context, laplacian, gradient, gradient), KTG_OK);
        for (uint32_t v = 0; v < b->panel->vertex_count; v++)
            b->flat[v] = ktg_sub2(b->flat[v], gradient[v]);
    }
    ktg_laplacian_free(&laplacian);
    ktg_free(held);
    ktg_free(gradient);
    ktg_free(weights);
}

static void few_steps_end_where_many_plain_iterations_do(void **state) {
    surface *const surfaces[] = {shallow_cap, hemisphere, saddle, ripples};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        bench_panel b = lay_out(*state, grid_panel(*state, surfaces[k], 20));
        uint32_t iterations = 0;
        assert_int_equal(ktg_conformal_start(*state, b.panel, b.rests, b.flat), KTG_OK);
        iterate_plainly(&b, 2000);
        double plain = value(&b, KTG_ENERGY_ARAP);
        assert_int_equal(ktg_conformal_start(*state, b.panel, b.rests, b.flat), KTG_OK);
        assert_int_equal(
            ktg_descend(*state, b.panel, b.rests, KTG_ENERGY_ARAP, NULL, b.flat, &iterations),
            KTG_OK);
        assert_true(value(&b, KTG_ENERGY_ARAP) < 1.001 * plain);
        assert_in_range(iterations, 1, 60);
        clear_away(&b);
    }
}

static void going_on_brings_little(void **state) {
    surface *const surfaces[] = {almost_sphere, spikes, sock};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        bench_panel b = lay_out(*state, grid_panel(*state, surfaces[k], 24));
        uint32_t iterations = 0;
        assert_int_equal(ktg_convex_start(*state, b.panel, b.rests, b.flat), KTG_OK);
        double energies[8] = {value(&b, KTG_ENERGY_DIRICHLET)};
        for (int i = 1; i < 8; i++) {
            assert_int_equal(ktg_descend(*state, b.panel, b.rests, KTG_ENERGY_DIRICHLET, NULL,
                                         b.flat, &iterations),
                             KTG_OK);
            assert_int_equal(ktg_panel_count_turned_over(b.panel, b.flat), 0);
            energies[i] = value(&b, KTG_ENERGY_DIRICHLET);
            assert_true(energies[i] < (1 + 1e-12) * energies[i - 1]);
        }
        assert_true(energies[1] < energies[0] && energies[1] < 1.01 * energies[7]);
        clear_away(&b);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(energies_are_those_of_the_singular_values),
        TEST(gradients_agree_with_finite_differences),
        TEST(a_vertex_and_its_ring_have_the_right_slope_and_hessian),
        TEST(a_sweep_lowers_the_energy_and_turns_nothing_over),
        TEST(a_step_ends_where_the_first_face_loses_its_area),
        TEST(the_best_size_is_found),
        TEST(cotangents_make_the_dirichlet_energy),
        TEST(the_proxy_weighs_each_direction_by_its_stiffness),
        TEST(a_laplacian_is_solved_around_held_vertices_for_any_weights),
        TEST(the_conformal_start_of_a_cap_is_the_stereographic_map),
        TEST(the_convex_start_turns_nothing_over),
        TEST(few_steps_end_where_many_plain_iterations_do),
        TEST(going_on_brings_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
