/* What must hold: the table of the specification, row by row. */
#include "core/vec.h"
#include "shapes.h"

#include <math.h>
#include <stdio.h>

#define FAR 100.0
static const ktg_vec3 everywhere_low = {-FAR, -FAR, -FAR}, everywhere_high = {FAR, FAR, FAR};

/* Holds the end of a strip along x at x0, and moves that at x1. */
static void hold_ends(rig *r, double x0, double x1, ktg_deform_motion motion) {
    rig_hold(r, KTG_HOLD_FIXED, "start", everywhere_low, (ktg_vec3){x0 + 1e-9, FAR, FAR});
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){x1 - 1e-9, -FAR, -FAR}, everywhere_high)
        ->motion = motion;
}

/* ---- a hole --------------------------------------------------------------------------------- */

/* Largest deviation of a ring's points from their mean distance to their middle, over that. */
static double out_of_round(const ktg_vec3 *p, uint32_t first, uint32_t count) {
    ktg_vec3 middle = {0, 0, 0};
    double mean = 0, worst = 0;
    for (uint32_t i = 0; i < count; i++)
        middle = ktg_madd3(middle, 1.0 / count, p[first + i]);
    for (uint32_t i = 0; i < count; i++)
        mean += ktg_length3(ktg_sub3(p[first + i], middle)) / count;
    for (uint32_t i = 0; i < count; i++)
        worst = fmax(worst, fabs(ktg_length3(ktg_sub3(p[first + i], middle)) - mean));
    return worst / mean;
}

static void a_hole_declared_rigid_stays_round_and_another_does_not(void **state) {
    rig *r = *state;
    rig_square_with_hole(r, 48, 12, 0.4);
    rig_mesh(r);
    hold_ends(r, -1, 1, bend(-1, 1, KTG_PI / 3));
    rig_deform(r);
    double free_hole = out_of_round(r->after, 0, 48);
    rig_hold_run(r, KTG_HOLD_RIGID, "hole", 0, 48);
    rig_deform(r);
    double rigid_hole = out_of_round(r->after, 0, 48);
    double radius = 0;
    for (uint32_t i = 0; i < 24; i++)
        radius = fmax(radius, fabs(gap(r->after, i, i + 24) / 0.8 - 1));
    print_message("# hole: %.3g rigid, %.3g free\n", rigid_hole, free_hole);
    assert_true(free_hole >= 1e-2);
    assert_true(rigid_hole <= 1e-9 && radius <= 1e-9);
    assert_true(r->report.feature_error <= 1e-9);
}

/* ---- links ---------------------------------------------------------------------------------- */

#define LONG 20
#define WIDE 6

/* Two plates in a row, 0.1 apart, WIDE x LONG cells of 0.1. */
static void two_in_a_row(rig *r, uint32_t wide_b, uint32_t first[2]) {
    first[0] =
        rig_plate(r, LONG, WIDE, (ktg_vec3){0, 0, 0}, (ktg_vec3){2, 0, 0}, (ktg_vec3){0, 0.6, 0});
    first[1] = rig_plate(r, LONG, wide_b, (ktg_vec3){2.1, 0, 0}, (ktg_vec3){2, 0, 0},
                         (ktg_vec3){0, 0.6, 0});
    rig_mesh(r);
    hold_ends(r, 0, 4.1, bend(0, 4.1, KTG_PI / 2));
}

static double turn_between(const ktg_vec3 *p, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    return degrees_between(direction(p, a, b), direction(p, c, d));
}

