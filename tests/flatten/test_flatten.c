/* Panels laid flat: exact where a surface can be laid flat, the same wherever and however large the
 * model is, upright, and refused where it would fold over. */
#include "tests/flatten/panels.h"
#include "tests/short_memory.h"

#include <stdio.h>
#include <string.h>

static const ktg_vec2 *flat_of(const ktg_pattern *pattern) {
    return pattern->pieces[0].vertices;
}

static void a_surface_that_can_be_laid_flat_keeps_every_length(void **state) {
    ktg_context *context = *state;
    surface *const surfaces[] = {plane, zigzag, cylinder, cone, slit_ring};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        ktg_flatten_report report;
        ktg_pattern *pattern = flat_panel(context, grid_panel(context, surfaces[k], 48), &report);
        const ktg_vec2 *flat = flat_of(pattern);
        assert_int_equal(report.whole.faces, 2 * 48 * 48);
        assert_int_equal(report.whole.flipped_faces, 0);
        assert_true(report.whole.strain_max < 1e-9 && report.whole.arap_energy < 1e-20);
        assert_true(report.whole.strain_mean <= report.whole.strain_max);
        assert_true(report.whole.strain_p95 <= report.whole.strain_max);
        assert_true(fabs(report.whole.border_error) < 1e-9);
        for (size_t e = 0; e < pattern->edge_count; e++) {
            const uint32_t *v = pattern->edges[e].vertices;
            double length = ktg_length3(ktg_sub3(pattern->vertices[v[1]], pattern->vertices[v[0]]));
            double now = ktg_length2(ktg_sub2(flat[v[1]], flat[v[0]]));
            assert_true(fabs(now - length) < 1e-9 * length);
        }
        ktg_pattern_free(&pattern);
    }
}

static void unit_weights_lay_developable_surfaces_flat_too(void **state) {
    ktg_context *context = *state;
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.method = KTG_FLATTEN_TWO_STEP;
    options.weight = KTG_WEIGHT_UNIT;
    ktg_flatten_report report;
    ktg_pattern *pattern;
    ktg_mesh *mesh = grid_panel(context, cone, 16);
    assert_int_equal(ktg_flatten(context, mesh, "cone", &options, &pattern, &report), KTG_OK);
    ktg_flatten_report_free(&report);
    assert_true(report.whole.strain_max < 1e-9);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* A finer grid brings the cap's energy down to 3.5e-4 (a hemisphere's is 0.0393). */
static void a_spherical_cap_strains_little_and_alike_on_all_sides(void **state) {
    ktg_context *context = *state;
    ktg_flatten_report report;
    enum { side = 20 };
    ktg_pattern *pattern = flat_panel(context, grid_panel(context, shallow_cap, side), &report);
    assert_int_equal(report.whole.flipped_faces, 0);
    assert_true(report.whole.arap_energy > 3.4e-4 && report.whole.arap_energy < 4e-4);
    assert_true(report.whole.strain_mean > 0 && report.whole.strain_mean < report.whole.strain_p95);
    assert_true(report.whole.strain_p95 < 0.04 &&
                report.whole.strain_p95 < report.whole.strain_max);
    const ktg_vec2 *flat = flat_of(pattern);
    uint32_t corners[] = {0, side, (side + 1) * (side + 1) - 1, (side + 1) * side};
    double least = INFINITY, most = 0;
    for (int k = 0; k < 4; k++) {
        double length = ktg_length2(ktg_sub2(flat[corners[(k + 1) % 4]], flat[corners[k]]));
        least = fmin(least, length);
        most = fmax(most, length);
    }
    assert_true(most - least < 0.01 * most);
    ktg_pattern_free(&pattern);
}

static void one_triangle_keeps_its_shape(void **state) {
    ktg_context *context = *state;
    const ktg_vec3 positions[] = {{10, 1, 0}, {13, 1, 0}, {10, 5, 0}};
    const uint32_t face[] = {0, 1, 2};
    ktg_flatten_report report;
    ktg_pattern *pattern = flat_panel(context, small_mesh(context, positions, 3, face, 1), &report);
    const ktg_vec2 wanted[] = {{0, 0}, {3, 0}, {0, 4}};
    for (int v = 0; v < 3; v++)
        assert_true(ktg_length2(ktg_sub2(flat_of(pattern)[v], wanted[v])) < 1e-14);
    assert_true(report.whole.strain_max < 1e-14);
    assert_int_equal(pattern->edge_count, 3);
    ktg_pattern_free(&pattern);
}

