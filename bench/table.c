/* bench/table.c - the figures as a table, and as JSON. */
#include "bench/table.h"

#include <stdlib.h>
#include <string.h>

/* ---- columns -------------------------------------------------------------------------------- */

typedef double figure_of(const bench_figures *f, int effort);

static double faces_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->faces;
}
static double components_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->components;
}
static double one_piece_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->one_piece;
}
static double pieces_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->most_pieces;
}
static double median_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->median;
}
static double slowest_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->slowest;
}
static double steps_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->steps;
}
static double megabytes_of(const bench_figures *f, int effort) {
    (void)effort;
    return f->megabytes;
}
static double fill_of(const bench_figures *f, int effort) {
    return f->sheets[effort].fill;
}
static double bare_fill_of(const bench_figures *f, int effort) {
    return f->sheets[effort].bare_fill;
}
static double seams_of(const bench_figures *f, int effort) {
    return f->sheets[effort].seams;
}
static double full_of(const bench_figures *f, int effort) {
    return f->sheets[effort].full;
}
static double reduced_of(const bench_figures *f, int effort) {
    return f->sheets[effort].reduced;
}
static double none_of(const bench_figures *f, int effort) {
    return f->sheets[effort].none;
}
static double net_seconds_of(const bench_figures *f, int effort) {
    return f->sheets[effort].seconds;
}

typedef struct column {
    const char *title, *key;
    int width, digits;
    bool low_is_bad;
    figure_of *figure;
} column;

static const column model_columns[] = {
    {"faces", "faces", 7, 0, false, faces_of},
    {"parts", "components", 5, 0, false, components_of},
    {"one", "runs_one_piece", 4, 0, true, one_piece_of},
    {"most", "most_pieces", 5, 0, false, pieces_of},
    {"seconds", "seconds_median", 9, 4, false, median_of},
    {"slowest", "seconds_max", 9, 4, false, slowest_of},
    {"steps", "steps", 9, 0, false, steps_of},
    {"MB", "megabytes", 6, 0, false, megabytes_of},
};

/* For each effort. */
static const column sheet_columns[] = {
    {"fill", "fill", 6, 3, true, fill_of},
    {"bare", "bare_fill", 6, 3, true, bare_fill_of},
    {"seams", "seams", 6, 0, false, seams_of},
    {"full%", "full_percent", 6, 1, true, full_of},
    {"red.%", "reduced_percent", 6, 1, false, reduced_of},
    {"none%", "none_percent", 6, 1, false, none_of},
    {"time", "seconds", 7, 2, false, net_seconds_of},
};

enum {
    MODEL_COLUMNS = sizeof model_columns / sizeof *model_columns,
    SHEET_COLUMNS = sizeof sheet_columns / sizeof *sheet_columns,
    NAME_WIDTH = 26
};

/* ---- the table ------------------------------------------------------------------------------ */

void bench_table_head(const bench_settings *settings) {
    printf("%-*s", NAME_WIDTH, "model");
    for (int i = 0; i < MODEL_COLUMNS; i++)
        printf(" %*s", model_columns[i].width, model_columns[i].title);
    for (int e = 0; e < BENCH_EFFORTS; e++) {
        if (!settings->efforts[e])
            continue;
        printf(" | %-6s", bench_effort_name(e));
        for (int i = 0; i < SHEET_COLUMNS; i++)
            printf(" %*s", sheet_columns[i].width, sheet_columns[i].title);
    }
    putchar('\n');
}

static void print_name(const char *name) {
    size_t length = strlen(name);
    if (length > NAME_WIDTH)
        printf("...%s", name + length - NAME_WIDTH + 3); /* the end tells more */
    else
        printf("%-*s", NAME_WIDTH, name);
}

void bench_table_row(const bench_settings *settings, const char *name, const bench_figures *f) {
    print_name(name);
    for (int i = 0; i < MODEL_COLUMNS; i++)
        printf(" %*.*f", model_columns[i].width, model_columns[i].digits,
               model_columns[i].figure(f, 0));
    for (int e = 0; e < BENCH_EFFORTS; e++) {
        if (!settings->efforts[e])
            continue;
        printf(" | %6s", "");
        for (int i = 0; i < SHEET_COLUMNS; i++)
            printf(" %*.*f", sheet_columns[i].width, sheet_columns[i].digits,
                   sheet_columns[i].figure(f, e));
    }
    putchar('\n');
    fflush(stdout);
}

