/* The whole unfolding: what every net must hold, whatever the model. */
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"
#include "tests/short_memory.h"
#include "tests/unfold/reference.h"
#include "tests/unfold/shapes.h"
#include "unfold/unfold.h"

#include <stdlib.h>
#include <string.h>

static ktg_unfold_options options_of(ktg_unfold_method method) {
    ktg_unfold_options options;
    ktg_unfold_defaults(&options);
    options.method = method;
    options.effort = KTG_EFFORT_QUICK;
    return options;
}

/* Little work, where something is done often. */
static ktg_unfold_options quick(void) {
    ktg_unfold_options options = options_of(KTG_METHOD_GENETIC);
    options.population = 8;
    options.patience = 4;
    options.restarts = 2;
    return options;
}

static ktg_pattern *unfold_by(ktg_context *context, ktg_unfold_method method, const ktg_mesh *mesh,
                              ktg_unfold_report *report) {
    ktg_pattern *pattern;
    ktg_unfold_options options = options_of(method);
    assert_int_equal(ktg_unfold(context, mesh, "model", &options, &pattern, report), KTG_OK);
    return pattern;
}

/* By transplants. */
static ktg_pattern *unfold(ktg_context *context, const ktg_mesh *mesh, ktg_unfold_report *report) {
    return unfold_by(context, KTG_METHOD_AUTO, mesh, report);
}

static ktg_pattern *unfold_quickly(ktg_context *context, const ktg_mesh *mesh,
                                   ktg_unfold_report *report) {
    ktg_pattern *pattern;
    ktg_unfold_options options = quick();
    assert_int_equal(ktg_unfold(context, mesh, "model", &options, &pattern, report), KTG_OK);
    return pattern;
}

/* Unfolds by each method, checks, frees the mesh; at most `most` pieces. */
static void assert_unfolds(ktg_context *context, ktg_mesh *mesh, uint32_t most) {
    for (ktg_unfold_method method = KTG_METHOD_AUTO; method <= KTG_METHOD_GENETIC; method++) {
        ktg_unfold_report report;
        ktg_pattern *pattern = unfold_by(context, method, mesh, &report);
        assert_sound_net(context, mesh, pattern);
        assert_int_equal(report.pieces, pattern->piece_count);
        assert_int_equal(report.components, pattern->component_count);
        assert_in_range(report.pieces, report.components, most);
        if (method == KTG_METHOD_GENETIC)
            assert_in_range(report.strips, report.components, mesh->face_count);
        assert_int_equal(report.stopped_by, KTG_STOPPED_DONE);
        ktg_pattern_free(&pattern);
    }
    ktg_mesh_free(&mesh);
}

static void the_smallest_surfaces_unfold(void **state) {
    assert_unfolds(*state, shape_triangle(*state), 1);
    assert_unfolds(*state, shape_two_triangles(*state), 1);
    assert_unfolds(*state, shape_tetrahedron(*state), 1);
}

static void two_faces_with_three_common_edges_unfold(void **state) {
    static const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0}};
    static const uint32_t faces[] = {0, 1, 2, 0, 2, 1};
    assert_unfolds(*state, shape_mesh(*state, positions, 3, faces, 2), 1);
}

static void vertices_without_faces_change_nothing(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1), *far = shape_triangle(*state);
    ktg_mesh *both = shape_beside(*state, mesh, far, (ktg_vec3){1e9, 0, 0});
    both->face_count--; /* the triangle's vertices stay */
    ktg_pattern *plain = unfold(*state, mesh, NULL), *pattern = unfold(*state, both, NULL);
    assert_same_net(plain, pattern, 1);
    assert_sound_net(*state, both, pattern);
    ktg_pattern_free(&plain);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&far);
    ktg_mesh_free(&both);
}

static void round_models_unfold_into_one_piece(void **state) {
    assert_unfolds(*state, shape_icosphere(*state, 0), 1);
    assert_unfolds(*state, shape_icosphere(*state, 1), 1);
    assert_unfolds(*state, shape_icosphere(*state, 2), 1);
}

