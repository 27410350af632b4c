/* Reading OBJ. */
#include "read_help.h"

#include <locale.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void corners_in_all_their_forms_are_read(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj",
                               TRIANGLE "vt 0 0\nvt 1 0.5\nvt 0.25 # half\nvn 0 0 1\n"
                                        "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//1 3//1\n"
                                        "f 1/1/1 2/2/1 3/3/1\nf -3/-3 -2/-2 -1/-1\n");
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 5);
    assert_int_equal(mesh->uv_count, 3);
    for (uint32_t f = 0; f < 5; f++) {
        assert_corners(mesh, f, 0, 1, 2);
        bool has = f == 1 || f == 3 || f == 4;
        for (uint32_t k = 0; k < 3; k++)
            assert_int_equal(mesh->face_uv[3 * f + k], has ? k : KTG_NONE);
    }
    assert_true(mesh->uvs[1].x == 1 && mesh->uvs[1].y == 0.5);
    assert_true(mesh->uvs[2].x == 0.25 && mesh->uvs[2].y == 0);
    assert_null(mesh->face_polygon);
    assert_null(mesh->face_object);
    assert_null(mesh->face_group);
    assert_null(mesh->face_material);
    assert_null(mesh->material_library);
    assert_null(mesh->marked_edges);
    ktg_mesh_free(&mesh);
}

static void texture_coordinates_without_a_use_are_left_out(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj", TRIANGLE "vt 0 0\nf 1 2 3\n");
    assert_int_equal(mesh->uv_count, 0);
    assert_null(mesh->uvs);
    assert_null(mesh->face_uv);
    ktg_mesh_free(&mesh);
}

static void negative_numbers_count_from_where_they_stand(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.obj", TRIANGLE "f -3 -2 -1\nv 0 0 1\nf -1 -4 -3\nf 5 1 2\nv 9 9 9\n");
    assert_corners(mesh, 0, 0, 1, 2);
    assert_corners(mesh, 1, 3, 0, 1);
    assert_corners(mesh, 2, 4, 0, 1); /* a vertex that only follows */
    ktg_mesh_free(&mesh);
}

static void names_are_kept_as_they_are_written(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj",
                               "mtllib my colours.mtl \nmtllib b.mtl\n" TRIANGLE "f 1 2 3\n"
                               "o body\ng left arm\nusemtl Material #25\nf 1 2 3\n"
                               "o head \ng\nusemtl red\nf 1 2 3\no body\ng left arm\nf 1 2 3\n");
    assert_string_equal(mesh->material_library, "my colours.mtl\nb.mtl");
    assert_int_equal(mesh->objects.count, 2);
    assert_string_equal(mesh->objects.text[0], "body");
    assert_string_equal(mesh->objects.text[1], "head");
    assert_int_equal(mesh->groups.count, 1);
    assert_string_equal(mesh->groups.text[0], "left arm");
    assert_int_equal(mesh->materials.count, 2);
    assert_string_equal(mesh->materials.text[0], "Material #25");
    const uint32_t objects[] = {KTG_NONE, 0, 1, 0}, groups[] = {KTG_NONE, 0, KTG_NONE, 0},
                   materials[] = {KTG_NONE, 0, 1, 1};
    assert_memory_equal(mesh->face_object, objects, sizeof objects);
    assert_memory_equal(mesh->face_group, groups, sizeof groups);
    assert_memory_equal(mesh->face_material, materials, sizeof materials);
    ktg_mesh_free(&mesh);
}

static void names_become_clean_utf8(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj",
                               TRIANGLE "g t\001a\x7f\tb\xc2\x85\nf 1 2 3\ng K\xf6rper\nf 1 2 3\n"
                                        "g \xe5\x9e\x8b\xe7\xb4\x99\nf 1 2 3\ng \x90\xed\xa0\x80\n"
                                        "f 1 2 3\n");
    assert_int_equal(mesh->groups.count, 4);
    assert_string_equal(mesh->groups.text[0], "t_a__b_");
    assert_string_equal(mesh->groups.text[1], "K\xc3\xb6rper");
    assert_string_equal(mesh->groups.text[2], "\xe5\x9e\x8b\xe7\xb4\x99");
    assert_string_equal(mesh->groups.text[3], "_\xc3\xad\xc2\xa0_");
    ktg_mesh_free(&mesh);
}

