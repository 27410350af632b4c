/* What is not a disk is refused, and the message says what it is instead. */
#include "flatten/kernel.h"
#include "tests/flatten/panels.h"

#include <string.h>

/* It is no panel: KTG_GEOMETRY and a message that holds `words`; the mesh is freed. */
static void assert_refused(ktg_context *context, ktg_mesh *mesh, const char *words) {
    ktg_panel *panel;
    ktg_status status = ktg_panel_new(context, mesh, &panel);
    if (status == KTG_OK)
        status = ktg_panel_check_disk(context, mesh, panel);
    assert_int_equal(status, KTG_GEOMETRY);
    ktg_panel_free(&panel);
    if (!strstr(ktg_context_message(context), words))
        fail_msg("\"%s\" is not in \"%s\"", words, ktg_context_message(context));
    ktg_mesh_free(&mesh);
}

static const ktg_vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

static void a_closed_surface_is_refused(void **state) {
    const uint32_t tetrahedron[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    assert_refused(*state, small_mesh(*state, corners, 4, tetrahedron, 4), "closed");
}

static void several_parts_are_refused(void **state) {
    ktg_vec3 positions[9];
    uint32_t faces[9];
    for (uint32_t k = 0; k < 9; k++) {
        positions[k] = ktg_add3(corners[k % 3], (ktg_vec3){0, 0, (double)(k / 3)});
        faces[k] = k;
    }
    assert_refused(*state, small_mesh(*state, positions, 9, faces, 3), "3 separate parts");
}

/* `columns` x `rows` squares, closed to a ring in one direction and, if `torus`, in the other. Each
 * but the first `holes` squares are there. */
static ktg_mesh *ring_mesh(ktg_context *context, uint32_t columns, uint32_t rows, bool torus,
                           uint32_t holes) {
    ktg_vec3 positions[100];
    uint32_t faces[600], count = 0, levels = torus ? rows : rows + 1;
    for (uint32_t j = 0; j < levels; j++)
        for (uint32_t i = 0; i < columns; i++) {
            double angle = 2 * KTG_PI * i / columns, turn = torus ? 2 * KTG_PI * j / rows : 0;
            double r = 3 + cos(turn), z = torus ? sin(turn) : j;
            positions[i + columns * j] = (ktg_vec3){r * cos(angle), r * sin(angle), z};
        }
    for (uint32_t k = holes; k < columns * rows; k++) {
        uint32_t i = k % columns, j = k / columns;
        uint32_t a = i + columns * j, b = (i + 1) % columns + columns * j;
        uint32_t c = b % columns + columns * ((j + 1) % levels);
        uint32_t d = i + columns * ((j + 1) % levels);
        uint32_t square[6] = {a, b, c, a, c, d};
        memcpy(faces + count, square, sizeof square);
        count += 6;
    }
    return small_mesh(context, positions, columns * levels, faces, count / 3);
}

static void a_tube_is_refused(void **state) {
    assert_refused(*state, ring_mesh(*state, 8, 3, false, 0), "2 borders");
}

static void a_torus_is_refused(void **state) {
    assert_refused(*state, ring_mesh(*state, 8, 6, true, 0), "closed");
}

static void a_torus_with_a_hole_is_refused_for_its_handle(void **state) {
    assert_refused(*state, ring_mesh(*state, 8, 6, true, 1), "1 handle,");
    assert_refused(*state, ring_mesh(*state, 8, 6, true, 2), "1 handle,");
}

static void sheets_that_touch_in_a_point_are_refused(void **state) {
    const uint32_t bow_tie[] = {0, 1, 2, 0, 3, 4};
    assert_refused(*state, small_mesh(*state, corners, 5, bow_tie, 2), "vertex 1 sheets touch");
}

static void an_edge_of_three_faces_is_refused(void **state) {
    const uint32_t fin[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    assert_refused(*state, small_mesh(*state, corners, 5, fin, 3), "vertices 1 and 2 joins 3");
}

static void faces_that_are_not_oriented_alike_are_refused(void **state) {
    const uint32_t turned[] = {0, 1, 2, 0, 1, 3};
    assert_refused(*state, small_mesh(*state, corners, 4, turned, 2), "repair the mesh");
}

static void an_unused_vertex_is_refused(void **state) {
    const uint32_t face[] = {0, 1, 2};
    assert_refused(*state, small_mesh(*state, corners, 4, face, 1), "vertex 4 belongs to no face");
}

static void a_face_without_area_is_named(void **state) {
    const ktg_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 1e-12}};
    const uint32_t faces[] = {0, 1, 2, 2, 1, 3};
    assert_refused(*state, small_mesh(*state, positions, 4, faces, 2),
                   "the face at (0, 1, 0) has no area");
    const ktg_vec3 point[] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    assert_refused(*state, small_mesh(*state, point, 3, faces, 1),
                   "the face at (1, 2, 3) has no area");
}

static void a_mesh_without_faces_is_refused(void **state) {
    ktg_mesh empty = {0};
    ktg_pattern *pattern;
    assert_int_equal(ktg_flatten(*state, &empty, "a", NULL, &pattern, NULL), KTG_GEOMETRY);
    assert_null(pattern);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_closed_surface_is_refused),
        TEST(several_parts_are_refused),
        TEST(a_tube_is_refused),
        TEST(a_torus_is_refused),
        TEST(a_torus_with_a_hole_is_refused_for_its_handle),
        TEST(sheets_that_touch_in_a_point_are_refused),
        TEST(an_edge_of_three_faces_is_refused),
        TEST(faces_that_are_not_oriented_alike_are_refused),
        TEST(an_unused_vertex_is_refused),
        TEST(a_face_without_area_is_named),
        TEST(a_mesh_without_faces_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
