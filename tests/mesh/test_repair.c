/* tests/mesh/test_repair.c - each kind of fault is mended, and what is clean stays as it is. */
#include "core/memory.h"
#include "core/random.h"
#include "shapes.h"
#include "tests/short_memory.h"

/* Repairs; the result has to be what a repair promises, and a second repair finds nothing. */
static ktg_repair_report repair(void **state, ktg_mesh *mesh) {
    ktg_repair_report report, again;
    OK(ktg_mesh_repair(context_of(state), mesh, &report));
    assert_oriented_manifold(state, mesh);
    ktg_mesh_report check = report_of(state, mesh);
    assert_true(check.manifold && check.oriented);
    assert_int_equal(check.duplicate_faces + check.degenerate_faces, 0);
    assert_int_equal(check.unreferenced_vertices + check.inward_components, 0);
    OK(ktg_mesh_repair(context_of(state), mesh, &again));
    assert_false(again.changed);
    return report;
}

static void stays_as_it_is(void **state, builder *b) {
    ktg_mesh *mesh = finish(state, b), *before;
    OK(ktg_mesh_copy(context_of(state), mesh, &before));
    ktg_repair_report r = repair(state, mesh);
    assert_false(r.changed);
    assert_int_equal(mesh->vertex_count, before->vertex_count);
    assert_int_equal(mesh->face_count, before->face_count);
    assert_memory_equal(mesh->faces, before->faces, 3 * mesh->face_count * sizeof *mesh->faces);
    assert_memory_equal(mesh->positions, before->positions,
                        mesh->vertex_count * sizeof *mesh->positions);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&before);
}

static void clean_meshes_stay_to_the_bit(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    add_cube(b, 1, 1, 1, 1); /* touches the first with a vertex of its own */
    add_sphere(b, 9, 0, 0, 1, 0.2, 8, 10);
    stays_as_it_is(state, b);
    b = build();
    add_torus(b, 3, 1, 9, 7);
    add_cylinder(b, 1, 3, 8);
    stays_as_it_is(state, b);
}

static void faces_that_are_there_twice_go(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    add_face(b, b->faces[0], b->faces[2], b->faces[1]);
    add_face(b, b->faces[4], b->faces[5], b->faces[3]);
    add_point(b, 5, 5, 5);
    add_face(b, 1, 1, 2);
    ktg_mesh *mesh = finish(state, b);
    ktg_repair_report r = repair(state, mesh);
    assert_true(r.changed);
    assert_int_equal(r.duplicate_faces_removed, 2);
    assert_int_equal(r.degenerate_faces_removed, 1);
    assert_int_equal(r.unreferenced_vertices_removed, 1);
    assert_int_equal(mesh->face_count, 12);
    assert_int_equal(mesh->vertex_count, 8);
    assert_true(report_of(state, mesh).closed);
    ktg_mesh_free(&mesh);
}

/* A square pyramid with a vertex on one edge of its base, where a sliver closes the gap. */
static void a_flat_sliver_splits_its_neighbour(void **state) {
    double points[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 2, 0.5, 0, 0};
    uint32_t faces[] = {0, 2, 1, 0, 3, 2, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 5, 4, 5, 1, 4, 0, 1, 5};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    double volume = report_of(state, mesh).volume;
    assert_true(volume > 2);
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(r.degenerate_faces_removed, 1);
    assert_int_equal(mesh->face_count, 8);
    ktg_mesh_report c = report_of(state, mesh);
    assert_true(c.closed);
    assert_int_equal(c.vertices, 6);
    assert_float_equal(c.volume, volume, 1e-12);
    ktg_mesh_free(&mesh);
}

static void slivers_behind_slivers_leave_no_hole(void **state) {
    /* the gap 0-1 of the base is filled by a pile of flat faces over five points on a line */
    double points[] = {0, 0, 0, 2,    0, 0, 2,   2, 0, 0,    2, 0,
                       1, 1, 2, 0.25, 0, 0, 0.5, 0, 0, 1.25, 0, 0};
    uint32_t faces[] = {0, 2, 1, 0, 3, 2, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 5, 4,
                        5, 6, 4, 6, 7, 4, 7, 1, 4, 0, 1, 6, 0, 6, 5, 6, 1, 7};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    assert_true(report_of(state, mesh).closed);
    (void)repair(state, mesh);
    ktg_mesh_report c = report_of(state, mesh);
    assert_true(c.closed);
    assert_int_equal(c.genus, 0);
    assert_int_equal(c.vertices, 8);
    assert_int_equal(c.faces, 12);
    ktg_mesh_free(&mesh);
}

