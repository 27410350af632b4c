/* tests/mesh/test_hausdorff.c - the distance between surfaces, where it is known. */
#include "shapes.h"

static double distance(void **state, const ktg_mesh *a, const ktg_mesh *b, double spacing) {
    double there, back;
    OK(ktg_mesh_hausdorff(context_of(state), a, b, spacing, &there));
    OK(ktg_mesh_hausdorff(context_of(state), b, a, spacing, &back));
    assert_true(there == back);
    return there;
}

static ktg_mesh *cube(void **state, double x, double size) {
    builder *b = build();
    add_cube(b, x, 0, 0, size);
    return finish(state, b);
}

static void a_surface_is_at_no_distance_from_itself(void **state) {
    ktg_mesh *mesh = cube(state, 0.3, 1.7);
    assert_true(distance(state, mesh, mesh, 0) < 1e-15);
    ktg_mesh_free(&mesh);
}

static void a_shifted_cube_is_as_far_as_its_shift(void **state) {
    ktg_mesh *a = cube(state, 0, 1), *b = cube(state, 0.25, 1);
    assert_float_equal(distance(state, a, b, 0), 0.25, 1e-12);
    ktg_mesh_free(&a);
    ktg_mesh_free(&b);
}

static void the_further_of_both_directions_counts(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 7};
    uint32_t part[] = {0, 1, 2}, whole[] = {0, 1, 2, 0, 3, 1};
    ktg_mesh *a = make(state, points, 3, part, 1), *b = make(state, POINTS(points), FACES(whole));
    assert_float_equal(distance(state, a, b, 0), 7, 1e-12);
    ktg_mesh_free(&a);
    ktg_mesh_free(&b);
}

/* Far from every vertex: the middle of a large face over a dent. */
static void samples_lie_within_faces_as_densely_as_asked(void **state) {
    double flat[] = {0, 0, 0, 9, 0, 0, 0, 9, 0}, dented[] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 3, 3, -1};
    uint32_t one[] = {0, 1, 2}, three[] = {0, 1, 3, 1, 2, 3, 2, 0, 3};
    ktg_mesh *a = make(state, POINTS(flat), FACES(one)),
             *b = make(state, POINTS(dented), FACES(three));
    double there;
    for (double spacing = 2; spacing > 0.1; spacing /= 2) {
        there = distance(state, a, b, spacing);
        assert_true(there <= 1 + 1e-12 && there >= 1 - spacing);
    }
    ktg_mesh_free(&a);
    ktg_mesh_free(&b);
    /* only from the flat side, whose vertices all lie on the other surface */
    double raised[] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 3, 3, 0, 0, 0, 2, 9, 0, 2, 0, 9, 2};
    uint32_t plain[] = {0, 1, 2}, walls[] = {0, 1, 4, 1, 2, 5, 2, 0, 6};
    a = make(state, POINTS(flat), FACES(plain));
    b = make(state, POINTS(raised), FACES(walls));
    there = distance(state, a, b, 0.2);
    assert_float_equal(there, 9 / (2 + sqrt(2)), 0.2); /* the radius of the circle within */
    ktg_mesh_free(&a);
    ktg_mesh_free(&b);
}

static void nonsense_is_refused(void **state) {
    ktg_mesh *mesh = cube(state, 0, 1), *empty = cube(state, 0, 1);
    double d;
    empty->face_count = 0;
    assert_int_equal(ktg_mesh_hausdorff(context_of(state), mesh, empty, 0, &d), KTG_ARGUMENT);
    assert_int_equal(ktg_mesh_hausdorff(context_of(state), empty, mesh, 0, &d), KTG_ARGUMENT);
    assert_int_equal(ktg_mesh_hausdorff(context_of(state), mesh, mesh, -1, &d), KTG_ARGUMENT);
    assert_int_equal(ktg_mesh_hausdorff(context_of(state), mesh, mesh, NAN, &d), KTG_ARGUMENT);
    assert_int_equal(ktg_mesh_hausdorff(context_of(state), mesh, mesh, 1e-9, &d), KTG_LIMIT);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&empty);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_surface_is_at_no_distance_from_itself),
        cmocka_unit_test(a_shifted_cube_is_as_far_as_its_shift),
        cmocka_unit_test(the_further_of_both_directions_counts),
        cmocka_unit_test(samples_lie_within_faces_as_densely_as_asked),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests_name("mesh hausdorff", tests, start, stop);
}
