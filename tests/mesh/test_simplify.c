/* tests/mesh/test_simplify.c - fewer faces, and nothing else that was promised is lost. */
#include "shapes.h"
#include "tests/short_memory.h"

/* Simplifies and compares with what was there before. */
static ktg_simplify_report simplify(void **state, ktg_mesh *mesh, uint32_t target) {
    ktg_simplify_report report;
    ktg_mesh_report before = report_of(state, mesh);
    OK(ktg_mesh_simplify(context_of(state), mesh, target, &report));
    ktg_mesh_report after = report_of(state, mesh);
    assert_oriented_manifold(state, mesh);
    assert_int_equal(report.faces_before, before.faces);
    assert_int_equal(report.faces_after, after.faces);
    assert_int_equal(report.target_reached, after.faces <= target);
    assert_int_equal(after.components, before.components);
    assert_int_equal(after.border_loops, before.border_loops);
    assert_int_equal(after.euler, before.euler);
    assert_int_equal(after.genus, before.genus);
    assert_int_equal(after.degenerate_faces, 0);
    assert_int_equal(after.inward_components, 0);
    assert_true(after.self_intersections <= before.self_intersections);
    return report;
}

static double distance(void **state, const ktg_mesh *a, const ktg_mesh *b) {
    double d;
    OK(ktg_mesh_hausdorff(context_of(state), a, b, 0, &d));
    return d;
}

static ktg_vec3 normal_of(const ktg_mesh *mesh, uint32_t f, ktg_vec3 *centre) {
    ktg_vec3 a = mesh->positions[mesh->faces[3 * f]], b = mesh->positions[mesh->faces[3 * f + 1]],
             c = mesh->positions[mesh->faces[3 * f + 2]];
    *centre = ktg_mul3(ktg_add3(a, ktg_add3(b, c)), 1.0 / 3);
    return ktg_cross3(ktg_sub3(b, a), ktg_sub3(c, a));
}

static void a_bumpy_sphere_keeps_its_shape_and_turns_no_face(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0.15, 50, 80);
    ktg_mesh *mesh = finish(state, b), *before;
    OK(ktg_mesh_copy(context_of(state), mesh, &before));
    ktg_simplify_report r = simplify(state, mesh, 400);
    assert_true(r.target_reached);
    assert_in_range(mesh->face_count, 399, 400);
    uint32_t thin = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec3 centre, n = normal_of(mesh, f, &centre), *p = mesh->positions;
        assert_true(ktg_dot3(n, centre) > 0);
        double longest = 0;
        for (uint32_t k = 0; k < 3; k++)
            longest = fmax(longest, ktg_length3(ktg_sub3(p[mesh->faces[3 * f + k]],
                                                         p[mesh->faces[3 * f + (k + 1) % 3]])));
        thin += ktg_length3(n) < 0.1 * longest * longest;
    }
    assert_int_equal(thin, 0);
    assert_true(distance(state, before, mesh) < 0.06);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&before);
}

static void a_torus_stays_a_torus_down_to_the_end(void **state) {
    builder *b = build();
    add_torus(b, 3, 1, 60, 30);
    ktg_mesh *mesh = finish(state, b);
    assert_true(simplify(state, mesh, 200).target_reached);
    (void)simplify(state, mesh, 1);
    assert_in_range(mesh->face_count, 14, 60); /* a torus has at least 14 */
    ktg_mesh_free(&mesh);
}

static void a_sphere_ends_as_a_tetrahedron(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0, 10, 12);
    ktg_mesh *mesh = finish(state, b);
    ktg_simplify_report r = simplify(state, mesh, 1);
    assert_false(r.target_reached);
    assert_int_equal(mesh->face_count, 4);
    assert_int_equal(mesh->vertex_count, 4);
    ktg_mesh_free(&mesh);
}

