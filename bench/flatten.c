/* bench/flatten.c - how fast and how well panels are laid flat, by each method: a table, and the
 * same as JSON.
 *
 *     BUILD/bench/flatten [--methods M,M,...] [--repeats N] [--json FILE] MODEL|FOLDER...
 *
 * M is arap, injective or two-step (all). Each model is read, repaired, and flattened N times (3);
 * seconds are those of the fastest, of the processor and without reading and repairing. A method in
 * brackets is what another one turned to. `said` is the sentence of one that refused, whose figures
 * are those of the shape it would have made. */
#include "bench/models.h"

#include "flatten/flatten.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { METHODS = 3 };

typedef struct command {
    bool methods[METHODS];
    int repeats;
    FILE *json;
    int rows; /* written to the JSON */
} command;

typedef struct row {
    const char *name;
    ktg_flatten_method asked;
    ktg_flatten_report report;
    double seconds;
    const char *said; /* NULL when it went well */
} row;

static bool read_methods(const char *list, bool *methods) {
    memset(methods, 0, METHODS * sizeof *methods);
    while (*list) {
        size_t length = strcspn(list, ",");
        int found = -1;
        for (int m = 0; m < METHODS; m++) {
            const char *name = ktg_flatten_method_name((ktg_flatten_method)m);
            if (strlen(name) == length && memcmp(list, name, length) == 0)
                found = m;
        }
        if (found < 0)
            return false;
        methods[found] = true;
        list += length + (list[length] == ',');
    }
    return methods[0] || methods[1] || methods[2];
}

/* Reads the options; the index of the first model, 0 when they are wrong. */
static int read_options(int argc, char **argv, command *c) {
    int i = 1;
    for (; i + 1 < argc && strncmp(argv[i], "--", 2) == 0; i += 2) {
        const char *value = argv[i + 1];
        if (strcmp(argv[i], "--repeats") == 0)
            c->repeats = atoi(value);
        else if (strcmp(argv[i], "--json") == 0 && !c->json)
            c->json = fopen(value, "w");
        else if (strcmp(argv[i], "--methods") != 0 || !read_methods(value, c->methods))
            return 0;
        if (strcmp(argv[i], "--json") == 0 && !c->json) {
            perror(value);
            return 0;
        }
    }
    return i < argc && c->repeats >= 1 ? i : 0;
}

static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print_row(const row *r) {
    const ktg_panel_report *f = &r->report.whole;
    char method[32];
    snprintf(method, sizeof method, f->method == r->asked ? "%s" : "(%s)",
             ktg_flatten_method_name(f->method));
    printf("%-28s %7u %-11s %8.5f %9.4f %6u %5u %6.1f %6.1f %8.1f %6.1f %+7.2f %7.3f%s%s\n",
           r->name, f->faces, method, f->arap_energy, f->symmetric_dirichlet, f->flipped_faces,
           f->iterations, 100 * f->strain_mean, 100 * f->strain_p95, 100 * f->strain_max,
           100 * f->area_beyond_limit, 100 * f->border_error, r->seconds, r->said ? "  " : "",
           r->said ? r->said : "");
    fflush(stdout);
}

static void write_row(command *c, const row *r) {
    const ktg_panel_report *f = &r->report.whole;
    fprintf(c->json,
            "%s\n  {\"panel\": \"%s\", \"asked\": \"%s\", \"method\": \"%s\", \"written\": %s, "
            "\"faces\": %u,\n   \"arap_energy\": %.17g, \"symmetric_dirichlet\": %.17g, "
            "\"flipped_faces\": %u, \"iterations\": %u,\n   \"strain_mean\": %.17g, "
            "\"strain_p95\": %.17g, \"strain_max\": %.17g, \"area_beyond_limit\": %.17g,\n   "
            "\"border_error\": %.17g, \"seconds\": %.6f}",
            c->rows++ > 0 ? "," : "", r->name, ktg_flatten_method_name(r->asked),
            ktg_flatten_method_name(f->method), r->said ? "false" : "true", f->faces,
            f->arap_energy, f->symmetric_dirichlet, f->flipped_faces, f->iterations, f->strain_mean,
            f->strain_p95, f->strain_max, f->area_beyond_limit, f->border_error, r->seconds);
}

/* Flattens once; false when it cannot even be tried. */
static ktg_status flatten_once(ktg_context *context, const ktg_mesh *mesh, row *r) {
    ktg_flatten_options options;
    ktg_pattern *pattern;
    ktg_flatten_defaults(&options);
    options.method = r->asked;
    double start = processor_seconds();
    ktg_status status = ktg_flatten(context, mesh, r->name, &options, &pattern, &r->report);
    ktg_flatten_report_free(&r->report);
    r->seconds = fmin(r->seconds, processor_seconds() - start);
    ktg_pattern_free(&pattern);
    return status;
}

/* False when the model is no panel at all. */
static bool measure_method(ktg_context *context, const ktg_mesh *mesh, command *c, row *r) {
    r->seconds = INFINITY;
    for (int k = 0; k < c->repeats; k++)
        r->said = flatten_once(context, mesh, r) == KTG_OK ? NULL : ktg_context_message(context);
    if (r->report.whole.faces == 0) {
        fprintf(stderr, "%s: %s\n", r->name, r->said);
        return false;
    }
    print_row(r);
    if (c->json)
        write_row(c, r);
    return true;
}

static bool measure(command *c, const bench_model *model) {
    ktg_context *context = NULL;
    ktg_mesh *mesh = NULL;
    ktg_repair_report repaired;
    if (ktg_context_new(&context) != KTG_OK)
        return false;
    bool good = ktg_mesh_read(context, model->path, KTG_MESH_BY_ENDING, &mesh) == KTG_OK &&
                ktg_mesh_repair(context, mesh, &repaired) == KTG_OK;
    if (!good)
        fprintf(stderr, "%s: %s\n", model->path, ktg_context_message(context));
    for (int m = 0; good && m < METHODS; m++) {
        row r = {.name = model->name, .asked = (ktg_flatten_method)m};
        if (c->methods[m])
            good = measure_method(context, mesh, c, &r);
    }
    ktg_mesh_free(&mesh);
    ktg_context_free(&context);
    return good;
}

static bool measure_all(command *c, const bench_models *models) {
    bool good = true;
    printf("%-28s %7s %-11s %8s %9s %6s %5s %6s %6s %8s %6s %7s %7s\n", "panel", "faces", "method",
           "energy", "dirichlet", "flips", "its", "mean%", "p95%", "max%", "> 5%", "border%",
           "seconds");
    if (c->json)
        fputs("[", c->json);
    for (size_t i = 0; i < models->count; i++)
        good = measure(c, &models->items[i]) && good;
    if (c->json)
        fputs("\n]\n", c->json);
    return good;
}

int main(int argc, char **argv) {
    command c = {.methods = {true, true, true}, .repeats = 3};
    bench_models models = {0};
    int first = read_options(argc, argv, &c);
    if (first == 0) {
        fputs("usage: flatten [--methods arap,injective,two-step] [--repeats N] [--json FILE] "
              "MODEL|FOLDER...\n",
              stderr);
        return 2;
    }
    bool good = true;
    for (int i = first; i < argc; i++)
        good = bench_models_add(&models, argv[i]) && good;
    bench_models_name_apart(&models);
    good = measure_all(&c, &models) && good;
    if (c.json)
        good = fclose(c.json) == 0 && good;
    bench_models_free(&models);
    return good ? 0 : 1;
}
