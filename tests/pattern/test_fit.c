/* Sheets, rows, boxes, the largest scale, seam allowance. */
#include "check.h"
#include "nets.h"

#include "core/random.h"
#include "core/vec.h"
#include "tests/short_memory.h"

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
    return 0;
}

static void assert_sheet(ktg_context *context, const char *text, const char *name, double width,
                         double height) {
    ktg_sheet_format format;
    ktg_sheet_defaults(&format);
    format.margin_mm = 7;
    assert_int_equal(ktg_sheet_parse(context, text, &format), KTG_OK);
    assert_string_equal(format.name, name);
    assert_true(format.width_mm == width || fabs(format.width_mm - width) < 1e-9);
    assert_true(format.height_mm == height || fabs(format.height_mm - height) < 1e-9);
    assert_true(format.margin_mm == 7);
}

static void sheets_go_by_name_or_measure(void **state) {
    assert_sheet(*state, "a4", "A4", 210, 297);
    assert_sheet(*state, "A0", "A0", 841, 1189);
    assert_sheet(*state, "LETTER", "Letter", 215.9, 279.4);
    assert_sheet(*state, "legal", "Legal", 215.9, 355.6);
    assert_sheet(*state, "Tabloid", "Tabloid", 279.4, 431.8);
    assert_sheet(*state, "a5", "A5", 148, 210);
    assert_sheet(*state, "a6", "A6", 105, 148);
    assert_sheet(*state, "A3+", "A3+", 329, 483);
    assert_sheet(*state, "b5", "B5", 176, 250);
    assert_sheet(*state, "jis-b4", "JIS-B4", 257, 364);
    assert_sheet(*state, "ledger", "Ledger", 279.4, 431.8);
    assert_sheet(*state, "ansi-d", "ANSI-D", 558.8, 863.6);
    assert_sheet(*state, "300x200", "300x200", 300, 200);
    assert_sheet(*state, "8.5x11in", "215.9x279.4", 215.9, 279.4);
    assert_sheet(*state, "21 x 29.7 cm", "210x297", 210, 297);
    assert_sheet(*state, "21cmX297mm", "210x297", 210, 297);
    assert_sheet(*state, "fit", "fit", INFINITY, INFINITY);
    assert_sheet(*state, "FIT", "fit", INFINITY, INFINITY);
}

static void what_is_no_sheet_is_refused_and_named(void **state) {
    const char *bad[] = {"",       "a9",        "x",          "210",       "210x",    "x297",
                         "-1x200", "1e3x200",   "nanxnan",    "210x297px", "5x5",     "10001x200",
                         "0x0",    "210x297x3", "210 x 297!", "8.5inx11",  "infx200", "fitx200",
                         "5xfit",  "900xfit",   "fitting"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        ktg_sheet_format format = {"mine", 1, 2, 3};
        assert_int_equal(ktg_sheet_parse(*state, bad[k], &format), KTG_ARGUMENT);
        assert_string_equal(format.name, "mine");
    }
    ktg_sheet_format format;
    assert_int_equal(ktg_sheet_parse(*state, "a9", &format), KTG_ARGUMENT);
    assert_non_null(strstr(ktg_context_message(*state), "tabloid"));
}

static void rows_never_overlap_nor_leave_the_sheet(void **state) {
    ktg_random random;
    ktg_random_seed(&random, 4);
    for (int round = 0; round < 50; round++) {
        ktg_row_box boxes[40];
        uint32_t sheets;
        for (int i = 0; i < 40; i++)
            boxes[i] = (ktg_row_box){5 + 60 * ktg_random_unit(&random),
                                     5 + 90 * ktg_random_unit(&random), -1, -1, 99};
        assert_int_equal(ktg_rows_pack(*state, 190, 277, 2, boxes, 40, &sheets), KTG_OK);
        for (int i = 0; i < 40; i++) {
            assert_true(boxes[i].sheet < sheets && boxes[i].x >= 0 && boxes[i].y >= 0);
            assert_true(boxes[i].x + boxes[i].width <= 190 && boxes[i].y + boxes[i].height <= 277);
            for (int k = 0; k < i; k++)
                assert_true(boxes[i].sheet != boxes[k].sheet ||
                            boxes[i].x >= boxes[k].x + boxes[k].width + 2 - 1e-9 ||
                            boxes[k].x >= boxes[i].x + boxes[i].width + 2 - 1e-9 ||
                            boxes[i].y >= boxes[k].y + boxes[k].height + 2 - 1e-9 ||
                            boxes[k].y >= boxes[i].y + boxes[i].height + 2 - 1e-9);
        }
    }
}

