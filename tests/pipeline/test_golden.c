/* Golden patterns: what the whole job makes of a few models, compared item by item with what it
 * made when somebody last looked at it.
 *
 * After a change that is meant to give other nets, look at them, and write new ones with
 *     BUILD/tests/pipeline/test_pipeline_golden --write
 */
#include "bench.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define CLOSE_MM 1e-6

static const struct {
    const char *name, *text; /* text: the model, where it is none of the samples */
} models[] = {
    {"tetrahedron", "v 0 0 0\nv 3 0 0\nv 1 2 0\nv 1 1 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"},
    {"cube", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"},
    {"house", NULL},
};

enum { MODEL_COUNT = sizeof models / sizeof *models };

static void prepare(bench *b, int i) {
    char name[64];
    snprintf(name, sizeof name, "%s.obj", models[i].name);
    bench_sample(b, name);
    if (models[i].text) {
        bench_write(b, name, models[i].text);
        strcpy(b->model, bench_path(b, name));
    }
    bench_no_outputs(b);
}

static const char *golden_path(int i) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s.json", KTG_GOLDEN, models[i].name);
    return path;
}

static void assert_near(double a, double b) {
    if (!(fabs(a - b) <= CLOSE_MM))
        fail_msg("%.12g instead of %.12g", a, b);
}

static void compare_points(const ktg_vec2 *a, const ktg_vec2 *b, size_t count) {
    for (size_t i = 0; i < count; i++) {
        assert_near(a[i].x, b[i].x);
        assert_near(a[i].y, b[i].y);
    }
}

static void compare_pieces(const ktg_pattern_piece *a, const ktg_pattern_piece *b) {
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->component, b->component);
    assert_int_equal(a->vertex_count, b->vertex_count);
    compare_points(a->vertices, b->vertices, a->vertex_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_memory_equal(a->faces, b->faces, a->face_count * sizeof *a->faces);
    assert_memory_equal(a->corners, b->corners, 3 * a->face_count * sizeof *a->corners);
    assert_int_equal(a->outline_count, b->outline_count);
    compare_points(a->outline, b->outline, a->outline_count);
    assert_int_equal(a->tab_count, b->tab_count);
    for (size_t i = 0; i < a->tab_count; i++) {
        assert_int_equal(a->tabs[i].edge, b->tabs[i].edge);
        assert_int_equal(a->tabs[i].size, b->tabs[i].size);
        assert_int_equal(a->tabs[i].corner_count, b->tabs[i].corner_count);
        compare_points(a->tabs[i].corners, b->tabs[i].corners, a->tabs[i].corner_count);
    }
    assert_int_equal(a->label_count, b->label_count);
    for (size_t i = 0; i < a->label_count; i++) {
        assert_string_equal(a->labels[i].text, b->labels[i].text);
        compare_points(&a->labels[i].at, &b->labels[i].at, 1);
    }
}

static void compare_edges(const ktg_pattern *a, const ktg_pattern *b) {
    assert_int_equal(a->edge_count, b->edge_count);
    for (size_t i = 0; i < a->edge_count; i++) {
        const ktg_pattern_edge *x = &a->edges[i], *y = &b->edges[i];
        assert_memory_equal(x->vertices, y->vertices, sizeof x->vertices);
        assert_int_equal(x->kind, y->kind);
        assert_int_equal(x->tab_on, y->tab_on);
        assert_int_equal(x->seam, y->seam);
        assert_near(x->angle, y->angle);
    }
}

static void compare_seams(const ktg_pattern *a, const ktg_pattern *b) {
    assert_int_equal(a->seam_count, b->seam_count);
    for (size_t i = 0; i < a->seam_count; i++) {
        assert_int_equal(a->seams[i].number, b->seams[i].number);
        assert_int_equal(a->seams[i].section, b->seams[i].section);
        assert_int_equal(a->seams[i].closing, b->seams[i].closing);
    }
}

