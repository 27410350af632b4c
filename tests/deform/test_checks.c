/* Edits that cannot be: each is refused before anything is factored, with names. */
#include "core/vec.h"
#include "shapes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FAR 100.0

static const ktg_vec3 low = {-FAR, -FAR, -FAR}, high = {FAR, FAR, FAR};

/* Two plates side by side, 6 x 4 cells, a cell apart. */
static void two_plates(rig *r) {
    rig_plate(r, 6, 4, (ktg_vec3){0, 0, 0}, (ktg_vec3){6, 0, 0}, (ktg_vec3){0, 4, 0});
    rig_plate(r, 6, 4, (ktg_vec3){7, 0, 0}, (ktg_vec3){6, 0, 0}, (ktg_vec3){0, 4, 0});
    rig_mesh(r);
    rig_hold(r, KTG_HOLD_FIXED, "start", low, (ktg_vec3){0, FAR, FAR})->line = 3;
}

static void assert_refused(rig *r, const char *const *said) {
    assert_int_equal(rig_try(r), KTG_FORMAT);
    for (; *said; said++)
        if (!strstr(ktg_context_message(r->context), *said))
            fail_msg("\"%s\" lacks \"%s\"", ktg_context_message(r->context), *said);
}
#define REFUSED(r, ...) assert_refused(r, (const char *const[]){__VA_ARGS__, NULL})

static void a_part_that_nothing_holds_is_named_with_its_size(void **state) {
    rig *r = *state;
    two_plates(r);
    REFUSED(r, "component \"part 2\" (48 faces, 6 x 4 x 0) is held by nothing");
    rig_plate(r, 1, 1, (ktg_vec3){0, 9, 0}, (ktg_vec3){1, 0, 0}, (ktg_vec3){0, 1, 0});
    rig_mesh(r);
    REFUSED(r, "part 2", "and 1 more component,");
    /* a link is enough, also through a third part */
    rig_link(r, KTG_LINK_VERTEX, 0, 35, 35, 35, 1.01);
    rig_link(r, KTG_LINK_FACE, 70, 4, 0, 35, 5.01);
    rig_deform(r);
}

static void a_vertex_under_two_motions_is_refused(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){0, 4, -1}, high)->line = 9;
    REFUSED(r, "[fixed start] (line 3)", "[handle end] (line 9)", "vertex 29");
}

static void two_handles_are_two_motions_even_when_alike(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_HANDLE, "one", (ktg_vec3){5, -1, -1}, high);
    rig_hold(r, KTG_HOLD_HANDLE, "two", (ktg_vec3){8, -1, -1}, high);
    REFUSED(r, "[handle one]", "[handle two]", "both move");
}

static void two_motions_meet_in_a_rigid_part(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){6, -1, -1}, high);
    rig_hold(r, KTG_HOLD_RIGID, "plate", low, high);
    REFUSED(r, "[fixed start] (line 3)", "[handle end]", "[rigid plate] makes one body");
}

static void two_motions_meet_in_a_link(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_FIXED, "edge", (ktg_vec3){6, -1, -1}, (ktg_vec3){6, 9, 9});
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){7, -1, -1}, high);
    rig_link(r, KTG_LINK_VERTEX, 0, 35, 35, 35, 1.01)->name = (char *)(uintptr_t) "seam";
    REFUSED(r, "[fixed edge]", "[handle end]", "[link seam] makes one body");
    r->links[0].name = NULL;
}

static void two_fixed_regions_may_meet(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_FIXED, "too", low, high);
    rig_hold(r, KTG_HOLD_RIGID, "plate", low, high);
    rig_deform(r);
    assert_int_equal(r->report.unknowns, 0);
}

static void two_sizes_are_refused(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_RESIZE, "large", (ktg_vec3){2, -1, -1}, high)->scale = 2;
    rig_hold(r, KTG_HOLD_RESIZE, "small", (ktg_vec3){4, -1, -1}, high)->scale = 0.5;
    REFUSED(r, "[resize large]", "[resize small]", "give two sizes");
    r->holds[2].scale = NAN;
    REFUSED(r, "[resize small]", "makes no sense");
}

static void a_part_that_is_held_twice_cannot_be_resized(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold(r, KTG_HOLD_RESIZE, "plate", low, high)->scale = 2;
    REFUSED(r, "[fixed start]", "[resize plate]", "more than one vertex");
}