static void the_borders_of_a_tube_keep_their_place(void **state) {
    builder *b = build();
    add_cylinder(b, 2, 40, 64);
    ktg_mesh *mesh = finish(state, b);
    assert_true(simplify(state, mesh, 150).target_reached);
    ktg_adjacency *a;
    OK(ktg_adjacency_new(context_of(state), mesh, &a));
    uint32_t at_border = 0;
    for (uint32_t h = 0; h < a->halfedge_count; h++) {
        ktg_vec3 p = mesh->positions[mesh->faces[h]];
        if (a->twin[h] != KTG_NONE)
            continue;
        assert_true(p.z == 0 || p.z == 2);
        assert_true(fabs(hypot(p.x, p.y) - 1) < 1e-12);
        at_border++;
    }
    assert_true(at_border >= 12);
    ktg_adjacency_free(&a);
    ktg_mesh_free(&mesh);
}

/* A plate with two materials side by side. */
static ktg_mesh *plate(void **state, uint32_t n) {
    builder *b = build();
    add_plate(b, n);
    ktg_mesh *mesh = finish(state, b);
    mesh->face_material = calloc(mesh->face_count, sizeof *mesh->face_material);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        mesh->face_material[f] = f / 2 % n < n / 2 ? 3 : 5;
    mesh->face_polygon = calloc(mesh->face_count, sizeof *mesh->face_polygon);
    return mesh;
}

static void a_plate_keeps_its_corners_and_its_colours(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    (void)simplify(state, mesh, 8);
    assert_in_range(mesh->face_count, 2, 8);
    double area[2] = {0, 0};
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec3 centre, n = normal_of(mesh, f, &centre);
        assert_true(mesh->face_material[f] == 3 || mesh->face_material[f] == 5);
        assert_int_equal(mesh->face_material[f], centre.x < 8 ? 3 : 5);
        area[mesh->face_material[f] == 5] += n.z / 2;
    }
    assert_float_equal(area[0], 128, 0.01);
    assert_float_equal(area[0] + area[1], 256, 1e-9);
    assert_null(mesh->face_polygon);
    ktg_mesh_free(&mesh);
}

/* Whether the mesh has an edge from p to q. */
static bool has_edge(const ktg_mesh *mesh, ktg_vec3 p, ktg_vec3 q) {
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        ktg_vec3 a = mesh->positions[mesh->faces[h]];
        ktg_vec3 b = mesh->positions[mesh->faces[h % 3 == 2 ? h - 2 : h + 1]];
        if ((!memcmp(&a, &p, sizeof p) && !memcmp(&b, &q, sizeof q)) ||
            (!memcmp(&a, &q, sizeof q) && !memcmp(&b, &p, sizeof p)))
            return true;
    }
    return false;
}

static void marked_edges_stay_as_they_are(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    uint32_t edges[2 * 9];
    ktg_vec3 ends[2 * 9];
    for (uint32_t i = 0; i < 9; i++) { /* from the border into the middle */
        edges[2 * i] = 17 * i + 8;
        edges[2 * i + 1] = 17 * (i + 1) + 8;
    }
    for (uint32_t i = 0; i < 18; i++)
        ends[i] = mesh->positions[edges[i]];
    assert_int_equal(ktg_mesh_mark(context_of(state), mesh, edges, 9), KTG_OK);
    assert_true(simplify(state, mesh, 60).target_reached);
    assert_int_equal(mesh->marked_count, 9);
    for (uint32_t i = 0; i < 9; i++) {
        ktg_vec3 p = mesh->positions[mesh->marked_edges[2 * i]];
        ktg_vec3 q = mesh->positions[mesh->marked_edges[2 * i + 1]];
        assert_int_equal(mesh->marked_numbers[i], i);
        assert_memory_equal(&p, &ends[2 * i], sizeof p);
        assert_memory_equal(&q, &ends[2 * i + 1], sizeof q);
        assert_true(has_edge(mesh, p, q));
    }
    double area = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec3 centre;
        area += normal_of(mesh, f, &centre).z / 2;
    }
    assert_float_equal(area, 256, 1e-9); /* the border did not follow them in */
    ktg_mesh_free(&mesh);
}

