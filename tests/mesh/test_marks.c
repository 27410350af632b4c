/* Marked edges on their way through repair, and faces that are left out by name. */
#include "core/memory.h"
#include "shapes.h"
#include "tests/short_memory.h"

static void mark(void **state, ktg_mesh *mesh, uint32_t a, uint32_t b) {
    const uint32_t edge[] = {a, b};
    OK(ktg_mesh_mark(context_of(state), mesh, edge, 1));
}

static void repair(void **state, ktg_mesh *mesh) {
    OK(ktg_mesh_repair(context_of(state), mesh, NULL));
}

/* The i-th mark runs from p to q. */
static void assert_mark(const ktg_mesh *mesh, uint32_t i, ktg_vec3 p, ktg_vec3 q) {
    assert_true(i < mesh->marked_count);
    ktg_vec3 a = mesh->positions[mesh->marked_edges[2 * i]];
    ktg_vec3 b = mesh->positions[mesh->marked_edges[2 * i + 1]];
    assert_memory_equal(&a, &p, sizeof p);
    assert_memory_equal(&b, &q, sizeof q);
}

static void only_edges_can_be_marked(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    uint32_t faces[] = {0, 1, 2, 0, 2, 3}, bad[] = {0, 2, 1, 3}, far[] = {0, 4};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    mark(state, mesh, 2, 0);
    assert_int_equal(mesh->marked_count, 1);
    assert_int_equal(mesh->marked_edges[0], 2);
    assert_int_equal(mesh->marked_edges[1], 0);
    assert_int_equal(ktg_mesh_mark(context_of(state), mesh, bad, 2), KTG_ARGUMENT);
    assert_int_equal(ktg_mesh_mark(context_of(state), mesh, far, 1), KTG_ARGUMENT);
    assert_int_equal(mesh->marked_count, 1); /* as they were */
    OK(ktg_mesh_mark(context_of(state), mesh, NULL, 0));
    assert_int_equal(mesh->marked_count, 0);
    ktg_mesh_free(&mesh);
}

/* Two squares whose common edge has vertices of its own on each side, and one of them in front. */
static void marks_on_either_side_of_a_seam_are_one_when_it_closes(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0};
    uint32_t faces[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    const uint32_t ways[][2] = {{1, 2}, {2, 1}, {4, 7}, {7, 4}, {1, 7}, {2, 4}};
    for (int i = 0; i < 6; i++) {
        ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
        ktg_vec3 p = mesh->positions[ways[i][0]], q = mesh->positions[ways[i][1]];
        mark(state, mesh, ways[i][0], ways[i][1]);
        assert_int_equal(mesh->marked_count, 2);
        repair(state, mesh);
        assert_int_equal(mesh->vertex_count, 6);
        assert_in_range(mesh->marked_count, 1, 2);
        for (uint32_t k = 0; k < mesh->marked_count; k++) {
            assert_mark(mesh, k, p, q);
            assert_int_equal(mesh->marked_numbers[k], 0);
        }
        ktg_mesh_free(&mesh);
    }
}

static void marks_made_by_hand_survive_on_the_second_side_of_a_seam(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0};
    uint32_t faces[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    mesh->marked_edges = ktg_new(context_of(state), 2, uint32_t);
    mesh->marked_edges[0] = 4;
    mesh->marked_edges[1] = 7; /* vertices of the second square only */
    mesh->marked_count = 1;
    repair(state, mesh);
    assert_int_equal(mesh->marked_count, 1);
    assert_mark(mesh, 0, (ktg_vec3){1, 0, 0}, (ktg_vec3){1, 1, 0});
    assert_null(mesh->marked_numbers);
    ktg_mesh_free(&mesh);
}

static void a_mark_where_two_solids_touch_is_on_both(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    add_cube(b, 1, 1, 0, 1);
    weld_builder(b);
    ktg_mesh *mesh = finish(state, b);
    uint32_t ends[2], count = 0;
    for (uint32_t v = 0; v < 8; v++)
        if (mesh->positions[v].x == 1 && mesh->positions[v].y == 1)
            ends[count++ % 2] = v;
    assert_int_equal(count, 2);
    mark(state, mesh, ends[0], ends[1]);
    assert_int_equal(mesh->marked_count, 1);
    repair(state, mesh);
    assert_int_equal(mesh->marked_count, 2);
    assert_int_equal(mesh->marked_numbers[1], 0);
    assert_true(mesh->marked_edges[0] != mesh->marked_edges[2]);
    ktg_mesh_free(&mesh);
}

