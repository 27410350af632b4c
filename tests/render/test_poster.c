/* What helps to put things together: marks where the tiles of a poster join, the cover with their
 * map, a picture of the finished model. */
#include "render/draw.h"
#include "render/more_pages.h"
#include "render/poster.h"

#include <setjmp.h>
#include <stdarg.h>

#include "tests/render/pdf_words.h"
#include "tests/render/picture.h"
#include "tests/render/strip.h"

#include <cmocka.h>

#define STEP_MM 70.0

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

/* A strip of 125 mm on two tiles that show 80 x 80 mm each. */
static ktg_pattern *make_poster(ktg_context *context) {
    ktg_pattern *pattern = make_strips(context, 2, 100, 100, 10, 12, 35);
    for (uint32_t k = 0; k < 2; k++) {
        ktg_pattern_sheet *tile = &pattern->sheets[k];
        tile->kind = KTG_TILE;
        tile->poster = 1;
        tile->column = k;
        tile->placements->piece = 0;
        tile->placements->x -= STEP_MM * k;
    }
    return pattern;
}

static snapshot take(ktg_context *context, const ktg_pattern *pattern, size_t sheet) {
    ktg_render_options options;
    char *bytes;
    size_t size;
    ktg_render_defaults(&options);
    options.dots_per_inch = 254;
    assert_int_equal(render_bytes(context, pattern, "png", sheet, &options, &bytes, &size), KTG_OK);
    snapshot taken = picture_of(bytes, size, 10, pattern->sheets[sheet].height_mm);
    ktg_free(bytes);
    return taken;
}

static void a_tile_shows_its_printable_area_only(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_poster(context);
    snapshot first = take(context, pattern, 0), second = take(context, pattern, 1);
    assert_true(picture_has_ink(&first, 88, 34, 90, 36)); /* the outline's lower side */
    assert_false(picture_has_ink(&first, 90.3, 34, 94, 36));
    assert_true(picture_has_ink(&second, 10.2, 74, 12, 76));
    assert_false(picture_has_ink(&second, 7, 74, 9.7, 76));
    picture_drop(&first);
    picture_drop(&second);
    ktg_pattern_free(&pattern);
}

static void neighbours_join_where_the_crosses_meet(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_poster(context);
    snapshot first = take(context, pattern, 0), second = take(context, pattern, 1);
    for (int k = 0; k < 2; k++) {
        double y = k ? 70 : 30; /* 25 and 75 % of the printable height */
        /* Both arms of a cross, at the join of the one and at the trim of the other. */
        for (int side = -1; side <= 1; side += 2) {
            assert_true(picture_has_ink(&first, 80 + side * 1.7 - 0.3, y + 1.4,
                                        80 + side * 1.7 + 0.3, y + 2));
            assert_true(picture_has_ink(&second, 10 + side * 1.7 - 0.3, y + 1.4,
                                        10 + side * 1.7 + 0.3, y + 2));
        }
    }
    assert_true(picture_has_ink(&first, 79.8, 77, 80.2, 90));   /* dashed */
    assert_true(picture_has_ink(&second, 9.9, 76, 10.1, 76.2)); /* all along */
    assert_true(picture_has_ink(&second, 9.9, 88, 10.1, 88.2));
    assert_false(picture_has_ink(&first, 8, 71.5, 10.2, 89)); /* no neighbour at the left */
    assert_false(picture_has_ink(&second, 79, 71.5, 81, 89)); /* nor at the right */
    picture_drop(&first);
    picture_drop(&second);
    ktg_pattern_free(&pattern);
}

/* In the middle of the join, 2.2 mm inside; name, 0.8 mm, arrow outwards. */
static void the_neighbours_name_stands_behind_its_arrow(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_poster(context);
    snapshot first = take(context, pattern, 0), second = take(context, pattern, 1);
    assert_false(picture_has_ink(&first, 80.5, 48.5, 82, 51.5));
    assert_true(picture_has_ink(&first, 82.2, 49, 83.2, 51)); /* to the right of the join */
    assert_true(picture_has_ink(&second, 12.3, 49.8, 13.9, 50.2));
    assert_false(picture_has_ink(&second, 14.2, 48.5, 14.7, 51.5));
    assert_true(picture_has_ink(&second, 14.8, 49, 16.5, 51));
    picture_drop(&first);
    picture_drop(&second);
    ktg_pattern_free(&pattern);
}

static void tiles_are_named_by_row_and_column(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_poster(context);
    ktg_drawing *drawing;
    char name[KTG_NAME_SIZE];
    assert_int_equal(ktg_drawing_new(context, pattern, NULL, &drawing), KTG_OK);
    ktg_tile_name(drawing, &pattern->sheets[1], name);
    assert_string_equal(name, "A2");
    pattern->sheets[1].row = 27;
    ktg_tile_name(drawing, &pattern->sheets[1], name);
    assert_string_equal(name, "AB2");
    pattern->sheets[1].poster = 3;
    ktg_tile_name(drawing, &pattern->sheets[1], name);
    assert_string_equal(name, "3-AB2");
    assert_int_equal(ktg_poster_count(pattern), 3);
    ktg_drawing_free(&drawing);
    ktg_pattern_free(&pattern);
}

