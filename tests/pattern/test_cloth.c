/* What pieces of cloth get: allowances, darts, notches, labels. */
#include "tests/pattern/cloth.h"
#include "tests/short_memory.h"

#include <math.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

/* ---- allowances --------------------------------------------------------------------------- */

static void seams_and_hems_have_allowances_of_their_own(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.hem_mm = 30;
    cloth_finish(*state, p, &options);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(p->pieces[i].outline_count, 4);
        assert_true(fabs(cloth_area(&p->pieces[i]) - (100 + 10 + 30) * (600 + 60)) < 1e-6);
    }
    ktg_pattern_free(&p);
}

/* A trapezium whose sides lean in by 30 degrees, above a hem, sewn to another one at its right. */
static void a_hem_is_as_wide_as_what_it_is_turned_up_on(void **state) {
    const double lean = 200 * tan(KTG_PI / 6);
    const cloth_piece pieces[] = {
        {"left", 4, {{0, 0}, {400, 0}, {400 - lean, 200}, {lean, 200}}, {0, 1, 2, 3}},
        {"right", 4, {{0, 0}, {400, 0}, {400 - lean, 200}, {lean, 200}}, {1, 4, 5, 2}}};
    const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
    ktg_pattern *p = cloth_make(*state, pieces, 2, positions, 6);
    cloth_finish(*state, p, NULL);
    /* the cut of the right side, 10 mm out, crosses the hem's line at x, and 20 mm further down it
     * is as far in as it is 20 mm further up */
    double x = 400 + 10 / cos(KTG_PI / 6), widest = -INFINITY, lowest = INFINITY, at_low = 0;
    for (size_t i = 0; i < p->pieces[0].outline_count; i++) {
        ktg_vec2 q = p->pieces[0].outline[i];
        widest = fmax(widest, q.x);
        if (q.y < lowest - 1e-9 || (q.y < lowest + 1e-9 && q.x > at_low)) {
            lowest = fmin(lowest, q.y);
            at_low = q.x;
        }
    }
    assert_true(fabs(widest - x) < 1e-6);
    assert_true(fabs(lowest + 20) < 1e-6);
    assert_true(fabs(at_low - (x - 20 * tan(KTG_PI / 6))) < 1e-6);
    ktg_pattern_free(&p);
}

/* A horseshoe whose ends nearly meet around a hollow of 100 x 100: the hems of the ends share the
 * gap of 12 mm, and the hollow stays open to the outside. */
