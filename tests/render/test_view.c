/* What an eye sees of faces: the nearest one at each dot, and nothing of those behind. */
#include "render/view.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

/* Looks along z from the front at the square from (0, 0) to (10, 10), 10 dots a unit. */
static ktg_view look(ktg_context *context, const ktg_pattern *pattern, double turn) {
    ktg_eye eye = ktg_eye_at(1, turn, 0);
    ktg_area seen = {turn > 1 ? -10 : 0, -10, turn > 1 ? 0 : 10, 0};
    ktg_view view;
    assert_int_equal(ktg_view_look(context, pattern, NULL, &eye, seen, 10, &view), KTG_OK);
    assert_int_equal(view.width, 100);
    assert_int_equal(view.height, 100);
    return view;
}

/* The face seen at a point of the square; right is right also from behind. */
static uint32_t face_at(const ktg_view *view, double x, double y, double z) {
    ktg_vec2 dot = ktg_view_dot(view, (ktg_vec3){x, y, z});
    return view->faces[(size_t)dot.y * 100 + (size_t)dot.x];
}

static void nothing_of_what_is_behind_shows(void **state) {
    static ktg_vec3 vertices[] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0},
                                  {2, 2, 5}, {9, 2, 5},  {2, 9, 5}};
    static uint32_t faces[] = {0, 1, 2, 1, 3, 2, 4, 5, 6};
    ktg_pattern pattern = {
        .vertex_count = 7, .vertices = vertices, .face_count = 3, .faces = faces};
    ktg_view front = look(*state, &pattern, 0), back = look(*state, &pattern, KTG_PI);
    for (double x = 0.05; x < 10; x += 0.1)
        for (double y = 0.05; y < 10; y += 0.1) {
            bool covered = x > 2 && y > 2 && x + y < 11;
            uint32_t behind = x + y < 10 ? 0 : 1;
            if (fabs(x + y - 10) < 0.15 || fabs(x + y - 11) < 0.15)
                continue;
            assert_int_equal(face_at(&front, x, y, 0), covered ? 2 : behind);
            assert_int_equal(face_at(&back, x, y, 0), behind);
        }
    ktg_view_drop(&front);
    ktg_view_drop(&back);
}

/* Three bars, each before the next and behind the one before: no order of painting is right. */
static void bars_that_lie_over_each_other_in_a_ring_are_right(void **state) {
    static const double ends[3][4] = {{0.5, 2, 9.5, 2}, {8.5, 0.5, 4, 9.5}, {6, 9.5, 1.5, 0.5}};
    ktg_vec3 vertices[12];
    uint32_t faces[18];
    for (uint32_t k = 0; k < 3; k++) {
        const double *e = ends[k];
        ktg_vec2 along = ktg_unit2((ktg_vec2){e[2] - e[0], e[3] - e[1]});
        ktg_vec2 side = ktg_mul2(ktg_perp2(along), 0.4);
        double z[2] = {0, 3}; /* from behind to before */
        for (uint32_t i = 0; i < 4; i++) {
            double s = i % 2 ? 1 : -1, end = i / 2;
            vertices[4 * k + i] =
                (ktg_vec3){e[i / 2 * 2] + s * side.x, e[i / 2 * 2 + 1] + s * side.y, z[(int)end]};
        }
        uint32_t own[] = {0, 2, 1, 1, 2, 3};
        for (uint32_t i = 0; i < 6; i++)
            faces[6 * k + i] = 4 * k + own[i];
    }
    ktg_pattern pattern = {
        .vertex_count = 12, .vertices = vertices, .face_count = 6, .faces = faces};
    ktg_view view = look(*state, &pattern, 0);
    for (uint32_t k = 0; k < 3; k++) { /* near its end a bar is above the beginning of the next */
        const double *e = ends[k], *n = ends[(k + 1) % 3];
        double a = e[2] - e[0], b = e[3] - e[1], c = n[2] - n[0], d = n[3] - n[1];
        double t = ((n[0] - e[0]) * d - (n[1] - e[1]) * c) / (a * d - b * c);
        double x = e[0] + t * a, y = e[1] + t * b;
        assert_true(t > 0.5 && t < 1);
        assert_int_equal(face_at(&view, x, y, 0) / 2, k);
    }
    ktg_view_drop(&view);
}

/* A square of many small triangles has no hole, and at the seams one of both faces. */
static void neighbours_leave_no_hole(void **state) {
    enum { N = 23 };
    ktg_vec3 vertices[(N + 1) * (N + 1)];
    uint32_t faces[6 * N * N], count = 0;
    uint64_t random = 5;
    for (uint32_t i = 0; i <= N; i++)
        for (uint32_t k = 0; k <= N; k++) {
            double shift[2];
            for (int s = 0; s < 2; s++) {
                random = random * 6364136223846793005u + 1442695040888963407u;
                shift[s] = (double)(random >> 40) / (1 << 24) * 0.6 - 0.3;
            }
            bool inside = i > 0 && k > 0 && i < N && k < N;
            vertices[i * (N + 1) + k] = (ktg_vec3){10.0 * (i + (inside ? shift[0] : 0)) / N,
                                                   10.0 * (k + (inside ? shift[1] : 0)) / N, 0};
            if (i < N && k < N) {
                uint32_t a = i * (N + 1) + k, b = a + N + 1;
                uint32_t own[] = {a, b, b + 1, a, b + 1, a + 1};
                memcpy(faces + count, own, sizeof own);
                count += 6;
            }
        }
    ktg_pattern pattern = {.vertex_count = (N + 1) * (N + 1),
                           .vertices = vertices,
                           .face_count = count / 3,
                           .faces = faces};
    ktg_view view = look(*state, &pattern, 0);
    for (size_t i = 0; i < 10000; i++)
        assert_int_not_equal(view.faces[i], KTG_NONE);
    ktg_view_drop(&view);
}

