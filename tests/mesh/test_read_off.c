/* Reading OFF. */
#include "read_help.h"

#define BODY "0 0 0\n0.12345678901234567 0 0\n0 1 0\n3 0 1 2\n"

static void check(ktg_mesh *mesh) {
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_corners(mesh, 0, 0, 1, 2);
    assert_point(mesh->positions[1], 0.12345678901234567, 0, 0);
    ktg_mesh_free(&mesh);
}

static void heads_in_all_their_forms_are_read(void **state) {
    check(read_text(*state, "a.off", "OFF\n3 1 0\n" BODY));
    check(read_text(*state, "a.OFF", "OFF 3 1 0\n" BODY));
    check(read_text(*state, "a.off", "OFF\r\n3 1\r\n" BODY));
    check(read_text(*state, "a.off", "3 1 0\n" BODY));
    check(
        read_text(*state, "a.off", "# made\n\nOFF # of\n# comments\n3 1 0 # x\n\n" BODY "# end\n"));
}

static void normals_and_colours_are_passed_over(void **state) {
    check(read_text(*state, "a.off",
                    "COFF\n3 1 0\n0 0 0 255 0 0 255\n0.12345678901234567 0 0 0 0 0\n"
                    "0 1 0 0.5 0.5 0.5 1\n3 0 1 2 255 0 0\n"));
    check(
        read_text(*state, "a.off",
                  "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 9 0 0\n0.12345678901234567 0 0 0 0 1 9 9 9 9 "
                  "0 0\n0 1 0 0 0 1 9 9 9 9 0 0\n3 0 1 2\n"));
}

static void what_follows_is_told(void **state) {
    fixture *f = *state;
    check(read_text(f, "a.off", "OFF\n3 1 0\n" BODY "3 0 1 2\n"));
    assert_non_null(strstr(f->log, "a.off:7"));
}

static void faulty_lines_are_named(void **state) {
    fixture *f = *state;
    refuse_text(f, "a.off", "OFF\n", KTG_FORMAT, "truncated");
    refuse_text(f, "a.off", "OFF\n3\n", KTG_FORMAT, ":2: the number of faces");
    refuse_text(f, "a.off", "OFF\n-3 1 0\n" BODY, KTG_FORMAT, ":2: the number of vertices");
    refuse_text(f, "a.off", "OFF\n1000000000 1 0\n" BODY, KTG_FORMAT,
                "announces 1000000000 vertices");
    refuse_text(f, "a.off", "OFF\n3 1000000000 0\n" BODY, KTG_FORMAT, "and 1000000000 faces");
    refuse_text(f, "a.off", "OFF\n99999999999999999999 1 0\n" BODY, KTG_FORMAT, ":2:");
    refuse_text(f, "a.off", "OFF\n5 1 0\n" BODY, KTG_FORMAT, "truncated");
    refuse_text(f, "a.off", "OFF\n3 2 0\n" BODY, KTG_FORMAT, "1 of 2 faces");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1\n3 0 1 2 # pad\n", KTG_FORMAT,
                ":5: the z of a vertex");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", KTG_FORMAT,
                ":4: \"inf\"");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 1e400\n0 1 0\n3 0 1 2\n", KTG_FORMAT, ":4:");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", KTG_FORMAT,
                ":6: vertex number 3, but there are only 3");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", KTG_FORMAT,
                ":6: vertex number -1");
    refuse_text(f, "a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n3 0 1 2\n", KTG_FORMAT,
                ":6: the number of a vertex is missing");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", KTG_FORMAT,
                ":6: a face needs");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n", KTG_FORMAT,
                ":6: a face needs");
    refuse_text(f, "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1\n", KTG_FORMAT, ":6:");
    refuse_text(f, "a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", KTG_FORMAT, "no faces");
    refuse_text(f, "a.off", "OFF BINARY\n3 1 0\n", KTG_FORMAT, "binary OFF");
    refuse_text(f, "a.off", "4OFF\n3 1 0\n", KTG_FORMAT, "dimensions");
    refuse_text(f, "a.off", "# nothing\n", KTG_FORMAT, "truncated");
}

static void a_failing_allocation_leaves_nothing_behind(void **state) {
    static const char text[] = "OFF\n3 1 0\n" BODY;
    fail_each_allocation(*state, "a.off", text, sizeof text - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(heads_in_all_their_forms_are_read),
        READ_TEST(normals_and_colours_are_passed_over),
        READ_TEST(what_follows_is_told),
        READ_TEST(faulty_lines_are_named),
        READ_TEST(a_failing_allocation_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