static void two_triangles_folded_at_a_right_angle_open_flat(void **state) {
    ktg_context *context = *state;
    /* a ridge along y, its flanks falling to both sides: a mountain */
    const ktg_vec3 positions[] = {{0, 0, 0}, {0, 2, 0}, {-1, 1, -1}, {1, 1, -1}};
    const uint32_t faces[] = {0, 1, 2, 1, 0, 3};
    ktg_pattern *pattern = flat_panel(context, small_mesh(context, positions, 4, faces, 2), NULL);
    double far = ktg_length2(ktg_sub2(flat_of(pattern)[3], flat_of(pattern)[2]));
    assert_true(fabs(far - 2 * sqrt(2)) < 1e-14);
    assert_int_equal(pattern->edge_count, 5);
    int inner = 0;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        inner += edge->kind == KTG_EDGE_FLAT;
        if (edge->kind == KTG_EDGE_FLAT)
            assert_true(fabs(edge->angle - KTG_PI / 2) < 1e-14);
        else
            assert_true(edge->angle == 0);
    }
    assert_int_equal(inner, 1);
    ktg_pattern_free(&pattern);
}

static void the_pattern_has_one_piece_with_all_faces_the_right_way_round(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = flat_panel(context, grid_panel(context, shallow_cap, 6), NULL);
    assert_int_equal(pattern->mode, KTG_CLOTH);
    assert_int_equal(pattern->component_count, 1);
    assert_int_equal(pattern->piece_count, 1);
    assert_int_equal(pattern->model_faces, 72);
    assert_string_equal(pattern->components[0].name, "panel");
    const ktg_pattern_piece *piece = &pattern->pieces[0];
    assert_string_equal(piece->name, "panel");
    assert_int_equal(piece->face_count, 72);
    assert_int_equal(piece->vertex_count, 49);
    assert_int_equal(piece->cut_count, 1);
    for (size_t f = 0; f < piece->face_count; f++) {
        const uint32_t *c = piece->corners + 3 * f;
        assert_int_equal(piece->faces[f], f);
        assert_memory_equal(c, pattern->faces + 3 * f, 3 * sizeof *c);
        assert_true(ktg_cross2(ktg_sub2(piece->vertices[c[1]], piece->vertices[c[0]]),
                               ktg_sub2(piece->vertices[c[2]], piece->vertices[c[0]])) > 0);
        assert_true(pattern->face_strain[f] > 0);
    }
    int borders = 0;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        assert_int_equal(edge->side_count, edge->kind == KTG_EDGE_BORDER ? 1 : 2);
        assert_int_equal(edge->tab_on, -1);
        assert_int_equal(edge->seam, KTG_NONE);
        borders += edge->kind == KTG_EDGE_BORDER;
        for (uint32_t s = 0; s < edge->side_count; s++) {
            const ktg_pattern_side *side = &edge->sides[s];
            const uint32_t *face = pattern->faces + 3 * (size_t)side->face;
            assert_int_equal(face[side->corner], edge->vertices[s]);
            assert_int_equal(face[(side->corner + 1) % 3], edge->vertices[1 - s]);
        }
    }
    assert_int_equal(borders, 24);
    ktg_pattern_free(&pattern);
}

/* ---- where, how large, which way up ------------------------------------------------------- */

