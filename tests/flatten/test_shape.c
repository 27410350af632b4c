/* Shapes that follow handles: Igarashi & Igarashi 2009, sections 3 to 6. */
#include "tests/flatten/shape_help.h"
#include "tests/short_memory.h"

/* Far away, tiny, and seen from behind. */
static ktg_vec3 mirrored(double u, double v) {
    return (ktg_vec3){1e-4 * (7 - u), 1e-4 * v - 3e-3, 5};
}

static ktg_vec2 transform(double c, double s, ktg_vec2 p) {
    return (ktg_vec2){c * p.x - s * p.y + 17, s * p.x + c * p.y - 5};
}

static double farthest(const ktg_vec2 *a, const ktg_vec2 *b, uint32_t count) {
    double most = 0;
    for (uint32_t v = 0; v < count; v++)
        most = fmax(most, ktg_length2(ktg_sub2(a[v], b[v])));
    return most;
}

static void exact_handles_are_where_they_are_wanted(void **state) {
    ktg_context *context = *state;
    for (int weight = 0; weight < 2; weight++) {
        ktg_shape *shape = registered(context, square, (ktg_edge_weight)weight);
        ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                                at(context, shape, 33.3, 71.9), at(context, shape, 34.1, 71.2),
                                ktg_handle_at_vertex(COUNT - 1)};
        ktg_vec2 targets[] = {{-20, 5}, {140, 20}, {50, 90}, {50.5, 88}, {90, 160}};
        ktg_vec2 positions[COUNT];
        compile(context, shape, handles, 5);
        update(context, shape, targets, positions);
        assert_true(measured(shape, targets, positions).handle_error < 1e-9 * 100);
        for (int k = 0; k < 5; k++)
            assert_true(ktg_length2(ktg_sub2(ktg_handle_place(&handles[k], positions),
                                             targets[k])) < 1e-9 * 100);
        ktg_shape_free(&shape);
    }
}

static void the_first_step_is_the_kernels_with_pins(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, square, SIDE);
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_COTANGENT);
    const uint32_t vertices[] = {0, SIDE, 5 + 5 * ROW, COUNT - 1};
    const ktg_vec2 targets[] = {{0, 0}, {120, -10}, {40, 60}, {70, 130}};
    ktg_vec2 wanted[4], similar[COUNT], rigid[COUNT], expected[COUNT], outward[COUNT];
    ktg_handle handles[4];
    ktg_neighbourhood *all;
    for (int k = 0; k < 4; k++) {
        handles[k] = ktg_handle_at_vertex(vertices[k]);
        wanted[k] = ktg_shape_inward(shape, targets[k]);
    }
    compile(context, shape, handles, 4);
    assert_int_equal(ktg_shape_update_similar(context, shape, targets, similar), KTG_OK);
    update(context, shape, targets, rigid);
    assert_int_equal(ktg_neighbourhoods_new(context, shape->panel, KTG_WEIGHT_COTANGENT, &all),
                     KTG_OK);
    ktg_edges edges = {COUNT, shape->panel->adjacency->edge_count, all};
    ktg_pins pins = {4, vertices, wanted};
    assert_int_equal(ktg_similarity_step(context, &edges, &pins, expected), KTG_OK);
    for (uint32_t v = 0; v < COUNT; v++)
        outward[v] = ktg_shape_outward(shape, expected[v]);
    assert_true(farthest(similar, outward, COUNT) < 1e-6);
    assert_int_equal(ktg_scale_step(context, &edges, &pins, expected), KTG_OK);
    for (uint32_t v = 0; v < COUNT; v++)
        outward[v] = ktg_shape_outward(shape, expected[v]);
    assert_true(farthest(rigid, outward, COUNT) < 1); /* the turns are means of other things */
    assert_true(farthest(rigid, similar, COUNT) > 5);
    ktg_free(all);
    ktg_mesh_free(&mesh);
    ktg_shape_free(&shape);
}