static void models_with_saddles_unfold_into_few_pieces(void **state) {
    assert_unfolds(*state, shape_bumpy_sphere(*state), 2);
    assert_unfolds(*state, shape_star(*state, 0.5), 2);
    assert_unfolds(*state, shape_torus(*state, 12, 8), 2);
    assert_unfolds(*state, shape_knot(*state, 30, 4), 2);
}

static void open_models_unfold(void **state) {
    assert_unfolds(*state, shape_cylinder(*state, 16, 5), 1);
    /* cuts must go from border to border, as none may end at a saddle: never one piece */
    assert_unfolds(*state, shape_saddle(*state, 8), 7);
}

static void needles_unfold(void **state) {
    assert_unfolds(*state, shape_needle(*state, 16, 1e-3), 1);
    assert_unfolds(*state, shape_needle(*state, 16, 1e-5), 1);
}

static void each_component_has_pieces_of_its_own(void **state) {
    ktg_mesh *mesh = shape_several(*state);
    ktg_unfold_report report;
    ktg_pattern *pattern = unfold(*state, mesh, &report);
    assert_sound_net(*state, mesh, pattern);
    assert_int_equal(pattern->component_count, 4);
    assert_int_equal(report.components, 4);
    assert_in_range(pattern->piece_count, 4, 5);
    assert_string_equal(pattern->components[3].name, "part 4");
    const ktg_pattern_piece *last = &pattern->pieces[pattern->piece_count - 1];
    assert_int_equal(last->component, 3);
    assert_int_equal(last->faces[0], mesh->face_count - 1);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void a_cube_of_quadrangles_is_never_cut_inside_them(void **state) {
    for (uint32_t side = 1; side <= 4; side++)
        for (uint64_t seed = 1; seed <= 3; seed++) {
            ktg_mesh *cube = shape_cube(*state, side);
            ktg_context_set_seed(*state, seed);
            ktg_pattern *pattern = unfold_quickly(*state, cube, NULL);
            assert_sound_net(*state, cube, pattern);
            assert_int_equal(pattern->piece_count, 1);
            for (size_t e = 0; e < pattern->edge_count; e++) {
                const ktg_pattern_edge *edge = &pattern->edges[e];
                if (edge->sides[0].face / 2 == edge->sides[1].face / 2)
                    assert_int_equal(edge->kind, KTG_EDGE_FLAT);
                else if (fabs(edge->angle) > 1)
                    assert_true(edge->kind == KTG_EDGE_MOUNTAIN || edge->kind == KTG_EDGE_CUT);
            }
            ktg_pattern_free(&pattern);
            ktg_mesh_free(&cube);
        }
    ktg_context_set_seed(*state, 1);
}

/* The cut edges at every vertex. */
static uint32_t *cuts_at(ktg_context *context, const ktg_pattern *pattern) {
    uint32_t *cuts = ktg_new(context, pattern->vertex_count, uint32_t);
    for (size_t e = 0; e < pattern->edge_count; e++)
        for (int i = 0; i < 2 && pattern->edges[e].kind == KTG_EDGE_CUT; i++)
            cuts[pattern->edges[e].vertices[i]]++;
    return cuts;
}

static void no_cut_ends_in_a_flat_vertex(void **state) {
    ktg_mesh *cube = shape_cube(*state, 5);
    double *sums = ktg_new(*state, cube->vertex_count, double);
    reference_angle_sums(cube, sums);
    ktg_pattern *pattern = unfold_quickly(*state, cube, NULL);
    assert_sound_net(*state, cube, pattern);
    uint32_t *cuts = cuts_at(*state, pattern), flat = 0, open = 0;
    for (uint32_t v = 0; v < cube->vertex_count; v++) {
        bool is_flat = fabs(sums[v] - 2 * KTG_PI) < 1e-9;
        assert_true(is_flat ? cuts[v] != 1 : cuts[v] >= 1);
        flat += is_flat;
        open += is_flat && cuts[v] > 0;
    }
    assert_int_equal(flat, cube->vertex_count - 8);
    assert_true(open < flat / 2);
    ktg_free(cuts);
    ktg_free(sums);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&cube);
}

