/* bench/deform.c - how long a deformation takes to set up, and to follow a handle that is dragged.
 *
 *     deform [FACES]...          (20000 100000)
 *
 * Surfaces of our own: a tube and a plate, one end held, the other one turned by 30 degrees (one
 * step) or shifted. Of several runs the fastest and the middle one are shown. */
#include "deform/deform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SETUPS  5
#define UPDATES 15

typedef struct shape {
    double *points;
    uint32_t *faces;
    uint32_t point_count, face_count, row;
} shape;

static bool new_shape(shape *s, uint32_t row, uint32_t rows) {
    *s = (shape){.row = row};
    s->points = malloc(3 * (size_t)row * rows * sizeof *s->points);
    s->faces = malloc(6 * (size_t)row * rows * sizeof *s->faces);
    return s->points && s->faces;
}

/* `rows` rows of `row` points; closed: the rows are rings. */
static void add_cells(shape *s, uint32_t rows, bool closed) {
    for (uint32_t j = 0; j + 1 < rows; j++)
        for (uint32_t i = 0; i < s->row - !closed; i++) {
            uint32_t a = j * s->row + i, b = j * s->row + (i + 1) % s->row;
            const uint32_t corners[6] = {a, b, b + s->row, a, b + s->row, a + s->row};
            for (int k = 0; k < 6; k++)
                s->faces[3 * (size_t)s->face_count + (size_t)k] = corners[k];
            s->face_count += 2;
        }
}

static bool make(shape *s, uint32_t faces, bool tube) {
    uint32_t row = (uint32_t)sqrt(faces / 2.0), rows = faces / 2 / row + 1;
    if (!new_shape(s, row + 1, rows))
        return false;
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < s->row; i++) {
            double *p = s->points + 3 * (size_t)s->point_count++;
            double u = 2 * 3.14159265358979 * i / s->row;
            p[0] = 4.0 * j / rows;
            p[1] = tube ? cos(u) : u;
            p[2] = tube ? sin(u) : 0.1 * sin(5 * u) * cos(3 * p[0]);
        }
    add_cells(s, rows, tube);
    return true;
}

/* Of the processor, so that others who use the machine do not count. */
static double seconds_used(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int by_size(const void *left, const void *right) {
    const double *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static void tell(const char *what, double *seconds, size_t count) {
    qsort(seconds, count, sizeof *seconds, by_size);
    printf("  %s %8.4f %8.4f", what, seconds[0], seconds[count / 2]);
}

/* Each motion its own update, like a drag. */
static ktg_status drag(ktg_context *context, ktg_deform *deform, bool turn, ktg_vec3 *after,
                       double *seconds) {
    ktg_deform_motion motions[2] = {{{0}}};
    for (int i = 0; i < UPDATES; i++) {
        double part = (i + 1.0) / UPDATES, start = seconds_used();
        if (turn)
            motions[1] = (ktg_deform_motion){
                .axis = {1, 1, 0}, .centre = {4, 0, 0}, .angle = part * 3.14159265358979 / 6};
        else
            motions[1] = (ktg_deform_motion){.move = {part, part, 0}};
        ktg_status status = ktg_deform_update(context, deform, motions, after);
        if (status != KTG_OK)
            return status;
        seconds[i] = seconds_used() - start;
    }
    return KTG_OK;
}

static ktg_status measure(ktg_context *context, const ktg_mesh *mesh, const ktg_edit *edit,
                          ktg_vec3 *after) {
    double seconds[UPDATES];
    ktg_deform *deform = NULL;
    ktg_status status = KTG_OK;
    for (int i = 0; status == KTG_OK && i < SETUPS; i++) {
        double start = seconds_used();
        ktg_deform_free(&deform);
        status = ktg_deform_new(context, mesh, edit, &deform);
        seconds[i] = seconds_used() - start;
    }
    tell("setup", seconds, SETUPS);
    for (int turn = 1; status == KTG_OK && turn >= 0; turn--) {
        status = drag(context, deform, turn, after, seconds);
        tell(turn ? "turn" : "shift", seconds, UPDATES);
    }
    putchar('\n');
    ktg_deform_free(&deform);
    return status;
}

static ktg_status run(ktg_context *context, const shape *s) {
    uint32_t *held = malloc(2 * (size_t)s->row * sizeof *held);
    ktg_vec3 *after = malloc(s->point_count * sizeof *after);
    ktg_mesh *mesh = NULL;
    ktg_status status = held && after ? ktg_mesh_new(context, s->points, s->point_count, s->faces,
                                                     s->face_count, &mesh)
                                      : KTG_MEMORY;
    for (uint32_t i = 0; held && i < s->row; i++) {
        held[i] = i;
        held[s->row + i] = s->point_count - 1 - i;
    }
    ktg_hold holds[2] = {
        {.kind = KTG_HOLD_FIXED, .vertex_count = s->row, .vertices = held},
        {.kind = KTG_HOLD_HANDLE, .vertex_count = s->row, .vertices = held ? held + s->row : NULL}};
    ktg_edit edit = {.hold_count = 2, .holds = holds};
    if (status == KTG_OK)
        status = measure(context, mesh, &edit, after);
    ktg_mesh_free(&mesh);
    free(held);
    free(after);
    return status;
}

int main(int argc, char **argv) {
    static const uint32_t usual[] = {20000, 100000};
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK)
        return 1;
    int count = argc > 1 ? argc - 1 : 2;
    ktg_status status = KTG_OK;
    puts("seconds: fastest, middle");
    for (int i = 0; status == KTG_OK && i < 2 * count; i++) {
        uint32_t faces = argc > 1 ? (uint32_t)strtoul(argv[1 + i / 2], NULL, 10) : usual[i / 2];
        shape s;
        if (faces < 50 || faces > 10000000 || !make(&s, faces, i % 2 == 0))
            return 1;
        printf("%-5s %7u faces", i % 2 ? "plate" : "tube", s.face_count);
        status = run(context, &s);
        free(s.points);
        free(s.faces);
    }
    if (status != KTG_OK)
        fprintf(stderr, "%s\n", ktg_context_message(context));
    ktg_context_free(&context);
    return status != KTG_OK;
}
