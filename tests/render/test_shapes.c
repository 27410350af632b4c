/* Surfaces side by side in a PNG. */
#include "render/draw.h"
#include "tests/short_memory.h"

#include <cairo.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const ktg_vec3 corners[] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
static const uint32_t faces[] = {0, 1, 2, 0, 2, 3};

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

/* Draws and reads the picture back. */
static cairo_surface_t *draw(ktg_context *context, const ktg_render_shape *shapes, size_t count) {
    char path[] = "/tmp/ktg-shapes-XXXXXX";
    ktg_output *output = NULL;
    close(mkstemp(path));
    assert_int_equal(ktg_output_open(context, path, &output), KTG_OK);
    assert_int_equal(ktg_render_shapes(context, shapes, count, 1, output), KTG_OK);
    assert_int_equal(ktg_output_commit(context, &output), KTG_OK);
    cairo_surface_t *picture = cairo_image_surface_create_from_png(path);
    unlink(path);
    assert_int_equal(cairo_surface_status(picture), CAIRO_STATUS_SUCCESS);
    return picture;
}

/* How many dots of each half are not white. */
static void count_ink(cairo_surface_t *picture, uint64_t ink[2]) {
    int width = cairo_image_surface_get_width(picture);
    ink[0] = ink[1] = 0;
    for (int y = 0; y < cairo_image_surface_get_height(picture); y++) {
        const unsigned char *row = cairo_image_surface_get_data(picture) +
                                   (ptrdiff_t)y * cairo_image_surface_get_stride(picture);
        for (int x = 0; x < width; x++)
            ink[2 * x >= width] += row[4 * x] != 255;
    }
}

static void both_are_drawn_at_one_scale(void **state) {
    static const ktg_vec3 smaller[] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    const ktg_render_shape shapes[] = {{4, 2, corners, faces, NULL}, {4, 2, smaller, faces, NULL}};
    uint64_t ink[2];
    cairo_surface_t *picture = draw(*state, (const ktg_render_shape[]){shapes[0], shapes[0]}, 2);
    count_ink(picture, ink);
    assert_true(ink[0] > 10000 && fabs((double)ink[0] / (double)ink[1] - 1) < 0.02);
    cairo_surface_destroy(picture);
    picture = draw(*state, shapes, 2);
    count_ink(picture, ink);
    uint64_t all = ink[0] + ink[1], width = (uint64_t)cairo_image_surface_get_width(picture);
    assert_true(all > 10000 && width < 1500);
    cairo_surface_destroy(picture);
}

static void faces_have_their_tints(void **state) {
    static const uint32_t red[] = {0xff0000, 0xff0000};
    const ktg_render_shape shape = {4, 2, corners, faces, red};
    cairo_surface_t *picture = draw(*state, &shape, 1);
    const unsigned char *middle = cairo_image_surface_get_data(picture) +
                                  (ptrdiff_t)(cairo_image_surface_get_height(picture) / 3) *
                                      cairo_image_surface_get_stride(picture) +
                                  4 * (ptrdiff_t)(cairo_image_surface_get_width(picture) / 2);
    assert_true(middle[2] > 150 && middle[1] < 20 && middle[0] < 20);
    cairo_surface_destroy(picture);
}

static void what_cannot_be_drawn_is_refused(void **state) {
    static const ktg_vec3 lost[] = {{0, 0, 0}, {4, 0, 0}, {4, NAN, 0}, {0, 4, 0}};
    static const uint32_t wrong[] = {0, 1, 4, 0, 2, 3};
    const ktg_render_shape shapes[] = {
        {4, 2, lost, faces, NULL}, {4, 2, corners, wrong, NULL}, {0, 0, corners, faces, NULL}};
    ktg_output *output = NULL;
    assert_int_equal(ktg_output_open(*state, "/dev/null", &output), KTG_OK);
    for (int i = 0; i < 3; i++)
        assert_int_equal(ktg_render_shapes(*state, &shapes[i], 1, 1, output), KTG_ARGUMENT);
    const ktg_render_shape good = {4, 2, corners, faces, NULL};
    assert_int_equal(ktg_render_shapes(*state, &good, 1, 3, output), KTG_ARGUMENT);
    for (uint64_t k = 1, failed = 1; failed; k++) {
        ktg_context_fail_allocation(*state, k);
        ktg_status status = ktg_render_shapes(*state, &good, 1, 1, output);
        failed = status != KTG_OK;
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        end_short_memory(*state, status);
    }
    ktg_output_discard(&output);
}

/* What cairo says, and how it is told. */
static void cairos_failures_become_ours(void **state) {
    static const struct {
        cairo_status_t cairo;
        ktg_status status;
        const char *words;
    } failures[] = {
        {CAIRO_STATUS_NO_MEMORY, KTG_MEMORY, "out of memory while drawing the sheet"},
        {CAIRO_STATUS_INVALID_SIZE, KTG_LIMIT, "the sheet would be too large"},
        {CAIRO_STATUS_SURFACE_FINISHED, KTG_INTERNAL, "drawing the sheet failed: "},
    };
    ktg_sink sink = {*state, NULL, KTG_OK};
    assert_int_equal(ktg_cairo_status(*state, &sink, CAIRO_STATUS_SUCCESS, "it"), KTG_OK);
    for (size_t i = 0; i < sizeof failures / sizeof *failures; i++) {
        assert_int_equal(ktg_cairo_status(*state, NULL, failures[i].cairo, "the sheet"),
                         failures[i].status);
        assert_non_null(strstr(ktg_context_message(*state), failures[i].words));
    }
}

static void a_full_disk_is_told_by_what_was_written_to(void **state) {
    ktg_output *output = NULL;
    unsigned char bytes[100000] = {0};
    assert_int_equal(ktg_output_open(*state, "/dev/full", &output), KTG_OK);
    ktg_sink sink = {*state, output, KTG_OK};
    assert_int_equal(ktg_sink_write(&sink, bytes, sizeof bytes), CAIRO_STATUS_WRITE_ERROR);
    assert_int_equal(ktg_sink_write(&sink, bytes, 1), CAIRO_STATUS_WRITE_ERROR);
    assert_int_equal(ktg_cairo_status(*state, &sink, CAIRO_STATUS_WRITE_ERROR, "it"), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(*state), "/dev/full: cannot be written: No space"));
    ktg_output_discard(&output);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(both_are_drawn_at_one_scale, make_context, drop_context),
        cmocka_unit_test_setup_teardown(faces_have_their_tints, make_context, drop_context),
        cmocka_unit_test_setup_teardown(what_cannot_be_drawn_is_refused, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(cairos_failures_become_ours, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_full_disk_is_told_by_what_was_written_to, make_context,
                                        drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
