/* Shapes that handles have folded: refined, or led to where the handles want them. */
#include "tests/flatten/shape_help.h"

static void refinement_brings_back_what_was_folded_and_keeps_handles(void **state) {
    ktg_context *context = *state;
    for (int weight = 0; weight < 2; weight++) {
        ktg_shape *shape = registered(context, bar, (ktg_edge_weight)weight);
        ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE * ROW),
                                ktg_handle_at_vertex(SIDE), ktg_handle_at_vertex(COUNT - 1)};
        ktg_vec2 targets[] = {{0, 0}, {0, 20}, {100, 20}, {100, 0}}, positions[COUNT];
        uint32_t rounds, count = 0;
        bool folded[2 * SIDE * SIDE];
        compile(context, shape, handles, 4);
        update(context, shape, targets, positions);
        ktg_shape_report before, after;
        ktg_shape_measure(shape, targets, positions, folded, &before);
        for (uint32_t f = 0; f < before.faces; f++)
            count += folded[f];
        assert_true(before.folded_faces > 0 && before.folded_faces == count);
        assert_true(folded[before.first_folded]);
        assert_int_equal(ktg_shape_refine(context, shape, targets, 500, positions, &rounds),
                         KTG_OK);
        after = measured(shape, targets, positions);
        assert_true(rounds > 0 && after.energy < before.energy);
        assert_true(after.folded_faces == 0 && after.first_folded == KTG_NONE);
        assert_true(after.handle_error < 1e-9 * 100);
        ktg_shape_free(&shape);
    }
}

/* At the end of refinement no vertex wants to move: the gradient is what handles hold. */
static void refinement_ends_where_the_energy_is_least(void **state) {
    ktg_context *context = *state;
    ktg_shape *shape = registered(context, bar, KTG_WEIGHT_COTANGENT);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE * ROW),
                            ktg_handle_at_vertex(SIDE), ktg_handle_at_vertex(COUNT - 1)};
    ktg_vec2 targets[] = {{0, 0}, {0, 20}, {75, 50}, {57, 60}}, positions[COUNT];
    ktg_vec2 z[COUNT], slope[COUNT];
    compile(context, shape, handles, 4);
    update(context, shape, targets, positions);
    assert_int_equal(ktg_shape_refine(context, shape, targets, 5000, positions, NULL), KTG_OK);
    for (uint32_t v = 0; v < COUNT; v++)
        z[v] = ktg_shape_inward(shape, positions[v]);
    (void)ktg_energy_value(shape->panel, shape->rests, KTG_ENERGY_ARAP, z, slope);
    for (uint32_t v = 0; v < COUNT; v++)
        if (v != 0 && v != SIDE * ROW && v != SIDE && v != COUNT - 1)
            assert_true(ktg_length2(slope[v]) < 1e-3);
    ktg_shape_free(&shape);
}

/* Local/global iteration ends with folds here: the least energy has some. */
static void handles_are_led_where_refinement_cannot_help(void **state) {
    ktg_context *context = *state;
    for (int weight = 0; weight < 2; weight++) {
        ktg_shape *shape = registered(context, square, (ktg_edge_weight)weight);
        ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                                ktg_handle_at_vertex(SIDE * ROW), ktg_handle_at_vertex(COUNT - 1),
                                at(context, shape, 50, 50)};
        ktg_vec2 targets[] = {{0, 0}, {100, 0}, {0, 100}, {100, 100}, {80, 80}}, positions[COUNT];
        bool arrived;
        compile(context, shape, handles, 5);
        update(context, shape, targets, positions);
        assert_int_equal(ktg_shape_refine(context, shape, targets, 500, positions, NULL), KTG_OK);
        assert_true(measured(shape, targets, positions).folded_faces > 0);
        assert_int_equal(ktg_shape_lead(context, shape, targets, positions, &arrived), KTG_OK);
        ktg_shape_report report = measured(shape, targets, positions);
        assert_true(arrived && report.folded_faces == 0 && report.stretch_least > 0.1);
        assert_true(report.handle_error < 1e-9 * 100);
        ktg_shape_free(&shape);
    }
}