static void a_rigid_motion_of_the_handles_moves_the_whole_shape(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_COTANGENT);
    ktg_handle handles[] = {at(context, shape, 12, 17), at(context, shape, 70, 60),
                            ktg_handle_at_vertex(3)};
    ktg_vec2 targets[3], positions[COUNT], expected[COUNT];
    compile(context, shape, handles, 3);
    for (int k = 0; k < 3; k++)
        targets[k] = transform(cos(2), sin(2), ktg_handle_place(&handles[k], shape->given));
    update(context, shape, targets, positions);
    for (uint32_t v = 0; v < COUNT; v++)
        expected[v] = transform(cos(2), sin(2), shape->given[v]);
    assert_true(farthest(positions, expected, COUNT) < 1e-9 * 100);
    ktg_shape_free(&shape);
}

/* Figure 2: pulled apart to twice their distance, two handles inflate the shape in the first step;
 * the second gives it its size back, but for what is between them. */
static void the_first_step_scales_and_the_second_keeps_the_size(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_COTANGENT);
    ktg_handle handles[] = {at(context, shape, 30, 50), at(context, shape, 70, 50)};
    ktg_vec2 targets[] = {{10, 50}, {90, 50}}, positions[COUNT], expected[COUNT];
    compile(context, shape, handles, 2);
    assert_int_equal(ktg_shape_update_similar(context, shape, targets, positions), KTG_OK);
    for (uint32_t v = 0; v < COUNT; v++)
        expected[v] = ktg_add2(ktg_mul2(shape->given[v], 2), (ktg_vec2){-50, -50});
    assert_true(farthest(positions, expected, COUNT) < 1e-9 * 100);
    ktg_shape_report grown = measured(shape, targets, positions);
    assert_true(fabs(grown.stretch_least - 2) < 1e-9 && fabs(grown.stretch_most - 2) < 1e-9);
    update(context, shape, targets, positions);
    assert_true(positions[COUNT - 1].y - positions[SIDE].y < 115);
    assert_true(ktg_length2(ktg_sub2(positions[1], positions[0])) < 1.1 * 100.0 / SIDE);
    assert_true(measured(shape, targets, positions).energy < 0.25 * grown.energy);
    ktg_shape_free(&shape);
}

static void a_bent_bar_keeps_its_width(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, bar, KTG_WEIGHT_COTANGENT);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE * ROW),
                            ktg_handle_at_vertex(SIDE), ktg_handle_at_vertex(COUNT - 1)};
    ktg_vec2 targets[] = {{0, 0}, {0, 20}, {70, 60}, {50, 60}}, positions[COUNT];
    compile(context, shape, handles, 4);
    update(context, shape, targets, positions);
    ktg_shape_report report = measured(shape, targets, positions);
    assert_int_equal(report.folded_faces, 0);
    double width = ktg_length2(ktg_sub2(positions[SIDE / 2], positions[SIDE / 2 + SIDE * ROW]));
    assert_true(fabs(width - 20) < 2);
    ktg_shape_free(&shape);
}

static void soft_handles_come_near_by_their_weight(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_UNIT);
    ktg_vec2 targets[] = {{0, 0}, {100, 0}, {50, 120}}, positions[COUNT];
    double off[3];
    for (int k = 0; k < 3; k++) {
        ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                                at(context, shape, 50, 50)};
        for (int h = 0; h < 3; h++)
            handles[h].weight = k == 0 ? 10 : k == 1 ? 1000 : 0;
        compile(context, shape, handles, 3);
        update(context, shape, targets, positions);
        off[k] = measured(shape, targets, positions).handle_error;
    }
    assert_true(off[0] > 10 * off[1] && off[1] > 1e-3 && off[1] < 1 && off[2] < 1e-7);
    ktg_shape_free(&shape);
}

