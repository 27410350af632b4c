/* The files: PDF, SVG, PNG, and what can go wrong. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include "tests/render/pdf_words.h"
#include "tests/render/strip.h"
#include "tests/short_memory.h"

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static ktg_pattern *two_on_a4(ktg_context *context) {
    return make_strips(context, 2, 210, 297, 10, 40, 200);
}

static void a_pdf_has_a_page_per_sheet(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = two_on_a4(context);
    ktg_render_options options;
    char *bytes;
    size_t size;
    ktg_render_defaults(&options);
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size), KTG_OK);
    assert_memory_equal(bytes, "%PDF-", 5);
    assert_int_equal(count_pages(bytes, size), 2);
    ktg_free(bytes);
    pattern->piece_count = 1; /* then there is no picture of the model: all of it is vectors */
    pattern->sheet_count = 1;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size), KTG_OK);
    assert_int_equal(count_text(bytes, size, "/Image"), 0);
    ktg_free(bytes);
    pattern->piece_count = pattern->sheet_count = 2;
    ktg_pattern_free(&pattern);
}

static void the_text_of_a_pdf_can_be_searched(void **state) {
    static const char *const words[] = {"strip",
                                        "sheet 1 of 2",
                                        "sheet 2 of 2",
                                        "12.5 mm per unit",
                                        "120 \xc3\x97 40 \xc3\x97 10 mm",
                                        "print at 100 %",
                                        "mountain fold",
                                        "valley fold",
                                        "glue tab",
                                        "100 mm",
                                        "4 in",
                                        "127",
                                        "66.",
                                        "W\xc3\xbcrfel"};
    ktg_context *context = *state;
    if (!installed("pdftotext"))
        skip();
    ktg_pattern *pattern = two_on_a4(context);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    char *text = tell("pdftotext -layout %s -", bytes, size);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strstr(text, words[i]))
            fail_msg("%s is not in the text", words[i]);
    free(text);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void the_outline_says_what_lies_on_each_sheet(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = two_on_a4(context);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_text(bytes, size, "(Sheets)"), 1);
    assert_int_equal(count_text(bytes, size, "(Sheet 1: strip 1 of 2)"), 1);
    assert_int_equal(count_text(bytes, size, "(Sheet 2: strip 2 of 2)"), 1);
    ktg_free(bytes);
    pattern->sheet_count = 1;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_text(bytes, size, "(Sheets)"), 0);
    ktg_free(bytes);
    pattern->sheet_count = 2;
    for (uint32_t k = 0; k < 2; k++) {
        pattern->sheets[k].kind = KTG_TILE;
        pattern->sheets[k].poster = k + 1;
    }
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_text(bytes, size, "(Poster 2: strip 2 of 2)"), 1);
    assert_int_equal(count_text(bytes, size, "(2-A1)"), 1);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void the_fonts_of_a_pdf_are_embedded(void **state) {
    ktg_context *context = *state;
    if (!installed("pdffonts"))
        skip();
    ktg_pattern *pattern = two_on_a4(context);
    char *bytes;
    size_t size, fonts = 0;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    char *text = tell("pdffonts %s", bytes, size), *line = strchr(text, '\n');
    line = strchr(line + 1, '\n'); /* below the heading and its rule */
    for (line = strtok(line, "\n"); line; line = strtok(NULL, "\n"), fonts++)
        assert_non_null(strstr(line, "yes yes yes")); /* embedded, a subset, with its characters */
    assert_true(fonts >= 2);
    free(text);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void a_pdf_says_what_it_is(void **state) {
    ktg_context *context = *state;
    if (!installed("pdfinfo"))
        skip();
    ktg_pattern *pattern = two_on_a4(context);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    char *text = tell("pdfinfo %s", bytes, size);
    assert_non_null(strstr(text, "Creator:         Katagami "));
    assert_non_null(strstr(text, "Title:           strip\n"));
    assert_non_null(strstr(text, "(A4)"));
    free(text);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void the_same_pattern_gives_the_same_bytes(void **state) {
    static const char *const kinds[] = {"pdf", "svg", "png", "contact", "dxf", "astm"};
    ktg_context *context = *state;
    ktg_pattern *pattern = two_on_a4(context);
    for (size_t k = 0; k < 6; k++) {
        char *first, *second;
        size_t first_size, second_size;
        assert_int_equal(render_bytes(context, pattern, kinds[k], 1, NULL, &first, &first_size),
                         KTG_OK);
        assert_int_equal(render_bytes(context, pattern, kinds[k], 1, NULL, &second, &second_size),
                         KTG_OK);
        assert_int_equal(first_size, second_size);
        assert_memory_equal(first, second, first_size);
        ktg_free(first);
        ktg_free(second);
    }
    ktg_pattern_free(&pattern);
}

static void an_svg_is_in_millimetres(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_strips(context, 1, 215.9, 279.4, 10, 40, 200);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "svg", 0, NULL, &bytes, &size), KTG_OK);
    assert_non_null(strstr(bytes, "width=\"215.9mm\" height=\"279.4mm\""));
    assert_non_null(strstr(bytes, "viewBox=\"0 0 215.9 279.4\""));
    /* The outline, one closed path: (120, 0) of the piece lies at (160, 79.4) of the page. */
    const char *outline = strstr(bytes, "d=\"M40 79.4");
    assert_non_null(outline);
    const char *end = strchr(outline + 3, '"'), *tip = strstr(outline, "L165 74.4");
    assert_true(tip && tip < end);
    assert_true(memmem(outline, (size_t)(end - outline), " Z", 2) != NULL);
    assert_int_equal(count_text(outline, (size_t)(end - outline), "L"), 6);
    assert_int_equal(count_text(bytes, size, "inkscape:groupmode=\"layer\""), 7);
    assert_non_null(strstr(bytes, "</svg>"));
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

/* Groups of a DXF: a code and a value, a line each. */
static void a_dxf_says_its_text_so_that_all_can_read_it(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    options.title = "a%%d ^J\n\xc3\xbc\xf0\x9f\xa6\x8a";
    ktg_pattern *pattern = two_on_a4(context);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "dxf", 0, &options, &bytes, &size), KTG_OK);
    assert_non_null(strstr(bytes, "\r\n  1\r\na%%%%d ^ J \\U+00FC? - sheet 1 of 2 - "));
    assert_non_null(strstr(bytes, "  9\r\n$ACADVER\r\n  1\r\nAC1009\r\n"));
    assert_int_equal(count_text(bytes, size, "POLYLINE\r\n  8\r\nCUT\r\n"), 1);
    ktg_free(bytes);
    assert_int_equal(render_bytes(context, pattern, "astm", 0, &options, &bytes, &size), KTG_OK);
    assert_non_null(strstr(bytes, "Style Name: a%%%%d ^ J ??\r\n"));
    assert_int_equal(count_text(bytes, size, "  0\r\nBLOCK\r\n"), 2);
    assert_non_null(strstr(bytes, "  2\r\nSTRIP_2\r\n"));
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void any_title_will_do(void **state) {
    static const char *const titles[] = {"\xff\xfe broken \xc3",
                                         "tab\there\nand\x7f there\x01",
                                         "\xed\xa0\x80 half a pair",
                                         "\xef\xbf\xbf\xf4\x90\x80\x80",
                                         "\xe5\x9e\x8b\xe7\xb4\x99",
                                         " ",
                                         "\\(()%"};
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    ktg_pattern *pattern = two_on_a4(context);
    char *bytes, *endless = malloc(100001);
    size_t size;
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        options.title = titles[i];
        assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size), KTG_OK);
        assert_int_equal(count_pages(bytes, size), 2);
        ktg_free(bytes);
    }
    for (size_t i = 0; i < 100000; i++)
        endless[i] = "\xe2\x82\xac"[i % 3];
    endless[100000] = 0;
    options.title = endless;
    memset(pattern->pieces[0].labels[0].text, 0xc3, sizeof pattern->pieces[0].labels[0].text);
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size), KTG_OK);
    ktg_free(bytes);
    free(endless);
    ktg_pattern_free(&pattern);
}

