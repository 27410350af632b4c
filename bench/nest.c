/* bench/nest.c - how densely polygons are nested on a strip.
 *
 *     BUILD/bench/nest [--seconds S] [--work N] [--seed N] INSTANCE.json...
 *
 * Instances as in bench/instance.h. Each is nested for S seconds (5), or with N units of work
 * whatever the machine. Density is the items' area over that of the strip; next to it, how near
 * that is to the best known. Every placement is proven before it counts. */
#include "bench/instance.h"
#include "core/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct command {
    double seconds;
    uint64_t work, seed;
} command;

typedef struct sums {
    double density, ratio;
    int count, rated;
} sums;

/* Reads the options; the index of the first instance, 0 when they are wrong. */
static int read_options(int argc, char **argv, command *c) {
    int i = 1;
    for (; i < argc && strncmp(argv[i], "--", 2) == 0; i += 2) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--seconds") == 0)
            c->seconds = strtod(value, NULL);
        else if (strcmp(argv[i], "--work") == 0)
            c->work = strtoull(value, NULL, 10);
        else if (strcmp(argv[i], "--seed") == 0)
            c->seed = strtoull(value, NULL, 10);
        else
            return 0;
    }
    if (c->seconds <= 0 && c->work == 0)
        c->seconds = 5;
    return i < argc && c->seconds >= 0 ? i : 0;
}

static ktg_status nest(ktg_context *context, const command *c, const bench_instance *in,
                       ktg_nest_place *places, ktg_nest_report *report) {
    ktg_nest_problem problem = {.shapes = in->shapes,
                                .shape_count = in->shape_count,
                                .items = in->items,
                                .item_count = in->item_count,
                                .width = in->width,
                                .length = INFINITY,
                                .work = c->work ? c->work : UINT64_MAX,
                                .seconds = c->seconds};
    ktg_status status = bench_instance_start(context, in, places);
    return status == KTG_OK ? ktg_nest(context, &problem, places, report) : status;
}

static void print_row(const bench_instance *in, const ktg_nest_report *report, double seconds,
                      sums *all) {
    double density = in->area / (in->width * report->length);
    char ratio[16] = "-";
    if (in->record > 0) {
        snprintf(ratio, sizeof ratio, "%.3f", density / in->record);
        all->ratio += density / in->record;
        all->rated++;
    }
    all->density += density;
    all->count++;
    printf("%-12s %5zu %12.3f %9.2f %9s %9u %9.0f %8.1f\n", in->name, in->item_count,
           report->length, 100 * density, ratio, report->records, (double)report->work / 1e6,
           seconds);
    fflush(stdout);
}

static bool measure(const command *c, const char *path, sums *all) {
    bench_instance in;
    ktg_context *context = NULL;
    ktg_nest_report report;
    if (!bench_instance_read(path, &in)) {
        bench_instance_drop(&in);
        return false;
    }
    double began = ktg_clock_seconds();
    ktg_nest_place *places = calloc(in.item_count, sizeof *places);
    ktg_status status = places ? ktg_context_new(&context) : KTG_MEMORY;
    if (status == KTG_OK) {
        ktg_context_set_seed(context, c->seed);
        status = nest(context, c, &in, places, &report);
    }
    if (status == KTG_OK)
        print_row(&in, &report, ktg_clock_seconds() - began, all);
    else
        fprintf(stderr, "%s: %s\n", path, context ? ktg_context_message(context) : "out of memory");
    ktg_context_free(&context);
    free(places);
    bench_instance_drop(&in);
    return status == KTG_OK;
}

int main(int argc, char **argv) {
    command c = {.seed = 1};
    sums all = {0};
    int first = read_options(argc, argv, &c);
    if (first == 0) {
        fputs("usage: nest [--seconds S] [--work N] [--seed N] INSTANCE.json...\n", stderr);
        return 2;
    }
    bool good = true;
    printf("%-12s %5s %12s %9s %9s %9s %9s %8s\n", "instance", "items", "length", "density %",
           "of record", "steps", "work M", "seconds");
    for (int i = first; i < argc; i++)
        good = measure(&c, argv[i], &all) && good;
    if (all.count > 0)
        printf("%-12s %28.2f %9.3f\n", "mean", 100 * all.density / all.count,
               all.rated ? all.ratio / all.rated : 0);
    return good ? 0 : 1;
}
