/* The three methods: how little they strain, that none ever writes a fold, which one takes over. */
#include "core/random.h"
#include "tests/flatten/panels.h"
#include "tests/short_memory.h"

#include <string.h>

static ktg_flatten_options by_method(ktg_flatten_method method) {
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.method = method;
    options.seams = KTG_SEAMS_MARKED; /* none: these tests are about single panels */
    return options;
}

/* Checks the written shape with arithmetic of its own. */
static void assert_no_fold(const ktg_pattern *pattern) {
    const ktg_pattern_piece *piece = &pattern->pieces[0];
    for (size_t f = 0; f < piece->face_count; f++) {
        const uint32_t *c = piece->corners + 3 * f;
        const ktg_vec2 a = piece->vertices[c[0]], b = piece->vertices[c[1]],
                       d = piece->vertices[c[2]];
        assert_true((b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x) > 0);
    }
}

/* Flattens; on success nothing is folded, on failure there is a sentence. */
static ktg_status flatten_by(ktg_context *context, const ktg_mesh *mesh, ktg_flatten_method method,
                             ktg_flatten_report *report) {
    ktg_flatten_options options = by_method(method);
    ktg_pattern *pattern;
    ktg_status status = ktg_flatten(context, mesh, "panel", &options, &pattern, report);
    ktg_flatten_report_free(report);
    if (status == KTG_OK) {
        assert_no_fold(pattern);
        assert_int_equal(report->whole.flipped_faces, 0);
    } else {
        assert_null(pattern);
        assert_string_not_equal(ktg_context_message(context), "");
    }
    ktg_pattern_free(&pattern);
    return status;
}

/* ---- how little they strain --------------------------------------------------------------- */

/* The radial map r(t) of a cap (t: angle from the pole) with the least ARAP energy: sin t (r' sin
 * t)' - r = sin t (cos t - 1), whose solutions through the pole are a tan(t / 2) + particular(t).
 */
static double particular(double t) {
    double half = t / 2, s = sin(half);
    return (tan(half) * cos(t) - (4 * log(cos(half)) + 2 * s * s) / tan(half)) / 2;
}

static double slope_of_particular(double t) {
    return (particular(t + 1e-6) - particular(t - 1e-6)) / 2e-6;
}

/* Its energy per area; at the border r' = 1, which settles a. */
static double least_energy_of_cap(double reach) {
    enum { steps = 2000 };
    double a = (1 - slope_of_particular(reach)) * 2 * cos(reach / 2) * cos(reach / 2), sum = 0;
    for (int k = 0; k < steps; k++) {
        double t = (k + 0.5) * reach / steps, c = cos(t / 2);
        double along = a / (2 * c * c) + slope_of_particular(t) - 1;
        double around = (a * tan(t / 2) + particular(t)) / sin(t) - 1;
        sum += (along * along + around * around) * sin(t) * reach / steps;
    }
    return sum / (1 - cos(reach));
}

static void caps_come_out_with_the_least_energy_there_is(void **state) {
    surface *const caps[] = {shallow_cap, hemisphere};
    const double reaches[] = {0.5, KTG_PI / 2};
    for (int k = 0; k < 2; k++) {
        ktg_flatten_report report;
        ktg_mesh *mesh = grid_panel(*state, caps[k], 64);
        assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_ARAP, &report), KTG_OK);
        assert_int_equal(report.whole.method, KTG_FLATTEN_ARAP);
        assert_true(fabs(report.whole.arap_energy / least_energy_of_cap(reaches[k]) - 1) < 0.01);
        ktg_mesh_free(&mesh);
    }
}

