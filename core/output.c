/* core/output.c - files that appear whole or not at all: written beside their place, then renamed.
 */
#include "core/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct ktg_output {
    char *path;
    char *beside; /* the file written before the rename; NULL when written directly */
    FILE *stream;
    bool standard;
};

static ktg_status cannot_write(ktg_context *context, const char *path, int error) {
    if (strcmp(path, "-") == 0)
        path = "standard output";
    return ktg_fail(context, KTG_FILE, "%s: cannot be written: %s", path, strerror(error));
}

static void output_free(ktg_output **output) {
    ktg_free((*output)->path);
    ktg_free((*output)->beside);
    ktg_free(*output);
    *output = NULL;
}

/* File names may have 255 bytes; this much of the path's own name leaves room for what is added. */
#define MOST_OF_NAME 200

/* Opens a new file beside `path`, under a name nobody else has. */
static ktg_status open_beside(ktg_context *context, ktg_output *output) {
    const char *slash = strrchr(output->path, '/'), *name = slash ? slash + 1 : output->path;
    int kept = (int)(name - output->path) + (int)strnlen(name, MOST_OF_NAME);
    size_t length = (size_t)kept + 48;
    output->beside = ktg_alloc(context, length, 1);
    if (!output->beside)
        return KTG_MEMORY;
    int file = -1;
    for (int attempt = 0; file < 0 && attempt < 1000; attempt++) {
        snprintf(output->beside, length, "%.*s.%ld-%d.tmp", kept, output->path, (long)getpid(),
                 attempt);
        file = open(output->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno != EEXIST)
            break;
    }
    if (file < 0) {
        int error = errno;
        ktg_free(output->beside);
        output->beside = NULL;
        return cannot_write(context, output->path, error);
    }
    output->stream = fdopen(file, "wb");
    return output->stream ? KTG_OK : cannot_write(context, output->path, errno);
}

static ktg_status open_stream(ktg_context *context, ktg_output *output) {
    struct stat about;
    if (output->standard) {
        output->stream = stdout;
        return KTG_OK;
    }
    if (stat(output->path, &about) != 0)
        return errno == ENOENT ? open_beside(context, output)
                               : cannot_write(context, output->path, errno);
    if (S_ISDIR(about.st_mode))
        return ktg_fail(context, KTG_FILE, "%s: is a folder; name a file in it", output->path);
    if (S_ISREG(about.st_mode))
        return access(output->path, W_OK) == 0 ? open_beside(context, output)
                                               : cannot_write(context, output->path, errno);
    output->stream = fopen(output->path, "wb");
    return output->stream ? KTG_OK : cannot_write(context, output->path, errno);
}

ktg_status ktg_output_open(ktg_context *context, const char *path, ktg_output **output) {
    *output = ktg_new(context, 1, ktg_output);
    if (!*output)
        return KTG_MEMORY;
    (*output)->standard = strcmp(path, "-") == 0;
    (*output)->path = ktg_copy_text(context, path, SIZE_MAX);
    ktg_status status = (*output)->path ? open_stream(context, *output) : KTG_MEMORY;
    if (status != KTG_OK)
        ktg_output_discard(output);
    return status;
}

ktg_status ktg_output_write(ktg_context *context, ktg_output *output, const void *bytes,
                            size_t size) {
    if (size && fwrite(bytes, 1, size, output->stream) != size)
        return cannot_write(context, output->path, errno);
    return KTG_OK;
}

ktg_status ktg_output_print(ktg_context *context, ktg_output *output, const char *format, ...) {
    locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0)
        return ktg_fail(context, KTG_MEMORY, "out of memory (locale)");
    locale_t before = uselocale(plain);
    va_list arguments;
    va_start(arguments, format);
    int written = vfprintf(output->stream, format, arguments);
    va_end(arguments);
    int error = errno;
    uselocale(before);
    freelocale(plain);
    return written < 0 ? cannot_write(context, output->path, error) : KTG_OK;
}

/* Closes the stream; everything has reached the system afterwards, or errno says why not. */
static bool close_stream(ktg_output *output) {
    bool good = fflush(output->stream) == 0 && !ferror(output->stream);
    if (output->beside)
        good = good && fsync(fileno(output->stream)) == 0;
    int error = errno;
    if (!output->standard && fclose(output->stream) != 0 && good) {
        good = false;
        error = errno;
    }
    output->stream = NULL;
    errno = error;
    return good;
}

ktg_status ktg_output_finish(ktg_context *context, ktg_output *output) {
    if (!output->stream || close_stream(output))
        return KTG_OK;
    return cannot_write(context, output->path, errno);
}

ktg_status ktg_output_commit(ktg_context *context, ktg_output **output) {
    ktg_status status = ktg_output_finish(context, *output);
    const char *beside = (*output)->beside;
    if (status == KTG_OK && beside && rename(beside, (*output)->path) != 0)
        status = cannot_write(context, (*output)->path, errno);
    if (status != KTG_OK)
        ktg_output_discard(output);
    else
        output_free(output);
    return status;
}

void ktg_output_discard(ktg_output **output) {
    if (!output || !*output)
        return;
    if ((*output)->stream && !(*output)->standard)
        fclose((*output)->stream);
    if ((*output)->beside)
        unlink((*output)->beside);
    output_free(output);
}

const char *ktg_output_path(const ktg_output *output) {
    return output->path;
}
