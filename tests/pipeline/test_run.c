/* The whole job on the project's own samples: what it reports, what it writes, how large it gets.
 */
#include "bench.h"

#include <jansson.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Edges under 4 mm may have tabs, but are not counted. */
static bool is_counted(const ktg_pattern *p, uint32_t edge) {
    ktg_vec3 a = p->vertices[p->edges[edge].vertices[0]];
    ktg_vec3 b = p->vertices[p->edges[edge].vertices[1]];
    return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z) >= 4;
}

static void the_report_says_what_the_pattern_holds(void **state) {
    bench *b = *state;
    static const struct {
        const char *file;
        uint32_t faces, components;
    } samples[] = {{"house.obj", 112, 1},  {"star.obj", 60, 1},     {"mask.obj", 160, 1},
                   {"torus.obj", 256, 1},  {"fox.obj", 340, 1},     {"lampshade.obj", 336, 1},
                   {"robot.obj", 940, 21}, {"geodesic.obj", 180, 1}};
    bench_output(b, "net.json");
    bench_output(b, "net.pdf");
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        ktg_pipeline_report r;
        bench_sample(b, samples[i].file);
        bench_run(b, &r);
        assert_int_equal(bench_count(b), 2);
        ktg_pattern *p = bench_pattern(b, "net.json");
        assert_string_equal(p->model_file, samples[i].file);
        assert_int_equal(r.faces, samples[i].faces);
        assert_int_equal(r.model.faces, samples[i].faces);
        assert_int_equal(r.components, samples[i].components);
        assert_int_equal(r.unfold.components, samples[i].components);
        assert_int_equal(p->face_count, r.faces);
        assert_int_equal(p->model_faces, r.model.faces);
        assert_int_equal(p->component_count, r.components);
        assert_int_equal(p->piece_count, r.pieces);
        assert_int_equal(p->seam_count, r.finish.seams);
        assert_int_equal(p->sheet_count, r.layout.sheets);
        assert_int_equal(p->sheet_count, 1);
        assert_true(p->mm_per_unit == r.mm_per_unit);
        assert_false(p->simplified);
        assert_false(r.repair.changed);
        assert_int_equal(r.up, KTG_AXIS_Y);
        assert_true(r.layout.fill > 0.01 && r.layout.fill < 1);
        assert_true(0 < r.seconds_unfold && r.seconds_unfold <= r.seconds);
        size_t tabs = 0;
        for (size_t k = 0; k < p->piece_count; k++)
            for (size_t t = 0; t < p->pieces[k].tab_count; t++)
                tabs += is_counted(p, p->pieces[k].tabs[t].edge);
        assert_int_equal(tabs, r.finish.tabs_full + r.finish.tabs_reduced);
        bench_sound(b, p);
        ktg_pattern_free(&p);
    }
}

static double number(const json_t *figures, const char *key) {
    const json_t *value = json_object_get(figures, key);
    if (!json_is_number(value))
        fail_msg("no number: %s", key);
    return json_number_value(value);
}

static void the_figures_are_written_as_they_are(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    json_error_t error;
    bench_sample(b, "robot.obj");
    bench_output(b, "net.json");
    strcpy(b->report, bench_path(b, "figures.json"));
    b->options.report = b->report;
    ktg_context_set_seed(b->context, UINT64_MAX);
    bench_run(b, &r);
    json_t *f = json_load_file(b->report, 0, &error);
    assert_non_null(f);
    assert_true(number(f, "faces") == r.faces);
    assert_true(number(f, "pieces") == r.pieces);
    assert_true(number(f, "components") == 21);
    assert_true(number(f, "seams") == r.finish.seams);
    assert_true(number(f, "tabs_full") == r.finish.tabs_full);
    assert_true(number(f, "tabs_reduced") == r.finish.tabs_reduced);
    assert_true(number(f, "tabs_none") == r.finish.tabs_none);
    assert_true(number(f, "sheets") == r.layout.sheets);
    assert_true(number(f, "mm_per_unit") == r.mm_per_unit);
    assert_true(number(f, "fill") == r.layout.fill);
    assert_true(number(f, "height_mm") == r.size_mm.y);
    assert_true(number(f, "seconds_unfold") == r.seconds_unfold);
    assert_true(number(f, "seconds") >= r.seconds_unfold && number(f, "seconds") <= r.seconds);
    assert_string_equal(json_string_value(json_object_get(f, "stopped_by")),
                        ktg_stopped_by_name(r.unfold.stopped_by));
    assert_string_equal(json_string_value(json_object_get(f, "mode")), "paper");
    assert_string_equal(json_string_value(json_object_get(f, "seed")), "18446744073709551615");
    json_decref(f);
    ktg_context_set_seed(b->context, UINT64_C(1) << 53);
    bench_run(b, &r);
    f = json_load_file(b->report, 0, &error);
    assert_int_equal(json_integer_value(json_object_get(f, "seed")), UINT64_C(1) << 53);
    json_decref(f);
}

