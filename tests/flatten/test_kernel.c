/* The parts of the kernel by themselves: neighbourhoods, singular values, the middle. */
#include "flatten/kernel.h"
#include "tests/flatten/panels.h"

static ktg_vec2 similarity_of(const ktg_neighbourhood *n, uint32_t base, const ktg_vec2 *z) {
    ktg_vec2 factors[4], sum = {0, 0};
    ktg_neighbourhood_similarity(n, base, factors);
    for (uint32_t v = 0; v < n->count; v++)
        sum = ktg_add2(sum, ktg_turn(factors[v], z[n->vertices[v]]));
    return sum;
}

static void a_neighbourhood_keeps_its_lengths_and_lies_on_both_sides(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, shallow_cap, 5);
    ktg_panel *panel;
    ktg_neighbourhood *all;
    assert_int_equal(ktg_panel_new(context, mesh, &panel), KTG_OK);
    assert_int_equal(ktg_neighbourhoods_new(context, panel, KTG_WEIGHT_COTANGENT, &all), KTG_OK);
    for (uint32_t e = 0; e < panel->adjacency->edge_count; e++) {
        const ktg_neighbourhood *n = &all[e];
        assert_true(n->flat[2].y > 0 && (n->count == 3 || n->flat[3].y < 0) && n->weight > 0);
        for (uint32_t v = 0; v < n->count; v++)
            for (uint32_t end = 0; end < 2; end++) {
                ktg_vec3 space =
                    ktg_sub3(panel->positions[n->vertices[v]], panel->positions[n->vertices[end]]);
                double length = ktg_length2(ktg_sub2(n->flat[v], n->flat[end]));
                assert_true(fabs(length - ktg_length3(space)) < 1e-15);
            }
    }
    ktg_free(all);
    ktg_panel_free(&panel);
    ktg_mesh_free(&mesh);
}

static void a_similarity_is_found_from_either_end_wherever_the_shape_lies(void **state) {
    (void)state;
    ktg_neighbourhood n = {4, {2, 0, 3, 1}, {{0, 0}, {2, 0}, {0.7, 1.1}, {1.2, -0.4}}, 1};
    const ktg_vec2 turn = {-0.3, 1.7}, move = {40, -9};
    ktg_vec2 z[4];
    for (uint32_t v = 0; v < 4; v++)
        z[n.vertices[v]] = ktg_add2(ktg_turn(turn, n.flat[v]), move);
    for (n.count = 3; n.count <= 4; n.count++)
        for (uint32_t base = 0; base < 2; base++)
            assert_true(ktg_length2(ktg_sub2(similarity_of(&n, base, z), turn)) < 1e-13);
}

static void weights_are_cotangents_but_never_too_low(void **state) {
    ktg_context *context = *state;
    /* a flat kite of two triangles that are obtuse at their common edge's opposite corners */
    const ktg_vec3 kite[] = {{0, 0, 0}, {4, 0, 0}, {2, 0.5, 0}, {2, -0.5, 0}};
    const uint32_t faces[] = {0, 1, 2, 1, 0, 3};
    ktg_mesh *mesh = small_mesh(context, kite, 4, faces, 2);
    ktg_panel *panel;
    ktg_neighbourhood *all;
    assert_int_equal(ktg_panel_new(context, mesh, &panel), KTG_OK);
    assert_int_equal(ktg_neighbourhoods_new(context, panel, KTG_WEIGHT_COTANGENT, &all), KTG_OK);
    /* the ridge: cot of (2 atan 4) = -1.875 twice; a flank: cot of atan(1/4) = 4, halved; so the
     * mean is (4 x 2 - 1.875) / 5 */
    for (uint32_t e = 0; e < 5; e++)
        assert_true(fabs(all[e].weight - (all[e].count == 4 ? 1.225e-3 : 2)) < 1e-14);
    ktg_free(all);
    assert_int_equal(ktg_neighbourhoods_new(context, panel, KTG_WEIGHT_UNIT, &all), KTG_OK);
    for (uint32_t e = 0; e < 5; e++)
        assert_true(all[e].weight == 1);
    ktg_free(all);
    ktg_panel_free(&panel);
    ktg_mesh_free(&mesh);
}

