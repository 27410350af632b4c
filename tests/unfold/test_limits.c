/* What ends an unfolding before its time, and what is not unfolded at all. */
#include "core/memory.h"
#include "core/vec.h"
#include "tests/short_memory.h"
#include "tests/unfold/reference.h"
#include "tests/unfold/shapes.h"
#include "tests/unfold/unfolding.h"

typedef struct asker {
    uint32_t calls, from;
    ktg_wish wish;
} asker;

static ktg_wish ask(void *user) {
    asker *a = user;
    return a->calls++ >= a->from ? a->wish : KTG_GO_ON;
}

static void a_wish_to_finish_gives_a_sound_net_early(void **state) {
    ktg_mesh *mesh = shape_several(*state);
    for (uint32_t from = 0; from < 100; from = 3 * from + 1) {
        asker user = {.from = from, .wish = KTG_FINISH};
        ktg_unfold_report report;
        ktg_context_set_cancel(*state, ask, &user);
        ktg_pattern *pattern = unfold_by(*state, KTG_METHOD_GENETIC, mesh, &report);
        assert_int_equal(report.stopped_by, KTG_STOPPED_INTERRUPT);
        assert_in_range(report.evaluations, 1, from + 4);
        assert_sound_net(*state, mesh, pattern);
        ktg_pattern_free(&pattern);
    }
    ktg_context_set_cancel(*state, NULL, NULL);
    ktg_mesh_free(&mesh);
}

static void a_wish_to_stop_cancels_soon(void **state) {
    ktg_mesh *mesh = shape_several(*state);
    for (uint32_t from = 0; from < 100; from = 3 * from + 1) {
        asker user = {.from = from, .wish = KTG_STOP};
        ktg_pattern *pattern = (ktg_pattern *)&user;
        ktg_unfold_options options = options_of(KTG_METHOD_GENETIC);
        ktg_context_set_cancel(*state, ask, &user);
        assert_int_equal(ktg_unfold(*state, mesh, NULL, &options, &pattern, NULL), KTG_CANCELLED);
        assert_null(pattern);
        assert_in_range(user.calls, from + 1, from + 3);
    }
    ktg_context_set_cancel(*state, NULL, NULL);
    ktg_mesh_free(&mesh);
}

/* And whenever it comes: nobody takes it for a wish to finish. */
static void a_wish_to_stop_is_never_overheard(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 0);
    for (int sheets = 0; sheets < 2; sheets++) {
        ktg_unfold_options options = quick();
        ktg_status status = KTG_CANCELLED;
        uint32_t from = 0;
        options.population = 4;
        options.patience = 1;
        options.restarts = 1;
        options.mm_per_unit = sheets ? 150 : 0;
        for (; status == KTG_CANCELLED; from++) {
            asker user = {.from = from, .wish = KTG_STOP};
            ktg_pattern *pattern;
            ktg_context_set_cancel(*state, ask, &user);
            status = ktg_unfold(*state, mesh, NULL, &options, &pattern, NULL);
            assert_int_equal(status == KTG_OK, user.calls <= from);
            ktg_pattern_free(&pattern);
        }
        assert_int_equal(status, KTG_OK);
        assert_true(from > 5);
    }
    ktg_context_set_cancel(*state, NULL, NULL);
    ktg_mesh_free(&mesh);
}

static void transplants_can_be_ended_and_stopped_too(void **state) {
    ktg_mesh *mesh = shape_knot(*state, 60, 6);
    asker user = {.wish = KTG_FINISH};
    ktg_unfold_report report;
    ktg_context_set_cancel(*state, ask, &user);
    ktg_pattern *pattern = unfold_by(*state, KTG_METHOD_AUTO, mesh, &report);
    assert_int_equal(report.stopped_by, KTG_STOPPED_INTERRUPT);
    assert_sound_net(*state, mesh, pattern);
    ktg_pattern_free(&pattern);
    user = (asker){.wish = KTG_STOP};
    assert_int_equal(ktg_unfold(*state, mesh, NULL, NULL, &pattern, NULL), KTG_CANCELLED);
    assert_null(pattern);
    ktg_context_set_cancel(*state, NULL, NULL);
    ktg_mesh_free(&mesh);
}

