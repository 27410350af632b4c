/* Reading STL. */
#include "read_help.h"

static void add_facet(bytes *b, float a, float c) {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, a, c};
    for (int k = 0; k < 3; k++)
        add_float(b, NAN); /* a normal nobody trusts */
    for (int k = 0; k < 9; k++)
        add_float(b, corners[k]);
    add_bits(b, 0xffff, 2);
}

/* Two facets that share an edge and one without area. */
static bytes binary(const char *head) {
    bytes b = {0};
    memset(b.at, ' ', 80);
    memcpy(b.at, head, strlen(head));
    b.size = 80;
    add_bits(&b, 3, 4);
    add_facet(&b, 1, -0.0f);
    add_facet(&b, 0.1f, 1);
    add_facet(&b, 0, 0);
    return b;
}

static void check_binary(const ktg_mesh *mesh) {
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->face_count, 3);
    assert_corners(mesh, 0, 0, 1, 2);
    assert_corners(mesh, 1, 0, 1, 3);
    assert_corners(mesh, 2, 0, 1, 1);
    assert_point(mesh->positions[3], 0, 0.1f, 1);
    assert_null(mesh->face_object);
}

static void binary_facets_are_welded_and_none_is_lost(void **state) {
    const char *heads[] = {"exported", "solid fooled you"};
    for (int i = 0; i < 2; i++) {
        bytes b = binary(heads[i]);
        ktg_mesh *mesh = NULL;
        assert_int_equal(read_bytes(*state, "a.stl", b.at, b.size, &mesh), KTG_OK);
        check_binary(mesh);
        ktg_mesh_free(&mesh);
    }
}

static void bytes_behind_the_last_facet_are_told(void **state) {
    fixture *f = *state;
    bytes b = binary("exported");
    add_text(&b, "more");
    ktg_mesh *mesh = NULL;
    assert_int_equal(read_bytes(f, "a.stl", b.at, b.size, &mesh), KTG_OK);
    check_binary(mesh);
    assert_non_null(strstr(f->log, "4 bytes"));
    ktg_mesh_free(&mesh);
}

static void faulty_binary_files_are_refused(void **state) {
    fixture *f = *state;
    bytes b = binary("exported");
    refuse_bytes(f, "a.stl", b.at, b.size - 1, KTG_FORMAT, "announces 3 facets");
    refuse_bytes(f, "a.stl", b.at, 84, KTG_FORMAT, "truncated");
    refuse_bytes(f, "a.stl", b.at, 83, KTG_FORMAT, "too short");
    memcpy(b.at + 80, "\xff\xff\xff\xff", 4);
    refuse_bytes(f, "a.stl", b.at, b.size, KTG_FORMAT, "announces 4294967295 facets");
    memset(b.at + 80, 0, 4);
    refuse_bytes(f, "a.stl", b.at, 84, KTG_FORMAT, "no faces");
    b = binary("exported");
    memcpy(b.at + 84 + 50 + 12, "\x00\x00\xc0\x7f", 4);
    refuse_bytes(f, "a.stl", b.at, b.size, KTG_FORMAT, "facet 2");
    memcpy(b.at + 84 + 50 + 12, "\x00\x00\x80\xff", 4);
    refuse_bytes(f, "a.stl", b.at, b.size, KTG_FORMAT, "facet 2");
}

#define FACET(a, b, c)                                                                             \
    "facet normal 0 0 nan\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c               \
    "\n endloop\nendfacet\n"

static void ascii_facets_are_welded_as_floats(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.stl",
                  "solid my model\n" FACET("0 0 0", "1 0 0", "0 0.1 0")
                      FACET("0 -0 0", "0 0.1000000001 0", "0 0 1") "endsolid my model\n");
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->face_count, 2);
    assert_corners(mesh, 1, 0, 2, 3);
    assert_point(mesh->positions[2], 0, 0.1, 0); /* not rounded to a float */
    assert_int_equal(mesh->objects.count, 0);
    ktg_mesh_free(&mesh);
}

