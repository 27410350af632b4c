/* Pieces onto sheets. */
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"
#include "tests/layout/rectangles.h"
#include "tests/short_memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static void one_piece_lies_in_the_middle_with_the_most_room(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = one_rectangle(context, 150, 60, 0);
    ktg_layout_report report;
    assert_int_equal(ktg_layout_place(context, pattern, NULL, &report), KTG_OK);
    assert_int_equal(report.sheets, 1);
    assert_float_equal(report.fill, 150 * 60 / (190.0 * 277.0), 1e-12);
    assert_well_laid(pattern, 2);
    const ktg_pattern_sheet *sheet = pattern->sheets;
    assert_float_equal(sheet->printable[3], 287, 1e-12);
    box a = placed_box(pattern, sheet->placements);
    assert_float_equal(a.x0 + a.x1, 210, 1e-9);
    assert_float_equal(a.y0 + a.y1, 297, 1e-9);
    /* Upright (60 x 150 mm) it could grow by 1.85, across by 1.27; somewhat tilted by more. */
    assert_true(fmin(190 / (a.x1 - a.x0), 277 / (a.y1 - a.y0)) >= 277.0 / 150 - 1e-9);
    ktg_pattern_free(&pattern);
}

static void a_piece_that_just_fits_is_laid(void **state) {
    ktg_context *context = *state;
    for (int way = 0; way < 2; way++) {
        ktg_pattern *pattern = one_rectangle(context, way ? 190 : 277, way ? 277 : 190, 0);
        assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_OK);
        assert_well_laid(pattern, 2);
        ktg_pattern_free(&pattern);
    }
}

static void a_long_piece_lies_across_the_diagonal(void **state) {
    ktg_context *context = *state;
    for (size_t count = 1; count <= 2; count++) {
        ktg_pattern *pattern = make_pattern(context, count);
        for (size_t i = 0; i < count; i++)
            make_rectangle(context, pattern, i, (ktg_vec2){320, 4}, 0, 2.1 * (double)i);
        assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_OK);
        assert_int_equal(pattern->sheet_count, 1);
        assert_well_laid(pattern, 2);
        ktg_pattern_free(&pattern);
    }
}

static void many_pieces_lie_apart_on_few_sheets(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    for (uint64_t seed = 1; seed <= 4; seed++) {
        options.gap_mm = seed < 4 ? 3 : 0;
        ktg_random random;
        ktg_random_seed(&random, seed);
        size_t count = 2 + ktg_random_below(&random, 80);
        ktg_pattern *pattern = make_pattern(context, count);
        double area = 0;
        for (size_t i = 0; i < count; i++) {
            ktg_vec2 size = {5 + 70 * ktg_random_unit(&random), 5 + 70 * ktg_random_unit(&random)};
            area += size.x * size.y;
            make_rectangle(context, pattern, i, size, 1, 6 * ktg_random_unit(&random));
        }
        ktg_layout_report report;
        assert_int_equal(ktg_layout_place(context, pattern, &options, &report), KTG_OK);
        assert_well_laid(pattern, options.gap_mm);
        assert_int_equal(report.sheets, pattern->sheet_count);
        assert_float_equal(report.fill, area / (190.0 * 277.0 * report.sheets), 1e-9);
        assert_true(report.sheets <= 1 + area / (190.0 * 277.0) / 0.7);
        ktg_pattern_free(&pattern);
    }
}

static void what_fits_in_rows_fits(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    /* 18 strips of 185 x 13 mm share a sheet when they lie across it: upright only 12 of them
     * stand side by side. */
    ktg_pattern *pattern = make_pattern(context, 18);
    for (size_t i = 0; i < 18; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){185, 13}, 0, 0.3 * (double)i);
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_well_laid(pattern, 2);
    ktg_pattern_free(&pattern);
    /* Strips of 270 x 13 mm only fit upright. */
    pattern = make_pattern(context, 12);
    for (size_t i = 0; i < 12; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){270, 13}, 0, 0.3 * (double)i);
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_well_laid(pattern, 2);
    ktg_pattern_free(&pattern);
}