static void a_power_of_two_changes_nothing_but_the_size(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, shallow_cap, 12);
    ktg_flatten_report report, scaled_report;
    ktg_pattern *pattern, *scaled;
    assert_int_equal(ktg_flatten(context, mesh, "a", NULL, &pattern, &report), KTG_OK);
    ktg_flatten_report_free(&report);
    const int exponents[] = {-240, -17, 1, 40, 240};
    for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++) {
        ktg_mesh *copy;
        assert_int_equal(ktg_mesh_copy(context, mesh, &copy), KTG_OK);
        for (uint32_t i = 0; i < 3 * mesh->vertex_count; i++)
            (&copy->positions[0].x)[i] = ldexp((&mesh->positions[0].x)[i], exponents[k]);
        assert_int_equal(ktg_flatten(context, copy, "a", NULL, &scaled, &scaled_report), KTG_OK);
        ktg_flatten_report_free(&scaled_report);
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            assert_true(flat_of(scaled)[v].x == ldexp(flat_of(pattern)[v].x, exponents[k]));
            assert_true(flat_of(scaled)[v].y == ldexp(flat_of(pattern)[v].y, exponents[k]));
        }
        assert_true(scaled_report.whole.arap_energy == report.whole.arap_energy);
        ktg_mesh_free(&copy);
        ktg_pattern_free(&scaled);
    }
    ktg_mesh_free(&mesh);
    ktg_pattern_free(&pattern);
}

/* Turned by `angle` about y, then by `tilt` about x, then moved. */
static ktg_mesh *moved_mesh(ktg_context *context, const ktg_mesh *mesh, double angle, double tilt) {
    ktg_mesh *copy;
    assert_int_equal(ktg_mesh_copy(context, mesh, &copy), KTG_OK);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        ktg_vec3 p = mesh->positions[v];
        p = (ktg_vec3){cos(angle) * p.x + sin(angle) * p.z, p.y,
                       cos(angle) * p.z - sin(angle) * p.x};
        p = (ktg_vec3){p.x, cos(tilt) * p.y - sin(tilt) * p.z, sin(tilt) * p.y + cos(tilt) * p.z};
        copy->positions[v] = ktg_add3(p, (ktg_vec3){11, -7, 3});
    }
    return copy;
}

static void a_moved_or_turned_model_gives_the_same_shape(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, shallow_cap, 14);
    ktg_pattern *pattern;
    assert_int_equal(ktg_flatten(context, mesh, "a", NULL, &pattern, NULL), KTG_OK);
    const double motions[][2] = {{0, 0}, {1.1, 0}, {-2, 0}, {0.4, 0.6}, {2, -1}, {0.5, 2.9}};
    for (size_t k = 0; k < sizeof motions / sizeof *motions; k++) {
        ktg_mesh *copy = moved_mesh(context, mesh, motions[k][0], motions[k][1]);
        ktg_pattern *moved = flat_panel(context, copy, NULL);
        const ktg_vec2 *a = flat_of(pattern), *b = flat_of(moved);
        ktg_motion2 back = ktg_motion2_between(b[0], b[14], a[0], a[14]);
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            assert_true(ktg_length2(ktg_sub2(ktg_move2(back, b[v]), a[v])) < 1e-9);
            /* turned about the vertical, even the way up is the same */
            if (motions[k][1] == 0)
                assert_true(ktg_length2(ktg_sub2(b[v], a[v])) < 1e-9);
        }
        ktg_pattern_free(&moved);
    }
    ktg_mesh_free(&mesh);
    ktg_pattern_free(&pattern);
}

static ktg_vec3 wall_from_behind(double u, double v) {
    return (ktg_vec3){-u, 2 * v, 0};
}

static ktg_vec3 floor_panel(double u, double v) {
    return (ktg_vec3){u, 5, -2 * v};
}

static ktg_vec3 upside_down(double u, double v) {
    return (ktg_vec3){-u, -2 * v, 0};
}

static ktg_vec3 front_wall(double u, double v) {
    return (ktg_vec3){u, 2 * v, 0};
}

/* Each of these is a rectangle 1 wide and 2 high, seen from its outside with the model's y (or -z)
 * up; upside_down runs through it from the upper right. */
static void a_piece_stands_upright_as_seen_from_outside(void **state) {
    ktg_context *context = *state;
    surface *const surfaces[] = {front_wall, wall_from_behind, floor_panel, upside_down};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        ktg_pattern *pattern = flat_panel(context, grid_panel(context, surfaces[k], 4), NULL);
        for (uint32_t v = 0; v < 25; v++) {
            ktg_vec2 wanted = {(v % 5) / 4.0, (v / 5) / 2.0};
            if (surfaces[k] == upside_down)
                wanted = ktg_sub2((ktg_vec2){1, 2}, wanted);
            assert_true(ktg_length2(ktg_sub2(flat_of(pattern)[v], wanted)) < 1e-12);
        }
        ktg_pattern_free(&pattern);
    }
}

