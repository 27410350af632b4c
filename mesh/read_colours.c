/* mesh/read_colours.c - the colours that a file gives its vertices or polygons. */
#include "core/memory.h"
#include "mesh/read.h"

#include <math.h>

ktg_status ktg_colours_set(ktg_context *context, ktg_colour_list *list, size_t index,
                           ktg_vec3 colour) {
    KTG_TRY(ktg_reserve(context, &list->values, &list->capacity, index + 1));
    while (list->count < index)
        list->values[list->count++] = (ktg_vec3){NAN, NAN, NAN};
    list->values[index] = colour;
    list->count = index + 1;
    return KTG_OK;
}

/* 255 where the file's numbers go to 1, 1 where they go to 255. */
static double scale_of(const ktg_colour_list *list) {
    double largest = 0;
    for (size_t i = 0; i < list->count; i++) {
        ktg_vec3 c = list->values[i];
        largest = fmax(largest, fmax(c.x, fmax(c.y, c.z))); /* fmax passes over NaN */
    }
    return largest > 1 ? 1 : 255;
}

static uint8_t byte_of(double value) {
    return value >= 0 ? (uint8_t)lround(fmin(value, 255)) : value < 0 ? 0 : 255;
}

ktg_status ktg_colours_bytes(ktg_context *context, const ktg_colour_list *list, size_t count,
                             uint8_t **bytes) {
    *bytes = NULL;
    if (list->count == 0)
        return KTG_OK;
    *bytes = ktg_new(context, 3 * count, uint8_t);
    if (!*bytes)
        return KTG_MEMORY;
    double scale = scale_of(list);
    for (size_t i = 0; i < count; i++) {
        ktg_vec3 c = i < list->count ? list->values[i] : (ktg_vec3){NAN, NAN, NAN};
        (*bytes)[3 * i] = byte_of(scale * c.x);
        (*bytes)[3 * i + 1] = byte_of(scale * c.y);
        (*bytes)[3 * i + 2] = byte_of(scale * c.z);
    }
    return KTG_OK;
}
