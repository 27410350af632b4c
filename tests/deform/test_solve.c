/* How the deformation behaves beyond the table: steps, refinement, units, sizes, drags. */
#include "core/vec.h"
#include "shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAR   100.0
#define SIDES 24
#define RINGS 40

static const ktg_vec3 low = {-FAR, -FAR, -FAR}, high = {FAR, FAR, FAR};

static void hold_ends(rig *r, double x0, double x1, ktg_deform_motion motion) {
    rig_hold(r, KTG_HOLD_FIXED, "start", low, (ktg_vec3){x0 + 1e-9, FAR, FAR});
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){x1 - 1e-9, -FAR, -FAR}, high)->motion = motion;
}

static void tube(rig *r, ktg_deform_motion motion) {
    rig_tube(r, SIDES, RINGS, 0, 4, 0.5, 0.5);
    rig_mesh(r);
    hold_ends(r, 0, 4, motion);
}

static ktg_deform_motion twist(double degrees) {
    return (ktg_deform_motion){.axis = {1, 0, 0}, .angle = degrees * KTG_PI / 180};
}

static double radius_in_the_middle(const rig *r) {
    double sum = 0;
    for (uint32_t i = 0; i < SIDES; i++) {
        ktg_vec3 p = r->after[RINGS / 2 * SIDES + i];
        sum += hypot(p.y, p.z) / SIDES;
    }
    return sum;
}

/* ---- steps and passes ----------------------------------------------------------------------- */

static void steps_keep_a_twisted_tube_from_getting_thin(void **state) {
    static const uint32_t steps[] = {1, 4, 8, 16};
    static const double least[] = {0, 0.46, 0.475, 0.485};
    rig *r = *state;
    double before = 0;
    tube(r, twist(180));
    for (int i = 0; i < 4; i++) {
        r->edit.steps = steps[i];
        rig_deform(r);
        double radius = radius_in_the_middle(r);
        print_message("# %u steps: radius %.3f of 0.5\n", steps[i], radius);
        assert_true(radius > before && radius > least[i] && radius < 0.5);
        before = radius;
    }
    r->edit.steps = 0;
    rig_deform(r);
    assert_int_equal(r->report.steps, 6); /* one for each 30 degrees */
    assert_true(radius_in_the_middle(r) > 0.47);
}

static void a_turn_of_more_than_half_a_turn_goes_all_the_way(void **state) {
    rig *r = *state;
    double before = 0, all = 0;
    tube(r, twist(450));
    rig_deform(r);
    for (uint32_t j = 0; j <= RINGS; j++) {
        ktg_vec3 p = r->after[j * SIDES];
        double angle = atan2(p.z, p.y), turn = remainder(angle - before, 2 * KTG_PI);
        assert_true(turn > -1e-9);
        before = angle;
        all += turn;
    }
    assert_true(fabs(all - 2.5 * KTG_PI) < 1e-9);
}

static void refinement_turns_what_a_shift_only_shears(void **state) {
    rig *r = *state;
    tube(r, (ktg_deform_motion){.move = {-0.5, 2, 0}});
    rig_deform(r);
    double least = r->report.stretch_min, most = r->report.stretch_max;
    r->edit.refine = 5;
    rig_deform(r);
    print_message("# edges %.2f to %.2f, refined %.2f to %.2f\n", least, most,
                  r->report.stretch_min, r->report.stretch_max);
    assert_true(r->report.stretch_min > least + 0.1 && r->report.stretch_max < most - 0.1);
    assert_int_equal(r->report.flipped_faces, 0);
}

/* The angle of a band's axis to x. */
static double tilt(const rig *r, uint32_t first_ring, uint32_t last_ring) {
    ktg_vec3 ends[2] = {{0, 0, 0}, {0, 0, 0}};
    for (uint32_t i = 0; i < SIDES; i++) {
        ends[0] = ktg_add3(ends[0], r->after[first_ring * SIDES + i]);
        ends[1] = ktg_add3(ends[1], r->after[last_ring * SIDES + i]);
    }
    return degrees_between(direction(ends, 0, 1), (ktg_vec3){1, 0, 0});
}

