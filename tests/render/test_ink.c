/* Where the ink is: looked at as pixels. */
#include <math.h>

#include "tests/render/ink.h"
#include "tests/render/strip.h"

static void a_png_has_the_pixels_asked_for(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    snapshot picture = take(context, pattern, &options);
    assert_int_equal(picture.width, 1240);
    assert_int_equal(picture.height, 1754);
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void the_outline_is_drawn_where_the_piece_lies(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 0, 0);
    static const double turns[] = {0, KTG_PI / 2, 0.3};
    for (size_t i = 0; i < 3; i++) {
        ktg_pattern_placement *placement = &pattern->sheets[0].placements[0];
        *placement = (ktg_pattern_placement){0, 70, 120, turns[i]};
        ktg_motion2 motion = {cos(turns[i]), sin(turns[i]), {70, 120}};
        snapshot picture = take(context, pattern, &options);
        const ktg_pattern_piece *piece = &pattern->pieces[0];
        for (size_t k = 0; k < piece->outline_count; k++) {
            ktg_vec2 a = piece->outline[k], b = piece->outline[(k + 1) % piece->outline_count];
            for (double t = 0.03; t < 1; t += 0.09) {
                ktg_vec2 p = ktg_move2(motion, ktg_madd2(a, t, ktg_sub2(b, a)));
                assert_true(grey(darkest(&picture, p.x, p.y)) < 60);
            }
        }
        /* Faces are white, the tab is tinted, beyond it there is nothing. */
        ktg_vec2 face = ktg_move2(motion, (ktg_vec2){20, 28}),
                 tab = ktg_move2(motion, (ktg_vec2){123, 30}),
                 beyond = ktg_move2(motion, (ktg_vec2){127, 20});
        assert_int_equal(grey(darkest(&picture, face.x, face.y)), 255);
        assert_in_range(grey(darkest(&picture, tab.x, tab.y)), 225, 245);
        assert_int_equal(grey(darkest(&picture, beyond.x, beyond.y)), 255);
        cairo_surface_destroy(picture.surface);
    }
    ktg_pattern_free(&pattern);
}

/* The lengths of the runs of ink along the line x of the strip that lies at (40, 200); negative
 * lengths are gaps. Returns their number. */
static size_t runs_along_fold(const snapshot *picture, double x, double *runs, size_t most) {
    size_t count = 0;
    bool ink = false;
    for (double y = 0.35; y < SIDE_MM - 0.3; y += 0.05) {
        bool now = grey(darkest(picture, 40 + x, 200 + y)) < 200;
        if (count == 0 || now != ink) {
            assert_true(count < most);
            runs[count++] = 0;
        }
        ink = now;
        runs[count - 1] += ink ? 0.05 : -0.05;
    }
    return count;
}