static void arap_strains_least_and_injective_has_the_least_dirichlet_energy(void **state) {
    surface *const surfaces[] = {hemisphere, saddle, ripples, shallow_cap};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        ktg_mesh *mesh = grid_panel(*state, surfaces[k], 30);
        ktg_flatten_report arap, injective, two_step;
        assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_ARAP, &arap), KTG_OK);
        assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_INJECTIVE, &injective), KTG_OK);
        assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_TWO_STEP, &two_step), KTG_OK);
        assert_true(arap.whole.arap_energy <= injective.whole.arap_energy);
        assert_true(arap.whole.arap_energy <= two_step.whole.arap_energy);
        assert_true(injective.whole.symmetric_dirichlet <= arap.whole.symmetric_dirichlet);
        assert_true(injective.whole.symmetric_dirichlet >= 4);
        assert_false(arap.interrupted || injective.interrupted || two_step.interrupted);
        assert_int_equal(arap.whole.method, KTG_FLATTEN_ARAP);
        assert_int_equal(injective.whole.method, KTG_FLATTEN_INJECTIVE);
        assert_int_equal(two_step.whole.method, KTG_FLATTEN_TWO_STEP);
        assert_true(arap.whole.iterations > 0 && injective.whole.iterations > 0 &&
                    two_step.whole.iterations == 0);
        ktg_mesh_free(&mesh);
    }
}

static void every_method_lays_developable_surfaces_flat(void **state) {
    surface *const surfaces[] = {plane, zigzag, cylinder, cone, slit_ring};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++)
        for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
            ktg_flatten_report report;
            ktg_mesh *mesh = grid_panel(*state, surfaces[k], 24);
            assert_int_equal(flatten_by(*state, mesh, m, &report), KTG_OK);
            assert_true(report.whole.strain_max < 1e-9);
            assert_true(fabs(report.whole.symmetric_dirichlet - 4) < 1e-9);
            assert_true(report.whole.area_beyond_limit == 0);
            ktg_mesh_free(&mesh);
        }
}

static void the_area_beyond_a_limit_is_told(void **state) {
    ktg_mesh *mesh = grid_panel(*state, hemisphere, 16);
    ktg_flatten_options options = by_method(KTG_FLATTEN_ARAP);
    ktg_flatten_report report;
    double before = 1.1;
    for (options.strain_limit = 0; options.strain_limit < 0.5; options.strain_limit += 0.05) {
        ktg_pattern *pattern;
        assert_int_equal(ktg_flatten(*state, mesh, "a", &options, &pattern, &report), KTG_OK);
        ktg_flatten_report_free(&report);
        double beyond = 0, total = 0;
        for (uint32_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *v = mesh->faces + 3 * (size_t)f;
            ktg_vec3 p = mesh->positions[v[0]];
            double area = ktg_length3(
                ktg_cross3(ktg_sub3(mesh->positions[v[1]], p), ktg_sub3(mesh->positions[v[2]], p)));
            total += area;
            beyond += pattern->face_strain[f] > options.strain_limit ? area : 0;
        }
        assert_true(fabs(report.whole.area_beyond_limit - beyond / total) < 1e-12);
        assert_true(report.strain_limit == options.strain_limit);
        assert_true(report.whole.area_beyond_limit <= before);
        before = report.whole.area_beyond_limit;
        ktg_pattern_free(&pattern);
    }
    assert_true(before < 0.2);
    ktg_mesh_free(&mesh);
}

/* ---- no folds ----------------------------------------------------------------------------- */

static void where_arap_folds_injective_takes_over(void **state) {
    surface *const surfaces[] = {almost_sphere, spikes, uneven};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        ktg_mesh *mesh = grid_panel(*state, surfaces[k], 40);
        ktg_flatten_report arap, injective;
        assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_ARAP, &arap), KTG_OK);
        assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_INJECTIVE, &injective), KTG_OK);
        assert_int_equal(arap.whole.method, KTG_FLATTEN_INJECTIVE);
        assert_true(arap.whole.flipped_by_arap > 0 && injective.whole.flipped_by_arap == 0);
        assert_true(arap.whole.symmetric_dirichlet == injective.whole.symmetric_dirichlet);
        assert_true(arap.whole.iterations == injective.whole.iterations);
        ktg_mesh_free(&mesh);
    }
}

static void where_arap_crosses_injective_takes_over(void **state) {
    ktg_mesh *mesh = grid_panel(*state, monkey_saddle, 60);
    ktg_flatten_report report;
    assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_ARAP, &report), KTG_OK);
    assert_int_equal(report.whole.method, KTG_FLATTEN_INJECTIVE);
    assert_true(report.whole.flipped_by_arap == 0 && report.whole.crossed_by_arap);
    ktg_mesh_free(&mesh);
    mesh = grid_panel(*state, ramp, 40);
    assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_ARAP, &report), KTG_GEOMETRY);
    assert_true(report.whole.crossed_by_arap && report.whole.method == KTG_FLATTEN_INJECTIVE);
    ktg_mesh_free(&mesh);
}

