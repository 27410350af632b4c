/* Context, allocation, files. */
#include "core/file.h"
#include "core/memory.h"
#include "core/predicate.h"
#include "core/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static void a_failure_leaves_its_text(void **state) {
    ktg_context *context = *state;
    assert_string_equal(ktg_context_message(context), "");
    assert_int_equal(ktg_fail(context, KTG_FORMAT, "line %d", 7), KTG_FORMAT);
    assert_string_equal(ktg_context_message(context), "line 7");
    assert_string_equal(ktg_status_name(KTG_FORMAT), "format");
    assert_string_equal(ktg_status_name(KTG_INTERNAL), "internal");
    assert_string_equal(ktg_status_name((ktg_status)(KTG_INTERNAL + 1)), "unknown");
    assert_string_equal(ktg_status_name((ktg_status)99), "unknown");
}

static void hear(void *user, ktg_log_level level, const char *text) {
    snprintf(user, 64, "%d %s", (int)level, text);
}

static void the_log_gets_lines_while_there_is_one(void **state) {
    ktg_context *context = *state;
    char heard[64] = "nothing";
    ktg_log(context, KTG_LOG_NOTE, "to nobody");
    ktg_context_set_log(context, hear, heard);
    assert_string_equal(heard, "nothing");
    ktg_log(context, KTG_LOG_WARNING, "%.1f of %s", 0.5, "it");
    assert_string_equal(heard, "1 0.5 of it");
    ktg_context_set_log(context, NULL, NULL);
    ktg_log(context, KTG_LOG_NOTE, "to nobody");
    assert_string_equal(heard, "1 0.5 of it");
}

static void a_long_message_keeps_its_beginning_and_its_end(void **state) {
    ktg_context *context = *state;
    size_t length = 30000;
    char *path = calloc(length + 1, 1);
    for (size_t i = 0; i + 1 < length; i += 2)
        memcpy(path + i, "\xc3\xa4", 2);
    for (size_t shift = 0; shift < 2; shift++) { /* each cut falls into a character once */
        ktg_fail(context, KTG_FILE, "%s%s: is missing%s", shift ? "x" : "", path, shift ? "!" : "");
        const char *message = ktg_context_message(context), *dots = strstr(message, "...");
        assert_non_null(dots);
        assert_true(strlen(message) > 8000 && strlen(message) < 8192);
        assert_string_equal(strstr(message, ": is"), shift ? ": is missing!" : ": is missing");
        for (const char *at = message + shift; *at != ':'; at += *at == '.' ? 1 : 2)
            assert_true(*at == '.' || (at[0] == '\xc3' && at[1] == '\xa4'));
    }
    free(path);
}

static void the_chosen_allocation_fails(void **state) {
    ktg_context *context = *state;
    ktg_context_fail_allocation(context, 2);
    int *first = ktg_new(context, 4, int), *second = ktg_new(context, 4, int),
        *third = ktg_new(context, 4, int);
    assert_non_null(first);
    assert_null(second);
    assert_non_null(third);
    assert_string_not_equal(ktg_context_message(context), "");
    ktg_free(first);
    ktg_free(third);
    assert_null(ktg_alloc(context, SIZE_MAX / 2, 16));
}

static void arrays_grow_with_zeroed_items(void **state) {
    ktg_context *context = *state;
    int *items = NULL;
    size_t capacity = 0;
    int moves = 0;
    for (size_t i = 0; i < 1000; i++) {
        size_t before = capacity;
        assert_int_equal(ktg_reserve(context, &items, &capacity, i + 1), KTG_OK);
        moves += capacity != before;
        assert_int_equal(items[i], 0);
        items[i] = (int)i;
    }
    assert_int_equal(items[999], 999);
    assert_true(moves < 15); /* by half of it each time */
    assert_int_equal(ktg_reserve(context, &items, &capacity, SIZE_MAX / 2), KTG_MEMORY);
    assert_int_equal(items[999], 999);
    ktg_free(items);
}