static void allowances_share_a_narrow_gap(void **state) {
    const cloth_piece piece = {"shoe",
                               12,
                               {{200, 200},
                                {200, 300},
                                {-100, 300},
                                {-100, -100},
                                {44, -100},
                                {44, 0},
                                {0, 0},
                                {0, 100},
                                {100, 100},
                                {100, 0},
                                {56, 0},
                                {56, -100}},
                               {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
    ktg_vec3 positions[12];
    for (int k = 0; k < 12; k++)
        positions[k] = (ktg_vec3){piece.points[k].x, piece.points[k].y, 0};
    ktg_pattern *p = cloth_make(*state, &piece, 1, positions, 12);
    cloth_finish(*state, p, NULL);
    bool hollow = false, gap = false;
    for (size_t i = 0; i < p->pieces[0].outline_count; i++) {
        ktg_vec2 q = p->pieces[0].outline[i];
        hollow = hollow || (q.x > 10 && q.x < 90 && q.y > 10 && q.y < 90);
        gap = gap || (q.x > 44 && q.x < 50 && q.y > -110 && q.y < 10);
    }
    assert_true(hollow && gap);
    ktg_pattern_free(&p);
}

/* ---- darts -------------------------------------------------------------------------------- */

/* The sides of a small triangle meet before its hem is as wide as it should be: what would come
 * beyond that point is left out. */
static void a_hem_ends_where_its_sides_meet(void **state) {
    const cloth_piece pieces[3] = {
        {"tip", 3, {{0.32, 0}, {1.7, 2.66}, {0, 2.58}}, {0, 1, 2}},
        {"left", 3, {{0.32, 0}, {0, 2.58}, {-9, 0}}, {0, 2, 3}},
        {"right", 3, {{0.32, 0}, {9, 0}, {1.7, 2.66}}, {0, 4, 1}},
    };
    const ktg_vec3 positions[5] = {
        {0.32, 0, 0}, {1.7, 2.66, 0}, {0, 2.58, 0}, {-9, 0, 0}, {9, 0, 0}};
    ktg_pattern *p = cloth_make(*state, pieces, 3, positions, 5);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.allowance_mm = 0.01;
    cloth_finish(*state, p, &options);
    assert_true(cloth_area(&p->pieces[0]) > 2.3);
    ktg_pattern_free(&p);
}

static void a_dart_is_folded_under_a_peak(void **state) {
    ktg_pattern *p = cloth_with_dart(*state);
    ktg_finish_report report = cloth_finish(*state, p, NULL);
    const ktg_pattern_piece *piece = p->pieces;
    assert_int_equal(report.darts, 1);
    assert_true(p->seams[0].dart);
    assert_int_equal(cloth_count_lines(piece, KTG_LINE_DART), 1);
    assert_int_equal(cloth_count_lines(piece, KTG_LINE_NOTCH), 2);
    double lowest = 0;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 q = piece->outline[i];
        assert_true(q.y <= -20 + 1e-6 || fabs(q.x - 100) > 100); /* nothing is cut out of it */
        lowest = fmin(lowest, q.y);
    }
    /* the hem's cut mirrored in a leg that leans by atan(1/8) meets the middle here */
    double leg = atan(1.0 / 8), from = 90 - 20 * tan(leg);
    assert_true(fabs(lowest - (-20 - (100 - from) * tan(2 * leg))) < 1e-6);
    assert_true(fabs(lowest + 20) > 1);
    ktg_pattern_free(&p);
}

static void what_opens_wide_is_no_dart(void **state) {
    ktg_pattern *p = cloth_with_dart(*state);
    p->pieces[0].vertices[1].x = 150; /* the mouth is 60 degrees wide and more */
    p->pieces[0].vertices[6].x = 50;
    assert_int_equal(cloth_finish(*state, p, NULL).darts, 0);
    assert_int_equal(cloth_count_lines(p->pieces, KTG_LINE_DART), 0);
    double highest = -INFINITY; /* of the cut in the middle */
    for (size_t i = 0; i < p->pieces[0].outline_count; i++)
        if (fabs(p->pieces[0].outline[i].x - 100) < 1)
            highest = fmax(highest, fmin(p->pieces[0].outline[i].y, 100));
    assert_true(highest > 40);
    ktg_pattern_free(&p);
}

/* ---- notches ------------------------------------------------------------------------------ */

static void notches_meet(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.twins = false;
    ktg_finish_report report = cloth_finish(*state, p, &options);
    const ktg_pattern_seam *seam = &p->seams[0];
    assert_int_equal(p->seam_count, 1);
    assert_int_equal(seam->notch_count, 2); /* 600 mm, one for each 250 mm */
    assert_int_equal(report.notches, 2);
    for (int side = 0; side < 2; side++) {
        const ktg_pattern_piece *piece = &p->pieces[seam->pieces[side]];
        double x = seam->pieces[side] == 0 ? 100 : 0, out = seam->pieces[side] == 0 ? 10 : -10;
        size_t found = 0;
        for (size_t i = 0; i < piece->line_count; i++) {
            const ktg_pattern_line *line = &piece->lines[i];
            if (line->kind != KTG_LINE_NOTCH)
                continue;
            assert_true(fabs(line->points[0].x - (x + out)) < 1e-6);
            assert_true(fabs(line->points[1].x - (x + out / 2)) < 1e-6);
            for (size_t k = 0; k < 2; k++)
                found += fabs(line->points[0].y - 600 * seam->notches[k].at) < 1e-6;
        }
        assert_int_equal(found, 2);
    }
    ktg_pattern_free(&p);
}

static void without_an_allowance_notches_are_drawn_inwards(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.allowance_mm = 0;
    cloth_finish(*state, p, &options);
    for (size_t i = 0; i < p->pieces[0].line_count; i++) {
        const ktg_pattern_line *line = &p->pieces[0].lines[i];
        if (line->kind == KTG_LINE_NOTCH)
            assert_true(fabs(line->points[0].x - 100) < 1e-6 &&
                        fabs(line->points[1].x - 95) < 1e-6);
    }
    assert_true(cloth_count_lines(&p->pieces[0], KTG_LINE_NOTCH) > 0);
    options.notch_mm = 0;
    assert_int_equal(cloth_finish(*state, p, &options).notches, 0);
    assert_int_equal(cloth_count_lines(&p->pieces[0], KTG_LINE_NOTCH), 0);
    ktg_pattern_free(&p);
}

/* However many are asked for, they can be told from each other and lie at their own seam. */
static void notches_do_not_run_into_each_other(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.notch_every_mm = 1;
    cloth_finish(*state, p, &options);
    const ktg_pattern_seam *seam = &p->seams[0];
    assert_true(seam->notch_count > 10);
    double end = 0;
    for (size_t k = 0; k < seam->notch_count; k++) {
        double at = 600 * seam->notches[k].at, wide = 3.0 * (seam->notches[k].marks - 1.0);
        assert_true(at - wide > end + 5);
        end = at + wide;
    }
    assert_true(end < 600);
    ktg_pattern_free(&p);
}

/* ---- labels, memory ----------------------------------------------------------------------- */

static void labels_lie_within_the_seams(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    cloth_finish(*state, p, NULL);
    assert_true(cloth_has_label(&p->pieces[0], "1") && cloth_has_label(&p->pieces[0], "left"));
    assert_true(cloth_has_label(&p->pieces[0], "with 10 mm, hem 20 mm"));
    for (size_t i = 0; i < p->pieces[0].label_count; i++) {
        ktg_vec2 at = p->pieces[0].labels[i].at;
        assert_true(at.x > 0 && at.x < 100 && at.y > 0 && at.y < 600);
    }
    ktg_pattern_free(&p);
}

/* Too small for any writing, and the middle of what is cut lies far from what is sewn. */
static void a_tiny_piece_has_its_name_within_the_seams(void **state) {
    const cloth_piece tiny[2] = {
        {"left", 4, {{0, 0}, {2, 0}, {2, 3}, {0, 3}}, {0, 1, 2, 3}},
        {"right", 4, {{0, 0}, {2, 0}, {2, 3}, {0, 3}}, {1, 4, 5, 2}},
    };
    const ktg_vec3 positions[6] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0},
                                   {0, 3, 0}, {4, 0, 0}, {4, 3, 0}};
    ktg_pattern *p = cloth_make(*state, tiny, 2, positions, 6);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.allowance_mm = 200;
    options.hem_mm = 0;
    options.twins = false;
    cloth_finish(*state, p, &options);
    for (size_t k = 0; k < 2; k++) {
        assert_true(cloth_has_label(&p->pieces[k], tiny[k].name));
        for (size_t i = 0; i < p->pieces[k].label_count; i++) {
            ktg_vec2 at = p->pieces[k].labels[i].at;
            assert_true(at.x > -5 && at.x < 7 && at.y > -5 && at.y < 8);
        }
    }
    ktg_pattern_free(&p);
}

