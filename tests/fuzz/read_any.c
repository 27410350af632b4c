/* tests/fuzz/read_any.c - any bytes, whose format their content has to say. */
#include "tests/fuzz/reading.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reading(data, size, KTG_MESH_BY_ENDING, "/model.obj");
    return 0;
}