static void rows_fill_from_the_highest_box(void **state) {
    ktg_row_box boxes[] = {{4, 1, 0, 0, 0}, {5, 3, 0, 0, 0}, {5, 2, 0, 0, 0}, {9, 1, 0, 0, 0}};
    uint32_t sheets;
    assert_int_equal(ktg_rows_pack(*state, 10, INFINITY, 0, boxes, 4, &sheets), KTG_OK);
    assert_int_equal(sheets, 1);
    assert_true(boxes[1].x == 0 && boxes[1].y == 0 && boxes[2].x == 5 && boxes[2].y == 0);
    assert_true(boxes[0].x == 0 && boxes[0].y == 3 && boxes[3].y == 4);
    assert_int_equal(ktg_rows_pack(*state, 10, 3, 0, boxes, 4, &sheets), KTG_OK);
    assert_int_equal(sheets, 2);
    assert_int_equal(ktg_rows_pack(*state, 8, 3, 0, boxes, 4, &sheets), KTG_GEOMETRY);
}

static ktg_vec2 turned_size(const ktg_vec2 *p, size_t count, double angle) {
    ktg_motion2 m = {cos(angle), sin(angle), {0, 0}};
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 q = ktg_move2(m, p[i]);
        low = (ktg_vec2){fmin(low.x, q.x), fmin(low.y, q.y)};
        high = (ktg_vec2){fmax(high.x, q.x), fmax(high.y, q.y)};
    }
    return ktg_sub2(high, low);
}

static void boxes_beat_every_angle_of_a_fine_search(void **state) {
    ktg_random random;
    ktg_random_seed(&random, 8);
    for (int round = 0; round < 40; round++) {
        ktg_vec2 p[25], low, size;
        size_t count = (round % 2 ? 15 : 3) + ktg_random_below(&random, round % 2 ? 11 : 22);
        for (size_t i = 0; i < count; i++)
            p[i] = (ktg_vec2){100 * ktg_random_unit(&random), 40 * ktg_random_unit(&random)};
        for (size_t i = 1; i < count && round % 2; i++) /* crowds, closer than digits can tell */
            if (i % 5)
                p[i] = ktg_madd2(p[i - 1], 1e-15 * ktg_random_unit(&random), p[i]);
        double rotation, magnification, area = INFINITY, most = 0;
        for (int k = 0; k < 18000; k++) {
            ktg_vec2 s = turned_size(p, count, KTG_PI * k / 18000);
            area = fmin(area, s.x * s.y);
            most = fmax(most, fmin(190 / s.x, 277 / s.y));
        }
        assert_int_equal(ktg_smallest_box(*state, p, count, &rotation, &low, &size), KTG_OK);
        ktg_vec2 s = turned_size(p, count, rotation);
        assert_true(fabs(s.x - size.x) < 1e-9 && fabs(s.y - size.y) < 1e-9);
        assert_true(size.x * size.y <= area * (1 + 1e-12));
        assert_int_equal(ktg_best_fit(*state, p, count, 190, 277, &rotation, &low, &magnification),
                         KTG_OK);
        s = turned_size(p, count, rotation);
        assert_true(fabs(fmin(190 / s.x, 277 / s.y) - magnification) < 1e-9 * magnification);
        assert_true(magnification >= most * (1 - 1e-12));
        assert_true(magnification <= most * (1 + 1e-3));
    }
}