/* ---- refused ------------------------------------------------------------------------------ */

static void what_the_two_step_method_folds_over_is_refused(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, almost_sphere, 30);
    ktg_pattern *pattern;
    ktg_flatten_report report;
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.method = KTG_FLATTEN_TWO_STEP;
    assert_int_equal(ktg_flatten(context, mesh, "ball", &options, &pattern, &report), KTG_GEOMETRY);
    ktg_flatten_report_free(&report);
    assert_null(pattern);
    assert_true(report.whole.flipped_faces > 0 && report.whole.arap_energy > 0.1);
    assert_true(report.whole.symmetric_dirichlet == 0);
    char start[64];
    snprintf(start, sizeof start, "%u of 1800 faces ", report.whole.flipped_faces);
    assert_memory_equal(ktg_context_message(context), start, strlen(start));
    assert_non_null(strstr(ktg_context_message(context), "two-step"));
    assert_non_null(strstr(ktg_context_message(context), "seams"));
    ktg_mesh_free(&mesh);
}

static void a_panel_that_would_lie_on_itself_is_cut_or_refused(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, ramp, 30);
    ktg_pattern *pattern;
    ktg_flatten_report report;
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_MARKED; /* of which there are none, and no others are wanted */
    assert_int_equal(ktg_flatten(context, mesh, "ramp", &options, &pattern, &report), KTG_GEOMETRY);
    ktg_flatten_report_free(&report);
    assert_null(pattern);
    assert_int_equal(report.whole.flipped_faces, 0);
    assert_non_null(strstr(ktg_context_message(context), "lies on itself"));
    assert_int_equal(ktg_flatten(context, mesh, "ramp", NULL, &pattern, &report), KTG_OK);
    ktg_flatten_report_free(&report);
    assert_true(pattern->piece_count > 1 && report.auto_edges > 0);
    assert_true(report.whole.strain_max < 0.05);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* Nine squares around a hole: the last one comes to lie exactly on the first, and no border crosses
 * another. */
static ktg_mesh *squares_around(ktg_context *context) {
    static const int ring[9][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2},
                                   {1, 2}, {0, 2}, {0, 1}, {0, 0}};
    static const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double positions[3 * 4 * 9];
    uint32_t faces[6 * 9], before[4] = {0}, count = 0;
    for (int k = 0; k < 9; k++) {
        uint32_t own[4];
        for (int i = 0; i < 4; i++) {
            double x = ring[k][0] + corners[i][0], y = ring[k][1] + corners[i][1];
            own[i] = count;
            for (int j = 0; j < 4 && k > 0; j++)
                if (positions[3 * before[j]] == x && positions[3 * before[j] + 1] == y)
                    own[i] = before[j];
            memcpy(&positions[3 * own[i]], (double[]){x, y, 0}, 3 * sizeof x);
            count += own[i] == count;
        }
        memcpy(&faces[6 * k], (uint32_t[]){own[0], own[1], own[2], own[0], own[2], own[3]},
               6 * sizeof *own);
        memcpy(before, own, sizeof own);
    }
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(context, positions, count, faces, 18, &mesh), KTG_OK);
    return mesh;
}