static void marked_edges_of_a_round_thing_stay_too(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0.1, 20, 30);
    ktg_mesh *mesh = finish(state, b);
    uint32_t edges[2 * 40];
    ktg_vec3 ends[2 * 40];
    for (uint32_t i = 0; i < 40; i++) {
        edges[2 * i] = mesh->faces[3 * 25 * i];
        edges[2 * i + 1] = mesh->faces[3 * 25 * i + 1];
    }
    for (uint32_t i = 0; i < 80; i++)
        ends[i] = mesh->positions[edges[i]];
    assert_int_equal(ktg_mesh_mark(context_of(state), mesh, edges, 40), KTG_OK);
    (void)simplify(state, mesh, 300);
    assert_in_range(mesh->face_count, 100, 300);
    for (uint32_t i = 0; i < 40; i++)
        assert_true(has_edge(mesh, ends[2 * i], ends[2 * i + 1]));
    ktg_mesh_free(&mesh);
}

static void shells_that_all_but_touch_do_not_cut_each_other(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0.1, 30, 40);
    add_sphere(b, 0, 0, 0, 1.004, 0.1, 30, 40);
    ktg_mesh *mesh = finish(state, b);
    assert_int_equal(report_of(state, mesh).self_intersections, 0);
    (void)simplify(state, mesh, 400); /* which must not grow from 0 */
    assert_true(mesh->face_count < 2300);
    ktg_mesh_free(&mesh);
}

static void linked_rings_stay_linked(void **state) {
    builder *b = build();
    add_torus(b, 3, 1, 40, 20);
    uint32_t first = b->vertex_count;
    add_torus(b, 3, 0.95, 40, 20);
    for (uint32_t v = first; v < b->vertex_count; v++) {
        double *p = b->positions + 3 * v, y = p[1];
        p[0] += 3.02;
        p[1] = -p[2];
        p[2] = y;
    }
    ktg_mesh *mesh = finish(state, b);
    assert_int_equal(report_of(state, mesh).self_intersections, 0);
    assert_true(simplify(state, mesh, 300).target_reached);
    ktg_mesh_free(&mesh);
}

static void intersections_that_were_there_do_not_grow(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0.1, 20, 30);
    add_sphere(b, 0.7, 0.1, 0.2, 1, 0.1, 20, 30);
    ktg_mesh *mesh = finish(state, b);
    assert_true(report_of(state, mesh).self_intersections > 50);
    assert_true(simplify(state, mesh, 200).target_reached);
    ktg_mesh_free(&mesh);
}

static void the_same_at_every_power_of_two_and_every_time(void **state) {
    ktg_mesh *meshes[3];
    int exponents[3] = {0, 0, 200};
    for (int i = 0; i < 3; i++) {
        builder *b = build();
        add_sphere(b, 0.1, 0.2, 0.3, 1, 0.2, 20, 30);
        for (uint32_t k = 0; k < 3 * b->vertex_count; k++)
            b->positions[k] = ldexp(b->positions[k], exponents[i]);
        meshes[i] = finish(state, b);
        (void)simplify(state, meshes[i], 150);
    }
    for (int i = 1; i < 3; i++) {
        assert_int_equal(meshes[i]->face_count, meshes[0]->face_count);
        assert_memory_equal(meshes[i]->faces, meshes[0]->faces,
                            3 * meshes[0]->face_count * sizeof(uint32_t));
        for (uint32_t v = 0; v < meshes[0]->vertex_count; v++) {
            ktg_vec3 p = meshes[0]->positions[v], q = meshes[i]->positions[v];
            assert_true(ldexp(p.x, exponents[i]) == q.x && ldexp(p.y, exponents[i]) == q.y &&
                        ldexp(p.z, exponents[i]) == q.z);
        }
    }
    for (int i = 0; i < 3; i++)
        ktg_mesh_free(&meshes[i]);
}

