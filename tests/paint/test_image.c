/* Images: PNG and JPEG come in as they are, smaller versions are means, colours lie between dots.
 */
#include "folder.h"
#include "paint/image.h"
#include "paint/paint.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jpeglib.h>

/* Red grows to the right, green downwards. */
static void fill(uint8_t *rgb, uint32_t width, uint32_t height) {
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            uint8_t *dot = rgb + 3 * (y * width + x);
            dot[0] = (uint8_t)(10 * x);
            dot[1] = (uint8_t)(10 * y);
            dot[2] = 77;
        }
}

static ktg_image *read_back(folder *f, const char *name) {
    ktg_image *image;
    ktg_status status = ktg_image_read(f->context, folder_file(f, name), &image);
    if (status != KTG_OK)
        fail_msg("%s: %s", name, ktg_context_message(f->context));
    return image;
}

static void a_png_comes_in_dot_by_dot(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 5 * 3];
    fill(rgb, 5, 3);
    folder_write_png(f, "a.png", rgb, 5, 3);
    ktg_image *image = read_back(f, "a.png");
    assert_int_equal(image->levels[0].width, 5);
    assert_int_equal(image->levels[0].height, 3);
    assert_memory_equal(image->levels[0].rgb, rgb, sizeof rgb);
    ktg_image_free(&image);
    assert_null(image);
}

static void smaller_versions_are_means(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 5 * 3];
    fill(rgb, 5, 3);
    folder_write_png(f, "a.png", rgb, 5, 3);
    ktg_image *image = read_back(f, "a.png");
    assert_int_equal(image->level_count, 4);
    const ktg_image_level *half = &image->levels[1], *least = &image->levels[3];
    assert_int_equal(half->width, 3);
    assert_int_equal(half->height, 2);
    assert_int_equal(half->rgb[0], 5);          /* of 0 and 10 */
    assert_int_equal(half->rgb[1], 5);          /* of 0 and 10 */
    assert_int_equal(half->rgb[3 * 2], 40);     /* the odd column stands for two */
    assert_int_equal(half->rgb[3 * 3 + 1], 20); /* and so does the odd row */
    assert_int_equal(least->width, 1);
    assert_int_equal(least->rgb[2], 77);
    ktg_image_free(&image);
}

static void a_jpeg_goes_out_and_comes_in(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 24 * 24];
    unsigned char *bytes;
    size_t size;
    fill(rgb, 24, 24);
    assert_int_equal(ktg_paint_jpeg(f->context, rgb, 24, 24, &bytes, &size), KTG_OK);
    folder_write(f, "a.jpg", bytes, size);
    ktg_free(bytes);
    ktg_image *image = read_back(f, "a.jpg");
    assert_int_equal(image->levels[0].width, 24);
    for (size_t i = 0; i < sizeof rgb; i++)
        assert_true(abs(image->levels[0].rgb[i] - rgb[i]) < 9);
    ktg_image_free(&image);
    assert_int_equal(ktg_paint_jpeg(f->context, rgb, 0, 24, &bytes, &size), KTG_ARGUMENT);
    assert_int_equal(ktg_paint_jpeg(f->context, rgb, 70000, 24, &bytes, &size), KTG_ARGUMENT);
}

/* A JPEG as for the press: cyan, magenta, yellow and black, inverted. */
static void write_inks(folder *f, const char *name, uint8_t *inks, uint32_t width,
                       uint32_t height) {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < height; y++) {
        JSAMPROW row = inks + 4 * (size_t)width * y;
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    folder_write(f, name, bytes, size);
    free(bytes);
}

static void a_jpeg_of_inks_is_understood(void **state) {
    folder *f = *state;
    uint8_t inks[4 * 16 * 16];
    for (size_t i = 0; i < 16 * 16; i++) {
        const uint8_t one[4] = {200, 100, 50, i < 8 * 16 ? 255 : 128}; /* darker below */
        memcpy(inks + 4 * i, one, 4);
    }
    write_inks(f, "a.jpg", inks, 16, 16);
    ktg_image *image = read_back(f, "a.jpg");
    const uint8_t *rgb = image->levels[0].rgb;
    for (size_t i = 0; i < 16 * 16; i++)
        for (size_t k = 0; k < 3; k++)
            assert_true(abs(rgb[3 * i + k] - inks[4 * i + k] * inks[4 * i + 3] / 255) < 4);
    ktg_image_free(&image);
}

static void colours_lie_between_dots(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 4 * 4];
    double c[3];
    fill(rgb, 4, 4);
    folder_write_png(f, "a.png", rgb, 4, 4);
    ktg_image *image = read_back(f, "a.png");
    ktg_image_colour(image, 0, (ktg_vec2){1.5, 2.5}, KTG_WRAP_CLAMP, false, c);
    assert_true(c[0] == 10 && c[1] == 20 && c[2] == 77);
    ktg_image_colour(image, 0, (ktg_vec2){2, 2.75}, KTG_WRAP_CLAMP, false, c);
    assert_true(c[0] == 15 && c[1] == 22.5);
    ktg_image_colour(image, 0, (ktg_vec2){1.99, 2.99}, KTG_WRAP_CLAMP, true, c);
    assert_true(c[0] == 10 && c[1] == 20);
    ktg_image_colour(image, 1, (ktg_vec2){1, 1}, KTG_WRAP_CLAMP, false, c);
    assert_true(c[0] == 5 && c[1] == 5);
    ktg_image_free(&image);
}

