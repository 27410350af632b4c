/* Pieces onto sheets. */
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"
#include "layout/layout.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SLACK_MM 1.0001e-7

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

/* Gives `piece` the rectangle of `size`, turned by `angle` about a corner that is not the origin:
 * two faces, and an outline that reaches `rim` beyond them. */
static void make_rectangle(ktg_context *context, ktg_pattern *pattern, size_t index, ktg_vec2 size,
                           double rim, double angle) {
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3};
    ktg_pattern_piece *piece = &pattern->pieces[index];
    ktg_motion2 turn = {cos(angle), sin(angle), {13, -7}};
    piece->vertex_count = piece->outline_count = 4;
    piece->vertices = ktg_new(context, 4, ktg_vec2);
    piece->outline = ktg_new(context, 4, ktg_vec2);
    piece->face_count = 2;
    piece->faces = ktg_new(context, 2, uint32_t);
    piece->corners = ktg_copy_array(context, corners, 6, sizeof *corners);
    piece->cut_count = 1;
    for (int k = 0; k < 4; k++) {
        double x = k == 1 || k == 2, y = k >= 2;
        piece->vertices[k] = ktg_move2(turn, (ktg_vec2){x * size.x, y * size.y});
        piece->outline[k] = ktg_move2(
            turn, (ktg_vec2){x * size.x + (2 * x - 1) * rim, y * size.y + (2 * y - 1) * rim});
        pattern->vertices[4 * index + (size_t)k] = (ktg_vec3){x * size.x, y * size.y, 0};
    }
    for (uint32_t f = 0; f < 2; f++) {
        piece->faces[f] = 2 * (uint32_t)index + f;
        for (int k = 0; k < 3; k++)
            pattern->faces[6 * index + 3 * f + (size_t)k] =
                4 * (uint32_t)index + corners[3 * f + (size_t)k];
    }
}

/* A pattern with room for `count` rectangles. */
static ktg_pattern *make_pattern(ktg_context *context, size_t count) {
    ktg_pattern *pattern = ktg_new(context, 1, ktg_pattern);
    pattern->mm_per_unit = 12.5;
    pattern->vertex_count = 4 * (uint32_t)count;
    pattern->vertices = ktg_new(context, 4 * count, ktg_vec3);
    pattern->face_count = 2 * (uint32_t)count;
    pattern->faces = ktg_new(context, 6 * count, uint32_t);
    pattern->piece_count = count;
    pattern->pieces = ktg_new(context, count, ktg_pattern_piece);
    return pattern;
}

static ktg_pattern *one_rectangle(ktg_context *context, double width, double height, double rim) {
    ktg_pattern *pattern = make_pattern(context, 1);
    make_rectangle(context, pattern, 0, (ktg_vec2){width, height}, rim, 0.7);
    return pattern;
}

typedef struct box {
    double x0, y0, x1, y1;
} box;

static box placed_box(const ktg_pattern *pattern, const ktg_pattern_placement *placement) {
    const ktg_pattern_piece *piece = &pattern->pieces[placement->piece];
    ktg_motion2 motion = {
        cos(placement->rotation), sin(placement->rotation), {placement->x, placement->y}};
    box around = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 p = ktg_move2(motion, piece->outline[i]);
        around = (box){fmin(around.x0, p.x), fmin(around.y0, p.y), fmax(around.x1, p.x),
                       fmax(around.y1, p.y)};
    }
    return around;
}

static void assert_apart(box a, box b, double gap) {
    double apart = fmax(fmax(b.x0 - a.x1, a.x0 - b.x1), fmax(b.y0 - a.y1, a.y0 - b.y1));
    assert_true(apart >= gap - 1e-9);
}

/* Each piece on one sheet, inside its printable area, boxes `gap` apart. */
static void assert_well_laid(const ktg_pattern *pattern, double gap) {
    size_t *seen = calloc(pattern->piece_count, sizeof *seen);
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &pattern->sheets[s];
        assert_true(sheet->placement_count > 0);
        for (size_t i = 0; i < sheet->placement_count; i++) {
            box a = placed_box(pattern, &sheet->placements[i]);
            seen[sheet->placements[i].piece]++;
            assert_true(a.x0 >= sheet->printable[0] - SLACK_MM);
            assert_true(a.y0 >= sheet->printable[1] - SLACK_MM);
            assert_true(a.x1 <= sheet->printable[2] + SLACK_MM);
            assert_true(a.y1 <= sheet->printable[3] + SLACK_MM);
            for (size_t k = 0; k < i; k++)
                assert_apart(a, placed_box(pattern, &sheet->placements[k]), gap);
        }
    }
    for (size_t p = 0; p < pattern->piece_count; p++)
        assert_int_equal(seen[p], 1);
    free(seen);
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
        assert_int_equal(pattern->sheet_count, count);
        assert_well_laid(pattern, 2);
        ktg_pattern_free(&pattern);
    }
}

static void many_pieces_lie_apart_on_few_sheets(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    options.gap_mm = 3;
    for (uint64_t seed = 1; seed <= 20; seed++) {
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
        assert_well_laid(pattern, 3);
        assert_int_equal(report.sheets, pattern->sheet_count);
        assert_float_equal(report.fill, area / (190.0 * 277.0 * report.sheets), 1e-9);
        assert_true(report.sheets <= 1 + area / (190.0 * 277.0) / 0.5);
        ktg_pattern_free(&pattern);
    }
}

static void rows_take_the_direction_that_needs_fewer_sheets(void **state) {
    ktg_context *context = *state;
    /* 18 strips of 185 x 13 mm share a sheet when they lie across it: upright only 12 of them
     * stand side by side. */
    ktg_pattern *pattern = make_pattern(context, 18);
    for (size_t i = 0; i < 18; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){185, 13}, 0, 0.3 * (double)i);
    assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_well_laid(pattern, 2);
    ktg_pattern_free(&pattern);
    /* Strips of 270 x 13 mm only fit upright. */
    pattern = make_pattern(context, 12);
    for (size_t i = 0; i < 12; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){270, 13}, 0, 0.3 * (double)i);
    assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_well_laid(pattern, 2);
    ktg_pattern_free(&pattern);
}

static void the_grain_is_kept(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_defaults(&options);
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

static void a_piece_too_large_is_told_what_would_fit(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    for (size_t count = 1; count <= 3; count++) {
        ktg_pattern *pattern = make_pattern(context, count);
        for (size_t i = 0; i < count; i++)
            make_rectangle(context, pattern, i, (ktg_vec2){400 - 30 * (double)i, 250}, 5, 1);
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
    ktg_pattern *pattern = make_pattern(context, 5);
    for (size_t i = 0; i < 5; i++)
        make_rectangle(context, pattern, i, (ktg_vec2){150, 100}, 0, (double)i);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status != KTG_OK && nth < 1000; nth++) {
        ktg_context_fail_allocation(context, nth);
        status = ktg_layout_place(context, pattern, NULL, NULL);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        assert_true(status == KTG_OK || pattern->sheet_count == 0);
    }
    ktg_context_fail_allocation(context, 0);
    assert_int_equal(status, KTG_OK);
    assert_well_laid(pattern, 2);
    assert_int_equal(ktg_layout_place(context, pattern, NULL, NULL), KTG_OK);
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
        cmocka_unit_test_setup_teardown(rows_take_the_direction_that_needs_fewer_sheets,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_grain_is_kept, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_piece_too_large_is_told_what_would_fit, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(senseless_wishes_are_refused, make_context, drop_context),
        cmocka_unit_test_setup_teardown(short_memory_is_survived, make_context, drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