static void boxes_of_points_and_lines_are_flat(void **state) {
    ktg_vec2 line[] = {{0, 0}, {3, 4}, {1.5, 2}}, low, size;
    double rotation, magnification;
    assert_int_equal(ktg_smallest_box(*state, line, 1, &rotation, &low, &size), KTG_OK);
    assert_true(size.x == 0 && size.y == 0);
    assert_int_equal(ktg_smallest_box(*state, line, 3, &rotation, &low, &size), KTG_OK);
    assert_true(fmin(size.x, size.y) < 1e-12 && fabs(fmax(size.x, size.y) - 5) < 1e-12);
    assert_int_equal(ktg_best_fit(*state, line, 3, 30, 40, &rotation, &low, &magnification),
                     KTG_OK);
    assert_true(fabs(magnification - 10) < 1e-9); /* the diagonal */
    static const double refused[] = {NAN, -INFINITY, 1.1e150, -1e300};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        line[1].x = refused[i];
        assert_int_equal(ktg_smallest_box(*state, line, 3, &rotation, &low, &size), KTG_ARGUMENT);
        assert_int_equal(ktg_best_fit(*state, line, 3, 30, 40, &rotation, &low, &magnification),
                         KTG_ARGUMENT);
    }
    for (int far = 0; far < 2; far++) {
        line[1] = far ? (ktg_vec2){-9e149, 9e149} : (ktg_vec2){9e149, 9e149};
        assert_int_equal(ktg_smallest_box(*state, line, 3, &rotation, &low, &size), KTG_OK);
        assert_true(isfinite(size.x) && isfinite(size.y) && fmax(size.x, size.y) > 1.2e150);
        assert_int_equal(ktg_best_fit(*state, line, 3, 30, 40, &rotation, &low, &magnification),
                         KTG_OK);
        assert_true(magnification > 0 && magnification < 1e-148);
    }
}

static void what_fit_promises_really_fits_and_little_more_does(void **state) {
    ktg_sheet_format sheet;
    ktg_sheet_defaults(&sheet);
    for (uint64_t seed = 1; seed < 6; seed++) {
        ktg_pattern *p = grow_net(*state, make_bumpy_ball(1, 0.3, 1, seed), 1000, seed);
        for (int k = 0; k < 2 && p->piece_count == 1; k++) {
            ktg_pattern *copy;
            double scale, rotation, magnification;
            ktg_vec2 low;
            assert_int_equal(ktg_pattern_fit(*state, p, &sheet, 2, NULL, &scale), KTG_OK);
            assert_int_equal(ktg_pattern_copy(*state, p, &copy), KTG_OK);
            assert_int_equal(ktg_pattern_scale(*state, copy, scale * (k ? 1.01 : 1)), KTG_OK);
            assert_int_equal(ktg_pattern_finish(*state, copy, NULL, NULL), KTG_OK);
            assert_int_equal(ktg_best_fit(*state, copy->pieces[0].outline,
                                          copy->pieces[0].outline_count, 190, 277, &rotation, &low,
                                          &magnification),
                             KTG_OK);
            assert_true(k ? magnification < 1.002 : magnification >= 1 + 1e-10);
            ktg_pattern_free(&copy);
        }
        ktg_pattern_free(&p);
    }
}

static void a_model_twice_as_large_fits_at_exactly_half_the_scale(void **state) {
    ktg_sheet_format sheet;
    ktg_sheet_defaults(&sheet);
    for (uint32_t most_faces = 5; most_faces < 1000; most_faces *= 10) {
        ktg_pattern *p = grow_net(*state, make_bumpy_ball(1, 0.3, 1, 3), most_faces, 3);
        double scale, half;
        assert_int_equal(ktg_pattern_fit(*state, p, &sheet, 2, NULL, &scale), KTG_OK);
        assert_int_equal(ktg_pattern_scale(*state, p, 2), KTG_OK);
        assert_int_equal(ktg_pattern_fit(*state, p, &sheet, 2, NULL, &half), KTG_OK);
        assert_true(half == scale / 2);
        ktg_pattern_free(&p);
    }
}

