/* A piece of a pattern moved by handles: what changes, what stays, and memory that runs out. */
#include "bench.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 6 };

/* A flat sheet of 60 x 60 mm in two halves, `left` and `right`, of which a seam is made; the second
 * is the mirror image of the first. */
static void write_halves(bench *b) {
    char text[8192] = "";
    size_t length = 0;
    for (int j = 0; j <= SIDE; j++)
        for (int i = 0; i <= SIDE; i++)
            length += (size_t)snprintf(text + length, sizeof text - length, "v %d %d 0\n",
                                       10 * (i - SIDE / 2), 10 * j);
    for (int half = 0; half < 2; half++) {
        length += (size_t)snprintf(text + length, sizeof text - length, "g %s\n",
                                   half ? "right" : "left");
        for (int j = 0; j < SIDE; j++)
            for (int i = half * SIDE / 2; i < (half + 1) * SIDE / 2; i++) {
                int a = i + (SIDE + 1) * j + 1, c = a + SIDE + 2;
                length += (size_t)snprintf(text + length, sizeof text - length,
                                           "f %d %d %d\nf %d %d %d\n", a, a + 1, c, a, c, c - 1);
            }
    }
    bench_write(b, "sheet.obj", text);
}

/* The pattern of that sheet, in the bench's folder. */
static void make_pattern(bench *b) {
    write_halves(b);
    strcpy(b->model, bench_path(b, "sheet.obj"));
    b->options.model = b->model;
    b->options.faces = KTG_ALL_FACES;
    b->options.mode = KTG_CLOTH;
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 1;
    b->options.finish.allowance_mm = 7;
    b->options.finish.hem_mm = 13;
    bench_output(b, "pattern.json");
    ktg_pipeline_report report;
    bench_run(b, &report);
    ktg_pipeline_report_free(&report);
    bench_no_outputs(b);
    ktg_finish_defaults(&b->options.finish);
}

typedef struct paths {
    char pattern[128], handles[128];
    ktg_warp_job job;
} paths;

static void make_job(bench *b, paths *p, const char *piece, const char *handles) {
    strcpy(p->pattern, bench_path(b, "pattern.json"));
    bench_write(b, "handles", handles);
    strcpy(p->handles, bench_path(b, "handles"));
    p->job = (ktg_warp_job){.pattern = p->pattern, .piece = piece, .handles = p->handles};
    ktg_warp_defaults(&p->job.warp);
    b->options.outputs = b->outputs;
}

static ktg_status warp(bench *b, const paths *p, ktg_warp_result *result) {
    return ktg_pipeline_warp(b->context, &b->options, &p->job, result);
}

static void a_seam_that_is_pulled_is_measured_again(void **state) {
    bench *b = *state;
    paths p;
    ktg_warp_result r;
    make_pattern(b);
    bench_output(b, "warped.json");
    make_job(b, &p, "left", "hold at 0 0\nhold at 15 0\nat 0 60 by 0 12\nat 30 60 by 0 6\n");
    assert_int_equal(warp(b, &p, &r), KTG_OK);
    assert_true(r.allowance_mm == 7 && r.hem_mm == 13);
    assert_true(r.seam_error_before_mm < 1e-6 && r.seam_error_mm > 4 && r.seams_off == 1);
    assert_int_equal(r.warp.handles, 4);
    ktg_pattern *pattern = bench_pattern(b, "warped.json");
    const ktg_pattern_seam *seam = &pattern->seams[0];
    assert_int_equal(pattern->seam_count, 1);
    assert_true(fabs(fabs(seam->lengths_mm[0] - seam->lengths_mm[1]) - r.seam_error_mm) < 1e-9);
    double most = 0;
    for (uint32_t f = 0; f < pattern->face_count; f++)
        most = fmax(most, pattern->face_strain[f]);
    assert_true(most > 0.1 && most < 0.5);
    ktg_pattern_free(&pattern);
}

static void handles_that_hold_change_nothing(void **state) {
    bench *b = *state;
    paths p;
    ktg_warp_result r;
    make_pattern(b);
    bench_output(b, "warped.json");
    make_job(b, &p, "piece2", "hold vertex 1\nhold vertex 7\nhold at 15 21\n");
    assert_int_equal(warp(b, &p, &r), KTG_OK);
    assert_true(r.seam_error_mm < 1e-9 && r.seams_off == 0 && r.twins_lost == 0);
    ktg_pattern *before = bench_pattern(b, "pattern.json"),
                *after = bench_pattern(b, "warped.json");
    for (size_t k = 0; k < before->piece_count; k++) {
        assert_int_equal(before->pieces[k].outline_count, after->pieces[k].outline_count);
        assert_int_equal(before->pieces[k].cut_count, after->pieces[k].cut_count);
        for (size_t i = 0; i < before->pieces[k].outline_count; i++) {
            ktg_vec2 u = before->pieces[k].outline[i], v = after->pieces[k].outline[i];
            assert_true(hypot(u.x - v.x, u.y - v.y) < 1e-9);
        }
    }
    ktg_pattern_free(&before);
    ktg_pattern_free(&after);
}

static void what_is_said_otherwise_counts(void **state) {
    bench *b = *state;
    paths p;
    ktg_warp_result r;
    make_pattern(b);
    bench_output(b, "warped.json");
    make_job(b, &p, "1", "vertex 1 by 3 4\n");
    p.job.allowance_given = true;
    b->options.finish.allowance_mm = 9;
    assert_int_equal(warp(b, &p, &r), KTG_OK);
    assert_true(r.allowance_mm == 9 && r.hem_mm == 13 && r.seam_error_mm < 1e-9);
}

static void a_fold_is_refused_and_nothing_is_written(void **state) {
    bench *b = *state;
    paths p;
    make_pattern(b);
    bench_output(b, "warped.json");
    make_job(b, &p, "left", "hold at 0 0\nhold at 30 0\nhold at 30 60\nat 15 30 -> 60 30\n");
    size_t before = bench_count(b);
    assert_int_equal(warp(b, &p, NULL), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(b->context), "\"left\" cannot be moved so far"));
    assert_int_equal(bench_count(b), before);
}

static void a_warp_needs_its_memory(void **state) {
    bench *b = *state;
    paths p;
    make_pattern(b);
    bench_output(b, "warped.pdf");
    bench_output(b, "warped.json");
    make_job(b, &p, "left", "hold at 0 0\nhold at 15 0\nat 0 60 by 0 12\nat 30 60 by 0 6\n");
    size_t before = bench_count(b), failures = 0;
    ktg_status status = KTG_MEMORY;
    for (uint64_t k = 1; status != KTG_OK; k += 1 + k / 24, failures++) {
        ktg_context_fail_allocation(b->context, k);
        status = warp(b, &p, NULL);
        end_short_memory(b->context, status);
        if (status == KTG_OK)
            break;
        if (status != KTG_MEMORY)
            fail_msg("allocation %llu: %s, \"%s\"", (unsigned long long)k, ktg_status_name(status),
                     ktg_context_message(b->context));
        assert_int_equal(bench_count(b), before);
    }
    assert_true(failures > 50);
    assert_int_equal(bench_count(b), before + 2);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, bench_setup, bench_teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_seam_that_is_pulled_is_measured_again),
        TEST(handles_that_hold_change_nothing),
        TEST(what_is_said_otherwise_counts),
        TEST(a_fold_is_refused_and_nothing_is_written),
        TEST(a_warp_needs_its_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
