/* What is larger than a sheet: posters, and one page for all. */
#include "core/memory.h"
#include "core/vec.h"
#include "layout/layout.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

/* One piece for each outline; nothing else is looked at. */
static ktg_pattern *make_pattern(ktg_context *context, size_t count) {
    ktg_pattern *pattern = ktg_new(context, 1, ktg_pattern);
    pattern->mm_per_unit = 1;
    pattern->piece_count = count;
    pattern->pieces = ktg_new(context, count, ktg_pattern_piece);
    return pattern;
}

static void set_outline(ktg_context *context, ktg_pattern_piece *piece, const ktg_vec2 *points,
                        size_t count) {
    piece->outline = ktg_copy_array(context, points, count, sizeof *points);
    piece->vertices = ktg_copy_array(context, points, count, sizeof *points);
    piece->outline_count = piece->vertex_count = count;
}

static void set_rectangle(ktg_context *context, ktg_pattern_piece *piece, double width,
                          double height) {
    ktg_vec2 points[] = {{5, -3}, {5 + width, -3}, {5 + width, height - 3}, {5, height - 3}};
    set_outline(context, piece, points, 4);
}

/* Two thin arms from a corner: an L. */
static void set_arms(ktg_context *context, ktg_pattern_piece *piece, double length, double wide) {
    ktg_vec2 points[] = {{0, 0},       {length, 0},    {length, wide},
                         {wide, wide}, {wide, length}, {0, length}};
    set_outline(context, piece, points, 6);
}

static const ktg_pattern_sheet *tile_at(const ktg_pattern *pattern, uint32_t poster, uint32_t row,
                                        uint32_t column) {
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &pattern->sheets[s];
        if (sheet->poster == poster && sheet->row == row && sheet->column == column)
            return sheet;
    }
    return NULL;
}

static void a_large_piece_becomes_tiles_that_overlap(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_report report;
    ktg_layout_defaults(&options);
    options.keep_grain = true;
    ktg_pattern *pattern = make_pattern(context, 1);
    set_rectangle(context, pattern->pieces, 500, 500);
    assert_int_equal(ktg_layout_tile(context, pattern, &options, 10, &report), KTG_OK);
    assert_int_equal(report.sheets, 6); /* 190 + 180 + 180 across, 277 + 267 up */
    assert_int_equal(pattern->sheet_count, 6);
    for (uint32_t r = 0; r < 2; r++)
        for (uint32_t c = 0; c < 3; c++) {
            const ktg_pattern_sheet *tile = tile_at(pattern, 1, r, c);
            assert_non_null(tile);
            assert_ptr_equal(tile, &pattern->sheets[3 * r + c]); /* as one reads */
            assert_int_equal(tile->kind, KTG_TILE);
            assert_int_equal(tile->placement_count, 1);
            const ktg_pattern_placement *at = tile->placements,
                                        *first = pattern->sheets->placements;
            assert_float_equal(at->rotation, 0, 0);
            assert_float_equal(at->x, first->x - 180 * c, 1e-9);
            assert_float_equal(at->y, first->y + 267 * r, 1e-9);
        }
    /* In the middle: as much free at the left of the first as at the right of the last column. */
    double left = pattern->sheets[0].placements->x + 5 - 10;
    double right = 200 - (pattern->sheets[2].placements->x + 505);
    assert_float_equal(left, right, 1e-9);
    assert_float_equal(left, (190 + 2 * 180 - 500) / 2.0, 1e-9);
    ktg_pattern_free(&pattern);
}

