/* Reading PLY. */
#include "read_help.h"

#define XYZ     "property double x\nproperty double y\nproperty double z\n"
#define FACES   "property list uchar int vertex_indices\n"
#define ASCII   "ply\nformat ascii 1.0\n"
#define HEAD    ASCII "element vertex 3\n" XYZ "element face 1\n" FACES "end_header\n"
#define CORNERS "0 0 0\n0.12345678901234567 0 0\n0 1 0\n"

static void check(ktg_mesh *mesh) {
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_corners(mesh, 0, 0, 1, 2);
    assert_point(mesh->positions[1], 0.12345678901234567, 0, 0);
    ktg_mesh_free(&mesh);
}

static void ascii_files_are_read(void **state) {
    check(read_text(*state, "a.ply", HEAD CORNERS "3 0 1 2\n"));
    check(read_text(*state, "a.ply", HEAD CORNERS "3 0 1 2")); /* no last line end */
    check(read_text(*state, "a.ply",
                    "ply\ncomment early\nformat ascii 1.0\nelement vertex 3\n" XYZ
                    "element face 1\n" FACES "end_header\n" CORNERS "3 0 1 2\n"));
}

static void properties_and_elements_come_in_any_order(void **state) {
    check(read_text(*state, "a.ply",
                    "ply\r\nformat ascii 1.0\r\ncomment hello\r\nobj_info x\r\n"
                    "element camera 2\r\nproperty float a\r\nproperty list uchar float b\r\n"
                    "element face 1\r\nproperty uchar red\r\n"
                    "property list ushort uint vertex_index\r\nproperty list int float uv\r\n"
                    "element vertex 3\r\nproperty float z\r\nproperty uchar red\r\n"
                    "property float64 x\r\nproperty float nx\r\nproperty int y\r\n"
                    "element nothing 4000000000\r\nend_header\r\n"
                    "1.5 2 0.5 nan\r\n1.5 0\r\n"
                    "255 3 0 1 2 2 0.5 0.5\r\n"
                    "0 9 0 nan 0\r\n0 9 0.12345678901234567 1 0\r\n0 9 0 1 1\r\n"));
}

static void add_head(bytes *b, const char *head) {
    add_text(b, "ply\nformat ");
    add_text(b, b->big ? "binary_big_endian 1.0\n" : "binary_little_endian 1.0\n");
    add_text(b, head);
    add_text(b, "end_header\n");
}

static bytes binary(int big) {
    bytes b = {.big = big};
    add_head(&b, "element vertex 3\nproperty double x\nproperty float y\nproperty short z\n"
                 "property list uint uchar tags\nelement face 1\nproperty list ushort int8 ids\n"
                 "property list uchar uint vertex_indices\nelement edge 1\nproperty int a\n");
    const double x[] = {0, 0.12345678901234567, 0};
    for (int i = 0; i < 3; i++) {
        add_double(&b, x[i]);
        add_float(&b, i == 2);
        add_bits(&b, 0, 2);
        add_bits(&b, (uint64_t)i, 4);
        add_text(&b, i == 0 ? "" : i == 1 ? "x" : "xy");
    }
    add_bits(&b, 1, 2);
    add_bits(&b, 7, 1);
    add_bits(&b, 3, 1);
    for (int i = 0; i < 3; i++)
        add_bits(&b, (uint64_t)i, 4);
    add_bits(&b, 5, 4);
    return b;
}

static void both_binary_orders_are_read(void **state) {
    for (int big = 0; big < 2; big++) {
        bytes b = binary(big);
        ktg_mesh *mesh = NULL;
        assert_int_equal(read_bytes(*state, "a.ply", b.at, b.size, &mesh), KTG_OK);
        check(mesh);
    }
}

static void signed_types_are_read(void **state) {
    for (int big = 0; big < 2; big++) {
        bytes b = {.big = big};
        add_head(&b, "element vertex 3\nproperty char x\nproperty int16 y\nproperty int z\n"
                     "element face 1\nproperty list int8 uint8 vertex_indices\n");
        const int32_t p[9] = {-1, -300, -70000, 0, 0, 0, 1, 2, 3};
        for (int i = 0; i < 9; i++)
            add_bits(&b, (uint32_t)p[i], i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 4);
        add_bits(&b, 0x03020100, 4);
        if (!big) /* the length comes first in either order */
            memcpy(b.at + b.size - 4, "\3\0\1\2", 4);
        ktg_mesh *mesh = NULL;
        assert_int_equal(read_bytes(*state, "a.ply", b.at, b.size, &mesh), KTG_OK);
        assert_corners(mesh, 0, big ? 2 : 0, 1, big ? 0 : 2);
        assert_point(mesh->positions[0], -1, -300, -70000);
        ktg_mesh_free(&mesh);
    }
}

