/* tests/fuzz/fuzz.c - what the fuzz targets share. */
#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

uint8_t fuzz_byte(fuzz_bytes *bytes) {
    if (bytes->left == 0)
        return 0;
    bytes->left--;
    return *bytes->at++;
}

uint32_t fuzz_below(fuzz_bytes *bytes, uint32_t bound) {
    return fuzz_byte(bytes) % bound;
}

void fuzz_expect(bool good, const char *sentence) {
    if (good)
        return;
    dprintf(STDERR_FILENO, "FINDING: %s\n", sentence);
    abort();
}

/* ---- contexts ----------------------------------------------------------------------------- */

static void look_at_log(void *user, ktg_log_level level, const char *text) {
    (void)user, (void)level;
    fuzz_expect(text && *text && !strchr(text, '\n'), "the log gets a line that is none");
}

static void look_at_progress(void *user, const char *stage, double fraction, const char *detail) {
    (void)user, (void)detail;
    fuzz_expect(stage && fraction >= 0 && fraction <= 1, "progress is outside of 0 to 1");
}

ktg_context *fuzz_context(void) {
    ktg_context *context;
    fuzz_expect(ktg_context_new(&context) == KTG_OK, "no context");
    ktg_context_set_log(context, look_at_log, NULL);
    ktg_context_set_progress(context, look_at_progress, NULL);
    return context;
}

bool fuzz_succeeded(ktg_context *context, ktg_status status) {
    const char *message = ktg_context_message(context);
    if (status == KTG_OK)
        return true;
    if (status == KTG_INTERNAL || status == KTG_UNSOUND || status == KTG_MEMORY)
        fuzz_must(context, status);
    fuzz_expect(*message && !strchr(message, '\n'), "a refusal says nothing, or several lines");
    return false;
}

void fuzz_must(ktg_context *context, ktg_status status) {
    if (status == KTG_OK)
        return;
    dprintf(STDERR_FILENO, "FINDING: %s: %s\n", ktg_status_name(status),
            ktg_context_message(context));
    abort();
}

/* ---- files -------------------------------------------------------------------------------- */

static char folder[256];

static void remove_folder(void) {
    DIR *open = opendir(folder);
    if (!open)
        return;
    for (struct dirent *entry; (entry = readdir(open));)
        unlinkat(dirfd(open), entry->d_name, 0);
    closedir(open);
    rmdir(folder);
}

static void make_folder(void) {
    const char *where = getenv("TMPDIR");
    if (!where || strlen(where) > 200)
        where = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    snprintf(folder, sizeof folder, "%s/katagami-fuzz-XXXXXX", where);
    fuzz_expect(mkdtemp(folder) != NULL, "no folder for files");
    atexit(remove_folder);
}

/* The last sixteen paths stay valid. */
const char *fuzz_path(const char *name) {
    static char paths[16][512];
    static unsigned next;
    if (!*folder)
        make_folder();
    char *path = paths[next++ % 16];
    snprintf(path, sizeof paths[0], "%s%s", folder, name);
    return path;
}

const char *fuzz_file(const char *name, const void *bytes, size_t size) {
    const char *path = fuzz_path(name);
    FILE *file = fopen(path, "wb");
    fuzz_expect(file && fwrite(bytes, 1, size, file) == size && fclose(file) == 0,
                "a file cannot be written");
    return path;
}

char *fuzz_load(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    fuzz_expect(file && fseek(file, 0, SEEK_END) == 0, "a file that was promised is not there");
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*size + 1);
    fuzz_expect(bytes && fread(bytes, 1, *size, file) == *size, "a file cannot be read");
    fclose(file);
    bytes[*size] = 0;
    return bytes;
}

bool fuzz_same(const char *path, const char *other) {
    size_t size, other_size;
    char *bytes = fuzz_load(path, &size), *other_bytes = fuzz_load(other, &other_size);
    bool same = size == other_size && memcmp(bytes, other_bytes, size) == 0;
    free(bytes);
    free(other_bytes);
    return same;
}
