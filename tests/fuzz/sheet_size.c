/* tests/fuzz/sheet_size.c - any text as the size of a sheet. */
#include "pattern/pattern.h"
#include "tests/fuzz/fuzz.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char text[128] = "";
    ktg_context *context = fuzz_context();
    ktg_sheet_format sheet;
    ktg_sheet_defaults(&sheet);
    memcpy(text, data, size < sizeof text ? size : sizeof text - 1);
    if (fuzz_succeeded(context, ktg_sheet_parse(context, text, &sheet)))
        fuzz_expect(sheet.width_mm > 0 && sheet.height_mm > 0 && sheet.margin_mm == 10 &&
                        memchr(sheet.name, 0, sizeof sheet.name),
                    "a sheet has no size or no name");
    ktg_context_free(&context);
    return 0;
}
