/* paint/image.h - an image with smaller and smaller versions of itself (paint only). */
#ifndef KTG_PAINT_IMAGE_H
#define KTG_PAINT_IMAGE_H

#include "core/vec.h"

/* More dots are refused; JPEG of up to four times as many are halved on the way in. */
#define KTG_IMAGE_MOST ((uint64_t)1 << 27)

#define KTG_IMAGE_LEVELS 16

/* Rows from the top, 3 bytes a dot. */
typedef struct ktg_image_level {
    uint32_t width, height;
    uint8_t *rgb;
} ktg_image_level;

/* Level k + 1 has half the width and height of level k, rounded up (Williams 1983). */
typedef struct ktg_image {
    uint32_t level_count;
    ktg_image_level levels[KTG_IMAGE_LEVELS];
    uint32_t width, height; /* of the file; level 0 may be smaller */
} ktg_image;

/* Reads a PNG or JPEG, whichever the content says, and makes its levels. KTG_FILE, KTG_FORMAT,
 * KTG_LIMIT with a sentence that begins with the path. */
KTG_NODISCARD ktg_status ktg_image_read(ktg_context *context, const char *path, ktg_image **image);
void ktg_image_free(ktg_image **image);

/* Lets go of the largest version, unless it is the only one: the next one is level 0 then. */
void ktg_image_shrink(ktg_image *image);

/* What happens beyond an image's edges. */
typedef enum ktg_image_wrap { KTG_WRAP_REPEAT, KTG_WRAP_CLAMP } ktg_image_wrap;

/* The colour at `at`, in dots of level 0 from the upper left corner, of the given level: between
 * the dots around it, or, when `crisp`, of the dot it lies in. Values 0 to 255. */
void ktg_image_colour(const ktg_image *image, uint32_t level, ktg_vec2 at, ktg_image_wrap wrap,
                      bool crisp, double rgb[3]);

/* ---- image_png.c, image_jpeg.c ------------------------------------------------------------- */

/* Fills width, height and level 0 from a file's content. */
KTG_NODISCARD ktg_status ktg_image_read_png(ktg_context *context, const char *path,
                                            const char *bytes, size_t size, ktg_image *image);
KTG_NODISCARD ktg_status ktg_image_read_jpeg(ktg_context *context, const char *path,
                                             const char *bytes, size_t size, ktg_image *image);

/* Fails unless that many dots can be taken. */
KTG_NODISCARD ktg_status ktg_image_check_size(ktg_context *context, const char *path,
                                              uint32_t width, uint32_t height, uint64_t most);

#endif