static void corners_all_but_equal_become_one(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0, 6, 8);
    double *south = b->positions, *near = b->positions + 3;
    near[0] = south[0] + 0x1p-45; /* a needle on either side of the edge between them */
    near[1] = south[1];
    near[2] = south[2];
    uint32_t faces = b->face_count;
    ktg_mesh *mesh = finish(state, b);
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(r.degenerate_faces_removed, 2);
    assert_int_equal(mesh->face_count, faces - 2);
    ktg_mesh_report c = report_of(state, mesh);
    assert_true(c.closed);
    assert_int_equal(c.euler, 2);
    ktg_mesh_free(&mesh);
}

static void loose_triangles_are_stitched(void **state) {
    builder *b = build(), *loose = build();
    add_sphere(b, 0, 0, 0, 1, 0.1, 6, 9);
    for (uint32_t h = 0; h < 3 * b->face_count; h++) {
        const double *p = b->positions + 3 * b->faces[h];
        add_point(loose, p[0], p[1], p[2]);
    }
    for (uint32_t f = 0; f < b->face_count; f++)
        add_face(loose, 3 * f, f % 3 ? 3 * f + 1 : 3 * f + 2, f % 3 ? 3 * f + 2 : 3 * f + 1);
    uint32_t vertices = b->vertex_count, faces = b->face_count;
    free(b);
    ktg_mesh *mesh = finish(state, loose);
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(mesh->vertex_count, vertices);
    assert_int_equal(r.vertices_welded, 3 * faces - vertices);
    assert_int_equal(r.faces_turned, (faces + 2) / 3);
    assert_true(report_of(state, mesh).closed);
    assert_true(report_of(state, mesh).volume > 0);
    ktg_mesh_free(&mesh);
}

static void a_solid_inside_out_is_turned_over(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    for (uint32_t f = 0; f < 12; f++) {
        uint32_t *c = b->faces + 3 * f, swap = c[1];
        c[1] = c[2];
        c[2] = swap;
    }
    ktg_mesh *mesh = finish(state, b);
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(r.faces_turned, 12);
    assert_float_equal(report_of(state, mesh).volume, 1, 1e-12);
    ktg_mesh_free(&mesh);
}

static void an_open_sheet_keeps_the_side_of_most_of_its_area(void **state) {
    builder *b = build();
    add_cylinder(b, 2, 4, 12);
    for (uint32_t f = 0; f < b->face_count / 4; f++) {
        uint32_t *c = b->faces + 3 * f, swap = c[1];
        c[1] = c[2];
        c[2] = swap;
    }
    uint32_t turned = b->face_count / 4;
    ktg_mesh *mesh = finish(state, b);
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(r.faces_turned, turned);
    ktg_mesh_free(&mesh);
}

static void two_cubes_that_share_an_edge_come_apart(void **state) {
    for (int welded = 0; welded < 2; welded++) {
        builder *b = build();
        add_cube(b, 0, 0, 0, 1);
        add_cube(b, 1, 1, 0, 1);
        if (welded)
            weld_builder(b);
        ktg_mesh *mesh = finish(state, b);
        ktg_repair_report r = repair(state, mesh);
        assert_int_equal(r.changed, welded);
        assert_int_equal(r.nonmanifold_edges_split, welded);
        assert_int_equal(r.nonmanifold_vertices_split, 2 * welded);
        ktg_mesh_report c = report_of(state, mesh);
        assert_true(c.closed);
        assert_int_equal(c.components, 2);
        assert_int_equal(c.vertices, 16);
        assert_float_equal(c.volume, 2, 1e-12);
        ktg_mesh_free(&mesh);
    }
}

static void two_cubes_that_share_a_vertex_come_apart(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    add_cube(b, 1, 1, 1, 1);
    weld_builder(b);
    ktg_mesh *mesh = finish(state, b);
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(r.nonmanifold_edges_split, 0);
    assert_int_equal(r.nonmanifold_vertices_split, 1);
    ktg_mesh_report c = report_of(state, mesh);
    assert_int_equal(c.components, 2);
    assert_int_equal(c.vertices, 16);
    assert_true(c.closed);
    ktg_mesh_free(&mesh);
}

