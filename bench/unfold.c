/* bench/unfold.c - how fast and how well models unfold: a table, and the same as JSON.
 *
 *     BUILD/bench/unfold [--seeds N] [--effort quick|normal|best] [--genetic] [--json FILE]
 * MODEL...
 *
 * Each model is read, repaired and unfolded as it is, N times with different seeds. Seconds are
 * those around the search (auto: until there is one piece; genetic: the library call), medians over
 * the seeds. Fill and tabs are those of seed 1 on one A4 sheet with tabs of 5 mm: the largest scale
 * that fits. */
#include "unfold/unfold.h"
#include "mesh/mesh.h"
#include "pattern/pattern.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define MOST_SEEDS 100

typedef struct bench {
    ktg_context *context;
    ktg_unfold_options options;
    int seeds;
    FILE *json;
    int models, models_one_piece;
} bench;

typedef struct figures {
    uint32_t faces, components, most_pieces;
    int one_piece;            /* runs with one piece for each component */
    double median, slowest;   /* seconds */
    uint64_t steps;           /* of seed 1 */
    double fill, mm_per_unit; /* of seed 1 */
    ktg_finish_report finish; /* of seed 1 */
} figures;

static double clock_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double face_area(const ktg_pattern *pattern) {
    double area = 0;
    for (size_t i = 0; i < pattern->piece_count; i++) {
        const ktg_pattern_piece *piece = &pattern->pieces[i];
        for (size_t f = 0; f < piece->face_count; f++) {
            const uint32_t *k = piece->corners + 3 * f;
            ktg_vec2 a = piece->vertices[k[0]], b = piece->vertices[k[1]],
                     c = piece->vertices[k[2]];
            area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        }
    }
    return area;
}

/* Fill and tabs on one sheet. */
static ktg_status measure_sheet(bench *b, ktg_pattern *pattern, figures *f) {
    ktg_sheet_format sheet;
    ktg_finish_options finish;
    ktg_sheet_defaults(&sheet);
    ktg_finish_defaults(&finish);
    ktg_status status = ktg_pattern_fit(b->context, pattern, &sheet, 2, &finish, &f->mm_per_unit);
    if (status == KTG_OK)
        status = ktg_pattern_scale(b->context, pattern, f->mm_per_unit);
    if (status == KTG_OK)
        status = ktg_pattern_finish(b->context, pattern, &finish, &f->finish);
    double margins = 2 * sheet.margin_mm;
    if (status == KTG_OK)
        f->fill = face_area(pattern) / ((sheet.width_mm - margins) * (sheet.height_mm - margins));
    return status;
}

static ktg_status run_seeds(bench *b, const ktg_mesh *mesh, figures *f) {
    double seconds[MOST_SEEDS];
    for (int seed = 0; seed < b->seeds; seed++) {
        ktg_pattern *pattern = NULL;
        ktg_unfold_report report = {0};
        ktg_context_set_seed(b->context, (uint64_t)seed + 1);
        double start = clock_seconds();
        ktg_status status = ktg_unfold(b->context, mesh, "model", &b->options, &pattern, &report);
        seconds[seed] = clock_seconds() - start;
        if (report.seconds_to_one_piece > 0)
            seconds[seed] = report.seconds_to_one_piece;
        if (status == KTG_OK && seed == 0) {
            f->steps = report.evaluations;
            f->components = report.components;
            status = measure_sheet(b, pattern, f);
        }
        ktg_pattern_free(&pattern);
        if (status != KTG_OK)
            return status;
        f->one_piece += report.pieces == report.components;
        f->most_pieces = report.pieces > f->most_pieces ? report.pieces : f->most_pieces;
    }
    qsort(seconds, (size_t)b->seeds, sizeof *seconds, compare_numbers);
    f->median = seconds[b->seeds / 2];
    f->slowest = seconds[b->seeds - 1];
    return KTG_OK;
}

