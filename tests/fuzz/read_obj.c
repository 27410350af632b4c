/* tests/fuzz/read_obj.c - any bytes as OBJ. */
#include "tests/fuzz/reading.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reading(data, size, KTG_MESH_OBJ, "/model.obj");
    return 0;
}
