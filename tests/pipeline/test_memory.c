/* Memory that runs out anywhere in the job: the call fails, nothing leaks, no file appears. */
#include "bench.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Lets the k-th allocation fail, k from 1 on with growing strides, until the job is done. */
static void starve(bench *b) {
    ktg_status status = KTG_MEMORY;
    size_t before = bench_count(b), failures = 0;
    strcpy(b->report, bench_path(b, "figures.json"));
    b->options.report = b->report;
    b->options.unfold.effort = KTG_EFFORT_QUICK; /* the job is run hundreds of times */
    for (uint64_t k = 1; status != KTG_OK; k += 1 + k / 24, failures++) {
        ktg_context_fail_allocation(b->context, k);
        status = ktg_pipeline_run(b->context, &b->options, NULL);
        end_short_memory(b->context, status);
        if (status == KTG_OK)
            break;
        if (status != KTG_MEMORY)
            fail_msg("allocation %llu: %s, \"%s\"", (unsigned long long)k, ktg_status_name(status),
                     ktg_context_message(b->context));
        assert_int_equal(bench_count(b), before);
    }
    assert_true(failures > 50);
    assert_int_equal(bench_count(b), before + b->options.output_count + 1);
}

static void a_net_needs_its_memory(void **state) {
    bench *b = *state;
    bench_sample(b, "star.obj");
    bench_output(b, "net.pdf");
    bench_output(b, "net.svg");
    bench_output(b, "net.png");
    bench_output(b, "net.json");
    b->options.render.dots_per_inch = 20;
    starve(b);
}

static void a_simplified_net_needs_its_memory(void **state) {
    bench *b = *state;
    bench_sample(b, "robot.obj"); /* of many parts, on several sheets */
    bench_output(b, "net.json");
    b->options.faces = 700;
    b->options.unfold.method = KTG_METHOD_GENETIC;
    b->options.unfold.generations = 3;
    starve(b);
}

static void a_net_with_a_hand_on_its_seams_needs_its_memory(void **state) {
    static const char *const omit[] = {"porch"};
    bench *b = *state;
    char keep[128], cut[128];
    const char *const files[] = {keep, cut};
    bench_sample(b, "house.obj");
    bench_write(b, "keep.txt", "4 36\n1 2\n");
    strcpy(keep, bench_path(b, "keep.txt"));
    bench_write(b, "cut.obj", "l 8 9 6\n");
    strcpy(cut, bench_path(b, "cut.obj"));
    bench_output(b, "net.json");
    b->options.unfold.seconds = 0.01; /* the search takes no memory */
    b->options.keep = files;
    b->options.cut = files + 1;
    b->options.omit = omit;
    b->options.keep_count = b->options.cut_count = b->options.omit_count = 1;
    starve(b);
}

static void a_model_that_is_changed_first_needs_its_memory(void **state) {
    bench *b = *state;
    char edit[128];
    bench_sample(b, "star.obj");
    bench_write(b, "up.edit",
                "[fixed f]\nset = halfspace 0 0 0  0 -1 0\n"
                "[handle h]\nset = halfspace 0 3 0  0 1 0\nmove = 0 1 0\n");
    strcpy(edit, bench_path(b, "up.edit"));
    b->options.edit = edit;
    b->options.unfold.seconds = 0.01;
    bench_output(b, "net.json");
    starve(b);
}

/* The model is simplified, so that the closest points are asked for colours. */
static void a_painted_net_needs_its_memory(void **state) {
    bench *b = *state;
    bench_write(b, "cube.obj",
                "mtllib cube.mtl\n"
                "v 0 0 0 1 0 0\nv 2 0 0 0 1 0\nv 2 2 0 0 0 1\nv 0 2 0 1 1 0\n"
                "v 0 0 2 1 0 1\nv 2 0 2 0 1 1\nv 2 2 2 1 1 1\nv 0 2 2 0 0 0\nv 1 1 2 1 0 0\n"
                "usemtl red\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nusemtl blue\nf 3 4 8 7\n"
                "f 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n");
    bench_write(b, "cube.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    strcpy(b->model, bench_path(b, "cube.obj"));
    b->options.model = b->model;
    b->options.faces = 12;
    b->options.unfold.seconds = 0.001;
    b->options.size_rule = KTG_SIZE_HEIGHT;
    b->options.size_mm = 10;
    assert_int_equal(ktg_sheet_parse(b->context, "60x60", &b->options.layout.sheet), KTG_OK);
    bench_output(b, "net.pdf");
    bench_output(b, "net.svg");
    bench_output(b, "net.png");
    b->options.render.dots_per_inch = 20;
    starve(b);
}

static void a_poster_needs_its_memory(void **state) {
    bench *b = *state;
    bench_sample(b, "star.obj");
    bench_output(b, "net.pdf");
    bench_output(b, "net.png");
    bench_output(b, "net.json");
    b->options.size_rule = KTG_SIZE_HEIGHT;
    b->options.size_mm = 250;
    b->options.large = KTG_LARGE_TILE;
    b->options.render.dots_per_inch = 20;
    starve(b);
}

static void one_page_and_many_sheets_need_their_memory(void **state) {
    bench *b = *state;
    bench_sample(b, "star.obj");
    bench_output(b, "net.json");
    b->options.sheets = 2;
    b->options.unfold.seconds = 0.001; /* a trial or two */
    starve(b);
    bench_no_outputs(b);
    bench_output(b, "page.json");
    b->options.unfold.seconds = 0;
    b->options.size_rule = KTG_SIZE_HEIGHT;
    b->options.size_mm = 200;
    b->options.layout.sheet.width_mm = b->options.layout.sheet.height_mm = INFINITY;
    ktg_pipeline_report r;
    bench_run(b, &r);
    assert_int_equal(r.layout.sheets, 1);
    assert_true(r.sheet_mm.x > 200 && r.sheet_mm.x < 600);
}

static void a_panel_needs_its_memory(void **state) {
    bench *b = *state;
    char text[4096] = "";
    size_t length = 0;
    for (int i = 0; i < 36; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "v %d %d %g\n", i % 6,
                                   i / 6, 0.02 * (i % 6) * (i / 6));
    for (int i = 0; i < 35; i++)
        if (i % 6 < 5 && i < 30)
            length +=
                (size_t)snprintf(text + length, sizeof text - length, "f %d %d %d\nf %d %d %d\n",
                                 i + 1, i + 2, i + 7, i + 2, i + 8, i + 7);
    bench_write(b, "panel.obj", text);
    strcpy(b->model, bench_path(b, "panel.obj"));
    b->options.model = b->model;
    b->options.faces = KTG_ALL_FACES;
    b->options.mode = KTG_CLOTH;
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 10;
    bench_output(b, "panel.pdf");
    bench_output(b, "panel.json");
    starve(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_net_needs_its_memory, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(a_simplified_net_needs_its_memory, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_net_with_a_hand_on_its_seams_needs_its_memory,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(a_model_that_is_changed_first_needs_its_memory, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_painted_net_needs_its_memory, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_poster_needs_its_memory, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(one_page_and_many_sheets_need_their_memory, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_panel_needs_its_memory, bench_setup, bench_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
