/* tests/render/ink.h - a sheet as a PNG, asked for the colours of its points. */
#ifndef KTG_TESTS_RENDER_INK_H
#define KTG_TESTS_RENDER_INK_H

#include <setjmp.h>
#include <stdarg.h>

#include "tests/render/picture.h"
#include "tests/render/strip.h"

#include <cmocka.h>

static inline int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static inline int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

static inline snapshot take(ktg_context *context, const ktg_pattern *pattern,
                            const ktg_render_options *options) {
    char *bytes;
    size_t size;
    assert_int_equal(render_bytes(context, pattern, "png", 0, options, &bytes, &size), KTG_OK);
    snapshot taken =
        picture_of(bytes, size, options->dots_per_inch / 25.4, pattern->sheets[0].height_mm);
    assert_int_equal(cairo_surface_status(taken.surface), CAIRO_STATUS_SUCCESS);
    ktg_free(bytes);
    return taken;
}

typedef struct colour {
    int r, g, b;
} colour;

static inline colour pixel(const snapshot *picture, int x, int y) {
    const unsigned char *row = cairo_image_surface_get_data(picture->surface) +
                               (ptrdiff_t)y * cairo_image_surface_get_stride(picture->surface);
    uint32_t value;
    memcpy(&value, row + 4 * (ptrdiff_t)x, 4);
    return (colour){(int)(value >> 16 & 255), (int)(value >> 8 & 255), (int)(value & 255)};
}

/* The darkest pixel within a hair's breadth of a point of the sheet (mm, y up). */
static inline colour darkest(const snapshot *picture, double x, double y) {
    int column = (int)floor(x * picture->dots_per_mm),
        row = (int)floor((picture->height_mm - y) * picture->dots_per_mm);
    colour dark = {255, 255, 255};
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            colour c = pixel(picture, column + dx, row + dy);
            if (c.r + c.g + c.b < dark.r + dark.g + dark.b)
                dark = c;
        }
    return dark;
}

static inline int grey(colour c) {
    return (c.r + c.g + c.b) / 3;
}

static inline void default_options(ktg_render_options *options) {
    ktg_render_defaults(options);
    options->dots_per_inch = 254; /* 10 to the millimetre */
}

#endif
