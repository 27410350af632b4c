/* tests/mesh/test_check.c - each kind of fault is found and nothing else is. */
#include "shapes.h"
#include "tests/short_memory.h"

static void a_cube_is_clean(void **state) {
    builder *b = build();
    add_cube(b, 1, 2, 3, 2);
    ktg_mesh *mesh = finish(state, b);
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.vertices, 8);
    assert_int_equal(r.edges, 18);
    assert_int_equal(r.faces, 12);
    assert_int_equal(r.components, 1);
    assert_int_equal(r.euler, 2);
    assert_int_equal(r.genus, 0);
    assert_true(r.closed && r.manifold && r.oriented);
    assert_true(r.intersections_known);
    assert_int_equal(r.border_edges + r.border_loops + r.duplicate_faces + r.degenerate_faces, 0);
    assert_int_equal(r.unreferenced_vertices + r.nonmanifold_edges + r.nonmanifold_vertices, 0);
    assert_int_equal(r.misoriented_edges + r.unstitched_edges + r.inward_components, 0);
    assert_int_equal(r.self_intersections, 0);
    assert_float_equal(r.volume, 8, 1e-12);
    assert_float_equal(r.area, 24, 1e-12);
    assert_float_equal(r.low.y, 2, 0);
    assert_float_equal(r.high.z, 5, 0);
    ktg_mesh_free(&mesh);
}

static ktg_status extent_at(void **state, double size, double away, double *extent) {
    builder *b = build();
    add_cube(b, away, 0, 0, size);
    ktg_mesh *mesh = finish(state, b);
    ktg_status status = ktg_mesh_check_extent(*state, mesh, extent);
    ktg_mesh_free(&mesh);
    return status;
}

static void a_mesh_may_be_large_small_or_away_but_not_beyond_its_digits(void **state) {
    double extent;
    assert_int_equal(extent_at(state, 4, 0, &extent), KTG_OK);
    assert_float_equal(extent, 4, 0);
    assert_int_equal(extent_at(state, 1e-70, 0, &extent), KTG_OK);
    assert_int_equal(extent_at(state, 1e70, 0, &extent), KTG_OK);
    assert_int_equal(extent_at(state, 4, -3.9e7, &extent), KTG_OK);
    assert_int_equal(extent_at(state, 4, -4.1e7, &extent), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(*state), "4.1e+07 units away from the origin"));
    assert_int_equal(extent_at(state, 1e-80, 0, &extent), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(*state), "1e-80 units large"));
    assert_int_equal(extent_at(state, 4e-310, 0, &extent), KTG_GEOMETRY);
    assert_int_equal(extent_at(state, 2e75, 0, &extent), KTG_GEOMETRY);
}

static void a_torus_has_genus_one_and_an_open_tube_two_loops(void **state) {
    builder *b = build();
    add_torus(b, 3, 1, 12, 8);
    ktg_mesh *mesh = finish(state, b);
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.genus, 1);
    assert_int_equal(r.euler, 0);
    assert_true(r.closed && r.volume > 0);
    ktg_mesh_free(&mesh);
    b = build();
    add_cylinder(b, 2, 3, 8);
    mesh = finish(state, b);
    r = report_of(state, mesh);
    assert_int_equal(r.border_loops, 2);
    assert_int_equal(r.border_edges, 16);
    assert_int_equal(r.genus, 0);
    assert_false(r.closed);
    assert_true(r.manifold && r.oriented);
    assert_true(r.volume == 0);
    ktg_mesh_free(&mesh);
}

static void faces_twice_flat_or_collapsed_are_counted(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 0, 7, 7, 7, 1, 0, 0};
    uint32_t faces[] = {0, 1, 2, 2, 1, 0, 0, 5, 2, 0, 3, 1, 1, 1, 2, 1, 5, 2};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.duplicate_faces, 2); /* turned over; with a coincident vertex */
    assert_int_equal(r.degenerate_faces, 3);
    assert_int_equal(r.unreferenced_vertices, 1);
    ktg_mesh_free(&mesh);
}

static void edges_of_three_faces_and_vertices_of_two_fans_are_not_manifold(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, -1, 2, 0, 1, 2};
    uint32_t rib[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(rib));
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.nonmanifold_edges, 1);
    assert_int_equal(r.nonmanifold_vertices, 0);
    assert_false(r.manifold);
    assert_int_equal(r.genus, -1);
    ktg_mesh_free(&mesh);
    uint32_t bow[] = {0, 1, 2, 0, 5, 6};
    mesh = make(state, POINTS(points), FACES(bow));
    r = report_of(state, mesh);
    assert_int_equal(r.nonmanifold_edges, 0);
    assert_int_equal(r.nonmanifold_vertices, 1);
    assert_int_equal(r.components, 2);
    assert_int_equal(r.unreferenced_vertices, 2);
    ktg_mesh_free(&mesh);
}

static void neighbours_that_run_the_same_way_are_misoriented(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    uint32_t swap = b->faces[1];
    b->faces[1] = b->faces[2];
    b->faces[2] = swap;
    ktg_mesh *mesh = finish(state, b);
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.misoriented_edges, 3);
    assert_false(r.oriented);
    assert_true(r.manifold && r.closed);
    assert_int_equal(r.genus, -1);
    assert_true(r.volume == 0);
    ktg_mesh_free(&mesh);
}

