/* Polygons grown: by how much, around what corners, and what cannot be grown. */
#include "core/memory.h"
#include "core/vec.h"
#include "pattern/offset.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static double area_of(const ktg_vec2 *polygon, size_t count) {
    double twice = 0;
    for (size_t i = 0; i < count; i++)
        twice += ktg_cross2(polygon[i], polygon[(i + 1) % count]);
    return twice / 2;
}

static double distance_to(const ktg_vec2 *polygon, size_t count, ktg_vec2 p) {
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 a = polygon[i], ab = ktg_sub2(polygon[(i + 1) % count], a), ap = ktg_sub2(p, a);
        double along = fmax(0, fmin(1, ktg_dot2(ap, ab) / ktg_dot2(ab, ab)));
        least = fmin(least, ktg_length2(ktg_sub2(ap, ktg_mul2(ab, along))));
    }
    return least;
}

/* Nothing of what came out is nearer than `distance`, and its area lies between two bounds. */
static void grow(ktg_context *context, const ktg_vec2 *polygon, size_t count, double distance,
                 double least, double most) {
    ktg_vec2 *grown = NULL;
    size_t grown_count = 0;
    assert_int_equal(ktg_offset_outward(context, polygon, count, distance, &grown, &grown_count),
                     KTG_OK);
    for (size_t i = 0; i < grown_count; i++)
        assert_true(distance_to(polygon, count, grown[i]) > distance * (1 - 1e-6));
    double area = area_of(grown, grown_count);
    assert_true(area > least && area < most);
    ktg_free(grown);
}

static const ktg_vec2 square[] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

static void a_square_grows_on_all_sides(void **state) {
    grow(*state, square, 4, 1, 140, 144 + 1e-9);
    grow(*state, square, 4, 0.01, 100.39, 100.4005);
}

static void corners_that_come_twice_count_once(void **state) {
    static const ktg_vec2 twice[] = {{0, 0}, {0, 0}, {10, 0}, {10, 10}, {10, 10}, {0, 10}, {0, 0}};
    ktg_vec2 *once = NULL, *grown[2] = {NULL, NULL};
    size_t count = 0, counts[2];
    assert_int_equal(ktg_offset_outward(*state, twice, 7, 0, &once, &count), KTG_OK);
    assert_int_equal(count, 4);
    assert_memory_equal(once, square, sizeof square);
    ktg_free(once);
    assert_int_equal(ktg_offset_outward(*state, twice, 7, 2, &grown[0], &counts[0]), KTG_OK);
    assert_int_equal(ktg_offset_outward(*state, square, 4, 2, &grown[1], &counts[1]), KTG_OK);
    assert_int_equal(counts[0], counts[1]);
    assert_memory_equal(grown[0], grown[1], counts[0] * sizeof **grown);
    ktg_free(grown[0]);
    ktg_free(grown[1]);
}

static void a_bay_that_closes_is_filled(void **state) {
    static const ktg_vec2 bay[] = {{0, 0}, {10, 0}, {10, 10}, {6, 10},
                                   {6, 1}, {4, 1},  {4, 10},  {0, 10}};
    grow(*state, bay, 8, 0.5, 82 + 20, 121 + 1e-9);
    grow(*state, bay, 8, 2, 190, 196 + 1e-9);
}

static void what_is_no_polygon_is_refused(void **state) {
    static const ktg_vec2 lost[] = {{0, 0}, {NAN, 0}, {10, 10}};
    ktg_vec2 *grown = NULL;
    size_t count = 0;
    assert_int_equal(ktg_offset_outward(*state, lost, 3, 1, &grown, &count), KTG_GEOMETRY);
    assert_null(grown);
}

static void short_memory_is_told(void **state) {
    ktg_status status = KTG_MEMORY;
    ktg_vec2 *grown = NULL;
    size_t count;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_context_fail_allocation(*state, ++nth);
        status = ktg_offset_outward(*state, square, 4, 1, &grown, &count);
        end_short_memory(*state, status);
        assert_true(status == KTG_OK || !grown);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 3);
    ktg_free(grown);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_square_grows_on_all_sides), TEST(corners_that_come_twice_count_once),
        TEST(a_bay_that_closes_is_filled), TEST(what_is_no_polygon_is_refused),
        TEST(short_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