/* Width and height stand in the header of a PNG, 16 bytes from its start. */
static uint32_t png_number(const char *bytes, size_t at) {
    const unsigned char *b = (const unsigned char *)bytes + at;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static void one_picture_shows_all_sheets(void **state) {
    ktg_context *context = *state;
    ktg_render_options options;
    ktg_render_defaults(&options);
    static const uint32_t counts[] = {1, 5, 40};
    for (size_t k = 0; k < 3; k++) {
        ktg_pattern *pattern = make_strips(context, counts[k], 210, 297, 10, 40, 200);
        char *bytes;
        size_t size;
        options.dots_per_inch = 25.4; /* a pixel for a millimetre */
        assert_int_equal(render_bytes(context, pattern, "contact", 0, &options, &bytes, &size),
                         KTG_OK);
        uint32_t columns = (png_number(bytes, 16) - 8) / 218,
                 rows = (png_number(bytes, 20) - 8) / 305;
        assert_int_equal(png_number(bytes, 16), 8 + 218 * columns);
        assert_int_equal(png_number(bytes, 20), 8 + 305 * rows);
        assert_true(columns * rows >= counts[k] && columns * rows < counts[k] + columns);
        ktg_free(bytes);
        options.dots_per_inch = 600;
        assert_int_equal(render_bytes(context, pattern, "contact", 0, &options, &bytes, &size),
                         KTG_OK);
        assert_int_equal(png_number(bytes, 16) > png_number(bytes, 20) ? png_number(bytes, 16)
                                                                       : png_number(bytes, 20),
                         3000);
        ktg_free(bytes);
        ktg_pattern_free(&pattern);
    }
}

static void what_cannot_be_drawn_is_refused(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = two_on_a4(context);
    ktg_render_options options;
    char *bytes;
    size_t size, sheets = pattern->sheet_count;
    ktg_render_defaults(&options);
    assert_int_equal(render_bytes(context, pattern, "svg", 2, NULL, &bytes, &size), KTG_ARGUMENT);
    assert_int_equal(render_bytes(context, pattern, "png", 2, NULL, &bytes, &size), KTG_ARGUMENT);
    options.dots_per_inch = 0;
    assert_int_equal(render_bytes(context, pattern, "png", 0, &options, &bytes, &size),
                     KTG_ARGUMENT);
    options.dots_per_inch = 1e6;
    assert_int_equal(render_bytes(context, pattern, "png", 0, &options, &bytes, &size), KTG_LIMIT);
    assert_non_null(strstr(ktg_context_message(context), "at most 2802 dots per inch"));
    ktg_render_defaults(&options);
    options.flat_below = -1;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size),
                     KTG_ARGUMENT);
    pattern->sheets[1].height_mm = 6000;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_LIMIT);
    assert_non_null(strstr(ktg_context_message(context), "sheet 2"));
    pattern->sheets[1].height_mm = NAN;
    assert_int_equal(render_bytes(context, pattern, "svg", 0, NULL, &bytes, &size), KTG_ARGUMENT);
    pattern->sheets[1].height_mm = 297;
    pattern->sheets[0].placements[0].piece = 2;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_ARGUMENT);
    pattern->sheets[0].placements[0].piece = 0;
    pattern->pieces[0].outline_count = 0;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_ARGUMENT);
    pattern->pieces[0].outline_count = 7;
    pattern->sheet_count = 0;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_ARGUMENT);
    assert_non_null(strstr(ktg_context_message(context), "lay it out"));
    pattern->sheet_count = sheets;
    ktg_pattern_free(&pattern);
}