/* The soft form as the paper writes it: the minimum of equation (4), found densely. */
static void soft_handles_solve_the_papers_equation(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_UNIT);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                            at(context, shape, 41, 52)};
    ktg_vec2 targets[] = {{0, 0}, {130, 0}, {50, 90}}, positions[COUNT];
    ktg_vec2 z[COUNT], slope[COUNT] = {{0, 0}};
    ktg_neighbourhood *all;
    for (int k = 0; k < 3; k++)
        handles[k].weight = 3;
    compile(context, shape, handles, 3);
    assert_int_equal(ktg_shape_update_similar(context, shape, targets, positions), KTG_OK);
    for (uint32_t v = 0; v < COUNT; v++)
        z[v] = ktg_shape_inward(shape, positions[v]);
    assert_int_equal(ktg_neighbourhoods_new(context, shape->panel, KTG_WEIGHT_UNIT, &all), KTG_OK);
    for (uint32_t e = 0; e < shape->panel->adjacency->edge_count; e++)
        for (uint32_t base = 0; base < 2; base++) {
            const ktg_neighbourhood *n = &all[e];
            ktg_vec2 factors[4], residual = {0, 0};
            ktg_neighbourhood_residual(n, base, factors);
            for (uint32_t v = 0; v < n->count; v++)
                residual = ktg_add2(residual, ktg_turn(factors[v], z[n->vertices[v]]));
            for (uint32_t v = 0; v < n->count; v++)
                slope[n->vertices[v]] =
                    ktg_add2(slope[n->vertices[v]], ktg_turn_back(factors[v], residual));
        }
    for (int k = 0; k < 3; k++) {
        ktg_vec2 off =
            ktg_sub2(ktg_handle_place(&handles[k], z), ktg_shape_inward(shape, targets[k]));
        assert_true(ktg_length2(off) > 1e-6);
        for (int i = 0; i < 3; i++)
            slope[handles[k].vertices[i]] =
                ktg_madd2(slope[handles[k].vertices[i]], 3 * handles[k].parts[i], off);
    }
    for (uint32_t v = 0; v < COUNT; v++)
        assert_true(ktg_length2(slope[v]) < 1e-9);
    ktg_free(all);
    ktg_shape_free(&shape);
}

static void one_handle_moves_and_none_leaves_the_shape_as_it_is(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_COTANGENT);
    ktg_handle handle = at(context, shape, 20, 30);
    ktg_vec2 target = {27, 26}, positions[COUNT];
    update(context, shape, NULL, positions);
    assert_memory_equal(positions, shape->given, sizeof positions);
    compile(context, shape, &handle, 1);
    update(context, shape, &target, positions);
    for (uint32_t v = 0; v < COUNT; v++) {
        ktg_vec2 by = ktg_sub2(positions[v], shape->given[v]);
        assert_true(fabs(by.x - 7) < 1e-12 && fabs(by.y + 4) < 1e-12);
    }
    compile(context, shape, NULL, 0);
    update(context, shape, NULL, positions);
    assert_memory_equal(positions, shape->given, sizeof positions);
    ktg_shape_free(&shape);
}

static void a_shape_seen_from_behind_far_away_and_tiny_is_no_different(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, mirrored, KTG_WEIGHT_COTANGENT);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                            ktg_handle_at_vertex(COUNT - 1)};
    ktg_vec2 targets[3], positions[COUNT], expected[COUNT];
    double c = cos(-1), s = sin(-1);
    compile(context, shape, handles, 3);
    for (int k = 0; k < 3; k++)
        targets[k] = transform(c, s, ktg_handle_place(&handles[k], shape->given));
    update(context, shape, targets, positions);
    for (uint32_t v = 0; v < COUNT; v++)
        expected[v] = transform(c, s, shape->given[v]);
    assert_true(farthest(positions, expected, COUNT) < 1e-13 * 17);
    assert_int_equal(measured(shape, targets, positions).folded_faces, 0);
    ktg_shape_free(&shape);
}

/* ---- refusals ----------------------------------------------------------------------------- */

static void refused(ktg_context *context, ktg_mesh *mesh, const char *words) {
    ktg_shape *shape;
    assert_int_equal(ktg_shape_register(context, mesh, KTG_WEIGHT_COTANGENT, &shape), KTG_GEOMETRY);
    assert_null(shape);
    assert_non_null(strstr(ktg_context_message(context), words));
    ktg_mesh_free(&mesh);
}

static void what_is_no_flat_shape_is_refused(void **state) {
    ktg_context *context = *state;
    const ktg_vec3 two[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
    const ktg_vec3 kite[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 0}};
    refused(context, grid_panel(context, shallow_cap, 4), "not flat");
    refused(context, small_mesh(context, two, 6, (const uint32_t[]){0, 1, 2, 3, 4, 5}, 2),
            "2 separate parts");
    refused(context, small_mesh(context, kite, 4, (const uint32_t[]){0, 1, 2, 2, 1, 3}, 2),
            "upside down");
    refused(context, grid_panel(context, folded_in_two, 4), "upside down");
}