static void a_time_limit_stops_the_search_not_the_answer(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    ktg_unfold_options options = options_of(KTG_METHOD_GENETIC);
    ktg_unfold_report report;
    ktg_pattern *pattern;
    options.seconds = 1e-9;
    assert_int_equal(ktg_unfold(*state, mesh, NULL, &options, &pattern, &report), KTG_OK);
    assert_int_equal(report.stopped_by, KTG_STOPPED_TIME);
    assert_int_equal(report.evaluations, 1);
    assert_sound_net(*state, mesh, pattern);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void used_up_generations_are_reported(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    ktg_unfold_options options = quick();
    ktg_unfold_report report;
    ktg_pattern *pattern;
    options.generations = 1;
    options.restarts = 0;
    assert_int_equal(ktg_unfold(*state, mesh, NULL, &options, &pattern, &report), KTG_OK);
    assert_int_equal(report.stopped_by, KTG_STOPPED_WORK);
    assert_int_equal(report.generations, 1);
    assert_sound_net(*state, mesh, pattern);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
    assert_string_equal(ktg_stopped_by_name(KTG_STOPPED_DONE), "done");
    assert_string_equal(ktg_stopped_by_name(KTG_STOPPED_WORK), "work");
    assert_string_equal(ktg_stopped_by_name(KTG_STOPPED_TIME), "time");
    assert_string_equal(ktg_stopped_by_name(KTG_STOPPED_INTERRUPT), "interrupt");
}

typedef struct listener {
    uint32_t calls;
    double last;
} listener;

static void listen(void *user, const char *stage, double fraction, const char *detail) {
    listener *l = user;
    assert_string_equal(stage, "unfold");
    assert_non_null(detail);
    assert_true(fraction >= l->last && fraction <= 1);
    l->last = fraction;
    l->calls++;
}

static void progress_never_runs_backwards(void **state) {
    ktg_mesh *knot = shape_knot(*state, 30, 4), *torus = shape_torus(*state, 8, 5);
    ktg_mesh *mesh = shape_beside(*state, knot, torus, (ktg_vec3){2, 0, 0});
    listener user = {0};
    ktg_context_set_progress(*state, listen, &user);
    for (ktg_unfold_method method = KTG_METHOD_AUTO; method <= KTG_METHOD_GENETIC; method++) {
        user = (listener){0};
        ktg_pattern *pattern = unfold_by(*state, method, mesh, NULL);
        assert_true(user.calls > (method == KTG_METHOD_GENETIC ? 4 : 0));
        ktg_pattern_free(&pattern);
    }
    ktg_context_set_progress(*state, NULL, NULL);
    ktg_mesh_free(&knot);
    ktg_mesh_free(&torus);
    ktg_mesh_free(&mesh);
}

/* ---- what is refused --------------------------------------------------------------------------*/

static void assert_refused(ktg_context *context, const ktg_mesh *mesh,
                           const ktg_unfold_options *options, ktg_status status) {
    ktg_pattern *pattern = (ktg_pattern *)&options;
    assert_int_equal(ktg_unfold(context, mesh, NULL, options, &pattern, NULL), status);
    assert_null(pattern);
    assert_string_not_equal(ktg_context_message(context), "");
}

static void options_out_of_range_are_refused(void **state) {
    ktg_mesh *mesh = shape_tetrahedron(*state);
    ktg_unfold_options good = quick(), bad[9];
    for (int i = 0; i < 9; i++)
        bad[i] = good;
    bad[0].population = 3;
    bad[1].population = UINT32_MAX;
    bad[2].crossover_rate = -0.1;
    bad[3].crossover_rate = 1.1;
    bad[4].crossover_rate = NAN;
    bad[5].mutation_rate = -0.1;
    bad[6].mutation_rate = NAN;
    bad[7].seconds = -1;
    bad[8].seconds = NAN;
    for (int i = 0; i < 9; i++)
        assert_refused(*state, mesh, &bad[i], KTG_ARGUMENT);
    ktg_mesh_free(&mesh);
}

static void refuse_mesh(ktg_context *context, const ktg_vec3 *positions, uint32_t vertex_count,
                        const uint32_t *faces, uint32_t face_count, ktg_status status) {
    ktg_unfold_options options = quick();
    ktg_mesh *mesh = shape_mesh(context, positions, vertex_count, faces, face_count);
    assert_refused(context, mesh, &options, status);
    ktg_mesh_free(&mesh);
}

static void what_is_no_oriented_manifold_is_refused(void **state) {
    static const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0},
                                         {0, 0, 1}, {0, -1, 0}, {0, -1, 1}};
    static const uint32_t three_at_an_edge[] = {0, 1, 2, 1, 0, 3, 1, 0, 4};
    static const uint32_t turned[] = {0, 1, 2, 0, 1, 3};
    static const uint32_t touching_in_a_vertex[] = {0, 1, 2, 0, 4, 5};
    static const uint32_t folded_on_itself[] = {0, 1, 0};
    refuse_mesh(*state, positions, 6, three_at_an_edge, 3, KTG_ARGUMENT);
    refuse_mesh(*state, positions, 6, turned, 2, KTG_ARGUMENT);
    refuse_mesh(*state, positions, 6, touching_in_a_vertex, 2, KTG_ARGUMENT);
    refuse_mesh(*state, positions, 6, folded_on_itself, 1, KTG_ARGUMENT);
}

