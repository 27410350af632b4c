/* Files that name edges: text, OBJ `l` elements, and what is wrong with them. */
#include "read_help.h"
#include "tests/short_memory.h"

/* A square of four triangles around its middle (5), and a loose square whose vertices 7 and 10
 * coincide with 2 and 3. */
static const char model_text[] = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0.5\nv 9 9 9\n"
                                 "v 2 0 0\nv 4 0 0\nv 4 2 0\nv 2 2 0\n"
                                 "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 7 8 9 10\n";

static ktg_status read_edges(fixture *f, const char *name, const void *content, size_t size,
                             ktg_edge_list *list) {
    ktg_mesh *mesh = read_text(f, "model.obj", model_text);
    write_file(f, name, content, size);
    ktg_status status = ktg_mesh_read_edges(f->context, f->path, mesh, list);
    assert_int_equal(unlink(f->path), 0);
    ktg_mesh_free(&mesh);
    return status;
}

/* The file names these edges (1-based pairs, ended by 0), the first one in the given line. */
static void expect(void **state, const char *name, const char *text, const uint32_t *pairs,
                   uint64_t first_line) {
    fixture *f = *state;
    ktg_edge_list list;
    ktg_status status = read_edges(f, name, text, strlen(text), &list);
    if (status != KTG_OK)
        fail_msg("%s\n%s", text, ktg_context_message(f->context));
    uint32_t count = 0;
    for (; pairs[2 * count]; count++) {
        assert_true(count < list.count);
        assert_int_equal(list.vertices[2 * count] + 1, pairs[2 * count]);
        assert_int_equal(list.vertices[2 * count + 1] + 1, pairs[2 * count + 1]);
    }
    assert_int_equal(list.count, count);
    assert_int_equal(list.lines[0], first_line);
    assert_string_equal(list.file, f->path);
    ktg_edge_list_free(&list);
    ktg_edge_list_free(&list);
}

static void refuse_size(void **state, const char *name, const void *content, size_t size,
                        const char *part) {
    fixture *f = *state;
    ktg_edge_list list;
    ktg_status status = read_edges(f, name, content, size, &list);
    const char *message = ktg_context_message(f->context);
    if (status != KTG_FORMAT || !strstr(message, part) || !strstr(message, f->path))
        fail_msg("%.60s\ngave %s: %s", (const char *)content, ktg_status_name(status), message);
    assert_int_equal(list.count, 0);
    assert_null(list.vertices);
}

static void refuse(void **state, const char *name, const char *text, const char *part) {
    refuse_size(state, name, text, strlen(text), part);
}

static void lines_of_numbers_are_paths(void **state) {
    expect(state, "a.txt", "1 5\n", (const uint32_t[]){1, 5, 0}, 1);
    expect(state, "a.txt", "# cut here\n\n 1 5 3\t2 # on\r\n5 1",
           (const uint32_t[]){1, 5, 5, 3, 3, 2, 5, 1, 0}, 3);
    expect(state, "a", "\xef\xbb\xbf+1 5", (const uint32_t[]){1, 5, 0}, 1);
    expect(state, "a.txt", "7 3\r2 10\r", (const uint32_t[]){7, 3, 2, 10, 0}, 1); /* welded */
}

static void line_elements_without_vertices_name_those_of_the_model(void **state) {
    expect(state, "a.obj", "# seams\nl 1 5 3\n", (const uint32_t[]){1, 5, 5, 3, 0}, 2);
    expect(state, "a.txt", "o seams\ng x\nl 1/7 5/2/\n", (const uint32_t[]){1, 5, 0}, 3);
    expect(state, "a.obj", "l -10 \\\n -6\n", (const uint32_t[]){1, 5, 0}, 2);
}

static void line_elements_with_vertices_go_by_position(void **state) {
    expect(state, "a.obj", "v 1 1 0.5\nv 0 0 0\nl 2 1\n", (const uint32_t[]){1, 5, 0}, 3);
    expect(state, "a.obj", "l 1 2\nv 1.000004 1 0.5\nv 0 -1e-6 0\n", (const uint32_t[]){5, 1, 0},
           1);
    expect(state, "a.obj", "v 2 2 0\nv 4 2 0\nl -1 -2\n", (const uint32_t[]){9, 3, 0}, 3);
    expect(state, "m.obj",
           "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0.5\nf 1 2 5\nl 3 5 1\nf 2 3 5\n",
           (const uint32_t[]){3, 5, 5, 1, 0}, 7);
}