/* A frame open on one side: arms of 30 mm around a bay of 100 x 90 mm. */
static void make_bracket(ktg_context *context, ktg_pattern *pattern, size_t index) {
    static const ktg_vec2 corners[] = {{0, 0},    {160, 0}, {160, 120}, {130, 120},
                                       {130, 30}, {30, 30}, {30, 120},  {0, 120}};
    make_rectangle(context, pattern, index, (ktg_vec2){160, 30}, 0, 0);
    ktg_pattern_piece *piece = &pattern->pieces[index];
    ktg_free(piece->outline);
    piece->outline = ktg_copy_array(context, corners, 8, sizeof *corners);
    piece->outline_count = 8;
}

/* By their boxes the two brackets fill a sheet, and the blocks need one more. */
static ktg_pattern *brackets_and_blocks(ktg_context *context) {
    ktg_pattern *pattern = make_pattern(context, 4);
    for (size_t i = 0; i < 4; i++)
        if (i < 2)
            make_bracket(context, pattern, i);
        else
            make_rectangle(context, pattern, i, (ktg_vec2){94, 84}, 0, 0.5);
    return pattern;
}

static void pieces_lie_in_each_others_bays(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    ktg_pattern *pattern = brackets_and_blocks(context);
    ktg_layout_report report;
    assert_int_equal(ktg_layout_place(context, pattern, &options, &report), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_true(report.records > 0);
    assert_well_laid(pattern, 2);
    ktg_pattern_free(&pattern);
}

static ktg_pattern *some_rectangles(ktg_context *context, size_t count) {
    ktg_pattern *pattern = make_pattern(context, count);
    for (size_t i = 0; i < count; i++)
        make_rectangle(context, pattern, i,
                       (ktg_vec2){40 + 7 * (double)(i % 5), 30 + 11 * (double)(i % 3)}, 0,
                       (double)i);
    return pattern;
}

static void the_same_seed_gives_the_same_sheets(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    ktg_pattern *patterns[3];
    for (uint64_t k = 0; k < 3; k++) {
        ktg_context_set_seed(context, k == 2 ? 2 : 1);
        patterns[k] = brackets_and_blocks(context);
        assert_int_equal(ktg_layout_place(context, patterns[k], &options, NULL), KTG_OK);
    }
    const ktg_pattern_sheet *a = patterns[0]->sheets, *b = patterns[1]->sheets;
    const ktg_pattern_sheet *c = patterns[2]->sheets;
    assert_int_equal(a->placement_count, b->placement_count);
    assert_memory_equal(a->placements, b->placements, a->placement_count * sizeof *a->placements);
    assert_true(a->placement_count != c->placement_count ||
                memcmp(a->placements, c->placements, a->placement_count * sizeof *a->placements));
    for (int k = 0; k < 3; k++)
        ktg_pattern_free(&patterns[k]);
}

static void a_roll_is_cut_where_the_pieces_end(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    options.roll = true;
    options.sheet = (ktg_sheet_format){"", 300, 5000, 10};
    for (size_t count = 1; count <= 12; count += 11) {
        ktg_pattern *pattern = some_rectangles(context, count);
        ktg_layout_report report;
        assert_int_equal(ktg_layout_place(context, pattern, &options, &report), KTG_OK);
        assert_well_laid(pattern, 2);
        assert_int_equal(pattern->sheet_count, 1);
        const ktg_pattern_sheet *sheet = pattern->sheets;
        assert_int_equal(sheet->kind, KTG_ROLL);
        assert_true(sheet->width_mm == 300 && sheet->height_mm < 300);
        assert_float_equal(sheet->height_mm, sheet->printable[3] + 10, 1e-9);
        double lowest = INFINITY;
        for (size_t i = 0; i < count; i++)
            lowest = fmin(lowest, placed_box(pattern, &sheet->placements[i]).y0);
        assert_float_equal(lowest, 10, 1e-6);
        assert_float_equal(report.last_mm, sheet->height_mm - 20, 1e-6);
        ktg_pattern_free(&pattern);
    }
}

static ktg_wish wish_of(void *user) {
    int *calls = user;
    return --*calls > 0 ? KTG_GO_ON : KTG_FINISH;
}

static ktg_wish stop_after(void *user) {
    int *calls = user;
    return --*calls > 0 ? KTG_GO_ON : KTG_STOP;
}

static void an_interrupt_keeps_what_there_is(void **state) {
    ktg_context *context = *state;
    for (int calls = 1; calls < 3000; calls *= 7) {
        int left = calls;
        ktg_pattern *pattern = some_rectangles(context, 12);
        ktg_context_set_cancel(context, wish_of, &left);
        assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_OK);
        assert_well_laid(pattern, 2);
        left = calls;
        ktg_context_set_cancel(context, stop_after, &left);
        assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_CANCELLED);
        assert_well_laid(pattern, 2);
        ktg_pattern_free(&pattern);
    }
    ktg_context_set_cancel(context, NULL, NULL);
}

