/* What a proof stands up to: other scales, needles, many faces, cloth, the model, little memory. */
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"
#include "nets.h"
#include "proof.h"
#include "tests/short_memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- scale and size ----------------------------------------------------------------------- */

static void a_model_of_any_size_gives_the_same_verdict(void **state) {
    ktg_context *context = *state;
    const net *nets[] = {&cube, &slit, &saddle, &useless_slit};
    for (size_t i = 0; i < 4; i++) {
        net bare = *nets[i];
        bare.bare = true;
        ktg_verify_report reports[3];
        ktg_status verdicts[3];
        for (int k = 0; k < 3; k++) {
            ktg_pattern *p = net_make(context, &bare);
            double factor = k == 0 ? 1 : k == 1 ? 0x1p-60 : 0x1p+70;
            for (size_t v = 0; v < p->vertex_count; v++)
                p->vertices[v] = ktg_mul3(p->vertices[v], factor);
            for (size_t v = 0; v < p->pieces[0].vertex_count; v++)
                p->pieces[0].vertices[v] = ktg_mul2(p->pieces[0].vertices[v], factor);
            verdicts[k] = ktg_verify(context, p, NULL, &reports[k]);
            assert_int_equal(verdicts[k], verdicts[0]);
            assert_memory_equal(&reports[k], &reports[0], sizeof *reports);
            ktg_pattern_free(&p);
        }
        assert_int_equal(verdicts[0], i < 2 ? KTG_OK : KTG_UNSOUND);
    }
}

/* A ribbon of 2 n triangles between two rows of points, wound up like a screw. */
static ktg_pattern *make_ribbon(ktg_context *context, uint32_t n, double step, double width,
                                double bend, bool bare) {
    ktg_vec3 *positions = ktg_new(context, 2 * ((size_t)n + 1), ktg_vec3);
    uint32_t(*faces)[3] = ktg_alloc(context, 2 * (size_t)n, sizeof *faces);
    for (uint32_t i = 0; i <= n; i++) {
        double a = bend * i, r = bend > 0 ? step / bend : 0;
        ktg_vec3 p = {bend > 0 ? r * sin(a) : step * i, bend > 0 ? r * cos(a) : 0, 0};
        positions[2 * i] = p;
        p.z = width;
        positions[2 * i + 1] = p;
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t two[2][3] = {{2 * i, 2 * i + 2, 2 * i + 1}, {2 * i + 1, 2 * i + 2, 2 * i + 3}};
        memcpy(faces[2 * i], two, sizeof two);
    }
    net ribbon = {positions, 2 * n + 2, (const uint32_t(*)[3])faces, 2 * n, NULL, 0, 2, bare};
    ktg_pattern *p = net_make(context, &ribbon);
    ktg_free(positions);
    ktg_free(faces);
    return p;
}

static void needles_refold(void **state) {
    ktg_context *context = *state;
    static const double steps[] = {1, 1e-3, 1e-5, 1e-7};
    for (size_t i = 0; i < 4; i++) {
        ktg_verify_report report;
        ktg_pattern *p = make_ribbon(context, 150, steps[i], 50, 0.02, true);
        accept(context, p, NULL, &report);
        assert_true(report.refold_error < 1e-7);
        ktg_pattern_free(&p);
    }
}

static void a_hundred_thousand_faces_take_a_moment(void **state) {
    ktg_context *context = *state;
    ktg_verify_report report;
    ktg_pattern *p = make_ribbon(context, 50000, 0.002, 10, 0, false);
    accept(context, p, NULL, &report);
    assert_int_equal(p->face_count, 100000);
    ktg_pattern_free(&p);
}

