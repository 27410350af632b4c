/* The pages that tell how to build the model. */
#include "pdf_words.h"
#include "picture.h"
#include "strip.h"

#include "render/build_guide.h"
#include "render/draw.h"
#include "render/text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

/* Strips whose ends meet, each a body with a seam of its own: a step for each. */
static ktg_pattern *make_rings(ktg_context *context, uint32_t count) {
    ktg_pattern *p = make_strips(context, count, 210, 297, 10, 40, 200);
    p->component_count = count;
    p->components = ktg_new(context, count, ktg_pattern_component);
    p->seam_count = count;
    p->seams = ktg_new(context, count, ktg_pattern_seam);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t edge = 3 * i + 2;
        char text[16];
        p->components[i].name = ktg_copy_text(context, "ring", 4);
        p->pieces[i].component = i;
        p->seams[i] = (ktg_pattern_seam){.edge_count = 1,
                                         .edges = ktg_copy_array(context, &edge, 1, sizeof edge),
                                         .first_side = ktg_new(context, 1, uint8_t),
                                         .pieces = {i, i},
                                         .number = i + 1,
                                         .section = i + 1,
                                         .closing = true};
        p->edges[edge].seam = i;
        snprintf(text, sizeof text, "%u", i + 1);
        for (size_t k = 0; k < 2; k++)
            memcpy(p->pieces[i].labels[k].text, text, sizeof text);
    }
    return p;
}

static size_t printed_pages(ktg_context *context, const ktg_pattern *pattern, bool guide) {
    ktg_render_options options;
    char *bytes;
    size_t size;
    ktg_render_defaults(&options);
    options.guide = guide;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size), KTG_OK);
    assert_int_equal(count_text(bytes, size, "How to build it"), guide); /* in the outline */
    size_t pages = count_pages(bytes, size);
    ktg_free(bytes);
    return pages;
}

static void a_guide_comes_last_unless_it_is_not_wished_for(void **state) {
    ktg_pattern *pattern = make_rings(*state, 1);
    assert_int_equal(printed_pages(*state, pattern, false), 1);
    assert_int_equal(printed_pages(*state, pattern, true), 2);
    ktg_pattern_free(&pattern);
}

static void a_guide_says_of_what_it_is_and_what_there_is_to_do(void **state) {
    static const char *const words[] = {"How to build it",      "strip",
                                        "3 pieces on 3 sheets", "3 seams with numbers, 3 steps",
                                        "Tools: scissors",      "From the front",
                                        "From behind"};
    if (!installed("pdftotext"))
        skip();
    ktg_pattern *pattern = make_rings(*state, 3);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(*state, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    char *text = tell("pdftotext -f 4 -layout %s -", bytes, size); /* behind the sheets */
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strstr(text, words[i]))
            fail_msg("%s is not in the guide: %s", words[i], text);
    assert_non_null(strstr(text, "How to build it\nstrip\n"));
    free(text);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void a_hundred_bodies_take_a_few_pages(void **state) {
    ktg_pattern *pattern = make_rings(*state, 100);
    size_t sheets = printed_pages(*state, pattern, false);
    size_t pages = printed_pages(*state, pattern, true) - sheets;
    assert_true(pages >= 2 && pages <= 8);
    ktg_pattern_free(&pattern);
}

static void tiny_and_huge_sheets_have_a_guide_on_a4(void **state) {
    static const double sizes[][3] = {{60, 60, 1}, {3000, 900, 1}, {148, 210, 0}, {297, 420, 0}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        ktg_pattern *pattern = make_rings(*state, 1);
        ktg_drawing *drawing;
        double width, height;
        pattern->sheets[0].width_mm = sizes[i][0];
        pattern->sheets[0].height_mm = sizes[i][1];
        assert_int_equal(ktg_drawing_new(*state, pattern, NULL, &drawing), KTG_OK);
        ktg_build_guide_size(drawing, &width, &height);
        assert_true(width == (sizes[i][2] ? 210 : sizes[i][0]));
        assert_true(height == (sizes[i][2] ? 297 : sizes[i][1]));
        ktg_drawing_free(&drawing);
        ktg_pattern_free(&pattern);
    }
}

/* Draws the guide's pages; returns how many, the first one in *picture. */
static size_t draw(const ktg_drawing *drawing, double width, double height,
                   cairo_surface_t **picture) {
    ktg_build_guide *guide;
    size_t pages = 0;
    assert_int_equal(ktg_build_guide_new(drawing, &guide), KTG_OK);
    for (; !ktg_build_guide_is_done(guide); pages++) {
        cairo_surface_t *surface =
            cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)(4 * width), (int)(4 * height));
        cairo_t *cairo = cairo_create(surface);
        cairo_set_source_rgb(cairo, 1, 1, 1);
        cairo_paint(cairo);
        cairo_scale(cairo, 4, 4);
        assert_int_equal(ktg_build_guide_draw(guide, cairo, width, height), KTG_OK);
        cairo_destroy(cairo);
        if (pages == 0)
            *picture = surface;
        else
            cairo_surface_destroy(surface);
        assert_true(pages < 100);
    }
    ktg_build_guide_free(&guide);
    return pages;
}

static size_t count_colour(cairo_surface_t *picture, bool (*is)(int red, int green, int blue)) {
    size_t count = 0;
    cairo_surface_flush(picture);
    for (int y = 0; y < cairo_image_surface_get_height(picture); y++)
        for (int x = 0; x < cairo_image_surface_get_width(picture); x++) {
            uint32_t dot;
            memcpy(&dot,
                   cairo_image_surface_get_data(picture) +
                       (ptrdiff_t)y * cairo_image_surface_get_stride(picture) + 4 * (ptrdiff_t)x,
                   4);
            count += is((int)(dot >> 16 & 255), (int)(dot >> 8 & 255), (int)(dot & 255));
        }
    return count;
}

