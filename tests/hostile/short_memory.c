/* tests/hostile/short_memory.c - preloaded into the program: the process's FAIL_AT-th request for
 * memory fails, whoever makes it (C++, CHOLMOD and jansson too); COUNT_INTO gets how many there
 * were. glibc only. */
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *memory, size_t size);

static atomic_long requests;

static int must_fail(void) {
    static atomic_long fail_at = -1; /* not asked for yet */
    if (atomic_load(&fail_at) < 0) {
        const char *text = getenv("FAIL_AT");
        atomic_store(&fail_at, text ? strtol(text, NULL, 10) : 0);
    }
    return atomic_fetch_add(&requests, 1) + 1 == atomic_load(&fail_at);
}

static void *nothing(void) {
    errno = ENOMEM;
    return NULL;
}

void *malloc(size_t size) {
    return must_fail() ? nothing() : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    return must_fail() ? nothing() : __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size) {
    return must_fail() ? nothing() : __libc_realloc(memory, size);
}

__attribute__((destructor)) static void tell(void) {
    const char *path = getenv("COUNT_INTO");
    long count = atomic_load(&requests);
    FILE *file = path ? fopen(path, "w") : NULL;
    if (file) {
        fprintf(file, "%ld\n", count);
        fclose(file);
    }
}