/* With an error, never with another pattern. */
static void every_failing_allocation_is_survived(void **state) {
    static const char *const names[] = {"left", "skirt"};
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.on_fold = names;
    options.on_fold_count = 2;
    for (int k = 0; k < 2; k++) {
        ktg_pattern *p = k == 0 ? cloth_oblongs(*state) : cloth_with_dart(*state);
        ktg_finish_report report;
        ktg_status status = KTG_MEMORY;
        for (uint64_t nth = 1; status == KTG_MEMORY; nth++) {
            ktg_context_fail_allocation(*state, nth);
            status = ktg_pattern_finish(*state, p, &options, &report);
            assert_true(nth < 5000);
        }
        end_short_memory(*state, status);
        assert_int_equal(status, KTG_OK);
        assert_int_equal(report.twins, k == 0);
        assert_int_equal(report.on_fold, k == 1);
        ktg_pattern_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seams_and_hems_have_allowances_of_their_own),
        cmocka_unit_test(a_hem_is_as_wide_as_what_it_is_turned_up_on),
        cmocka_unit_test(allowances_share_a_narrow_gap),
        cmocka_unit_test(a_hem_ends_where_its_sides_meet),
        cmocka_unit_test(a_dart_is_folded_under_a_peak),
        cmocka_unit_test(what_opens_wide_is_no_dart),
        cmocka_unit_test(notches_meet),
        cmocka_unit_test(notches_do_not_run_into_each_other),
        cmocka_unit_test(without_an_allowance_notches_are_drawn_inwards),
        cmocka_unit_test(labels_lie_within_the_seams),
        cmocka_unit_test(a_tiny_piece_has_its_name_within_the_seams),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests_name("pattern/cloth", tests, make_context, drop_context);
}