/* A fan that winds round its vertex a thousand times: everything lies on everything. */
static void a_heap_of_faces_ends_soon(void **state) {
    enum { COUNT = 12000 };
    ktg_context *context = *state;
    ktg_verify_report report;
    ktg_vec3 *positions = ktg_new(context, COUNT + 2, ktg_vec3);
    uint32_t(*faces)[3] = ktg_alloc(context, COUNT, sizeof *faces);
    for (uint32_t i = 0; i <= COUNT; i++)
        positions[i + 1] = (ktg_vec3){20 * cos(i * KTG_PI / 6), 20 * sin(i * KTG_PI / 6), 0.01 * i};
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t face[3] = {0, i + 1, i + 2};
        memcpy(faces[i], face, sizeof face);
    }
    net fan = {positions, COUNT + 2, (const uint32_t(*)[3])faces, COUNT, NULL, 0, 0, true};
    ktg_pattern *p = net_make(context, &fan);
    assert_int_equal(ktg_verify(context, p, NULL, &report), KTG_UNSOUND);
    assert_int_equal(report.problem_count, 10000);
    ktg_pattern_free(&p);
    ktg_free(positions);
    ktg_free(faces);
}

/* ---- the JSON form ------------------------------------------------------------------------ */

static void a_pattern_that_was_written_and_read_still_holds(void **state) {
    ktg_context *context = *state;
    const net *nets[] = {&tetrahedron, &box_and_lid, &open_box, &slit, &two_parts};
    char path[] = "/tmp/ktg-proof-XXXXXX";
    assert_int_not_equal(mkstemp(path), -1);
    for (size_t i = 0; i < 5; i++) {
        ktg_verify_report report;
        ktg_output *output = NULL;
        ktg_pattern *p = net_make(context, nets[i]), *back = NULL;
        assert_int_equal(ktg_output_open(context, path, &output), KTG_OK);
        assert_int_equal(ktg_pattern_write_json(context, p, output), KTG_OK);
        assert_int_equal(ktg_output_commit(context, &output), KTG_OK);
        assert_int_equal(ktg_pattern_read_json(context, path, &back), KTG_OK);
        accept(context, back, NULL, &report);
        ktg_pattern_free(&p);
        ktg_pattern_free(&back);
    }
    unlink(path);
}

/* ---- the model ---------------------------------------------------------------------------- */

/* The surface as a model in another unit, turned and moved by `turn` and `shift`. */
static ktg_mesh *make_model(ktg_context *context, const ktg_pattern *p, double unit, double turn,
                            double shift) {
    ktg_mesh *model = NULL;
    ktg_vec3 *positions = ktg_new(context, p->vertex_count, ktg_vec3);
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        ktg_vec3 v = p->vertices[i];
        positions[i] =
            (ktg_vec3){(cos(turn) * v.x - sin(turn) * v.z) * unit + shift, v.y * unit - 2 * shift,
                       (sin(turn) * v.x + cos(turn) * v.z) * unit};
    }
    assert_int_equal(
        ktg_mesh_new(context, &positions[0].x, p->vertex_count, p->faces, p->face_count, &model),
        KTG_OK);
    ktg_free(positions);
    return model;
}

static void the_model_is_recognised_in_any_pose(void **state) {
    ktg_context *context = *state;
    ktg_verify_report report;
    ktg_pattern *p = net_make(context, &two_parts);
    p->mm_per_unit = 8;
    ktg_mesh *model = make_model(context, p, 0.125, 2.5, 7);
    accept(context, p, model, &report);
    assert_true(report.model_compared);
    assert_true(report.model_error < 1e-14);
    p->mm_per_unit = 8.001;
    refuse(context, p, model, "The surface is not the model: at 8.001 mm per unit");
    p->mm_per_unit = 8;
    model->positions[3].x += 1e-3;
    refuse(context, p, model, "of the diagonal off");
    ktg_mesh_free(&model);
    model = make_model(context, p, 0.125, 0, 0);
    for (uint32_t i = 0; i < model->vertex_count; i++)
        model->positions[i].x *= -1;
    refuse(context, p, model, "of the diagonal off"); /* a mirror image is another model */
    model->face_count--;
    refuse(context, p, model, "it has 8 faces, the model has 7");
    ktg_mesh_free(&model);
    ktg_pattern_free(&p);
}

