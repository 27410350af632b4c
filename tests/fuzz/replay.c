/* tests/fuzz/replay.c - goes through files and folders of inputs with one fuzz target: its corpus
 * as an ordinary test. usage: TARGET FILE|FOLDER... */
#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#define SLOW_SECONDS 10

static unsigned inputs;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The bytes lie in a block of their own size, so that a sanitizer sees a step beyond. */
static void run_file(const char *path) {
    size_t size;
    char *bytes = fuzz_load(path, &size);
    uint8_t *input = malloc(size ? size : 1);
    fuzz_expect(input != NULL, "out of memory");
    memcpy(input, bytes, size);
    free(bytes);
    fprintf(stderr, "%s\n", path); /* the last one that is told is the one that fails */
    double start = now();
    LLVMFuzzerTestOneInput(input, size);
    if (now() - start > SLOW_SECONDS)
        fprintf(stderr, "%s: slow, %.1f s\n", path, now() - start);
    free(input);
    inputs++;
}

static void run_path(const char *path) {
    struct stat about;
    fuzz_expect(stat(path, &about) == 0, "a file of the corpus is not there");
    if (!S_ISDIR(about.st_mode)) {
        run_file(path);
        return;
    }
    struct dirent **entries;
    int count = scandir(path, &entries, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        char inside[1024];
        snprintf(inside, sizeof inside, "%s/%s", path, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.')
            run_path(inside);
        free(entries[i]);
    }
    free(entries);
}

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++)
        run_path(argv[i]);
    printf("%u inputs\n", inputs);
    return inputs > 0 ? 0 : 1;
}
