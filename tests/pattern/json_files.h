/* tests/pattern/json_files.h - a pattern in which everything appears that the JSON form knows, and
 * its files. */
#ifndef KTG_TESTS_PATTERN_JSON_FILES_H
#define KTG_TESTS_PATTERN_JSON_FILES_H

#include "pattern/pattern.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct fixture {
    ktg_context *context;
    char folder[32], path[64], other[64];
} fixture;

int setup(void **state);
int teardown(void **state);
#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

/* Two triangles in two pieces, joined by one seam; everything the form knows appears. */
ktg_pattern *make_pattern(ktg_context *context);

ktg_status write_to(fixture *f, const ktg_pattern *pattern, const char *path);
void write_bytes(const char *path, const char *bytes, size_t size);
/* The text of a file, to be freed with ktg_free. */
char *slurp(fixture *f, const char *path);
/* The files at f->path and f->other are the same. */
void assert_same_file(fixture *f);

#endif
