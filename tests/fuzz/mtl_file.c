/* tests/fuzz/mtl_file.c - any bytes as the MTL file of a fixed model with an image beside it. */
#include "paint/paint.h"
#include "tests/fuzz/model.h"
#include "tests/fuzz/trouble.h"

#include <string.h>

static const char model[] = "mtllib some.mtl\n"
                            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
                            "vt 0 0\nvt 1 0\nvt 1 1\nvt -3 7\n"
                            "usemtl a\nf 1/1 2/2 3/3 4/4\n"
                            "usemtl b\nf 1/1 5/2 2/3\n"
                            "usemtl c d\nf 2 5 3\n";

/* Two dots, black and red. */
static const uint8_t image[] = {
    0x89, 'P',  'N',  'G',  13,   10,  0x1a, 10,  0,    0,   0,    13,   'I',  'H', 'D',
    'R',  0,    0,    0,    2,    0,   0,    0,   1,    8,   2,    0,    0,    0,   0x7b,
    0x40, 0xe8, 0xdd, 0,    0,    0,   15,   'I', 'D',  'A', 'T',  'x',  0xda, 'c', 0x60,
    0x60, 0x60, 0xf8, 0xcf, 0xc0, 0,   0,    3,   4,    1,   0,    0xd5, 0x3e, 8,   'V',
    0,    0,    0,    0,    'I',  'E', 'N',  'D', 0xae, 'B', 0x60, 0x82};

static void look_at_faces(ktg_context *context, const ktg_paint *paint) {
    for (uint32_t f = 0; f < ktg_paint_face_count(paint); f++) {
        ktg_paint_dot dot = {f, {0.2, 0.3, 0.5}, {0.01, -0.01, 0}, {0, 0.01, -0.01}, KTG_NONE};
        uint8_t rgb[3];
        fuzz_must(context, ktg_paint_colour(context, paint, &dot, rgb));
    }
}

static void paint_with_little_memory(ktg_context *context, const ktg_mesh *mesh, const char *path,
                                     const ktg_paint_options *options) {
    ktg_paint *paint;
    ktg_paint_report report;
    if (!fuzz_trouble_over(context, ktg_paint_new(context, mesh, path, options, &paint, &report)))
        fuzz_expect(!paint, "colours come with a failure");
    ktg_paint_free(&paint);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ktg_context *context = fuzz_context();
    const char *path = fuzz_file("/model.obj", model, strlen(model));
    fuzz_file("/image.png", image, sizeof image);
    fuzz_file("/some.mtl", data, size);
    ktg_mesh *mesh = fuzz_read_model(context, path);
    ktg_paint *paint;
    ktg_paint_report report;
    const ktg_paint_options options = {.plain = true};
    if (fuzz_trouble_memory(context, data, size))
        paint_with_little_memory(context, mesh, path, &options);
    if (fuzz_succeeded(context, ktg_paint_new(context, mesh, path, &options, &paint, &report)) &&
        paint) {
        fuzz_must(context, ktg_paint_lay(context, paint, mesh, 10, &report));
        look_at_faces(context, paint);
    }
    ktg_paint_free(&paint);
    ktg_mesh_free(&mesh);
    ktg_context_free(&context);
    return 0;
}