static void what_is_small_enough_stays_as_it_is(void **state) {
    ktg_mesh *mesh = plate(state, 2);
    const uint32_t edge[] = {4, 1};
    assert_int_equal(ktg_mesh_mark(context_of(state), mesh, edge, 1), KTG_OK);
    ktg_simplify_report r = simplify(state, mesh, 8);
    assert_true(r.target_reached);
    assert_non_null(mesh->face_polygon);
    assert_int_equal(mesh->marked_count, 1);
    ktg_mesh_free(&mesh);
}

static void only_manifolds_are_taken(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, -1, 2, 0, 1, 2};
    uint32_t rib[] = {0, 1, 2, 1, 0, 3, 0, 1, 4}, bow[] = {0, 1, 2, 0, 5, 6};
    uint32_t turned[] = {0, 1, 2, 0, 1, 3};
    ktg_mesh *meshes[] = {make(state, POINTS(points), FACES(rib)),
                          make(state, POINTS(points), FACES(bow)),
                          make(state, POINTS(points), FACES(turned))};
    for (int i = 0; i < 3; i++) {
        ktg_simplify_report r;
        uint32_t before = meshes[i]->face_count;
        assert_int_equal(ktg_mesh_simplify(context_of(state), meshes[i], 1, &r), KTG_ARGUMENT);
        assert_int_equal(meshes[i]->face_count, before);
        ktg_mesh_free(&meshes[i]);
    }
}

/* Stops when it is asked for the n-th time, and counts down to that. */
static ktg_wish stop_at(void *user) {
    int *left = user;
    return --*left > 0 ? KTG_GO_ON : KTG_STOP;
}

static void it_can_be_cancelled_whenever_it_asks(void **state) {
    ktg_status status = KTG_CANCELLED;
    int asked = 0;
    for (int nth = 1; status == KTG_CANCELLED; nth++) {
        builder *b = build();
        add_sphere(b, 0, 0, 0, 1, 0.1, 20, 30);
        ktg_mesh *mesh = finish(state, b);
        uint32_t before = mesh->face_count;
        int left = nth;
        ktg_context_set_cancel(context_of(state), stop_at, &left);
        status = ktg_mesh_simplify(context_of(state), mesh, 20, NULL);
        ktg_context_set_cancel(context_of(state), NULL, NULL);
        assert_true(status == KTG_OK ? left > 0 : left == 0); /* the first answer counts */
        assert_int_equal(status == KTG_OK, mesh->face_count < before);
        asked = nth - left;
        ktg_mesh_free(&mesh);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(asked >= 2);
}

static void memory_may_run_out(void **state) {
    ktg_mesh *mesh = plate(state, 6);
    ktg_simplify_report r;
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        assert_int_equal(mesh->face_count, 72);
        ktg_context_fail_allocation(context_of(state), ++nth);
        status = ktg_mesh_simplify(context_of(state), mesh, 10, &r);
    }
    end_short_memory(context_of(state), status);
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 20 && mesh->face_count <= 10);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bumpy_sphere_keeps_its_shape_and_turns_no_face),
        cmocka_unit_test(a_torus_stays_a_torus_down_to_the_end),
        cmocka_unit_test(a_sphere_ends_as_a_tetrahedron),
        cmocka_unit_test(the_borders_of_a_tube_keep_their_place),
        cmocka_unit_test(a_plate_keeps_its_corners_and_its_colours),
        cmocka_unit_test(marked_edges_stay_as_they_are),
        cmocka_unit_test(marked_edges_of_a_round_thing_stay_too),
        cmocka_unit_test(shells_that_all_but_touch_do_not_cut_each_other),
        cmocka_unit_test(linked_rings_stay_linked),
        cmocka_unit_test(intersections_that_were_there_do_not_grow),
        cmocka_unit_test(the_same_at_every_power_of_two_and_every_time),
        cmocka_unit_test(what_is_small_enough_stays_as_it_is),
        cmocka_unit_test(only_manifolds_are_taken),
        cmocka_unit_test(it_can_be_cancelled_whenever_it_asks),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests_name("mesh simplify", tests, start, stop);
}
