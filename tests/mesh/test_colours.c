/* Colours of vertices and faces, and a PLY's texture: read, written, and carried along. */
#include "read_help.h"

#include "core/vec.h"

#define OBJ_FACE "f 1 2 3\n"
#define XYZ      "property float x\nproperty float y\nproperty float z\n"
#define RGB(t)   "property " t " red\nproperty " t " green\nproperty " t " blue\n"
#define LIST     "property list uchar int vertex_indices\n"
#define HEAD     "ply\nformat ascii 1.0\n"
#define END      "end_header\n"

static void assert_colour(const uint8_t *colours, size_t at, int red, int green, int blue) {
    assert_non_null(colours);
    if (colours[3 * at] != red || colours[3 * at + 1] != green || colours[3 * at + 2] != blue)
        fail_msg("colour %zu is %d %d %d, not %d %d %d", at, colours[3 * at], colours[3 * at + 1],
                 colours[3 * at + 2], red, green, blue);
}

/* ---- reading -------------------------------------------------------------------------------- */

static void obj_colours_go_to_1_or_to_255(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.obj", "v 0 0 0 1 0 0.5\nv 1 0 0 0.2 -3 1\nv 0 1 0 0 0 0 1\n" OBJ_FACE);
    assert_colour(mesh->vertex_colours, 0, 255, 0, 128);
    assert_colour(mesh->vertex_colours, 1, 51, 0, 255);
    assert_colour(mesh->vertex_colours, 2, 0, 0, 0);
    assert_null(mesh->face_colours);
    ktg_mesh_free(&mesh);
    mesh =
        read_text(*state, "a.obj", "v 0 0 0 1 0 255\nv 1 0 0 12 300 1\nv 0 1 0 0 0 0\n" OBJ_FACE);
    assert_colour(mesh->vertex_colours, 0, 1, 0, 255);
    assert_colour(mesh->vertex_colours, 1, 12, 255, 1);
    ktg_mesh_free(&mesh);
}

static void an_obj_weight_is_no_colour(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj", "v 0 0 0 1\nv 1 0 0 1 # 1 1\nv 0 1 0\n" OBJ_FACE);
    assert_null(mesh->vertex_colours);
    ktg_mesh_free(&mesh);
}

static void what_has_no_colour_among_others_is_white(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.obj", "v 0 0 0\nv 1 0 0 0 0 1\nv 0 1 0\nv 0 0 1\n" OBJ_FACE);
    assert_colour(mesh->vertex_colours, 0, 255, 255, 255);
    assert_colour(mesh->vertex_colours, 1, 0, 0, 255);
    assert_colour(mesh->vertex_colours, 2, 255, 255, 255);
    assert_colour(mesh->vertex_colours, 3, 255, 255, 255);
    ktg_mesh_free(&mesh);
}

static void faulty_colours_are_named(void **state) {
    refuse_text(*state, "a.obj", "v 0 0 0\nv 1 0 0 1 red 0\nv 0 1 0\n" OBJ_FACE, KTG_FORMAT,
                ":2: \"red\"");
    refuse_text(*state, "a.off", "COFF\n3 1 0\n0 0 0 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n",
                KTG_FORMAT, ":3: the blue of a vertex");
    refuse_text(*state, "a.ply",
                HEAD "element vertex 3\n" XYZ RGB(
                    "float") "element face 1\n" LIST END
                             "0 0 0 0 0 0\n1 0 0 0 nan 0\n0 1 0 0 0 0\n3 0 1 2\n",
                KTG_FORMAT, ":14: \"nan\"");
}

static void ply_colours_of_every_type_are_read(void **state) {
#define PLY(type, a, b)                                                                            \
    HEAD "element vertex 3\n" XYZ RGB(type) "property " type " alpha\nelement face 1\n" LIST END   \
                                            "0 0 0 " a " 9\n1 0 0 0 0 0 9\n0 1 0 " b               \
                                            " 9\n3 0 1 2\n"
    const char *files[] = {PLY("uchar", "255 51 0", "1 2 3"),
                           PLY("ushort", "65535 13107 0", "257 514 771"),
                           PLY("float", "1 0.2 0", "0.0039 0.0078 0.0118"),
                           PLY("float", "255 51 0", "1 2 3"), PLY("uchar", "255.0 51 0", "1 2 3")};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        ktg_mesh *mesh = read_text(*state, "a.ply", files[i]);
        assert_colour(mesh->vertex_colours, 0, 255, 51, 0);
        assert_colour(mesh->vertex_colours, 1, 0, 0, 0);
        assert_colour(mesh->vertex_colours, 2, 1, 2, 3);
        ktg_mesh_free(&mesh);
    }
}

