/* tests/fuzz/edit_file.c - any bytes as an edit of a fixed model. */
#include "deform/deform.h"
#include "tests/fuzz/editing.h"
#include "tests/fuzz/fixed.h"
#include "tests/fuzz/trouble.h"

static void read_with_little_memory(ktg_context *context, const char *path, const ktg_mesh *model) {
    ktg_edit *edit;
    if (!fuzz_trouble_over(context, ktg_edit_read(context, path, model, &edit)))
        fuzz_expect(!edit, "an edit comes with a failure");
    ktg_edit_free(&edit);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const ktg_mesh *boxes = fuzz_boxes();
    ktg_context *context = fuzz_context();
    const char *path = fuzz_file("/some.edit", data, size);
    if (fuzz_trouble_memory(context, data, size))
        read_with_little_memory(context, path, boxes);
    fuzz_editing(context, boxes, path);
    ktg_context_free(&context);
    return 0;
}
