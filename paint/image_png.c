/* paint/image_png.c - PNG through libpng's simplified interface, on white where it is transparent.
 */
#include "paint/image.h"

#include "core/memory.h"

#include <png.h>
#include <string.h>

static ktg_status decode(ktg_context *context, const char *path, png_image *png,
                         ktg_image_level *level) {
    static const png_color white = {255, 255, 255};
    KTG_TRY(ktg_image_check_size(context, path, png->width, png->height, KTG_IMAGE_MOST));
    png->format = PNG_FORMAT_RGB;
    level->width = png->width;
    level->height = png->height;
    level->rgb = ktg_alloc(context, (size_t)png->width * png->height, 3);
    if (!level->rgb)
        return KTG_MEMORY;
    if (!png_image_finish_read(png, &white, level->rgb, 0, NULL))
        return ktg_fail(context, KTG_FORMAT, "%s: the PNG is damaged: %s", path, png->message);
    return KTG_OK;
}

ktg_status ktg_image_read_png(ktg_context *context, const char *path, const char *bytes,
                              size_t size, ktg_image *image) {
    png_image png;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    ktg_status status =
        png_image_begin_read_from_memory(&png, bytes, size)
            ? decode(context, path, &png, &image->levels[0])
            : ktg_fail(context, KTG_FORMAT, "%s: the PNG is damaged: %s", path, png.message);
    image->width = png.width;
    image->height = png.height;
    png_image_free(&png);
    return status;
}
