/* bench/paint.c - what a large image costs: the whole job, from a model with a texture to a PDF.
 *
 *     BUILD/bench/paint [DOTS...]        (2048 8192)
 *
 * For each size, an image of so many dots a side (noise, which packs badly) as JPEG and as PNG on a
 * ball of 840 faces, unfolded whole, and a ball of 39,600, simplified to 500: seconds by the clock,
 * seconds of the processors, and the largest memory of the job, which is a process of its own. */
#include "paint/paint.h"
#include "pipeline/pipeline.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define PI 3.14159265358979323846

static char folder[] = "/tmp/ktg-bench-paint-XXXXXX";

static void give_up(const char *what) {
    fprintf(stderr, "paint: %s\n", what);
    exit(1);
}

static const char *path_of(const char *name) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static FILE *create(const char *name) {
    FILE *file = fopen(path_of(name), "wb");
    if (!file)
        give_up("no room in /tmp");
    return file;
}

/* ---- what is measured ---------------------------------------------------------------------- */

/* A ball of rows x 2 rows rectangles; those at the poles are triangles. */
static void write_ball(const char *name, const char *library, int rows) {
    FILE *file = create(name);
    int columns = 2 * rows;
    fprintf(file, "mtllib %s\nusemtl skin\n", library);
    for (int i = 0; i <= rows; i++)
        for (int j = 0; j <= columns; j++) {
            double t = PI * i / rows, p = 2 * PI * (j % columns) / columns;
            double r = i == 0 || i == rows ? 0 : sin(t);
            fprintf(file, "v %.9f %.9f %.9f\nvt %.9f %.9f\n", r * cos(p), cos(t), -r * sin(p),
                    (double)j / columns, 1 - (double)i / rows);
        }
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++) {
            int a = i * (columns + 1) + j + 1, b = a + columns + 1;
            if (i + 1 < rows)
                fprintf(file, "f %d/%d %d/%d %d/%d\n", a, a, b, b, b + 1, b + 1);
            if (i > 0)
                fprintf(file, "f %d/%d %d/%d %d/%d\n", a, a, b + 1, b + 1, a + 1, a + 1);
        }
    fclose(file);
}

static void write_library(const char *name, const char *image) {
    FILE *file = create(name);
    fprintf(file, "newmtl skin\nmap_Kd %s\n", image);
    fclose(file);
}

/* Waves with noise on them. */
static void fill(uint8_t *rgb, uint32_t side) {
    uint32_t noise = 1;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < 3 * side; x++) {
            noise = noise * 1664525u + 1013904223u;
            double wave = 100 + 80 * sin(0.002 * x + 0.003 * y * (1 + x % 3));
            rgb[(size_t)y * 3 * side + x] = (uint8_t)(wave + (noise >> 26));
        }
}

static void write_images(uint32_t side) {
    ktg_context *context;
    unsigned char *bytes;
    size_t size;
    uint8_t *rgb = malloc((size_t)3 * side * side);
    png_image png = {
        .version = PNG_IMAGE_VERSION, .width = side, .height = side, .format = PNG_FORMAT_RGB};
    if (!rgb || ktg_context_new(&context) != KTG_OK)
        give_up("not enough memory");
    fill(rgb, side);
    png.flags = PNG_IMAGE_FLAG_FAST;
    if (!png_image_write_to_file(&png, path_of("skin.png"), 0, rgb, 0, NULL))
        give_up(png.message);
    if (ktg_paint_jpeg(context, rgb, side, side, &bytes, &size) != KTG_OK)
        give_up(ktg_context_message(context));
    FILE *file = create("skin.jpg");
    fwrite(bytes, 1, size, file);
    fclose(file);
    ktg_free(bytes);
    free(rgb);
    ktg_context_free(&context);
}

/* ---- measuring ----------------------------------------------------------------------------- */

static void unfold(const char *model, uint32_t faces) {
    ktg_context *context;
    ktg_pipeline_options options;
    char from[128], to[128];
    const char *outputs[] = {to};
    strcpy(from, path_of(model));
    strcpy(to, path_of("net.pdf"));
    if (ktg_context_new(&context) != KTG_OK)
        give_up("not enough memory");
    ktg_pipeline_defaults(&options);
    options.model = from;
    options.outputs = outputs;
    options.output_count = 1;
    options.faces = faces;
    options.unfold.effort = KTG_EFFORT_QUICK;
    if (ktg_pipeline_run(context, &options, NULL) != KTG_OK)
        give_up(ktg_context_message(context));
    ktg_context_free(&context);
}

static void measure(uint32_t side, const char *image, const char *model, const char *what) {
    struct timespec begin, end;
    struct rusage usage;
    int status;
    write_library("skin.mtl", image);
    fflush(stdout);
    clock_gettime(CLOCK_MONOTONIC, &begin);
    pid_t child = fork();
    if (child == 0) {
        unfold(model, strcmp(model, "small.obj") == 0 ? KTG_ALL_FACES : 500);
        _exit(0);
    }
    if (child < 0 || wait4(child, &status, 0, &usage) < 0 || status != 0)
        give_up("a job failed");
    clock_gettime(CLOCK_MONOTONIC, &end);
    printf("%6u  %-8s  %-22s  %7.2f  %7.2f  %7.0f\n", side, image + 5, what,
           (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec),
           (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
               1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
           (double)usage.ru_maxrss / 1024);
}

int main(int count, char **words) {
    static const char *const usual[] = {"2048", "8192"};
    static const char *const files[] = {"skin.png",  "skin.jpg",  "skin.mtl",
                                        "small.obj", "large.obj", "net.pdf"};
    if (!mkdtemp(folder))
        give_up("no room in /tmp");
    write_ball("small.obj", "skin.mtl", 15);
    write_ball("large.obj", "skin.mtl", 100);
    printf("  dots  image     model                   seconds  of CPUs  megabytes\n");
    for (int i = 0; i < (count > 1 ? count - 1 : 2); i++) {
        long side = strtol(count > 1 ? words[i + 1] : usual[i], NULL, 10);
        if (side < 1 || side > 11000)
            give_up("dots from 1 to 11000");
        write_images((uint32_t)side);
        for (int image = 0; image < 2; image++) {
            measure((uint32_t)side, files[image], "small.obj", "840 faces");
            measure((uint32_t)side, files[image], "large.obj", "39,600 faces to 500");
        }
    }
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        unlink(path_of(files[i]));
    rmdir(folder);
    return 0;
}
