/* tests/fuzz/read_off.c - any bytes as OFF. */
#include "tests/fuzz/reading.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_reading(data, size, KTG_MESH_OFF, "/model.off");
    return 0;
}