/* A sliver 0 3 1 behind the edge 0 1: the face in front of it is cut at 3, and so is the mark. */
static void a_mark_is_cut_with_its_face(void **state) {
    double points[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 1, 0, 0, 0, -1, 0};
    uint32_t faces[] = {0, 1, 2, 0, 3, 1, 3, 0, 4};
    for (int turned = 0; turned < 2; turned++) {
        ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
        mark(state, mesh, turned, 1 - turned);
        repair(state, mesh);
        assert_int_equal(mesh->face_count, 3);
        assert_int_equal(mesh->marked_count, 2);
        ktg_vec3 from = {2.0 * turned, 0, 0}, middle = {1, 0, 0}, to = {2.0 * (1 - turned), 0, 0};
        assert_mark(mesh, 0, from, middle);
        assert_mark(mesh, 1, middle, to);
        assert_int_equal(mesh->marked_numbers[0] + mesh->marked_numbers[1], 0);
        ktg_mesh_free(&mesh);
    }
}

static void a_mark_without_length_is_lost(void **state) {
    double points[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 2, 0, 0};
    uint32_t faces[] = {0, 1, 2, 0, 3, 1};
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    mark(state, mesh, 3, 1);
    repair(state, mesh);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->marked_count, 0);
    ktg_mesh_free(&mesh);
}

/* ---- leaving out ---------------------------------------------------------------------------- */

/* A cube of three groups: "base" (two faces), "front door" (two), "rest"; base is also all there is
 * of a material. Vertex 8 is not used. */
static ktg_mesh *house(void **state) {
    builder *b = build();
    add_cube(b, 0, 0, 0, 1);
    weld_builder(b);
    add_point(b, 9, 9, 9);
    static const char *const names[] = {"base", "front door", "rest"};
    ktg_mesh *mesh = finish(state, b);
    mesh->face_group = ktg_new(context_of(state), 12, uint32_t);
    mesh->face_material = ktg_new(context_of(state), 12, uint32_t);
    mesh->groups.text = ktg_new(context_of(state), 3, char *);
    for (uint32_t i = 0; i < 3; i++)
        mesh->groups.text[i] = ktg_copy_text(context_of(state), names[i], SIZE_MAX);
    mesh->groups.count = 3;
    mesh->materials.text = ktg_new(context_of(state), 1, char *);
    mesh->materials.text[0] = ktg_copy_text(context_of(state), "grass", SIZE_MAX);
    mesh->materials.count = 1;
    for (uint32_t f = 0; f < 12; f++) {
        mesh->face_group[f] = f < 2 ? 0 : f < 4 ? 1 : 2;
        mesh->face_material[f] = f < 2 ? 0 : KTG_NONE;
    }
    return mesh;
}

static void omit(void **state, const char *name, uint32_t left) {
    ktg_mesh *mesh = house(state);
    OK(ktg_mesh_omit(context_of(state), mesh, &name, 1));
    assert_int_equal(mesh->face_count, left);
    assert_int_equal(mesh->vertex_count, 9); /* each vertex is in other faces too, or in none */
    ktg_mesh_free(&mesh);
}

static void faces_are_left_out_by_any_of_their_names(void **state) {
    omit(state, "base", 10);
    omit(state, "grass", 10);
    omit(state, "front door", 10);
    omit(state, "door", 10);
    omit(state, "front", 10);
    omit(state, "rest", 4);
}