static void a_gap_keeps_its_width_and_turns_no_more_than_the_rest(void **state) {
    rig *r = *state;
    uint32_t first[2], row = LONG + 1;
    two_in_a_row(r, WIDE, first);
    rig_link(r, KTG_LINK_VERTEX, first[0], row * (WIDE + 1), first[1], row * (WIDE + 1), 0.1001);
    rig_deform(r);
    double worst = 0, elsewhere = 0, here = 0;
    for (uint32_t j = 0; j <= WIDE; j++) {
        uint32_t a = first[0] + j * row, b = first[1] + j * row;
        worst = fmax(worst, fabs(gap(r->after, a + LONG, b) - 0.1));
        here = fmax(here, turn_between(r->after, a + LONG - 1, a + LONG, b, b + 1));
        here = fmax(here, turn_between(r->after, a + LONG - 1, a + LONG, a + LONG, b));
        here = fmax(here, turn_between(r->after, a + LONG, b, b, b + 1));
        for (uint32_t i = 2; i < LONG; i++) {
            elsewhere =
                fmax(elsewhere, turn_between(r->after, a + i - 2, a + i - 1, a + i - 1, a + i));
            elsewhere =
                fmax(elsewhere, turn_between(r->after, b + i - 2, b + i - 1, b + i - 1, b + i));
        }
    }
    print_message("# gap: off by %.3g; turns %.3g degrees at the link, %.3g elsewhere\n", worst,
                  here, elsewhere);
    assert_int_equal(r->report.vertex_links, WIDE + 1);
    assert_true(worst <= 1e-9 && r->report.link_error <= 1e-9);
    assert_true(here <= elsewhere);
}

static void followers_keep_their_distance_too(void **state) {
    static const ktg_link_kind kinds[] = {KTG_LINK_EDGE, KTG_LINK_FACE, KTG_LINK_AUTO};
    rig *r = *state;
    uint32_t first[2], row = LONG + 1;
    two_in_a_row(r, WIDE - 2, first);
    rig_link(r, KTG_LINK_AUTO, first[0], row * (WIDE + 1), first[1], row * (WIDE - 1), 0.12);
    for (int k = 0; k < 3; k++) {
        r->links[0].kind = kinds[k];
        rig_deform(r);
        print_message("# %u pairs, %u followers: off by %.3g\n", r->report.vertex_links,
                      r->report.follower_links, r->report.link_error);
        assert_int_equal(r->report.vertex_links + r->report.follower_links, WIDE + 1);
        assert_true(r->report.follower_links >= 2);
        assert_true(r->report.link_error <= 1e-9);
        assert_true(r->report.stretch_min > 0.9 && r->report.stretch_max < 1.1);
    }
}

/* Two plates one over the other, of which only the lower one is held. */
static void stack(rig *r, double angle) {
    rig_plate(r, LONG, WIDE, (ktg_vec3){0, 0, 0}, (ktg_vec3){2, 0, 0}, (ktg_vec3){0, 0.6, 0});
    rig_plate(r, LONG, WIDE, (ktg_vec3){0, 0, 0.2}, (ktg_vec3){2, 0, 0}, (ktg_vec3){0, 0.6, 0});
    rig_mesh(r);
    rig_hold(r, KTG_HOLD_FIXED, "start", everywhere_low, (ktg_vec3){1e-9, FAR, 0.1});
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){2 - 1e-9, -FAR, -FAR}, (ktg_vec3){FAR, FAR, 0.1})
        ->motion = bend(0, 2, angle);
}

static void assert_stacked(rig *r) {
    uint32_t count = (LONG + 1) * (WIDE + 1);
    double least = INFINITY, most = 0;
    rig_deform(r);
    for (uint32_t v = 0; v < count; v++) {
        least = fmin(least, gap(r->after, v, count + v));
        most = fmax(most, gap(r->after, v, count + v));
    }
    print_message("# stacked: %.4f to %.4f of 0.2\n", least, most);
    assert_true(least >= 0.19 && most <= 0.21);
}

static void plates_stacked_along_their_sides_keep_their_distance(void **state) {
    rig *r = *state;
    uint32_t row = LONG + 1, count = row * (WIDE + 1);
    stack(r, KTG_PI / 2);
    rig_link(r, KTG_LINK_VERTEX, 0, row, count, row, 0.2001);
    rig_link(r, KTG_LINK_VERTEX, WIDE * row, row, count + WIDE * row, row, 0.2001);
    assert_stacked(r);
}

static void plates_stacked_at_their_ends_keep_their_distance(void **state) {
    rig *r = *state;
    uint32_t row = LONG + 1, count = row * (WIDE + 1);
    stack(r, KTG_PI / 6);
    for (uint32_t j = 0; j <= WIDE; j++) {
        rig_link(r, KTG_LINK_VERTEX, j * row, 1, count + j * row, 1, 0.2001);
        rig_link(r, KTG_LINK_VERTEX, j * row + LONG, 1, count + j * row + LONG, 1, 0.2001);
    }
    assert_stacked(r);
}

