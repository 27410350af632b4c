/* The proof that polygons lie apart. */
#include "core/vec.h"
#include "layout/nest.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(polygon) (sizeof(polygon) / sizeof *(polygon))
#define APART(a, b, gap)                                                                           \
    (ktg_nest_apart(a, COUNT(a), b, COUNT(b), gap) && ktg_nest_apart(b, COUNT(b), a, COUNT(a), gap))
#define NOT_APART(a, b, gap)                                                                       \
    (!ktg_nest_apart(a, COUNT(a), b, COUNT(b), gap) &&                                             \
     !ktg_nest_apart(b, COUNT(b), a, COUNT(a), gap))

static const ktg_vec2 square[] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
static const ktg_vec2 square_backwards[] = {{0, 0}, {0, 10}, {10, 10}, {10, 0}};

static void crossing_sides_overlap(void **state) {
    (void)state;
    const ktg_vec2 corner[] = {{9, 9}, {19, 9}, {19, 19}, {9, 19}};
    const ktg_vec2 bar[] = {{-5, 4}, {15, 4}, {15, 6}, {-5, 6}};
    /* no side has its middle in the other polygon */
    const ktg_vec2 post[] = {{1, -2}, {3, -2}, {3, 30}, {1, 30}};
    assert_true(NOT_APART(square, corner, 0));
    assert_true(NOT_APART(square, bar, 0));
    assert_true(NOT_APART(square, post, 0));
    assert_true(NOT_APART(bar, post, 0));
}

static void flush_overlaps_are_seen(void **state) {
    (void)state;
    const ktg_vec2 shifted[] = {{1e-12, 0}, {10 + 1e-12, 0}, {10 + 1e-12, 10}, {1e-12, 10}};
    const ktg_vec2 lower[] = {{2, 0}, {8, 0}, {8, 10}, {2, 10}};
    const ktg_vec2 diamond[] = {{5, 0}, {10, 5}, {5, 10}, {0, 5}};
    const ktg_vec2 half[] = {{0, 0}, {10, 0}, {10, 10}};
    assert_true(NOT_APART(square, square, 0));
    assert_true(NOT_APART(square, square_backwards, 0));
    assert_true(NOT_APART(square, shifted, 0));
    assert_true(NOT_APART(square, lower, 0));
    assert_true(NOT_APART(square, diamond, 0));
    assert_true(NOT_APART(square_backwards, diamond, 0));
    assert_true(NOT_APART(square, half, 0));
}

static void what_lies_inside_overlaps(void **state) {
    (void)state;
    const ktg_vec2 inner[] = {{4, 4}, {6, 4}, {6, 6}, {4, 6}};
    const ktg_vec2 thin[] = {{4, 4}, {6, 4}, {6, 4 + 1e-14}};
    assert_true(NOT_APART(square, inner, 0));
    assert_true(NOT_APART(square_backwards, inner, 0));
    assert_true(NOT_APART(square, inner, 1));
    assert_true(NOT_APART(square, thin, 0));
}

static void touching_is_allowed(void **state) {
    (void)state;
    const ktg_vec2 beside[] = {{10, 0}, {20, 0}, {20, 10}, {10, 10}};
    const ktg_vec2 higher[] = {{10, 3}, {20, 3}, {20, 13}, {10, 13}};
    const ktg_vec2 at_corner[] = {{10, 10}, {20, 10}, {20, 20}, {10, 20}};
    const ktg_vec2 tip[] = {{10, 5}, {20, 0}, {20, 10}};
    assert_true(APART(square, beside, 0));
    assert_true(APART(square_backwards, beside, 0));
    assert_true(APART(square, higher, 0));
    assert_true(APART(square, at_corner, 0));
    assert_true(APART(square, tip, 0));
}

static void bays_may_be_filled_exactly(void **state) {
    (void)state;
    const ktg_vec2 bracket[] = {{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {3, 3}, {3, 9}, {0, 9}};
    const ktg_vec2 key[] = {{3, 3}, {6, 3}, {6, 9}, {3, 9}};
    const ktg_vec2 wide_key[] = {{3, 3}, {6 + 1e-12, 3}, {6 + 1e-12, 9}, {3, 9}};
    const ktg_vec2 half_key[] = {{3.5, 3}, {6, 3}, {6, 12}, {3.5, 12}};
    assert_true(APART(bracket, key, 0));
    assert_true(NOT_APART(bracket, wide_key, 0));
    assert_true(APART(bracket, half_key, 0));
    assert_true(NOT_APART(bracket, half_key, 0.5));
}

/* A slit is walked on both sides: nothing has room in it. */
static void weakly_simple_outlines_are_understood(void **state) {
    (void)state;
    const ktg_vec2 slit[] = {{0, 0}, {10, 0}, {10, 10}, {5, 10}, {5, 2}, {5, 10}, {0, 10}};
    const ktg_vec2 across[] = {{4, 5}, {6, 5}, {6, 6}, {4, 6}};
    const ktg_vec2 above[] = {{4, 10}, {6, 10}, {6, 12}, {4, 12}};
    assert_true(NOT_APART(slit, across, 0));
    assert_true(APART(slit, above, 0));
}

static void the_gap_is_kept(void **state) {
    (void)state;
    const ktg_vec2 beside[] = {{12, 0}, {20, 0}, {20, 10}, {12, 10}};
    const ktg_vec2 at_corner[] = {{11.5, 11.5}, {20, 11.5}, {20, 20}, {11.5, 20}};
    assert_true(APART(square, beside, 0));
    assert_true(APART(square, beside, 2));
    assert_true(NOT_APART(square, beside, 2.00001));
    assert_true(APART(square, at_corner, 2.12));
    assert_true(NOT_APART(square, at_corner, 2.13));
    assert_true(NOT_APART(square, square, 1));
}

static void needles_and_points_that_repeat_are_taken(void **state) {
    (void)state;
    const ktg_vec2 needle[] = {{-5, 5}, {15, 5}, {15, 5}, {-5, 5}};
    const ktg_vec2 repeated[] = {{0, 0}, {0, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 10}};
    const ktg_vec2 straight[] = {{0, 0}, {5, 0}, {7, 0}, {10, 0}, {10, 10}, {0, 10}};
    const ktg_vec2 beside[] = {{10, 0}, {20, 0}, {20, 10}, {10, 10}};
    assert_true(NOT_APART(square, needle, 0));
    assert_true(NOT_APART(square, repeated, 0));
    assert_true(NOT_APART(straight, square, 0));
    assert_true(APART(repeated, beside, 0));
    assert_true(APART(straight, beside, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossing_sides_overlap),
        cmocka_unit_test(flush_overlaps_are_seen),
        cmocka_unit_test(what_lies_inside_overlaps),
        cmocka_unit_test(touching_is_allowed),
        cmocka_unit_test(bays_may_be_filled_exactly),
        cmocka_unit_test(weakly_simple_outlines_are_understood),
        cmocka_unit_test(the_gap_is_kept),
        cmocka_unit_test(needles_and_points_that_repeat_are_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