static void long_tubes_come_out_without_a_fold(void **state) {
    ktg_mesh *mesh = grid_panel(*state, sock, 40);
    ktg_flatten_report report;
    assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_INJECTIVE, &report), KTG_OK);
    assert_true(report.whole.symmetric_dirichlet < 20);
    ktg_mesh_free(&mesh);
}

/* A sheet crumpled by chance, up to the height of many faces. */
static ktg_mesh *crumpled(ktg_context *context, double height, uint64_t seed) {
    ktg_mesh *mesh = grid_panel(context, plane, 20);
    ktg_random random;
    ktg_random_seed(&random, seed);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        mesh->positions[v].z = height * ktg_random_unit(&random);
    return mesh;
}

static void crumpled_sheets_are_laid_flat_or_refused(void **state) {
    uint32_t done = 0;
    for (uint64_t seed = 0; seed < 4; seed++)
        for (double height = 1e-3; height < 1e6; height *= 30) {
            ktg_mesh *mesh = crumpled(*state, height, seed);
            ktg_flatten_report report;
            for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
                ktg_status status = flatten_by(*state, mesh, m, &report);
                assert_true(status == KTG_OK || status == KTG_GEOMETRY);
                done += status == KTG_OK;
            }
            ktg_mesh_free(&mesh);
        }
    assert_true(done > 15);
}

/* Two sheets in the same place, joined along one side; a fan of needles; a sheet with every corner
 * of one row nearly on a line. */
static void odd_panels_are_laid_flat_or_refused(void **state) {
    ktg_flatten_report report;
    ktg_mesh *mesh = grid_panel(*state, folded_in_two, 12);
    for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
        assert_int_equal(flatten_by(*state, mesh, m, &report), KTG_OK);
        assert_true(report.whole.strain_max < 1e-9);
    }
    ktg_mesh_free(&mesh);
    for (double thin = 1e-2; thin > 1e-14; thin /= 100) {
        mesh = grid_panel(*state, saddle, 8);
        for (uint32_t v = 36; v < 45; v++) /* the fifth row falls onto the fourth */
            mesh->positions[v] =
                ktg_add3(mesh->positions[v - 9],
                         ktg_mul3(ktg_sub3(mesh->positions[v], mesh->positions[v - 9]), thin));
        for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
            ktg_status status = flatten_by(*state, mesh, m, &report);
            assert_true(status == KTG_OK || status == KTG_GEOMETRY);
            assert_true(status == KTG_OK || thin < 1e-5 || m == KTG_FLATTEN_TWO_STEP);
        }
        ktg_mesh_free(&mesh);
    }
}

static void one_triangle_is_itself_by_every_method(void **state) {
    const ktg_vec3 positions[] = {{10, 1, 0}, {13, 1, 0}, {10, 5, 0}};
    const uint32_t face[] = {0, 1, 2};
    for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
        ktg_mesh *mesh = small_mesh(*state, positions, 3, face, 1);
        ktg_flatten_report report;
        assert_int_equal(flatten_by(*state, mesh, m, &report), KTG_OK);
        assert_true(report.whole.strain_max < 1e-14);
        ktg_mesh_free(&mesh);
    }
}

/* ---- the call ----------------------------------------------------------------------------- */

static void the_same_call_gives_the_same_bytes(void **state) {
    for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
        ktg_mesh *mesh = grid_panel(*state, hemisphere, 20);
        ktg_flatten_options options = by_method(m);
        ktg_pattern *once, *again;
        assert_int_equal(ktg_flatten(*state, mesh, "a", &options, &once, NULL), KTG_OK);
        assert_int_equal(ktg_flatten(*state, mesh, "a", &options, &again, NULL), KTG_OK);
        assert_memory_equal(once->pieces[0].vertices, again->pieces[0].vertices,
                            mesh->vertex_count * sizeof(ktg_vec2));
        ktg_pattern_free(&once);
        ktg_pattern_free(&again);
        ktg_mesh_free(&mesh);
    }
}