static ktg_vec3 extents(const ktg_pattern *p) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        const double c[3] = {p->vertices[v].x, p->vertices[v].y, p->vertices[v].z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], c[k]);
            high[k] = fmax(high[k], c[k]);
        }
    }
    return (ktg_vec3){high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

static void the_wished_size_is_hit_whichever_axis_is_up(void **state) {
    bench *b = *state;
    bench_sample(b, "house.obj");
    bench_output(b, "net.json");
    /* for up = auto, x, y, z: which of x, y, z (0, 1, 2) is height, width, length */
    static const int axis_of[4][3] = {{1, 0, 2}, {0, 2, 1}, {1, 0, 2}, {2, 0, 1}};
    for (int up = KTG_AXIS_AUTO; up <= KTG_AXIS_Z; up++)
        for (int rule = KTG_SIZE_HEIGHT; rule <= KTG_SIZE_LENGTH; rule++) {
            ktg_pipeline_report r;
            b->options.up = (ktg_axis)up;
            b->options.size_rule = (ktg_size_rule)rule;
            b->options.size_mm = 31.7;
            bench_run(b, &r);
            ktg_pattern *p = bench_pattern(b, "net.json");
            ktg_vec3 e = extents(p);
            const double along[3] = {e.x, e.y, e.z};
            const int *axis = axis_of[up];
            assert_true(fabs(along[axis[rule - KTG_SIZE_HEIGHT]] - 31.7) < 1e-9);
            assert_true(fabs(r.size_mm.y - along[axis[0]]) < 1e-9);
            assert_true(fabs(r.size_mm.x - along[axis[1]]) < 1e-9);
            assert_true(fabs(r.size_mm.z - along[axis[2]]) < 1e-9);
            assert_int_equal(r.up, up == KTG_AXIS_AUTO ? KTG_AXIS_Y : up);
            ktg_pattern_free(&p);
        }
}

static void a_factor_is_taken_as_it_is(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    bench_sample(b, "house.obj");
    bench_output(b, "net.json");
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 1.0 / 3;
    bench_run(b, &r);
    assert_true(r.mm_per_unit == 1.0 / 3);
    assert_true(fabs(r.size_mm.x - 15.0 / 3) < 1e-12); /* the roof is 15 units wide */
}

static void what_fits_is_one_sheet_and_hardly_more_does(void **state) {
    bench *b = *state;
    static const char *const samples[] = {"star.obj", "house.obj", "fox.obj", "robot.obj"};
    bench_output(b, "net.json");
    b->options.large = KTG_LARGE_ERROR;
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        ktg_pipeline_report r, larger;
        bench_sample(b, samples[i]);
        b->options.size_rule = KTG_SIZE_FIT;
        bench_run(b, &r);
        assert_int_equal(r.layout.sheets, 1);
        assert_true(r.pieces == 1 || r.layout.records > 0); /* nested: larger than in rows */
        b->options.size_rule = KTG_SIZE_FACTOR;
        b->options.size_mm = r.mm_per_unit * (r.pieces == 1 ? 1.1 : 1.2);
        ktg_status status = ktg_pipeline_run(b->context, &b->options, &larger);
        if (r.pieces == 1)
            assert_int_equal(status, KTG_GEOMETRY);
        else if (status == KTG_OK)
            assert_true(larger.layout.sheets > 1);
    }
}

