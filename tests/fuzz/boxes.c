/* tests/fuzz/boxes.c - boxes in rows, and points in rectangles. */
#include "pattern/pattern.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <string.h>

#define MOST 32

/* Half small whole numbers, half any doubles. */
static double number(fuzz_bytes *bytes) {
    uint8_t kind = fuzz_byte(bytes), raw[8];
    double value;
    if (kind < 200)
        return kind % 20;
    for (int i = 0; i < 8; i++)
        raw[i] = fuzz_byte(bytes);
    memcpy(&value, raw, sizeof value);
    return value;
}

static void pack(ktg_context *context, fuzz_bytes *bytes) {
    ktg_row_box boxes[MOST] = {0};
    uint32_t sheets = 0, count = fuzz_below(bytes, MOST);
    double width = fabs(number(bytes)), height = fabs(number(bytes)), gap = fabs(number(bytes));
    for (uint32_t i = 0; i < count; i++) {
        boxes[i].width = fabs(number(bytes));
        boxes[i].height = fabs(number(bytes));
    }
    if (!fuzz_succeeded(context, ktg_rows_pack(context, width, height, gap, boxes, count, &sheets)))
        return;
    for (uint32_t i = 0; i < count; i++)
        fuzz_expect(boxes[i].sheet < sheets && boxes[i].x >= 0 && boxes[i].y >= 0 &&
                        boxes[i].x + boxes[i].width <= width * (1 + 1e-9) &&
                        boxes[i].y + boxes[i].height <= height * (1 + 1e-9),
                    "a box lies outside of its sheet");
}

static void fit(ktg_context *context, fuzz_bytes *bytes) {
    ktg_vec2 points[MOST], low, extent;
    double rotation, magnification;
    size_t count = 1 + fuzz_below(bytes, MOST - 1);
    for (size_t i = 0; i < count; i++)
        points[i] = (ktg_vec2){number(bytes), number(bytes)};
    if (fuzz_succeeded(context, ktg_smallest_box(context, points, count, &rotation, &low, &extent)))
        fuzz_expect(extent.x >= 0 && extent.y >= 0, "a box has no size");
    if (fuzz_succeeded(context, ktg_best_fit(context, points, count, 190, 277, &rotation, &low,
                                             &magnification)))
        fuzz_expect(magnification > 0, "a magnification is not above 0");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    ktg_context *context = fuzz_context();
    if (fuzz_byte(&bytes) % 2)
        pack(context, &bytes);
    else
        fit(context, &bytes);
    ktg_context_free(&context);
    return 0;
}