/* ---- over all models ------------------------------------------------------------------------ */

static double median_over(const column *c, int effort, const bench_figures *all, size_t count) {
    double *numbers = malloc((count + 1) * sizeof *numbers);
    if (!numbers)
        return 0;
    for (size_t i = 0; i < count; i++)
        numbers[i] = c->figure(&all[i], effort);
    double median = bench_median(numbers, (int)count);
    free(numbers);
    return median;
}

static double worst_over(const column *c, int effort, const bench_figures *all, size_t count) {
    double worst = c->figure(&all[0], effort);
    for (size_t i = 1; i < count; i++) {
        double value = c->figure(&all[i], effort);
        if (c->low_is_bad ? value < worst : value > worst)
            worst = value;
    }
    return worst;
}

typedef double over_models(const column *c, int effort, const bench_figures *all, size_t count);

static void print_summary(const bench_settings *settings, const char *name, over_models *over,
                          const bench_figures *all, size_t count) {
    printf("%-*s", NAME_WIDTH, name);
    for (int i = 0; i < MODEL_COLUMNS; i++)
        printf(" %*.*f", model_columns[i].width, model_columns[i].digits,
               over(&model_columns[i], 0, all, count));
    for (int e = 0; e < BENCH_EFFORTS; e++) {
        if (!settings->efforts[e])
            continue;
        printf(" | %6s", "");
        for (int i = 0; i < SHEET_COLUMNS; i++)
            printf(" %*.*f", sheet_columns[i].width, sheet_columns[i].digits,
                   over(&sheet_columns[i], e, all, count));
    }
    putchar('\n');
}

void bench_table_summary(const bench_settings *settings, const bench_figures *all, size_t count) {
    int good = 0;
    for (size_t i = 0; i < count; i++)
        good += all[i].one_piece == settings->seeds;
    if (count > 0) {
        print_summary(settings, "median", median_over, all, count);
        print_summary(settings, "worst", worst_over, all, count);
    }
    printf("%d of %zu models in one piece on every run\n", good, count);
}

/* ---- JSON ----------------------------------------------------------------------------------- */

static void put_text(FILE *file, const char *text) {
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fprintf(file, "\\%c", *text);
        else if ((unsigned char)*text < ' ')
            fprintf(file, "\\u%04x", (unsigned)*text);
        else
            fputc(*text, file);
    }
    fputc('"', file);
}

/* The figures of one model, or those over all models. */
static void put_figures(FILE *file, const bench_settings *settings, over_models *over,
                        const bench_figures *all, size_t count) {
    for (int i = 0; i < MODEL_COLUMNS; i++)
        fprintf(file, "%s\"%s\": %.9g", i ? ", " : "{", model_columns[i].key,
                over(&model_columns[i], 0, all, count));
    for (int e = 0; e < BENCH_EFFORTS; e++) {
        if (!settings->efforts[e])
            continue;
        fprintf(file, ",\n    \"%s\": ", bench_effort_name(e));
        for (int i = 0; i < SHEET_COLUMNS; i++)
            fprintf(file, "%s\"%s\": %.9g", i ? ", " : "{", sheet_columns[i].key,
                    over(&sheet_columns[i], e, all, count));
        fputc('}', file);
    }
    fputc('}', file);
}

void bench_json(FILE *file, const bench_settings *settings, const char *const *names,
                const bench_figures *all, size_t count) {
    fprintf(file,
            "{\"settings\": {\"method\": \"%s\", \"runs\": %d, \"sheets\": %d},\n \"models\": {",
            settings->genetic ? "genetic" : "auto", settings->seeds, settings->sheet_seeds);
    for (size_t i = 0; i < count; i++) {
        fputs(i ? ",\n  " : "\n  ", file);
        put_text(file, names[i]);
        fputs(": ", file);
        put_figures(file, settings, median_over, &all[i], 1);
    }
    fputs("\n }", file);
    if (count > 0) {
        fputs(",\n \"median\": ", file);
        put_figures(file, settings, median_over, all, count);
        fputs(",\n \"worst\": ", file);
        put_figures(file, settings, worst_over, all, count);
    }
    fputs("}\n", file);
}