static void handles_that_make_no_sense_are_refused(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_COTANGENT);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(3),
                            at(context, shape, 0, 0)};
    ktg_handle beyond = ktg_handle_at_vertex(COUNT), half = {{0, 1, 2}, {0.5, 0, 0}, 0};
    ktg_handle negative = {{0, 1, 2}, {1, 0, 0}, -1}, nan = {{0, 1, 2}, {NAN, 0, 0}, 0};
    ktg_vec2 targets[] = {{0, 0}, {NAN, 0}, {0, 0}}, positions[COUNT];
    assert_int_equal(ktg_shape_compile(context, shape, handles, 3), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(context), "handles 1 and 3 are in the same place"));
    assert_int_equal(ktg_shape_compile(context, shape, &beyond, 1), KTG_ARGUMENT);
    assert_int_equal(ktg_shape_compile(context, shape, &half, 1), KTG_ARGUMENT);
    assert_int_equal(ktg_shape_compile(context, shape, &negative, 1), KTG_ARGUMENT);
    assert_int_equal(ktg_shape_compile(context, shape, &nan, 1), KTG_ARGUMENT);
    compile(context, shape, handles, 2);
    assert_int_equal(ktg_shape_update(context, shape, targets, positions), KTG_ARGUMENT);
    assert_int_equal(ktg_shape_handle_at(context, shape, (ktg_vec2){101, 5}, &half), KTG_GEOMETRY);
    assert_int_equal(ktg_shape_handle_at(context, shape, (ktg_vec2){NAN, 5}, &half), KTG_GEOMETRY);
    ktg_shape_free(&shape);
}

/* Four handles in one triangle: the fourth is settled by the others. */
static void a_handle_too_many_in_a_triangle_is_refused(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_COTANGENT);
    double h = 100.0 / SIDE;
    ktg_handle handles[] = {
        at(context, shape, 0.5 * h, 0.1 * h), at(context, shape, 0.3 * h, 0.2 * h),
        at(context, shape, 0.5 * h, 0.2 * h), at(context, shape, 0.4 * h, 0.15 * h)};
    assert_int_equal(ktg_shape_compile(context, shape, handles, 4), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(context), "handle 4 has no say"));
    compile(context, shape, handles, 3);
    ktg_shape_free(&shape);
}

static ktg_status whole_job(ktg_context *context, const ktg_mesh *mesh) {
    ktg_shape *shape;
    ktg_vec2 targets[] = {{0, 0}, {130, 0}, {50, 90}}, positions[COUNT];
    ktg_status status = ktg_shape_register(context, mesh, KTG_WEIGHT_COTANGENT, &shape);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                            ktg_handle_at_vertex(COUNT - 1)};
    if (status == KTG_OK)
        status = ktg_shape_compile(context, shape, handles, 3);
    if (status == KTG_OK)
        status = ktg_shape_update(context, shape, targets, positions);
    if (status == KTG_OK)
        status = ktg_shape_refine(context, shape, targets, 3, positions, NULL);
    bool arrived;
    if (status == KTG_OK)
        status = ktg_shape_lead(context, shape, targets, positions, &arrived);
    ktg_shape_free(&shape);
    return status;
}

static void short_memory_is_told_wherever_it_runs_out(void **state) {
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, square, SIDE);
    ktg_status status = KTG_MEMORY;
    uint64_t k = 0;
    while (status != KTG_OK && k < 1000) {
        ktg_context_fail_allocation(context, ++k);
        status = whole_job(context, mesh);
        end_short_memory(context, status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
    }
    assert_true(k > 20 && k < 1000);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(exact_handles_are_where_they_are_wanted),
        TEST(the_first_step_is_the_kernels_with_pins),
        TEST(a_rigid_motion_of_the_handles_moves_the_whole_shape),
        TEST(the_first_step_scales_and_the_second_keeps_the_size),
        TEST(a_bent_bar_keeps_its_width),
        TEST(soft_handles_come_near_by_their_weight),
        TEST(soft_handles_solve_the_papers_equation),
        TEST(one_handle_moves_and_none_leaves_the_shape_as_it_is),
        TEST(a_shape_seen_from_behind_far_away_and_tiny_is_no_different),
        TEST(what_is_no_flat_shape_is_refused),
        TEST(handles_that_make_no_sense_are_refused),
        TEST(a_handle_too_many_in_a_triangle_is_refused),
        TEST(short_memory_is_told_wherever_it_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
