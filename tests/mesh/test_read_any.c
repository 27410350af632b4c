/* Reading whatever a path may name: which format it is, and what is not a model at all. */
#include "read_help.h"

#include <fcntl.h>

static const char obj[] = "# x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
static const char off[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
static const char stl[] = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                          "vertex 0 1 0\nendloop\nendfacet\nendsolid x\n";

static void endings_are_known_in_any_case(void **state) {
    (void)state;
    assert_int_equal(ktg_mesh_format_of("a.obj"), KTG_MESH_OBJ);
    assert_int_equal(ktg_mesh_format_of("/x.y/A.STL"), KTG_MESH_STL);
    assert_int_equal(ktg_mesh_format_of("a.b.Ply"), KTG_MESH_PLY);
    assert_int_equal(ktg_mesh_format_of(".off"), KTG_MESH_OFF);
    assert_int_equal(ktg_mesh_format_of("a.obj/b"), KTG_MESH_BY_ENDING);
    assert_int_equal(ktg_mesh_format_of("a.objx"), KTG_MESH_BY_ENDING);
    assert_int_equal(ktg_mesh_format_of("obj"), KTG_MESH_BY_ENDING);
    assert_int_equal(ktg_mesh_format_of("-"), KTG_MESH_BY_ENDING);
    assert_int_equal(ktg_mesh_format_of(""), KTG_MESH_BY_ENDING);
}

static void content_counts_more_than_the_ending(void **state) {
    const char *contents[] = {obj, off, ply, stl};
    const char *names[] = {"a.obj", "a.off", "a.ply", "a.stl", "a", "a.txt"};
    for (int c = 0; c < 4; c++)
        for (int n = 0; n < 6; n++) {
            ktg_mesh *mesh = read_text(*state, names[n], contents[c]);
            assert_int_equal(mesh->vertex_count, 3);
            assert_corners(mesh, 0, 0, 1, 2);
            ktg_mesh_free(&mesh);
        }
}

static void a_named_format_counts_more_than_the_content(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = NULL;
    write_file(f, "a", off, sizeof off - 1);
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_OFF, &mesh), KTG_OK);
    ktg_mesh_free(&mesh);
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_PLY, &mesh), KTG_FORMAT);
    assert_non_null(strstr(ktg_context_message(f->context), ":1: \"OFF\" stands where ply"));
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_OBJ, &mesh), KTG_FORMAT);
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_STL, &mesh), KTG_FORMAT);
    assert_int_equal(ktg_mesh_read(f->context, f->path, (ktg_mesh_format)9, &mesh), KTG_ARGUMENT);
    assert_null(mesh);
    assert_int_equal(unlink(f->path), 0);
}

static void standard_input_is_read(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = NULL;
    write_file(f, "in", ply, sizeof ply - 1);
    int kept = dup(0), file = open(f->path, O_RDONLY);
    assert_int_equal(dup2(file, 0), 0);
    assert_int_equal(ktg_mesh_read(f->context, "-", KTG_MESH_BY_ENDING, &mesh), KTG_OK);
    assert_int_equal(mesh->face_count, 1);
    ktg_mesh_free(&mesh);
    clearerr(stdin);
    assert_int_equal(ktg_mesh_read(f->context, "-", KTG_MESH_BY_ENDING, &mesh), KTG_FORMAT);
    assert_non_null(strstr(ktg_context_message(f->context), "standard input: is empty"));
    dup2(kept, 0);
    close(kept);
    close(file);
    assert_int_equal(unlink(f->path), 0);
}

static void what_is_no_model_is_refused(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = NULL;
    assert_int_equal(ktg_mesh_read(f->context, "/no/such.obj", KTG_MESH_BY_ENDING, &mesh),
                     KTG_FILE);
    assert_non_null(strstr(ktg_context_message(f->context), "/no/such.obj"));
    assert_int_equal(ktg_mesh_read(f->context, f->folder, KTG_MESH_BY_ENDING, &mesh), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(f->context), "folder"));
    refuse_text(f, "a.txt", "Dear reader,\n", KTG_FORMAT, "OBJ, STL, PLY and OFF");
    refuse_text(f, "a", "glTF\002", KTG_FORMAT, "OBJ, STL, PLY and OFF");
    const char *names[] = {"a.obj", "a.off", "a.ply", "a.stl", "a"};
    for (int n = 0; n < 5; n++) {
        refuse_text(f, names[n], "", KTG_FORMAT, "is empty");
        refuse_text(f, names[n], "\xef\xbb\xbf", KTG_FORMAT, names[n]);
        refuse_text(f, names[n], "\n\n\n", KTG_FORMAT, names[n]);
        refuse_text(f, names[n], "Dear reader,\n", KTG_FORMAT, names[n]);
    }
}

static void noise_is_refused_under_every_ending(void **state) {
    const char *names[] = {"a.obj", "a.off", "a.ply", "a.stl", "a"};
    unsigned char noise[3000];
    uint64_t random = 1;
    for (int round = 0; round < 20; round++)
        for (int n = 0; n < 5; n++) {
            for (size_t i = 0; i < sizeof noise; i++)
                noise[i] = (unsigned char)((random = random * 6364136223846793005u + 1) >> 56);
            refuse_bytes(*state, names[n], noise, sizeof noise, KTG_FORMAT, names[n]);
        }
}

static void strange_paths_are_no_harm(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = NULL;
    char path[5001];
    memset(path, 'x', 5000);
    strcpy(path + 4996, ".obj");
    assert_int_equal(ktg_mesh_read(f->context, path, KTG_MESH_BY_ENDING, &mesh), KTG_FILE);
    assert_null(mesh);
    write_file(f, "a\n\033[1mb.obj", "v 0 0 x\n", 8);
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_BY_ENDING, &mesh), KTG_FORMAT);
    assert_non_null(strstr(ktg_context_message(f->context), "a__[1mb.obj:1: \"x\""));
    assert_int_equal(unlink(f->path), 0);
    ktg_mesh *read = read_text(f, "a\n\033[1mb.obj", obj);
    ktg_mesh_free(&read);
}

static ktg_wish stop(void *user) {
    (void)user;
    return KTG_STOP;
}

static void reading_can_be_cancelled(void **state) {
    fixture *f = *state;
    const char *contents[] = {obj, off, ply, stl};
    ktg_context_set_cancel(f->context, stop, NULL);
    for (int c = 0; c < 4; c++) {
        ktg_mesh *mesh = NULL;
        assert_int_equal(read_bytes(f, "a", contents[c], strlen(contents[c]), &mesh),
                         KTG_CANCELLED);
        assert_null(mesh);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(endings_are_known_in_any_case),
        READ_TEST(content_counts_more_than_the_ending),
        READ_TEST(a_named_format_counts_more_than_the_content),
        READ_TEST(standard_input_is_read),
        READ_TEST(what_is_no_model_is_refused),
        READ_TEST(noise_is_refused_under_every_ending),
        READ_TEST(strange_paths_are_no_harm),
        READ_TEST(reading_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