static void binary_ply_colours_are_read_in_both_orders(void **state) {
    for (int big = 0; big < 2; big++) {
        bytes b = {.big = big};
        add_text(&b, "ply\nformat ");
        add_text(&b, big ? "binary_big_endian 1.0\n" : "binary_little_endian 1.0\n");
        add_text(&b, "element vertex 3\nproperty ushort diffuse_red\nproperty uchar diffuse_green\n"
                     "property uchar red\n" XYZ
                     "property float diffuse_blue\nelement face 1\n" RGB("uchar") LIST END);
        for (int i = 0; i < 3; i++) {
            add_bits(&b, (uint64_t)i * 257, 2);
            add_bits(&b, 100, 1);
            add_bits(&b, 77, 1); /* "red" comes after "diffuse_red": not taken */
            add_float(&b, i == 1);
            add_float(&b, i == 2);
            add_float(&b, 0);
            add_float(&b, 1);
        }
        for (int i = 0; i < 3; i++)
            add_bits(&b, (uint64_t)(10 * i), 1);
        add_bits(&b, 3, 1);
        for (int i = 0; i < 3; i++)
            add_bits(&b, (uint64_t)i, 4);
        ktg_mesh *mesh = NULL;
        assert_int_equal(read_bytes(*state, "a.ply", b.at, b.size, &mesh), KTG_OK);
        for (int i = 0; i < 3; i++)
            assert_colour(mesh->vertex_colours, (size_t)i, i, 100, 255);
        assert_colour(mesh->face_colours, 0, 0, 10, 20);
        ktg_mesh_free(&mesh);
    }
}

static void all_triangles_of_a_polygon_have_its_colour(void **state) {
    const char *files[] = {
        HEAD "element vertex 5\n" XYZ "element face 2\n" LIST RGB("uchar") END
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3 255 128 0\n3 0 1 4 1 2 3\n",
        "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3 255 128 0 255\n"
        "3 0 1 4 1 2 3 # four\n"};
    for (int i = 0; i < 2; i++) {
        ktg_mesh *mesh = read_text(*state, i == 0 ? "a.ply" : "a.off", files[i]);
        assert_int_equal(mesh->face_count, 3);
        assert_colour(mesh->face_colours, 0, 255, 128, 0);
        assert_colour(mesh->face_colours, 1, 255, 128, 0);
        assert_colour(mesh->face_colours, 2, 1, 2, 3);
        assert_null(mesh->vertex_colours);
        ktg_mesh_free(&mesh);
    }
}

static void off_colours_stand_where_its_word_says(void **state) {
    const char *files[] = {"COFF\n3 1 0\n0 0 0 10 20 30 255\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2 7\n",
                           "CNOFF\n3 1 0\n0 0 0 0 0 1 10 20 30 255\n1 0 0 0 0 1 0 0 0\n"
                           "0 1 0 0 0 1 0 0 0\n3 0 1 2 7 # 1 2 3\n",
                           "NCOFF\n3 1 0\n0 0 0 10 20 30 255 0 0 1\n1 0 0 0 0 0 255 0 0 1\n"
                           "0 1 0 0 0 0 255 0 0 1\n3 0 1 2\n"};
    for (int i = 0; i < 3; i++) {
        ktg_mesh *mesh = read_text(*state, "a.off", files[i]);
        assert_colour(mesh->vertex_colours, 0, 10, 20, 30);
        assert_colour(mesh->vertex_colours, 1, 0, 0, 0);
        assert_null(mesh->face_colours);
        ktg_mesh_free(&mesh);
    }
}

/* ---- a PLY's texture ------------------------------------------------------------------------ */

#define FOUR "0 0 0 0.1 0.2\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n"