static void refinement_turns_a_rigid_part_with_its_surroundings(void **state) {
    rig *r = *state;
    tube(r, (ktg_deform_motion){.move = {-0.5, 2, 0}});
    rig_hold_run(r, KTG_HOLD_RIGID, "band", 15 * SIDES, 11 * SIDES);
    rig_deform(r);
    assert_true(tilt(r, 15, 25) < 1e-9);
    r->edit.refine = 10;
    rig_deform(r);
    print_message("# the band is turned by %.1f degrees\n", tilt(r, 15, 25));
    assert_true(tilt(r, 15, 25) > 15 && r->report.feature_error < 1e-12);
}

/* ---- units ---------------------------------------------------------------------------------- */

/* The same tube, with a rigid ring, a link and a resized end, in another unit. */
static void in_unit(rig *r, double unit) {
    uint32_t first = rig_tube(r, SIDES, RINGS, 0, 4, 0.5, 0.3), count = r->point_count;
    uint32_t second = rig_tube(r, 8, 10, 4.1, 5, 0.3, 0.3);
    for (uint32_t v = 0; v < r->point_count; v++)
        r->points[v] = ktg_mul3(r->points[v], unit);
    rig_mesh(r);
    rig_hold(r, KTG_HOLD_FIXED, "start", low, (ktg_vec3){1e-9 * unit, FAR * unit, FAR * unit})
        ->vertices[0] = 0;
    r->holds[0].vertex_count = 0;
    for (uint32_t v = 0; v < SIDES; v++)
        r->holds[0].vertices[r->holds[0].vertex_count++] = v;
    ktg_hold *end = rig_hold_run(r, KTG_HOLD_HANDLE, "end", r->point_count - 8, 8);
    end->motion = (ktg_deform_motion){.axis = {0, 0, 1},
                                      .angle = 1,
                                      .centre = {2 * unit, unit, 0},
                                      .move = {0, unit / 3, unit / 7}};
    rig_hold_run(r, KTG_HOLD_RIGID, "ring", first + RINGS / 2 * SIDES, SIDES);
    rig_hold_run(r, KTG_HOLD_RESIZE, "wide", first + 10 * SIDES, SIDES)->scale = 1.5;
    rig_link(r, KTG_LINK_AUTO, second, 8, first, count, 0.2 * unit);
    r->edit.refine = 1;
    rig_deform(r);
}

static void assert_same_in(void **state, double unit, double tolerance) {
    rig *r = *state;
    void *other_state;
    in_unit(r, 1);
    assert_int_equal(rig_setup(&other_state), 0);
    rig *other = other_state;
    in_unit(other, unit);
    double worst = 0;
    for (uint32_t v = 0; v < r->point_count; v++) {
        ktg_vec3 p = ktg_mul3(other->after[v], 1 / unit);
        worst = fmax(worst, ktg_length3(ktg_sub3(p, r->after[v])));
    }
    print_message("# unit %g: off by %.3g; %u pairs, %u follow\n", unit, worst,
                  r->report.vertex_links, r->report.follower_links);
    assert_true(worst <= tolerance);
    assert_true(r->report.vertex_links + r->report.follower_links == 8);
    rig_teardown(&other_state);
}

static void metres_and_millimetres_give_the_same(void **state) {
    assert_same_in(state, 1000, 1e-9);
}

static void thousandths_give_the_same(void **state) {
    assert_same_in(state, 0.001, 1e-9);
}

static void powers_of_two_give_the_same_bits(void **state) {
    assert_same_in(state, 1024, 0);
}

/* ---- sizes ---------------------------------------------------------------------------------- */

static double ring_radius(const ktg_vec3 *p, uint32_t ring) {
    ktg_vec3 middle = {0, 0, 0};
    for (uint32_t i = 0; i < SIDES; i++)
        middle = ktg_madd3(middle, 1.0 / SIDES, p[ring * SIDES + i]);
    return ktg_length3(ktg_sub3(p[ring * SIDES], middle));
}

static void a_resized_ring_has_its_size_and_its_neighbours_follow(void **state) {
    rig *r = *state;
    tube(r, (ktg_deform_motion){{0}});
    rig_hold_run(r, KTG_HOLD_RESIZE, "ring", RINGS / 2 * SIDES, SIDES)->scale = 1.4;
    rig_deform(r);
    assert_true(fabs(ring_radius(r->after, RINGS / 2) - 0.7) < 1e-12);
    assert_true(r->report.feature_error < 1e-12);
    double before = 0.5;
    for (uint32_t ring = 2; ring < RINGS / 2; ring++) {
        assert_true(ring_radius(r->after, ring) > before - 1e-3);
        before = ring_radius(r->after, ring);
    }
}

