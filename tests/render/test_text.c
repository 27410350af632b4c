/* Text that is always valid. */
#include "render/draw.h"
#include "render/text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define LOST "\xef\xbf\xbd" /* U+FFFD */

static void what_is_no_utf8_is_replaced(void **state) {
    static const char *const cases[][2] = {
        {"fox", "fox"},
        {"", ""},
        {"\xe5\x9e\x8b\xe7\xb4\x99", "\xe5\x9e\x8b\xe7\xb4\x99"},
        {"\xf0\x9f\xa6\x8a", "\xf0\x9f\xa6\x8a"},
        {"a\xff"
         "b",
         "a" LOST "b"},
        {"\xc3", LOST},
        {"\xc3(", LOST "("},
        {"\xc0\xaf", LOST LOST}, /* overlong */
        {"\xe0\x80\xaf", LOST LOST LOST},
        {"\xed\xa0\x80", LOST LOST LOST},          /* surrogate */
        {"\xf4\x90\x80\x80", LOST LOST LOST LOST}, /* beyond U+10FFFF */
        {"\xef\xbf\xbf", LOST LOST LOST},          /* U+FFFF, which cairo refuses */
        {"\xef\xb7\x90", LOST LOST LOST},          /* U+FDD0 */
        {"a\tb\nc\x7f\xc2\x85"
         "d",
         "a b c  d"},
        {"\xe2\x80\xa8", " "}, /* line separator */
        {"a\xe2\x80\xae"
         "b\xe2\x81\xa6"
         "c\xef\xbb\xbf",
         "abc"}, /* marks of direction */
    };
    char clean[64];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ktg_text_clean(cases[i][0], SIZE_MAX, clean, sizeof clean);
        assert_string_equal(clean, cases[i][1]);
    }
}

#define ALEF  "\xd7\x90"
#define BET   "\xd7\x91"
#define GIMEL "\xd7\x92"

static void letters_from_right_to_left_stand_in_their_order(void **state) {
    static const char *const cases[][2] = {
        {"fox 12", "fox 12"},
        {ALEF BET GIMEL, GIMEL BET ALEF},
        {"a " ALEF BET " b", "a " BET ALEF " b"},
        {ALEF BET " " GIMEL ALEF "!", ALEF GIMEL " " BET ALEF "!"},
        {ALEF " 12 " BET, BET " 12 " ALEF},
        {ALEF " 2 of 3", ALEF " 2 of 3"},
        {ALEF " (" BET ") " GIMEL, GIMEL " (" BET ") " ALEF},
        {"\xe5\x9e\x8b\xf0\x9f\xa6\x8a" ALEF BET, "\xe5\x9e\x8b\xf0\x9f\xa6\x8a" BET ALEF},
    };
    char ordered[KTG_TITLE_SIZE], endless[2 * KTG_TITLE_SIZE];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(ktg_text_order(cases[i][0], ordered), cases[i][1]);
    for (size_t i = 0; i + 1 < sizeof endless; i++)
        endless[i] = ALEF[i % 2];
    endless[sizeof endless - 1] = 0;
    assert_ptr_equal(ktg_text_order(endless, ordered), endless);
    endless[KTG_TITLE_SIZE - 2] = 0;
    assert_string_equal(ktg_text_order(endless, ordered), endless);
}

static void text_is_cut_between_characters(void **state) {
    char clean[6];
    (void)state;
    ktg_text_clean("ab\xe2\x82\xac\xe2\x82\xac", SIZE_MAX, clean, sizeof clean);
    assert_string_equal(clean, "ab\xe2\x82\xac");
    ktg_text_clean("abc\xe2\x82\xac", SIZE_MAX, clean, sizeof clean);
    assert_string_equal(clean, "abc");
    ktg_text_clean("abcdefgh", 2, clean, sizeof clean);
    assert_string_equal(clean, "ab");
}

static void noise_is_made_text_cairo_takes(void **state) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 100, 100);
    cairo_t *cairo = cairo_create(surface);
    char noise[40], clean[100];
    (void)state;
    srand(7);
    for (int round = 0; round < 20000; round++) {
        for (size_t i = 0; i < sizeof noise; i++)
            noise[i] = (char)(rand() % 4 ? 0x80 + rand() % 128 : rand() % 256);
        ktg_text_clean(noise, sizeof noise, clean, sizeof clean);
        if (round % 100 == 0)
            (void)ktg_text_width(cairo, clean);
        char again[100];
        ktg_text_clean(clean, SIZE_MAX, again, sizeof again);
        assert_string_equal(again, clean);
    }
    assert_int_equal(cairo_status(cairo), CAIRO_STATUS_SUCCESS);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
}

static void long_text_ends_with_an_ellipsis(void **state) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 100, 100);
    cairo_t *cairo = cairo_create(surface);
    char text[64];
    (void)state;
    ktg_page_begin(cairo);
    ktg_text_set(cairo, KTG_FACE_PLAIN, 2.4);
    strcpy(text, "W\xc3\xbcrfel mit Augen");
    double whole = ktg_text_width(cairo, text);
    ktg_text_shorten(cairo, whole + 0.1, text, sizeof text);
    assert_string_equal(text, "W\xc3\xbcrfel mit Augen");
    ktg_text_shorten(cairo, whole / 2, text, sizeof text);
    assert_true(ktg_text_width(cairo, text) <= whole / 2);
    assert_true(strlen(text) > 6 && strcmp(text + strlen(text) - 3, "\xe2\x80\xa6") == 0);
    ktg_text_shorten(cairo, 0.1, text, sizeof text);
    assert_string_equal(text, "");
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_utf8_is_replaced),
        cmocka_unit_test(letters_from_right_to_left_stand_in_their_order),
        cmocka_unit_test(text_is_cut_between_characters),
        cmocka_unit_test(noise_is_made_text_cairo_takes),
        cmocka_unit_test(long_text_ends_with_an_ellipsis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
