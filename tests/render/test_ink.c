/* Where the ink is: looked at as pixels. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include "tests/render/picture.h"
#include "tests/render/strip.h"

#include <cairo.h>
#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static snapshot take(ktg_context *context, const ktg_pattern *pattern,
                     const ktg_render_options *options) {
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "png", 0, options, &bytes, &size), KTG_OK);
    snapshot taken =
        picture_of(bytes, size, options->dots_per_inch / 25.4, pattern->sheets[0].height_mm);
    assert_int_equal(cairo_surface_status(taken.surface), CAIRO_STATUS_SUCCESS);
    ktg_free(bytes);
    return taken;
}

typedef struct colour {
    int r, g, b;
} colour;

static colour pixel(const snapshot *picture, int x, int y) {
    const unsigned char *row = cairo_image_surface_get_data(picture->surface) +
                               (ptrdiff_t)y * cairo_image_surface_get_stride(picture->surface);
    uint32_t value;
    memcpy(&value, row + 4 * (ptrdiff_t)x, 4);
    return (colour){(int)(value >> 16 & 255), (int)(value >> 8 & 255), (int)(value & 255)};
}

/* The darkest pixel within a hair's breadth of a point of the sheet (mm, y up). */
static colour darkest(const snapshot *picture, double x, double y) {
    int column = (int)floor(x * picture->dots_per_mm),
        row = (int)floor((picture->height_mm - y) * picture->dots_per_mm);
    colour dark = {255, 255, 255};
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            colour c = pixel(picture, column + dx, row + dy);
            if (c.r + c.g + c.b < dark.r + dark.g + dark.b)
                dark = c;
        }
    return dark;
}

static int grey(colour c) {
    return (c.r + c.g + c.b) / 3;
}

static void default_options(ktg_render_options *options) {
    ktg_render_defaults(options);
    options->dots_per_inch = 254; /* 10 to the millimetre */
}

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

static bool has_ink(const snapshot *picture, double x0, double y0, double x1, double y1) {
    for (double y = y0; y < y1; y += 0.9 / picture->dots_per_mm)
        for (double x = x0; x < x1; x += 0.9 / picture->dots_per_mm) {
            int column = (int)(x * picture->dots_per_mm),
                row = (int)((picture->height_mm - y) * picture->dots_per_mm);
            if (grey(pixel(picture, column, row)) < 230)
                return true;
        }
    return false;
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
    assert_false(has_ink(&picture, 201, 200, 209, 280)); /* the right margin */
    assert_true(has_ink(&picture, 190, 265, 199.9, 269));
    cairo_surface_destroy(picture.surface);
    piece->labels[0].at = (ktg_vec2){100, 38};
    piece->labels[0].rotation = KTG_PI / 2;
    picture = take(context, pattern, &options);
    assert_false(has_ink(&picture, 170, 287.3, 180, 287.9)); /* below the title */
    assert_true(has_ink(&picture, 172, 280, 178, 286.9));
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
            assert_false(has_ink(&picture, margin + 0.2, margin + 0.2, width - margin - 0.2,
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
        bool corner = has_ink(&picture, 6, 6, 70, 40) || has_ink(&picture, 140, 6, 204, 40);
        assert_true(corner);
        assert_false(has_ink(&picture, x + 1, y + 1, x + 39, y + 39));
        assert_false(has_ink(&picture, fmax(0, x - 1.5), y + 41, x + 126, fmin(297, y + 41.5)));
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
    assert_true(has_ink(&picture, 6, 47, 254, 153));
    assert_false(has_ink(&picture, 0, 45.5, 260, 46.8)); /* clear of the pieces */
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
    size_t size, pages = 0;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    for (const char *at = bytes; (at = memmem(at, size - (size_t)(at - bytes), "/Type /Page", 11));
         at++)
        pages += at[11] != 's';
    assert_int_equal(pages, 2);
    assert_non_null(memmem(bytes, size, "How to read this pattern", 24)); /* in the outline */
    ktg_free(bytes);
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
    assert_false(has_ink(&picture, 79, 201, 81, 239)); /* the mountain fold of paper */
    assert_true(runs_along_fold(&picture, 20, runs, 100) >= 7);
    assert_int_equal(runs_along_fold(&picture, 60, runs, 100), 3); /* none, grain, none */
    assert_true(has_ink(&picture, 100.5, 207, 102, 208));          /* half an arrow head */
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
    return has_ink(picture, x, 200 + y - 1, x + 0.8, 200 + y + 1);
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
    assert_false(has_ink(&picture, 160.3, 215, 164.5, 225)); /* inside only */
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
    assert_false(has_ink(&picture, 40.3, 200.3, 43, 203)); /* left of the first fold */
    cairo_surface_destroy(picture.surface);
    for (int i = 0; i < 8; i++)
        piece->vertices[i] = ktg_mul2(piece->vertices[i], 4.1 / 3.9);
    picture = take(context, pattern, &options);
    assert_true(has_ink(&picture, 40.3, 200.3, 43, 203));
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
