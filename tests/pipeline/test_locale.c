/* A program that has set a locale with decimal commas gets the same files and the same words. */
#include "bench.h"

#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What the log and a failure say. */
static void keep_words(void *user, ktg_log_level level, const char *text) {
    (void)level;
    strncat(user, text, 4000 - strlen(user));
}

/* Runs the job in both locales; the outputs have names "a..." and "b...", equally long, in two
 * halves. */
static void same_in_both(bench *b) {
    size_t half = b->options.output_count / 2;
    char words[2][4096] = {"", ""};
    for (int k = 0; k < 2; k++) {
        const char *set = setlocale(LC_ALL, k == 0 ? "C" : "");
        assert_non_null(set);
        assert_string_equal(localeconv()->decimal_point, k == 0 ? "." : ",");
        b->options.outputs = b->outputs + (k == 0 ? 0 : half);
        b->options.output_count = half;
        ktg_context_set_log(b->context, keep_words, words[k]);
        bench_run(b, NULL);
        b->options.outputs = b->outputs;
    }
    setlocale(LC_ALL, "C");
    for (size_t i = 0; i < half; i++) {
        size_t sizes[2];
        char *bytes[2];
        for (int k = 0; k < 2; k++)
            bytes[k] = bench_read(b, strrchr(b->paths[i + (k ? half : 0)], '/') + 1, &sizes[k]);
        assert_true(bytes[0] && bytes[1]);
        assert_true(sizes[0] == sizes[1] && memcmp(bytes[0], bytes[1], sizes[0]) == 0);
        free(bytes[0]);
        free(bytes[1]);
    }
    for (char *at = words[1]; (at = strstr(at, "/b.")); at++)
        at[1] = 'a'; /* "wrote .../a.pdf" */
    assert_string_equal(words[0], words[1]);
}

/* `svg`: of several sheets its files would have other names. */
static void all_outputs(bench *b, bool svg) {
    static const char *const endings[] = {"svg", "pdf", "dxf", "png", "json"};
    for (const char *letter = "ab"; *letter; letter++)
        for (size_t i = svg ? 0 : 1; i < sizeof endings / sizeof *endings; i++) {
            char name[16];
            snprintf(name, sizeof name, "%c.%s", *letter, endings[i]);
            bench_output(b, name);
        }
    b->options.render.dots_per_inch = 40;
}

static void a_net_is_the_same_with_commas(void **state) {
    bench *b = *state;
    bench_sample(b, "house.obj");
    b->options.unfold.effort = KTG_EFFORT_QUICK;
    all_outputs(b, true);
    same_in_both(b);
}

static void cloth_is_the_same_with_commas(void **state) {
    bench *b = *state;
    bench_sample(b, "blouse-front.obj");
    b->options.mode = KTG_CLOTH;
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 4.5;
    b->options.large = KTG_LARGE_TILE;
    b->options.finish.allowance_mm = 7.5;
    all_outputs(b, false);
    same_in_both(b);
}

static void models_are_written_and_read_the_same(void **state) {
    static const char *const names[] = {"m.obj", "m.stl", "m.ply", "m.off"};
    bench *b = *state;
    bench_sample(b, "fox.obj");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        size_t sizes[2];
        char *bytes[2];
        for (int k = 0; k < 2; k++) {
            ktg_mesh *mesh = NULL;
            ktg_output *output = NULL;
            setlocale(LC_ALL, k == 0 ? "C" : "");
            assert_int_equal(ktg_mesh_read(b->context, b->model, KTG_MESH_BY_ENDING, &mesh),
                             KTG_OK);
            assert_int_equal(ktg_output_open(b->context, bench_path(b, names[i]), &output), KTG_OK);
            assert_int_equal(ktg_mesh_write(b->context, mesh, ktg_mesh_format_of(names[i]), output),
                             KTG_OK);
            assert_int_equal(ktg_output_commit(b->context, &output), KTG_OK);
            ktg_mesh_free(&mesh);
            bytes[k] = bench_read(b, names[i], &sizes[k]);
        }
        setlocale(LC_ALL, "C");
        assert_true(sizes[0] == sizes[1] && memcmp(bytes[0], bytes[1], sizes[0]) == 0);
        free(bytes[0]);
        free(bytes[1]);
    }
}

static void a_failure_has_the_same_words(void **state) {
    bench *b = *state;
    char words[2048];
    bench_sample(b, "house.obj");
    bench_output(b, "a.pdf");
    b->options.large = KTG_LARGE_ERROR;
    b->options.size_rule = KTG_SIZE_HEIGHT;
    b->options.size_mm = 1217.3;
    b->options.unfold.effort = KTG_EFFORT_QUICK;
    assert_int_equal(ktg_pipeline_run(b->context, &b->options, NULL), KTG_GEOMETRY);
    snprintf(words, sizeof words, "%s", ktg_context_message(b->context));
    assert_non_null(strstr(words, "."));
    setlocale(LC_ALL, "");
    assert_int_equal(ktg_pipeline_run(b->context, &b->options, NULL), KTG_GEOMETRY);
    setlocale(LC_ALL, "C");
    assert_string_equal(words, ktg_context_message(b->context));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_net_is_the_same_with_commas, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(cloth_is_the_same_with_commas, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(models_are_written_and_read_the_same, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_failure_has_the_same_words, bench_setup, bench_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
