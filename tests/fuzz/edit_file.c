/* tests/fuzz/edit_file.c - any bytes as an edit of a fixed model. */
#include "tests/fuzz/editing.h"
#include "tests/fuzz/fixed.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const ktg_mesh *boxes = fuzz_boxes();
    ktg_context *context = fuzz_context();
    fuzz_editing(context, boxes, fuzz_file("/some.edit", data, size));
    ktg_context_free(&context);
    return 0;
}
