/* bench/unfold.c - how fast and how well models unfold: a table, and the same as JSON.
 *
 *     BUILD/bench/unfold [--seeds N] [--sheets N] [--faces N] [--efforts E,E,...] [--genetic]
 *                        [--json FILE] MODEL|FOLDER...
 *
 * E is quick, normal or best. Each model is read, repaired, simplified where it has more faces than
 * wanted, and unfolded N times (10) with different seeds. A folder stands for the models in it; one
 * that holds only folders, for theirs. Seconds are those to one piece (genetic, or where a part is
 * left in more pieces: of the library call) and, like the steps, medians over the seeds, at the
 * first effort. Fill and tabs are those of seed 1 (or the mean of the first N, --sheets N) on one
 * A4 sheet, at the largest scale that fits: fill with tabs of 5 mm, bare without tabs. MB is the
 * process's peak. bench/compare tells two JSON files apart. */
#include "bench/measure.h"
#include "bench/models.h"
#include "bench/table.h"

#include <stdlib.h>
#include <string.h>

typedef struct command {
    bench_settings settings;
    const char *json;
} command;

/* Words of a list: "quick,best". */
static bool read_efforts(const char *list, bool *efforts) {
    memset(efforts, 0, BENCH_EFFORTS * sizeof *efforts);
    while (*list) {
        size_t length = strcspn(list, ",");
        int found = -1;
        for (int e = 0; e < BENCH_EFFORTS; e++)
            if (strlen(bench_effort_name(e)) == length &&
                memcmp(list, bench_effort_name(e), length) == 0)
                found = e;
        if (found < 0)
            return false;
        efforts[found] = true;
        list += length + (list[length] == ',');
    }
    return efforts[0] || efforts[1] || efforts[2];
}

/* Reads the options; the index of the first model, 0 when they are wrong. */
static int read_options(int argc, char **argv, command *c) {
    bench_settings *s = &c->settings;
    int i = 1;
    for (; i < argc && strncmp(argv[i], "--", 2) == 0; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--genetic") == 0) {
            s->genetic = true;
            continue;
        }
        if (strcmp(argv[i], "--seeds") == 0)
            s->seeds = atoi(value);
        else if (strcmp(argv[i], "--sheets") == 0)
            s->sheet_seeds = atoi(value);
        else if (strcmp(argv[i], "--faces") == 0)
            s->faces = (uint32_t)strtoul(value, NULL, 10);
        else if (strcmp(argv[i], "--json") == 0)
            c->json = value;
        else if ((strcmp(argv[i], "--effort") != 0 && strcmp(argv[i], "--efforts") != 0) ||
                 !read_efforts(value, s->efforts))
            return 0;
        i++;
    }
    if (s->sheet_seeds > s->seeds)
        s->sheet_seeds = s->seeds;
    bool good = s->seeds >= 1 && s->seeds <= BENCH_MOST_SEEDS && s->sheet_seeds >= 1;
    return i < argc && good ? i : 0;
}

/* Measures and prints model after model; those that worked come first in `names` and `all`. */
static size_t measure_all(const bench_settings *settings, const bench_models *models,
                          const char **names, bench_figures *all) {
    size_t done = 0;
    bench_table_head(settings);
    for (size_t i = 0; i < models->count; i++) {
        all[done] = (bench_figures){0};
        if (!bench_measure(settings, models->items[i].path, &all[done]))
            continue;
        names[done] = models->items[i].name;
        bench_table_row(settings, names[done], &all[done]);
        done++;
    }
    bench_table_summary(settings, all, done);
    return done;
}

static bool write_json(const command *c, const char *const *names, const bench_figures *all,
                       size_t count) {
    FILE *file = fopen(c->json, "w");
    if (!file) {
        perror(c->json);
        return false;
    }
    bench_json(file, &c->settings, names, all, count);
    bool good = !ferror(file);
    good = fclose(file) == 0 && good;
    if (!good)
        fprintf(stderr, "%s: cannot be written\n", c->json);
    return good;
}

int main(int argc, char **argv) {
    command c = {.settings = {.seeds = 10, .sheet_seeds = 1, .efforts = {true, false, false}}};
    bench_models models = {0};
    int first = read_options(argc, argv, &c);
    if (first == 0) {
        fputs("usage: unfold [--seeds N] [--sheets N] [--faces N] [--efforts quick,normal,best] "
              "[--genetic] "
              "[--json FILE] MODEL|FOLDER...\n",
              stderr);
        return 2;
    }
    bool good = true;
    for (int i = first; i < argc; i++)
        good = bench_models_add(&models, argv[i]) && good;
    bench_models_name_apart(&models);
    const char **names = calloc(models.count + 1, sizeof *names);
    bench_figures *all = calloc(models.count + 1, sizeof *all);
    if (names && all) {
        size_t done = measure_all(&c.settings, &models, names, all);
        good = good && done == models.count;
        if (c.json)
            good = write_json(&c, names, all, done) && good;
    } else {
        good = false;
    }
    free(names);
    free(all);
    bench_models_free(&models);
    return good ? 0 : 1;
}
