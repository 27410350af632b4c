/* Writing models, and reading them back. */
#include "read_help.h"

#include <locale.h>

static const char source[] =
    "mtllib colours.mtl\n"
    "v 0.1 -0.12345678901234567 3\nv 1e-300 0 0\nv 0 1 0\n"
    "v 123456789.12345678 0.3333333333333333 -7e70\n"
    "vt 0.1 0.2\nvt 0.5 1\nvt 1 0\nf 1 2 3\no body\ng left arm\nusemtl red\n"
    "f 2/1 3/2 4/3\ng\nf 1 3 4\nl 1 2\nl 3 1\n";

/* Writes `mesh` under `name` into the fixture's folder. */
static ktg_status write_model(fixture *f, const ktg_mesh *mesh, const char *name) {
    ktg_output *output = NULL;
    snprintf(f->path, sizeof f->path, "%s/%s", f->folder, name);
    assert_int_equal(ktg_output_open(f->context, f->path, &output), KTG_OK);
    ktg_status status = ktg_mesh_write(f->context, mesh, KTG_MESH_BY_ENDING, output);
    if (status != KTG_OK) {
        ktg_output_discard(&output);
        return status;
    }
    return ktg_output_commit(f->context, &output);
}

static ktg_mesh *write_and_read(fixture *f, const ktg_mesh *mesh, const char *name) {
    ktg_mesh *again = NULL;
    assert_int_equal(write_model(f, mesh, name), KTG_OK);
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_BY_ENDING, &again), KTG_OK);
    assert_int_equal(unlink(f->path), 0);
    return again;
}

static void assert_same_shape(const ktg_mesh *a, const ktg_mesh *b) {
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_memory_equal(a->positions, b->positions, a->vertex_count * sizeof *a->positions);
    assert_memory_equal(a->faces, b->faces, 3 * a->face_count * sizeof *a->faces);
}

static void assert_same_names(const ktg_names *a, const ktg_names *b) {
    assert_int_equal(a->count, b->count);
    for (uint32_t i = 0; i < a->count; i++)
        assert_string_equal(a->text[i], b->text[i]);
}

static void obj_keeps_everything(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj", source);
    ktg_mesh *again = write_and_read(*state, mesh, "b.obj");
    size_t faces = mesh->face_count * sizeof(uint32_t);
    assert_same_shape(mesh, again);
    assert_same_names(&mesh->objects, &again->objects);
    assert_same_names(&mesh->groups, &again->groups);
    assert_same_names(&mesh->materials, &again->materials);
    assert_memory_equal(mesh->face_object, again->face_object, faces);
    assert_memory_equal(mesh->face_group, again->face_group, faces);
    assert_memory_equal(mesh->face_material, again->face_material, faces);
    assert_string_equal(mesh->material_library, again->material_library);
    assert_int_equal(mesh->uv_count, again->uv_count);
    assert_memory_equal(mesh->uvs, again->uvs, mesh->uv_count * sizeof *mesh->uvs);
    assert_memory_equal(mesh->face_uv, again->face_uv, 3 * faces);
    assert_int_equal(again->marked_count, 2);
    assert_memory_equal(mesh->marked_edges, again->marked_edges, 4 * sizeof(uint32_t));
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&again);
}

static void ply_and_off_keep_positions_and_faces(void **state) {
    const char *names[] = {"b.ply", "b.OFF"};
    ktg_mesh *mesh = read_text(*state, "a.obj", source);
    for (int i = 0; i < 2; i++) {
        ktg_mesh *again = write_and_read(*state, mesh, names[i]);
        assert_same_shape(mesh, again);
        ktg_mesh_free(&again);
    }
    ktg_mesh_free(&mesh);
}

