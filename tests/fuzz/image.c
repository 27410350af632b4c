/* tests/fuzz/image.c - any bytes as an image of a model's surface, PNG or JPEG by their content. */
#include "paint/image.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>

/* Beyond the image, too: what is asked for may lie anywhere. */
static void look_at_dots(const ktg_image *image) {
    static const double places[] = {0, 0.5, -1e9, 1e300, 3.25};
    for (uint32_t level = 0; level < image->level_count; level++)
        for (int i = 0; i < 25; i++) {
            double rgb[3];
            ktg_vec2 at = {places[i % 5], places[i / 5]};
            ktg_image_colour(image, level, at, i % 2 ? KTG_WRAP_REPEAT : KTG_WRAP_CLAMP, i % 3 == 0,
                             rgb);
            for (int k = 0; k < 3; k++)
                fuzz_expect(rgb[k] >= 0 && rgb[k] <= 255, "a colour is outside of 0 to 255");
        }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ktg_context *context = fuzz_context();
    ktg_image *image;
    if (fuzz_succeeded(context, ktg_image_read(context, fuzz_file("/image", data, size), &image))) {
        fuzz_expect(image->width > 0 && image->height > 0 && image->level_count > 0,
                    "an image without dots is read");
        look_at_dots(image);
    } else {
        fuzz_expect(!image, "an image comes with a failure");
    }
    ktg_image_free(&image);
    ktg_context_free(&context);
    return 0;
}