/* Turns the order of vertices and faces round and lets each face start at another corner. */
static void renumber(ktg_mesh *model) {
    uint32_t n = model->vertex_count, f = model->face_count;
    for (uint32_t i = 0; i < n / 2; i++) {
        ktg_vec3 swap = model->positions[i];
        model->positions[i] = model->positions[n - 1 - i];
        model->positions[n - 1 - i] = swap;
    }
    for (uint32_t i = 0; i < f; i++) {
        uint32_t *c = model->faces + 3 * (size_t)i, first = c[0];
        c[0] = n - 1 - c[1];
        c[1] = n - 1 - c[2];
        c[2] = n - 1 - first;
    }
    for (uint32_t i = 0; i < 3 * (f / 2); i++) {
        uint32_t swap = model->faces[i], j = 3 * (f - 1 - i / 3) + i % 3;
        model->faces[i] = model->faces[j];
        model->faces[j] = swap;
    }
}

static void the_model_may_be_numbered_otherwise(void **state) {
    ktg_context *context = *state;
    ktg_verify_report report;
    ktg_pattern *p = net_make(context, &cube);
    p->mm_per_unit = 4;
    ktg_mesh *model = make_model(context, p, 0.25, 0, 3);
    renumber(model);
    accept(context, p, model, &report);
    assert_true(report.model_compared && report.model_error < 1e-14);
    uint32_t *c = model->faces; /* the other diagonal of a square is another surface */
    model->positions[c[0]].x += 0.01;
    refuse(context, p, model, "The surface is not the model: no vertex");
    model->positions[c[0]].x -= 0.01;
    uint32_t swap = c[0];
    c[0] = c[1];
    c[1] = swap;
    refuse(context, p, model, "The surface is not the model: face");
    ktg_mesh_free(&model);
    ktg_pattern_free(&p);
}

static void a_simplified_model_is_measured(void **state) {
    ktg_context *context = *state;
    ktg_verify_report report;
    ktg_pattern *p = net_make(context, &cube);
    p->mm_per_unit = 2;
    p->simplified = true;
    ktg_mesh *model = make_model(context, p, 0.5, 0, 0);
    accept(context, p, model, &report);
    assert_true(report.model_compared);
    assert_true(report.hausdorff_mm < 1e-9);
    for (uint32_t i = 4; i < 8; i++)
        model->positions[i].z += 1.5; /* 3 mm in print */
    accept(context, p, model, &report);
    assert_true(fabs(report.hausdorff_mm - 3) < 0.3);
    ktg_mesh_free(&model);
    ktg_pattern_free(&p);
}

/* ---- cloth -------------------------------------------------------------------------------- */

