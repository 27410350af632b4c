/* The files of a run: all of them or none, numbered sheets, the same bytes, interrupts. */
#include "bench.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* A file is still what bench_write made it. */
static void assert_old(bench *b, const char *name) {
    size_t size;
    char *text = bench_read(b, name, &size);
    assert_non_null(text);
    assert_string_equal(text, "old");
    free(text);
}

static bool same_bytes(bench *b, const char *one, const char *other) {
    size_t m, n;
    char *x = bench_read(b, one, &m), *y = bench_read(b, other, &n);
    assert_non_null(x);
    assert_non_null(y);
    bool same = m == n && memcmp(x, y, m) == 0;
    free(x);
    free(y);
    return same;
}

static void sheets_are_numbered_where_there_are_several(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    bench_sample(b, "robot.obj");
    bench_output(b, "net.svg");
    bench_output(b, "net.png");
    bench_output(b, "net.pdf");
    b->options.render.dots_per_inch = 20;
    bench_run(b, &r);
    assert_int_equal(r.layout.sheets, 1);
    assert_true(bench_exists(b, "net.svg") && bench_exists(b, "net.png"));
    assert_int_equal(bench_count(b), 3);
    b->options.size_rule = KTG_SIZE_HEIGHT;
    b->options.size_mm = 200;
    bench_run(b, &r);
    assert_true(r.layout.sheets > 1 && r.layout.sheets < 10);
    assert_int_equal(bench_count(b), 3 + r.layout.sheets); /* a PNG shows all of them */
    for (uint32_t i = 1; i <= r.layout.sheets; i++) {
        char svg[] = "net-00.svg";
        svg[5] = (char)('0' + i);
        assert_true(bench_exists(b, svg));
    }
}

static void a_number_in_the_name_asks_for_a_file_for_each_sheet(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    bench_sample(b, "robot.obj");
    bench_output(b, "a%d.png");
    bench_output(b, "page %d of.svg");
    b->options.render.dots_per_inch = 20;
    bench_run(b, &r);
    assert_int_equal(r.layout.sheets, 1);
    assert_true(bench_exists(b, "a01.png") && bench_exists(b, "page 01 of.svg"));
    b->options.size_rule = KTG_SIZE_HEIGHT;
    b->options.size_mm = 200;
    bench_run(b, &r);
    assert_int_equal(bench_count(b), 2 * r.layout.sheets);
    assert_true(bench_exists(b, "a02.png") && bench_exists(b, "page 02 of.svg"));
    bench_output(b, "a02.png"); /* what all sheets would show, and a sheet */
    bench_refused(b, KTG_ARGUMENT, "a02.png: is to be written twice");
}

static void too_large_a_piece_names_what_fits_and_touches_nothing(void **state) {
    bench *b = *state;
    ktg_pipeline_report fit;
    bench_sample(b, "fox.obj");
    bench_output(b, "net.pdf");
    bench_run(b, &fit);
    bench_write(b, "net.pdf", "old");
    bench_output(b, "net.json");
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 30;
    b->options.large = KTG_LARGE_ERROR;
    bench_refused(b, KTG_GEOMETRY, "fox.obj: piece 1");
    const char *told = strstr(ktg_context_message(b->context), "at most about ");
    assert_non_null(told);
    double fits = strtod(told + strlen("at most about "), NULL);
    assert_true(fits > 0 && fits <= 1.01 * fit.mm_per_unit);
    assert_old(b, "net.pdf");
    assert_int_equal(bench_count(b), 1);
    b->options.size_mm = fits; /* and it does fit */
    bench_run(b, &fit);
}

static void one_output_that_cannot_be_written_and_none_appears(void **state) {
    bench *b = *state;
    static const char *const outputs[] = {"a.pdf", "b.svg", "c.png", "d.json"};
    bench_sample(b, "star.obj");
    for (int bad = 0; bad < 4; bad++) {
        for (int kind = 0; kind < 3; kind++) {
            bench_no_outputs(b);
            bench_write(b, "a.pdf", "old");
            for (int i = 0; i < 4; i++)
                bench_output(b, i != bad ? outputs[i] : kind == 0 ? "no/such.pdf" : outputs[i]);
            const char *path = b->outputs[bad];
            if (kind > 0) {
                unlink(path);
                assert_int_equal(symlink(kind == 1 ? "/dev/full" : "/no/such/folder", path), 0);
            }
            bench_refused(b, KTG_FILE, path);
            assert_int_equal(bench_count(b), bad == 0 ? 1 : 1 + (kind > 0));
            if (bad != 0)
                assert_old(b, "a.pdf");
            for (int i = 0; i < 4; i++)
                unlink(bench_path(b, outputs[i]));
        }
    }
}

static void the_report_is_one_of_the_outputs(void **state) {
    bench *b = *state;
    bench_sample(b, "star.obj");
    bench_write(b, "net.json", "old");
    const char *output = bench_output(b, "net.json");
    b->options.report = "/dev/full";
    bench_refused(b, KTG_FILE, "/dev/full: cannot be written");
    b->options.report = "/no/such/folder";
    bench_refused(b, KTG_FILE, "/no/such/folder: cannot be written");
    b->options.report = output;
    bench_refused(b, KTG_ARGUMENT, "is to be written twice");
    b->options.report = b->options.model;
    bench_refused(b, KTG_ARGUMENT, "is the model itself");
    assert_old(b, "net.json");
    assert_int_equal(bench_count(b), 1);
}

