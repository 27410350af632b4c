/* Overlap of flat triangles, against Minkowski differences and clipping. */
#include "core/random.h"
#include "core/vec.h"
#include "tests/unfold/reference.h"
#include "tests/unfold/shapes.h"
#include "unfold/overlap.h"

#define DEPTH 1e-9

static void measure(const ktg_vec2 t[3], double lengths[3]) {
    for (int k = 0; k < 3; k++)
        lengths[k] = ktg_length2(ktg_sub2(t[(k + 1) % 3], t[k]));
}

static bool overlap(const ktg_vec2 a[3], const ktg_vec2 b[3], double depth) {
    double a_lengths[3], b_lengths[3];
    measure(a, a_lengths);
    measure(b, b_lengths);
    bool result = ktg_triangles_overlap(a, a_lengths, b, b_lengths, depth);
    assert_true(result == ktg_triangles_overlap(b, b_lengths, a, a_lengths, depth));
    return result;
}

static ktg_vec2 random_point(ktg_random *random, double size) {
    double x = ktg_random_unit(random);
    return (ktg_vec2){size * x, size * ktg_random_unit(random)};
}

/* Counter-clockwise; every fourth one is a sliver. */
static void random_triangle(ktg_random *random, double size, ktg_vec2 t[3]) {
    ktg_vec2 at = random_point(random, 1);
    for (int k = 0; k < 3; k++)
        t[k] = ktg_add2(at, random_point(random, size));
    if (ktg_random_below(random, 4) == 0)
        t[2] = ktg_madd2(t[2], 1, ktg_mul2(ktg_sub2(t[0], t[2]), 0.99999));
    if (ktg_cross2(ktg_sub2(t[1], t[0]), ktg_sub2(t[2], t[0])) < 0) {
        ktg_vec2 other = t[1];
        t[1] = t[2];
        t[2] = other;
    }
}

static void touching_along_an_edge_is_no_overlap(void **state) {
    (void)state;
    const ktg_vec2 a[3] = {{0, 0}, {3, 1}, {1, 2}}, b[3] = {{3, 1}, {0, 0}, {2, -2}};
    assert_false(overlap(a, b, 0));
    assert_false(overlap(a, b, DEPTH));
    /* along a part of it, too */
    const ktg_vec2 c[3] = {{1.5, 0.5}, {0, 0}, {2, -2}};
    assert_false(overlap(a, c, DEPTH));
}

static void touching_in_a_point_is_no_overlap(void **state) {
    (void)state;
    const ktg_vec2 a[3] = {{0, 0}, {1, 0}, {0, 1}};
    const ktg_vec2 corner[3] = {{1, 0}, {2, -1}, {2, 1}}, edge[3] = {{0.5, 0.5}, {2, 1}, {1, 2}};
    assert_false(overlap(a, corner, 0));
    assert_false(overlap(a, edge, 0));
}

static void a_triangle_overlaps_itself_and_what_lies_in_it(void **state) {
    (void)state;
    const ktg_vec2 a[3] = {{0, 0}, {9, 0}, {0, 9}}, inside[3] = {{2, 2}, {3, 2}, {2, 3}};
    assert_true(overlap(a, a, DEPTH));
    assert_true(overlap(a, inside, DEPTH));
}

static void needles_side_by_side_overlap_by_their_width_and_crossing_ones_deeply(void **state) {
    (void)state;
    const ktg_vec2 a[3] = {{-1, 0}, {1, 0}, {1, 1e-6}}, across[3] = {{0, -1}, {1e-6, 1}, {0, 1}};
    assert_true(overlap(a, a, DEPTH));
    assert_true(overlap(a, a, 0.9e-6));
    assert_false(overlap(a, a, 1.1e-6));
    assert_true(overlap(a, across, 0.9));
    assert_false(overlap(a, across, 1.1));
}