static void a_head_of_carriage_returns_may_be_followed_by_a_newline_byte(void **state) {
    bytes b = {0};
    add_text(&b, "ply\rformat binary_little_endian 1.0\relement face 1\r"
                 "property list char char vertex_indices\relement vertex 11\rproperty char x\r"
                 "property char y\rproperty char z\rend_header\r");
    add_bits(&b, 10, 1); /* the length of the list, and a \n */
    for (int i = 0; i < 10; i++)
        add_bits(&b, (uint64_t)i, 1);
    for (int i = 0; i < 33; i++)
        add_bits(&b, (uint64_t)(i * i % 100), 1);
    ktg_mesh *mesh = NULL;
    assert_int_equal(read_bytes(*state, "a.ply", b.at, b.size, &mesh), KTG_OK);
    assert_int_equal(mesh->vertex_count, 11);
    assert_int_equal(mesh->face_count, 8);
    ktg_mesh_free(&mesh);
}

static void truncated_files_are_refused_at_every_length(void **state) {
    for (int big = 0; big < 2; big++) {
        bytes b = binary(big);
        for (size_t size = 1; size < b.size; size++)
            refuse_bytes(*state, "a.ply", b.at, size, KTG_FORMAT, "a.ply");
    }
    const char *text = HEAD CORNERS "3 0 1 2";
    for (size_t size = 1; size < strlen(text); size++)
        refuse_bytes(*state, "a.ply", text, size, KTG_FORMAT, "a.ply");
}

static void faulty_heads_are_refused(void **state) {
    fixture *f = *state;
#define LIST "element face 1\n" FACES
#define END  "end_header\n" CORNERS "3 0 1 2\n"
    refuse_text(f, "a.ply", "ply\nelement vertex 3\n", KTG_FORMAT, ":2: \"element\"");
    refuse_text(f, "a.ply", "ply\nend_header\n", KTG_FORMAT, ":2: \"end_header\"");
    refuse_text(f, "a.ply", "ply\nformat text 1.0\n", KTG_FORMAT, ":2: \"text\"");
    refuse_text(f, "a.ply", ASCII "element vertex 3\n" XYZ END, KTG_FORMAT, "0 elements \"face\"");
    refuse_text(f, "a.ply", ASCII LIST END, KTG_FORMAT, "0 elements \"vertex\"");
    refuse_text(f, "a.ply", ASCII "element vertex 3\n" XYZ "element vertex 3\n" XYZ LIST END,
                KTG_FORMAT, "2 elements \"vertex\"");
    refuse_text(f, "a.ply", ASCII "element vertex 3\nproperty float x\nproperty float y\n" LIST END,
                KTG_FORMAT, "no x, y and z");
    refuse_text(f, "a.ply", ASCII "element vertex 3\n" XYZ "element face 1\nproperty int a\n" END,
                KTG_FORMAT, "no list vertex_indices");
    refuse_text(f, "a.ply", ASCII "element vertex 3\n" XYZ "property float x\n" LIST END,
                KTG_FORMAT, ":7: a property appears twice");
    refuse_text(f, "a.ply", ASCII "property float x\n", KTG_FORMAT, ":3: a property stands before");
    refuse_text(f, "a.ply", ASCII "element vertex 3\nproperty quad x\n", KTG_FORMAT,
                ":4: \"quad\"");
    refuse_text(f, "a.ply", ASCII "element face 3\nproperty list float int vertex_indices\n",
                KTG_FORMAT, ":4: \"float\"");
    refuse_text(f, "a.ply", ASCII "element face 3\nproperty list int float vertex_indices\n",
                KTG_FORMAT, ":4: vertex numbers");
    refuse_text(f, "a.ply", ASCII "element vertex -3\n", KTG_FORMAT, ":3: -3 elements");
    refuse_text(f, "a.ply", ASCII "element vertex many\n", KTG_FORMAT, ":3: \"many\"");
    refuse_text(f, "a.ply", ASCII "elephant\n", KTG_FORMAT, ":3: \"elephant\"");
    refuse_text(f, "a.ply", ASCII "element vertex 1000000000000\n" XYZ LIST END, KTG_FORMAT,
                "announces 1000000000000 elements \"vertex\"");
    refuse_text(f, "a.ply", ASCII "element vertex 3\n" XYZ "element face 4000000000\n" FACES END,
                KTG_FORMAT, "announces 4000000000 elements \"face\"");
    refuse_text(f, "a.ply", ASCII "element vertex 0\n" XYZ "element face 0\n" FACES "end_header\n",
                KTG_FORMAT, "no faces (0 vertices)");
}