static void a_cover_with_the_maps_comes_first(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_poster(context);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_pages(bytes, size) - count_text(bytes, size, "How to read"), 1 + 2);
    assert_int_equal(count_text(bytes, size, "(cover)"), 1);
    ktg_free(bytes);
    pattern->sheets[1].poster = 13; /* six maps a page */
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_pages(bytes, size) - count_text(bytes, size, "How to read"), 3 + 2);
    ktg_free(bytes);
    for (uint32_t k = 0; k < 2; k++)
        pattern->sheets[k].poster = 0; /* tiles of which nothing is told are drawn, too */
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    assert_int_equal(count_text(bytes, size, "(cover"), 0);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void the_map_names_its_tiles(void **state) {
    static const char *const words[] = {"A1", "A2", "sheet 1", "sheet 2"};
    ktg_context *context = *state;
    if (!installed("pdftotext"))
        skip();
    ktg_pattern *pattern = make_poster(context);
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, NULL, &bytes, &size), KTG_OK);
    char *text = tell("pdftotext -l 1 -layout %s -", bytes, size); /* the cover */
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strstr(text, words[i]))
            fail_msg("%s is not on the cover: %s", words[i], text);
    free(text);
    ktg_free(bytes);
    ktg_pattern_free(&pattern);
}

static void several_pieces_come_with_a_picture_on_the_last_sheet(void **state) {
    ktg_context *context = *state;
    ktg_pattern *pattern = make_strips(context, 2, 210, 297, 10, 40, 200);
    snapshot first = take(context, pattern, 0), last = take(context, pattern, 1);
    assert_false(picture_has_ink(&first, 10.5, 10.5, 199, 190));
    assert_true(picture_has_ink(&last, 10.5, 10.5, 135, 75));
    picture_drop(&first);
    picture_drop(&last);
    pattern->mode = KTG_CLOTH;
    last = take(context, pattern, 1);
    assert_false(picture_has_ink(&last, 10.5, 10.5, 199, 190));
    picture_drop(&last);
    ktg_pattern_free(&pattern);
    pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    last = take(context, pattern, 0);
    assert_false(picture_has_ink(&last, 10.5, 10.5, 199, 190));
    picture_drop(&last);
    ktg_pattern_free(&pattern);
}

/* The strip of y = 0 .. 40 and z = 0, 10: what is up is higher in the picture. */
static void the_picture_stands_upright(void **state) {
    ktg_context *context = *state;
    for (unsigned up = 0; up < 3; up++) {
        ktg_pattern *pattern = make_strips(context, 2, 210, 297, 10, 40, 200);
        for (uint32_t v = 0; v < pattern->vertex_count; v++) {
            ktg_vec3 *p = &pattern->vertices[v]; /* a thin pole along the axis */
            double along = v < 8 ? 100.0 * (v % 2) : 0;
            *p = (ktg_vec3){v & 2, v & 4, (v ^ 3) & 2};
            *(up == 0 ? &p->x : up == 1 ? &p->y : &p->z) = along;
        }
        ktg_render_options options;
        ktg_drawing *drawing;
        ktg_render_defaults(&options);
        options.up = up;
        assert_int_equal(ktg_drawing_new(context, pattern, &options, &drawing), KTG_OK);
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 100, 100);
        cairo_t *cairo = cairo_create(surface);
        cairo_set_source_rgb(cairo, 1, 1, 1);
        cairo_paint(cairo);
        ktg_page_begin(cairo);
        assert_int_equal(ktg_solid_draw(drawing, cairo, (ktg_area){0, 0, 100, 100}, false), KTG_OK);
        cairo_destroy(cairo);
        cairo_surface_flush(surface);
        snapshot p = {surface, 100, 100, 1, 100};
        assert_true(picture_has_ink(&p, 45, 2, 55, 8) && picture_has_ink(&p, 45, 92, 55, 98));
        assert_false(picture_has_ink(&p, 0, 0, 30, 100) || picture_has_ink(&p, 70, 0, 100, 100));
        picture_drop(&p);
        ktg_drawing_free(&drawing);
        ktg_pattern_free(&pattern);
    }
    ktg_pattern *pattern = make_strips(context, 1, 210, 297, 10, 40, 200);
    ktg_render_options options;
    char *bytes;
    size_t size;
    ktg_render_defaults(&options);
    options.up = 3;
    assert_int_equal(render_bytes(context, pattern, "pdf", 0, &options, &bytes, &size),
                     KTG_ARGUMENT);
    ktg_pattern_free(&pattern);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(a_tile_shows_its_printable_area_only),
        CASE(neighbours_join_where_the_crosses_meet),
        CASE(the_neighbours_name_stands_behind_its_arrow),
        CASE(tiles_are_named_by_row_and_column),
        CASE(the_map_names_its_tiles),
        CASE(several_pieces_come_with_a_picture_on_the_last_sheet),
        CASE(the_picture_stands_upright),
        CASE(a_cover_with_the_maps_comes_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