static void a_free_part_takes_the_scale_of_what_it_hangs_on(void **state) {
    rig *r = *state;
    uint32_t disk = rig_tube(r, SIDES, 4, 0, 1, 0.5, 0.5);
    uint32_t knob = rig_tube(r, SIDES, 4, 1.1, 1.5, 0.5, 0.5);
    rig_mesh(r);
    rig_hold_run(r, KTG_HOLD_FIXED, "point", disk, 1);
    rig_hold_run(r, KTG_HOLD_RESIZE, "disk", disk, 5 * SIDES)->scale = 2;
    rig_hold_run(r, KTG_HOLD_RESIZE, "knob", knob + SIDES, 4 * SIDES)->scale = 0;
    rig_link(r, KTG_LINK_VERTEX, knob, SIDES, disk + 4 * SIDES, SIDES, 0.11);
    rig_deform(r);
    assert_true(fabs(ring_radius(r->after, 4) - 1) < 1e-9);
    assert_true(fabs(gap(r->after, disk + 4 * SIDES, knob) - 0.2) < 1e-9);
    double scale = gap(r->after, knob + SIDES, knob + 4 * SIDES) / 0.3;
    print_message("# the free part became %.4f times as large\n", scale);
    assert_true(scale > 1.9 && scale < 2.1);
    /* and the point that is held is where it was */
    assert_memory_equal(&r->after[disk], &r->points[disk], sizeof *r->after);
}

/* ---- drags ---------------------------------------------------------------------------------- */

static void an_update_depends_on_its_motions_alone(void **state) {
    rig *r = *state;
    ktg_deform *deform;
    ktg_deform_motion motions[2] = {{{0}}};
    tube(r, twist(80));
    rig_deform(r);
    ktg_vec3 *dragged = calloc(r->point_count, sizeof *dragged);
    assert_int_equal(ktg_deform_new(r->context, r->mesh, &r->edit, &deform), KTG_OK);
    for (int i = 0; i < 5; i++) {
        motions[1] = (ktg_deform_motion){.axis = {0, 1, i}, .angle = i, .move = {0, i, 1}};
        assert_int_equal(ktg_deform_update(r->context, deform, motions, dragged), KTG_OK);
    }
    motions[1] = twist(80);
    assert_int_equal(ktg_deform_update(r->context, deform, motions, dragged), KTG_OK);
    assert_memory_equal(dragged, r->after, r->point_count * sizeof *dragged);
    motions[1].angle = NAN;
    assert_int_equal(ktg_deform_update(r->context, deform, motions, dragged), KTG_ARGUMENT);
    ktg_deform_free(&deform);
    ktg_deform_free(&deform);
    free(dragged);
}

/* ---- edges with many faces ------------------------------------------------------------------ */

static void a_cross_of_four_faces_keeps_its_angles(void **state) {
    static const ktg_vec3 wings[4] = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
    rig *r = *state;
    uint32_t first[4];
    for (uint32_t i = 0; i <= 20; i++)
        rig_point(r, 0.1 * i, 0, 0);
    for (int w = 0; w < 4; w++) {
        first[w] = r->point_count;
        for (uint32_t j = 1; j <= 4; j++)
            for (uint32_t i = 0; i <= 20; i++)
                rig_point(r, 0.1 * i, 0.1 * j * wings[w].y, 0.1 * j * wings[w].z);
        for (uint32_t j = 0; j < 4; j++)
            for (uint32_t i = 0; i < 20; i++) {
                uint32_t a = j == 0 ? i : first[w] + (j - 1) * 21 + i, b = first[w] + j * 21 + i;
                rig_face(r, a, a + 1, b + 1);
                rig_face(r, a, b + 1, b);
            }
    }
    rig_mesh(r);
    hold_ends(r, 0, 2, bend(0, 2, KTG_PI / 2));
    rig_deform(r);
    double worst = 0;
    for (uint32_t i = 0; i < 20; i++)
        for (int w = 0; w < 4; w++) {
            ktg_vec3 one = normal_of(r->after, i, i + 1, first[w] + i + 1);
            ktg_vec3 next = normal_of(r->after, i, i + 1, first[(w + 1) % 4] + i + 1);
            worst = fmax(worst, fabs(degrees_between(one, next) - 90));
        }
    print_message("# cross: %.3g degrees off\n", worst);
    assert_true(worst <= 0.5);
}

