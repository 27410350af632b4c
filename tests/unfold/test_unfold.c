/* The whole unfolding: what every net must hold, whatever the model. */
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"
#include "tests/unfold/reference.h"
#include "tests/unfold/shapes.h"
#include "tests/unfold/unfolding.h"

#include <stdlib.h>
#include <string.h>

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
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
