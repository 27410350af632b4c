/* render/surface.c - cairo's streams into a ktg_output, and its errors as ours. */
#include "render/draw.h"

cairo_status_t ktg_sink_write(void *closure, const unsigned char *bytes, unsigned int size) {
    ktg_sink *sink = closure;
    if (sink->status == KTG_OK)
        sink->status = ktg_output_write(sink->context, sink->output, bytes, size);
    return sink->status == KTG_OK ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

ktg_status ktg_cairo_status(ktg_context *context, const ktg_sink *sink, cairo_status_t status,
                            const char *what) {
    if (sink && sink->status != KTG_OK)
        return sink->status; /* its message is in the context already */
    switch (status) {
    case CAIRO_STATUS_SUCCESS:
        return KTG_OK;
    case CAIRO_STATUS_NO_MEMORY:
        return ktg_fail(context, KTG_MEMORY, "out of memory while drawing %s", what);
    case CAIRO_STATUS_INVALID_SIZE:
        return ktg_fail(context, KTG_LIMIT, "%s would be too large: choose a smaller sheet", what);
    default:
        return ktg_fail(context, KTG_INTERNAL, "drawing %s failed: %s", what,
                        cairo_status_to_string(status));
    }
}