static void with_a_nap_no_piece_lies_head_down(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    ktg_pattern *pattern = make_pattern(context, 6);
    for (size_t i = 0; i < 6; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){90, 30 + 5 * (double)i}, 0, 0.4);
    options.keep_grain = options.nap = true;
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_OK);
    assert_well_laid(pattern, 2);
    for (size_t s = 0; s < pattern->sheet_count; s++)
        for (size_t i = 0; i < pattern->sheets[s].placement_count; i++)
            assert_float_equal(pattern->sheets[s].placements[i].rotation, 0, 1e-12);
    ktg_pattern_free(&pattern);
}

static void the_grain_is_kept(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    options.keep_grain = true;
    for (size_t count = 1; count <= 7; count += 6) {
        ktg_pattern *pattern = make_pattern(context, count);
        for (size_t i = 0; i < count; i++)
            make_rectangle(context, pattern, i, (ktg_vec2){90, 30 + 5 * (double)i}, 0, 0.4);
        assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_OK);
        assert_well_laid(pattern, 2);
        for (size_t s = 0; s < pattern->sheet_count; s++)
            for (size_t i = 0; i < pattern->sheets[s].placement_count; i++)
                assert_float_equal(sin(pattern->sheets[s].placements[i].rotation), 0, 1e-12);
        ktg_pattern_free(&pattern);
    }
    ktg_pattern *pattern = one_rectangle(context, 320, 4, 0); /* fits only across the diagonal */
    pattern->pieces[0].name = ktg_copy_text(context, "sleeve", 6);
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(context), "sleeve"));
    assert_non_null(strstr(ktg_context_message(context), "grain"));
    ktg_pattern_free(&pattern);
}

/* Moves the model somewhere, and pulls one of its corners 60 mm up. */
static void lift(ktg_pattern *pattern) {
    pattern->vertices[0].z = 60;
    for (uint32_t v = 0; v < pattern->vertex_count; v++)
        pattern->vertices[v] = ktg_add3(pattern->vertices[v], (ktg_vec3){7, -3, 1000});
}

static void assert_finished_size(const char *message, ktg_vec3 size) {
    static const char words[] = "a finished size (x, y, z) of ";
    const char *told = strstr(message, words);
    ktg_vec3 is;
    assert_non_null(told);
    assert_int_equal(sscanf(told + strlen(words), "%lf x %lf x %lf mm", &is.x, &is.y, &is.z), 3);
    assert_true(ktg_length3(ktg_sub3(is, size)) < 1e-3 * ktg_length3(size)); /* four digits */
}

