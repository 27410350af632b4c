/* core/output.c - files that appear whole or not at all: written without a name or beside their
 * place, then put there.
 */
#include "core/memory.h"
#include "core/target.h"
#include "core/text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct ktg_output {
    char *path;
    ktg_target place;
    char *beside;  /* the name of a file that is not in its place yet; NULL where there is none */
    bool nameless; /* the stream's file has no name yet */
    FILE *stream;
    bool standard;
};

/* What a signal cut short was not refused. */
static ktg_status cannot_write(ktg_context *context, const char *path, int error) {
    if (strcmp(path, "-") == 0)
        path = "standard output";
    if (error == EINTR)
        KTG_TRY(ktg_check_cancel(context));
    return ktg_fail(context, KTG_FILE, "%s: cannot be written: %s", path, strerror(error));
}

static void output_free(ktg_output **output) {
    ktg_free((*output)->path);
    ktg_free((*output)->beside);
    ktg_free(*output);
    *output = NULL;
}

/* ---- where it goes ------------------------------------------------------------------------ */

static ktg_status check_folder(ktg_context *context, const char *path, const ktg_target *place) {
    char folder[PATH_MAX];
    if (!ktg_target_folder(place->path, folder, sizeof folder))
        return cannot_write(context, path, ENAMETOOLONG);
    if (access(folder, W_OK | X_OK) == 0)
        return KTG_OK;
    return ktg_fail(context, KTG_FILE, "%s: cannot be written: %s%s", path, strerror(errno),
                    errno == ENOENT ? "; make its folder first" : "");
}

static ktg_status find_place(ktg_context *context, const char *path, ktg_target *place) {
    int error = ktg_target_find(path, place);
    if (error != 0)
        return cannot_write(context, path, error);
    if (place->exists && S_ISDIR(place->mode))
        return ktg_fail(context, KTG_FILE, "%s: is a folder; name a file in it", path);
    if (place->exists && access(path, W_OK) != 0)
        return cannot_write(context, path, errno);
    return place->regular ? check_folder(context, path, place) : KTG_OK;
}

ktg_status ktg_output_check(ktg_context *context, const char *path) {
    ktg_target place;
    return strcmp(path, "-") == 0 ? KTG_OK : find_place(context, path, &place);
}

/* ---- opening ------------------------------------------------------------------------------ */

/* File names may have 255 bytes; this much of the place's own name leaves room for what is added.
 */
#define MOST_OF_NAME 200

/* Names beside the place, until `make` made a file of one of them. False with errno set. */
static bool name_beside(ktg_output *output, size_t size, bool (*make)(ktg_output *output)) {
    const char *path = output->place.path, *slash = strrchr(path, '/'),
               *name = slash ? slash + 1 : path;
    int kept = (int)(name - path) + (int)strnlen(name, MOST_OF_NAME);
    for (int attempt = 0; attempt < 1000; attempt++) {
        snprintf(output->beside, size, "%.*s.%ld-%d.tmp", kept, path, (long)getpid(), attempt);
        if (make(output))
            return true;
        if (errno != EEXIST)
            break;
    }
    return false;
}

static ktg_status beside(ktg_context *context, ktg_output *output,
                         bool (*make)(ktg_output *output)) {
    size_t size = strlen(output->place.path) + 48;
    output->beside = ktg_alloc(context, size, 1);
    if (!output->beside)
        return KTG_MEMORY;
    if (name_beside(output, size, make))
        return KTG_OK;
    int error = errno;
    ktg_free(output->beside);
    output->beside = NULL;
    return cannot_write(context, output->path, error);
}

/* The stream of a new file; false with errno set. */
static bool take_file(ktg_output *output, int file) {
    output->stream = file < 0 ? NULL : fdopen(file, "wb");
    if (file >= 0 && !output->stream)
        close(file);
    return output->stream;
}