static void cubes_that_share_a_whole_face_make_one_box_and_a_wall(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    add_cube(b, 1, 0, 0, 1);
    weld_builder(b);
    ktg_mesh *mesh = finish(state, b);
    ktg_repair_report r = repair(state, mesh);
    ktg_mesh_report c = report_of(state, mesh);
    assert_int_equal(c.components, 2);
    /* the faces between differ in their diagonal or not: either way a box of 2 x 1 x 1 is whole */
    assert_float_equal(c.high.x - c.low.x, 2, 0);
    assert_int_equal(r.nonmanifold_edges_split >= 4, true);
    assert_true(c.border_loops <= 2);
    ktg_mesh_free(&mesh);
}

/* A flat plate with an upright rib, or one that is bent upright where a rib goes straight on. */
static ktg_mesh *ribbed_plate(void **state, bool bent) {
    builder *b = build();
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 5; j++)
            add_point(b, j, bent && i > 1 ? 1 : i, bent && i > 1 ? i - 1 : 0);
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t j = 0; j < 4; j++)
            add_quad(b, 5 * i + j, 5 * i + j + 1, 5 * i + j + 6, 5 * i + j + 5);
    uint32_t top = b->vertex_count; /* a rib over the inner edges 6-7-8 */
    for (int j = 1; j < 4; j++)
        add_point(b, j, bent ? 2 : 1, bent ? 0 : 1);
    add_quad(b, 6, 7, top + 1, top);
    add_quad(b, 7, 8, top + 2, top + 1);
    return finish(state, b);
}

static void a_plate_stays_whole_beside_its_rib(void **state) {
    for (int bent = 0; bent < 2; bent++) {
        ktg_mesh *mesh = ribbed_plate(state, bent);
        ktg_repair_report r = repair(state, mesh);
        assert_int_equal(r.nonmanifold_edges_split, 2);
        assert_int_equal(r.faces_turned, 0);
        ktg_mesh_report c = report_of(state, mesh);
        assert_int_equal(c.components, 2);
        assert_int_equal(c.vertices, 26);
        assert_int_equal(c.border_edges, 14 + 6);
        assert_int_equal(c.border_loops, 2);
        ktg_mesh_free(&mesh);
    }
}

static void the_smoothest_pair_stays_where_nothing_else_decides(void **state) {
    double points[] = {0, 0, 0, 0, 4, 0, 2, 0, 0, -2, 0, 0.3, 0, 0, 3};
    uint32_t faces[] = {1, 0, 4, 0, 1, 3, 1, 0, 2}; /* upright, left, right */
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    (void)repair(state, mesh);
    ktg_adjacency *a;
    OK(ktg_adjacency_new(context_of(state), mesh, &a));
    assert_int_equal(a->twin[0], KTG_NONE);
    assert_int_equal(a->twin[3] / 3, 2);
    ktg_adjacency_free(&a);
    assert_int_equal(report_of(state, mesh).components, 2);
    ktg_mesh_free(&mesh);
}

static void a_moebius_strip_is_cut_once_and_a_full_twist_is_not(void **state) {
    for (int twists = 0; twists < 4; twists++) {
        builder *b = build();
        add_band(b, 40, twists);
        ktg_mesh *mesh = finish(state, b);
        ktg_repair_report r = repair(state, mesh);
        ktg_mesh_report c = report_of(state, mesh);
        assert_int_equal(c.components, 1);
        assert_int_equal(c.faces, 80);
        assert_int_equal(r.seams_opened > 0, twists % 2);
        assert_int_equal(c.border_loops, twists % 2 ? 1 : 2);
        ktg_mesh_free(&mesh);
    }
}

/* A slit one edge long has both its ends on both sides: the border needs a vertex of its own. */
static void a_slit_one_edge_long_can_be_told(void **state) {
    builder *b = build();
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            add_point(b, j, i, 0);
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t j = 0; j < 3; j++)
            add_quad(b, 4 * i + j, 4 * i + j + 1, 4 * i + j + 5, 4 * i + j + 4);
    uint32_t top = add_point(b, 1.5, 1, 1);
    add_face(b, 5, 6, top); /* two flaps on the edge 5-6: joined to each other or left over */
    uint32_t low = add_point(b, 1.5, 1, -1);
    add_face(b, 6, 5, low);
    ktg_mesh *mesh = finish(state, b);
    (void)repair(state, mesh);
    ktg_mesh_report c = report_of(state, mesh);
    assert_int_equal(c.components, 2);
    assert_int_equal(c.border_edges, 12 + 4);
    ktg_mesh_free(&mesh);
}

