/* tests/fuzz/read_ply.c - any bytes as PLY. */
#include "tests/fuzz/reading.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reading(data, size, KTG_MESH_PLY, "/model.ply");
    return 0;
}
