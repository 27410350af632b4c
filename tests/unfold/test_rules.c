/* The user's hand: folds that are kept, edges that are cut. */
#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"
#include "tests/short_memory.h"
#include "tests/unfold/reference.h"
#include "tests/unfold/shapes.h"
#include "unfold/rules.h"

#include <stdio.h>
#include <string.h>

#define MOST_RULES 4096

/* Rules as a test collects them. */
typedef struct hand {
    ktg_edge_rule rules[MOST_RULES];
    uint32_t count;
} hand;

static void want(hand *h, bool cut, uint32_t a, uint32_t b) {
    assert_true(h->count < MOST_RULES);
    h->rules[h->count] = (ktg_edge_rule){.vertices = {a, b},
                                         .cut = cut,
                                         .numbers = {a + 1, b + 1},
                                         .file = "rules.txt",
                                         .line = h->count + 1};
    h->count++;
}

static hand *new_hand(ktg_context *context) {
    hand *h = ktg_new(context, 1, hand);
    assert_non_null(h);
    return h;
}

static ktg_unfold_options options_with(const hand *h, ktg_unfold_method method) {
    ktg_unfold_options options;
    ktg_unfold_defaults(&options);
    options.method = method;
    options.effort = KTG_EFFORT_QUICK;
    options.population = 8;
    options.patience = 4;
    options.restarts = 2;
    options.rules = h->rules;
    options.rule_count = h->count;
    return options;
}

static void assert_obeyed(const hand *h, const ktg_pattern *p) {
    for (uint32_t i = 0; i < h->count; i++) {
        const uint32_t *wanted = h->rules[i].vertices;
        bool found = false;
        for (size_t e = 0; e < p->edge_count; e++) {
            const ktg_pattern_edge *edge = &p->edges[e];
            if (!((edge->vertices[0] == wanted[0] && edge->vertices[1] == wanted[1]) ||
                  (edge->vertices[0] == wanted[1] && edge->vertices[1] == wanted[0])))
                continue;
            found = true;
            assert_int_equal(edge->kind == KTG_EDGE_CUT, h->rules[i].cut);
            assert_int_equal(edge->forced, h->rules[i].cut);
        }
        assert_true(found);
    }
}

/* Unfolds by a method; the net is sound and does what the rules say. */
static ktg_pattern *obey(ktg_context *context, const ktg_mesh *mesh, const hand *h,
                         ktg_unfold_method method, ktg_unfold_report *report) {
    ktg_pattern *pattern;
    ktg_unfold_options options = options_with(h, method);
    ktg_status status = ktg_unfold(context, mesh, "model", &options, &pattern, report);
    if (status != KTG_OK)
        print_message("# %s\n", ktg_context_message(context));
    assert_int_equal(status, KTG_OK);
    assert_sound_net(context, mesh, pattern);
    assert_obeyed(h, pattern);
    assert_true(report->parts >= report->components && report->pieces >= report->parts);
    return pattern;
}

static void obey_both(ktg_context *context, const ktg_mesh *mesh, const hand *h, uint32_t parts,
                      uint32_t most_pieces) {
    for (ktg_unfold_method m = KTG_METHOD_AUTO; m <= KTG_METHOD_GENETIC; m++) {
        ktg_unfold_report report;
        ktg_pattern *pattern = obey(context, mesh, h, m, &report);
        assert_int_equal(report.parts, parts);
        assert_in_range(report.pieces, parts, most_pieces);
        ktg_pattern_free(&pattern);
    }
}

static void refuse(ktg_context *context, const ktg_mesh *mesh, const hand *h, ktg_status status,
                   const char *words) {
    for (ktg_unfold_method m = KTG_METHOD_AUTO; m <= KTG_METHOD_GENETIC; m++) {
        ktg_unfold_options options = options_with(h, m);
        ktg_pattern *pattern;
        assert_int_equal(ktg_unfold(context, mesh, NULL, &options, &pattern, NULL), status);
        assert_null(pattern);
        if (!strstr(ktg_context_message(context), words))
            fail_msg("\"%s\" does not say \"%s\"", ktg_context_message(context), words);
    }
}

