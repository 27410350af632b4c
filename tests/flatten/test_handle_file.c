/* Files of handles: what they say, and what they must not. */
#include "tests/flatten/panels.h"
#include "tests/short_memory.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { SIDE = 4, COUNT = (SIDE + 1) * (SIDE + 1) };

static ktg_vec3 square(double u, double v) {
    return (ktg_vec3){100 * u, 100 * v, 0};
}

/* Reads `text` (length bytes) as a file of handles of a square. */
static ktg_status read_text(ktg_context *context, const char *text, size_t length,
                            ktg_handle_list *list) {
    char path[] = "/tmp/katagami-handles-XXXXXX";
    int file = mkstemp(path);
    assert_true(file >= 0 && write(file, text, length) == (ssize_t)length);
    close(file);
    ktg_mesh *mesh = grid_panel(context, square, SIDE);
    ktg_shape *shape;
    assert_int_equal(ktg_shape_register(context, mesh, KTG_WEIGHT_UNIT, &shape), KTG_OK);
    ktg_status status = ktg_handles_read(context, path, shape, list);
    ktg_shape_free(&shape);
    ktg_mesh_free(&mesh);
    unlink(path);
    return status;
}

static bool is_at(ktg_vec2 p, double x, double y) {
    return fabs(p.x - x) < 1e-12 && fabs(p.y - y) < 1e-12;
}

static void every_form_of_line_is_read(void **state) {
    const char *text = "# a comment\n\n vertex 1 -> -3 4.5e0 # behind\r\nat 30 55 -> 35 60\n"
                       "hold vertex 3\nvertex 5 by 10 -5 weight 1000\n\thold at 12 13 weight .5\n"
                       "at 99 99 by 1 1";
    ktg_handle_list list;
    assert_int_equal(read_text(*state, text, strlen(text), &list), KTG_OK);
    assert_int_equal(list.count, 6);
    assert_true(is_at(list.targets[0], -3, 4.5) && is_at(list.targets[1], 35, 60));
    assert_true(is_at(list.targets[2], 50, 0) && is_at(list.targets[3], 110, -5));
    assert_true(is_at(list.targets[4], 12, 13) && is_at(list.targets[5], 100, 100));
    assert_int_equal(list.handles[0].vertices[0], 0);
    assert_int_equal(list.lines[0], 3);
    assert_int_equal(list.lines[5], 8);
    assert_true(list.handles[2].weight == 0 && list.handles[3].weight == 1000 &&
                list.handles[4].weight == 0.5);
    ktg_handle_list_free(&list);
}

static void a_wrong_line_is_told_with_its_number(void **state) {
    static const struct {
        const char *text, *words;
    } wrong[] = {
        {"", "names no handle"},
        {"# nothing\n", "names no handle"},
        {"\nvertx 1 -> 0 0", ":2: wants \"vertex N\" or \"at X Y\", not \"vertx\""},
        {"vertex", ":1: wants the number of a vertex, not \"the end of the line\""},
        {"vertex x -> 0 0", ":1: wants the number of a vertex, not \"x\""},
        {"vertex 0 -> 0 0", ":1: there is no vertex 0; the shape's are 1 to 25"},
        {"vertex 26 -> 0 0", ":1: there is no vertex 26"},
        {"vertex 1.5 -> 0 0", ":1: there is no vertex 1.5"},
        {"vertex -1 -> 0 0", ":1: there is no vertex -1"},
        {"vertex 1e300 -> 0 0", ":1: there is no vertex 1e300"},
        {"vertex 1", ":1: wants \"-> X Y\" or \"by X Y\""},
        {"vertex 1 > 0 0", ":1: wants \"-> X Y\" or \"by X Y\", not \">\""},
        {"vertex 1 -> 0", ":1: wants a coordinate, not \"the end of the line\""},
        {"vertex 1 -> 0 y", ":1: wants a coordinate, not \"y\""},
        {"vertex 1 -> 0 0,5", ":1: wants a coordinate, not \"0,5\""},
        {"vertex 1 -> nan 0", ":1: nan is not a finite number"},
        {"vertex 1 -> 0 -inf", ":1: -inf is not a finite number"},
        {"vertex 1 -> 1e400 0", ":1: 1e400 is not a finite number"},
        {"vertex 1 -> 1e12 0", ":1: 1e12 is more than a million times"},
        {"vertex 1 by 1e12 0", ":1: 1e12 is more than a million times"},
        {"at 130 50 -> 0 0", ":1: (130, 50) is outside the shape"},
        {"at nan 50 -> 0 0", ":1: nan is not a finite number"},
        {"hold vertex 1 -> 0 0", ":1: wants nothing more, not \"->\""},
        {"vertex 1 -> 0 0 0", ":1: wants nothing more, not \"0\""},
        {"vertex 1 -> 0 0 weight", ":1: wants a weight"},
        {"vertex 1 -> 0 0 weight 0", ":1: a weight is above 0"},
        {"vertex 1 -> 0 0 weight -3", ":1: a weight is above 0"},
        {"hold vertex 7\n\nvertex 7 -> 0 0", ":3: is the same point as line 1"},
        {"hold vertex 1\nhold vertex 2\nat 0 0 -> 5 5", ":3: is the same point as line 1"},
        {"vertex 1 -> 0 0 weight 1 a b c d e f g h i", ":1: has too many words"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        ktg_handle_list list;
        ktg_status status = read_text(*state, wrong[k].text, strlen(wrong[k].text), &list);
        if (status != KTG_FORMAT || !strstr(ktg_context_message(*state), wrong[k].words))
            fail_msg("%s: status %d, \"%s\"", wrong[k].text, (int)status,
                     ktg_context_message(*state));
        ktg_handle_list_free(&list);
    }
}

static void bytes_that_are_no_text_are_refused(void **state) {
    ktg_handle_list list;
    assert_int_equal(read_text(*state, "hold vertex 1\0 x", 16, &list), KTG_FORMAT);
    ktg_handle_list_free(&list);
    assert_int_equal(ktg_handles_read(*state, "/tmp/no such file", NULL, &list), KTG_FILE);
}

static void short_memory_is_told(void **state) {
    const char *text = "hold vertex 1\nhold vertex 2\nhold vertex 3\n";
    ktg_context *context = *state;
    ktg_handle_list list;
    ktg_mesh *mesh = grid_panel(context, square, SIDE);
    ktg_shape *shape;
    char path[] = "/tmp/katagami-handles-XXXXXX";
    int file = mkstemp(path);
    assert_true(write(file, text, strlen(text)) > 0);
    close(file);
    assert_int_equal(ktg_shape_register(context, mesh, KTG_WEIGHT_UNIT, &shape), KTG_OK);
    ktg_status status = KTG_MEMORY;
    uint64_t k = 0;
    while (status != KTG_OK) {
        ktg_context_fail_allocation(context, ++k);
        status = ktg_handles_read(context, path, shape, &list);
        end_short_memory(context, status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        ktg_handle_list_free(&list);
    }
    assert_true(k > 4);
    ktg_shape_free(&shape);
    ktg_mesh_free(&mesh);
    unlink(path);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(every_form_of_line_is_read),
        TEST(a_wrong_line_is_told_with_its_number),
        TEST(bytes_that_are_no_text_are_refused),
        TEST(short_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
