/* Files that are written: through links, with what was there before, many at a time. */
#include "core/file.h"
#include "core/memory.h"
#include "core/target.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

/* A context and a folder, from which paths start. */
typedef struct desk {
    ktg_context *context;
    char folder[64], path[512];
} desk;

static int set_up(void **state) {
    desk *d = calloc(1, sizeof *d);
    *state = d;
    strcpy(d->folder, "/tmp/ktg-output-XXXXXX");
    return ktg_context_new(&d->context) != KTG_OK || !mkdtemp(d->folder);
}

static const char *at(desk *d, const char *name) {
    snprintf(d->path, sizeof d->path, "%s/%s", d->folder, name);
    return d->path;
}

static int count_files(desk *d) {
    int count = 0;
    DIR *folder = opendir(d->folder);
    for (struct dirent *entry; (entry = readdir(folder));)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

static int tear_down(void **state) {
    desk *d = *state;
    DIR *folder = opendir(d->folder);
    for (struct dirent *entry; (entry = readdir(folder));)
        if (entry->d_name[0] != '.')
            remove(at(d, entry->d_name));
    closedir(folder);
    int left = rmdir(d->folder);
    ktg_context_free(&d->context);
    free(d);
    return left;
}

static void write_file(desk *d, const char *name, const char *text) {
    ktg_output *output = NULL;
    assert_int_equal(ktg_output_open(d->context, at(d, name), &output), KTG_OK);
    assert_int_equal(ktg_output_write(d->context, output, text, strlen(text)), KTG_OK);
    assert_int_equal(ktg_output_commit(d->context, &output), KTG_OK);
    assert_null(output);
}

static void assert_holds(desk *d, const char *name, const char *text) {
    char *bytes = NULL;
    size_t size;
    assert_int_equal(ktg_file_read(d->context, at(d, name), 1000, &bytes, &size), KTG_OK);
    assert_string_equal(bytes, text);
    ktg_free(bytes);
}

/* ---- where it goes ------------------------------------------------------------------------ */

static void links_lead_to_what_is_written(void **state) {
    desk *d = *state;
    struct stat about;
    char target[256];
    snprintf(target, sizeof target, "%s/new", d->folder);
    assert_int_equal(symlink("b", at(d, "a")), 0);
    assert_int_equal(symlink(target, at(d, "b")), 0);
    write_file(d, "a", "first");
    assert_holds(d, "new", "first");
    write_file(d, "a", "second");
    assert_holds(d, "new", "second");
    assert_int_equal(lstat(at(d, "a"), &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_int_equal(count_files(d), 3);
}

static void links_in_a_ring_are_refused(void **state) {
    desk *d = *state;
    ktg_output *output = NULL;
    assert_int_equal(symlink("b", at(d, "a")), 0);
    assert_int_equal(symlink("a", at(d, "b")), 0);
    assert_int_equal(ktg_output_check(d->context, at(d, "a")), KTG_FILE);
    assert_int_equal(ktg_output_open(d->context, at(d, "a"), &output), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(d->context), "levels of symbolic links"));
}

static void the_same_file_is_known_by_any_path(void **state) {
    desk *d = *state;
    char a[512], b[512];
    write_file(d, "there", "");
    assert_int_equal(symlink("there", at(d, "link")), 0);
    assert_int_equal(symlink("new", at(d, "to-new")), 0);
    strcpy(a, at(d, "there"));
    assert_int_equal(link(a, at(d, "hard")), 0);
    assert_true(ktg_target_same(a, at(d, "link")));
    assert_true(ktg_target_same(a, at(d, "./there")));
    assert_true(ktg_target_same(a, at(d, "hard")));
    assert_false(ktg_target_same(a, at(d, "new")));
    strcpy(b, at(d, "new"));
    assert_true(ktg_target_same(b, at(d, "to-new")));
    assert_true(ktg_target_same(b, at(d, ".//new")));
    assert_false(ktg_target_same(b, at(d, "other")));
    assert_false(ktg_target_same("/dev/null", "/dev/null"));
    assert_true(ktg_target_same("new", "./new"));
}

static void whether_it_can_be_written_is_known_before(void **state) {
    desk *d = *state;
    assert_int_equal(ktg_output_check(d->context, at(d, "new")), KTG_OK);
    assert_int_equal(ktg_output_check(d->context, "-"), KTG_OK);
    assert_int_equal(ktg_output_check(d->context, "/dev/null"), KTG_OK);
    assert_int_equal(ktg_output_check(d->context, at(d, "no/new")), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(d->context), "; make its folder first"));
    assert_int_equal(ktg_output_check(d->context, d->folder), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(d->context), "is a folder"));
    char *path = calloc(6000, 1);
    memset(path, 'x', 5999);
    assert_int_equal(ktg_output_check(d->context, path), KTG_FILE);
    assert_non_null(strstr(ktg_context_message(d->context), "File name too long"));
    assert_true(ktg_target_same(path, path));
    assert_false(ktg_target_same(path, path + 1));
    free(path);
    assert_int_equal(count_files(d), 0);
}