static void faulty_rows_are_named(void **state) {
    fixture *f = *state;
    refuse_text(f, "a.ply", HEAD CORNERS "3 0 1 3\n", KTG_FORMAT, ":13: face 1: vertex number 3");
    refuse_text(f, "a.ply", HEAD CORNERS "3 0 1 -1\n", KTG_FORMAT, ":13: face 1: vertex number -1");
    refuse_text(f, "a.ply", HEAD CORNERS "3 0 1 1.5\n", KTG_FORMAT, ":13: \"1.5\"");
    refuse_text(f, "a.ply", HEAD CORNERS "2 0 1\n", KTG_FORMAT, ":13: face 1: a face needs three");
    refuse_text(f, "a.ply", HEAD CORNERS "-1 0 1\n", KTG_FORMAT,
                ":13: face 1: a list of length -1");
    refuse_text(f, "a.ply", HEAD CORNERS "4000000000 0\n", KTG_FORMAT,
                "a list of length 4000000000");
    refuse_text(f, "a.ply", HEAD CORNERS "3 0 1 2 3\n", KTG_FORMAT,
                ":13: face 1: the line has more");
    refuse_text(f, "a.ply", HEAD CORNERS "3 0 1\n2\n", KTG_FORMAT,
                ":13: the number of a vertex is");
    refuse_text(f, "a.ply", HEAD "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", KTG_FORMAT, ":11: \"nan\"");
    refuse_text(f, "a.ply", HEAD "0 0 0\n1e400 0 0\n0 1 0\n3 0 1 2\n", KTG_FORMAT,
                ":11: \"1e400\"");
    refuse_text(f, "a.ply", HEAD "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", KTG_FORMAT, ":11: a coordinate");
}

static void faulty_binary_values_are_named(void **state) {
    fixture *f = *state;
    bytes b = binary(0);
    size_t body = (size_t)(strstr((char *)b.at, "end_header\n") + 11 - (char *)b.at);
    size_t second = body + 18, list = b.size - 4 - 12 - 1;
    bytes bad = b;
    memcpy(bad.at + second, "\0\0\0\0\0\0\xf0\x7f", 8);
    refuse_bytes(f, "a.ply", bad.at, bad.size, KTG_FORMAT,
                 "vertex 2: a coordinate is not a finite");
    bad = b;
    memset(bad.at + body + 14, 0xff, 4);
    refuse_bytes(f, "a.ply", bad.at, bad.size, KTG_FORMAT, "vertex 1: a list of length 4294967295");
    bad = b;
    bad.at[list] = 200;
    refuse_bytes(f, "a.ply", bad.at, bad.size, KTG_FORMAT, "face 1: a list of length 200");
    bad.at[list] = 0;
    refuse_bytes(f, "a.ply", bad.at, bad.size, KTG_FORMAT, "face 1: a face needs three corners");
    bad = b;
    bad.at[list + 1] = 3;
    refuse_bytes(f, "a.ply", bad.at, bad.size, KTG_FORMAT, "face 1: vertex number 3");
}

static void what_follows_is_told(void **state) {
    fixture *f = *state;
    check(read_text(f, "a.ply", HEAD CORNERS "3 0 1 2\n3 0 1 2\n"));
    assert_non_null(strstr(f->log, "ignored"));
}

static void a_failing_allocation_leaves_nothing_behind(void **state) {
    static const char text[] = HEAD CORNERS "3 0 1 2\n";
    fail_each_allocation(*state, "a.ply", text, sizeof text - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(ascii_files_are_read),
        READ_TEST(properties_and_elements_come_in_any_order),
        READ_TEST(both_binary_orders_are_read),
        READ_TEST(signed_types_are_read),
        READ_TEST(a_head_of_carriage_returns_may_be_followed_by_a_newline_byte),
        READ_TEST(truncated_files_are_refused_at_every_length),
        READ_TEST(faulty_heads_are_refused),
        READ_TEST(faulty_rows_are_named),
        READ_TEST(faulty_binary_values_are_named),
        READ_TEST(what_follows_is_told),
        READ_TEST(a_failing_allocation_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
