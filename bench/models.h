/* bench/models.h - which models a benchmark is about. */
#ifndef KTG_BENCH_MODELS_H
#define KTG_BENCH_MODELS_H

#include <stdbool.h>
#include <stddef.h>

/* A model file and what the table calls it: its path below the folder that was named, or the name
 * of a file that was named itself. */
typedef struct bench_model {
    char *path, *name;
} bench_model;

typedef struct bench_models {
    bench_model *items;
    size_t count;
} bench_models;

/* Adds a file, or all models of a folder, sorted by name. A folder that holds no model itself is
 * one of folders: theirs are added. False, with a sentence on standard error, when there is none.
 */
bool bench_models_add(bench_models *models, const char *path);

/* Models that would have the same name are called by their whole paths. */
void bench_models_name_apart(bench_models *models);

void bench_models_free(bench_models *models);

#endif