static void a_flat_sheet_has_no_cut_at_all(void **state) {
    ktg_mesh *sheet = shape_flat(*state, 8);
    ktg_pattern *pattern = unfold(*state, sheet, NULL);
    assert_sound_net(*state, sheet, pattern);
    assert_int_equal(pattern->piece_count, 1);
    assert_int_equal(pattern->pieces[0].vertex_count, sheet->vertex_count);
    for (size_t e = 0; e < pattern->edge_count; e++)
        assert_int_equal(pattern->edges[e].kind,
                         pattern->edges[e].side_count == 1 ? KTG_EDGE_BORDER : KTG_EDGE_FLAT);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&sheet);
}

static void a_flat_ring_keeps_the_cut_that_makes_it_one_walk(void **state) {
    for (uint64_t seed = 1; seed <= 5; seed++) {
        ktg_mesh *ring = shape_flat(*state, 3);
        ring->face_count -= 2; /* the middle square goes, the last one takes its place */
        memcpy(ring->faces + 24, ring->faces + 48, 6 * sizeof *ring->faces);
        ktg_context_set_seed(*state, seed);
        ktg_pattern *pattern = unfold_quickly(*state, ring, NULL);
        assert_sound_net(*state, ring, pattern);
        assert_int_equal(pattern->piece_count, 1);
        uint32_t cuts = 0;
        for (size_t e = 0; e < pattern->edge_count; e++)
            cuts += pattern->edges[e].kind == KTG_EDGE_CUT;
        assert_int_equal(cuts, 1); /* no vertex lies inside, so any longer one would part it */
        ktg_pattern_free(&pattern);
        ktg_mesh_free(&ring);
    }
    ktg_context_set_seed(*state, 1);
}

static void a_nearly_flat_sheet_keeps_its_lengths(void **state) {
    ktg_mesh *sheet = shape_flat(*state, 16);
    ktg_random random;
    ktg_random_seed(&random, 1);
    for (uint32_t v = 0; v < sheet->vertex_count; v++)
        sheet->positions[v].z = 5e-6 * ktg_random_unit(&random);
    ktg_pattern *pattern = unfold_quickly(*state, sheet, NULL);
    assert_sound_net(*state, sheet, pattern);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&sheet);
}

static void saddles_have_two_cuts_and_others_one(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    double *sums = ktg_new(*state, mesh->vertex_count, double);
    reference_angle_sums(mesh, sums);
    ktg_pattern *pattern = unfold(*state, mesh, NULL);
    uint32_t *cuts = cuts_at(*state, pattern);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        assert_true(cuts[v] >= (sums[v] > 2 * KTG_PI + 1e-7 ? 2u : 1u));
    ktg_free(cuts);
    ktg_free(sums);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void folds_of_a_convex_model_are_mountains_and_turned_inside_out_valleys(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1);
    for (int inside = 0; inside < 2; inside++) {
        ktg_pattern *pattern = unfold_quickly(*state, mesh, NULL);
        assert_sound_net(*state, mesh, pattern);
        for (size_t e = 0; e < pattern->edge_count; e++) {
            const ktg_pattern_edge *edge = &pattern->edges[e];
            assert_true(inside ? edge->angle < 0 : edge->angle > 0);
            if (edge->kind != KTG_EDGE_CUT)
                assert_int_equal(edge->kind, inside ? KTG_EDGE_VALLEY : KTG_EDGE_MOUNTAIN);
        }
        ktg_pattern_free(&pattern);
        for (uint32_t f = 0; f < mesh->face_count; f++) {
            uint32_t corner = mesh->faces[3 * f];
            mesh->faces[3 * f] = mesh->faces[3 * f + 1];
            mesh->faces[3 * f + 1] = corner;
        }
    }
    ktg_mesh_free(&mesh);
}

/* ---- the same again ---------------------------------------------------------------------------*/