/* ---- what was there ----------------------------------------------------------------------- */

static void permissions_stay(void **state) {
    desk *d = *state;
    static const mode_t modes[] = {0600, 0640, 0777};
    struct stat about;
    write_file(d, "a", "old");
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        assert_int_equal(chmod(at(d, "a"), modes[i]), 0);
        write_file(d, "a", "new");
        assert_int_equal(stat(at(d, "a"), &about), 0);
        assert_int_equal(about.st_mode & 07777, modes[i]);
    }
}

static void what_appears_meanwhile_is_replaced(void **state) {
    desk *d = *state;
    ktg_output *output = NULL;
    assert_int_equal(ktg_output_open(d->context, at(d, "a"), &output), KTG_OK);
    assert_int_equal(ktg_output_write(d->context, output, "ours", 4), KTG_OK);
    write_file(d, "a", "another's");
    assert_int_equal(ktg_output_commit(d->context, &output), KTG_OK);
    assert_holds(d, "a", "ours");
    assert_int_equal(count_files(d), 1);
}

static void a_name_as_long_as_can_be_is_written_again_and_again(void **state) {
    desk *d = *state;
    char name[256] = "";
    memset(name, 'n', 255);
    write_file(d, name, "first");
    write_file(d, name, "second");
    assert_holds(d, name, "second");
    assert_int_equal(count_files(d), 1);
}

/* ---- many, and none ----------------------------------------------------------------------- */

enum { many = 60 }; /* more than are kept without a name */

static void open_many(desk *d, ktg_output **outputs) {
    for (int i = 0; i < many; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d", i);
        assert_int_equal(ktg_output_open(d->context, at(d, name), &outputs[i]), KTG_OK);
        assert_string_equal(ktg_output_path(outputs[i]), d->path);
        assert_string_equal(strrchr(ktg_output_target(outputs[i]), '/') + 1, name);
        assert_int_equal(ktg_output_print(d->context, outputs[i], "%d", i), KTG_OK);
        assert_int_not_equal(access(d->path, F_OK), 0);
    }
}

static void many_are_written_together(void **state) {
    desk *d = *state;
    ktg_output *outputs[many];
    open_many(d, outputs);
    for (int i = 0; i < many; i++)
        assert_int_equal(ktg_output_finish(d->context, outputs[i]), KTG_OK);
    for (int i = 0; i < many; i++)
        assert_int_equal(ktg_output_commit(d->context, &outputs[i]), KTG_OK);
    assert_int_equal(count_files(d), many);
    assert_holds(d, "3", "3");
    assert_holds(d, "59", "59");
}

static void what_is_discarded_leaves_nothing(void **state) {
    desk *d = *state;
    ktg_output *outputs[many], *none = NULL;
    open_many(d, outputs);
    for (int i = 0; i < many; i++) {
        if (i % 2)
            assert_int_equal(ktg_output_finish(d->context, outputs[i]), KTG_OK);
        ktg_output_discard(&outputs[i]);
        assert_null(outputs[i]);
    }
    ktg_output_discard(&none);
    ktg_output_discard(NULL);
    assert_int_equal(count_files(d), 0);
}

static void a_folder_that_went_away_is_told(void **state) {
    desk *d = *state;
    ktg_output *output = NULL;
    assert_int_equal(mkdir(at(d, "sub"), 0755), 0);
    assert_int_equal(ktg_output_open(d->context, at(d, "sub/a"), &output), KTG_OK);
    DIR *folder = opendir(at(d, "sub"));
    for (struct dirent *entry; (entry = readdir(folder));) { /* where files have names at once */
        char name[512];
        snprintf(name, sizeof name, "%s/sub/%.200s", d->folder, entry->d_name);
        if (entry->d_name[0] != '.')
            unlink(name);
    }
    closedir(folder);
    assert_int_equal(rmdir(at(d, "sub")), 0);
    assert_int_equal(ktg_output_commit(d->context, &output), KTG_FILE);
    assert_null(output);
    assert_non_null(strstr(ktg_context_message(d->context), "sub/a: cannot be written: No such"));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(links_lead_to_what_is_written),
        TEST(links_in_a_ring_are_refused),
        TEST(the_same_file_is_known_by_any_path),
        TEST(whether_it_can_be_written_is_known_before),
        TEST(permissions_stay),
        TEST(what_appears_meanwhile_is_replaced),
        TEST(a_name_as_long_as_can_be_is_written_again_and_again),
        TEST(many_are_written_together),
        TEST(what_is_discarded_leaves_nothing),
        TEST(a_folder_that_went_away_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
