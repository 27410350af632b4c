/* bench/measure.c - unfolds a model as often as wanted and puts nets on a sheet. */
#include "bench/measure.h"
#include "mesh/mesh.h"
#include "pattern/pattern.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* A model being measured. */
typedef struct measuring {
    const bench_settings *settings;
    ktg_context *context;
    ktg_mesh *mesh;
    bench_figures *figures;
} measuring;

const char *bench_effort_name(int effort) {
    static const char *const names[BENCH_EFFORTS] = {"quick", "normal", "best"};
    return names[effort];
}

/* ---- what is run ---------------------------------------------------------------------------- */

static void sheet_options(ktg_sheet_format *sheet) {
    ktg_sheet_defaults(sheet);
}

static void finish_options(bool tabs, ktg_finish_options *options) {
    ktg_finish_defaults(options);
    if (!tabs)
        options->tab_height_mm = 0;
}

/* The one place where a search gets its options. Where they are the same with tabs and without,
 * one net serves for both. */
static void unfold_options(const bench_settings *settings, int effort, bool tabs,
                           ktg_unfold_options *options) {
    memset(options, 0, sizeof *options);
    ktg_unfold_defaults(options);
    options->method = settings->genetic ? KTG_METHOD_GENETIC : KTG_METHOD_AUTO;
    options->effort = (ktg_effort)effort;
    if (!tabs)
        options->finish.tab_height_mm = 0;
}

/* ---- one net -------------------------------------------------------------------------------- */

static double clock_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *numbers, int count) {
    qsort(numbers, (size_t)count, sizeof *numbers, compare_numbers);
    return numbers[count / 2];
}

static ktg_status make_net(const measuring *m, int effort, bool tabs, int seed,
                           ktg_pattern **pattern, ktg_unfold_report *report, double *seconds) {
    ktg_unfold_options options;
    unfold_options(m->settings, effort, tabs, &options);
    ktg_context_set_seed(m->context, (uint64_t)seed + 1);
    double start = clock_seconds();
    ktg_status status = ktg_unfold(m->context, m->mesh, "model", &options, pattern, report);
    *seconds = clock_seconds() - start;
    return status;
}

/* ---- one sheet ------------------------------------------------------------------------------ */

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

/* Adds this net's part of the means. */
static void add_sheet(const measuring *m, bench_sheet *sheet, bool tabs, double fill,
                      const ktg_finish_report *r) {
    double share = 1.0 / m->settings->sheet_seeds;
    double edges = (double)r->tabs_full + r->tabs_reduced + r->tabs_none;
    if (!tabs) {
        sheet->bare_fill += share * fill;
        return;
    }
    sheet->fill += share * fill;
    sheet->seams += share * edges;
    if (edges == 0)
        return;
    sheet->full += share * 100 * r->tabs_full / edges;
    sheet->reduced += share * 100 * r->tabs_reduced / edges;
    sheet->none += share * 100 * r->tabs_none / edges;
}

/* Fits a copy of the net to a sheet, with tabs or without. */
static ktg_status put_on_sheet(const measuring *m, const ktg_pattern *net, bool tabs,
                               bench_sheet *result) {
    ktg_sheet_format sheet;
    ktg_finish_options finish;
    ktg_finish_report report = {0};
    ktg_pattern *pattern = NULL;
    double mm_per_unit;
    sheet_options(&sheet);
    finish_options(tabs, &finish);
    ktg_status status = ktg_pattern_copy(m->context, net, &pattern);
    if (status == KTG_OK)
        status = ktg_pattern_fit(m->context, pattern, &sheet, 2, &finish, &mm_per_unit);
    if (status == KTG_OK)
        status = ktg_pattern_scale(m->context, pattern, mm_per_unit);
    if (status == KTG_OK)
        status = ktg_pattern_finish(m->context, pattern, &finish, &report);
    double margins = 2 * sheet.margin_mm;
    double printable = (sheet.width_mm - margins) * (sheet.height_mm - margins);
    if (status == KTG_OK)
        add_sheet(m, result, tabs, face_area(pattern) / printable, &report);
    ktg_pattern_free(&pattern);
    return status;
}

