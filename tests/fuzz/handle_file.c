/* tests/fuzz/handle_file.c - any bytes as handles of a fixed flat shape. */
#include "tests/fuzz/fixed.h"
#include "tests/fuzz/warping.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const ktg_mesh *grid = fuzz_grid();
    ktg_context *context = fuzz_context();
    ktg_warp_options options;
    ktg_warp_defaults(&options);
    fuzz_warping(context, grid, fuzz_file("/some.handles", data, size), &options);
    ktg_context_free(&context);
    return 0;
}