static void stl_keeps_floats_and_the_order_of_corners(void **state) {
    ktg_mesh *mesh = read_text(
        *state, "a.obj", "v 0 0 0\nv 0.1 0 0\nv 0 1e-30 0\nv 0 0 1\nf 1 2 3\nf 3 2 4\nf 1 1 4\n");
    ktg_mesh *again = write_and_read(*state, mesh, "b.stl");
    assert_int_equal(again->vertex_count, 4);
    assert_memory_equal(mesh->faces, again->faces, 6 * sizeof(uint32_t));
    assert_corners(again, 2, 0, 3, 3);
    for (int i = 0; i < 4; i++)
        assert_point(again->positions[i], (float)mesh->positions[i].x, (float)mesh->positions[i].y,
                     (float)mesh->positions[i].z);
    assert_int_equal(write_model(*state, mesh, "b.stl"), KTG_OK);
    FILE *file = fopen(((fixture *)*state)->path, "rb");
    float normal[3] = {9, 9, 9};
    assert_int_equal(fseek(file, 84, SEEK_SET), 0);
    assert_int_equal(fread(normal, sizeof(float), 3, file), 3);
    assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == 1);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    assert_int_equal(ftell(file), 84 + 3 * 50);
    fclose(file);
    assert_int_equal(unlink(((fixture *)*state)->path), 0);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&again);
}

static void what_stl_cannot_hold_is_refused(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = read_text(f, "a.obj", source); /* has a coordinate of -7e70 */
    assert_int_equal(write_model(f, mesh, "b.stl"), KTG_LIMIT);
    assert_non_null(strstr(ktg_context_message(f->context), "too large for STL"));
    ktg_mesh_free(&mesh);
}

static void unknown_endings_are_refused(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = read_text(f, "a.obj", source);
    assert_int_equal(write_model(f, mesh, "b.txt"), KTG_ARGUMENT);
    assert_non_null(strstr(ktg_context_message(f->context), "b.txt"));
    ktg_mesh_free(&mesh);
}

static void a_full_disk_is_told(void **state) {
    fixture *f = *state;
    ktg_output *output = NULL;
    ktg_mesh *mesh = read_text(f, "a.obj", source);
    assert_int_equal(ktg_output_open(f->context, "/dev/full", &output), KTG_OK);
    ktg_status status = ktg_mesh_write(f->context, mesh, KTG_MESH_OBJ, output);
    if (status == KTG_OK)
        status = ktg_output_commit(f->context, &output);
    ktg_output_discard(&output);
    assert_int_equal(status, KTG_FILE);
    ktg_mesh_free(&mesh);
}

static void the_locale_does_not_matter(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj", source);
    const char *names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "C.UTF-8"};
    for (size_t i = 0; i < 4 && !setlocale(LC_NUMERIC, names[i]); i++)
        ;
    ktg_mesh *again = write_and_read(*state, mesh, "b.obj");
    setlocale(LC_NUMERIC, "C");
    assert_same_shape(mesh, again);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&again);
}

static void numbers_are_no_longer_than_needed(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = read_text(f, "a.obj", "v 0.1 2 -0.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    char text[256] = {0};
    assert_int_equal(write_model(f, mesh, "b.off"), KTG_OK);
    FILE *file = fopen(f->path, "rb");
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    assert_int_equal(unlink(f->path), 0);
    assert_string_equal(text, "OFF\n3 1 0\n0.1 2 -0.5\n1 0 0\n0 1 0\n3 0 1 2\n");
    ktg_mesh_free(&mesh);
}

/* Names that came from elsewhere than a file cannot break the lines of one. */
static void names_stay_on_their_line(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = read_text(f, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no abcdef\nf 1 2 3\n");
    memcpy(mesh->objects.text[0], "a\nf 1\\", 6);
    ktg_mesh *again = write_and_read(f, mesh, "b.obj");
    assert_string_equal(again->objects.text[0], "a_f 1_");
    assert_int_equal(again->face_count, 1);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&again);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(obj_keeps_everything),
        READ_TEST(ply_and_off_keep_positions_and_faces),
        READ_TEST(stl_keeps_floats_and_the_order_of_corners),
        READ_TEST(what_stl_cannot_hold_is_refused),
        READ_TEST(unknown_endings_are_refused),
        READ_TEST(a_full_disk_is_told),
        READ_TEST(the_locale_does_not_matter),
        READ_TEST(numbers_are_no_longer_than_needed),
        READ_TEST(names_stay_on_their_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