static void what_is_wrong_is_named_with_its_line(void **state) {
    refuse(state, "a.txt", "1 5\nx 3\n", "a.txt:2: \"x\" is not a whole number");
    refuse(state, "a.txt", "1 5.5\n", "a.txt:1: \"5.5\" is not a whole number");
    refuse(state, "a.txt", "1,5\n", "a.txt:1: ");
    refuse(state, "a.txt", "1 5\n0 1\n",
           "a.txt:2: vertex number 0, but the model's vertices are "
           "numbered 1 to 10");
    refuse(state, "a.txt", "1 11\n", "vertex number 11");
    refuse(state, "a.txt", "-1 5\n", "vertex number -1");
    refuse(state, "a.txt", "1 99999999999999999999999\n", "of a size that makes sense");
    refuse(state, "a.txt", "1 4294967297\n", "vertex number 4294967297");
    refuse(state, "a.txt", "5\n", "a.txt:1: one vertex is no edge");
    refuse(state, "a.txt", "1 3\n", "a.txt:1: vertices 1 and 3 of the model have no edge");
    refuse(state, "a.txt", "1 1\n", "have no edge");
    refuse(state, "a.txt", "1 6\n", "vertices 1 and 6 of the model have no edge");
    refuse(state, "a.txt", "", "names no edges");
    refuse(state, "a.txt", "# nothing\n\n", "names no edges");
    refuse(state, "a.obj", "v 0 0 0\nf 1 2 3\n", "names no edges");
    refuse(state, "a.obj", "1 5\n", "names no edges");
    refuse(state, "a.obj", "l 1\n", "a.obj:1: one vertex is no edge");
    refuse(state, "a.obj", "l\n", "a.obj:1: the number of a vertex is missing");
    refuse(state, "a.obj", "l 1 11\n", "a.obj:1: vertex number 11");
    refuse(state, "a.obj", "l 1 -11\n", "vertex number -11");
    refuse(state, "a.obj", "v 0 0 0\nl 1 2\n", "vertex number 2, but the file has only 1");
    refuse(state, "a.obj", "v 0 0 0\nl 1 -2\n", "vertex number -2");
    refuse(state, "a.obj", "v 0 0 0\nv 0.1 0 0\n\nl 1 2\n",
           "a.obj:4: vertex number 2 of this file lies at (0.1, 0, 0), where the model has none");
    refuse(state, "a.obj", "v 0 0 x\nl 1 2\n", "a.obj:1: \"x\" is not a finite number");
    refuse(state, "a.obj", "v 0 0 nan\nl 1 2\n", "a.obj:1: ");
    refuse_size(state, "a.txt", "1 5\n\0\0", 6, "holds binary data");
}

static void noise_is_refused(void **state) {
    char noise[512];
    uint32_t x = 1;
    for (int round = 0; round < 200; round++) {
        for (size_t i = 0; i < sizeof noise; i++) {
            x = x * 1664525 + 1013904223;
            noise[i] = round % 2 ? (char)(x >> 24) : "0123 -l#v\n/\\.e+"[(x >> 24) % 16];
        }
        ktg_edge_list list;
        ktg_status status =
            read_edges(*state, round % 3 ? "a.txt" : "a.obj", noise, sizeof noise, &list);
        assert_true(status == KTG_FORMAT || status == KTG_OK || status == KTG_LIMIT);
        if (status == KTG_OK)
            ktg_edge_list_free(&list);
    }
}

static void a_file_that_is_not_there_is_named(void **state) {
    fixture *f = *state;
    ktg_edge_list list;
    ktg_mesh *mesh = read_text(f, "model.obj", model_text);
    assert_int_equal(ktg_mesh_read_edges(f->context, "/nowhere/edges.txt", mesh, &list), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(f->context), "/nowhere/edges.txt"));
    assert_int_equal(ktg_mesh_read_edges(f->context, f->folder, mesh, &list), KTG_FILE);
    ktg_mesh_free(&mesh);
}

static void memory_may_run_out_anywhere(void **state) {
    fixture *f = *state;
    const char *text = "v 1 1 0.5\nv 0 0 0\nl 2 1\n";
    ktg_mesh *mesh = read_text(f, "model.obj", model_text);
    write_file(f, "a.obj", text, strlen(text));
    ktg_status status = KTG_MEMORY;
    ktg_edge_list list;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_context_fail_allocation(f->context, ++nth);
        status = ktg_mesh_read_edges(f->context, f->path, mesh, &list);
    }
    end_short_memory(f->context, status);
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 5);
    assert_int_equal(unlink(f->path), 0);
    ktg_edge_list_free(&list);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(lines_of_numbers_are_paths),
        READ_TEST(line_elements_without_vertices_name_those_of_the_model),
        READ_TEST(line_elements_with_vertices_go_by_position),
        READ_TEST(what_is_wrong_is_named_with_its_line),
        READ_TEST(noise_is_refused),
        READ_TEST(a_file_that_is_not_there_is_named),
        READ_TEST(memory_may_run_out_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
