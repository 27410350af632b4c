/* tests/fuzz/fixed.c - the models that targets of text files are about, made once. */
#include "tests/fuzz/fixed.h"
#include "tests/fuzz/model.h"

#include <stdio.h>

static void put_box(FILE *file, unsigned first, double x, double y, double size, unsigned sides) {
    static const unsigned corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (unsigned v = 0; v < 8; v++)
        fprintf(file, "v %g %g %g\n", x + size * (v & 1), y + size * (v / 2 & 1), size * (v / 4));
    for (unsigned side = 0; side < sides; side++) {
        fprintf(file, "usemtl %s\nf", side % 2 ? "red" : "blue");
        for (unsigned k = 0; k < 4; k++)
            fprintf(file, " %u", first + corners[side][k]);
        fputs("\n", file);
    }
}

static ktg_mesh *read_fixed(const char *path) {
    ktg_context *context = fuzz_context();
    ktg_mesh *mesh = fuzz_read_model(context, path);
    fuzz_expect(mesh != NULL, "a fixed model is refused");
    ktg_context_free(&context);
    return mesh;
}

const ktg_mesh *fuzz_boxes(void) {
    static ktg_mesh *mesh;
    if (mesh)
        return mesh;
    const char *path = fuzz_path("/boxes.obj");
    FILE *file = fopen(path, "w");
    fuzz_expect(file != NULL, "a fixed model cannot be written");
    fputs("o body\ng low\n", file);
    put_box(file, 1, 0, 0, 5, 6);
    fputs("o head\ng high\n", file);
    put_box(file, 9, 1, 6, 3, 6);
    fputs("o plate\ng low left\n", file);
    put_box(file, 17, 6, 0, 4, 3);
    fclose(file);
    return mesh = read_fixed(path);
}

const ktg_mesh *fuzz_grid(void) {
    static ktg_mesh *mesh;
    if (mesh)
        return mesh;
    const char *path = fuzz_path("/grid.obj");
    FILE *file = fopen(path, "w");
    fuzz_expect(file != NULL, "a fixed model cannot be written");
    for (unsigned i = 0; i < 20; i++)
        fprintf(file, "v %u %u 0\n", 10 * (i % 5), 10 * (i / 5));
    for (unsigned i = 1; i < 15; i++)
        if (i % 5 != 0)
            fprintf(file, "f %u %u %u\nf %u %u %u\n", i, i + 1, i + 6, i, i + 6, i + 5);
    fclose(file);
    return mesh = read_fixed(path);
}
