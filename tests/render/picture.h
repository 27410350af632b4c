/* A PNG in memory, asked for its ink in millimetres of the sheet (y up). */
#ifndef KTG_TESTS_RENDER_PICTURE_H
#define KTG_TESTS_RENDER_PICTURE_H

#include <cairo.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct snapshot {
    cairo_surface_t *surface;
    int width, height;
    double dots_per_mm, height_mm;
} snapshot;

typedef struct picture_bytes {
    const char *bytes;
    size_t left;
} picture_bytes;

static inline cairo_status_t picture_read(void *closure, unsigned char *bytes, unsigned int size) {
    picture_bytes *from = closure;
    if (size > from->left)
        return CAIRO_STATUS_READ_ERROR;
    memcpy(bytes, from->bytes, size);
    from->bytes += size;
    from->left -= size;
    return CAIRO_STATUS_SUCCESS;
}

static inline snapshot picture_of(const char *bytes, size_t size, double dots_per_mm,
                                  double height_mm) {
    picture_bytes from = {bytes, size};
    cairo_surface_t *surface = cairo_image_surface_create_from_png_stream(picture_read, &from);
    return (snapshot){surface, cairo_image_surface_get_width(surface),
                      cairo_image_surface_get_height(surface), dots_per_mm, height_mm};
}

static inline void picture_drop(snapshot *p) {
    cairo_surface_destroy(p->surface);
}

/* The mean of red, green and blue, 0..255; white outside. */
static inline int picture_grey(const snapshot *p, int x, int y) {
    if (x < 0 || y < 0 || x >= p->width || y >= p->height)
        return 255;
    uint32_t value;
    memcpy(&value,
           cairo_image_surface_get_data(p->surface) +
               (ptrdiff_t)y * cairo_image_surface_get_stride(p->surface) + 4 * (ptrdiff_t)x,
           4);
    return (int)((value >> 16 & 255) + (value >> 8 & 255) + (value & 255)) / 3;
}

/* True when something darker than a tint is within the rectangle. */
static inline bool picture_has_ink(const snapshot *p, double x0, double y0, double x1, double y1) {
    for (int y = (int)floor((p->height_mm - y1) * p->dots_per_mm);
         y <= (int)ceil((p->height_mm - y0) * p->dots_per_mm) - 1; y++)
        for (int x = (int)floor(x0 * p->dots_per_mm); x <= (int)ceil(x1 * p->dots_per_mm) - 1; x++)
            if (picture_grey(p, x, y) < 215)
                return true;
    return false;
}

#endif