static void texture_coordinates_of_ply_vertices_are_read(void **state) {
    const char *names[][2] = {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}};
    for (int i = 0; i < 3; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 HEAD "comment TextureFile my skin.png\nelement vertex 4\n" XYZ
                      "property float %s\nproperty float %s\nelement face 1\n" LIST END FOUR
                      "4 0 1 2 3\n",
                 names[i][0], names[i][1]);
        ktg_mesh *mesh = read_text(*state, "a.ply", text);
        assert_string_equal(mesh->texture_file, "my skin.png");
        assert_int_equal(mesh->uv_count, 4);
        assert_memory_equal(mesh->face_uv, mesh->faces, 6 * sizeof(uint32_t));
        assert_true(mesh->uvs[0].x == 0.1 && mesh->uvs[0].y == 0.2);
        assert_null(mesh->face_material);
        ktg_mesh_free(&mesh);
    }
}

static void texture_coordinates_of_ply_corners_are_read(void **state) {
    ktg_mesh *mesh = read_text(
        *state, "a.ply",
        HEAD "comment TextureFile a.png\ncomment TextureFile b.png\nelement vertex 4\n" XYZ
             "property float s\nproperty float t\nelement face 3\n"
             "property list uchar float texcoord\n" LIST "property int texnumber\n" END FOUR
             "6 0 0 0.5 0 0.5 0.75 3 0 1 2 1\n0 3 0 2 3 0\n6 0 0 1 0 1 1 3 0 2 3 7\n");
    assert_string_equal(mesh->texture_file, "a.png\nb.png");
    assert_int_equal(mesh->uv_count, 6);
    const uint32_t uvs[] = {0, 1, 2, KTG_NONE, KTG_NONE, KTG_NONE, 3, 4, 5};
    assert_memory_equal(mesh->face_uv, uvs, sizeof uvs);
    assert_true(mesh->uvs[2].x == 0.5 && mesh->uvs[2].y == 0.75);
    assert_string_equal(mesh->materials.text[mesh->face_material[0]], "b.png");
    assert_string_equal(mesh->materials.text[mesh->face_material[1]], "a.png");
    assert_int_equal(mesh->face_material[2], KTG_NONE);
    ktg_mesh_free(&mesh);
}

static void memory_may_run_out(void **state) {
    const char *text = HEAD
        "comment TextureFile a.png\ncomment TextureFile b.png\n"
        "element vertex 3\n" XYZ RGB(
            "uchar") "element face 1\n" LIST
                     "property list uchar float texcoord\nproperty int texnumber\n" RGB("uchar") END
        "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n"
        "3 0 1 2 6 0 0 0.5 0 0.5 0.75 1 9 9 9\n";
    fail_each_allocation(*state, "a.ply", text, strlen(text));
    text = "mtllib a\nmtllib b\nv 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\n" OBJ_FACE;
    fail_each_allocation(*state, "a.obj", text, strlen(text));
}

/* ---- writing -------------------------------------------------------------------------------- */

static ktg_mesh *write_and_read(fixture *f, const ktg_mesh *mesh, const char *name) {
    ktg_output *output = NULL;
    ktg_mesh *again = NULL;
    snprintf(f->path, sizeof f->path, "%s/%s", f->folder, name);
    assert_int_equal(ktg_output_open(f->context, f->path, &output), KTG_OK);
    assert_int_equal(ktg_mesh_write(f->context, mesh, KTG_MESH_BY_ENDING, output), KTG_OK);
    assert_int_equal(ktg_output_commit(f->context, &output), KTG_OK);
    assert_int_equal(ktg_mesh_read(f->context, f->path, KTG_MESH_BY_ENDING, &again), KTG_OK);
    assert_int_equal(unlink(f->path), 0);
    return again;
}

static void every_colour_comes_back(void **state) {
    char text[16384] =
        HEAD "element vertex 256\n" XYZ RGB("uchar") "element face 2\n" LIST RGB("uchar") END;
    size_t length = strlen(text);
    for (int i = 0; i < 256; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%d %d 0 %d %d %d\n", i,
                                   i * i, i, 255 - i, i / 2);
    snprintf(text + length, sizeof text - length, "3 0 1 2 8 9 10\n3 5 6 7 11 12 13\n");
    ktg_mesh *mesh = read_text(*state, "a.ply", text);
    const char *names[] = {"b.ply", "b.obj"};
    for (int i = 0; i < 2; i++) {
        ktg_mesh *again = write_and_read(*state, mesh, names[i]);
        assert_int_equal(again->vertex_count, 256);
        assert_memory_equal(again->vertex_colours, mesh->vertex_colours, 768);
        assert_true(i == 1 || !memcmp(again->face_colours, mesh->face_colours, 6));
        ktg_mesh_free(&again);
    }
    ktg_mesh_free(&mesh);
}