static void a_full_disk_is_told(void **state) {
    ktg_context *context = *state;
    if (access("/dev/full", W_OK) != 0)
        skip();
    ktg_pattern *pattern = make_strips(context, 40, 210, 297, 10, 40, 200);
    ktg_render_options options;
    ktg_render_defaults(&options);
    options.dots_per_inch = 300;
    for (int kind = 0; kind < 3; kind++) {
        ktg_output *output = NULL;
        assert_int_equal(ktg_output_open(context, "/dev/full", &output), KTG_OK);
        ktg_status status = kind == 0   ? ktg_render_pdf(context, pattern, &options, output)
                            : kind == 1 ? ktg_render_svg(context, pattern, 0, &options, output)
                                        : ktg_render_png(context, pattern, 0, &options, output);
        if (status == KTG_OK) /* it fits a buffer */
            status = ktg_output_commit(context, &output);
        assert_int_equal(status, KTG_FILE);
        assert_non_null(strstr(ktg_context_message(context), "/dev/full"));
        ktg_output_discard(&output);
    }
    ktg_pattern_free(&pattern);
}

static void short_memory_is_survived(void **state) {
    static const char *const kinds[] = {"pdf", "svg", "png", "contact", "dxf", "astm"};
    ktg_context *context = *state;
    ktg_pattern *pattern = two_on_a4(context);
    for (size_t k = 0; k < 6; k++) {
        ktg_status status = KTG_MEMORY;
        for (uint64_t nth = 1; status != KTG_OK && nth < 200; nth++) {
            char *bytes;
            size_t size;
            ktg_context_fail_allocation(context, nth);
            status = render_bytes(context, pattern, kinds[k], 0, NULL, &bytes, &size);
            assert_true(status == KTG_OK || status == KTG_MEMORY);
            ktg_free(bytes);
        }
        end_short_memory(context, status);
        assert_int_equal(status, KTG_OK);
    }
    ktg_pattern_free(&pattern);
}