static void what_has_no_size_is_refused(void **state) {
    static const uint32_t face[] = {0, 1, 2};
    static const ktg_vec3 point[] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    static const ktg_vec3 line[] = {{0, 0, 0}, {0, 0, 0}, {1, 2, 3}};
    static const ktg_vec3 flat[] = {{0, 0, 0}, {1, 1, 2}, {2, 2, 4}};
    static const ktg_vec3 tiny[] = {{0, 0, 0}, {1e-100, 0, 0}, {0, 1e-100, 0}};
    static const ktg_vec3 huge[] = {{-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0}};
    refuse_mesh(*state, point, 3, face, 0, KTG_GEOMETRY);
    refuse_mesh(*state, point, 3, face, 1, KTG_GEOMETRY);
    refuse_mesh(*state, line, 3, face, 1, KTG_ARGUMENT);
    refuse_mesh(*state, flat, 3, face, 1, KTG_ARGUMENT);
    refuse_mesh(*state, tiny, 3, face, 1, KTG_GEOMETRY);
    refuse_mesh(*state, huge, 3, face, 1, KTG_GEOMETRY);
}

static void fail_allocations(ktg_context *context, const ktg_unfold_options *options) {
    ktg_mesh *mesh = shape_several(context);
    ktg_status status = KTG_MEMORY;
    ktg_pattern *pattern;
    uint64_t k = 1;
    for (; status == KTG_MEMORY; k += k < 150 ? 1 : 7) {
        ktg_context_fail_allocation(context, k);
        status = ktg_unfold(context, mesh, "model", options, &pattern, NULL);
        assert_true(status == KTG_OK ? pattern != NULL : pattern == NULL);
    }
    end_short_memory(context, status);
    assert_int_equal(status, KTG_OK);
    assert_true(k > 100);
    assert_sound_net(context, mesh, pattern);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void memory_running_out_anywhere_is_a_status(void **state) {
    ktg_unfold_options options = quick();
    options.population = 4;
    options.patience = 1;
    options.restarts = 1;
    fail_allocations(*state, &options);
    options.method = KTG_METHOD_AUTO;
    options.seconds = 0.02; /* annealing takes no memory */
    fail_allocations(*state, &options);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wish_to_finish_gives_a_sound_net_early),
        cmocka_unit_test(a_wish_to_stop_cancels_soon),
        cmocka_unit_test(a_wish_to_stop_is_never_overheard),
        cmocka_unit_test(transplants_can_be_ended_and_stopped_too),
        cmocka_unit_test(a_time_limit_stops_the_search_not_the_answer),
        cmocka_unit_test(used_up_generations_are_reported),
        cmocka_unit_test(progress_never_runs_backwards),
        cmocka_unit_test(options_out_of_range_are_refused),
        cmocka_unit_test(what_is_no_oriented_manifold_is_refused),
        cmocka_unit_test(what_has_no_size_is_refused),
        cmocka_unit_test(memory_running_out_anywhere_is_a_status),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