static void cloth_may_strain_a_little(void **state) {
    ktg_context *context = *state;
    ktg_verify_report report;
    net plain = slit;
    plain.tab_mm = 0;
    ktg_pattern *p = net_make(context, &plain);
    p->mode = KTG_CLOTH;
    for (size_t i = 0; i < p->pieces[0].vertex_count; i++) /* the sides stay about equal */
        p->pieces[0].vertices[i].x *= 1.002;
    for (size_t i = 0; i < p->pieces[0].outline_count; i++)
        p->pieces[0].outline[i].x *= 1.002;
    for (size_t i = 0; i < p->seam_count; i++)
        for (int s = 0; s < 2; s++) {
            const ktg_pattern_edge *e = &p->edges[p->seams[i].edges[0]];
            const uint32_t *c = p->pieces[0].corners;
            for (size_t k = 0; k < p->pieces[0].face_count; k++)
                if (p->pieces[0].faces[k] == e->sides[s].face)
                    c += 3 * k;
            p->seams[i].lengths_mm[s] =
                ktg_length2(ktg_sub2(p->pieces[0].vertices[c[(e->sides[s].corner + 1) % 3]],
                                     p->pieces[0].vertices[c[e->sides[s].corner]]));
        }
    accept(context, p, NULL, &report);
    p->mode = KTG_PAPER;
    refuse(context, p, NULL, "on the surface");
    p->mode = KTG_CLOTH;
    const ktg_pattern_edge *outer = net_edge(p, 0, 5); /* one copy of vertex 0 moves along */
    for (size_t k = 0; k < p->pieces[0].face_count; k++)
        if (p->pieces[0].faces[k] == outer->sides[0].face) {
            const uint32_t *c = p->pieces[0].corners + 3 * k;
            uint32_t end = c[(outer->sides[0].corner + (outer->vertices[0] == 0 ? 0 : 1)) % 3];
            uint32_t fixed = c[(outer->sides[0].corner + (outer->vertices[0] == 0 ? 1 : 0)) % 3];
            ktg_vec2 *v = p->pieces[0].vertices;
            v[end] = ktg_madd2(v[end], 0.02, ktg_sub2(v[end], v[fixed]));
        }
    refuse(context, p, NULL, "long on one side, but");
    ktg_pattern_free(&p);
}

/* ---- many problems, little memory, no patience ---------------------------------------------- */

static void many_problems_are_counted_and_the_first_told(void **state) {
    ktg_context *context = *state;
    ktg_verify_report report;
    ktg_pattern *p = net_make(context, &cube);
    for (size_t i = 0; i < p->edge_count; i++)
        p->edges[i].angle += 1;
    assert_int_equal(ktg_verify(context, p, NULL, &report), KTG_UNSOUND);
    assert_int_equal(report.problem_count, 19); /* 18 angles, and the piece does not refold */
    assert_non_null(strstr(ktg_context_message(context), "... and 14 more"));
    ktg_pattern_free(&p);
}

static void memory_may_fail_anywhere(void **state) {
    ktg_context *context = *state;
    ktg_pattern *p = net_make(context, &box_and_lid);
    ktg_mesh *model = make_model(context, p, 1, 0, 0);
    renumber(model);
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_context_fail_allocation(context, ++nth);
        status = ktg_verify(context, p, model, NULL);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 30);
    end_short_memory(context, status);
    ktg_mesh_free(&model);
    ktg_pattern_free(&p);
}

static ktg_wish count_down(void *user) {
    int *left = user;
    return --*left < 0 ? KTG_STOP : KTG_GO_ON;
}

static void a_proof_can_be_interrupted_anywhere(void **state) {
    ktg_context *context = *state;
    ktg_pattern *p = net_make(context, &cube);
    ktg_mesh *model = make_model(context, p, 1, 0, 0);
    ktg_status status = KTG_CANCELLED;
    int asked = 0;
    for (; status == KTG_CANCELLED; asked++) {
        int left = asked;
        ktg_context_set_cancel(context, count_down, &left);
        status = ktg_verify(context, p, model, NULL);
        assert_int_equal(status == KTG_OK, left >= 0); /* nobody said stop */
    }
    assert_int_equal(status, KTG_OK);
    assert_true(asked > 2);
    ktg_mesh_free(&model);
    ktg_pattern_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(a_model_of_any_size_gives_the_same_verdict),
        CASE(needles_refold),
        CASE(a_hundred_thousand_faces_take_a_moment),
        CASE(a_heap_of_faces_ends_soon),
        CASE(a_pattern_that_was_written_and_read_still_holds),
        CASE(the_model_is_recognised_in_any_pose),
        CASE(the_model_may_be_numbered_otherwise),
        CASE(a_simplified_model_is_measured),
        CASE(cloth_may_strain_a_little),
        CASE(many_problems_are_counted_and_the_first_told),
        CASE(memory_may_fail_anywhere),
        CASE(a_proof_can_be_interrupted_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
