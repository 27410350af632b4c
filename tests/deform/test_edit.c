/* Edit files: what they select, and what is wrong with them. */
#include "core/vec.h"
#include "shapes.h"
#include "tests/short_memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct desk {
    ktg_context *context;
    ktg_mesh *mesh;
    ktg_edit *edit;
    char model[32], file[32];
} desk;

/* An L of two squares (groups), of two objects, and a triangle apart, which is red. */
static const char model[] = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
                            "v 5 0 0\nv 6 0 0\nv 5 1 0\n"
                            "o ell\ng left \"long name\"\nf 1 2 5\nf 1 5 4\n"
                            "g right both\nf 2 3 6\nf 2 6 5\n"
                            "o tri angle\ng one\nusemtl red\nf 7 8 9\n";

static void write_text(const char *path, const char *text, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static int desk_setup(void **state) {
    desk *d = calloc(1, sizeof *d);
    *state = d;
    if (!d || ktg_context_new(&d->context) != KTG_OK)
        return 1;
    strcpy(d->model, "/tmp/ktg-edit-XXXXXX");
    strcpy(d->file, "/tmp/ktg-edit-XXXXXX");
    int a = mkstemp(d->model), b = mkstemp(d->file);
    write_text(d->model, model, strlen(model));
    ktg_status status = ktg_mesh_read(d->context, d->model, KTG_MESH_OBJ, &d->mesh);
    return close(a) | close(b) | (status != KTG_OK);
}

static int desk_teardown(void **state) {
    desk *d = *state;
    unlink(d->model);
    unlink(d->file);
    ktg_edit_free(&d->edit);
    ktg_mesh_free(&d->mesh);
    ktg_context_free(&d->context);
    free(d);
    return 0;
}

static ktg_status read_bytes(desk *d, const char *text, size_t size) {
    write_text(d->file, text, size);
    ktg_edit_free(&d->edit);
    return ktg_edit_read(d->context, d->file, d->mesh, &d->edit);
}

/* The vertices of the set "s" whose section's lines these are: "1 2 5". */
static void assert_set(desk *d, const char *lines, const char *wanted) {
    char text[1000], found[200] = "";
    snprintf(text, sizeof text,
             "[set s]\n%s\n[set other]\nadd = vertex 2 3\n[fixed f]\nset = all\n", lines);
    if (read_bytes(d, text, strlen(text)) != KTG_OK)
        fail_msg("%s", ktg_context_message(d->context));
    for (uint32_t i = 0; i < d->edit->sets[0].vertex_count; i++)
        sprintf(found + strlen(found), "%s%u", i > 0 ? " " : "", d->edit->sets[0].vertices[i] + 1);
    if (strcmp(found, wanted) != 0)
        fail_msg("%s: %s, not %s", lines, found, wanted);
}

static void selections_select(void **state) {
    desk *d = *state;
    assert_set(d, "add = all", "1 2 3 4 5 6 7 8 9");
    assert_set(d, "add = group left", "1 2 4 5");
    assert_set(d, "add = group both", "2 3 5 6");
    assert_set(d, "add = object ell", "1 2 3 4 5 6");
    assert_set(d, "add = object \"tri angle\"", "7 8 9");
    assert_set(d, "add = material red # the red one", "7 8 9");
    assert_set(d, "add = component ell", "1 2 3 4 5 6");
    assert_set(d, "add = component near 5.4 0.2 0", "7 8 9");
    assert_set(d, "add = boundary near 6 0 0", "7 8 9");
    assert_set(d, "add = boundary", "1 2 3 4 5 6 7 8 9");
    assert_set(d, "add = box 0.5 -1 -1  2 0.5 1", "2 3");
    assert_set(d, "add = sphere 0 0 0  1", "1 2 4");
    assert_set(d, "add = cylinder 0 0 0  3 0 0  0.1", "1 2 3");
    assert_set(d, "add = halfspace 1 0 0  1 0 0", "2 3 5 6 7 8 9");
    assert_set(d, "add = vertex 9 1", "1 9");
    assert_set(d, "add = set other", "2 3");
    assert_set(d, "add=other", "2 3");
    assert_set(d, "add = \"other\"", "2 3");
}

static void statements_are_obeyed_in_order(void **state) {
    desk *d = *state;
    assert_set(d, "add = all\nsub = object ell", "7 8 9");
    assert_set(d, "add = group left\nand = group right", "2 5");
    assert_set(d, "sub = all\nadd = vertex 1\nadd = vertex 3", "1 3");
    assert_set(d, "add = vertex 1\ngrow = 1", "1 2 4 5");
    assert_set(d, "add = vertex 1\ngrow = 2", "1 2 3 4 5 6");
    assert_set(d, "add = vertex 1\ngrow = 1\nshrink = 1", "1 4");
    assert_set(d, "grow = 3\nadd = vertex 1\ngrow = 0", "1");
}

static void sections_become_holds_and_links(void **state) {
    static const char text[] =
        "\xef\xbb\xbf# an edit\r\n[fixed]\r\nset = group left\r\n"
        "[handle \"the end\"]\nset = vertex 3 6\nmove = 1 -2.5e0 +3\nturn = 0 1 0 -400\n"
        "[handle b]\nset=vertex 9\nturn=0 0 1 90\nabout=7 7 7\n"
        "[rigid r]\nset = material red\ntogether = yes\n"
        "[resize s]\nset = object \"tri angle\"\nscale = 1.25\n"
        "[resize t]\nset = object ell\nscale = free\n"
        "[link l]\nfrom = set here\nto = material red\nmax = 4.5\nkind = edge\n"
        "[set here]\nadd = vertex 3\n[solve]\nsteps = 7\nrefine = 3";
    desk *d = *state;
    assert_int_equal(read_bytes(d, text, sizeof text - 1), KTG_OK);
    const ktg_edit *e = d->edit;
    assert_int_equal(e->hold_count, 6);
    assert_int_equal(e->holds[0].kind, KTG_HOLD_FIXED);
    assert_string_equal(e->holds[1].name, "the end");
    assert_int_equal(e->holds[1].line, 4);
    assert_true(e->holds[1].motion.move.y == -2.5 && e->holds[1].motion.move.z == 3);
    assert_true(fabs(e->holds[1].motion.angle + 400 * KTG_PI / 180) < 1e-12);
    assert_true(e->holds[1].motion.centre.x == 2 && e->holds[1].motion.centre.y == 0.5);
    assert_true(e->holds[2].motion.centre.x == 7);
    assert_true(e->holds[3].together && e->holds[3].vertex_count == 3);
    assert_true(e->holds[4].scale == 1.25 && e->holds[5].scale == 0);
    assert_int_equal(e->link_count, 1);
    assert_int_equal(e->links[0].kind, KTG_LINK_EDGE);
    assert_int_equal(e->links[0].from_count, 1);
    assert_true(e->links[0].most == 4.5);
    assert_true(e->steps == 7 && e->refine == 3);
}

/* ---- what is wrong -------------------------------------------------------------------------- */

static void assert_wrong(desk *d, const char *text, unsigned line, const char *said) {
    char where[64];
    assert_int_equal(read_bytes(d, text, strlen(text)), KTG_FORMAT);
    assert_null(d->edit);
    snprintf(where, sizeof where, "%s:%u: ", d->file, line);
    const char *message = ktg_context_message(d->context);
    if (strncmp(message, where, strlen(where)) != 0 || !strstr(message, said))
        fail_msg("%s: \"%s\", not line %u: \"%s\"", text, message, line, said);
}

static void what_is_wrong_is_told_with_its_line(void **state) {
    static const struct {
        const char *text;
        unsigned line;
        const char *said;
    } cases[] = {
        {"set = all", 1, "before the first [section]"},
        {"[fixed f\nset = all", 1, "[kind name]"},
        {"[]\n", 1, "[kind name]"},
        {"[fixed f] set = all", 1, "behind a section's ]"},
        {"[fixed a b]\nset = all", 1, "quotes"},
        {"[fixed \"a]\nset = all", 1, "quote"},
        {"[glue x]", 1, "no section [glue]"},
        {"[solve x]", 1, "[solve] has no name"},
        {"[solve]\n[solve]", 2, "[solve] stands in line 1 already"},
        {"[fixed f]\nset = all\n\n[fixed f]\nset = all", 4, "stands in line 1"},
        {"[fixed f]\nset all", 2, "key = value"},
        {"[fixed f]\nset =", 2, "no value"},
        {"[fixed f]\nset = # all", 2, "no value"},
        {"[fixed f]\n# nothing", 1, "has no \"set\""},
        {"[fixed f]\nset = all\nmove = 1 2 3", 3, "[fixed] has no \"move\": it has set"},
        {"[fixed f]\nset = nobody", 2, "no set \"nobody\""},
        {"[fixed f]\nset = set nobody", 2, "no set \"nobody\""},
        {"[fixed f]\nset = groop left", 2, "\"groop\" selects nothing"},
        {"[fixed f]\nset = group nobody", 2, "no group is called \"nobody\"; there are: left"},
        {"[fixed f]\nset = component nobody", 2, "there are: ell, tri angle"},
        {"[fixed f]\nset = group", 2, "NAME"},
        {"[fixed f]\nset = all of it", 2, "all"},
        {"[fixed f]\nset = sphere 0 0 0", 2, "4 numbers are wanted"},
        {"[fixed f]\nset = sphere 0 0 0 1 2", 2, "5 stand here"},
        {"[fixed f]\nset = sphere 0 0 0 nan", 2, "\"nan\" is not a number"},
        {"[fixed f]\nset = sphere 0 0 0 inf", 2, "\"inf\" is not a number"},
        {"[fixed f]\nset = sphere 0 0 0 0x10", 2, "not a number"},
        {"[fixed f]\nset = sphere 0 0 0 1,5", 2, "not a number"},
        {"[fixed f]\nset = sphere 0 0 0 1e400", 2, "too large"},
        {"[fixed f]\nset = sphere 0 0 0 -1e31", 2, "too large"},
        {"[fixed f]\nset = sphere 0 0 0 --1", 2, "not a number"},
        {"[fixed f]\nset = sphere 90 0 0 1", 1, "its selection is empty"},
        {"[fixed f]\nset = box 1 0 0 0 1 1", 2, "lower corner"},
        {"[fixed f]\nset = cylinder 1 1 1 1 1 1 2", 2, "one point"},
        {"[fixed f]\nset = halfspace 1 1 1 0 0 0", 2, "0 0 0"},
        {"[fixed f]\nset = vertex", 2, "numbers of vertices"},
        {"[fixed f]\nset = vertex 0", 2, "from 1 to 9"},
        {"[fixed f]\nset = vertex 10", 2, "from 1 to 9"},
        {"[fixed f]\nset = vertex 99999999999999999999", 2, "from 1 to 9"},
        {"[fixed f]\nset = vertex 1.5", 2, "from 1 to 9"},
        {"[fixed f]\nset = boundary close 1 2 3", 2, "near X Y Z"},
        {"[fixed f]\nset = boundary near 1 2", 2, "3 numbers are wanted"},
        {"[fixed f]\nset = component near 1 x 3", 2, "\"x\" is not a number"},
        {"[set]\nadd = all", 1, "a set wants a name"},
        {"[set all]\nadd = all", 1, "means a selection"},
        {"[set a]\nadd = all\n[set a]\nadd = all", 3, "in line 1"},
        {"[set a]\nset = all", 2, "a set has no \"set\""},
        {"[set a]\n", 1, "the set \"a\" is empty"},
        {"[set a]\nadd = all\nsub = all", 1, "the set \"a\" is empty"},
        {"[set a]\nadd = a", 2, "made of itself"},
        {"[set a]\nadd = b\n[set b]\nadd = c\n[set c]\nadd = set a", 6,
         "\"a\" (line 1) is made of itself"},
        {"[set a]\nadd = all\ngrow = -1", 3, "whole number"},
        {"[set a]\nadd = all\ngrow = x", 3, "whole number"},
        {"[set a]\nadd = all\ngrow = 1 2", 3, "grow = RINGS"},
        {"[handle h]\nset = all\nturn = 0 0 0 90", 3, "axis"},
        {"[handle h]\nset = all\nturn = 0 0 1 30001", 3, "degrees"},
        {"[handle h]\nset = all\nmove = 1 2", 3, "3 numbers are wanted"},
        {"[handle h]\nset = all\nmove = 1 2 3\nmove = 1 2 3", 4, "stands twice"},
        {"[rigid h]\nset = all\ntogether = perhaps", 3, "yes|no"},
        {"[resize h]\nset = all", 1, "no \"scale\""},
        {"[resize h]\nset = all\nscale = 0", 3, "scale"},
        {"[resize h]\nset = all\nscale = -1", 3, "scale"},
        {"[resize h]\nset = all\nscale = 1e9", 3, "scale"},
        {"[link l]\nfrom = all\nto = all", 1, "no \"max\""},
        {"[link l]\nfrom = all\nmax = 2", 1, "no \"to\""},
        {"[link l]\nfrom = all\nto = all\nmax = -1", 4, "below 0"},
        {"[link l]\nfrom = all\nto = all\nmax = 1\nkind = knot", 5, "auto|vertex|edge|face"},
        {"[solve]\nsteps = 0", 2, "whole number"},
        {"[solve]\nsteps = 1001", 2, "whole number"},
        {"[solve]\nrefine = auto", 2, "whole number"},
        {"[solve]\nspeed = 1", 2, "it has steps, refine"},
        {"[fixed f]\nset = \"all\"", 2, "no set \"all\""},
        {"[fixed f]\nset = group \"left\"x", 2, "blank is missing"},
        {"[fixed f]\nset = a\001b", 2, "no text"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_wrong(*state, cases[i].text, cases[i].line, cases[i].said);
}

static void nothing_that_holds_is_refused(void **state) {
    desk *d = *state;
    assert_int_equal(read_bytes(d, "", 0), KTG_FORMAT);
    assert_non_null(strstr(ktg_context_message(d->context), "nothing is [fixed]"));
    assert_int_equal(read_bytes(d, "[rigid r]\nset = all\n", 20), KTG_FORMAT);
}

static void bytes_that_are_no_text_are_refused(void **state) {
    desk *d = *state;
    assert_int_equal(read_bytes(d, "[fixed f]\nset = a\0ll\n", 21), KTG_FORMAT);
    char noise[5000];
    uint32_t random = 1;
    for (int round = 0; round < 50; round++) {
        for (size_t i = 0; i < sizeof noise; i++)
            noise[i] = (char)((random = random * 1664525 + 1013904223) >> 24);
        assert_int_equal(read_bytes(d, noise, sizeof noise), KTG_FORMAT);
    }
    unlink(d->file);
    assert_int_equal(ktg_edit_read(d->context, d->file, d->mesh, &d->edit), KTG_FILE);
}

/* A good file with one byte after another changed: read or refused, never more. */
static void damaged_files_are_read_or_refused(void **state) {
    static const char good[] = "[set a]\nadd = group left\ngrow = 1\n[fixed f]\nset = a\n"
                               "[handle h]\nset = vertex 9\nturn = 0 0 1 30\n[solve]\nsteps = 2\n";
    static const char bytes[] = {0, ' ', '\n', '"', '[', ']', '=', '#', '9', '-', 'a', (char)0xff};
    desk *d = *state;
    char text[sizeof good];
    for (size_t i = 0; i < sizeof good - 1; i++)
        for (size_t b = 0; b < sizeof bytes; b++) {
            memcpy(text, good, sizeof good);
            text[i] = bytes[b];
            ktg_status status = read_bytes(d, text, sizeof good - 1);
            assert_true(status == KTG_OK || status == KTG_FORMAT);
            assert_true((status == KTG_OK) == (d->edit != NULL));
        }
}

static void too_many_sections_or_nested_sets_are_refused(void **state) {
    desk *d = *state;
    size_t size = 200000, length = 0;
    char *text = malloc(size);
    assert_non_null(text);
    for (int i = 0; i < 100; i++)
        length += (size_t)sprintf(text + length, "[set s%d]\nadd = s%d\n", i, i + 1);
    length += (size_t)sprintf(text + length, "[set s100]\nadd = all\n");
    assert_int_equal(read_bytes(d, text, length), KTG_FORMAT);
    assert_non_null(strstr(ktg_context_message(d->context), "64 deep"));
    length = 0;
    for (int i = 0; i < 5000; i++)
        length += (size_t)sprintf(text + length, "[fixed f%d]\nset = all\n", i);
    assert_int_equal(read_bytes(d, text, length), KTG_FORMAT);
    assert_non_null(strstr(ktg_context_message(d->context), "at most 2000 sections"));
    free(text);
}

/* ---- the selections as a model -------------------------------------------------------------- */

static void selections_are_written_as_groups(void **state) {
    static const char text[] = "[set \"a b\"]\nadd = group left\n[fixed f]\nset = vertex 2 3\n"
                               "[handle h]\nset = vertex 9\n"
                               "[link l]\nfrom = vertex 8\nto = vertex 3\nmax = 5\n";
    static const char *const wanted[] = {"g rest\nf 2 3 6\n",    "g set-a_b\nf 1 2 5\nf 1 5 4\n",
                                         "g fixed-f\nl 2 3\n",   "g handle-h\np 9\n",
                                         "g link-l-from\np 8\n", "g link-l-to\np 3\n"};
    desk *d = *state;
    char found[2000] = "";
    ktg_output *output = NULL;
    assert_int_equal(read_bytes(d, text, sizeof text - 1), KTG_OK);
    assert_int_equal(ktg_output_open(d->context, d->model, &output), KTG_OK);
    assert_int_equal(ktg_edit_write_sets(d->context, d->edit, d->mesh, output), KTG_OK);
    assert_int_equal(ktg_output_commit(d->context, &output), KTG_OK);
    FILE *file = fopen(d->model, "rb");
    assert_non_null(file);
    size_t length = fread(found, 1, sizeof found - 1, file);
    fclose(file);
    found[length] = 0;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!strstr(found, wanted[i]))
            fail_msg("%s lacks %s", found, wanted[i]);
    ktg_mesh_free(&d->mesh);
    assert_int_equal(ktg_mesh_read(d->context, d->model, KTG_MESH_OBJ, &d->mesh), KTG_OK);
}

static void all_else_of_a_mesh_survives(void **state) {
    static const char text[] = "[fixed f]\nset = vertex 1 4\n[handle h]\nset = vertex 3 6\n"
                               "turn = 1 0 0 40\n[fixed g]\nset = material red\n";
    desk *d = *state;
    ktg_mesh *before = NULL;
    ktg_deform_report report;
    assert_int_equal(read_bytes(d, text, sizeof text - 1), KTG_OK);
    assert_int_equal(ktg_mesh_copy(d->context, d->mesh, &before), KTG_OK);
    assert_int_equal(ktg_deform_mesh(d->context, d->mesh, d->edit, &report), KTG_OK);
    assert_int_equal(d->mesh->vertex_count, before->vertex_count);
    assert_memory_equal(d->mesh->faces, before->faces, 3 * before->face_count * sizeof(uint32_t));
    assert_memory_equal(d->mesh->face_group, before->face_group,
                        before->face_count * sizeof(uint32_t));
    assert_string_equal(d->mesh->materials.text[0], "red");
    assert_true(d->mesh->positions[5].z != before->positions[5].z);
    assert_true(report.components == 2 && report.moved > 0.1);
    ktg_mesh_free(&before);
}

/* ---- memory --------------------------------------------------------------------------------- */

static ktg_status whole(desk *d) {
    ktg_edit *edit = NULL;
    ktg_mesh *copy = NULL;
    ktg_output *output = NULL;
    ktg_status status = ktg_edit_read(d->context, d->file, d->mesh, &edit);
    if (status == KTG_OK)
        status = ktg_mesh_copy(d->context, d->mesh, &copy);
    if (status == KTG_OK)
        status = ktg_deform_mesh(d->context, copy, edit, NULL);
    if (status == KTG_OK)
        status = ktg_output_open(d->context, "/dev/null", &output);
    if (status == KTG_OK)
        status = ktg_edit_write_sets(d->context, edit, d->mesh, output);
    ktg_output_discard(&output);
    ktg_edit_free(&edit);
    ktg_mesh_free(&copy);
    return status;
}

static void memory_that_runs_out_is_told(void **state) {
    static const char text[] =
        "[set s]\nadd = boundary near 0 0 0\nand = component ell\nshrink = 0\ngrow = 1\n"
        "[fixed f]\nset = vertex 1 4\n[handle h]\nset = vertex 3\nturn = 1 0 0 50\n"
        "[rigid r]\nset = vertex 7 8\n[resize z]\nset = vertex 7 8\nscale = 1.2\n"
        "[link l]\nfrom = material red\nto = object ell\nmax = 4.2\n"
        "[link m]\nfrom = vertex 9\nto = object ell\nmax = 4.2\nkind = face\n[solve]\nrefine = 1\n";
    desk *d = *state;
    write_text(d->file, text, sizeof text - 1);
    ktg_status status = KTG_MEMORY;
    uint64_t failures = 0;
    for (uint64_t k = 1; status != KTG_OK; k++, failures++) {
        ktg_context_fail_allocation(d->context, k);
        status = whole(d);
        end_short_memory(d->context, status);
        if (status != KTG_OK && status != KTG_MEMORY)
            fail_msg("allocation %llu: %s", (unsigned long long)k, ktg_context_message(d->context));
    }
    print_message("# %llu allocations\n", (unsigned long long)failures);
    assert_true(failures > 100);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, desk_setup, desk_teardown)
    const struct CMUnitTest tests[] = {
        TEST(selections_select),
        TEST(statements_are_obeyed_in_order),
        TEST(sections_become_holds_and_links),
        TEST(what_is_wrong_is_told_with_its_line),
        TEST(nothing_that_holds_is_refused),
        TEST(bytes_that_are_no_text_are_refused),
        TEST(damaged_files_are_read_or_refused),
        TEST(too_many_sections_or_nested_sets_are_refused),
        TEST(selections_are_written_as_groups),
        TEST(all_else_of_a_mesh_survives),
        TEST(memory_that_runs_out_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