static void several_solids_become_objects(void **state) {
    ktg_mesh *mesh = read_text(
        *state, "a.STL",
        "SOLID hull\n" FACET("0 0 0", "1 0 0", "0 1 0") "ENDSOLID hull\n"
                                                        "solid mast\n" FACET("0 0 0", "0 0 0",
                                                                             "0 1 1") "endsolid");
    assert_int_equal(mesh->face_count, 2);
    assert_int_equal(mesh->objects.count, 2);
    assert_string_equal(mesh->objects.text[mesh->face_object[1]], "mast");
    ktg_mesh_free(&mesh);
}

static void faulty_ascii_files_are_refused(void **state) {
    fixture *f = *state;
    static const char whole[] = "solid x\n" FACET("0 0 0", "1 0 0", "0 1 0") "endsolid x\n";
    ktg_mesh *mesh = read_text(f, "a.stl", whole);
    ktg_mesh_free(&mesh);
    for (size_t size = 1; size < strlen(whole) - strlen("endsolid x\n") + strlen("endsolid");
         size++)
        refuse_bytes(f, "a.stl", whole, size, KTG_FORMAT, "a.stl");
    refuse_text(f, "a.stl", "solid x\n" FACET("0 0 0", "1 0 0", "0 1 0"), KTG_FORMAT,
                ":9: the file is truncated");
    refuse_text(f, "a.stl", "solid x\nendsolid x\n", KTG_FORMAT, "no faces");
    refuse_text(f, "a.stl", "solid x\n" FACET("0 0 0", "1 nan 0", "0 1 0"), KTG_FORMAT,
                ":5: \"nan\"");
    refuse_text(f, "a.stl", "solid x\n" FACET("0 0 0", "1e39 0 0", "0 1 0"), KTG_FORMAT, ":5: ");
    refuse_text(f, "a.stl", "solid x\n" FACET("0 0 0", "1 0", "0 1 0"), KTG_FORMAT, ":5: the z");
    refuse_text(f, "a.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                "endloop\nendfacet\nendsolid\n",
                KTG_FORMAT, "three corners");
    refuse_text(f, "a.stl", "solid x\nfacet normal 0 0 1\nvertex 0 0 0\n", KTG_FORMAT,
                ":3: \"vertex\" stands where outer");
}

static void many_vertices_are_told_apart(void **state) {
    ktg_mesh *mesh = NULL;
    size_t facets = 20000, size = 84 + 50 * facets;
    unsigned char *data = calloc(1, size);
    memcpy(data + 80, &(uint32_t){(uint32_t)facets}, 4);
    for (size_t i = 0; i < facets; i++) /* a strip: corners (i), (i + 1), (i + 2) on a parabola */
        for (size_t k = 0; k < 3; k++) {
            float p[3] = {(float)(i + k), (float)(i + k) * (float)(i + k), (float)((i + k) % 2)};
            memcpy(data + 84 + 50 * i + 12 + 12 * k, p, 12);
        }
    assert_int_equal(read_bytes(*state, "a.stl", data, size, &mesh), KTG_OK);
    assert_int_equal(mesh->vertex_count, facets + 2);
    for (uint32_t i = 0; i < facets; i++)
        assert_corners(mesh, i, i, i + 1, i + 2);
    ktg_mesh_free(&mesh);
    free(data);
}

static void a_failing_allocation_leaves_nothing_behind(void **state) {
    static const char text[] = "solid x\n" FACET("0 0 0", "1 0 0", "0 1 0") "endsolid x\n";
    fail_each_allocation(*state, "a.stl", text, sizeof text - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(binary_facets_are_welded_and_none_is_lost),
        READ_TEST(bytes_behind_the_last_facet_are_told),
        READ_TEST(faulty_binary_files_are_refused),
        READ_TEST(ascii_facets_are_welded_as_floats),
        READ_TEST(several_solids_become_objects),
        READ_TEST(faulty_ascii_files_are_refused),
        READ_TEST(many_vertices_are_told_apart),
        READ_TEST(a_failing_allocation_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
