/* pattern/rows.c - boxes in rows by height (Igarashi & Cosgrove 2001). */
#include "pattern/pattern.h"

#include "core/memory.h"
#include "core/vec.h"

#include <stdlib.h>

/* A box's turn: by decreasing height, then by its place in the array. */
typedef struct place {
    double height;
    size_t index;
} place;

static int by_height(const void *left, const void *right) {
    const place *a = left, *b = right;
    if (a->height != b->height)
        return a->height > b->height ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

static ktg_status check_boxes(ktg_context *context, double width, double height, double gap,
                              const ktg_row_box *boxes, size_t count) {
    if (!(width > 0) || !(height > 0) || !(gap >= 0))
        return ktg_fail(context, KTG_ARGUMENT,
                        "rows of %g x %g mm with gaps of %g mm cannot be packed", width, height,
                        gap);
    for (size_t i = 0; i < count; i++) {
        if (!(boxes[i].width >= 0) || !(boxes[i].height >= 0))
            return ktg_fail(context, KTG_ARGUMENT, "box %zu has no size", i + 1);
        if (boxes[i].width > width || boxes[i].height > height)
            return ktg_fail(context, KTG_GEOMETRY,
                            "piece %zu needs %.1f x %.1f mm, but the sheet has %.1f x %.1f mm "
                            "inside its margins: choose a smaller size or a larger sheet",
                            i + 1, boxes[i].width, boxes[i].height, width, height);
    }
    return KTG_OK;
}

ktg_status ktg_rows_pack(ktg_context *context, double width, double height, double gap,
                         ktg_row_box *boxes, size_t box_count, uint32_t *sheet_count) {
    KTG_TRY(check_boxes(context, width, height, gap, boxes, box_count));
    place *order = ktg_new(context, box_count, place);
    if (!order)
        return KTG_MEMORY;
    for (size_t i = 0; i < box_count; i++)
        order[i] = (place){boxes[i].height, i};
    qsort(order, box_count, sizeof *order, by_height);
    double x = 0, y = 0,
           row_height = 0; /* where the next box goes; a row is as high as its first */
    uint32_t sheet = 0;
    for (size_t k = 0; k < box_count; k++) {
        ktg_row_box *box = &boxes[order[k].index];
        bool opens = k == 0 || x + box->width > width;
        if (opens && k > 0) {
            x = 0;
            y += row_height + gap;
            if (y + box->height > height) {
                y = 0;
                sheet++;
            }
        }
        if (opens)
            row_height = box->height;
        box->x = x;
        box->y = y;
        box->sheet = sheet;
        x += box->width + gap;
    }
    *sheet_count = box_count ? sheet + 1 : 0;
    ktg_free(order);
    return KTG_OK;
}