/* ---- the dual -------------------------------------------------------------------------------- */

static uint32_t components_of(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *a,
                              uint32_t **of) {
    uint32_t count;
    assert_int_equal(ktg_mesh_components(context, mesh, a, of, &count), KTG_OK);
    return count;
}

static void forced_cuts_stand_behind_the_joinable_edges(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1);
    ktg_adjacency *a;
    ktg_rules rules;
    ktg_parts parts;
    ktg_dual *dual;
    uint32_t *of;
    hand *h = new_hand(*state);
    want(h, true, mesh->faces[0], mesh->faces[1]);
    want(h, false, mesh->faces[4], mesh->faces[5]);
    ktg_unfold_options options = options_with(h, KTG_METHOD_AUTO);
    assert_int_equal(ktg_adjacency_new(*state, mesh, &a), KTG_OK);
    assert_int_equal(ktg_rules_new(*state, mesh, a, &options, &rules), KTG_OK);
    uint32_t count = components_of(*state, mesh, a, &of);
    assert_int_equal(ktg_parts_new(*state, mesh, &rules, of, count, &parts), KTG_OK);
    assert_int_equal(parts.count, 1);
    assert_int_equal(
        ktg_dual_new(*state, mesh, &rules.adjacency, parts.faces, mesh->face_count, 1, &dual),
        KTG_OK);
    ktg_rules_apply(&rules, a, dual);
    assert_int_equal(dual->edge_count, 119);
    assert_int_equal(dual->forced_count, 1);
    assert_int_equal(dual->outer_count, 0);
    const ktg_dual_edge *cut = &dual->edges[119];
    assert_int_equal(cut->halfedge[0], 0);
    assert_int_equal(dual->halfedge_edge[cut->halfedge[0]], KTG_NONE);
    assert_int_equal(dual->halfedge_edge[cut->halfedge[1]], KTG_NONE);
    assert_int_equal(cut->halfedge[1], a->twin[0]);
    assert_true(cut->length > 0);
    uint32_t kept = 0;
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        assert_int_equal(dual->edges[e].kept, dual->edges[e].rigid);
        kept += dual->edges[e].kept;
    }
    assert_int_equal(kept, 1);
    ktg_dual_free(&dual);
    ktg_parts_free(&parts);
    ktg_rules_free(&rules);
    ktg_adjacency_free(&a);
    ktg_free(of);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void cuts_to_another_part_stand_last(void **state) {
    ktg_mesh *mesh = shape_two_triangles(*state);
    ktg_adjacency *a;
    ktg_rules rules;
    ktg_dual *dual;
    hand *h = new_hand(*state);
    assert_int_equal(ktg_adjacency_new(*state, mesh, &a), KTG_OK);
    for (uint32_t g = 0; g < 3; g++)
        if (a->twin[g] != KTG_NONE)
            want(h, true, mesh->faces[g], mesh->faces[(g + 1) % 3]);
    ktg_unfold_options options = options_with(h, KTG_METHOD_AUTO);
    assert_int_equal(ktg_rules_new(*state, mesh, a, &options, &rules), KTG_OK);
    uint32_t face = 1;
    assert_int_equal(ktg_dual_new(*state, mesh, &rules.adjacency, &face, 1, 1, &dual), KTG_OK);
    ktg_rules_apply(&rules, a, dual);
    assert_int_equal(dual->edge_count, 0);
    assert_int_equal(dual->forced_count, 0);
    assert_int_equal(dual->outer_count, 1);
    assert_int_equal(dual->edges[0].halfedge[1], KTG_NONE);
    ktg_dual_free(&dual);
    ktg_rules_free(&rules);
    ktg_adjacency_free(&a);
    obey_both(*state, mesh, h, 2, 2);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

/* ---- cuts ------------------------------------------------------------------------------------ */

/* Calls for each inner edge of the mesh. */
static void want_inner_edges(ktg_context *context, const ktg_mesh *mesh, bool cut,
                             bool (*wanted)(const ktg_mesh *mesh, uint32_t a, uint32_t b),
                             hand *h) {
    ktg_adjacency *a;
    assert_int_equal(ktg_adjacency_new(context, mesh, &a), KTG_OK);
    for (uint32_t g = 0; g < a->halfedge_count; g++) {
        uint32_t from = mesh->faces[g], to = mesh->faces[g % 3 == 2 ? g - 2 : g + 1];
        if (a->twin[g] != KTG_NONE && g < a->twin[g] && wanted(mesh, from, to))
            want(h, cut, from, to);
    }
    ktg_adjacency_free(&a);
}

static bool always(const ktg_mesh *mesh, uint32_t a, uint32_t b) {
    (void)mesh, (void)a, (void)b;
    return true;
}

/* Along the middle of shape_flat(4) and of a cylinder with four rows, once around. */
static bool in_the_middle(const ktg_mesh *mesh, uint32_t a, uint32_t b) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        low = fmin(low, mesh->positions[v].y);
        high = fmax(high, mesh->positions[v].y);
    }
    double middle = (low + high) / 2, near = 1e-9 * (high - low);
    return fabs(mesh->positions[a].y - middle) < near && fabs(mesh->positions[b].y - middle) < near;
}