static void an_output_appears_whole_or_not_at_all(void **state) {
    ktg_context *context = *state;
    char folder[] = "/tmp/ktg-core-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/out", folder);
    ktg_output *output = NULL;
    char *bytes = NULL;
    size_t size = 0;

    assert_int_equal(ktg_output_open(context, path, &output), KTG_OK);
    assert_int_equal(ktg_output_print(context, output, "%.2f", 1.5), KTG_OK);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(ktg_output_commit(context, &output), KTG_OK);
    assert_null(output);

    assert_int_equal(ktg_output_open(context, path, &output), KTG_OK);
    assert_int_equal(ktg_output_write(context, output, "other", 5), KTG_OK);
    assert_int_equal(ktg_output_finish(context, output), KTG_OK);
    ktg_output_discard(&output);
    assert_int_equal(ktg_file_read(context, path, 100, &bytes, &size), KTG_OK);
    assert_string_equal(bytes, "1.50");
    assert_int_equal(size, 4);
    ktg_free(bytes);

    assert_int_equal(ktg_file_read(context, path, 3, &bytes, &size), KTG_LIMIT);
    assert_null(bytes);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0); /* nothing else was left behind */
}

static void impossible_paths_are_named(void **state) {
    ktg_context *context = *state;
    ktg_output *output = NULL;
    char *bytes = NULL;
    size_t size = 0;
    assert_int_equal(ktg_output_open(context, "/tmp", &output), KTG_FILE);
    assert_int_equal(ktg_output_open(context, "/no-such-folder/x", &output), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(context), "/no-such-folder/x"));
    assert_int_equal(ktg_file_read(context, "/tmp", 100, &bytes, &size), KTG_FILE);
    assert_int_equal(ktg_file_read(context, "/no-such-file", 100, &bytes, &size), KTG_FILE);
    assert_int_equal(ktg_output_open(context, "/dev/full", &output), KTG_OK);
    assert_int_equal(ktg_output_write(context, output, "x", 1), KTG_OK);
    assert_int_equal(ktg_output_commit(context, &output), KTG_FILE);
    assert_null(output);
    assert_int_equal(ktg_output_open(context, "/dev/full", &output), KTG_OK);
    assert_int_equal(ktg_output_write(context, output, "x", 1), KTG_OK);
    assert_int_equal(ktg_output_finish(context, output), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(context), "/dev/full"));
    ktg_output_discard(&output);
}

static void a_shape_that_fails_is_told_with_its_file(void **state) {
    ktg_context *context = *state;
    ktg_status status = ktg_fail(context, KTG_GEOMETRY, "it is empty");
    assert_int_equal(ktg_about_file(context, "a.obj", status), KTG_GEOMETRY);
    assert_string_equal(ktg_context_message(context), "a.obj: it is empty");
    assert_int_equal(ktg_about_file(context, "b.obj", KTG_OK), KTG_OK);
    assert_int_equal(ktg_about_file(context, "b.obj", KTG_FILE), KTG_FILE);
    assert_string_equal(ktg_context_message(context), "a.obj: it is empty");
    status = ktg_fail(context, KTG_LIMIT, "it is large");
    assert_int_equal(ktg_about_file(context, "-", status), KTG_LIMIT);
    assert_string_equal(ktg_context_message(context), "standard input: it is large");
}

static void orientation_is_exact(void **state) {
    (void)state;
    ktg_vec2 a = {0.1, 0.1}, b = {0.3, 0.3}, c = {0.7, 0.7};
    assert_int_equal(ktg_orientation2(a, b, c), 0);
    c.y = nextafter(0.7, 1);
    assert_int_equal(ktg_orientation2(a, b, c), 1);
    assert_int_equal(ktg_orientation2(b, a, c), -1);
}

static void random_numbers_stay_the_same(void **state) {
    (void)state;
    ktg_random random, again;
    ktg_random_seed(&random, 1);
    ktg_random_seed(&again, 1);
    size_t counts[5] = {0};
    for (int i = 0; i < 5000; i++) {
        size_t k = ktg_random_below(&random, 5);
        assert_int_equal(k, ktg_random_below(&again, 5));
        counts[k]++;
    }
    for (int k = 0; k < 5; k++)
        assert_in_range(counts[k], 900, 1100);
    double unit = ktg_random_unit(&random);
    assert_true(unit >= 0 && unit < 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_failure_leaves_its_text, make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_log_gets_lines_while_there_is_one, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_long_message_keeps_its_beginning_and_its_end,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(the_chosen_allocation_fails, make_context, drop_context),
        cmocka_unit_test_setup_teardown(arrays_grow_with_zeroed_items, make_context, drop_context),
        cmocka_unit_test_setup_teardown(an_output_appears_whole_or_not_at_all, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(impossible_paths_are_named, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_shape_that_fails_is_told_with_its_file, make_context,
                                        drop_context),
        cmocka_unit_test(orientation_is_exact),
        cmocka_unit_test(random_numbers_stay_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