static void a_large_model_is_simplified_and_says_so(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    bench_sample(b, "dragon-egg.obj");
    bench_output(b, "net.json");
    b->options.faces = 200;
    bench_run(b, &r);
    assert_int_equal(r.simplify.faces_before, 20480);
    assert_true(r.simplify.target_reached && r.faces <= 200 && r.faces > 190);
    ktg_pattern *p = bench_pattern(b, "net.json");
    assert_true(p->simplified);
    assert_int_equal(p->model_faces, 20480);
    bench_sound(b, p);
    ktg_pattern_free(&p);
}

/* A hilly field of 128 faces; with `charts` its halves have charts of their own, with `colours` the
 * last row is red. */
static void write_field(bench *b, const char *name, bool charts, bool colours) {
    char text[20000] = "mtllib red.mtl\n";
    size_t used = strlen(text);
    bench_write(b, "red.mtl", "newmtl white\nKd 1 1 1\nnewmtl red\nKd 1 0 0\n");
    for (int k = 0; k < 2 * 81; k++)
        used += (size_t)snprintf(text + used, sizeof text - used, "vt %g %g\n",
                                 k % 9 / 8.0 + k / 81, k / 9 % 9 / 8.0);
    for (int k = 0; k < 81; k++)
        used += (size_t)snprintf(text + used, sizeof text - used, "v %d %g %d\n", k % 9,
                                 sin(0.7 * (k % 9)) + cos(0.4 * (k % 9) * (k / 9)), k / 9);
    for (int k = 0; k < 64; k++) {
        int a = 9 * (k / 8) + k % 8 + 1, chart = k % 8 < 4 ? 0 : 81;
        int corners[] = {a, a + 9, a + 10, a + 1};
        used += (size_t)snprintf(text + used, sizeof text - used, "usemtl %s\nf",
                                 colours && k >= 56 ? "red" : "white");
        for (int c = 0; c < 4; c++)
            used += (size_t)snprintf(text + used, sizeof text - used, charts ? " %d/%d" : " %d",
                                     corners[c], corners[c] + chart);
        used += (size_t)snprintf(text + used, sizeof text - used, "\n");
    }
    bench_write(b, name, text);
    snprintf(b->model, sizeof b->model, "%s", bench_path(b, name));
    b->options.model = b->model;
}

static void coordinates_of_no_image_hinder_nothing(void **state) {
    bench *b = *state;
    bench_output(b, "net.json");
    b->options.faces = 60;
    for (int colours = 0; colours < 2; colours++) {
        ktg_pattern *nets[2];
        for (int charts = 0; charts < 2; charts++) {
            ktg_pipeline_report r;
            write_field(b, "field.obj", charts, colours);
            bench_run(b, &r);
            assert_int_equal(r.faces, 60);
            assert_int_equal(r.paint.colours, colours ? 2 : 1);
            nets[charts] = bench_pattern(b, "net.json");
        }
        assert_int_equal(nets[0]->vertex_count, nets[1]->vertex_count);
        assert_memory_equal(nets[0]->vertices, nets[1]->vertices,
                            nets[0]->vertex_count * sizeof *nets[0]->vertices);
        ktg_pattern_free(&nets[0]);
        ktg_pattern_free(&nets[1]);
    }
}

static void cloth_goes_the_same_way(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    bench_sample(b, "blouse-front.obj");
    bench_output(b, "panel.json");
    bench_output(b, "panel.pdf");
    b->options.mode = KTG_CLOTH;
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 2;
    bench_run(b, &r);
    assert_int_equal(r.pieces, 1);
    assert_true(r.flatten.whole.strain_max > 0 && r.flatten.whole.strain_max < 0.2);
    ktg_pattern *p = bench_pattern(b, "panel.json");
    assert_int_equal(p->mode, KTG_CLOTH);
    bench_sound(b, p);
    ktg_pattern_free(&p);
    ktg_pipeline_report_free(&r);
}