static void a_texture_comes_back_as_ply(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.ply",
                  HEAD "comment TextureFile a b.png\ncomment TextureFile c.png\n"
                       "element vertex 3\n" XYZ "element face 4\n" LIST
                       "property list uchar float texcoord\nproperty int texnumber\n" RGB("uchar")
                           END "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0.1 0.2 0.3 0.4 0.5 1 7 8 9\n"
                               "3 1 2 0 0 0 0 0 0\n3 0 2 1 6 1 2 3 4 5 6 0 1 2 3\n"
                               "3 2 1 0 0 1 0 0 0\n");
    ktg_mesh *again = write_and_read(*state, mesh, "b.ply");
    assert_string_equal(again->texture_file, "a b.png\nc.png");
    assert_int_equal(again->uv_count, 6);
    assert_memory_equal(again->uvs, mesh->uvs, 6 * sizeof *mesh->uvs);
    assert_memory_equal(again->face_uv, mesh->face_uv, 12 * sizeof(uint32_t));
    assert_memory_equal(again->face_colours, mesh->face_colours, 12);
    for (uint32_t i = 0; i < 4; i++)
        assert_string_equal(again->materials.text[again->face_material[i]],
                            i % 3 == 0 ? "c.png" : "a b.png");
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&again);
}

/* ---- carrying ------------------------------------------------------------------------------- */

/* A tetrahedron, each face of its own with three vertices, and one vertex too many. */
static const char torn[] =
    HEAD "element vertex 13\n" XYZ RGB("uchar") "element face 4\n" LIST RGB("uchar") END
    "9 9 9 1 1 1\n"
    "0 0 0 10 0 0\n0 1 0 20 0 0\n1 0 0 30 0 0\n"
    "0 0 0 11 0 0\n1 0 0 31 0 0\n0 0 1 40 0 0\n"
    "1 0 0 32 0 0\n0 1 0 21 0 0\n0 0 1 41 0 0\n"
    "0 1 0 22 0 0\n0 0 0 12 0 0\n0 0 1 42 0 0\n"
    "3 1 2 3 1 0 0\n3 4 5 6 2 0 0\n3 7 8 9 3 0 0\n3 10 11 12 4 0 0\n";

static void a_repair_keeps_the_first_colour_of_a_place(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = read_text(f, "a.ply", torn), *copy = NULL;
    assert_int_equal(ktg_mesh_repair(f->context, mesh, NULL), KTG_OK);
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(ktg_mesh_copy(f->context, mesh, &copy), KTG_OK);
    ktg_mesh_free(&mesh);
    for (uint32_t v = 0; v < 4; v++) {
        ktg_vec3 p = copy->positions[v];
        assert_colour(copy->vertex_colours, v,
                      p.y > 0   ? 20
                      : p.x > 0 ? 30
                      : p.z > 0 ? 40
                                : 10,
                      0, 0);
    }
    for (uint32_t i = 0; i < 4; i++)
        assert_colour(copy->face_colours, i, (int)i + 1, 0, 0);
    ktg_mesh_free(&copy);
}

static void what_is_split_or_cut_keeps_its_colour(void **state) {
    fixture *f = *state;
    /* Two triangles that meet in a vertex, and a cap that cuts the second one's edge. */
    ktg_mesh *mesh = read_text(
        f, "a.ply",
        HEAD "element vertex 6\n" XYZ RGB("uchar") "element face 3\n" LIST RGB("uchar") END
        "0 0 0 1 0 0\n1 0 0 2 0 0\n0 1 0 3 0 0\n-2 0 0 4 0 0\n0 -2 0 5 0 0\n-1 -1 0 6 0 0\n"
        "3 0 1 2 7 0 0\n3 0 3 4 8 0 0\n3 4 3 5 9 0 0\n");
    assert_int_equal(ktg_mesh_repair(f->context, mesh, NULL), KTG_OK);
    assert_int_equal(mesh->face_count, 3);
    assert_int_equal(mesh->vertex_count, 7);
    for (uint32_t v = 0; v < 7; v++) {
        ktg_vec3 p = mesh->positions[v];
        int wanted = p.x > 0 ? 2 : p.y > 0 ? 3 : p.x < -1 ? 4 : p.y < -1 ? 5 : p.x < 0 ? 6 : 1;
        assert_colour(mesh->vertex_colours, v, wanted, 0, 0);
    }
    for (uint32_t i = 0; i < 3; i++)
        assert_colour(mesh->face_colours, i, i == 0 ? 7 : 8, 0, 0);
    ktg_mesh_free(&mesh);
}

