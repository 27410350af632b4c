/* tests/fuzz/fabric_file.c - any bytes as a fabric. */
#include "flatten/flatten.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ktg_context *context = fuzz_context();
    ktg_fabric f;
    if (fuzz_succeeded(context,
                       ktg_fabric_read(context, fuzz_file("/some.fabric", data, size), &f)))
        fuzz_expect(f.stretch_along >= 0 && f.stretch_across >= 0 && f.shrink_along >= 0 &&
                        f.shrink_across >= 0 && f.shear >= 0 && isfinite(f.stretch_along) &&
                        isfinite(f.stretch_across) && isfinite(f.shrink_along) &&
                        isfinite(f.shrink_across) && isfinite(f.shear),
                    "a fabric holds what is no number");
    ktg_context_free(&context);
    return 0;
}
