/* What machines get: cuts once, from the inside out, in long paths. */
#include "render/plot.h"
#include "render/weld.h"

#include <setjmp.h>
#include <stdarg.h>

#include "render/furniture.h"
#include "tests/render/picture.h"
#include "tests/render/strip.h"

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

/* The cuts of one sheet, as one looks at them. */
typedef struct cuts {
    ktg_drawing *drawing;
    ktg_plot plot;
    size_t count;
    const ktg_plot_path *paths[8];
} cuts;

/* `count` pieces with these outlines on one sheet; the pattern is the caller's. */
static ktg_pattern *make_pieces(ktg_context *context, uint32_t count,
                                const ktg_vec2 *const *outlines, const size_t *sizes) {
    ktg_pattern *pattern = make_strips(context, count, 300, 300, 10, 20, 20);
    ktg_pattern_sheet *sheet = &pattern->sheets[0];
    ktg_free(sheet->placements);
    sheet->placements = ktg_new(context, count, ktg_pattern_placement);
    sheet->placement_count = count;
    for (uint32_t i = 0; i < count; i++) {
        ktg_pattern_piece *piece = &pattern->pieces[i];
        ktg_free(piece->outline);
        piece->outline = ktg_copy_array(context, outlines[i], sizes[i], sizeof(ktg_vec2));
        piece->outline_count = sizes[i];
        sheet->placements[i] = (ktg_pattern_placement){i, 20, 20, 0};
    }
    return pattern;
}

static cuts find_cuts(ktg_context *context, const ktg_pattern *pattern) {
    cuts found = {.count = 0};
    assert_int_equal(ktg_drawing_new(context, pattern, NULL, &found.drawing), KTG_OK);
    assert_int_equal(ktg_plot_make(found.drawing, 0, &found.plot), KTG_OK);
    for (size_t i = 0; i < found.plot.path_count; i++)
        if (found.plot.paths[i].layer == KTG_LAYER_CUT && found.count < 8)
            found.paths[found.count++] = &found.plot.paths[i];
    return found;
}

static void drop_cuts(cuts *found) {
    ktg_plot_drop(&found->plot);
    ktg_drawing_free(&found->drawing);
}

static ktg_vec2 point_of(const cuts *found, size_t path, size_t index) {
    ktg_vec2 p = found->plot.points[found->paths[path]->first + index];
    return (ktg_vec2){p.x - 20, p.y - 20};
}

static void expect_path(const cuts *found, size_t path, const ktg_vec2 *points, size_t count,
                        bool closed) {
    assert_int_equal(found->paths[path]->count, count);
    assert_int_equal(found->paths[path]->closed, closed);
    for (size_t i = 0; i < count; i++) {
        assert_float_equal(point_of(found, path, i).x, points[i].x, 1e-9);
        assert_float_equal(point_of(found, path, i).y, points[i].y, 1e-9);
    }
}

/* The slit has a corner, and on the way back a point more. */
static void a_slit_is_cut_once_and_before_the_outline(void **state) {
    static const ktg_vec2 outline[] = {{0, 0},   {20, 0}, {20, 10}, {30, 20}, {27, 17},
                                       {20, 10}, {20, 0}, {40, 0},  {40, 40}, {0, 40}};
    static const ktg_vec2 slit[] = {{20, 0}, {20, 10}, {27, 17}, {30, 20}},
                          rest[] = {{0, 0}, {20, 0}, {40, 0}, {40, 40}, {0, 40}};
    ktg_pattern *pattern = make_pieces(*state, 1, (const ktg_vec2 *[]){outline}, (size_t[]){10});
    cuts found = find_cuts(*state, pattern);
    assert_int_equal(found.count, 2);
    expect_path(&found, 0, slit, 4, false);
    expect_path(&found, 1, rest, 5, true);
    drop_cuts(&found);
    ktg_pattern_free(&pattern);
}

static void a_slit_that_has_opened_is_part_of_the_outline(void **state) {
    static const ktg_vec2 outline[] = {{0, 0}, {20, 0}, {20.5, 10}, {21, 0}, {40, 0}, {0, 40}};
    ktg_pattern *pattern = make_pieces(*state, 1, (const ktg_vec2 *[]){outline}, (size_t[]){6});
    cuts found = find_cuts(*state, pattern);
    assert_int_equal(found.count, 1);
    expect_path(&found, 0, outline, 6, true);
    drop_cuts(&found);
    ktg_pattern_free(&pattern);
}

/* A frame: the walk goes along a bridge to the hole, around it and back. */
static void a_hole_comes_before_its_outline(void **state) {
    static const ktg_vec2 outline[] = {{0, 0},   {10, 10}, {10, 30}, {30, 30}, {30, 10},
                                       {10, 10}, {0, 0},   {40, 0},  {40, 40}, {0, 40}};
    static const ktg_vec2 bridge[] = {{0, 0}, {10, 10}},
                          hole[] = {{10, 10}, {10, 30}, {30, 30}, {30, 10}},
                          rest[] = {{0, 0}, {40, 0}, {40, 40}, {0, 40}};
    ktg_pattern *pattern = make_pieces(*state, 1, (const ktg_vec2 *[]){outline}, (size_t[]){10});
    cuts found = find_cuts(*state, pattern);
    assert_int_equal(found.count, 3);
    expect_path(&found, 0, bridge, 2, false);
    expect_path(&found, 1, hole, 4, true);
    expect_path(&found, 2, rest, 4, true);
    drop_cuts(&found);
    ktg_pattern_free(&pattern);
}

