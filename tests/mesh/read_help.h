/* tests/mesh/read_help.h - model files made by a test and read by the library. */
#ifndef KTG_TESTS_MESH_READ_HELP_H
#define KTG_TESTS_MESH_READ_HELP_H

#include "mesh/mesh.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct fixture {
    ktg_context *context;
    char folder[32], path[512];
    char log[256]; /* the last line logged */
} fixture;

static inline void keep_log(void *user, ktg_log_level level, const char *text) {
    (void)level;
    snprintf(((fixture *)user)->log, sizeof((fixture *)user)->log, "%s", text);
}

static inline int make_fixture(void **state) {
    fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/ktg-read-XXXXXX");
    *state = f;
    if (!mkdtemp(f->folder) || ktg_context_new(&f->context) != KTG_OK)
        return 1;
    ktg_context_set_log(f->context, keep_log, f);
    return 0;
}

static inline int drop_fixture(void **state) {
    fixture *f = *state;
    ktg_context_free(&f->context);
    int left = rmdir(f->folder);
    free(f);
    return left;
}

static inline void write_file(fixture *f, const char *name, const void *bytes, size_t size) {
    snprintf(f->path, sizeof f->path, "%s/%s", f->folder, name);
    FILE *file = fopen(f->path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Writes a file, reads it as a model and removes it. */
static inline ktg_status read_bytes(fixture *f, const char *name, const void *bytes, size_t size,
                                    ktg_mesh **mesh) {
    write_file(f, name, bytes, size);
    ktg_status status = ktg_mesh_read(f->context, f->path, KTG_MESH_BY_ENDING, mesh);
    assert_int_equal(unlink(f->path), 0);
    return status;
}

/* A file that must be readable. */
static inline ktg_mesh *read_text(fixture *f, const char *name, const char *text) {
    ktg_mesh *mesh = NULL;
    ktg_status status = read_bytes(f, name, text, strlen(text), &mesh);
    if (status != KTG_OK)
        fail_msg("%s", ktg_context_message(f->context));
    assert_non_null(mesh);
    return mesh;
}

/* A file that must be refused with a message that names the file and holds `part`. */
static inline void refuse_bytes(fixture *f, const char *name, const void *bytes, size_t size,
                                ktg_status wanted, const char *part) {
    ktg_mesh *mesh = NULL;
    ktg_status status = read_bytes(f, name, bytes, size, &mesh);
    const char *message = ktg_context_message(f->context);
    assert_null(mesh);
    if (status != wanted || !strstr(message, part) || !strstr(message, f->path))
        fail_msg("%.60s\ngave %s: %s", (const char *)bytes, ktg_status_name(status), message);
}

static inline void refuse_text(fixture *f, const char *name, const char *text, ktg_status wanted,
                               const char *part) {
    refuse_bytes(f, name, text, strlen(text), wanted, part);
}

static inline void assert_corners(const ktg_mesh *mesh, uint32_t face, uint32_t a, uint32_t b,
                                  uint32_t c) {
    assert_true(face < mesh->face_count);
    assert_int_equal(mesh->faces[3 * face], a);
    assert_int_equal(mesh->faces[3 * face + 1], b);
    assert_int_equal(mesh->faces[3 * face + 2], c);
}

static inline void assert_point(ktg_vec3 p, double x, double y, double z) {
    assert_true(p.x == x && p.y == y && p.z == z);
}

/* Bytes put together, least byte first unless `big`. */
typedef struct bytes {
    unsigned char at[1024];
    size_t size;
    int big;
} bytes;

static inline void add_text(bytes *b, const char *text) {
    memcpy(b->at + b->size, text, strlen(text));
    b->size += strlen(text);
}

static inline void add_bits(bytes *b, uint64_t bits, int size) {
    for (int i = 0; i < size; i++)
        b->at[b->size++] = (unsigned char)(bits >> 8 * (b->big ? size - 1 - i : i));
}

static inline void add_float(bytes *b, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_bits(b, bits, 4);
}

static inline void add_double(bytes *b, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_bits(b, bits, 8);
}

/* Reads the file again and again, each time with another allocation failing, until it succeeds. */
static inline void fail_each_allocation(fixture *f, const char *name, const void *data,
                                        size_t size) {
    ktg_status status = KTG_MEMORY;
    ktg_mesh *mesh = NULL;
    for (uint64_t nth = 1; status != KTG_OK && nth < 1000; nth++) {
        ktg_context_fail_allocation(f->context, nth);
        status = read_bytes(f, name, data, size, &mesh);
        assert_true(status == KTG_OK ? mesh != NULL : status == KTG_MEMORY && mesh == NULL);
    }
    end_short_memory(f->context, status);
    assert_int_equal(status, KTG_OK);
    ktg_mesh_free(&mesh);
}

#define READ_TEST(name) cmocka_unit_test_setup_teardown(name, make_fixture, drop_fixture)

#endif