static void strain_is_measured_from_known_maps(void **state) {
    ktg_context *context = *state;
    /* two triangles in space, areas 4 to 1 */
    const ktg_vec3 positions[] = {{0, 0, 0}, {4, 0, 0}, {0, 0, -4}, {1, 0, 1}};
    const uint32_t faces[] = {0, 1, 2, 1, 0, 3};
    ktg_mesh *mesh = small_mesh(context, positions, 4, faces, 2);
    ktg_panel *panel;
    assert_int_equal(ktg_panel_new(context, mesh, &panel), KTG_OK);
    double unit = ldexp(1, -panel->exponent), face_strain[2];
    ktg_panel_report report = {0};
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.strain_limit = 0.6;
    uint32_t flipped;
    /* the first stretched 1.5 by 0.8, the second 1.5 by 1.3 and turned over */
    ktg_vec2 flat[] = {{0, 0}, {6, 0}, {0, 3.2}, {1.5, 1.3}};
    for (int v = 0; v < 4; v++)
        flat[v] = ktg_mul2(flat[v], unit);
    ktg_face_map map = ktg_face_map_of(panel, 0, flat);
    assert_true(fabs(map.s1 - 1.5) < 1e-14 && fabs(map.s2 - 0.8) < 1e-14);
    ktg_vec2 up = ktg_face_map_direction(&map, (ktg_vec3){0, 7, -1});
    assert_true(fabs(up.x) < 1e-14 && fabs(up.y - 0.8) < 1e-14);
    map = ktg_face_map_of(panel, 1, flat);
    assert_true(fabs(map.s1 - 1.5) < 1e-14 && fabs(map.s2 + 1.3) < 1e-14);
    assert_int_equal(
        ktg_strain_measure(context, panel, flat, &options, face_strain, &report, &flipped), KTG_OK);
    assert_int_equal(flipped, 1);
    assert_int_equal(report.flipped_faces, 1);
    assert_true(fabs(face_strain[0] - 0.5) < 1e-14 && fabs(face_strain[1] - 2.3) < 1e-14);
    assert_true(fabs(report.arap_energy - (0.8 * 0.29 + 0.2 * (0.25 + 2.3 * 2.3))) < 1e-13);
    assert_true(fabs(report.strain_mean - (0.8 * 0.5 + 0.2 * 2.3)) < 1e-13);
    assert_true(fabs(report.area_beyond_limit - 0.2) < 1e-14);
    assert_int_equal(ktg_panel_count_flipped(panel, flat), 1);
    assert_true(report.strain_max == face_strain[1] && report.strain_p95 == face_strain[1]);
    double before = sqrt(32) + 4 + sqrt(2) + sqrt(10);
    double after = hypot(6, 3.2) + 3.2 + hypot(1.5, 1.3) + hypot(4.5, 1.3);
    assert_true(fabs(report.border_error - (after - before) / before) < 1e-13);
    ktg_panel_free(&panel);
    ktg_mesh_free(&mesh);
}

static void the_middle_of_a_square_is_pinned_in_its_middle(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, plane, 10);
    ktg_panel *panel;
    uint32_t edge;
    assert_int_equal(ktg_panel_new(context, mesh, &panel), KTG_OK);
    assert_int_equal(ktg_panel_middle(context, panel, &edge), KTG_OK);
    uint32_t h = panel->adjacency->edge_halfedges[panel->adjacency->edge_first[edge]];
    uint32_t ends[2] = {panel->faces[h], panel->faces[ktg_halfedge_next(h)]};
    for (int k = 0; k < 2; k++) {
        assert_in_range(ends[k] % 11, 4, 6);
        assert_in_range(ends[k] / 11, 4, 6);
    }
    ktg_panel_free(&panel);
    ktg_mesh_free(&mesh);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_neighbourhood_keeps_its_lengths_and_lies_on_both_sides),
        TEST(a_similarity_is_found_from_either_end_wherever_the_shape_lies),
        TEST(weights_are_cotangents_but_never_too_low),
        TEST(strain_is_measured_from_known_maps),
        TEST(the_middle_of_a_square_is_pinned_in_its_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
