/* bench/warp.c - how fast a flat shape follows its handles.
 *
 *     BUILD/bench/warp [VERTICES...]        (1000 10000 20000)
 *
 * For each number of vertices: a bar of that many, its ends held by two handles each and bent.
 * Seconds of the processor: register once, compile and update the fastest and the median of many;
 * updates in a second, and how far the handles are off. */
#include "flatten/flatten.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { HANDLES = 4, COMPILES = 7, UPDATES = 101 };

static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A bar five times as long as wide. */
static ktg_mesh *make_bar(ktg_context *context, uint32_t vertices) {
    uint32_t rows = (uint32_t)fmax(2, round(sqrt(vertices / 5.0)));
    uint32_t columns = (vertices + rows - 1) / rows, count = 0;
    double *positions = calloc((size_t)3 * rows * columns, sizeof *positions);
    uint32_t *faces = calloc((size_t)6 * rows * columns, sizeof *faces);
    ktg_mesh *mesh = NULL;
    for (uint32_t i = 0; positions && i < rows * columns; i++) {
        positions[3 * i] = i % columns;
        positions[3 * i + 1] = i / columns;
    }
    for (uint32_t j = 0; faces && j + 1 < rows; j++)
        for (uint32_t i = 0; i + 1 < columns; i++) {
            uint32_t a = i + columns * j, b = a + 1, c = b + columns, d = a + columns;
            uint32_t one[6] = {a, b, c, a, c, d}, other[6] = {a, b, d, b, c, d};
            for (int k = 0; k < 6; k++)
                faces[count++] = (i + j) % 2 ? one[k] : other[k];
        }
    if (!positions || !faces ||
        ktg_mesh_new(context, positions, rows * columns, faces, count / 3, &mesh) != KTG_OK)
        mesh = NULL;
    free(positions);
    free(faces);
    return mesh;
}

static void check(ktg_context *context, ktg_status status) {
    if (status == KTG_OK)
        return;
    fprintf(stderr, "warp: %s\n", ktg_context_message(context));
    exit(1);
}

/* Two handles at each end; the right ones turn by `angle` and come nearer. */
static void place_handles(ktg_context *context, const ktg_shape *shape, const ktg_mesh *bar,
                          ktg_handle *handles, ktg_vec2 *points) {
    ktg_vec3 far = bar->positions[bar->vertex_count - 1];
    for (int k = 0; k < HANDLES; k++) {
        points[k] = (ktg_vec2){far.x * (k < 2 ? 0.02 : 0.98), far.y * (k % 2 ? 0.8 : 0.2)};
        check(context, ktg_shape_handle_at(context, shape, points[k], &handles[k]));
    }
}

static void move_handles(const ktg_vec2 *points, double angle, ktg_vec2 *targets) {
    ktg_vec2 middle = {(points[2].x + points[3].x) / 2, (points[2].y + points[3].y) / 2};
    for (int k = 0; k < HANDLES; k++) {
        targets[k] = points[k];
        if (k < 2)
            continue;
        double x = points[k].x - middle.x, y = points[k].y - middle.y;
        targets[k].x = middle.x * (1 - 0.2 * angle) + cos(angle) * x - sin(angle) * y;
        targets[k].y = middle.y + middle.x * 0.3 * angle + sin(angle) * x + cos(angle) * y;
    }
}

typedef struct times {
    double reg, compile[COMPILES], update[UPDATES];
} times;

static void run(ktg_context *context, uint32_t vertices) {
    static times t;
    ktg_shape *shape;
    ktg_handle handles[HANDLES];
    ktg_vec2 points[HANDLES], targets[HANDLES];
    ktg_shape_report report;
    ktg_mesh *bar = make_bar(context, vertices);
    ktg_vec2 *positions = bar ? calloc(bar->vertex_count, sizeof *positions) : NULL;
    if (!positions)
        exit(1);
    double start = processor_seconds();
    check(context, ktg_shape_register(context, bar, KTG_WEIGHT_COTANGENT, &shape));
    t.reg = processor_seconds() - start;
    place_handles(context, shape, bar, handles, points);
    for (int i = 0; i < COMPILES; i++) {
        start = processor_seconds();
        check(context, ktg_shape_compile(context, shape, handles, HANDLES));
        t.compile[i] = processor_seconds() - start;
    }
    for (int i = 0; i < UPDATES; i++) {
        move_handles(points, 1.2 * i / UPDATES, targets);
        start = processor_seconds();
        check(context, ktg_shape_update(context, shape, targets, positions));
        t.update[i] = processor_seconds() - start;
    }
    ktg_shape_measure(shape, targets, positions, NULL, &report);
    qsort(t.compile, COMPILES, sizeof(double), by_value);
    qsort(t.update, UPDATES, sizeof(double), by_value);
    printf("%9u %9u  %9.2f %9.2f  %8.3f %8.3f %10.0f  %8.1e %6u\n", bar->vertex_count,
           bar->face_count, 1e3 * t.reg, 1e3 * t.compile[COMPILES / 2], 1e3 * t.update[0],
           1e3 * t.update[UPDATES / 2], 1 / t.update[UPDATES / 2],
           report.handle_error / bar->positions[bar->vertex_count - 1].x, report.folded_faces);
    ktg_shape_free(&shape);
    ktg_mesh_free(&bar);
    free(positions);
}

int main(int argc, char **argv) {
    ktg_context *context;
    if (ktg_context_new(&context) != KTG_OK)
        return 1;
    puts(" vertices     faces   register   compile    update   median    updates   handles folded\n"
         "                            ms        ms        ms       ms    a second      off");
    for (int i = 1; i < argc; i++)
        run(context, (uint32_t)strtoul(argv[i], NULL, 10));
    if (argc < 2) {
        run(context, 1000);
        run(context, 10000);
        run(context, 20000);
    }
    ktg_context_free(&context);
    return 0;
}