/* The middle of a fine square, nearly to its side: only sweeps over single vertices make room. */
static void a_fine_mesh_takes_sweeps(void **state) {
    enum { FINE = 40, FINE_COUNT = (FINE + 1) * (FINE + 1) };
    ktg_context *context = *state;
    ktg_mesh *mesh = grid_panel(context, square, FINE);
    ktg_shape *shape;
    assert_int_equal(ktg_shape_register(context, mesh, KTG_WEIGHT_UNIT, &shape), KTG_OK);
    ktg_handle handles[] = {at(context, shape, 2, 50), at(context, shape, 50, 50),
                            at(context, shape, 98, 50)};
    ktg_vec2 targets[] = {{2, 50}, {90, 50}, {98, 50}}, positions[FINE_COUNT];
    bool arrived;
    compile(context, shape, handles, 3);
    assert_int_equal(ktg_shape_lead(context, shape, targets, positions, &arrived), KTG_OK);
    assert_true(arrived && measured(shape, targets, positions).folded_faces == 0);
    ktg_shape_free(&shape);
    ktg_mesh_free(&mesh);
}

/* Two points of a triangle change places: no way leads there. */
static void handles_that_cannot_arrive_leave_everything_as_it_was(void **state) {
    ktg_context *context = *state;
    const ktg_vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    ktg_mesh *mesh = small_mesh(context, corners, 3, (const uint32_t[]){0, 1, 2}, 1);
    ktg_shape *shape;
    assert_int_equal(ktg_shape_register(context, mesh, KTG_WEIGHT_UNIT, &shape), KTG_OK);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(1),
                            ktg_handle_at_vertex(2)};
    ktg_vec2 targets[] = {{0, 0}, {0, 1}, {1, 0}}, positions[3], before[3];
    bool arrived;
    compile(context, shape, handles, 3);
    update(context, shape, targets, positions);
    assert_int_equal(measured(shape, targets, positions).folded_faces, 1);
    memcpy(before, positions, sizeof before);
    assert_int_equal(ktg_shape_lead(context, shape, targets, positions, &arrived), KTG_OK);
    assert_false(arrived);
    assert_memory_equal(positions, before, sizeof before);
    ktg_shape_free(&shape);
    ktg_mesh_free(&mesh);
}

/* ---- stopping ----------------------------------------------------------------------------- */

typedef struct asker {
    int left; /* so many times nobody wants anything */
    ktg_wish wish;
} asker;

static ktg_wish ask(void *user) {
    asker *a = user;
    return --a->left < 0 ? a->wish : KTG_GO_ON;
}

/* Folds a square by its middle; then refines it, or leads its handles. */
static ktg_status unfold(ktg_context *context, bool leads) {
    ktg_shape *shape = registered(context, square, KTG_WEIGHT_UNIT);
    ktg_handle handles[] = {ktg_handle_at_vertex(0), ktg_handle_at_vertex(SIDE),
                            ktg_handle_at_vertex(SIDE * ROW), ktg_handle_at_vertex(COUNT - 1),
                            at(context, shape, 50, 50)};
    ktg_vec2 targets[] = {{0, 0}, {100, 0}, {0, 100}, {100, 100}, {80, 80}}, positions[COUNT];
    bool arrived;
    ktg_status status = ktg_shape_compile(context, shape, handles, 5);
    if (status == KTG_OK)
        status = ktg_shape_update(context, shape, targets, positions);
    if (status == KTG_OK)
        status = leads ? ktg_shape_lead(context, shape, targets, positions, &arrived)
                       : ktg_shape_refine(context, shape, targets, 9, positions, NULL);
    ktg_shape_free(&shape);
    return status;
}

static void a_wish_to_stop_is_obeyed_whenever_it_comes(void **state) {
    for (int leads = 0; leads < 2; leads++) {
        ktg_status status = KTG_CANCELLED;
        int asked = 0;
        for (; status == KTG_CANCELLED; asked++) {
            asker a = {asked, KTG_STOP};
            ktg_context_set_cancel(*state, ask, &a);
            status = unfold(*state, leads);
            assert_int_equal(status == KTG_OK, a.left >= 0); /* nobody said stop */
            a = (asker){asked, KTG_FINISH};
            assert_int_equal(unfold(*state, leads), KTG_OK);
        }
        assert_int_equal(status, KTG_OK);
        assert_true(asked > 5);
    }
    ktg_context_set_cancel(*state, NULL, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(refinement_brings_back_what_was_folded_and_keeps_handles),
        TEST(refinement_ends_where_the_energy_is_least),
        TEST(handles_are_led_where_refinement_cannot_help),
        TEST(a_fine_mesh_takes_sweeps),
        TEST(handles_that_cannot_arrive_leave_everything_as_it_was),
        TEST(a_wish_to_stop_is_obeyed_whenever_it_comes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