static bool make_named(ktg_output *output) {
    return take_file(output, open(output->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
}

/* The way to a file without a name. */
static void name_of_nameless(const ktg_output *output, char name[48]) {
    snprintf(name, 48, "/proc/self/fd/%d", fileno(output->stream));
}

/* What has no name stays open until it gets one; a process may not have very many open files. */
#define MOST_NAMELESS 32

/* Opens a file without a name where system and disk know how, and can name it later. */
static bool open_nameless(ktg_output *output) {
#ifdef O_TMPFILE
    char folder[PATH_MAX], name[48];
    if (!ktg_target_folder(output->place.path, folder, sizeof folder) ||
        !take_file(output, open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666)))
        return false;
    name_of_nameless(output, name);
    output->nameless = fileno(output->stream) < MOST_NAMELESS && access(name, F_OK) == 0;
    if (!output->nameless)
        fclose(output->stream);
    return output->nameless;
#else
    (void)output;
    return false;
#endif
}

/* As the file had that was there. */
static bool keep_permissions(const ktg_output *output) {
    const ktg_target *place = &output->place;
    int file = fileno(output->stream);
    struct stat about;
    if (!place->exists)
        return true;
    if (fstat(file, &about) == 0 && (about.st_uid != place->owner || about.st_gid != place->group))
        (void)!fchown(file, place->owner, place->group); /* where that is allowed */
    return fchmod(file, place->mode & 0777) == 0;
}

static ktg_status open_regular(ktg_context *context, ktg_output *output) {
    if (!open_nameless(output))
        KTG_TRY(beside(context, output, make_named));
    return keep_permissions(output) ? KTG_OK : cannot_write(context, output->path, errno);
}

/* A FIFO opens when somebody reads it; a signal may come before. */
static ktg_status open_directly(ktg_context *context, ktg_output *output) {
    do {
        output->stream = fopen(output->path, "wb");
        KTG_TRY(output->stream ? KTG_OK : ktg_check_cancel(context));
    } while (!output->stream && errno == EINTR);
    return output->stream ? KTG_OK : cannot_write(context, output->path, errno);
}

static ktg_status open_stream(ktg_context *context, ktg_output *output) {
    if (output->standard) {
        output->stream = stdout;
        return KTG_OK;
    }
    KTG_TRY(find_place(context, output->path, &output->place));
    return output->place.regular ? open_regular(context, output) : open_directly(context, output);
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

/* ---- writing ------------------------------------------------------------------------------ */

ktg_status ktg_output_write(ktg_context *context, ktg_output *output, const void *bytes,
                            size_t size) {
    if (size && fwrite(bytes, 1, size, output->stream) != size)
        return cannot_write(context, output->path, errno);
    return KTG_OK;
}

ktg_status ktg_output_print(ktg_context *context, ktg_output *output, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int written = ktg_vprint(output->stream, format, arguments);
    va_end(arguments);
    return written < 0 ? cannot_write(context, output->path, errno) : KTG_OK;
}

/* ---- putting it in its place -------------------------------------------------------------- */

static bool close_stream(ktg_output *output) {
    bool good = output->standard || fclose(output->stream) == 0;
    output->stream = NULL;
    return good;
}

/* Everything has reached the system afterwards, or errno says why not. What has no name yet stays
 * open. */
static bool bring_out(ktg_output *output) {
    bool good = fflush(output->stream) == 0 && !ferror(output->stream);
    if (good && (output->beside || output->nameless))
        good = fsync(fileno(output->stream)) == 0;
    int error = errno;
    if (output->nameless)
        return good;
    if (!close_stream(output) && good)
        return false;
    errno = error;
    return good;
}

ktg_status ktg_output_finish(ktg_context *context, ktg_output *output) {
    if (!output->stream || bring_out(output))
        return KTG_OK;
    return cannot_write(context, output->path, errno);
}

static bool link_nameless(const ktg_output *output, const char *path) {
    char name[48];
    name_of_nameless(output, name);
    return linkat(AT_FDCWD, name, AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0;
}

static bool make_link(ktg_output *output) {
    return link_nameless(output, output->beside);
}

/* Where there is no file yet a name is enough; else it takes the old one's place. */
static ktg_status put(ktg_context *context, ktg_output *output) {
    if (output->nameless && !output->place.exists && link_nameless(output, output->place.path))
        return KTG_OK;
    if (output->nameless)
        KTG_TRY(beside(context, output, make_link));
    if (output->beside && rename(output->beside, output->place.path) != 0)
        return cannot_write(context, output->path, errno);
    return KTG_OK;
}

ktg_status ktg_output_commit(ktg_context *context, ktg_output **output) {
    ktg_status status = ktg_output_finish(context, *output);
    if (status == KTG_OK)
        status = put(context, *output);
    if (status == KTG_OK) {
        ktg_free((*output)->beside);
        (*output)->beside = NULL;
    }
    ktg_output_discard(output);
    return status;
}

void ktg_output_discard(ktg_output **output) {
    if (!output || !*output)
        return;
    if ((*output)->stream)
        (void)close_stream(*output);
    if ((*output)->beside)
        unlink((*output)->beside);
    output_free(output);
}

const char *ktg_output_path(const ktg_output *output) {
    return output->path;
}

const char *ktg_output_target(const ktg_output *output) {
    return output->standard || !output->place.regular ? NULL : output->place.path;
}
