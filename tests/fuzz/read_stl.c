/* tests/fuzz/read_stl.c - any bytes as STL. */
#include "tests/fuzz/reading.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reading(data, size, KTG_MESH_STL, "/model.stl");
    return 0;
}