/* ---- ribs ----------------------------------------------------------------------------------- */

/* A plate with a rib along its middle, in cells that grow from one end to the other. */
static void a_rib_keeps_its_angle(void **state) {
    rig *r = *state;
    uint32_t row = LONG + 1;
    uint32_t plate =
        rig_plate(r, LONG, 8, (ktg_vec3){0, -0.4, 0}, (ktg_vec3){2, 0, 0}, (ktg_vec3){0, 0.8, 0});
    uint32_t middle = plate + 4 * row, rib = r->point_count;
    for (uint32_t j = 1; j <= 3; j++)
        for (uint32_t i = 0; i <= LONG; i++)
            rig_point(r, 2.0 * i / LONG, 0, 0.1 * j);
    for (uint32_t j = 0; j < 3; j++)
        for (uint32_t i = 0; i < LONG; i++) {
            uint32_t low = j == 0 ? middle : rib + (j - 1) * row, high = rib + j * row;
            rig_face(r, low + i, low + i + 1, high + i + 1);
            rig_face(r, low + i, high + i + 1, high + i);
        }
    for (uint32_t v = 0; v < r->point_count; v++) { /* small faces beside large ones */
        double t = r->points[v].x / 2;
        r->points[v].x = 2 * t * t * (3 - 2 * t);
    }
    rig_mesh(r);
    hold_ends(r, 0, 2, bend(0, 2, KTG_PI / 2));
    rig_deform(r);
    double worst = 0;
    for (uint32_t i = 0; i < LONG; i++) {
        ktg_vec3 up = normal_of(r->after, middle + i, middle + i + 1, rib + i + 1);
        ktg_vec3 left = normal_of(r->after, middle + i, middle + i + 1, middle + i + 1 + row);
        ktg_vec3 right = normal_of(r->after, middle + i, middle + i + 1, middle + i + 1 - row);
        worst = fmax(worst, fabs(degrees_between(up, left) - 90));
        worst = fmax(worst, fabs(degrees_between(up, right) - 90));
    }
    print_message("# rib: %.3g degrees off\n", worst);
    assert_true(worst <= 0.5);
}

/* ---- a chain -------------------------------------------------------------------------------- */

#define PARTS 16
#define CELLS 4

/* Sixteen plates in a row; four pairs from each to the next. */
static void chain(rig *r, ktg_deform_motion motion) {
    uint32_t count = (CELLS + 1) * (CELLS + 1);
    for (uint32_t k = 0; k < PARTS; k++)
        rig_plate(r, CELLS, CELLS, (ktg_vec3){k, 0, 0}, (ktg_vec3){0.8, 0, 0},
                  (ktg_vec3){0, 0.8, 0});
    rig_mesh(r);
    hold_ends(r, 0, PARTS - 0.2, motion);
    for (uint32_t k = 1; k < PARTS; k++)
        rig_link(r, KTG_LINK_VERTEX, (k - 1) * count, count, k * count, count, 0.2001);
    rig_deform(r);
    assert_int_equal(r->report.vertex_links, (PARTS - 1) * (CELLS + 1));
    assert_true(r->report.link_error <= 1e-9);
}

/* The turn of each part's middle about the axis grows from part to part, up to half a turn. */
static void assert_monotone(rig *r, bool twist) {
    double before = -1e-9, angle = 0;
    for (uint32_t k = 0; k < PARTS; k++) {
        uint32_t a = k * (CELLS + 1) * (CELLS + 1) + (CELLS / 2) * (CELLS + 1) + CELLS / 2;
        uint32_t b = twist ? a + CELLS + 1 : a + 1;
        ktg_vec3 d = direction(r->after, a, b);
        angle = twist ? atan2(d.z, d.y) : atan2(d.z, d.x);
        if (angle < before - 0.1) /* past half a turn */
            angle += 2 * KTG_PI;
        assert_true(angle > before);
        before = angle;
    }
    print_message("# chain: the last part's middle is at %.4g degrees\n", angle * 180 / KTG_PI);
    assert_true(angle > 2.5 && angle < KTG_PI + 1e-6);
}