static void borders_that_coincide_are_unstitched(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, -0.0, 1, 1, 0, 0, 1, 0};
    uint32_t faces[] = {0, 1, 2, 3, 4, 5};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.unstitched_edges, 2);
    assert_int_equal(r.components, 2);
    assert_int_equal(r.border_edges, 6);
    assert_int_equal(r.self_intersections, 0);
    ktg_mesh_free(&mesh);
}

static void a_component_inside_out_is_counted(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    add_cube(b, 5, 0, 0, 1);
    for (uint32_t f = 12; f < 24; f++) {
        uint32_t *c = b->faces + 3 * f, swap = c[1];
        c[1] = c[2];
        c[2] = swap;
    }
    ktg_mesh *mesh = finish(state, b);
    ktg_mesh_report r = report_of(state, mesh);
    assert_int_equal(r.inward_components, 1);
    assert_int_equal(r.components, 2);
    assert_int_equal(r.euler, 4);
    assert_true(r.oriented && fabs(r.volume) < 1e-12);
    ktg_mesh_free(&mesh);
}

/* Two faces in all the ways they can touch or cut. */
static uint32_t pairs_of(void **state, const double *points, uint32_t vertices,
                         const uint32_t *faces) {
    ktg_mesh *mesh = make(state, points, vertices, faces, 2);
    uint32_t pairs = report_of(state, mesh).self_intersections;
    ktg_mesh_free(&mesh);
    return pairs;
}

static void intersections_beyond_shared_corners_are_counted(void **state) {
    uint32_t apart[] = {0, 1, 2, 3, 4, 5}, corner[] = {0, 1, 2, 0, 3, 4},
             edge[] = {0, 1, 2, 1, 0, 3};
    double through[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 5, 5, 1};
    double above[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1, 1, 2, 5, 5, 1};
    double touching[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 1, 1, 2, 5, 5, 1};
    double coincident[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 1, 1, 2, 5, 5, 1};
    assert_int_equal(pairs_of(state, POINTS(through), apart), 1);
    assert_int_equal(pairs_of(state, POINTS(above), apart), 0);
    assert_int_equal(pairs_of(state, POINTS(touching), apart), 1);
    assert_int_equal(pairs_of(state, POINTS(coincident), apart), 0);
    double fan[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, -1, -1, 1, -1, -1, -1};
    double wing[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1, 1, -1};
    double inside[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 0.5, 1, 0};
    double side[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, -1, 1, 0, -1, -1, 0};
    assert_int_equal(pairs_of(state, POINTS(fan), corner), 0);
    assert_int_equal(pairs_of(state, POINTS(wing), corner), 1);
    assert_int_equal(pairs_of(state, POINTS(inside), corner), 1);
    assert_int_equal(pairs_of(state, POINTS(side), corner), 0);
    double roof[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1};
    double flat[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, -1, 0};
    double folded[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 3, 1, 0};
    assert_int_equal(pairs_of(state, POINTS(roof), edge), 0);
    assert_int_equal(pairs_of(state, POINTS(flat), edge), 0);
    assert_int_equal(pairs_of(state, POINTS(folded), edge), 1);
}

static void a_scale_by_a_power_of_two_changes_no_count(void **state) {
    for (int exponent = -300; exponent <= 300; exponent += 300) {
        builder *b = build();
        add_sphere(b, 0.3, 0.1, 0.7, 1, 0.3, 8, 12);
        add_sphere(b, 1.1, 0.2, 0.5, 1, 0.1, 8, 12);
        for (uint32_t i = 0; i < 3 * b->vertex_count; i++)
            b->positions[i] = ldexp(b->positions[i], exponent);
        ktg_mesh *mesh = finish(state, b);
        static uint32_t pairs;
        ktg_mesh_report r = report_of(state, mesh);
        if (exponent == -300)
            pairs = r.self_intersections;
        assert_true(pairs > 10);
        assert_int_equal(r.self_intersections, pairs);
        assert_int_equal(r.degenerate_faces, 0);
        ktg_mesh_free(&mesh);
    }
}

static void memory_may_run_out_anywhere(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    ktg_mesh *mesh = finish(state, b);
    ktg_mesh_report r;
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_context_fail_allocation(context_of(state), ++nth);
        status = ktg_mesh_check(context_of(state), mesh, true, &r);
    }
    end_short_memory(context_of(state), status);
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 10);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_clean),
        cmocka_unit_test(a_mesh_may_be_large_small_or_away_but_not_beyond_its_digits),
        cmocka_unit_test(a_torus_has_genus_one_and_an_open_tube_two_loops),
        cmocka_unit_test(faces_twice_flat_or_collapsed_are_counted),
        cmocka_unit_test(edges_of_three_faces_and_vertices_of_two_fans_are_not_manifold),
        cmocka_unit_test(neighbours_that_run_the_same_way_are_misoriented),
        cmocka_unit_test(borders_that_coincide_are_unstitched),
        cmocka_unit_test(a_component_inside_out_is_counted),
        cmocka_unit_test(intersections_beyond_shared_corners_are_counted),
        cmocka_unit_test(a_scale_by_a_power_of_two_changes_no_count),
        cmocka_unit_test(memory_may_run_out_anywhere),
    };
    return cmocka_run_group_tests_name("mesh check", tests, start, stop);
}