static void keep_warning(void *user, ktg_log_level level, const char *text) {
    if (level == KTG_LOG_WARNING)
        snprintf(user, 256, "%s", text);
}

/* Cloth stays white unless somebody asks; its triangles are its own, so the model's are asked. */
static void cloth_has_colours_when_they_are_asked_for(void **state) {
    bench *b = *state;
    ktg_pipeline_report r;
    bench_write(b, "flag.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    bench_write(b, "flag.obj",
                "mtllib flag.mtl\nv 0 0 0\nv 9 0 0\nv 9 9 1\nv 0 9 0\n"
                "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n");
    strcpy(b->model, bench_path(b, "flag.obj"));
    b->options.model = b->model;
    b->options.mode = KTG_CLOTH;
    b->options.faces = KTG_ALL_FACES;
    b->options.size_rule = KTG_SIZE_FACTOR;
    b->options.size_mm = 10;
    bench_output(b, "flag.svg");
    bench_run(b, &r);
    size_t white, coloured;
    ktg_pipeline_report_free(&r);
    free(bench_read(b, "flag.svg", &white));
    b->options.colours = KTG_COLOURS_ON;
    bench_run(b, &r);
    char *text = bench_read(b, "flag.svg", &coloured);
    assert_non_null(strstr(text, "id=\"colours\""));
    assert_int_equal(r.paint.colours, 2);
    assert_true(coloured > white);
    ktg_pipeline_report_free(&r);
    free(text);
}

static void a_wish_for_colours_that_are_not_there_is_answered(void **state) {
    bench *b = *state;
    char warning[256] = "";
    bench_sample(b, "geodesic.obj");
    bench_output(b, "net.json");
    b->options.colours = KTG_COLOURS_ON;
    ktg_context_set_log(b->context, keep_warning, warning);
    bench_run(b, NULL);
    ktg_context_set_log(b->context, NULL, NULL);
    assert_non_null(strstr(warning, "no colours"));
}

static void options_that_make_no_sense_are_refused_before_the_work(void **state) {
    bench *b = *state;
    static const double sizes[] = {0, -1, NAN, INFINITY};
    bench_sample(b, "no-such-model.obj"); /* it would be missed if work began */
    bench_output(b, "net.json");
    b->options.size_rule = KTG_SIZE_HEIGHT;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        b->options.size_mm = sizes[i];
        bench_refused(b, KTG_ARGUMENT, "cannot be made");
    }
    b->options.size_mm = 100;
    bench_refused(b, KTG_FILE, "no-such-model.obj");
    b->options.layout.sheet.margin_mm = 105;
    bench_refused(b, KTG_ARGUMENT, "margins of 105 mm");
    b->options.layout.sheet.margin_mm = 10;
    b->options.mode = KTG_CLOTH;
    b->options.size_rule = KTG_SIZE_FIT;
    bench_refused(b, KTG_ARGUMENT, "cloth needs a size");
    b->options.model = NULL;
    bench_refused(b, KTG_ARGUMENT, "no model is named");
    assert_int_equal(bench_count(b), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_report_says_what_the_pattern_holds, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(the_figures_are_written_as_they_are, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(the_wished_size_is_hit_whichever_axis_is_up, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_factor_is_taken_as_it_is, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(what_fits_is_one_sheet_and_hardly_more_does, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_large_model_is_simplified_and_says_so, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(coordinates_of_no_image_hinder_nothing, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(cloth_goes_the_same_way, bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(cloth_has_colours_when_they_are_asked_for, bench_setup,
                                        bench_teardown),
        cmocka_unit_test_setup_teardown(a_wish_for_colours_that_are_not_there_is_answered,
                                        bench_setup, bench_teardown),
        cmocka_unit_test_setup_teardown(options_that_make_no_sense_are_refused_before_the_work,
                                        bench_setup, bench_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