static void a_chain_of_sixteen_parts_twists_evenly(void **state) {
    chain(*state,
          (ktg_deform_motion){.axis = {1, 0, 0}, .angle = KTG_PI, .centre = {PARTS - 0.2, 0.4, 0}});
    assert_monotone(*state, true);
}

static void a_chain_of_sixteen_parts_bends_evenly(void **state) {
    chain(*state, bend(0, PARTS - 0.2, KTG_PI));
    assert_monotone(*state, false);
}

/* ---- rigid motions -------------------------------------------------------------------------- */

static void a_rigid_motion_comes_out_as_it_goes_in(void **state) {
    rig *r = *state;
    double s = sqrt(0.5), worst = 0;
    rig_tube(r, 6, 2000, 0, 40, 0.1, 0.1); /* long and thin: ill-conditioned */
    rig_mesh(r);
    hold_ends(r, 0, 40, (ktg_deform_motion){{0}});
    r->holds[0].kind = KTG_HOLD_HANDLE;
    for (int h = 0; h < 2; h++)
        r->holds[h].motion = (ktg_deform_motion){
            .axis = {0, 0, 3}, .angle = 5 * KTG_PI / 4, .centre = {1, 2, 3}, .move = {4, 5, 6}};
    rig_deform(r);
    for (uint32_t v = 0; v < r->point_count; v++) {
        double x = r->points[v].x - 1, y = r->points[v].y - 2;
        ktg_vec3 wanted = {5 + s * (y - x), 7 - s * (x + y), r->points[v].z + 6};
        worst = fmax(worst, ktg_length3(ktg_sub3(r->after[v], wanted)) / 40);
    }
    print_message("# rigid motion: off by %.3g of the size\n", worst);
    assert_true(worst <= 1e-6);
}

static void without_motion_nothing_moves(void **state) {
    rig *r = *state;
    rig_tube(r, 12, 40, 0.1, 4.7, 0.5, 0.4);
    rig_mesh(r);
    hold_ends(r, 0.1, 4.7, (ktg_deform_motion){{0}});
    rig_hold_run(r, KTG_HOLD_RIGID, "ring", 12 * 20, 12);
    rig_deform(r);
    for (uint32_t v = 0; v < r->point_count; v++)
        assert_memory_equal(&r->after[v], &r->points[v], sizeof *r->after);
}

static void a_sleeve_that_is_lengthened_keeps_its_rings(void **state) {
    rig *r = *state;
    double worst = 0;
    rig_tube(r, 24, 30, 0, 6, 1.2, 0.7);
    rig_mesh(r);
    hold_ends(r, 0, 6, (ktg_deform_motion){.move = {1.5, 0, 0}});
    rig_deform(r);
    for (uint32_t v = 0; v < r->point_count; v++)
        worst = fmax(worst, fabs(hypot(r->after[v].y, r->after[v].z) -
                                 hypot(r->points[v].y, r->points[v].z)));
    print_message("# sleeve: radii off by %.3g\n", worst);
    assert_true(worst <= 1e-9);
    assert_true(r->after[15 * 24].x > 3.5 && r->after[15 * 24].x < 4.0);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, rig_setup, rig_teardown)
    const struct CMUnitTest tests[] = {
        TEST(a_hole_declared_rigid_stays_round_and_another_does_not),
        TEST(a_gap_keeps_its_width_and_turns_no_more_than_the_rest),
        TEST(followers_keep_their_distance_too),
        TEST(plates_stacked_along_their_sides_keep_their_distance),
        TEST(plates_stacked_at_their_ends_keep_their_distance),
        TEST(a_rib_keeps_its_angle),
        TEST(a_chain_of_sixteen_parts_twists_evenly),
        TEST(a_chain_of_sixteen_parts_bends_evenly),
        TEST(a_rigid_motion_comes_out_as_it_goes_in),
        TEST(without_motion_nothing_moves),
        TEST(a_sleeve_that_is_lengthened_keeps_its_rings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