static void a_ring_of_cuts_parts_a_component(void **state) {
    ktg_mesh *sheet = shape_flat(*state, 4), *ball = shape_icosphere(*state, 1);
    ktg_mesh *mesh = shape_beside(*state, sheet, ball, (ktg_vec3){3, 0, 0});
    hand *h = new_hand(*state);
    want_inner_edges(*state, sheet, true, in_the_middle, h);
    assert_int_equal(h->count, 4);
    ktg_unfold_report report;
    ktg_pattern *pattern = obey(*state, mesh, h, KTG_METHOD_AUTO, &report);
    assert_int_equal(report.components, 2);
    assert_int_equal(report.parts, 3);
    assert_int_equal(report.pieces, 3);
    assert_true(report.seconds_to_one_piece > 0);
    assert_int_equal(pattern->component_count, 2);
    assert_int_equal(pattern->pieces[0].component, 0);
    assert_int_equal(pattern->pieces[1].component, 0);
    assert_int_equal(pattern->pieces[2].component, 1);
    assert_string_equal(pattern->pieces[1].name, "part 1");
    ktg_pattern_free(&pattern);
    ktg_free(h);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&sheet);
    ktg_mesh_free(&ball);
}

static void a_slit_in_a_flat_sheet_stays_open(void **state) {
    ktg_mesh *mesh = shape_flat(*state, 4);
    hand *h = new_hand(*state);
    want_inner_edges(*state, mesh, true, in_the_middle, h);
    h->count = 2; /* it no longer reaches from border to border */
    obey_both(*state, mesh, h, 1, 1);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void all_edges_may_be_cut(void **state) {
    ktg_mesh *mesh = shape_cube(*state, 2);
    hand *h = new_hand(*state);
    want_inner_edges(*state, mesh, true, always, h);
    obey_both(*state, mesh, h, mesh->face_count, mesh->face_count);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void a_rule_may_stand_twice(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1);
    hand *h = new_hand(*state);
    for (int i = 0; i < 2; i++) {
        want(h, true, mesh->faces[i], mesh->faces[1 - i]);
        want(h, false, mesh->faces[3 + i], mesh->faces[4 - i]);
    }
    obey_both(*state, mesh, h, 1, 1);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void random_rules_are_obeyed_or_refused(void **state) {
    ktg_mesh *meshes[] = {shape_icosphere(*state, 2), shape_cube(*state, 4),
                          shape_knot(*state, 24, 4), shape_star(*state, 0.5)};
    uint32_t obeyed = 0;
    ktg_random random;
    ktg_random_seed(&random, 5);
    for (int i = 0; i < 24; i++) {
        const ktg_mesh *mesh = meshes[i % 4];
        hand *h = new_hand(*state);
        ktg_adjacency *a;
        assert_int_equal(ktg_adjacency_new(*state, mesh, &a), KTG_OK);
        double keep = 0.6 * ktg_random_unit(&random), cut = 0.3 * ktg_random_unit(&random);
        for (uint32_t g = 0; g < a->halfedge_count; g++) {
            double draw = ktg_random_unit(&random);
            if (a->twin[g] != KTG_NONE && g < a->twin[g] && draw < keep + cut)
                want(h, draw > keep, mesh->faces[g], mesh->faces[g % 3 == 2 ? g - 2 : g + 1]);
        }
        for (ktg_unfold_method m = KTG_METHOD_AUTO; m <= KTG_METHOD_GENETIC; m++) {
            ktg_unfold_options options = options_with(h, m);
            ktg_pattern *pattern;
            ktg_status status = ktg_unfold(*state, mesh, NULL, &options, &pattern, NULL);
            if (status == KTG_OK) {
                assert_sound_net(*state, mesh, pattern);
                assert_obeyed(h, pattern);
                obeyed++;
            } else {
                assert_int_equal(status, KTG_GEOMETRY);
                assert_non_null(strstr(ktg_context_message(*state), "rules.txt:"));
            }
            ktg_pattern_free(&pattern);
        }
        ktg_adjacency_free(&a);
        ktg_free(h);
    }
    print_message("# %u of 48 obeyed\n", obeyed);
    assert_in_range(obeyed, 20, 47);
    for (int i = 0; i < 4; i++)
        ktg_mesh_free(&meshes[i]);
}

/* ---- folds ----------------------------------------------------------------------------------- */

static void a_flat_sheet_may_be_kept_whole(void **state) {
    ktg_mesh *mesh = shape_flat(*state, 6);
    hand *h = new_hand(*state);
    want_inner_edges(*state, mesh, false, always, h);
    obey_both(*state, mesh, h, 1, 1);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void folds_around_a_vertex_that_is_not_flat_are_refused_by_its_number(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1);
    hand *h = new_hand(*state);
    uint32_t corner = mesh->faces[0];
    for (uint32_t g = 0; g < 3 * mesh->face_count; g++)
        if (mesh->faces[g] == corner)
            want(h, false, mesh->faces[g % 3 == 2 ? g - 2 : g + 1], corner);
    char words[64];
    snprintf(words, sizeof words, "around vertex %u ", corner + 1);
    refuse(*state, mesh, h, KTG_GEOMETRY, words);
    refuse(*state, mesh, h, KTG_GEOMETRY, "(rules.txt:");
    h->count--;
    obey_both(*state, mesh, h, 1, 1);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void a_ring_of_folds_is_refused(void **state) {
    ktg_mesh *mesh = shape_cylinder(*state, 8, 1);
    hand *h = new_hand(*state);
    want_inner_edges(*state, mesh, false, always, h);
    refuse(*state, mesh, h, KTG_GEOMETRY, "a ring of faces, and no net does without a cut");
    h->count--;
    obey_both(*state, mesh, h, 1, 1);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void a_ring_through_polygons_is_refused(void **state) {
    ktg_mesh *mesh = shape_cube(*state, 1);
    hand *h = new_hand(*state);
    ktg_adjacency *a;
    assert_int_equal(ktg_adjacency_new(*state, mesh, &a), KTG_OK);
    for (uint32_t g = 0; g < a->halfedge_count; g++) {
        ktg_vec3 p = mesh->positions[mesh->faces[g]];
        ktg_vec3 q = mesh->positions[mesh->faces[g % 3 == 2 ? g - 2 : g + 1]];
        if (g < a->twin[g] && fabs(p.x - q.x) + fabs(p.y - q.y) < 1e-9)
            want(h, false, mesh->faces[g], mesh->faces[g % 3 == 2 ? g - 2 : g + 1]);
    }
    assert_int_equal(h->count, 4);
    refuse(*state, mesh, h, KTG_GEOMETRY, "a ring of faces");
    h->count--;
    obey_both(*state, mesh, h, 1, 1);
    ktg_free(h);
    ktg_adjacency_free(&a);
    ktg_mesh_free(&mesh);
}

/* A fan of thirteen faces of 30 degrees around a corner, all but its last edge: 390 degrees. */
static void folds_that_hold_overlapping_faces_are_refused(void **state) {
    ktg_vec3 positions[15] = {{0, 0, 0}};
    uint32_t faces[39];
    for (uint32_t i = 0; i < 14; i++) {
        double angle = KTG_PI / 6 * i;
        positions[i + 1] = (ktg_vec3){cos(angle), sin(angle), 0.02 * i};
    }
    for (uint32_t i = 0; i < 13; i++) {
        faces[3 * i] = 0;
        faces[3 * i + 1] = i + 1;
        faces[3 * i + 2] = i + 2;
    }
    ktg_mesh *mesh = shape_mesh(*state, positions, 15, faces, 13);
    hand *h = new_hand(*state);
    want_inner_edges(*state, mesh, false, always, h);
    assert_int_equal(h->count, 12);
    refuse(*state, mesh, h, KTG_GEOMETRY, "hold 13 faces together that overlap");
    h->rules[6].cut = true;
    obey_both(*state, mesh, h, 2, 2);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void rules_that_make_no_sense_are_refused(void **state) {
    ktg_mesh *mesh = shape_flat(*state, 2);
    hand *h = new_hand(*state);
    want(h, true, 0, UINT32_MAX);
    refuse(*state, mesh, h, KTG_ARGUMENT, "is no edge of the surface");
    h->count = 0;
    want(h, true, 0, 8);
    refuse(*state, mesh, h, KTG_ARGUMENT, "edge 1-9 (rules.txt:1) is no edge");
    h->count = 0;
    want(h, true, 0, 0);
    refuse(*state, mesh, h, KTG_ARGUMENT, "is no edge of the surface");
    h->count = 0;
    want(h, false, 0, 1);
    refuse(*state, mesh, h, KTG_ARGUMENT, "lies on the border");
    h->count = 0;
    want(h, false, 1, 4);
    want(h, true, 4, 1);
    refuse(*state, mesh, h, KTG_ARGUMENT,
           "edge 5-2 (rules.txt:2) is both to be kept and to be cut: so says edge 2-5");
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

static void memory_running_out_with_rules_is_a_status(void **state) {
    ktg_mesh *mesh = shape_cube(*state, 2);
    hand *h = new_hand(*state);
    ktg_pattern *pattern;
    want(h, true, mesh->faces[0], mesh->faces[1]);
    want(h, false, mesh->faces[6], mesh->faces[7]);
    want(h, false, mesh->faces[15], mesh->faces[16]);
    want(h, false, mesh->faces[16], mesh->faces[17]);
    ktg_unfold_options options = options_with(h, KTG_METHOD_AUTO);
    ktg_status status = KTG_MEMORY;
    uint64_t k = 1;
    for (; status == KTG_MEMORY; k++) {
        ktg_context_fail_allocation(*state, k);
        status = ktg_unfold(*state, mesh, "model", &options, &pattern, NULL);
        assert_true(status == KTG_OK ? pattern != NULL : pattern == NULL);
    }
    end_short_memory(*state, status);
    assert_int_equal(status, KTG_OK);
    assert_true(k > 100);
    ktg_pattern_free(&pattern);
    ktg_free(h);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forced_cuts_stand_behind_the_joinable_edges),
        cmocka_unit_test(cuts_to_another_part_stand_last),
        cmocka_unit_test(a_ring_of_cuts_parts_a_component),
        cmocka_unit_test(a_slit_in_a_flat_sheet_stays_open),
        cmocka_unit_test(all_edges_may_be_cut),
        cmocka_unit_test(a_rule_may_stand_twice),
        cmocka_unit_test(random_rules_are_obeyed_or_refused),
        cmocka_unit_test(a_flat_sheet_may_be_kept_whole),
        cmocka_unit_test(folds_around_a_vertex_that_is_not_flat_are_refused_by_its_number),
        cmocka_unit_test(a_ring_of_folds_is_refused),
        cmocka_unit_test(a_ring_through_polygons_is_refused),
        cmocka_unit_test(folds_that_hold_overlapping_faces_are_refused),
        cmocka_unit_test(rules_that_make_no_sense_are_refused),
        cmocka_unit_test(memory_running_out_with_rules_is_a_status),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