static ktg_wish count_down(void *user) {
    int *left = user;
    return --*left < 0 ? KTG_STOP : KTG_GO_ON;
}

static void drawing_can_be_interrupted_anywhere(void **state) {
    static const char *const kinds[] = {"pdf", "png", "svg", "dxf"};
    ktg_context *context = *state;
    ktg_pattern *pattern = two_on_a4(context);
    for (int k = 0; k < 4; k++) {
        ktg_status status = KTG_CANCELLED;
        int asked = 0;
        for (; status == KTG_CANCELLED; asked++) {
            char *bytes = NULL;
            size_t size;
            int left = asked;
            ktg_context_set_cancel(context, count_down, &left);
            status = render_bytes(context, pattern, kinds[k], 0, NULL, &bytes, &size);
            assert_int_equal(status == KTG_OK, left >= 0); /* nobody said stop */
            ktg_free(bytes);
        }
        assert_int_equal(status, KTG_OK);
        assert_true(asked > 1);
    }
    ktg_context_set_cancel(context, NULL, NULL);
    ktg_pattern_free(&pattern);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_pdf_has_a_page_per_sheet, make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_text_of_a_pdf_can_be_searched, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(the_outline_says_what_lies_on_each_sheet, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(the_fonts_of_a_pdf_are_embedded, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_pdf_says_what_it_is, make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_same_pattern_gives_the_same_bytes, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(an_svg_is_in_millimetres, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_dxf_says_its_text_so_that_all_can_read_it, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(any_title_will_do, make_context, drop_context),
        cmocka_unit_test_setup_teardown(one_picture_shows_all_sheets, make_context, drop_context),
        cmocka_unit_test_setup_teardown(what_cannot_be_drawn_is_refused, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_full_disk_is_told, make_context, drop_context),
        cmocka_unit_test_setup_teardown(short_memory_is_survived, make_context, drop_context),
        cmocka_unit_test_setup_teardown(drawing_can_be_interrupted_anywhere, make_context,
                                        drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