static void print_row(bench *b, const char *name, const figures *f) {
    printf("%-26.26s %7u %5u  %3d/%-3d %5u  %8.4f %8.4f %8llu  %5.3f  %5u %5u %5u\n", name,
           f->faces, f->components, f->one_piece, b->seeds, f->most_pieces, f->median, f->slowest,
           (unsigned long long)f->steps, f->fill, f->finish.tabs_full, f->finish.tabs_reduced,
           f->finish.tabs_none);
    if (!b->json)
        return;
    fprintf(b->json,
            "%s\n  {\"model\": \"%s\", \"faces\": %u, \"components\": %u, \"runs\": %d, "
            "\"runs_one_piece\": %d, \"most_pieces\": %u, \"seconds_median\": %.6f, "
            "\"seconds_max\": %.6f, \"steps\": %llu, \"fill\": %.6f, \"tabs_full\": %u, "
            "\"tabs_reduced\": %u, \"tabs_none\": %u}",
            b->models > 0 ? "," : "", name, f->faces, f->components, b->seeds, f->one_piece,
            f->most_pieces, f->median, f->slowest, (unsigned long long)f->steps, f->fill,
            f->finish.tabs_full, f->finish.tabs_reduced, f->finish.tabs_none);
}

static bool run_model(bench *b, const char *path) {
    const char *slash = strrchr(path, '/');
    ktg_mesh *mesh = NULL;
    ktg_repair_report repair;
    figures f = {0};
    ktg_status status = ktg_mesh_read(b->context, path, KTG_MESH_BY_ENDING, &mesh);
    if (status == KTG_OK)
        status = ktg_mesh_repair(b->context, mesh, &repair);
    if (status == KTG_OK) {
        f.faces = mesh->face_count;
        status = run_seeds(b, mesh, &f);
    }
    ktg_mesh_free(&mesh);
    if (status != KTG_OK) {
        fprintf(stderr, "%s\n", ktg_context_message(b->context));
        return false;
    }
    print_row(b, slash ? slash + 1 : path, &f);
    fflush(stdout);
    b->models++;
    b->models_one_piece += f.one_piece == b->seeds;
    return true;
}

/* Reads the options; the index of the first model, 0 when they are wrong. */
static int read_options(int argc, char **argv, bench *b) {
    static const char *const efforts[] = {"quick", "normal", "best"};
    int i = 1;
    for (; i < argc && strncmp(argv[i], "--", 2) == 0; i++) {
        if (strcmp(argv[i], "--genetic") == 0) {
            b->options.method = KTG_METHOD_GENETIC;
        } else if (strcmp(argv[i], "--seeds") == 0 && i + 1 < argc) {
            b->seeds = atoi(argv[++i]);
        } else if (strcmp(argv[i], "--json") == 0 && i + 1 < argc) {
            b->json = fopen(argv[++i], "w");
            if (!b->json)
                return 0;
        } else if (strcmp(argv[i], "--effort") == 0 && i + 1 < argc) {
            int effort = 0;
            for (i++; effort < 3 && strcmp(argv[i], efforts[effort]) != 0;)
                effort++;
            if (effort == 3)
                return 0;
            b->options.effort = (ktg_effort)effort;
        } else {
            return 0;
        }
    }
    return i < argc && b->seeds >= 1 && b->seeds <= MOST_SEEDS ? i : 0;
}

int main(int argc, char **argv) {
    bench b = {.seeds = 10};
    ktg_unfold_defaults(&b.options);
    b.options.effort = KTG_EFFORT_QUICK;
    int first = read_options(argc, argv, &b);
    if (first == 0 || ktg_context_new(&b.context) != KTG_OK) {
        fputs("usage: unfold [--seeds N] [--effort quick|normal|best] [--genetic] [--json FILE] "
              "MODEL...\n",
              stderr);
        return 2;
    }
    puts("model                        faces parts  one piece most   seconds  slowest    steps   "
         "fill"
         "   full  red.  none");
    if (b.json)
        fputs("[", b.json);
    bool good = true;
    for (int i = first; i < argc; i++)
        good = run_model(&b, argv[i]) && good;
    printf("%d of %d models in one piece on every run\n", b.models_one_piece, b.models);
    if (b.json) {
        fputs("\n]\n", b.json);
        good = fclose(b.json) == 0 && good;
    }
    ktg_context_free(&b.context);
    return good ? 0 : 1;
}
