/* tests/fuzz/warp.c - tiny flat shapes, folded and torn ones among them, under handles that are
 * well formed. */
#include "tests/fuzz/warping.h"

#include <stdio.h>

static int place(fuzz_bytes *bytes) {
    return (int)fuzz_below(bytes, 40) - 10;
}

static const char *make_handles(fuzz_bytes *bytes) {
    const char *path = fuzz_path("/some.handles");
    FILE *file = fopen(path, "w");
    fuzz_expect(file != NULL, "the handles cannot be written");
    uint32_t count = 1 + fuzz_below(bytes, 5);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t kind = fuzz_byte(bytes);
        if (kind % 4 == 0)
            fprintf(file, "hold ");
        if (kind / 4 % 4 == 3)
            fprintf(file, "at %d.5 %d", (int)fuzz_below(bytes, 16), (int)fuzz_below(bytes, 12));
        else
            fprintf(file, "vertex %u", 1 + fuzz_below(bytes, 16));
        if (kind % 4 != 0)
            fprintf(file, " %s %d %d", kind % 4 == 1 ? "->" : "by", place(bytes), place(bytes));
        fprintf(file, "%s\n", FUZZ_PICK(bytes, char *, "", "", " weight 1000", " weight 1e-9"));
    }
    fclose(file);
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    ktg_context *context = fuzz_context();
    ktg_warp_options options;
    ktg_warp_defaults(&options);
    options.refine = FUZZ_PICK(&bytes, uint32_t, KTG_NONE, 0, 1, 20);
    options.weight = FUZZ_PICK(&bytes, ktg_edge_weight, KTG_WEIGHT_COTANGENT, KTG_WEIGHT_UNIT);
    const char *handles = make_handles(&bytes);
    ktg_mesh *mesh = fuzz_read_model(context, fuzz_flat_model(&bytes));
    if (mesh)
        fuzz_warping(context, mesh, handles, &options);
    ktg_mesh_free(&mesh);
    ktg_context_free(&context);
    return 0;
}