static void many_names_are_told_apart(void **state) {
    char *text = malloc(200000), *at = text;
    at += sprintf(at, TRIANGLE);
    for (int i = 0; i < 5000; i++)
        at += sprintf(at, "g part%d\nf 1 2 3\n", i * 7 % 3000);
    ktg_mesh *mesh = read_text(*state, "a.obj", text);
    assert_int_equal(mesh->groups.count, 3000);
    for (int i = 0; i < 5000; i++) {
        char name[16];
        sprintf(name, "part%d", i * 7 % 3000);
        assert_string_equal(mesh->groups.text[mesh->face_group[i]], name);
    }
    ktg_mesh_free(&mesh);
    free(text);
}

static void line_elements_become_marked_edges(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.obj", TRIANGLE "f 1 2 3\nl 1 2 3\nl -1/1 -3/1\nvt 0 0\nl 2 2\n");
    const uint32_t marked[] = {0, 1, 1, 2, 2, 0};
    assert_int_equal(mesh->marked_count, 3);
    assert_memory_equal(mesh->marked_edges, marked, sizeof marked);
    ktg_mesh_free(&mesh);
}

static void what_is_not_needed_is_passed_over(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj",
                               "\xef\xbb\xbf# a comment ending in \\\r\n\r\nv 0 0 0 1.0\r\n"
                               "v 1 0 0 0.5 0.5 0.5\r\nv 0 1 0 1 0 0 1 # red\r\n   \r\ns off\r\n"
                               "curv 0 1 \\\r\n 1 2\r\np 1\r\nunknown words\r\n"
                               "  f 1\t2 \\\r\n  3 # up\r\n");
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_corners(mesh, 0, 0, 1, 2);
    assert_point(mesh->positions[1], 1, 0, 0);
    ktg_mesh_free(&mesh);
}

static void lines_may_end_in_carriage_returns_or_not_at_all(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3");
    assert_int_equal(mesh->vertex_count, 3);
    assert_corners(mesh, 0, 0, 1, 2);
    ktg_mesh_free(&mesh);
}

static void numbers_are_the_nearest_doubles(void **state) {
    const char *numbers[] = {"0.1",
                             "-1e-3",
                             "+.5",
                             "5.",
                             "123456789012345678901234567890",
                             "0.12345678901234567",
                             "2.2250738585072011e-308",
                             "1e-400",
                             "9007199254740993",
                             "0.000000000000000000000000000000000000000000001",
                             "3.14159265358979323846264338327950288",
                             "1E22",
                             "1.7976931348623157e+23"};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        char text[256];
        snprintf(text, sizeof text, "v %s 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", numbers[i]);
        ktg_mesh *mesh = read_text(*state, "a.obj", text);
        assert_true(mesh->positions[0].x == strtod(numbers[i], NULL));
        ktg_mesh_free(&mesh);
    }
}

static void the_locale_does_not_matter(void **state) {
    const char *names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "C.UTF-8"};
    for (size_t i = 0; i < 4 && !setlocale(LC_NUMERIC, names[i]); i++)
        ;
    ktg_mesh *mesh = read_text(*state, "a.obj",
                               "v 0.12345678901234567 1.5 0\nv 1 0 0\nv 0 1 0\n"
                               "f 1 2 3\n");
    setlocale(LC_NUMERIC, "C");
    assert_point(mesh->positions[0], 0.12345678901234567, 1.5, 0);
    ktg_mesh_free(&mesh);
}

static void faces_without_area_are_kept(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj", TRIANGLE "f 1 1 2\nf 3 3 3\nf 1 2 2 3 3 1\n");
    assert_int_equal(mesh->face_count, 3);
    assert_corners(mesh, 0, 0, 1, 1);
    assert_corners(mesh, 1, 2, 2, 2);
    assert_corners(mesh, 2, 0, 1, 2);
    ktg_mesh_free(&mesh);
}