static void several_pieces_fit_one_sheet_in_rows(void **state) {
    ktg_sheet_format sheet;
    ktg_sheet_defaults(&sheet);
    ktg_pattern *p = grow_net(*state, make_bumpy_ball(1, 0.3, 1, 3), 5, 3);
    double scale, area = 0;
    assert_true(p->piece_count > 5);
    assert_int_equal(ktg_pattern_fit(*state, p, &sheet, 2, NULL, &scale), KTG_OK);
    assert_int_equal(ktg_pattern_scale(*state, p, scale), KTG_OK);
    assert_int_equal(ktg_pattern_finish(*state, p, NULL, NULL), KTG_OK);
    for (size_t i = 0; i < p->piece_count; i++)
        area += area_of_polygon(p->pieces[i].outline, p->pieces[i].outline_count);
    assert_true(area > 0.3 * 190 * 277 && area < 190 * 277);
    ktg_pattern_free(&p);
}

static void margins_that_eat_the_sheet_are_refused(void **state) {
    ktg_sheet_format sheet;
    ktg_sheet_defaults(&sheet);
    sheet.margin_mm = 105;
    ktg_pattern *p = grow_net(*state, make_cube(1), 12, 1);
    double scale;
    assert_int_equal(ktg_pattern_fit(*state, p, &sheet, 2, NULL, &scale), KTG_GEOMETRY);
    ktg_pattern_free(&p);
}

static void every_failing_allocation_is_survived(void **state) {
    ktg_context *context = *state;
    ktg_sheet_format sheet;
    ktg_sheet_defaults(&sheet);
    for (int cloth = 0; cloth < 2; cloth++) {
        ktg_pattern *p =
            grow_net(context, cloth ? make_strip(3, 1, 2) : make_tetrahedron(1), 2 + 98 * cloth, 1);
        p->mode = cloth ? KTG_CLOTH : KTG_PAPER;
        ktg_status status = KTG_MEMORY;
        double scale = 0;
        for (uint64_t nth = 1; status == KTG_MEMORY; nth++) {
            ktg_context_fail_allocation(context, nth);
            status = ktg_pattern_fit(context, p, &sheet, 2, NULL, &scale);
            assert_true(nth < 20000);
        }
        end_short_memory(context, status);
        assert_int_equal(status, KTG_OK);
        assert_true(scale > 10);
        ktg_pattern_free(&p);
    }
}

/* ---- cloth -------------------------------------------------------------------------------- */

static void a_strip_of_cloth_gets_its_allowance_all_around(void **state) {
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    ktg_pattern *p = grow_net(*state, make_strip(6, 20, 50), 100, 1);
    p->mode = KTG_CLOTH;
    o.hem_mm = 10;
    assert_int_equal(ktg_pattern_finish(*state, p, &o, NULL), KTG_OK);
    const ktg_pattern_piece *piece = p->pieces;
    assert_int_equal(piece->outline_count, 4);
    assert_true(fabs(area_of_polygon(piece->outline, 4) - 140 * 70) < 1e-6);
    assert_int_equal(piece->line_count, 2);
    assert_int_equal(piece->lines[0].kind, KTG_LINE_SEW);
    assert_int_equal(piece->lines[0].point_count, 15);
    assert_int_equal(piece->lines[1].kind, KTG_LINE_GRAIN);
    assert_true(piece->lines[1].points[0].x == piece->lines[1].points[1].x);
    assert_int_equal(piece->label_count, 3);
    assert_string_equal(piece->labels[0].text, "piece 1");
    assert_string_equal(piece->labels[1].text, "cut 1");
    assert_string_equal(piece->labels[2].text, "with 10 mm, hem 10 mm");
    o.hem_mm = 0;
    assert_int_equal(ktg_pattern_finish(*state, p, &o, NULL), KTG_OK);
    assert_int_equal(p->pieces[0].outline_count, 4);
    assert_true(fabs(area_of_polygon(p->pieces[0].outline, 4) - 120 * 50) < 1e-6);
    ktg_pattern_free(&p);
}