static void an_edge_shows_where_one_of_its_faces_does(void **state) {
    static ktg_vec3 vertices[] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0},
                                  {2, 2, 5}, {9, 2, 5},  {2, 9, 5}};
    static uint32_t faces[] = {0, 1, 2, 1, 3, 2, 4, 5, 6};
    ktg_pattern pattern = {
        .vertex_count = 7, .vertices = vertices, .face_count = 3, .faces = faces};
    ktg_view view = look(*state, &pattern, 0);
    for (double x = 0.5; x < 10; x += 0.5) { /* the diagonal, hidden from x = 2 to 8 */
        bool hidden = x > 2.3 && x < 7.7, shown = x < 1.7 || x > 8.3;
        ktg_vec2 dot = ktg_view_dot(&view, (ktg_vec3){x, 10 - x, 0});
        if (hidden || shown)
            assert_int_equal(ktg_view_shows(&view, dot, 0, 1), shown);
    }
    assert_false(ktg_view_shows(&view, (ktg_vec2){-50, 20}, 0, 1));
    ktg_view_drop(&view);
}

static uint32_t by_weight(const void *user, const ktg_seen_dot *dot) {
    const double *weights = dot->weights;
    assert_int_equal(dot->face, 0);
    assert_false(dot->is_inside);
    for (int k = 0; k < 3; k++) { /* two dots of the view are 0.2, a fiftieth of the sides */
        static const double right[] = {-0.02, 0.02, 0}, down[] = {0.02, 0, -0.02};
        assert_true(fabs(dot->right[k] - right[k]) < 1e-9 && fabs(dot->down[k] - down[k]) < 1e-9);
    }
    assert_true(fabs(weights[0] + weights[1] + weights[2] - 1) < 1e-9);
    (void)user;
    uint32_t most = weights[0] > 0.6 ? 0 : weights[1] > 0.6 ? 1 : weights[2] > 0.6 ? 2 : 3;
    return most < 3 ? 0xffu << (16 - 8 * most) : 0;
}

/* Red at the first corner, green at the second, blue at the third; nothing beside the face. */
static void colours_know_where_on_the_face_they_are(void **state) {
    static ktg_vec3 vertices[] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
    static uint32_t faces[] = {0, 1, 2};
    ktg_pattern pattern = {
        .vertex_count = 3, .vertices = vertices, .face_count = 1, .faces = faces};
    ktg_view view = look(*state, &pattern, 0);
    ktg_look colours = {NULL, by_weight, NULL, 0};
    cairo_surface_t *picture = NULL;
    assert_int_equal(ktg_view_picture(*state, &view, &colours, 2, 20, &picture), KTG_OK);
    assert_int_equal(cairo_image_surface_get_width(picture), 50);
    const unsigned char *rows = cairo_image_surface_get_data(picture);
    static const int places[4][2] = {{3, 46}, {45, 48}, {1, 5}, {40, 10}};
    for (int k = 0; k < 4; k++) {
        uint32_t dot;
        memcpy(&dot,
               rows + (ptrdiff_t)places[k][1] * cairo_image_surface_get_stride(picture) +
                   4 * (ptrdiff_t)places[k][0],
               4);
        for (int c = 0; c < 3; c++)
            assert_int_equal((dot >> (16 - 8 * c) & 255) > 100, c == k);
        assert_int_equal(dot >> 24, k < 3 ? 255 : 0);
    }
    cairo_surface_destroy(picture);
    ktg_view_drop(&view);
}

static void eyes_stand_where_they_are_named(void **state) {
    (void)state;
    for (unsigned up = 0; up < 3; up++) {
        ktg_eye front = ktg_eye_at(up, 0, 0), right = ktg_eye_at(up, KTG_PI / 2, 0);
        ktg_eye top = ktg_eye_at(up, 0, KTG_PI / 2);
        const double heights[] = {top.toward.x, top.toward.y, top.toward.z};
        assert_true(fabs(heights[up] - 1) < 1e-12);
        assert_true(ktg_dot3(right.toward, front.right) > 1 - 1e-12);
        assert_true(ktg_dot3(ktg_cross3(front.right, front.above), front.toward) > 1 - 1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_of_what_is_behind_shows),
        cmocka_unit_test(bars_that_lie_over_each_other_in_a_ring_are_right),
        cmocka_unit_test(neighbours_leave_no_hole),
        cmocka_unit_test(an_edge_shows_where_one_of_its_faces_does),
        cmocka_unit_test(colours_know_where_on_the_face_they_are),
        cmocka_unit_test(eyes_stand_where_they_are_named),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
