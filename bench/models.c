/* bench/models.c - files and folders of models. */
#include "bench/models.h"
#include "mesh/mesh.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define DEEPEST 8 /* folders in folders: enough, and no endless way round a link */

static void *checked(void *memory) {
    if (!memory) {
        fputs("out of memory\n", stderr);
        exit(1);
    }
    return memory;
}

static char *joined(const char *folder, const char *name) {
    size_t length = strlen(folder);
    const char *slash = length > 0 && folder[length - 1] == '/' ? "" : "/";
    char *path = checked(malloc(length + strlen(name) + 2));
    sprintf(path, "%s%s%s", folder, slash, name);
    return path;
}

static void add(bench_models *models, const char *path, const char *name) {
    models->items = checked(realloc(models->items, (models->count + 1) * sizeof *models->items));
    models->items[models->count++] = (bench_model){checked(strdup(path)), checked(strdup(name))};
}

static bool is_folder(const char *path) {
    struct stat about;
    return stat(path, &about) == 0 && S_ISDIR(about.st_mode);
}

static int by_text(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* The sorted names in a folder, without hidden ones. */
static char **names_in(const char *path, size_t *count) {
    char **names = NULL;
    DIR *folder = opendir(path);
    *count = 0;
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        if (entry->d_name[0] == '.')
            continue;
        names = checked(realloc(names, (*count + 1) * sizeof *names));
        names[(*count)++] = checked(strdup(entry->d_name));
    }
    if (folder)
        closedir(folder);
    if (names)
        qsort(names, *count, sizeof *names, by_text);
    return names;
}

/* `prefix` leads from the folder that was named to this one. */
static void add_folder(bench_models *models, const char *path, const char *prefix, int depth) {
    size_t count, before = models->count;
    char **names = names_in(path, &count);
    for (size_t i = 0; i < count; i++) {
        char *whole = joined(path, names[i]), *name = joined(prefix, names[i]);
        if (ktg_mesh_format_of(whole) != KTG_MESH_BY_ENDING && !is_folder(whole))
            add(models, whole, *prefix ? name : names[i]);
        free(whole);
        free(name);
    }
    for (size_t i = 0; i < count && models->count == before && depth < DEEPEST; i++) {
        char *whole = joined(path, names[i]), *name = joined(prefix, names[i]);
        if (is_folder(whole)) {
            size_t so_far = models->count;
            add_folder(models, whole, *prefix ? name : names[i], depth + 1);
            before += models->count - so_far; /* go on with the next folder */
        }
        free(whole);
        free(name);
    }
    for (size_t i = 0; i < count; i++)
        free(names[i]);
    free(names);
}

bool bench_models_add(bench_models *models, const char *path) {
    const char *slash = strrchr(path, '/');
    size_t before = models->count;
    if (is_folder(path))
        add_folder(models, path, "", 0);
    else
        add(models, path, slash ? slash + 1 : path);
    if (models->count == before)
        fprintf(stderr, "%s: holds no models (.obj, .stl, .ply, .off)\n", path);
    return models->count > before;
}

static int by_name(const void *a, const void *b) {
    return strcmp((*(bench_model *const *)a)->name, (*(bench_model *const *)b)->name);
}

void bench_models_name_apart(bench_models *models) {
    if (models->count == 0)
        return;
    bench_model **sorted = checked(malloc(models->count * sizeof *sorted));
    for (size_t i = 0; i < models->count; i++)
        sorted[i] = &models->items[i];
    qsort(sorted, models->count, sizeof *sorted, by_name);
    bool *twice = checked(calloc(models->count, sizeof *twice));
    for (size_t i = 1; i < models->count; i++)
        if (strcmp(sorted[i]->name, sorted[i - 1]->name) == 0)
            twice[i] = twice[i - 1] = true;
    for (size_t i = 0; i < models->count; i++) {
        if (!twice[i])
            continue;
        free(sorted[i]->name);
        sorted[i]->name = checked(strdup(sorted[i]->path));
    }
    free(sorted);
    free(twice);
}

void bench_models_free(bench_models *models) {
    for (size_t i = 0; i < models->count; i++) {
        free(models->items[i].path);
        free(models->items[i].name);
    }
    free(models->items);
    *models = (bench_models){0};
}
