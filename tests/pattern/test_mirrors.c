/* Pieces of cloth that are mirror images of others, or of themselves, and what is sewn to them. */
#include "tests/pattern/cloth.h"

#include <math.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

static void mirror_images_are_cut_together(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    assert_int_equal(cloth_finish(*state, p, NULL).twins, 1);
    assert_int_equal(p->pieces[0].cut_count, 1);
    assert_int_equal(p->pieces[0].cut_mirrored, 1); /* not a copy: the seam is on the other side */
    assert_int_equal(p->pieces[1].cut_count, 0);
    assert_int_equal(p->pieces[1].twin_of, 0);
    assert_true(cloth_has_label(&p->pieces[0], "cut 2, 1 mirrored"));
    assert_true(cloth_has_label(&p->pieces[0], "piece 1 of 1"));
    ktg_pattern_free(&p);
    p = cloth_oblongs(*state);
    p->pieces[1].vertices[1].x = p->pieces[1].vertices[2].x = 101; /* 1 mm wider */
    assert_int_equal(cloth_finish(*state, p, NULL).twins, 0);
    ktg_pattern_free(&p);
}

static void a_symmetric_piece_is_halved_on_the_fold(void **state) {
    const char *const names[] = {"skirt"};
    ktg_pattern *p = cloth_with_dart(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    cloth_finish(*state, p, &options);
    double whole = cloth_area(p->pieces);
    options.on_fold = names;
    options.on_fold_count = 1;
    assert_int_equal(cloth_finish(*state, p, &options).on_fold, 1);
    assert_true(p->pieces[0].on_fold);
    assert_true(fabs(2 * cloth_area(p->pieces) - whole) < 1e-6);
    assert_int_equal(cloth_count_lines(p->pieces, KTG_LINE_FOLD), 1);
    assert_true(cloth_has_label(p->pieces, "cut 1 on the fold"));
    for (size_t i = 0; i < p->pieces[0].line_count; i++)
        for (size_t k = 0; k < p->pieces[0].lines[i].point_count; k++)
            assert_true(p->pieces[0].lines[i].points[k].x >= 100 - 1e-9);
    ktg_pattern_free(&p);
}

static void what_is_not_symmetric_stays_whole(void **state) {
    const char *const names[] = {"left"};
    ktg_pattern *p = cloth_oblongs(*state); /* in shape it is, but its seam is on one side */
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.on_fold = names;
    options.on_fold_count = 1;
    assert_int_equal(cloth_finish(*state, p, &options).on_fold, 0);
    assert_false(p->pieces[0].on_fold);
    ktg_pattern_free(&p);
}

/* The middle of the seam between front and back is its mark, and lies on the fold of both. */
static void a_mark_on_the_fold_is_drawn(void **state) {
    const cloth_piece pieces[2] = {
        {"front", 5, {{50.05, 9}, {0, 0}, {0.7, -100}, {99.4, -100}, {100.1, 0}}, {6, 0, 2, 3, 1}},
        {"back", 5, {{50.05, 9}, {100.1, 0}, {90.1, 200}, {10, 200}, {0, 0}}, {6, 1, 4, 5, 0}},
    };
    const ktg_vec3 positions[7] = {{0, 0, 0},    {100, 0, 0},  {0, -100, 0}, {100, -100, 0},
                                   {90, 200, 0}, {10, 200, 0}, {50, 9, 0}};
    static const char *const names[] = {"front", "back"};
    ktg_pattern *p = cloth_make(*state, pieces, 2, positions, 7);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.on_fold = names;
    options.on_fold_count = 2;
    cloth_finish(*state, p, &options);
    assert_int_equal(p->seams[0].notch_count, 1);
    for (size_t k = 0; k < 2; k++) {
        size_t marks = 0;
        assert_true(p->pieces[k].on_fold);
        for (size_t i = 0; i < p->pieces[k].line_count; i++)
            marks += p->pieces[k].lines[i].kind == KTG_LINE_NOTCH;
        assert_int_equal(marks, 1);
    }
    ktg_pattern_free(&p);
}

/* A front with a back below and sleeves at both sides, which are mirror images of each other. */
static ktg_pattern *make_shirt(ktg_context *context) {
    static const cloth_piece pieces[] = {
        {"front", 4, {{0, 0}, {300, 0}, {200, 400}, {100, 400}}, {0, 1, 2, 3}},
        {"right", 4, {{0, 0}, {150, 0}, {150, 400}, {-100, 400}}, {1, 4, 5, 2}},
        {"left", 4, {{0, 0}, {150, 0}, {250, 400}, {0, 400}}, {6, 0, 3, 7}}};
    static const ktg_vec3 positions[] = {{0, 0, 0},   {300, 0, 0},   {200, 400, 0}, {100, 400, 0},
                                         {450, 0, 0}, {450, 400, 0}, {-150, 0, 0},  {-150, 400, 0}};
    return cloth_make(context, pieces, 3, positions, 8);
}

/* Where the notches of a piece are cut, each with its mirror image across the middle of the front.
 */
static void assert_notches_are_mirrored(const ktg_pattern_piece *front, size_t wanted) {
    size_t found = 0;
    for (size_t i = 0; i < front->line_count; i++)
        for (size_t k = 0; k < front->line_count; k++) {
            const ktg_pattern_line *a = &front->lines[i], *b = &front->lines[k];
            found += a->kind == KTG_LINE_NOTCH && b->kind == KTG_LINE_NOTCH &&
                     fabs(a->points[0].x + b->points[0].x - 300) < 1e-6 &&
                     fabs(a->points[0].y - b->points[0].y) < 1e-6;
        }
    assert_int_equal(cloth_count_lines(front, KTG_LINE_NOTCH), wanted);
    assert_int_equal(found, wanted);
}

static void seams_that_mirror_each_other_have_the_same_number_and_marks(void **state) {
    ktg_pattern *p = make_shirt(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.notch_every_mm = 400; /* one each, which is not in the middle */
    assert_int_equal(cloth_finish(*state, p, &options).twins, 1);
    assert_int_equal(p->seam_count, 2);
    assert_int_equal(p->seams[0].number, 1);
    assert_int_equal(p->seams[1].number, 1);
    assert_notches_are_mirrored(&p->pieces[0], 2);
    ktg_pattern_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirror_images_are_cut_together),
        cmocka_unit_test(a_symmetric_piece_is_halved_on_the_fold),
        cmocka_unit_test(what_is_not_symmetric_stays_whole),
        cmocka_unit_test(a_mark_on_the_fold_is_drawn),
        cmocka_unit_test(seams_that_mirror_each_other_have_the_same_number_and_marks),
    };
    return cmocka_run_group_tests_name("pattern/mirrors", tests, make_context, drop_context);
}
