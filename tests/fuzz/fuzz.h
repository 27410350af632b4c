/* tests/fuzz/fuzz.h - what the fuzz targets share: bytes as decisions, files, and what must hold.
 *
 * A target is a file with one function, LLVMFuzzerTestOneInput. With clang's libFuzzer (tools/fuzz)
 * it is fed with damaged inputs as long as one likes; with replay.c it becomes an ordinary test
 * that goes through its corpus. What does not hold aborts, with a sentence on standard error. */
#ifndef KTG_TESTS_FUZZ_FUZZ_H
#define KTG_TESTS_FUZZ_FUZZ_H

#include "core/core.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What is left of an input. */
typedef struct fuzz_bytes {
    const uint8_t *at;
    size_t left;
} fuzz_bytes;

/* The next byte; 0 where nothing is left. */
uint8_t fuzz_byte(fuzz_bytes *bytes);

/* A number 0 .. bound - 1 from the next byte; bound at most 256. */
uint32_t fuzz_below(fuzz_bytes *bytes, uint32_t bound);

/* One of the values, by the next byte. */
#define FUZZ_PICK(bytes, type, ...)                                                                \
    (((const type[]){__VA_ARGS__})[fuzz_below(                                                     \
        bytes, (uint32_t)(sizeof((const type[]){__VA_ARGS__}) / sizeof(type)))])

/* Aborts with the sentence where `good` is false. */
void fuzz_expect(bool good, const char *sentence);

/* A context whose callbacks look at what they are given. */
ktg_context *fuzz_context(void);

/* A call may succeed or refuse its input, with a reason; it must not find a defect of the library.
 * True where it succeeded. */
bool fuzz_succeeded(ktg_context *context, ktg_status status);

/* The same of a call that has no reason to refuse. */
void fuzz_must(ktg_context *context, ktg_status status);

/* The path of a file in this process's own folder, which is removed at the end. `name`: its name,
 * with a slash before. */
const char *fuzz_path(const char *name);

/* Puts bytes into such a file; its path. */
const char *fuzz_file(const char *name, const void *bytes, size_t size);

/* The bytes of a file, freed with free(); aborts where there is none. */
char *fuzz_load(const char *path, size_t *size);

/* True where both files hold the same bytes. */
bool fuzz_same(const char *path, const char *other);

#endif