static double distance_to_border(const ktg_pattern_line *border, ktg_vec2 p) {
    double least = INFINITY;
    for (size_t i = 0; i + 1 < border->point_count; i++) {
        ktg_vec2 a = border->points[i], d = ktg_sub2(border->points[i + 1], a);
        double s = fmax(0, fmin(1, ktg_dot2(ktg_sub2(p, a), d) / ktg_dot2(d, d)));
        least = fmin(least, ktg_length2(ktg_sub2(p, ktg_madd2(a, s, d))));
    }
    return least;
}

static uint32_t dart_count(const ktg_pattern *p) {
    uint32_t count = 0;
    for (size_t s = 0; s < p->seam_count; s++)
        count += p->seams[s].dart;
    return count;
}

static void allowances_of_ragged_pieces_are_simple_and_wide_enough(void **state) {
    ktg_finish_options o;
    uint32_t narrow = 0, points = 0;
    ktg_finish_defaults(&o);
    for (uint64_t seed = 1; seed <= 30; seed++) {
        ktg_pattern *p = grow_net(*state, make_bumpy_ball(60, 0.6, 1, seed), 100, seed);
        p->mode = KTG_CLOTH;
        o.allowance_mm = o.hem_mm = (double)(1 + 3 * (seed % 6));
        assert_int_equal(ktg_pattern_finish(*state, p, &o, NULL), KTG_OK);
        for (size_t i = 0; i < p->piece_count; i++) {
            const ktg_pattern_piece *piece = &p->pieces[i];
            assert_true(is_simple(piece->outline, piece->outline_count));
            assert_true(area_of_polygon(piece->outline, piece->outline_count) > 0);
            for (size_t k = 0; k < piece->outline_count; k++) {
                ktg_vec2 a = piece->outline[k];
                ktg_vec2 b = piece->outline[(k + 1) % piece->outline_count];
                for (int n = 0; n < 8; n++) {
                    ktg_vec2 q = ktg_madd2(a, n / 8.0, ktg_sub2(b, a));
                    double d = distance_to_border(&piece->lines[0], q);
                    assert_true(d > 0);
                    narrow += d < 0.6 * o.allowance_mm; /* where a piece comes near itself */
                    points++;
                    assert_true(d < 2.5 * o.allowance_mm * (1 + 1e-3) || dart_count(p) > 0);
                }
            }
        }
        ktg_pattern_free(&p);
    }
    assert_true(narrow < points / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheets_go_by_name_or_measure),
        cmocka_unit_test(what_is_no_sheet_is_refused_and_named),
        cmocka_unit_test(rows_never_overlap_nor_leave_the_sheet),
        cmocka_unit_test(rows_fill_from_the_highest_box),
        cmocka_unit_test(boxes_beat_every_angle_of_a_fine_search),
        cmocka_unit_test(boxes_of_points_and_lines_are_flat),
        cmocka_unit_test(what_fit_promises_really_fits_and_little_more_does),
        cmocka_unit_test(a_model_twice_as_large_fits_at_exactly_half_the_scale),
        cmocka_unit_test(several_pieces_fit_one_sheet_in_rows),
        cmocka_unit_test(margins_that_eat_the_sheet_are_refused),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(a_strip_of_cloth_gets_its_allowance_all_around),
        cmocka_unit_test(allowances_of_ragged_pieces_are_simple_and_wide_enough),
    };
    return cmocka_run_group_tests_name("pattern/fit", tests, make_context, drop_context);
}
