/* Pieces that fit their sheets at a scale that is given. */
#include "core/memory.h"
#include "core/vec.h"
#include "tests/short_memory.h"
#include "tests/unfold/help.h"
#include "unfold/join.h"
#include "unfold/sheet_check.h"
#include "unfold/sheet_merge.h"
#include "unfold/sheet_start.h"
#include "unfold/sheets.h"
#include "unfold/unfold.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ktg_unfold_options options_at(double mm_per_unit) {
    ktg_unfold_options options;
    ktg_unfold_defaults(&options);
    options.effort = KTG_EFFORT_QUICK;
    options.mm_per_unit = mm_per_unit;
    return options;
}

/* Every face lies in one piece; each piece, finished, fits the sheet. */
static void check_pattern(ktg_context *context, const ktg_unfold_options *options,
                          ktg_pattern *pattern) {
    ktg_finish_report report;
    uint32_t *times = ktg_new(context, pattern->face_count, uint32_t);
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t f = 0; f < pattern->pieces[p].face_count; f++)
            times[pattern->pieces[p].faces[f]]++;
    for (uint32_t f = 0; f < pattern->face_count; f++)
        assert_int_equal(times[f], 1);
    ktg_free(times);
    assert_int_equal(ktg_pattern_scale(context, pattern, options->mm_per_unit), KTG_OK);
    assert_int_equal(ktg_pattern_finish(context, pattern, &options->finish, &report), KTG_OK);
    double margins = 2 * options->sheet.margin_mm;
    for (size_t p = 0; p < pattern->piece_count; p++) {
        const ktg_pattern_piece *piece = &pattern->pieces[p];
        double rotation, magnification;
        ktg_vec2 low;
        assert_int_equal(ktg_best_fit(context, piece->outline, piece->outline_count,
                                      options->sheet.width_mm - margins,
                                      options->sheet.height_mm - margins, &rotation, &low,
                                      &magnification),
                         KTG_OK);
        assert_true(magnification >= 1);
    }
}

/* Unfolds and checks; returns how many pieces. */
static uint32_t divide(ktg_context *context, ktg_mesh *mesh, const ktg_unfold_options *options) {
    ktg_pattern *pattern;
    ktg_unfold_report report;
    assert_int_equal(ktg_unfold(context, mesh, "thing", options, &pattern, &report), KTG_OK);
    uint32_t count = (uint32_t)pattern->piece_count;
    for (size_t p = 0; options->piece_faces > 0 && p < pattern->piece_count; p++)
        assert_true(pattern->pieces[p].face_count <= options->piece_faces);
    if (options->mm_per_unit > 0)
        check_pattern(context, options, pattern);
    ktg_pattern_free(&pattern);
    return count;
}

static double sheets_in(const ktg_mesh *mesh, double mm) {
    double area = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *v = mesh->faces + 3 * (size_t)f;
        ktg_vec3 a = mesh->positions[v[0]];
        area += 0.5 * ktg_length3(ktg_cross3(ktg_sub3(mesh->positions[v[1]], a),
                                             ktg_sub3(mesh->positions[v[2]], a)));
    }
    return area * mm * mm / (190.0 * 277.0);
}

static void pieces_fit_and_are_few(void **state) {
    ktg_mesh *meshes[] = {shape_icosphere(*state, 2), shape_torus(*state, 20, 10),
                          shape_bumpy_sphere(*state), shape_cylinder(*state, 16, 8),
                          shape_several(*state)};
    const double mm[] = {100, 250, 180, 180, 90};
    for (size_t i = 0; i < 5; i++) {
        ktg_unfold_options options = options_at(mm[i]);
        uint32_t parts = i == 4 ? 4 : 1;
        double bar = ceil(sheets_in(meshes[i], mm[i]) / 0.45);
        uint32_t count = divide(*state, meshes[i], &options);
        assert_true(count <= bar + 1 + parts);
        ktg_mesh_free(&meshes[i]);
    }
}

static void what_fits_stays_in_one_piece(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 2);
    ktg_unfold_options options = options_at(40);
    assert_int_equal(divide(*state, mesh, &options), 1);
    options.mm_per_unit = 160;
    options.oversize = KTG_OVERSIZE_ERROR;
    ktg_pattern *pattern;
    assert_int_equal(ktg_unfold(*state, mesh, "thing", &options, &pattern, NULL), KTG_OK);
    assert_int_equal(pattern->piece_count, 1);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void numbers_can_be_asked_for(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 2);
    ktg_unfold_options options = options_at(0);
    options.pieces = 5;
    assert_int_equal(divide(*state, mesh, &options), 5);
    options.pieces = 0;
    options.piece_faces = 33;
    assert_true(divide(*state, mesh, &options) >= 10);
    options.mm_per_unit = 50;
    assert_true(divide(*state, mesh, &options) >= 10);
    options.piece_faces = 1;
    assert_int_equal(divide(*state, mesh, &options), 320);
    ktg_mesh_free(&mesh);
}