static void faulty_lines_are_named(void **state) {
    fixture *f = *state;
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 4\n", KTG_FORMAT, ":4: vertex number 4");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 0\n", KTG_FORMAT, ":4: vertex number 0");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 -4\n", KTG_FORMAT, ":4: vertex number -4");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 99999999999\n", KTG_FORMAT, ":4: vertex number");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 99999999999999999999\n", KTG_FORMAT, ":4: \"9999");
    refuse_text(f, "a.obj", TRIANGLE "f 1/1 2 3\n", KTG_FORMAT, ":4: texture coordinate number 1");
    refuse_text(f, "a.obj", TRIANGLE "f 1/-1 2 3\n", KTG_FORMAT, ":4: texture coordinate");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 x\n", KTG_FORMAT, ":4: \"x\" is not a whole number");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 2.5\n", KTG_FORMAT, ":4: \"2.5\"");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2\n", KTG_FORMAT, ":4: a face needs three corners");
    refuse_text(f, "a.obj", TRIANGLE "f\n", KTG_FORMAT, ":4: a face needs three corners");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 3\nl 1\n", KTG_FORMAT, ":5:");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 3\nl 1 7\n", KTG_FORMAT, ":5: vertex number 7");
    refuse_text(f, "a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\n", KTG_FORMAT, ":2: the z of a vertex");
    refuse_text(f, "a.obj", "v 0 0 0\nv 1 nan 0\n", KTG_FORMAT, ":2: \"nan\"");
    refuse_text(f, "a.obj", "v 0 0 0\n\nv 1 -inf 0\n", KTG_FORMAT, ":3: \"-inf\"");
    refuse_text(f, "a.obj", "v 0 0 1e400\n", KTG_FORMAT, ":1: \"1e400\"");
    refuse_text(f, "a.obj", "v 0 0 1e100\n", KTG_LIMIT, ":1: ");
    refuse_text(f, "a.obj", "v 0 0 0x10\n", KTG_FORMAT, ":1: \"0x10\"");
    refuse_text(f, "a.obj", "v 0 0 1e\n", KTG_FORMAT, ":1: \"1e\"");
    refuse_text(f, "a.obj", "v 0 0 1,5\n", KTG_FORMAT, ":1: \"1,5\"");
    refuse_text(f, "a.obj", "v 0 0 \001\002\n", KTG_FORMAT, ":1: \"??\"");
    refuse_text(f, "a.obj", TRIANGLE "f 1 2 \\\n\n", KTG_FORMAT, ":5: a face needs");
    refuse_text(f, "a.obj", TRIANGLE, KTG_FORMAT, "no faces (3 vertices)");
}

static void a_failing_allocation_leaves_nothing_behind(void **state) {
    static const char text[] = "mtllib a.mtl\n" TRIANGLE "v 2 2 0\nv 0 2 0\nvt 0 0\no x\ng y\n"
                               "usemtl z\nf 1/1 2/1 4/1 5/1 3/1\nl 1 2\n";
    fail_each_allocation(*state, "a.obj", text, sizeof text - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(corners_in_all_their_forms_are_read),
        READ_TEST(texture_coordinates_without_a_use_are_left_out),
        READ_TEST(negative_numbers_count_from_where_they_stand),
        READ_TEST(names_are_kept_as_they_are_written),
        READ_TEST(names_become_clean_utf8),
        READ_TEST(many_names_are_told_apart),
        READ_TEST(line_elements_become_marked_edges),
        READ_TEST(what_is_not_needed_is_passed_over),
        READ_TEST(lines_may_end_in_carriage_returns_or_not_at_all),
        READ_TEST(numbers_are_the_nearest_doubles),
        READ_TEST(the_locale_does_not_matter),
        READ_TEST(faces_without_area_are_kept),
        READ_TEST(faulty_lines_are_named),
        READ_TEST(a_failing_allocation_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