static uint32_t *numbers(uint32_t count, uint32_t from, uint32_t step) {
    uint32_t *array = calloc(count, sizeof(uint32_t));
    for (uint32_t i = 0; i < count; i++)
        array[i] = from + step * i;
    return array;
}

static void what_faces_carry_follows_them(void **state) {
    /* a face twice, a square whose second half is turned over, a flap beside it with a sliver */
    double points[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 0, 0, 1, -1, 0};
    uint32_t faces[] = {0, 1, 2, 2, 0, 1, 0, 3, 2, 0, 4, 1, 0, 5, 4, 4, 5, 1};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    mesh->face_polygon = numbers(6, 10, 1);
    mesh->face_material = numbers(6, 20, 1);
    mesh->face_uv = numbers(18, 0, 1);
    mesh->uvs = ktg_new(context_of(state), 18, ktg_vec2);
    mesh->uv_count = 18;
    for (int i = 0; i < 18; i++) /* the position itself, so that corners can be told */
        mesh->uvs[i] = (ktg_vec2){points[3 * faces[i]], points[3 * faces[i] + 1]};
    mesh->marked_edges = numbers(4, 2, 1);
    mesh->marked_count = 2; /* 2-3, and 4-5 */
    ktg_repair_report r = repair(state, mesh);
    assert_int_equal(r.duplicate_faces_removed, 1);
    assert_int_equal(r.degenerate_faces_removed, 1);
    assert_int_equal(r.faces_turned, 1);
    assert_int_equal(mesh->face_count, 5);
    assert_int_equal(report_of(state, mesh).components, 1);
    uint32_t seen[26] = {0};
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        assert_int_equal(mesh->face_material[f], mesh->face_polygon[f] + 10);
        seen[mesh->face_material[f]]++;
    }
    for (uint32_t h = 0; h < 15; h++) {
        ktg_vec2 uv = mesh->uvs[mesh->face_uv[h]];
        ktg_vec3 p = mesh->positions[mesh->faces[h]];
        assert_true(uv.x == p.x && uv.y == p.y);
    }
    assert_int_equal(seen[20], 2); /* cut in two by the sliver */
    assert_int_equal(seen[21] + seen[23], 0);
    assert_int_equal(seen[22] + seen[24] + seen[25], 3);
    assert_int_equal(mesh->marked_count, 2);
    for (int i = 0; i < 2; i++) { /* either way round */
        ktg_vec3 p = mesh->positions[mesh->marked_edges[2 * i]];
        ktg_vec3 q = mesh->positions[mesh->marked_edges[2 * i + 1]];
        const double *from = points + 6 + 6 * i, *to = from + 3;
        assert_true(p.x + q.x == from[0] + to[0] && p.y + q.y == from[1] + to[1]);
        assert_true((p.x == from[0] && p.y == from[1]) || (p.x == to[0] && p.y == to[1]));
    }
    ktg_mesh_free(&mesh);
}

static void heaps_of_any_triangles_become_manifold(void **state) {
    for (uint64_t seed = 1; seed <= 300; seed++) {
        ktg_random random;
        ktg_random_seed(&random, seed);
        builder *b = build();
        uint32_t side = 2 + (uint32_t)ktg_random_below(&random, 3);
        uint32_t vertices = 4 + (uint32_t)ktg_random_below(&random, 20);
        for (uint32_t i = 0; i < vertices; i++)
            add_point(b, (double)ktg_random_below(&random, side),
                      (double)ktg_random_below(&random, side),
                      (double)ktg_random_below(&random, side));
        for (uint32_t i = 1 + (uint32_t)ktg_random_below(&random, 60); i > 0; i--)
            add_face(b, (uint32_t)ktg_random_below(&random, vertices),
                     (uint32_t)ktg_random_below(&random, vertices),
                     (uint32_t)ktg_random_below(&random, vertices));
        ktg_mesh *mesh = finish(state, b), *copy;
        OK(ktg_mesh_copy(context_of(state), mesh, &copy));
        ktg_repair_report report;
        if (ktg_mesh_repair(context_of(state), copy, &report) == KTG_OK)
            (void)repair(state, mesh);
        ktg_mesh_free(&mesh);
        ktg_mesh_free(&copy);
    }
}