static void the_depth_is_the_shortest_way_out(void **state) {
    (void)state;
    const ktg_vec2 a[3] = {{0, 0}, {4, 0}, {0, 4}};
    for (int sign = -1; sign <= 1; sign += 2) {
        double depth = DEPTH * (1 + sign * 1e-3), d = depth * sqrt(0.5);
        ktg_vec2 b[3] = {{2 - d, 2 - d}, {4, 3}, {3, 4}};
        assert_true(overlap(a, b, DEPTH) == (sign > 0));
        ktg_vec2 c[3] = {{1, depth}, {0.5, -1}, {1.5, -1}};
        assert_true(overlap(a, c, DEPTH) == (sign > 0));
    }
}

static void random_pairs_agree_with_the_minkowski_difference(void **state) {
    (void)state;
    ktg_random random;
    ktg_random_seed(&random, 11);
    int yes = 0, no = 0;
    for (int i = 0; i < 200000; i++) {
        ktg_vec2 a[3], b[3];
        random_triangle(&random, 0.7, a);
        random_triangle(&random, 0.7, b);
        double depth = reference_depth(a, b);
        double limit = i % 2 ? DEPTH : 0.02;
        if (fabs(depth - limit) < 1e-12)
            continue;
        assert_true(overlap(a, b, limit) == (depth > limit));
        yes += depth > limit;
        no += depth < limit;
    }
    assert_true(yes > 20000 && no > 20000);
}

static void random_pairs_agree_with_clipping(void **state) {
    (void)state;
    ktg_random random;
    ktg_random_seed(&random, 12);
    for (int i = 0; i < 100000; i++) {
        ktg_vec2 a[3], b[3];
        random_triangle(&random, 0.7, a);
        random_triangle(&random, 0.7, b);
        if (!overlap(a, b, DEPTH))
            assert_true(reference_common_area(a, b) < 2 * DEPTH);
        else if (!overlap(a, b, 1e-3))
            continue; /* too little for the area to tell */
        else
            assert_true(reference_common_area(a, b) > 0);
    }
}

static void boxes_never_hide_an_overlap(void **state) {
    (void)state;
    ktg_random random;
    ktg_random_seed(&random, 13);
    int apart = 0;
    for (int i = 0; i < 200000; i++) {
        ktg_vec2 a[3], b[3];
        random_triangle(&random, 0.3, a);
        random_triangle(&random, 0.3, b);
        ktg_vec2 far = {i % 3 - 1.0, i % 5 - 2.0}; /* negative coordinates, too */
        for (int k = 0; k < 3; k++) {
            a[k] = ktg_add2(a[k], far);
            b[k] = ktg_add2(b[k], far);
        }
        ktg_flat_box box_a = ktg_flat_box_of(a), box_b = ktg_flat_box_of(b),
                     both = ktg_flat_box_empty();
        assert_false(ktg_flat_boxes_meet(&both, &box_a));
        ktg_flat_box_add(&both, &box_a);
        ktg_flat_box_add(&both, &box_b);
        assert_true(ktg_flat_boxes_meet(&both, &box_a) && ktg_flat_boxes_meet(&both, &box_b));
        for (int k = 0; k < 3; k++) {
            assert_true(box_a.x0 <= a[k].x && a[k].x <= box_a.x1);
            assert_true(box_a.y0 <= a[k].y && a[k].y <= box_a.y1);
        }
        if (!ktg_flat_boxes_meet(&box_a, &box_b))
            assert_false(overlap(a, b, 0));
        apart += !ktg_flat_boxes_meet(&box_a, &box_b);
    }
    assert_in_range(apart, 50000, 199000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(touching_along_an_edge_is_no_overlap),
        cmocka_unit_test(touching_in_a_point_is_no_overlap),
        cmocka_unit_test(a_triangle_overlaps_itself_and_what_lies_in_it),
        cmocka_unit_test(needles_side_by_side_overlap_by_their_width_and_crossing_ones_deeply),
        cmocka_unit_test(the_depth_is_the_shortest_way_out),
        cmocka_unit_test(random_pairs_agree_with_the_minkowski_difference),
        cmocka_unit_test(random_pairs_agree_with_clipping),
        cmocka_unit_test(boxes_never_hide_an_overlap),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
