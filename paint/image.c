/* paint/image.c - images as they are looked at: levels of falling size, and the colour at a point.
 */
#include "paint/image.h"

#include "core/file.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

/* An image of the largest size that is taken has no more bytes than this, whatever its format. */
#define MOST_BYTES ((size_t)1 << 29)

ktg_status ktg_image_check_size(ktg_context *context, const char *path, uint32_t width,
                                uint32_t height, uint64_t most) {
    if (width == 0 || height == 0)
        return ktg_fail(context, KTG_FORMAT, "%s: the image is empty", path);
    if ((uint64_t)width * height > most)
        return ktg_fail(context, KTG_LIMIT,
                        "%s: %u x %u dots are more than are taken (%.0f million): make the image "
                        "smaller",
                        path, width, height, (double)most / 1e6);
    return KTG_OK;
}

/* ---- levels -------------------------------------------------------------------------------- */

/* Each dot is the mean of four; along odd edges two of them are the same. */
static void halve(const ktg_image_level *from, ktg_image_level *to) {
    for (uint32_t y = 0; y < to->height; y++) {
        uint32_t next = 2 * y + 1 < from->height ? 1 : 0;
        const uint8_t *above = from->rgb + 3 * (size_t)from->width * (2 * (size_t)y);
        const uint8_t *below = above + 3 * (size_t)from->width * next;
        uint8_t *out = to->rgb + 3 * (size_t)to->width * y;
        for (uint32_t x = 0; x < to->width; x++) {
            size_t left = 6 * (size_t)x, right = 2 * x + 1 < from->width ? left + 3 : left;
            for (size_t k = 0; k < 3; k++)
                out[3 * (size_t)x + k] = (uint8_t)((above[left + k] + above[right + k] +
                                                    below[left + k] + below[right + k] + 2) /
                                                   4);
        }
    }
}

static ktg_status make_levels(ktg_context *context, ktg_image *image) {
    while (image->level_count < KTG_IMAGE_LEVELS) {
        const ktg_image_level *last = &image->levels[image->level_count - 1];
        ktg_image_level *next = &image->levels[image->level_count];
        if (last->width <= 1 && last->height <= 1)
            break;
        next->width = (last->width + 1) / 2;
        next->height = (last->height + 1) / 2;
        next->rgb = ktg_alloc(context, (size_t)next->width * next->height, 3);
        if (!next->rgb)
            return KTG_MEMORY;
        image->level_count++;
        halve(last, next);
    }
    return KTG_OK;
}

/* ---- reading ------------------------------------------------------------------------------- */

static ktg_status decode(ktg_context *context, const char *path, const char *bytes, size_t size,
                         ktg_image *image) {
    if (size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0)
        return ktg_image_read_png(context, path, bytes, size, image);
    if (size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0)
        return ktg_image_read_jpeg(context, path, bytes, size, image);
    return ktg_fail(context, KTG_FORMAT,
                    "%s: is neither PNG nor JPEG; convert the image to one of them", path);
}

ktg_status ktg_image_read(ktg_context *context, const char *path, ktg_image **image) {
    char *bytes = NULL;
    size_t size = 0;
    *image = NULL;
    KTG_TRY(ktg_file_read(context, path, MOST_BYTES, &bytes, &size));
    ktg_image *made = ktg_new(context, 1, ktg_image);
    ktg_status status = made ? decode(context, path, bytes, size, made) : KTG_MEMORY;
    ktg_free(bytes);
    if (status == KTG_OK) {
        made->level_count = 1;
        status = make_levels(context, made);
    }
    if (status != KTG_OK)
        ktg_image_free(&made);
    *image = made;
    return status;
}

void ktg_image_free(ktg_image **image) {
    if (!image || !*image)
        return;
    for (size_t k = 0; k < KTG_IMAGE_LEVELS; k++)
        ktg_free((*image)->levels[k].rgb);
    ktg_free(*image);
    *image = NULL;
}

void ktg_image_shrink(ktg_image *image) {
    if (image->level_count < 2)
        return;
    ktg_free(image->levels[0].rgb);
    image->level_count--;
    memmove(image->levels, image->levels + 1, image->level_count * sizeof *image->levels);
    image->levels[image->level_count] = (ktg_image_level){0};
}

/* ---- looking ------------------------------------------------------------------------------- */

/* The index of a dot along an axis of `count` dots. */
static uint32_t wrapped(double at, uint32_t count, ktg_image_wrap wrap) {
    if (wrap == KTG_WRAP_REPEAT)
        at -= floor(at / count) * count;
    return at <= 0 ? 0 : at >= count ? count - 1 : (uint32_t)at;
}

static const uint8_t *dot_at(const ktg_image_level *level, uint32_t x, uint32_t y) {
    return level->rgb + 3 * ((size_t)y * level->width + x);
}

/* Level 0 repeats after its own width, which need not be a multiple of the level's dots. */
static ktg_vec2 brought_in(const ktg_image *image, ktg_vec2 at, ktg_image_wrap wrap) {
    double w = image->levels[0].width, h = image->levels[0].height;
    if (wrap == KTG_WRAP_REPEAT)
        return (ktg_vec2){at.x - floor(at.x / w) * w, at.y - floor(at.y / h) * h};
    return (ktg_vec2){ktg_max(0, ktg_min(w, at.x)), ktg_max(0, ktg_min(h, at.y))};
}

void ktg_image_colour(const ktg_image *image, uint32_t number, ktg_vec2 at, ktg_image_wrap wrap,
                      bool crisp, double rgb[3]) {
    const ktg_image_level *level = &image->levels[number];
    at = ktg_mul2(brought_in(image, at, wrap), 1.0 / (double)((uint32_t)1 << number));
    double left = crisp ? floor(at.x) : floor(at.x - 0.5);
    double top = crisp ? floor(at.y) : floor(at.y - 0.5);
    double s = crisp ? 0 : at.x - 0.5 - left, t = crisp ? 0 : at.y - 0.5 - top;
    uint32_t x0 = wrapped(left, level->width, wrap), x1 = wrapped(left + 1, level->width, wrap);
    uint32_t y0 = wrapped(top, level->height, wrap), y1 = wrapped(top + 1, level->height, wrap);
    const uint8_t *a = dot_at(level, x0, y0), *b = dot_at(level, x1, y0);
    const uint8_t *c = dot_at(level, x0, y1), *d = dot_at(level, x1, y1);
    for (size_t k = 0; k < 3; k++)
        rgb[k] = (1 - t) * ((1 - s) * a[k] + s * b[k]) + t * ((1 - s) * c[k] + s * d[k]);
}