static void options_that_make_no_sense_are_refused(void **state) {
    ktg_mesh *mesh = grid_panel(*state, plane, 4);
    ktg_flatten_options wrong[4];
    for (int k = 0; k < 4; k++)
        ktg_flatten_defaults(&wrong[k]);
    wrong[0].weight = KTG_WEIGHT_UNIT;
    wrong[1].method = (ktg_flatten_method)3;
    wrong[2].strain_limit = NAN;
    wrong[3].weight = (ktg_edge_weight)2;
    for (int k = 0; k < 4; k++) {
        ktg_pattern *pattern;
        assert_int_equal(ktg_flatten(*state, mesh, "a", &wrong[k], &pattern, NULL), KTG_ARGUMENT);
        assert_null(pattern);
    }
    ktg_mesh_free(&mesh);
}

static ktg_wish count_down(void *user) {
    int *left = user;
    return --*left < 0 ? KTG_STOP : KTG_GO_ON;
}

static void every_method_can_be_cancelled_anywhere(void **state) {
    ktg_mesh *mesh = grid_panel(*state, spikes, 16);
    for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_INJECTIVE; m++) {
        ktg_flatten_report report;
        ktg_status status = KTG_CANCELLED;
        int asked = 0;
        for (; status == KTG_CANCELLED; asked++) {
            int left = asked;
            ktg_context_set_cancel(*state, count_down, &left);
            status = flatten_by(*state, mesh, m, &report);
            assert_int_equal(status == KTG_OK, left >= 0); /* nobody said stop */
        }
        assert_int_equal(status, KTG_OK);
        assert_true(asked > 10);
    }
    ktg_context_set_cancel(*state, NULL, NULL);
    ktg_mesh_free(&mesh);
}

static ktg_wish finish(void *user) {
    (void)user;
    return KTG_FINISH;
}

static void iterations_end_when_the_caller_wants_to_finish(void **state) {
    ktg_mesh *mesh = grid_panel(*state, almost_sphere, 24);
    ktg_flatten_report report;
    ktg_context_set_cancel(*state, finish, NULL);
    assert_int_equal(flatten_by(*state, mesh, KTG_FLATTEN_INJECTIVE, &report), KTG_OK);
    assert_int_equal(report.whole.iterations, 0);
    assert_true(report.interrupted);
    ktg_context_set_cancel(*state, NULL, NULL);
    ktg_mesh_free(&mesh);
}

static void every_allocation_may_fail(void **state) {
    surface *const surfaces[] = {shallow_cap, spikes};
    for (int k = 0; k < 2; k++) {
        ktg_mesh *mesh = grid_panel(*state, surfaces[k], k == 0 ? 4 : 12);
        ktg_flatten_report report;
        ktg_status status = KTG_MEMORY;
        uint64_t nth = 0;
        while (status == KTG_MEMORY) {
            ktg_context_fail_allocation(*state, ++nth);
            status = flatten_by(*state, mesh, KTG_FLATTEN_ARAP, &report);
            end_short_memory(*state, status);
        }
        assert_int_equal(status, KTG_OK);
        assert_int_equal(report.whole.method, k == 0 ? KTG_FLATTEN_ARAP : KTG_FLATTEN_INJECTIVE);
        assert_true(nth > 50);
        ktg_mesh_free(&mesh);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(caps_come_out_with_the_least_energy_there_is),
        TEST(arap_strains_least_and_injective_has_the_least_dirichlet_energy),
        TEST(every_method_lays_developable_surfaces_flat),
        TEST(the_area_beyond_a_limit_is_told),
        TEST(where_arap_folds_injective_takes_over),
        TEST(where_arap_crosses_injective_takes_over),
        TEST(long_tubes_come_out_without_a_fold),
        TEST(crumpled_sheets_are_laid_flat_or_refused),
        TEST(odd_panels_are_laid_flat_or_refused),
        TEST(one_triangle_is_itself_by_every_method),
        TEST(the_same_call_gives_the_same_bytes),
        TEST(options_that_make_no_sense_are_refused),
        TEST(every_method_can_be_cancelled_anywhere),
        TEST(iterations_end_when_the_caller_wants_to_finish),
        TEST(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
