/* tests/fuzz/handle_file.c - any bytes as handles of a fixed flat shape. */
#include "tests/fuzz/fixed.h"
#include "tests/fuzz/trouble.h"
#include "tests/fuzz/warping.h"

static void warp_with_little_memory(ktg_context *context, const char *path, const ktg_mesh *grid,
                                    const ktg_warp_options *options) {
    ktg_mesh *mesh;
    ktg_warp_report report;
    ktg_status status = ktg_mesh_copy(context, grid, &mesh);
    if (status == KTG_OK)
        status = ktg_warp(context, mesh, path, options, &report);
    fuzz_trouble_over(context, status);
    ktg_mesh_free(&mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const ktg_mesh *grid = fuzz_grid();
    ktg_context *context = fuzz_context();
    ktg_warp_options options;
    ktg_warp_defaults(&options);
    const char *path = fuzz_file("/some.handles", data, size);
    if (fuzz_trouble_memory(context, data, size))
        warp_with_little_memory(context, path, grid, &options);
    fuzz_warping(context, grid, path, &options);
    ktg_context_free(&context);
    return 0;
}