/* ---- what is reported ----------------------------------------------------------------------- */

static void what_turns_over_or_loses_its_area_is_counted(void **state) {
    rig *r = *state;
    rig_plate(r, 20, 4, (ktg_vec3){0, 0, 0}, (ktg_vec3){2, 0, 0}, (ktg_vec3){0, 0.4, 0});
    rig_mesh(r);
    hold_ends(r, 0, 2, (ktg_deform_motion){.move = {-3, 0, 0}});
    rig_deform(r);
    assert_true(r->report.flipped_faces > 100);
    r->holds[1].motion.move.x = -2;
    rig_deform(r);
    assert_true(r->report.degenerate_faces + r->report.flipped_faces > 20);
    r->holds[1].motion.move.x = 1;
    rig_deform(r);
    assert_int_equal(r->report.flipped_faces + r->report.degenerate_faces, 0);
    assert_true(fabs(r->report.moved - 1) < 1e-12);
    assert_true(r->report.stretch_max > 1.4);
}

static void a_bare_vertex_and_a_face_without_area_do_no_harm(void **state) {
    rig *r = *state;
    rig_plate(r, 10, 4, (ktg_vec3){0, 0, 0}, (ktg_vec3){2, 0, 0}, (ktg_vec3){0, 0.8, 0});
    uint32_t bare = rig_point(r, 9, 9, 9), line = rig_point(r, 1, 0, 0);
    rig_face(r, 5, line, 6);
    rig_face(r, 5, 5, 6);
    rig_mesh(r);
    hold_ends(r, 0, 8, (ktg_deform_motion){{0}});
    r->holds[1].vertex_count = 0;
    for (uint32_t v = 0; v < r->point_count; v++)
        if (r->points[v].x > 1.99 && v != bare)
            r->holds[1].vertices[r->holds[1].vertex_count++] = v;
    r->holds[1].motion = bend(0, 2, 1);
    rig_deform(r);
    assert_memory_equal(&r->after[bare], &r->points[bare], sizeof *r->after);
    for (uint32_t v = 0; v < r->point_count; v++)
        assert_true(isfinite(r->after[v].x) && isfinite(r->after[v].y) && isfinite(r->after[v].z));
    print_message("# stretch up to %.3f\n", r->report.stretch_max);
    assert_true(r->report.stretch_max < 1.5);
}

/* Vertices that lie on each other along a seam stay together when they are linked. */
static void an_open_seam_is_closed_by_a_link_of_length_nothing(void **state) {
    rig *r = *state;
    rig_plate(r, 10, 6, (ktg_vec3){0, 0, 0}, (ktg_vec3){1, 0, 0}, (ktg_vec3){0, 1, 0});
    uint32_t other =
        rig_plate(r, 10, 6, (ktg_vec3){1, 0, 0}, (ktg_vec3){1, 0, 0}, (ktg_vec3){0, 1, 0});
    rig_mesh(r);
    hold_ends(r, 0, 2, bend(0, 2, 1));
    rig_link(r, KTG_LINK_AUTO, 0, r->point_count, 0, r->point_count, 0);
    rig_deform(r);
    for (uint32_t j = 0; j <= 6; j++)
        assert_memory_equal(&r->after[11 * j + 10], &r->after[other + 11 * j], sizeof *r->after);
    assert_int_equal(r->report.vertex_links, 7);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, rig_setup, rig_teardown)
    const struct CMUnitTest tests[] = {
        TEST(steps_keep_a_twisted_tube_from_getting_thin),
        TEST(a_turn_of_more_than_half_a_turn_goes_all_the_way),
        TEST(refinement_turns_what_a_shift_only_shears),
        TEST(refinement_turns_a_rigid_part_with_its_surroundings),
        TEST(metres_and_millimetres_give_the_same),
        TEST(thousandths_give_the_same),
        TEST(powers_of_two_give_the_same_bits),
        TEST(a_resized_ring_has_its_size_and_its_neighbours_follow),
        TEST(a_free_part_takes_the_scale_of_what_it_hangs_on),
        TEST(an_update_depends_on_its_motions_alone),
        TEST(a_cross_of_four_faces_keeps_its_angles),
        TEST(what_turns_over_or_loses_its_area_is_counted),
        TEST(a_bare_vertex_and_a_face_without_area_do_no_harm),
        TEST(an_open_seam_is_closed_by_a_link_of_length_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
