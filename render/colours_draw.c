/* render/colours_draw.c - the colours of a sheet on its page, and ink that is seen on them. */
#include "render/colours.h"

#include "core/memory.h"

#include <string.h>

/* Darker grounds get light ink (relative luminance, Rec. 709). */
#define DARK 0.42
/* How much of the ground shows through a fold's ink. */
#define FOLD_INK 0.6

/* ---- the picture --------------------------------------------------------------------------- */

/* Pictures are packed as JPEG; plain colours pack better without. */
static ktg_status attach_jpeg(const ktg_drawing *drawing, const ktg_colours *colours,
                              cairo_surface_t *surface) {
    size_t count = (size_t)colours->width * colours->height, size;
    unsigned char *bytes;
    uint8_t *rgb = ktg_alloc(drawing->context, count, 3);
    if (!rgb)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++)
            rgb[3 * i + k] = (uint8_t)(colours->dots[i] >> (16 - 8 * k));
    ktg_status status =
        ktg_paint_jpeg(drawing->context, rgb, colours->width, colours->height, &bytes, &size);
    ktg_free(rgb);
    if (status != KTG_OK)
        return status;
    if (cairo_surface_set_mime_data(surface, CAIRO_MIME_TYPE_JPEG, bytes, size, ktg_free, bytes) ==
        CAIRO_STATUS_SUCCESS)
        return KTG_OK;
    ktg_free(bytes);
    return ktg_fail(drawing->context, KTG_MEMORY, "not enough memory for the colours of a sheet");
}

ktg_status ktg_colours_surface(const ktg_drawing *drawing, const ktg_colours *colours, bool packed,
                               cairo_surface_t **made) {
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)colours->width, (int)colours->height);
    unsigned char *data = cairo_image_surface_get_data(surface);
    ptrdiff_t stride = cairo_image_surface_get_stride(surface);
    cairo_surface_flush(surface);
    for (uint32_t y = 0; data && y < colours->height; y++)
        memcpy(data + y * stride, colours->dots + (size_t)y * colours->width,
               colours->width * sizeof *colours->dots);
    cairo_surface_mark_dirty(surface);
    *made = surface;
    return packed && ktg_paint_is_picture(drawing->options.paint)
               ? attach_jpeg(drawing, colours, surface)
               : KTG_OK;
}

static ktg_status draw(const ktg_page *page, bool is_image) {
    const ktg_colours *colours = page->colours;
    cairo_surface_t *surface;
    ktg_status status = ktg_colours_surface(page->drawing, colours, !is_image, &surface);
    if (status == KTG_OK) {
        cairo_save(page->cairo);
        cairo_translate(page->cairo, colours->corner.x, colours->corner.y);
        cairo_scale(page->cairo, 1 / colours->dots_per_mm, 1 / colours->dots_per_mm);
        cairo_set_source_surface(page->cairo, surface, 0, 0);
        cairo_paint(page->cairo);
        cairo_restore(page->cairo);
    }
    cairo_surface_destroy(surface);
    return status;
}

ktg_status ktg_colours_begin(ktg_page *page) {
    double dots = KTG_COLOUR_DOTS_PER_MM, right = 1, down = 0;
    cairo_surface_t *target = cairo_get_target(page->cairo);
    bool is_image = cairo_surface_get_type(target) == CAIRO_SURFACE_TYPE_IMAGE;
    cairo_user_to_device_distance(page->cairo, &right, &down);
    if (is_image && right > 0)
        dots = fmin(dots, right);
    KTG_TRY(ktg_colours_make(page->drawing, page->number, dots, &page->colours));
    return page->colours ? draw(page, is_image) : KTG_OK;
}

/* ---- ink ----------------------------------------------------------------------------------- */

/* False where the page has no colours there. */
static bool add_ground(const ktg_colours *colours, ktg_vec2 at, double rgb[3]) {
    double x = floor((at.x - colours->corner.x) * colours->dots_per_mm);
    double y = floor((at.y - colours->corner.y) * colours->dots_per_mm);
    if (!(x >= 0) || !(y >= 0) || x >= colours->width || y >= colours->height)
        return false;
    uint32_t dot = colours->dots[(size_t)y * colours->width + (size_t)x];
    for (size_t k = 0; k < 3; k++)
        rgb[k] += (dot >> (16 - 8 * k) & 255) / 255.0;
    return true;
}

bool ktg_ground_of(const ktg_page *page, ktg_vec2 from, ktg_vec2 to, double rgb[3]) {
    size_t steps = 8, count = 0;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (size_t i = 0; page->colours && i <= steps; i++)
        count += add_ground(page->colours,
                            ktg_madd2(from, (double)i / (double)steps, ktg_sub2(to, from)), rgb);
    for (size_t k = 0; k < 3; k++)
        rgb[k] = count > 0 ? rgb[k] / (double)count : 1;
    return count > 0 && rgb[0] + rgb[1] + rgb[2] < 2.99;
}

bool ktg_ground_is_dark(const double rgb[3]) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] < DARK;
}

void ktg_ground_set_fold_ink(const ktg_page *page, ktg_vec2 from, ktg_vec2 to) {
    double rgb[3];
    if (!ktg_ground_of(page, from, to, rgb))
        return;
    double grey = ktg_ground_is_dark(rgb) ? 1 : 0;
    cairo_set_source_rgba(page->cairo, grey, grey, grey, FOLD_INK);
}