static void compare_sheets(const ktg_pattern *a, const ktg_pattern *b) {
    assert_int_equal(a->sheet_count, b->sheet_count);
    for (size_t i = 0; i < a->sheet_count; i++) {
        const ktg_pattern_sheet *x = &a->sheets[i], *y = &b->sheets[i];
        assert_near(x->width_mm, y->width_mm);
        assert_near(x->height_mm, y->height_mm);
        assert_int_equal(x->placement_count, y->placement_count);
        for (size_t k = 0; k < x->placement_count; k++) {
            assert_int_equal(x->placements[k].piece, y->placements[k].piece);
            assert_near(x->placements[k].x, y->placements[k].x);
            assert_near(x->placements[k].y, y->placements[k].y);
            assert_near(x->placements[k].rotation, y->placements[k].rotation);
        }
    }
}

static void compare(const ktg_pattern *a, const ktg_pattern *b) {
    assert_int_equal(a->face_count, b->face_count);
    assert_int_equal(a->component_count, b->component_count);
    assert_int_equal(a->piece_count, b->piece_count);
    assert_int_equal(a->seam_count, b->seam_count);
    assert_near(a->mm_per_unit, b->mm_per_unit);
    compare_edges(a, b);
    compare_seams(a, b);
    for (size_t i = 0; i < a->piece_count; i++)
        compare_pieces(&a->pieces[i], &b->pieces[i]);
    compare_sheets(a, b);
}

static void patterns_are_what_they_were(void **state) {
    bench *b = *state;
    for (int i = 0; i < MODEL_COUNT; i++) {
        ktg_pattern *golden = NULL;
        prepare(b, i);
        bench_output(b, "net.json");
        bench_run(b, NULL);
        ktg_pattern *pattern = bench_pattern(b, "net.json");
        bench_sound(b, pattern);
        if (ktg_pattern_read_json(b->context, golden_path(i), &golden) != KTG_OK)
            fail_msg("%s", ktg_context_message(b->context));
        print_message("# %s\n", models[i].name); /* TAP */
        compare(pattern, golden);
        ktg_pattern_free(&pattern);
        ktg_pattern_free(&golden);
    }
}

/* The cube's six squares stay whole: 5 folds, 7 cut edges, each of which has a tab. */
static void a_cube_is_folded_as_anybody_would(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    prepare(b, 1);
    bench_output(b, "net.json");
    bench_run(b, &r);
    ktg_pattern *p = bench_pattern(b, "net.json");
    int kinds[5] = {0};
    for (size_t i = 0; i < p->edge_count; i++)
        kinds[p->edges[i].kind]++;
    assert_int_equal(kinds[KTG_EDGE_CUT], 7);
    assert_int_equal(kinds[KTG_EDGE_MOUNTAIN], 5);
    assert_int_equal(kinds[KTG_EDGE_FLAT], 6);
    assert_int_equal(kinds[KTG_EDGE_VALLEY] + kinds[KTG_EDGE_BORDER], 0);
    assert_int_equal(r.pieces, 1);
    assert_int_equal(r.finish.tabs_full, 7);
    ktg_pattern_free(&p);
}

static int write_all(void) {
    int bad = 0;
    for (int i = 0; i < MODEL_COUNT && !bad; i++) {
        void *state = NULL;
        bad = bench_setup(&state);
        bench *b = state;
        prepare(b, i);
        b->outputs[0] = golden_path(i);
        b->options.output_count = 1;
        bad = bad || ktg_pipeline_run(b->context, &b->options, NULL) != KTG_OK;
        printf("%s: %s\n", golden_path(i), bad ? ktg_context_message(b->context) : "written");
        bench_teardown(&state);
    }
    return bad;
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "--write") == 0)
        return write_all();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(patterns_are_what_they_were, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(a_cube_is_folded_as_anybody_would, bench_setup,
                                        bench_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