/* A net and its two sheets; a second net where the search wants other options without tabs. */
static ktg_status run_seed(const measuring *m, int effort, int seed, bool sheets,
                           ktg_unfold_report *report, double *seconds) {
    bench_sheet *sheet = &m->figures->sheets[effort];
    ktg_unfold_options with, without;
    ktg_pattern *net = NULL, *bare = NULL;
    ktg_unfold_report bare_report;
    double bare_seconds;
    unfold_options(m->settings, effort, true, &with);
    unfold_options(m->settings, effort, false, &without);
    bool same = memcmp(&with, &without, sizeof with) == 0;
    ktg_status status = make_net(m, effort, true, seed, &net, report, seconds);
    if (status == KTG_OK && sheets) {
        sheet->seconds += *seconds / m->settings->sheet_seeds;
        status = put_on_sheet(m, net, true, sheet);
        if (status == KTG_OK && !same)
            status = make_net(m, effort, false, seed, &bare, &bare_report, &bare_seconds);
        if (status == KTG_OK)
            status = put_on_sheet(m, same ? net : bare, false, sheet);
    }
    ktg_pattern_free(&net);
    ktg_pattern_free(&bare);
    return status;
}

/* ---- one model ------------------------------------------------------------------------------ */

/* The first effort is run with all seeds, the others with those that get sheets. */
static ktg_status run_effort(const measuring *m, int effort, bool first) {
    bench_figures *f = m->figures;
    int seeds = first ? m->settings->seeds : m->settings->sheet_seeds;
    double seconds[BENCH_MOST_SEEDS], steps[BENCH_MOST_SEEDS];
    for (int seed = 0; seed < seeds; seed++) {
        ktg_unfold_report r = {0};
        ktg_status status =
            run_seed(m, effort, seed, seed < m->settings->sheet_seeds, &r, &seconds[seed]);
        if (status != KTG_OK)
            return status;
        if (r.seconds_to_one_piece > 0)
            seconds[seed] = r.seconds_to_one_piece;
        steps[seed] = (double)r.evaluations;
        if (!first)
            continue;
        f->components = r.components;
        f->one_piece += r.pieces == r.parts;
        f->most_pieces = r.pieces > f->most_pieces ? r.pieces : f->most_pieces;
    }
    if (first) {
        f->median = bench_median(seconds, seeds);
        f->slowest = seconds[seeds - 1];
        f->steps = bench_median(steps, seeds);
    }
    return KTG_OK;
}

static ktg_status run_model(measuring *m, const char *path) {
    ktg_repair_report repair;
    ktg_status status = ktg_mesh_read(m->context, path, KTG_MESH_BY_ENDING, &m->mesh);
    if (status == KTG_OK)
        status = ktg_mesh_repair(m->context, m->mesh, &repair);
    uint32_t most = m->settings->faces;
    if (status == KTG_OK && most > 0)
        status = ktg_mesh_simplify(m->context, m->mesh, most, NULL);
    if (status == KTG_OK)
        m->figures->faces = m->mesh->face_count;
    bool first = true;
    for (int effort = 0; status == KTG_OK && effort < BENCH_EFFORTS; effort++) {
        if (!m->settings->efforts[effort])
            continue;
        status = run_effort(m, effort, first);
        first = false;
    }
    return status;
}

/* In the child: measures, tells, ends. */
static int measure_here(const bench_settings *settings, const char *path, int pipe_end) {
    bench_figures figures = {0};
    measuring m = {.settings = settings, .figures = &figures};
    if (ktg_context_new(&m.context) != KTG_OK)
        return 1;
    ktg_status status = run_model(&m, path);
    if (status != KTG_OK)
        fprintf(stderr, "%s: %s\n", path, ktg_context_message(m.context));
    ktg_mesh_free(&m.mesh);
    ktg_context_free(&m.context);
    if (status != KTG_OK || write(pipe_end, &figures, sizeof figures) != sizeof figures)
        return 1;
    return 0;
}

bool bench_measure(const bench_settings *settings, const char *path, bench_figures *figures) {
    int ends[2], how = 0;
    struct rusage usage;
    fflush(NULL);
    if (pipe(ends) != 0) {
        perror("pipe");
        return false;
    }
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        _exit(measure_here(settings, path, ends[1]));
    }
    close(ends[1]);
    bool told = child > 0 && read(ends[0], figures, sizeof *figures) == sizeof *figures;
    close(ends[0]);
    if (child < 0 || wait4(child, &how, 0, &usage) != child) {
        perror("fork");
        return false;
    }
    if (WIFSIGNALED(how))
        fprintf(stderr, "%s: ended by signal %d\n", path, WTERMSIG(how));
    figures->megabytes = (double)usage.ru_maxrss / 1024;
    return told && WIFEXITED(how) && WEXITSTATUS(how) == 0;
}