static void a_short_time_is_enough_for_an_answer(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    ktg_unfold_options options = options_at(200);
    ktg_unfold_report report;
    ktg_pattern *pattern;
    options.seconds = 1e-6;
    assert_int_equal(ktg_unfold(*state, mesh, "thing", &options, &pattern, &report), KTG_OK);
    assert_int_equal(report.stopped_by, KTG_STOPPED_TIME);
    check_pattern(*state, &options, pattern);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* And the size that is promised to fit does. */
static void a_face_larger_than_the_sheet_is_named(void **state) {
    ktg_mesh *mesh = shape_tetrahedron(*state);
    ktg_unfold_options options = options_at(500);
    ktg_pattern *pattern;
    double promised = 0;
    assert_int_equal(ktg_unfold(*state, mesh, "thing", &options, &pattern, NULL), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(*state), "face 1"));
    const char *promise = strstr(ktg_context_message(*state), "divided: at ");
    assert_non_null(promise);
    assert_int_equal(sscanf(promise, "divided: at %lf mm per unit it fits", &promised), 1);
    options.mm_per_unit = promised;
    assert_int_equal(ktg_unfold(*state, mesh, "thing", &options, &pattern, NULL), KTG_OK);
    check_pattern(*state, &options, pattern);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* Sides of a cube stay whole where they fit the sheet, and are divided where they do not. */
static void polygons_are_divided_only_where_they_must(void **state) {
    ktg_mesh *mesh = shape_cube(*state, 1);
    const double mm[] = {150, 195};
    for (int i = 0; i < 2; i++) {
        ktg_unfold_options options = options_at(mm[i]);
        ktg_pattern *pattern;
        uint32_t divided = 0;
        assert_int_equal(ktg_unfold(*state, mesh, "cube", &options, &pattern, NULL), KTG_OK);
        for (size_t e = 0; e < pattern->edge_count; e++) {
            const ktg_pattern_edge *edge = &pattern->edges[e];
            divided += edge->kind == KTG_EDGE_CUT && fabs(edge->angle) < 1e-6;
        }
        assert_true((divided > 0) == (i == 1));
        check_pattern(*state, &options, pattern);
        ktg_pattern_free(&pattern);
    }
    ktg_mesh_free(&mesh);
}

static void halves_and_mergers_count_trees(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 2);
    ktg_dual *dual = dual_of(*state, mesh);
    ktg_search search = {.faces_all = dual->face_count, .mm = 100, .area_all = 12};
    ktg_unfold_options options = options_at(100);
    bool *folded = ktg_new(*state, dual->edge_count, bool), overlaps = true;
    uint32_t *tree = ktg_new(*state, dual->face_count, uint32_t), pieces = 0, count = 0;
    ktg_random_seed(&search.random, 1);
    assert_int_equal(ktg_join_transplant(*state, dual, &options, &search, folded, &pieces), KTG_OK);
    assert_int_equal(pieces, 1);
    assert_int_equal(ktg_sheet_halve_largest(*state, dual, 7, folded), KTG_OK);
    assert_int_equal(ktg_sheet_trees(*state, dual, folded, tree, &count), KTG_OK);
    assert_int_equal(count, 7);
    assert_int_equal(ktg_sheet_merge(*state, dual, 3, folded), KTG_OK);
    assert_int_equal(ktg_sheet_trees(*state, dual, folded, tree, &count), KTG_OK);
    assert_true(count >= 3 && count < 7);
    assert_int_equal(ktg_sheet_overlaps(*state, dual, folded, &overlaps), KTG_OK);
    assert_false(overlaps);
    ktg_free(folded);
    ktg_free(tree);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

/* Wherever memory ends, the call says so and leaves nothing behind. */
static void memory_may_end_anywhere(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 0);
    ktg_unfold_options options = options_at(150);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status == KTG_MEMORY; nth += 1 + nth / 16) {
        ktg_pattern *pattern = NULL;
        ktg_context_fail_allocation(*state, nth);
        status = ktg_unfold(*state, mesh, "thing", &options, &pattern, NULL);
        end_short_memory(*state, status);
        assert_true((status == KTG_OK) == (pattern != NULL));
        ktg_pattern_free(&pattern);
    }
    assert_int_equal(status, KTG_OK);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(pieces_fit_and_are_few, make_context, drop_context),
        cmocka_unit_test_setup_teardown(what_fits_stays_in_one_piece, make_context, drop_context),
        cmocka_unit_test_setup_teardown(numbers_can_be_asked_for, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_short_time_is_enough_for_an_answer, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_face_larger_than_the_sheet_is_named, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(polygons_are_divided_only_where_they_must, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(halves_and_mergers_count_trees, make_context, drop_context),
        cmocka_unit_test_setup_teardown(memory_may_end_anywhere, make_context, drop_context)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