static void a_piece_too_large_is_told_what_would_fit(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    for (size_t count = 1; count <= 3; count++) {
        ktg_pattern *pattern = make_pattern(context, count);
        for (size_t i = 0; i < count; i++)
            make_rectangle(context, pattern, i, (ktg_vec2){400 - 30 * (double)i, 250}, 5, 1);
        lift(pattern);
        assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_GEOMETRY);
        assert_null(pattern->sheets);
        const char *message = ktg_context_message(context);
        assert_non_null(strstr(message, "piece 1 "));
        assert_non_null(strstr(message, "12.5 mm per unit"));
        assert_non_null(strstr(message, "190.0 x 277.0 mm"));
        const char *promise = strstr(message, "at most about ");
        assert_non_null(promise);
        double most = strtod(promise + strlen("at most about "), NULL);
        assert_true(most > 5 && most < 12.5);
        assert_finished_size(message, ktg_mul3((ktg_vec3){400, 250, 60}, most / 12.5));
        ktg_pattern_free(&pattern);

        /* The promise holds, and little more would. */
        for (int more = 0; more < 2; more++) {
            double shrink = most / 12.5 * (more ? 1.02 : 1);
            pattern = make_pattern(context, count);
            for (size_t i = 0; i < count; i++)
                make_rectangle(context, pattern, i,
                               (ktg_vec2){shrink * (400 - 30 * (double)i), shrink * 250}, 5, 1);
            assert_int_equal(ktg_layout_place(context, pattern, &options, NULL),
                             more ? KTG_GEOMETRY : KTG_OK);
            ktg_pattern_free(&pattern);
        }
    }
}

static void senseless_wishes_are_refused(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_pattern *pattern = one_rectangle(context, 50, 50, 0);
    ktg_layout_defaults(&options);
    options.gap_mm = -1;
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_ARGUMENT);
    ktg_layout_defaults(&options);
    options.sheet.margin_mm = 105;
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_GEOMETRY);
    options.sheet.margin_mm = NAN;
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_ARGUMENT);
    ktg_layout_defaults(&options);
    options.sheet.width_mm = INFINITY;
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_ARGUMENT);
    pattern->pieces[0].outline_count = 0;
    assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_ARGUMENT);
    ktg_pattern_free(&pattern);
    pattern = make_pattern(context, 0);
    assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_ARGUMENT);
    ktg_pattern_free(&pattern);
}

static void short_memory_is_survived(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options = quick_options();
    ktg_pattern *pattern = make_pattern(context, 5);
    for (size_t i = 0; i < 5; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){150, 100}, 0, (double)i);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status != KTG_OK && nth < 1000; nth++) {
        ktg_context_fail_allocation(context, nth);
        status = ktg_layout_place(context, pattern, &options, NULL);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        assert_true(status == KTG_OK || pattern->sheet_count == 0);
    }
    end_short_memory(context, status);
    assert_int_equal(status, KTG_OK);
    assert_well_laid(pattern, 2);
    assert_int_equal(ktg_layout_place(context, pattern, &options, NULL), KTG_OK);
    assert_well_laid(pattern, 2);
    ktg_pattern_free(&pattern);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(one_piece_lies_in_the_middle_with_the_most_room,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_piece_that_just_fits_is_laid, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_long_piece_lies_across_the_diagonal, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(many_pieces_lie_apart_on_few_sheets, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(what_fits_in_rows_fits, make_context, drop_context),
        cmocka_unit_test_setup_teardown(pieces_lie_in_each_others_bays, make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_same_seed_gives_the_same_sheets, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_roll_is_cut_where_the_pieces_end, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(an_interrupt_keeps_what_there_is, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(with_a_nap_no_piece_lies_head_down, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(the_grain_is_kept, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_piece_too_large_is_told_what_would_fit, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(senseless_wishes_are_refused, make_context, drop_context),
        cmocka_unit_test_setup_teardown(short_memory_is_survived, make_context, drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
