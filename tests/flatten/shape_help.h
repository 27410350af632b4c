/* tests/flatten/shape_help.h - shapes to be moved by handles, for the tests. */
#ifndef KTG_TESTS_FLATTEN_SHAPE_HELP_H
#define KTG_TESTS_FLATTEN_SHAPE_HELP_H

#include "flatten/shape.h"
#include "tests/flatten/panels.h"

#include <string.h>

enum { SIDE = 12, ROW = SIDE + 1, COUNT = ROW * ROW };

static inline ktg_vec3 square(double u, double v) {
    return (ktg_vec3){100 * u, 100 * v, 0};
}

static inline ktg_vec3 bar(double u, double v) {
    return (ktg_vec3){100 * u, 20 * v, 0};
}

static inline ktg_shape *registered(ktg_context *context, surface *point, ktg_edge_weight weight) {
    ktg_mesh *mesh = grid_panel(context, point, SIDE);
    ktg_shape *shape;
    assert_int_equal(ktg_shape_register(context, mesh, weight, &shape), KTG_OK);
    ktg_mesh_free(&mesh);
    return shape;
}

static inline ktg_handle at(ktg_context *context, const ktg_shape *shape, double x, double y) {
    ktg_handle handle;
    assert_int_equal(ktg_shape_handle_at(context, shape, (ktg_vec2){x, y}, &handle), KTG_OK);
    return handle;
}

static inline void compile(ktg_context *context, ktg_shape *shape, const ktg_handle *handles,
                           uint32_t count) {
    assert_int_equal(ktg_shape_compile(context, shape, handles, count), KTG_OK);
}

static inline void update(ktg_context *context, ktg_shape *shape, const ktg_vec2 *targets,
                          ktg_vec2 *positions) {
    assert_int_equal(ktg_shape_update(context, shape, targets, positions), KTG_OK);
}

static inline ktg_shape_report measured(const ktg_shape *shape, const ktg_vec2 *targets,
                                        const ktg_vec2 *positions) {
    ktg_shape_report report;
    ktg_shape_measure(shape, targets, positions, NULL, &report);
    return report;
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

#endif