static void leaving_out_keeps_the_colours_of_the_rest(void **state) {
    fixture *f = *state;
    const char *name = "a";
    ktg_mesh *mesh = read_text(f, "a.obj",
                               "v 9 9 9 0 0 1\nv 0 0 0 0 1 0\nv 1 0 0 1 0 0\nv 0 1 0 1 1 0\n"
                               "g a\nf 1 2 3\ng b\nf 2 3 4\n");
    assert_int_equal(ktg_mesh_omit(f->context, mesh, &name, 1), KTG_OK);
    assert_int_equal(mesh->vertex_count, 3);
    assert_colour(mesh->vertex_colours, 0, 0, 255, 0);
    assert_colour(mesh->vertex_colours, 1, 255, 0, 0);
    assert_colour(mesh->vertex_colours, 2, 255, 255, 0);
    ktg_mesh_free(&mesh);
}

/* A fine plate whose colours say where its vertices are. */
static ktg_mesh *plate(fixture *f, int n) {
    size_t size = 200 * (size_t)(n + 1) * (size_t)(n + 1), length = 0;
    char *text = malloc(size);
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            length += (size_t)snprintf(text + length, size - length, "v %d %d 0 %g %g 0\n", j, i,
                                       255.0 * j / n, 255.0 * i / n);
    for (int i = 0; i < n; i++)
        for (int j = 0, at = (n + 1) * i + 1; j < n; j++, at++)
            length += (size_t)snprintf(text + length, size - length, "f %d %d %d\nf %d %d %d\n", at,
                                       at + 1, at + n + 2, at, at + n + 2, at + n + 1);
    ktg_mesh *mesh = read_text(f, "a.obj", text);
    free(text);
    return mesh;
}

static void colours_follow_a_simplification(void **state) {
    fixture *f = *state;
    ktg_mesh *mesh = plate(f, 24);
    mesh->face_colours = calloc(mesh->face_count, 3);
    for (uint32_t i = 0; i < mesh->face_count; i++)
        mesh->face_colours[3 * i + 2] = i / 2 % 24 < 12 ? 10 : 20;
    assert_int_equal(ktg_mesh_simplify(f->context, mesh, 100, NULL), KTG_OK);
    assert_in_range(mesh->face_count, 4, 100);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        ktg_vec3 p = mesh->positions[v];
        assert_true(fabs(mesh->vertex_colours[3 * v] - 255 * p.x / 24) < 8);
        assert_true(fabs(mesh->vertex_colours[3 * v + 1] - 255 * p.y / 24) < 8);
    }
    for (uint32_t i = 0; i < mesh->face_count; i++) { /* the line between colours is kept to */
        double x = 0;
        for (int k = 0; k < 3; k++)
            x += mesh->positions[mesh->faces[3 * i + (uint32_t)k]].x / 3;
        assert_colour(mesh->face_colours, i, 0, 0, x < 12 ? 10 : 20);
    }
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(obj_colours_go_to_1_or_to_255),
        READ_TEST(an_obj_weight_is_no_colour),
        READ_TEST(what_has_no_colour_among_others_is_white),
        READ_TEST(faulty_colours_are_named),
        READ_TEST(ply_colours_of_every_type_are_read),
        READ_TEST(binary_ply_colours_are_read_in_both_orders),
        READ_TEST(all_triangles_of_a_polygon_have_its_colour),
        READ_TEST(off_colours_stand_where_its_word_says),
        READ_TEST(texture_coordinates_of_ply_vertices_are_read),
        READ_TEST(texture_coordinates_of_ply_corners_are_read),
        READ_TEST(memory_may_run_out),
        READ_TEST(every_colour_comes_back),
        READ_TEST(a_texture_comes_back_as_ply),
        READ_TEST(a_repair_keeps_the_first_colour_of_a_place),
        READ_TEST(what_is_split_or_cut_keeps_its_colour),
        READ_TEST(leaving_out_keeps_the_colours_of_the_rest),
        READ_TEST(colours_follow_a_simplification),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