static void the_same_seed_gives_the_same_net_and_another_seed_another(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    ktg_unfold_report first, second;
    ktg_pattern *one = unfold(*state, mesh, &first), *same = unfold(*state, mesh, &second);
    assert_same_net(one, same, 1);
    assert_int_equal(first.evaluations, second.evaluations);
    assert_int_equal(first.generations, second.generations);
    ktg_context_set_seed(*state, 77);
    ktg_pattern *other = unfold(*state, mesh, NULL);
    assert_false(same_folds(one, other));
    assert_sound_net(*state, mesh, other);
    ktg_context_set_seed(*state, 1);
    ktg_pattern_free(&one);
    ktg_pattern_free(&same);
    ktg_pattern_free(&other);
    ktg_mesh_free(&mesh);
}

static void a_model_scaled_by_a_power_of_two_has_the_same_net(void **state) {
    ktg_mesh *mesh = shape_star(*state, 0.45);
    ktg_pattern *plain = unfold(*state, mesh, NULL);
    static const int powers[] = {-240, -30, -1, 7, 60, 240};
    for (int i = 0; i < 6; i++) {
        double factor = ldexp(1, powers[i]);
        ktg_mesh *scaled = shape_scaled(*state, mesh, factor);
        ktg_pattern *pattern = unfold(*state, scaled, NULL);
        assert_same_net(plain, pattern, factor);
        ktg_pattern_free(&pattern);
        ktg_mesh_free(&scaled);
    }
    ktg_pattern_free(&plain);
    ktg_mesh_free(&mesh);
}

static void a_moved_turned_or_renumbered_model_has_as_good_a_net(void **state) {
    ktg_mesh *mesh = shape_star(*state, 0.45);
    ktg_unfold_report report;
    ktg_pattern *plain = unfold(*state, mesh, &report);
    assert_unfolds(*state, shape_turned(*state, mesh, 0, (ktg_vec3){100, -7, 3}),
                   report.pieces + 1);
    assert_unfolds(*state, shape_turned(*state, mesh, 1.1, (ktg_vec3){0, 0, 0}), report.pieces + 1);
    assert_unfolds(*state, shape_renumbered(*state, mesh, 5), report.pieces + 1);
    assert_unfolds(*state, shape_renumbered(*state, mesh, 6), report.pieces + 1);
    ktg_pattern_free(&plain);
    ktg_mesh_free(&mesh);
}

/* ---- limits -----------------------------------------------------------------------------------*/

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
    ktg_pattern *pattern = unfold(*state, mesh, &report);
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
        cmocka_unit_test(the_smallest_surfaces_unfold),
        cmocka_unit_test(two_faces_with_three_common_edges_unfold),
        cmocka_unit_test(vertices_without_faces_change_nothing),
        cmocka_unit_test(round_models_unfold_into_one_piece),
        cmocka_unit_test(models_with_saddles_unfold_into_few_pieces),
        cmocka_unit_test(open_models_unfold),
        cmocka_unit_test(needles_unfold),
        cmocka_unit_test(each_component_has_pieces_of_its_own),
        cmocka_unit_test(a_cube_of_quadrangles_is_never_cut_inside_them),
        cmocka_unit_test(no_cut_ends_in_a_flat_vertex),
        cmocka_unit_test(a_flat_sheet_has_no_cut_at_all),
        cmocka_unit_test(a_flat_ring_keeps_the_cut_that_makes_it_one_walk),
        cmocka_unit_test(a_nearly_flat_sheet_keeps_its_lengths),
        cmocka_unit_test(saddles_have_two_cuts_and_others_one),
        cmocka_unit_test(folds_of_a_convex_model_are_mountains_and_turned_inside_out_valleys),
        cmocka_unit_test(the_same_seed_gives_the_same_net_and_another_seed_another),
        cmocka_unit_test(a_model_scaled_by_a_power_of_two_has_the_same_net),
        cmocka_unit_test(a_moved_turned_or_renumbered_model_has_as_good_a_net),
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