static void the_model_is_not_written_over_and_nothing_twice(void **state) {
    bench *b = *state;
    bench_write(b, "m.pdf", "old");
    b->options.model = bench_output(b, "m.pdf");
    bench_refused(b, KTG_ARGUMENT, "is the model itself");
    assert_int_equal(symlink("m.pdf", bench_path(b, "n.pdf")), 0);
    bench_no_outputs(b);
    strcpy(b->model, b->options.model);
    b->options.model = b->model;
    bench_output(b, "n.pdf");
    bench_refused(b, KTG_ARGUMENT, "is the model itself");
    assert_old(b, "m.pdf");

    bench_sample(b, "star.obj");
    static const char *const again[] = {"x.json", "./x.json"};
    for (int i = 0; i < 2; i++) {
        bench_no_outputs(b);
        bench_output(b, "x.json");
        bench_output(b, again[i]);
        bench_refused(b, KTG_ARGUMENT, "is to be written twice");
    }
    bench_no_outputs(b);
    bench_output(b, "x.json");
    bench_output(b, "x.eps");
    bench_refused(b, KTG_ARGUMENT, "x.eps: no such kind of output");
    assert_int_equal(bench_count(b), 2);
}

static void two_runs_give_the_same_bytes_and_another_seed_another_net(void **state) {
    bench *b = *state;
    static const char *const endings[] = {"pdf", "json", "png"};
    bench_sample(b, "fox.obj");
    b->options.render.dots_per_inch = 40;
    for (int run = 0; run < 3; run++) {
        bench_no_outputs(b);
        for (int k = 0; k < 3; k++) {
            char name[16] = {(char)('a' + run), '.'};
            bench_output(b, strcat(name, endings[k]));
        }
        ktg_context_set_seed(b->context, run < 2 ? 5 : 6);
        bench_run(b, NULL);
    }
    assert_true(same_bytes(b, "a.pdf", "b.pdf"));
    assert_true(same_bytes(b, "a.json", "b.json"));
    assert_true(same_bytes(b, "a.png", "b.png"));
    ktg_pattern *one = bench_pattern(b, "a.json"), *other = bench_pattern(b, "c.json");
    bench_sound(b, other);
    size_t unlike = 0;
    for (size_t e = 0; e < one->edge_count; e++)
        unlike += one->edges[e].kind != other->edges[e].kind;
    assert_true(unlike > 0); /* other edges are cut */
    ktg_pattern_free(&one);
    ktg_pattern_free(&other);
}

/* Wishes something from the `from`-th time it is asked on. */
typedef struct plan {
    uint64_t asked, from;
    ktg_wish wish;
} plan;

static ktg_wish ask(void *user) {
    plan *p = user;
    return ++p->asked >= p->from ? p->wish : KTG_GO_ON;
}

static void whoever_finishes_early_still_gets_a_sound_pattern(void **state) {
    bench *b = *state;
    bench_sample(b, "fox.obj");
    bench_output(b, "net.json");
    bench_output(b, "net.pdf");
    for (uint64_t from = 1; from < 100000; from *= 7) {
        ktg_pipeline_report r;
        plan p = {.from = from, .wish = KTG_FINISH};
        ktg_context_set_cancel(b->context, ask, &p);
        bench_run(b, &r);
        ktg_pattern *pattern = bench_pattern(b, "net.json");
        bench_sound(b, pattern);
        ktg_pattern_free(&pattern);
        if (from == 1)
            assert_int_equal(r.unfold.stopped_by, KTG_STOPPED_INTERRUPT);
    }
}

static void whoever_stops_gets_nothing(void **state) {
    bench *b = *state;
    bench_sample(b, "fox.obj");
    bench_write(b, "net.json", "old");
    bench_output(b, "net.json");
    bench_output(b, "net.pdf");
    ktg_status status = KTG_CANCELLED;
    int stopped = 0;
    for (uint64_t from = 1; status != KTG_OK; from += 1 + from / 6) {
        plan p = {.from = from, .wish = KTG_STOP};
        ktg_context_set_cancel(b->context, ask, &p);
        status = ktg_pipeline_run(b->context, &b->options, NULL);
        if (status == KTG_OK)
            assert_true(p.asked < from);
        else {
            assert_int_equal(status, KTG_CANCELLED);
            assert_string_equal(ktg_context_message(b->context), "interrupted");
            assert_old(b, "net.json");
            assert_int_equal(bench_count(b), 1);
            stopped++;
        }
    }
    assert_true(stopped > 10); /* it is asked often */
    assert_int_equal(bench_count(b), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(sheets_are_numbered_where_there_are_several, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_number_in_the_name_asks_for_a_file_for_each_sheet,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(too_large_a_piece_names_what_fits_and_touches_nothing,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(one_output_that_cannot_be_written_and_none_appears,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(the_report_is_one_of_the_outputs, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(the_model_is_not_written_over_and_nothing_twice,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(two_runs_give_the_same_bytes_and_another_seed_another_net,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(whoever_finishes_early_still_gets_a_sound_pattern,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(whoever_stops_gets_nothing, bench_setup, bench_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