static void faces_exactly_on_each_other_are_noticed(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = squares_around(context);
    ktg_pattern *pattern;
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_MARKED;
    assert_int_equal(ktg_flatten(context, mesh, "ring", &options, &pattern, NULL), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(context), "lies on itself"));
    assert_int_equal(ktg_flatten(context, mesh, "ring", NULL, &pattern, NULL), KTG_OK);
    assert_true(pattern->piece_count > 1);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void a_long_ribbon_is_laid_flat_and_one_without_end_refused_by_two_step(void **state) {
    ktg_context *context = *state;
    const uint32_t lengths[] = {1000, 100000};
    for (int k = 0; k < 2; k++) {
        uint32_t length = lengths[k];
        ktg_vec3 *positions = ktg_new(context, 2 * (size_t)length + 2, ktg_vec3);
        uint32_t *faces = ktg_new(context, 6 * (size_t)length, uint32_t);
        for (uint32_t v = 0; v < 2 * length + 2; v++)
            positions[v] = (ktg_vec3){v / 2, v % 2, 0};
        for (uint32_t i = 0; i < length; i++) {
            uint32_t a = 2 * i, square[6] = {a, a + 2, a + 3, a, a + 3, a + 1};
            memcpy(faces + 6 * (size_t)i, square, sizeof square);
        }
        ktg_mesh *mesh = small_mesh(context, positions, 2 * length + 2, faces, 2 * length);
        ktg_pattern *pattern;
        ktg_flatten_report report;
        assert_int_equal(ktg_flatten(context, mesh, "ribbon", NULL, &pattern, &report), KTG_OK);
        ktg_flatten_report_free(&report);
        assert_true(report.whole.strain_max < 1e-9);
        ktg_pattern_free(&pattern);
        ktg_flatten_options options;
        ktg_flatten_defaults(&options);
        options.method = KTG_FLATTEN_TWO_STEP;
        ktg_status status = ktg_flatten(context, mesh, "ribbon", &options, &pattern, &report);
        ktg_flatten_report_free(&report);
        assert_int_equal(status, k == 0 ? KTG_OK : KTG_GEOMETRY);
        if (k == 0)
            assert_true(report.whole.strain_max < 1e-9);
        else
            assert_non_null(strstr(ktg_context_message(context), "too long and thin"));
        ktg_pattern_free(&pattern);
        ktg_mesh_free(&mesh);
        ktg_free(positions);
        ktg_free(faces);
    }
}

static ktg_wish stop_at_once(void *user) {
    return ++*(int *)user > 0 ? KTG_STOP : KTG_GO_ON;
}

static void the_work_can_be_cancelled(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, shallow_cap, 8);
    ktg_pattern *pattern;
    int most = 0;
    for (int asked_before = 0;; asked_before++) {
        int calls = -asked_before;
        ktg_context_set_cancel(context, stop_at_once, &calls);
        ktg_status status = ktg_flatten(context, mesh, "a", NULL, &pattern, NULL);
        most = asked_before;
        assert_int_equal(status == KTG_OK, calls <= 0); /* nobody said stop */
        if (status == KTG_OK)
            break;
        assert_int_equal(status, KTG_CANCELLED);
        assert_null(pattern);
    }
    assert_true(most >= 3);
    ktg_context_set_cancel(context, NULL, NULL);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void every_allocation_may_fail(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, shallow_cap, 4);
    ktg_pattern *pattern;
    uint64_t nth = 1;
    for (;; nth++) {
        ktg_context_fail_allocation(context, nth);
        ktg_status status = ktg_flatten(context, mesh, "a", NULL, &pattern, NULL);
        end_short_memory(context, status);
        if (status == KTG_OK)
            break;
        assert_int_equal(status, KTG_MEMORY);
        assert_null(pattern);
    }
    assert_true(nth > 20);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_surface_that_can_be_laid_flat_keeps_every_length),
        TEST(unit_weights_lay_developable_surfaces_flat_too),
        TEST(a_spherical_cap_strains_little_and_alike_on_all_sides),
        TEST(one_triangle_keeps_its_shape),
        TEST(two_triangles_folded_at_a_right_angle_open_flat),
        TEST(the_pattern_has_one_piece_with_all_faces_the_right_way_round),
        TEST(a_power_of_two_changes_nothing_but_the_size),
        TEST(a_moved_or_turned_model_gives_the_same_shape),
        TEST(a_piece_stands_upright_as_seen_from_outside),
        TEST(what_the_two_step_method_folds_over_is_refused),
        TEST(a_panel_that_would_lie_on_itself_is_cut_or_refused),
        TEST(faces_exactly_on_each_other_are_noticed),
        TEST(a_long_ribbon_is_laid_flat_and_one_without_end_refused_by_two_step),
        TEST(the_work_can_be_cancelled),
        TEST(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