static void a_scale_by_a_power_of_two_changes_nothing(void **state) {
    uint32_t *faces[2] = {NULL, NULL}, count[2];
    for (int i = 0; i < 2; i++) {
        ktg_random random;
        ktg_random_seed(&random, 7);
        builder *b = build();
        for (int v = 0; v < 12; v++)
            for (int k = 0; k < 3; k++)
                b->positions[3 * v + k] = ldexp(ktg_random_unit(&random), 500 * i);
        b->vertex_count = 12;
        for (int f = 0; f < 60; f++)
            add_face(b, (uint32_t)ktg_random_below(&random, 12),
                     (uint32_t)ktg_random_below(&random, 12),
                     (uint32_t)ktg_random_below(&random, 12));
        ktg_mesh *mesh = finish(state, b);
        (void)repair(state, mesh);
        count[i] = mesh->face_count;
        faces[i] = mesh->faces;
        mesh->faces = NULL;
        ktg_mesh_free(&mesh);
    }
    assert_int_equal(count[0], count[1]);
    assert_memory_equal(faces[0], faces[1], 3 * count[0] * sizeof *faces[0]);
    ktg_free(faces[0]);
    ktg_free(faces[1]);
}

static void without_area_nothing_is_left(void **state) {
    double points[] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0};
    uint32_t faces[] = {0, 1, 2, 0, 3, 1};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    ktg_repair_report r;
    assert_int_equal(ktg_mesh_repair(context_of(state), mesh, &r), KTG_GEOMETRY);
    assert_int_equal(mesh->face_count, 2); /* a failed repair leaves the mesh alone */
    ktg_mesh_free(&mesh);
}

static void memory_may_run_out_anywhere(void **state) {
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        builder *b = build();
        add_cube(b, 0, 0, 0, 1);
        add_cube(b, 1, 1, 0, 1);
        weld_builder(b);
        uint32_t middle = add_point(b, 0.5, 0, 0);
        add_face(b, 0, 1, middle);
        ktg_mesh *mesh = finish(state, b);
        mesh->marked_edges = numbers(2, 0, 1);
        mesh->marked_count = 1;
        ktg_repair_report r;
        ktg_context_fail_allocation(context_of(state), ++nth);
        status = ktg_mesh_repair(context_of(state), mesh, &r);
        end_short_memory(context_of(state), status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        assert_int_equal(status == KTG_OK, mesh->vertex_count == 16 || mesh->face_count != 25);
        ktg_mesh_free(&mesh);
    }
    assert_true(nth > 30);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clean_meshes_stay_to_the_bit),
        cmocka_unit_test(faces_that_are_there_twice_go),
        cmocka_unit_test(a_flat_sliver_splits_its_neighbour),
        cmocka_unit_test(slivers_behind_slivers_leave_no_hole),
        cmocka_unit_test(corners_all_but_equal_become_one),
        cmocka_unit_test(loose_triangles_are_stitched),
        cmocka_unit_test(a_solid_inside_out_is_turned_over),
        cmocka_unit_test(an_open_sheet_keeps_the_side_of_most_of_its_area),
        cmocka_unit_test(two_cubes_that_share_an_edge_come_apart),
        cmocka_unit_test(two_cubes_that_share_a_vertex_come_apart),
        cmocka_unit_test(cubes_that_share_a_whole_face_make_one_box_and_a_wall),
        cmocka_unit_test(a_plate_stays_whole_beside_its_rib),
        cmocka_unit_test(the_smoothest_pair_stays_where_nothing_else_decides),
        cmocka_unit_test(a_moebius_strip_is_cut_once_and_a_full_twist_is_not),
        cmocka_unit_test(a_slit_one_edge_long_can_be_told),
        cmocka_unit_test(what_faces_carry_follows_them),
        cmocka_unit_test(heaps_of_any_triangles_become_manifold),
        cmocka_unit_test(a_scale_by_a_power_of_two_changes_nothing),
        cmocka_unit_test(without_area_nothing_is_left),
        cmocka_unit_test(memory_may_run_out_anywhere),
    };
    return cmocka_run_group_tests_name("mesh repair", tests, start, stop);
}
