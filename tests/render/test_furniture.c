/* Title, legend and rulers keep clear of the pieces and of the paper's edge: looked at as pixels.
 */
#include <math.h>

#include "tests/render/ink.h"
#include "tests/render/pdf_words.h"
#include "tests/render/strip.h"

/* How near to the paper's edge there is ink, in mm. */
static double ink_edge(const snapshot *picture) {
    double nearest = INFINITY;
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++)
            if (grey(pixel(picture, x, y)) < 230) {
                double column = fmin(x, picture->width - 1 - x),
                       row = fmin(y, picture->height - 1 - y);
                nearest = fmin(nearest, fmin(column, row) / picture->dots_per_mm);
            }
    return nearest;
}

static void a_long_name_does_not_run_into_the_furniture(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    default_options(&options);
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 75, 247);
    ktg_pattern_piece *piece = &pattern->pieces[0];
    piece->label_count = 1;
    piece->labels[0] = (ktg_pattern_label){"a long name, 12 of 13", {118, 20}, 0, 4, KTG_NONE};
    snapshot picture = take(context, pattern, &options);
    assert_false(picture_has_ink(&picture, 201, 200, 209, 280)); /* the right margin */
    assert_true(picture_has_ink(&picture, 190, 265, 199.9, 269));
    cairo_surface_destroy(picture.surface);
    piece->labels[0].at = (ktg_vec2){100, 38};
    piece->labels[0].rotation = KTG_PI / 2;
    picture = take(context, pattern, &options);
    assert_false(picture_has_ink(&picture, 170, 287.3, 180, 287.9)); /* below the title */
    assert_true(picture_has_ink(&picture, 172, 280, 178, 286.9));
    cairo_surface_destroy(picture.surface);
    ktg_pattern_free(&pattern);
}

static void furniture_stays_between_paper_edge_and_printable_area(void **state) {
    static const double sheets[][3] = {{210, 297, 10},     {297, 210, 10}, {215.9, 279.4, 12.7},
                                       {420, 297, 20},     {105, 148, 10}, {300, 60, 10},
                                       {60, 300, 10.0001}, {40, 40, 10},   {841, 1189, 10}};
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    options.title =
        "A title that is long enough to need shortening on most of these sheets, if not "
        "on all of them, for it goes on and on";
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++) {
        double width = sheets[i][0], height = sheets[i][1], margin = sheets[i][2];
        options.dots_per_inch = width > 500 ? 76.2 : 127; /* 3 or 5 to the millimetre */
        ktg_pattern *pattern = make_strips(context, 1, width, height, margin, 0, 0);
        pattern->sheets[0].placement_count = 0;
        snapshot picture = take(context, pattern, &options);
        assert_true(ink_edge(&picture) >= 6.35 - 1.1 / picture.dots_per_mm);
        assert_true(ink_edge(&picture) < margin);
        if (width >= 100) /* else the legend finds a pocket inside */
            assert_false(picture_has_ink(&picture, margin + 0.2, margin + 0.2, width - margin - 0.2,
                                         height - margin - 0.2));
        cairo_surface_destroy(picture.surface);
        ktg_pattern_free(&pattern);
    }
}

static void furniture_keeps_out_of_the_pieces_in_narrow_margins(void **state) {
    static const ktg_vec2 places[] = {{5, 5}, {80, 5}, {5, 250}, {80, 250}, {40, 120}};
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    options.dots_per_inch = 127;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        double x = places[i].x, y = places[i].y;
        ktg_pattern *pattern = make_strips(context, 1, 210, 297, 5, x, y);
        pattern->pieces[0].label_count = 0;
        snapshot picture = take(context, pattern, &options);
        /* Furniture is there, and none of it in a face or close to the piece. */
        bool corner =
            picture_has_ink(&picture, 6, 6, 70, 40) || picture_has_ink(&picture, 140, 6, 204, 40);
        assert_true(corner);
        assert_false(picture_has_ink(&picture, x + 1, y + 1, x + 39, y + 39));
        assert_false(
            picture_has_ink(&picture, fmax(0, x - 1.5), y + 41, x + 126, fmin(297, y + 41.5)));
        cairo_surface_destroy(picture.surface);
        ktg_pattern_free(&pattern);
    }
}

static void furniture_finds_a_pocket_between_the_pieces(void **state) {
    static const ktg_vec2 corners[] = {{5, 5}, {130, 5}, {5, 155}, {130, 155}};
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    options.dots_per_inch = 127;
    ktg_pattern *pattern = make_strips(context, 4, 260, 200, 5, 0, 0);
    ktg_pattern_placement *places = ktg_new(context, 4, ktg_pattern_placement);
    for (uint32_t k = 0; k < 4; k++) {
        places[k] = (ktg_pattern_placement){k, corners[k].x, corners[k].y, 0};
        ktg_free(pattern->sheets[k].placements);
        pattern->sheets[k].placements = NULL;
        pattern->sheets[k].placement_count = 0;
    }
    pattern->sheets[0].placements = places;
    pattern->sheets[0].placement_count = 4;
    pattern->sheet_count = 1;
    snapshot picture = take(context, pattern, &options);
    assert_true(picture_has_ink(&picture, 6, 47, 254, 153));
    assert_false(picture_has_ink(&picture, 0, 45.5, 260, 46.8)); /* clear of the pieces */
    cairo_surface_destroy(picture.surface);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_null(memmem(bytes, size, "How to read this pattern", 24));
    ktg_free(bytes);
    pattern->sheet_count = 4;
    ktg_pattern_free(&pattern);
}

static void a_full_sheet_gets_a_page_that_explains_it(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_strips(context, 1, 135, 50, 5, 5, 5);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_pages(bytes, size), 2);
    assert_non_null(memmem(bytes, size, "How to read this pattern", 24)); /* in the outline */
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_long_name_does_not_run_into_the_furniture, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(furniture_stays_between_paper_edge_and_printable_area,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(furniture_keeps_out_of_the_pieces_in_narrow_margins,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(furniture_finds_a_pocket_between_the_pieces, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_full_sheet_gets_a_page_that_explains_it, make_context,
                                        drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