static void what_two_pieces_share_is_cut_with_the_smaller_one(void **state) {
    static const ktg_vec2 large[] = {{0, 0}, {40, 0}, {40, 40}, {0, 40}},
                          small[] = {{40, 10}, {60, 10}, {60, 20}, {40, 20}},
                          rest[] = {{40, 20}, {40, 40}, {0, 40}, {0, 0}, {40, 0}, {40, 10}};
    ktg_pattern *pattern =
        make_pieces(*state, 2, (const ktg_vec2 *[]){large, small}, (size_t[]){4, 4});
    cuts found = find_cuts(*state, pattern);
    assert_int_equal(found.count, 2);
    expect_path(&found, 0, small, 4, true);
    expect_path(&found, 1, rest, 6, false);
    drop_cuts(&found);
    ktg_pattern_free(&pattern);
}

/* Beyond a tile's printable area nothing is drawn: the outline falls into what is inside. */
static void a_tiles_paths_end_at_its_printable_area(void **state) {
    static const ktg_vec2 outline[] = {{0, 0}, {400, 0}, {400, 40}, {0, 40}};
    static const ktg_vec2 lower[] = {{0, 0}, {270, 0}}, upper[] = {{270, 40}, {0, 40}, {0, 0}};
    ktg_pattern *pattern = make_pieces(*state, 1, (const ktg_vec2 *[]){outline}, (size_t[]){4});
    pattern->sheets[0].kind = KTG_TILE;
    cuts found = find_cuts(*state, pattern);
    assert_int_equal(found.count, 2);
    expect_path(&found, 0, lower, 2, false);
    expect_path(&found, 1, upper, 3, false);
    drop_cuts(&found);
    ktg_pattern_free(&pattern);
}

typedef struct trails {
    size_t count;
    size_t lengths[4];
    bool closed[4];
} trails;

static ktg_status note(void *user, const ktg_vec2 *points, size_t count, bool closed) {
    trails *t = user;
    (void)points;
    t->closed[t->count] = closed;
    t->lengths[t->count++] = count;
    return KTG_OK;
}

static void loose_segments_become_long_paths(void **state) {
    /* A square with both halves of a line through one corner. */
    static const ktg_vec2 ends[][2] = {{{0, 0}, {1, 0}}, {{1, 1}, {1, 0}}, {{1, 1}, {0, 1}},
                                       {{0, 1}, {0, 0}}, {{1, 1}, {2, 2}}, {{0.5, 0.5}, {1, 1}}};
    ktg_weld weld = {.context = *state, .tolerance = 1e-6};
    ktg_segment segments[6];
    trails found = {0};
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(ktg_weld_point(&weld, ends[i][0], &segments[i].a), KTG_OK);
        assert_int_equal(ktg_weld_point(&weld, ends[i][1], &segments[i].b), KTG_OK);
    }
    assert_int_equal(weld.count, 6);
    assert_int_equal(ktg_trails_join(&weld, segments, 6, note, &found), KTG_OK);
    assert_int_equal(found.count, 2);
    assert_int_equal(found.lengths[0], 3);
    assert_false(found.closed[0]);
    assert_int_equal(found.lengths[1], 4);
    assert_true(found.closed[1]);
    ktg_weld_drop(&weld);
}

static void numbers_are_short_and_know_no_locale(void **state) {
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},         {-0.00001, "0"},    {12.5, "12.5"},    {210, "210"},
                 {-1.25, "-1.25"}, {0.0001, "0.0001"}, {99.99996, "100"}, {1.23456, "1.2346"}};
    char text[KTG_NUMBER_SIZE];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ktg_plot_number(cases[i].value, text);
        assert_string_equal(text, cases[i].text);
    }
}

/* Between what printers leave white and the pieces, the same in print and in the cutter's file. */
static void registration_marks_stand_in_the_margins(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    ktg_pattern_sheet *sheet = &pattern->sheets[0];
    ktg_vec2 marks[KTG_REGISTRATION_MARKS];
    double reach;
    assert_true(ktg_registration_find(sheet, marks, &reach));
    assert_float_equal(marks[2].x, 210 - (10 + KTG_PAPER_EDGE_MM) / 2, 1e-9);
    assert_true(reach > 1 && marks[0].x + reach < 10 && marks[0].y - reach > KTG_PAPER_EDGE_MM);
    ktg_render_options options;
    char *bytes;
    size_t size;
    ktg_render_defaults(&options);
    options.dots_per_inch = 254;
    for (int wanted = 0; wanted < 2; wanted++) {
        options.registration = wanted;
        assert_int_equal(render_bytes(context, pattern, "png", 0, &options, &bytes, &size), KTG_OK);
        snapshot page = picture_of(bytes, size, 10, sheet->height_mm);
        for (int k = 0; k < KTG_REGISTRATION_MARKS; k++)
            assert_int_equal(picture_has_ink(&page, marks[k].x - 0.2, marks[k].y - 0.2,
                                             marks[k].x + 0.2, marks[k].y + 0.2),
                             wanted);
        picture_drop(&page);
        ktg_free(bytes);
    }
    for (int side = 0; side < 2; side++)
        sheet->printable[side] = 0.5;
    assert_false(ktg_registration_find(sheet, marks, &reach));
    ktg_pattern_free(&pattern);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_slit_is_cut_once_and_before_the_outline, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_slit_that_has_opened_is_part_of_the_outline, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_hole_comes_before_its_outline, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(what_two_pieces_share_is_cut_with_the_smaller_one,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_tiles_paths_end_at_its_printable_area, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(loose_segments_become_long_paths, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(registration_marks_stand_in_the_margins, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(numbers_are_short_and_know_no_locale, make_context,
                                        drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