static void empty_tiles_are_left_out(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    options.keep_grain = true;
    ktg_pattern *pattern = make_pattern(context, 1);
    set_arms(context, pattern->pieces, 700, 40); /* 4 columns, 3 rows */
    assert_int_equal(ktg_layout_tile(context, pattern, &options, 10, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 4 + 3 - 1);
    for (uint32_t c = 0; c < 4; c++)
        assert_non_null(tile_at(pattern, 1, 2, c));
    for (uint32_t r = 0; r < 3; r++)
        assert_non_null(tile_at(pattern, 1, r, 0));
    assert_null(tile_at(pattern, 1, 0, 1));
    ktg_pattern_free(&pattern);
}

static void the_turn_with_fewer_sheets_is_taken(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_pattern(context, 1);
    set_rectangle(context, pattern->pieces, 540, 180); /* across 3 sheets, upright 2 */
    assert_int_equal(ktg_layout_tile(context, pattern, NULL, 10, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 2);
    ktg_pattern_free(&pattern);
}

static void what_fits_is_laid_as_usual_and_posters_follow(void **state) {
    ktg_context *context = *state;
    ktg_layout_report report;
    ktg_pattern *pattern = make_pattern(context, 4);
    set_rectangle(context, &pattern->pieces[0], 300, 300);
    set_rectangle(context, &pattern->pieces[1], 100, 100);
    set_rectangle(context, &pattern->pieces[2], 400, 100);
    set_rectangle(context, &pattern->pieces[3], 50, 60);
    assert_int_equal(ktg_layout_tile(context, pattern, NULL, 10, &report), KTG_OK);
    assert_int_equal(pattern->sheets[0].kind, KTG_SHEET);
    assert_int_equal(pattern->sheets[0].placement_count, 2);
    assert_int_equal(
        pattern->sheets[0].placements[0].piece + pattern->sheets[0].placements[1].piece, 1 + 3);
    for (size_t s = 1; s < pattern->sheet_count; s++) {
        assert_int_equal(pattern->sheets[s].kind, KTG_TILE);
        assert_int_equal(pattern->sheets[s].placements->piece,
                         pattern->sheets[s].poster == 1 ? 0 : 2);
    }
    assert_int_equal(pattern->sheet_count, 1 + 4 + 2);
    assert_int_equal(report.sheets, 7);
    ktg_pattern_free(&pattern);
}

static void nothing_large_is_no_poster(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_pattern(context, 1);
    set_rectangle(context, pattern->pieces, 190, 277);
    assert_int_equal(ktg_layout_tile(context, pattern, NULL, 10, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_int_equal(pattern->sheets->kind, KTG_SHEET);
    ktg_pattern_free(&pattern);
}

static void what_makes_no_poster_is_refused(void **state) {
    ktg_context *context = *state;
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    ktg_pattern *pattern = make_pattern(context, 1);
    set_rectangle(context, pattern->pieces, 500, 500);
    assert_int_equal(ktg_layout_tile(context, pattern, NULL, 96, NULL), KTG_ARGUMENT);
    assert_non_null(strstr(ktg_context_message(context), "0 to 95 mm"));
    assert_int_equal(ktg_layout_tile(context, pattern, NULL, -1, NULL), KTG_ARGUMENT);
    options.sheet.margin_mm = 110;
    assert_int_equal(ktg_layout_tile(context, pattern, &options, 10, NULL), KTG_GEOMETRY);
    assert_int_equal(pattern->sheet_count, 0);
    ktg_pattern_free(&pattern);
    const double sides_mm[][2] = {{1e5, 1e5}, {1e38, 1}, {1, 1e30}, {4294967296 * 190.0, 1}};
    for (size_t k = 0; k < sizeof sides_mm / sizeof *sides_mm; k++) {
        pattern = make_pattern(context, 1);
        set_rectangle(context, pattern->pieces, sides_mm[k][0], sides_mm[k][1]);
        assert_int_equal(ktg_layout_tile(context, pattern, NULL, 10, NULL), KTG_LIMIT);
        ktg_pattern_free(&pattern);
    }
}

static ktg_status lay_page(ktg_context *context, ktg_pattern *pattern, ktg_layout_report *report) {
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    options.sheet.width_mm = options.sheet.height_mm = INFINITY;
    return ktg_layout_page(context, pattern, &options, report);
}

static void one_page_is_cut_to_what_lies_on_it(void **state) {
    ktg_context *context = *state;
    ktg_layout_report report;
    ktg_pattern *pattern = make_pattern(context, 1);
    set_rectangle(context, pattern->pieces, 300, 500);
    assert_int_equal(lay_page(context, pattern, &report), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    double width = pattern->sheets->width_mm, height = pattern->sheets->height_mm;
    assert_float_equal(fmin(width, height), 320, 1e-6);
    assert_float_equal(fmax(width, height), 520, 1e-6);
    ktg_pattern_free(&pattern);
    pattern = make_pattern(context, 1); /* small, but with room for rulers */
    set_rectangle(context, pattern->pieces, 30, 20);
    assert_int_equal(lay_page(context, pattern, NULL), KTG_OK);
    assert_float_equal(pattern->sheets->width_mm, 130, 1e-6);
    ktg_pattern_free(&pattern);
}

static void one_page_has_its_limits(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_pattern(context, 4);
    for (int k = 0; k < 4; k++)
        set_rectangle(context, &pattern->pieces[k], 300, 290);
    assert_int_equal(lay_page(context, pattern, NULL), KTG_OK);
    assert_int_equal(pattern->sheet_count, 1);
    assert_true(pattern->sheets->width_mm * pattern->sheets->height_mm < 700 * 700);
    ktg_pattern_free(&pattern);
    pattern = make_pattern(context, 4);
    for (int k = 0; k < 4; k++)
        set_rectangle(context, &pattern->pieces[k], 4900, 4900);
    assert_int_equal(lay_page(context, pattern, NULL), KTG_LIMIT);
    ktg_pattern_free(&pattern);
    pattern = make_pattern(context, 1);
    set_rectangle(context, pattern->pieces, 9000, 9000);
    assert_int_equal(lay_page(context, pattern, NULL), KTG_GEOMETRY);
    ktg_pattern_free(&pattern);
}

static void short_memory_is_survived(void **state) {
    ktg_context *context = *state;
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status != KTG_OK && nth < 300; nth++) {
        ktg_pattern *pattern = make_pattern(context, 2);
        set_rectangle(context, &pattern->pieces[0], 300, 300);
        set_rectangle(context, &pattern->pieces[1], 100, 100);
        ktg_context_fail_allocation(context, nth);
        status = ktg_layout_tile(context, pattern, NULL, 10, NULL);
        end_short_memory(context, status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        assert_int_equal(pattern->sheet_count, status == KTG_OK ? 5 : 0);
        ktg_pattern_free(&pattern);
    }
    assert_int_equal(status, KTG_OK);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(a_large_piece_becomes_tiles_that_overlap),
        CASE(empty_tiles_are_left_out),
        CASE(the_turn_with_fewer_sheets_is_taken),
        CASE(what_fits_is_laid_as_usual_and_posters_follow),
        CASE(nothing_large_is_no_poster),
        CASE(what_makes_no_poster_is_refused),
        CASE(one_page_is_cut_to_what_lies_on_it),
        CASE(one_page_has_its_limits),
        CASE(short_memory_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