static void folds_are_dashed_from_end_to_end(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    double runs[100];
    default_options(&options);
    snapshot picture = take(context, pattern, &options);
    size_t mountain = runs_along_fold(&picture, 40, runs, 100);
    assert_true(mountain >= 9 && mountain % 2 == 1); /* a dash at each end */
    assert_true(runs[0] > 1 && runs[mountain - 1] > 1);
    assert_float_equal(runs[2], runs[4], 0.21);
    size_t valley = runs_along_fold(&picture, 80, runs, 100);
    assert_true(valley >= 9 && valley % 4 == 1); /* dash, dot, dash, ... dash */
    assert_true(runs[0] > 2 && runs[2] < 1 && runs[2] > 0 && runs[4] > 2);
    cairo_surface_destroy(picture.surface);

    options.folds = KTG_FOLDS_SOLID;
    picture = take(context, pattern, &options);
    assert_int_equal(runs_along_fold(&picture, 40, runs, 100), 1);
    assert_true(runs_along_fold(&picture, 80, runs, 100) >= 9);
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void a_short_fold_has_two_dashes(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    options.dots_per_inch = 1270;
    ktg_pattern *pattern = make_strips(context, 1, 60, 40, 10, 10, 10);
    ktg_pattern_piece *piece = &pattern->pieces[0];
    /* The whole strip ten times smaller: folds of 4 mm. */
    for (int i = 0; i < 8; i++)
        piece->vertices[i] = ktg_mul2(piece->vertices[i], 0.1);
    for (int i = 0; i < 7; i++)
        piece->outline[i] = ktg_mul2(piece->outline[i], 0.1);
    piece->tab_count = piece->label_count = 0;
    snapshot picture = take(context, pattern, &options);
    int changes = 0;
    bool ink = true;
    for (double y = 0.3; y < 3.7; y += 0.01) {
        bool now = grey(darkest(&picture, 14, 10 + y)) < 200;
        changes += now != ink;
        ink = now;
    }
    assert_true(changes >= 2 && ink); /* dash, gap, dash */
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void folds_have_the_colours_of_the_options(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    snapshot picture = take(context, pattern, &options);
    colour mountain = darkest(&picture, 80, 201), valley = darkest(&picture, 120, 201),
           foot = darkest(&picture, 160, 201);
    assert_true(mountain.r > mountain.g + 60 && mountain.r > mountain.b + 60);
    assert_true(valley.b > valley.g + 30 && valley.b > valley.r + 60);
    assert_true(foot.r > foot.g + 60); /* the seam's angle is that of a mountain */
    cairo_surface_destroy(picture.surface);

    options.colour = false;
    pattern->edges[2].angle = 0.001; /* flatter than a degree: the tab's foot is no fold */
    pattern->edges[1].angle = -0.01;
    picture = take(context, pattern, &options);
    mountain = darkest(&picture, 80, 201);
    assert_true(mountain.r == mountain.g && mountain.g == mountain.b && mountain.r < 160);
    assert_int_equal(grey(darkest(&picture, 120, 201)), 255);
    assert_true(grey(darkest(&picture, 160, 220)) > 220);
    cairo_surface_destroy(picture.surface);

    options.flat_below = 0; /* now all are drawn */
    picture = take(context, pattern, &options);
    assert_true(grey(darkest(&picture, 120, 201)) < 160);
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void names_are_never_upside_down(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 60, 200);
    ktg_pattern_piece *piece = &pattern->pieces[0];
    piece->label_count = 1;
    piece->labels[0] = (ktg_pattern_label){"L", {20, 15}, 0, 10, KTG_NONE};
    for (int turned = 0; turned < 3; turned++) {
        piece->labels[0].rotation = turned == 1 ? KTG_PI : 0;
        if (turned == 2) /* with its piece, about the label's place */
            pattern->sheets[0].placements[0] = (ktg_pattern_placement){0, 100, 230, KTG_PI};
        for (int number = 0; number < 2; number++) {
            piece->labels[0].edge = number ? 2 : KTG_NONE;
            snapshot picture = take(context, pattern, &options);
            int above = 0, below = 0; /* an L has its ink below */
            for (double x = 76; x < 84; x += 0.2)
                for (double y = 0.2; y < 6; y += 0.2) {
                    above += grey(darkest(&picture, x, 215 + y)) < 100;
                    below += grey(darkest(&picture, x, 215 - y)) < 100;
                }
            assert_true(above > 10 && below > 10);
            assert_true((below > above) == !(turned && number));
            cairo_surface_destroy(picture.surface);
        }
    }
    ktg_pattern_free(&pattern);
}

static void cloth_has_seam_and_grain_lines_and_no_folds(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    ktg_pattern_piece *piece = &pattern->pieces[0];
    pattern->mode = KTG_CLOTH;
    piece->tab_count = 0;
    piece->label_count = 0;
    piece->line_count = 2;
    piece->lines = ktg_new(context, 2, ktg_pattern_line);
    for (int k = 0; k < 2; k++) {
        piece->lines[k].kind = k ? KTG_LINE_GRAIN : KTG_LINE_SEW;
        piece->lines[k].point_count = 2;
        piece->lines[k].points = ktg_new(context, 2, ktg_vec2);
        piece->lines[k].points[0] = (ktg_vec2){20 + 40 * k, 5};
        piece->lines[k].points[1] = (ktg_vec2){20 + 40 * k, 35};
    }
    snapshot picture = take(context, pattern, &options);
    double runs[100];
    assert_false(picture_has_ink(&picture, 79, 201, 81, 239)); /* the mountain fold of paper */
    assert_true(runs_along_fold(&picture, 20, runs, 100) >= 7);
    assert_int_equal(runs_along_fold(&picture, 60, runs, 100), 3); /* none, grain, none */
    assert_true(picture_has_ink(&picture, 100.5, 207, 102, 208));  /* half an arrow head */
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

/* Two strips, the second one on the sheet: its seam (the ends at x = 40 and x = 160) has no tab. */
static ktg_pattern *strip_without_tab(ktg_context *context) {
    ktg_pattern *pattern = make_strips(context, 2, 210, 297, 10, 40, 200);
    pattern->sheets[0].placements[0].piece = 1;
    pattern->pieces[1].tab_count = 0;
    pattern->pieces[1].label_count = 0;
    pattern->edges[5].tab_on = -1;
    return pattern;
}

/* Whether there is ink just inside the strip's ends, a millimetre around height y (mm). */
static bool has_mark(const snapshot *picture, bool right, double y) {
    double x = right ? 158.9 : 40.3;
    return picture_has_ink(picture, x, 200 + y - 1, x + 0.8, 200 + y + 1);
}

static void edges_without_a_tab_bear_half_a_diamond_on_both_copies(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = strip_without_tab(context);
    snapshot picture = take(context, pattern, &options);
    for (int right = 0; right < 2; right++) {
        assert_true(has_mark(&picture, right, 20));
        assert_false(has_mark(&picture, right, 24));
        assert_false(has_mark(&picture, right, 16));
        double inner = right ? 159.6 : 40.4; /* it is hollow */
        assert_int_equal(grey(darkest(&picture, inner, 220)), 255);
    }
    assert_false(picture_has_ink(&picture, 160.3, 215, 164.5, 225)); /* inside only */
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void marks_of_edges_keep_clear_of_numbers(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = strip_without_tab(context);
    ktg_pattern_piece *piece = &pattern->pieces[1];
    piece->label_count = 1; /* across the middle of the left end: both copies move on */
    piece->labels[0] = (ktg_pattern_label){"28", {2, 20}, KTG_PI / 2, 2.4, 5};
    snapshot picture = take(context, pattern, &options);
    for (int right = 0; right < 2; right++)
        assert_true(has_mark(&picture, right, 16) || has_mark(&picture, right, 24));
    assert_int_equal(has_mark(&picture, false, 16), has_mark(&picture, true, 16));
    assert_false(has_mark(&picture, true, 20));
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void no_marks_on_short_edges_nor_without_tabs_at_all(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = strip_without_tab(context);
    pattern->pieces[0].tab_count = 0; /* as --tabs none makes it */
    pattern->edges[2].tab_on = -1;
    snapshot picture = take(context, pattern, &options);
    assert_false(has_mark(&picture, false, 20) || has_mark(&picture, true, 20));
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);

    pattern = strip_without_tab(context);
    ktg_pattern_piece *piece = &pattern->pieces[1];
    for (int i = 0; i < 8; i++)
        piece->vertices[i] = ktg_mul2(piece->vertices[i], 3.9 / SIDE_MM);
    picture = take(context, pattern, &options);
    assert_false(picture_has_ink(&picture, 40.3, 200.3, 43, 203)); /* left of the first fold */
    cairo_surface_destroy(picture.surface);
    for (int i = 0; i < 8; i++)
        piece->vertices[i] = ktg_mul2(piece->vertices[i], 4.1 / 3.9);
    picture = take(context, pattern, &options);
    assert_true(picture_has_ink(&picture, 40.3, 200.3, 43, 203));
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_png_has_the_pixels_asked_for, make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_outline_is_drawn_where_the_piece_lies, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(folds_are_dashed_from_end_to_end, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_short_fold_has_two_dashes, make_context, drop_context),
        cmocka_unit_test_setup_teardown(folds_have_the_colours_of_the_options, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(names_are_never_upside_down, make_context, drop_context),
        cmocka_unit_test_setup_teardown(cloth_has_seam_and_grain_lines_and_no_folds, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(edges_without_a_tab_bear_half_a_diamond_on_both_copies,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(marks_of_edges_keep_clear_of_numbers, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(no_marks_on_short_edges_nor_without_tabs_at_all,
                                        make_context, drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
