/* Nesting of plain polygons. */
#include "core/vec.h"
#include "layout/nest.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define MOST_ITEMS   16
#define MOST_CORNERS 16

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static ktg_nest_shape shape_of(const ktg_vec2 *points, size_t count, const double *turns,
                               size_t turn_count) {
    return (ktg_nest_shape){points, count, points, count, turns, turn_count};
}

static void outline_at(const ktg_nest_shape *shape, const ktg_nest_place *place, ktg_vec2 *points) {
    ktg_motion2 motion = {cos(place->turn), sin(place->turn), {place->x, place->y}};
    for (size_t i = 0; i < shape->outline_count; i++)
        points[i] = ktg_move2(motion, shape->outline[i]);
}

/* All inside their bins, none overlapping, turned only as allowed. */
static void assert_sound(const ktg_nest_problem *problem, const ktg_nest_place *places) {
    ktg_vec2 points[MOST_ITEMS][MOST_CORNERS];
    for (size_t i = 0; i < problem->item_count; i++) {
        const ktg_nest_shape *shape = &problem->shapes[problem->items[i]];
        outline_at(shape, &places[i], points[i]);
        for (size_t k = 0; k < shape->outline_count; k++) {
            assert_true(points[i][k].x >= -1e-6 && points[i][k].x <= problem->length + 1e-6);
            assert_true(points[i][k].y >= -1e-6 && points[i][k].y <= problem->width + 1e-6);
        }
        bool allowed = shape->turn_count == 0;
        for (size_t k = 0; k < shape->turn_count; k++)
            allowed = allowed || places[i].turn == shape->turns[k];
        assert_true(allowed);
        for (size_t k = 0; k < i; k++)
            assert_true(places[i].bin != places[k].bin ||
                        ktg_nest_apart(points[i], shape->outline_count, points[k],
                                       problem->shapes[problem->items[k]].outline_count,
                                       problem->gap));
    }
}

/* One after the other along x, `step` apart, in a strip or one to a bin. */
static void lay_in_line(size_t count, double step, bool bins, ktg_nest_place *places) {
    for (size_t i = 0; i < count; i++)
        places[i] = (ktg_nest_place){bins ? (uint32_t)i : 0, bins ? 0 : step * (double)i, 0, 0};
}

static const ktg_vec2 right_triangle[] = {{0, 0}, {10, 0}, {0, 10}};
static const double two_turns[] = {0, KTG_PI};
static const uint32_t same_items[MOST_ITEMS] = {0};

static void triangles_pair_up_on_a_strip(void **state) {
    ktg_nest_shape shape = shape_of(right_triangle, 3, two_turns, 2);
    ktg_nest_problem problem = {&shape, 1, same_items, 8, 10.01, INFINITY, 0, 0, 20000000, 0};
    ktg_nest_place places[8];
    ktg_nest_report report;
    lay_in_line(8, 11, false, places);
    assert_int_equal(ktg_nest(*state, &problem, places, &report), KTG_OK);
    assert_sound(&problem, places);
    assert_true(report.length < 41 && report.length >= 40 * 10 / 10.01);
}

static void freely_turned_triangles_do_too(void **state) {
    ktg_nest_shape shape = shape_of(right_triangle, 3, NULL, 0);
    ktg_nest_problem problem = {&shape, 1, same_items, 8, 10.01, INFINITY, 0, 0, 60000000, 0};
    ktg_nest_place places[8];
    ktg_nest_report report;
    lay_in_line(8, 11, false, places);
    assert_int_equal(ktg_nest(*state, &problem, places, &report), KTG_OK);
    assert_sound(&problem, places);
    assert_true(report.length < 46);
}

static void few_bins_are_used(void **state) {
    ktg_nest_shape shape = shape_of(right_triangle, 3, two_turns, 2);
    ktg_nest_problem problem = {&shape, 1, same_items, 8, 10.5, 21, 0.2, 0, 40000000, 0};
    const ktg_vec2 cover[] = {{-0.15, -0.15}, {10.5, -0.15}, {-0.15, 10.5}};
    ktg_nest_place places[8];
    ktg_nest_report report;
    shape.cover = cover;
    lay_in_line(8, 0, true, places);
    assert_int_equal(ktg_nest(*state, &problem, places, &report), KTG_OK);
    assert_sound(&problem, places);
    assert_true(report.length <= 42);
    for (int i = 0; i < 8; i++)
        assert_true(places[i].bin < 2);
}

static void hostile_shapes_are_laid(void **state) {
    const ktg_vec2 needle[] = {{0, 0}, {9, 1e-9}, {0, 1e-9}};
    const ktg_vec2 flat[] = {{0, 0}, {9, 0}, {5, 0}};
    const ktg_vec2 dot[] = {{3, 3}, {3, 3}, {3, 3}};
    const ktg_vec2 repeated[] = {{0, 0}, {0, 0}, {4, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}, {0, 0}};
    const ktg_vec2 comb[] = {{0, 0}, {9, 0}, {9, 9}, {8, 9}, {8, 1}, {5, 1},
                             {5, 9}, {4, 9}, {4, 1}, {1, 1}, {1, 9}, {0, 9}};
    for (int turns = 0; turns <= 2; turns += 2) {
        ktg_nest_shape shapes[] = {shape_of(needle, 3, two_turns, (size_t)turns),
                                   shape_of(flat, 3, two_turns, (size_t)turns),
                                   shape_of(dot, 3, two_turns, (size_t)turns),
                                   shape_of(repeated, 8, two_turns, (size_t)turns),
                                   shape_of(comb, 12, two_turns, (size_t)turns)};
        const uint32_t items[] = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4};
        ktg_nest_problem problem = {shapes, 5, items, 10, 10, INFINITY, 0, 0, 20000000, 0};
        ktg_nest_place places[10];
        ktg_nest_report report;
        lay_in_line(10, 10, false, places);
        assert_int_equal(ktg_nest(*state, &problem, places, &report), KTG_OK);
        assert_sound(&problem, places);
        assert_true(report.length < 30);
    }
}

static void no_work_leaves_everything_where_it_is(void **state) {
    ktg_nest_shape shape = shape_of(right_triangle, 3, two_turns, 2);
    ktg_nest_problem problem = {&shape, 1, same_items, 3, 10, INFINITY, 0, 0, 0, 0};
    ktg_nest_place places[3];
    ktg_nest_report report;
    lay_in_line(3, 10, false, places);
    assert_int_equal(ktg_nest(*state, &problem, places, &report), KTG_OK);
    assert_int_equal(report.records, 0);
    assert_float_equal(report.length, 30, 1e-12);
    for (int i = 0; i < 3; i++)
        assert_true(places[i].x == 10 * i && places[i].y == 0 && places[i].turn == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(triangles_pair_up_on_a_strip, make_context, drop_context),
        cmocka_unit_test_setup_teardown(freely_turned_triangles_do_too, make_context, drop_context),
        cmocka_unit_test_setup_teardown(few_bins_are_used, make_context, drop_context),
        cmocka_unit_test_setup_teardown(hostile_shapes_are_laid, make_context, drop_context),
        cmocka_unit_test_setup_teardown(no_work_leaves_everything_where_it_is, make_context,
                                        drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