static void a_name_that_is_not_there_is_answered_with_those_that_are(void **state) {
    ktg_mesh *mesh = house(state);
    const char *bad[] = {"bas", "", "doo", "door ", "front  door"};
    for (int i = 0; i < 5; i++) {
        assert_int_equal(ktg_mesh_omit(context_of(state), mesh, &bad[i], 1), KTG_ARGUMENT);
        assert_non_null(strstr(ktg_context_message(context_of(state)),
                               "there are groups: base, front door, rest; materials: grass"));
    }
    assert_int_equal(mesh->face_count, 12);
    ktg_mesh_free(&mesh);
    double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    uint32_t faces[] = {0, 1, 2};
    mesh = make(state, POINTS(points), FACES(faces));
    assert_int_equal(ktg_mesh_omit(context_of(state), mesh, bad, 1), KTG_ARGUMENT);
    assert_non_null(strstr(ktg_context_message(context_of(state)), "names no group"));
    ktg_mesh_free(&mesh);
}

static void leaving_out_everything_is_refused(void **state) {
    ktg_mesh *mesh = house(state);
    const char *all[] = {"base", "door", "rest"};
    assert_int_equal(ktg_mesh_omit(context_of(state), mesh, all, 3), KTG_GEOMETRY);
    assert_int_equal(mesh->face_count, 12);
    OK(ktg_mesh_omit(context_of(state), mesh, all, 2));
    assert_int_equal(mesh->face_count, 8);
    ktg_mesh_free(&mesh);
}

static void vertices_and_marks_go_with_their_faces(void **state) {
    double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 5, 5, 5};
    uint32_t faces[] = {0, 1, 2, 0, 2, 3}, edges[] = {0, 1, 0, 2, 3, 0};
    const char *name = "a";
    ktg_mesh *mesh = make(state, POINTS(points), FACES(faces));
    mesh->face_object = ktg_new(context_of(state), 2, uint32_t);
    mesh->face_object[1] = KTG_NONE;
    mesh->objects.text = ktg_new(context_of(state), 1, char *);
    mesh->objects.text[0] = ktg_copy_text(context_of(state), "a", SIZE_MAX);
    mesh->objects.count = 1;
    OK(ktg_mesh_mark(context_of(state), mesh, edges, 3));
    OK(ktg_mesh_omit(context_of(state), mesh, &name, 1));
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->vertex_count, 4); /* the one without faces is for the repair to tell */
    assert_int_equal(mesh->marked_count, 2);
    assert_mark(mesh, 0, (ktg_vec3){0, 0, 0}, (ktg_vec3){1, 1, 0});
    assert_mark(mesh, 1, (ktg_vec3){0, 1, 0}, (ktg_vec3){0, 0, 0});
    assert_int_equal(mesh->marked_numbers[0], 1);
    assert_int_equal(mesh->marked_numbers[1], 2);
    ktg_mesh_free(&mesh);
}

static void memory_may_run_out_anywhere(void **state) {
    const char *name = "base";
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_mesh *mesh = house(state);
        uint32_t edges[2 * 6]; /* more than lists have room for at first */
        for (uint32_t k = 0; k < 6; k++)
            memcpy(edges + 2 * k, mesh->faces + 3 * (11 - k), 2 * sizeof *edges);
        ktg_context_fail_allocation(context_of(state), ++nth);
        status = ktg_mesh_mark(context_of(state), mesh, edges, 6);
        if (status == KTG_OK)
            status = ktg_mesh_omit(context_of(state), mesh, &name, 1);
        if (status == KTG_OK)
            status = ktg_mesh_repair(context_of(state), mesh, NULL);
        end_short_memory(context_of(state), status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        ktg_mesh_free(&mesh);
    }
    assert_true(nth > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_edges_can_be_marked),
        cmocka_unit_test(marks_on_either_side_of_a_seam_are_one_when_it_closes),
        cmocka_unit_test(marks_made_by_hand_survive_on_the_second_side_of_a_seam),
        cmocka_unit_test(a_mark_where_two_solids_touch_is_on_both),
        cmocka_unit_test(a_mark_is_cut_with_its_face),
        cmocka_unit_test(a_mark_without_length_is_lost),
        cmocka_unit_test(faces_are_left_out_by_any_of_their_names),
        cmocka_unit_test(a_name_that_is_not_there_is_answered_with_those_that_are),
        cmocka_unit_test(leaving_out_everything_is_refused),
        cmocka_unit_test(vertices_and_marks_go_with_their_faces),
        cmocka_unit_test(memory_may_run_out_anywhere),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
