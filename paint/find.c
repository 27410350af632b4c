/* paint/find.c - finding the files that a model's files name, without leaving the model's folder.
 */
#include "paint/material.h"

#include "core/memory.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* What comes before the last part of a path, with its slash. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash + 1 - path) : 0;
}

/* The folder of `from` with `name` behind it; an absolute name stands alone. */
static char *joined(ktg_context *context, const char *from, const char *name) {
    size_t folder = *name == '/' ? 0 : folder_length(from), length = strlen(name);
    char *path = ktg_alloc(context, folder + length + 1, 1);
    if (path) {
        memcpy(path, from, folder);
        memcpy(path + folder, name, length);
    }
    return path;
}

/* True when `path` lies in the model's folder or below it, whatever links lead there. */
static bool is_inside(const ktg_paint_root *place, const char *path) {
    char file[PATH_MAX], folder[PATH_MAX], model[PATH_MAX];
    size_t length = folder_length(place->model);
    if (length >= sizeof folder)
        return false;
    memcpy(folder, length ? place->model : ".", length ? length : 1);
    folder[length ? length : 1] = 0;
    if (!realpath(folder, model) || !realpath(path, file))
        return false;
    length = strlen(model);
    return strncmp(file, model, length) == 0 && (model[length - 1] == '/' || file[length] == '/');
}

/* NULL when the file may be read, else why not. */
static const char *refusal(const ktg_paint_root *place, const char *path) {
    struct stat about;
    if (stat(path, &about) != 0)
        return "is not there";
    if (!S_ISREG(about.st_mode))
        return "is no file";
    if (!place->anywhere && !is_inside(place, path))
        return "lies outside the model's folder (--textures-anywhere reads it all the same)";
    return NULL;
}

/* Tries one way to read the name; a file that is there but refused is told of rather than one that
 * is not there. */
static ktg_status try_name(ktg_context *context, const ktg_paint_root *place, const char *from,
                           const char *name, char **path, const char **why) {
    if (*path || !*name)
        return KTG_OK;
    char *tried = joined(context, from, name);
    if (!tried)
        return KTG_MEMORY;
    const char *refused = refusal(place, tried);
    if (!refused) {
        char real[PATH_MAX];
        *path = ktg_copy_text(context, realpath(tried, real) ? real : tried, SIZE_MAX);
        ktg_free(tried);
        return *path ? KTG_OK : KTG_MEMORY;
    }
    if (!*why || strcmp(*why, "is not there") == 0)
        *why = refused;
    ktg_free(tried);
    return KTG_OK;
}

ktg_status ktg_paint_find_file(ktg_context *context, const ktg_paint_root *place, const char *from,
                               const char *name, char **path, const char **why) {
    *path = NULL;
    *why = NULL;
    char *slashed = ktg_copy_text(context, name, SIZE_MAX);
    if (!slashed)
        return KTG_MEMORY;
    for (char *at = slashed; *at; at++)
        *at = *at == '\\' ? '/' : *at;
    ktg_status status = try_name(context, place, from, name, path, why);
    if (status == KTG_OK)
        status = try_name(context, place, from, slashed, path, why);
    if (status == KTG_OK)
        status = try_name(context, place, from, slashed + folder_length(slashed), path, why);
    if (status != KTG_OK) {
        ktg_free(*path);
        *path = NULL;
    }
    if (!*why)
        *why = "has no name";
    ktg_free(slashed);
    return status;
}