static void a_link_without_a_pair_says_how_far_off_it_is(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_link(r, KTG_LINK_AUTO, 0, 35, 35, 35, 0.9)->line = 17;
    r->edit.file = (char *)(uintptr_t) "x.edit";
    REFUSED(r,
            "x.edit:17:", "finds no pair within max = 0.9: the nearest two vertices are 1 apart");
    r->edit.file = NULL;
}

static void a_rigid_part_without_edges_is_refused(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold_run(r, KTG_HOLD_RIGID, "dots", 2, 1);
    REFUSED(r, "[rigid dots]", "no edge between its vertices");
    r->holds[1].vertex_count = 2;
    r->holds[1].vertices[1] = 40;
    REFUSED(r, "[rigid dots]", "no edge between its vertices");
    r->holds[1].together = true;
    rig_deform(r); /* which holds the other plate, too */
    assert_true(r->report.feature_error < 1e-12);
}

static void an_empty_hold_is_refused(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold_run(r, KTG_HOLD_HANDLE, "nobody", 0, 0);
    REFUSED(r, "[handle nobody] takes hold of no vertex");
}

static void motions_in_another_unit_are_refused(void **state) {
    rig *r = *state;
    two_plates(r);
    ktg_hold *hold = rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){7, -1, -1}, high);
    hold->motion.move.x = 1e7;
    REFUSED(r, "[handle end] moves by 1e+07");
    hold->motion = (ktg_deform_motion){.axis = {0, 0, 1}, .angle = 1, .centre = {1e9, 0, 0}};
    REFUSED(r, "[handle end]", "another unit");
    hold->motion = (ktg_deform_motion){.angle = 1};
    REFUSED(r, "axis without a direction");
    hold->motion = (ktg_deform_motion){.axis = {0, 0, 1}, .angle = 1e9};
    REFUSED(r, "turns by more than");
}

static void indices_out_of_range_are_refused(void **state) {
    rig *r = *state;
    two_plates(r);
    rig_hold_run(r, KTG_HOLD_HANDLE, "end", 69, 1)->vertices[0] = 70;
    assert_int_equal(rig_try(r), KTG_ARGUMENT);
    r->holds[1].vertices[0] = 69;
    rig_link(r, KTG_LINK_AUTO, 0, 35, 35, 35, 2)->to[0] = 70;
    REFUSED(r, "not there");
}

/* Each plate's border follows the other's: one way holds, the other is left out. */
static void links_that_go_round_in_circles_are_left_out(void **state) {
    rig *r = *state;
    rig_plate(r, 6, 4, (ktg_vec3){0, 0, 0}, (ktg_vec3){6, 0, 0}, (ktg_vec3){0, 4, 0});
    uint32_t other =
        rig_plate(r, 6, 4, (ktg_vec3){0.5, 0.3, 1}, (ktg_vec3){5, 0, 0}, (ktg_vec3){0, 3.4, 0});
    rig_mesh(r);
    rig_hold(r, KTG_HOLD_FIXED, "start", low, (ktg_vec3){0, FAR, FAR});
    rig_hold(r, KTG_HOLD_HANDLE, "end", (ktg_vec3){6, -FAR, -FAR}, high)->motion = bend(0, 6, 1);
    rig_link(r, KTG_LINK_FACE, 0, 35, other, 35, 1.2);
    rig_link(r, KTG_LINK_FACE, other, 35, 0, 35, 1.2);
    rig_deform(r);
    print_message("# %u follow, %u left out\n", r->report.follower_links, r->report.links_left_out);
    assert_true(r->report.links_left_out > 0 && r->report.follower_links > 10);
    assert_true(r->report.link_error < 1e-12);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, rig_setup, rig_teardown)
    const struct CMUnitTest tests[] = {
        TEST(a_part_that_nothing_holds_is_named_with_its_size),
        TEST(a_vertex_under_two_motions_is_refused),
        TEST(two_handles_are_two_motions_even_when_alike),
        TEST(two_motions_meet_in_a_rigid_part),
        TEST(two_motions_meet_in_a_link),
        TEST(two_fixed_regions_may_meet),
        TEST(two_sizes_are_refused),
        TEST(a_part_that_is_held_twice_cannot_be_resized),
        TEST(a_link_without_a_pair_says_how_far_off_it_is),
        TEST(a_rigid_part_without_edges_is_refused),
        TEST(an_empty_hold_is_refused),
        TEST(motions_in_another_unit_are_refused),
        TEST(indices_out_of_range_are_refused),
        TEST(links_that_go_round_in_circles_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
