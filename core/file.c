/* core/file.c - reading a whole file. */
#include "core/file.h"
#include "core/memory.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static ktg_status read_stream(ktg_context *context, FILE *stream, const char *path, size_t most,
                              char **bytes, size_t *size) {
    size_t capacity = 0, count = 0;
    for (;;) {
        KTG_TRY(ktg_reserve(context, bytes, &capacity, count + 65536));
        size_t got = fread(*bytes + count, 1, capacity - count - 1, stream);
        count += got;
        if (count > most)
            return ktg_fail(context, KTG_LIMIT,
                            "%s: larger than %zu MB; nothing that large can be worked on", path,
                            most >> 20);
        if (ferror(stream) && errno == EINTR) { /* a signal that may want an end */
            KTG_TRY(ktg_check_cancel(context));
            clearerr(stream);
            continue;
        }
        if (ferror(stream))
            return ktg_fail(context, KTG_FILE, "%s: cannot be read: %s", path, strerror(errno));
        if (got == 0)
            break;
    }
    (*bytes)[count] = 0;
    *size = count;
    return KTG_OK;
}

static ktg_status open_stream(ktg_context *context, const char *path, FILE **stream) {
    struct stat about;
    while (!(*stream = fopen(path, "rb")) && errno == EINTR) /* a FIFO nobody writes yet */
        KTG_TRY(ktg_check_cancel(context));
    if (!*stream)
        return ktg_fail(context, KTG_FILE, "%s: cannot be opened: %s", path, strerror(errno));
    if (fstat(fileno(*stream), &about) == 0 && S_ISDIR(about.st_mode)) {
        fclose(*stream);
        return ktg_fail(context, KTG_FILE, "%s: is a folder; name a file in it", path);
    }
    return KTG_OK;
}

ktg_status ktg_file_read(ktg_context *context, const char *path, size_t most, char **bytes,
                         size_t *size) {
    *bytes = NULL;
    *size = 0;
    FILE *stream = stdin;
    bool standard = strcmp(path, "-") == 0;
    if (!standard)
        KTG_TRY(open_stream(context, path, &stream));
    ktg_status status =
        read_stream(context, stream, standard ? "standard input" : path, most, bytes, size);
    if (!standard)
        fclose(stream);
    if (status != KTG_OK) {
        ktg_free(*bytes);
        *bytes = NULL;
    }
    return status;
}