static void images_repeat_or_end(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 4 * 4];
    double c[3];
    fill(rgb, 4, 4);
    folder_write_png(f, "a.png", rgb, 4, 4);
    ktg_image *image = read_back(f, "a.png");
    ktg_image_colour(image, 0, (ktg_vec2){4, 0.5}, KTG_WRAP_REPEAT, false, c);
    assert_true(c[0] == 15); /* between the last and the first column */
    ktg_image_colour(image, 0, (ktg_vec2){-2.5, 8.5}, KTG_WRAP_REPEAT, true, c);
    assert_true(c[0] == 10 && c[1] == 0);
    ktg_image_colour(image, 0, (ktg_vec2){4, 0.5}, KTG_WRAP_CLAMP, false, c);
    assert_true(c[0] == 30);
    ktg_image_colour(image, 0, (ktg_vec2){-7, 99}, KTG_WRAP_CLAMP, true, c);
    assert_true(c[0] == 0 && c[1] == 30);
    ktg_image_free(&image);
}

static void refuse(folder *f, const char *name, ktg_status wanted, const char *words) {
    ktg_image *image;
    assert_int_equal(ktg_image_read(f->context, folder_file(f, name), &image), wanted);
    assert_null(image);
    assert_non_null(strstr(ktg_context_message(f->context), words));
    assert_non_null(strstr(ktg_context_message(f->context), name));
}

static void what_is_no_image_is_refused(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 20 * 20];
    fill(rgb, 20, 20);
    folder_write_png(f, "whole.png", rgb, 20, 20);
    char bytes[4096];
    FILE *file = fopen(folder_file(f, "whole.png"), "rb");
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    folder_write(f, "half.png", bytes, size / 2);
    folder_write(f, "head.png", bytes, 12);
    folder_write_text(f, "text.png", "GIF89a");
    folder_write(f, "head.jpg", "\xff\xd8\xff\xe0\0\20JFIF\0", 11);
    refuse(f, "half.png", KTG_FORMAT, "damaged");
    refuse(f, "head.png", KTG_FORMAT, "damaged");
    refuse(f, "text.png", KTG_FORMAT, "neither PNG nor JPEG");
    refuse(f, "head.jpg", KTG_FORMAT, "damaged");
    refuse(f, "none.png", KTG_FILE, "none.png");
}

/* The size in the frame header of a JPEG is changed; there are no more data than before. */
static void what_is_too_large_is_refused_before_it_is_decoded(void **state) {
    folder *f = *state;
    uint8_t rgb[3 * 16 * 16];
    unsigned char *bytes;
    size_t size, at = 0;
    fill(rgb, 16, 16);
    assert_int_equal(ktg_paint_jpeg(f->context, rgb, 16, 16, &bytes, &size), KTG_OK);
    while (bytes[at] != 0xff || bytes[at + 1] != 0xc0)
        at++;
    memcpy(bytes + at + 5, "\xea\x60\xea\x60", 4); /* 60000 x 60000 */
    folder_write(f, "huge.jpg", bytes, size);
    ktg_free(bytes);
    refuse(f, "huge.jpg", KTG_LIMIT, "60000 x 60000");
}

static void a_jpeg_that_is_cut_off_is_used_as_far_as_it_goes(void **state) {
    folder *f = *state;
    uint8_t *rgb = calloc(3, 64 * 64);
    unsigned char *bytes;
    size_t size;
    for (size_t i = 0; i < 3 * 64 * 64; i++)
        rgb[i] = (uint8_t)(i * i >> 5);
    assert_int_equal(ktg_paint_jpeg(f->context, rgb, 64, 64, &bytes, &size), KTG_OK);
    folder_write(f, "cut.jpg", bytes, size * 2 / 3);
    ktg_image *image = read_back(f, "cut.jpg");
    assert_non_null(strstr(f->log, "cut.jpg"));
    assert_non_null(strstr(f->log, "warning"));
    ktg_image_free(&image);
    ktg_free(bytes);
    free(rgb);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_png_comes_in_dot_by_dot, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(smaller_versions_are_means, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(a_jpeg_goes_out_and_comes_in, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(a_jpeg_of_inks_is_understood, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(colours_lie_between_dots, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(images_repeat_or_end, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(what_is_no_image_is_refused, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(what_is_too_large_is_refused_before_it_is_decoded,
                                        folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(a_jpeg_that_is_cut_off_is_used_as_far_as_it_goes,
                                        folder_begin, folder_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