static bool is_seam(int red, int green, int blue) {
    return red > 150 && green < 80 && blue < 80;
}

static bool is_coloured(int red, int green, int blue) {
    return red != green || green != blue;
}

static bool is_grey(int red, int green, int blue) {
    return red == green && green == blue && red > 100 && red < 250;
}

/* The seam of the step is drawn as a thick red line, and black print has no colours at all. */
static void a_word_wider_than_the_page_ends_with_its_column(void **state) {
    ktg_pattern *pattern = make_rings(*state, 1);
    ktg_drawing *drawing;
    char word[81];
    memset(word, 'W', 80);
    word[80] = 0;
    assert_int_equal(ktg_drawing_new(*state, pattern, NULL, &drawing), KTG_OK);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 420, 594);
    cairo_t *cairo = cairo_create(surface);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    cairo_scale(cairo, 2, 2);
    ktg_column at = ktg_column_begin(drawing, cairo, 210, 297);
    double right = at.x + at.width;
    ktg_column_wrap(&at, KTG_FACE_PLAIN, 4, word, false);
    cairo_destroy(cairo);
    cairo_surface_flush(surface);
    snapshot p = {surface, 420, 594, 2, 297};
    assert_true(picture_has_ink(&p, right - 10, 260, right, 297));
    assert_false(picture_has_ink(&p, right + 1, 0, 210, 297));
    picture_drop(&p);
    ktg_drawing_free(&drawing);
    ktg_pattern_free(&pattern);
}

static void steps_show_their_seams(void **state) {
    ktg_pattern *pattern = make_rings(*state, 1);
    ktg_render_options options;
    ktg_drawing *drawing;
    cairo_surface_t *picture = NULL;
    ktg_render_defaults(&options);
    for (int colour = 0; colour < 2; colour++) {
        options.colour = colour;
        assert_int_equal(ktg_drawing_new(*state, pattern, &options, &drawing), KTG_OK);
        assert_int_equal(draw(drawing, 210, 297, &picture), 1);
        assert_int_equal(count_colour(picture, is_seam) > 100, colour);
        assert_int_equal(count_colour(picture, is_coloured) > 1000, colour);
        assert_true(colour || count_colour(picture, is_coloured) == 0);
        assert_true(colour || count_colour(picture, is_grey) > 10000);
        cairo_surface_destroy(picture);
        ktg_drawing_free(&drawing);
    }
    ktg_pattern_free(&pattern);
}

static void a_page_too_small_for_a_row_has_one_anyway(void **state) {
    ktg_pattern *pattern = make_rings(*state, 5);
    ktg_drawing *drawing;
    cairo_surface_t *picture = NULL;
    assert_int_equal(ktg_drawing_new(*state, pattern, NULL, &drawing), KTG_OK);
    size_t pages = draw(drawing, 60, 40, &picture);
    assert_true(pages >= 5 && pages <= 12);
    cairo_surface_destroy(picture);
    ktg_drawing_free(&drawing);
    ktg_pattern_free(&pattern);
}

/* Two seams that meet: the first begins at its other end, the second at either. */
static void a_seam_begins_where_all_else_is_closed(void **state) {
    ktg_pattern *pattern = make_rings(*state, 2);
    ktg_drawing *drawing;
    ktg_build_guide *guide;
    pattern->edges[5].vertices[0] = pattern->edges[2].vertices[0];
    assert_int_equal(ktg_drawing_new(*state, pattern, NULL, &drawing), KTG_OK);
    assert_int_equal(ktg_build_guide_new(drawing, &guide), KTG_OK);
    assert_int_equal(guide->starts[0], pattern->edges[2].vertices[1]);
    assert_int_equal(guide->starts[1], KTG_NONE);
    ktg_build_guide_free(&guide);
    ktg_drawing_free(&drawing);
    ktg_pattern_free(&pattern);
}

/* Of a pattern that says nothing about steps, as older files do, the model is shown. */
static void without_sections_there_is_the_model(void **state) {
    ktg_pattern *pattern = make_rings(*state, 2);
    ktg_drawing *drawing;
    cairo_surface_t *picture = NULL;
    for (size_t s = 0; s < 2; s++)
        pattern->seams[s].section = s ? 4000000000u : 0; /* nor of one that talks nonsense */
    assert_int_equal(ktg_drawing_new(*state, pattern, NULL, &drawing), KTG_OK);
    assert_int_equal(draw(drawing, 210, 297, &picture), 1);
    assert_true(count_colour(picture, is_coloured) > 1000);
    assert_int_equal(count_colour(picture, is_seam), 0);
    cairo_surface_destroy(picture);
    ktg_drawing_free(&drawing);
    ktg_pattern_free(&pattern);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_guide_comes_last_unless_it_is_not_wished_for),
        cmocka_unit_test(a_guide_says_of_what_it_is_and_what_there_is_to_do),
        cmocka_unit_test(a_hundred_bodies_take_a_few_pages),
        cmocka_unit_test(tiny_and_huge_sheets_have_a_guide_on_a4),
        cmocka_unit_test(a_word_wider_than_the_page_ends_with_its_column),
        cmocka_unit_test(steps_show_their_seams),
        cmocka_unit_test(a_page_too_small_for_a_row_has_one_anyway),
        cmocka_unit_test(a_seam_begins_where_all_else_is_closed),
        cmocka_unit_test(without_sections_there_is_the_model),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
