/* bench/garments.c - how seams are chosen on whole garments: a table.
 *
 *     BUILD/bench/garments [--max-strain PERCENT] MODEL|FOLDER...
 *
 * Each model is read, repaired and flattened with KTG_SEAMS_AUTO (--seams auto). `worst` is, of all
 * panels, the largest part of the area that is strained beyond the limit; a panel passes with 5 %.
 * `seam` is the largest difference of the two sides of an edge that is sewn. Seconds are those of
 * the clock and of the processors, without reading and repairing. */
#include "bench/models.h"

#include "flatten/flatten.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double seconds_of(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print_row(const char *name, const ktg_flatten_report *r, double clock,
                      double processor) {
    double worst = 0, p95 = 0;
    for (uint32_t p = 0; p < r->panel_count; p++) {
        worst = fmax(worst, r->panels[p].area_beyond_limit);
        p95 = fmax(p95, r->panels[p].strain_p95);
    }
    printf("%-28s %7u %6u %6u %7.2f %7.2f %7.2f %7.3f %7.2f %7.2f\n", name, r->whole.faces,
           r->panel_count, r->panels_beyond, 100 * r->whole.strain_mean, 100 * p95, 100 * worst,
           100 * r->seam_error, clock, processor);
    fflush(stdout);
}

static ktg_status flatten(ktg_context *context, const bench_model *model, double limit) {
    ktg_mesh *mesh = NULL;
    ktg_pattern *pattern = NULL;
    ktg_repair_report repaired;
    ktg_flatten_report report = {0};
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_AUTO;
    options.strain_limit = limit;
    ktg_status status = ktg_mesh_read(context, model->path, KTG_MESH_BY_ENDING, &mesh);
    if (status == KTG_OK)
        status = ktg_mesh_repair(context, mesh, &repaired);
    double clock = seconds_of(CLOCK_MONOTONIC), processor = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    if (status == KTG_OK)
        status = ktg_flatten(context, mesh, model->name, &options, &pattern, &report);
    if (status == KTG_OK)
        print_row(model->name, &report, seconds_of(CLOCK_MONOTONIC) - clock,
                  seconds_of(CLOCK_PROCESS_CPUTIME_ID) - processor);
    ktg_flatten_report_free(&report);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
    return status;
}

static bool measure(const bench_model *model, double limit) {
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK)
        return false;
    bool good = flatten(context, model, limit) == KTG_OK;
    if (!good)
        fprintf(stderr, "%s: %s\n", model->path, ktg_context_message(context));
    ktg_context_free(&context);
    return good;
}

int main(int argc, char **argv) {
    bench_models models = {0};
    double percent = 5;
    int first = 1;
    if (argc > 2 && strcmp(argv[1], "--max-strain") == 0) {
        percent = strtod(argv[2], NULL);
        first = 3;
    }
    if (first >= argc || !(percent > 0)) {
        fputs("usage: garments [--max-strain PERCENT] MODEL|FOLDER...\n", stderr);
        return 2;
    }
    bool good = true;
    for (int i = first; i < argc; i++)
        good = bench_models_add(&models, argv[i]) && good;
    bench_models_name_apart(&models);
    printf("%-28s %7s %6s %6s %7s %7s %7s %7s %7s %7s\n", "garment", "faces", "panels", "beyond",
           "mean%", "p95%", "worst%", "seam%", "clock", "cpu");
    for (size_t i = 0; i < models.count; i++)
        good = measure(&models.items[i], percent / 100) && good;
    bench_models_free(&models);
    return good ? 0 : 1;
}
