/* paint/image_jpeg.c - JPEG in and out through libjpeg, which jumps back here when it fails. */
#include "paint/image.h"
#include "paint/paint.h"

#include "core/memory.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#define QUALITY 92

/* libjpeg's errors, with the way back. */
typedef struct jpeg_errors {
    struct jpeg_error_mgr manager; /* first: libjpeg hands back a pointer to it */
    jmp_buf back;
    char text[JMSG_LENGTH_MAX];
} jpeg_errors;

static void fail(j_common_ptr jpeg) {
    jpeg_errors *errors = (jpeg_errors *)jpeg->err;
    jpeg->err->format_message(jpeg, errors->text);
    longjmp(errors->back, 1);
}

/* Counted by libjpeg; nothing is printed. */
static void say_nothing(j_common_ptr jpeg) {
    (void)jpeg;
}

static struct jpeg_error_mgr *quiet(jpeg_errors *errors) {
    struct jpeg_error_mgr *manager = jpeg_std_error(&errors->manager);
    manager->error_exit = fail;
    manager->output_message = say_nothing;
    return manager;
}

/* ---- in ------------------------------------------------------------------------------------ */

/* Photoshop writes ink, inverted. */
static void ink_to_rgb(uint8_t *row, uint32_t width, const uint8_t *ink) {
    for (size_t x = 0; x < width; x++)
        for (size_t k = 0; k < 3; k++)
            row[3 * x + k] = (uint8_t)(ink[4 * x + k] * ink[4 * x + 3] / 255);
}

/* Larger images than are taken come in at half or a quarter of their width; those that keep all of
 * their coefficients in memory (progressive ones) may have half as many dots. */
static ktg_status choose_scale(ktg_context *context, const char *path,
                               struct jpeg_decompress_struct *jpeg) {
    uint64_t most = jpeg_has_multiple_scans(jpeg) ? KTG_IMAGE_MOST / 2 : 4 * KTG_IMAGE_MOST;
    KTG_TRY(ktg_image_check_size(context, path, jpeg->image_width, jpeg->image_height, most));
    jpeg->scale_num = 1;
    jpeg->scale_denom = 1;
    while ((uint64_t)jpeg->image_width * jpeg->image_height >
           KTG_IMAGE_MOST * jpeg->scale_denom * jpeg->scale_denom)
        jpeg->scale_denom *= 2;
    bool is_ink = jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK;
    jpeg->out_color_space = is_ink ? JCS_CMYK : JCS_RGB;
    return KTG_OK;
}

static void read_rows(struct jpeg_decompress_struct *jpeg, ktg_image_level *level, uint8_t *ink) {
    while (jpeg->output_scanline < jpeg->output_height) {
        uint8_t *row = level->rgb + 3 * (size_t)level->width * jpeg->output_scanline;
        JSAMPROW into = ink ? ink : row;
        jpeg_read_scanlines(jpeg, &into, 1);
        if (ink)
            ink_to_rgb(row, level->width, ink);
    }
}

/* What is taken from libjpeg's side of the jump. */
typedef struct jpeg_read {
    struct jpeg_decompress_struct jpeg;
    jpeg_errors errors;
    uint8_t *ink; /* a row, where it is ink */
} jpeg_read;

static ktg_status decode(ktg_context *context, const char *path, jpeg_read *r, const char *bytes,
                         size_t size, ktg_image *image) {
    struct jpeg_decompress_struct *jpeg = &r->jpeg;
    ktg_image_level *level = &image->levels[0];
    if (setjmp(r->errors.back))
        return ktg_fail(context, KTG_FORMAT, "%s: the JPEG is damaged: %s", path, r->errors.text);
    jpeg_mem_src(jpeg, (const unsigned char *)bytes, size);
    jpeg_read_header(jpeg, TRUE);
    KTG_TRY(choose_scale(context, path, jpeg));
    jpeg_start_decompress(jpeg);
    image->width = jpeg->image_width;
    image->height = jpeg->image_height;
    level->width = jpeg->output_width;
    level->height = jpeg->output_height;
    level->rgb = ktg_alloc(context, (size_t)level->width * level->height, 3);
    if (jpeg->out_color_space == JCS_CMYK)
        r->ink = ktg_alloc(context, level->width, 4);
    if (!level->rgb || (jpeg->out_color_space == JCS_CMYK && !r->ink))
        return KTG_MEMORY;
    read_rows(jpeg, level, r->ink);
    jpeg_finish_decompress(jpeg);
    if (jpeg->err->num_warnings > 0)
        ktg_log(context, KTG_LOG_WARNING, "%s: the JPEG is damaged or cut off; the rest is used",
                path);
    return KTG_OK;
}

ktg_status ktg_image_read_jpeg(ktg_context *context, const char *path, const char *bytes,
                               size_t size, ktg_image *image) {
    jpeg_read *r = ktg_new(context, 1, jpeg_read);
    if (!r)
        return KTG_MEMORY;
    r->jpeg.err = quiet(&r->errors);
    if (setjmp(r->errors.back)) {
        ktg_free(r);
        return ktg_fail(context, KTG_MEMORY, "%s: not enough memory to read the JPEG", path);
    }
    jpeg_create_decompress(&r->jpeg);
    ktg_status status = decode(context, path, r, bytes, size, image);
    jpeg_destroy_decompress(&r->jpeg);
    ktg_free(r->ink);
    ktg_free(r);
    return status;
}

/* ---- out ----------------------------------------------------------------------------------- */

/* What is taken from libjpeg's side of the jump. */
typedef struct jpeg_write {
    struct jpeg_compress_struct jpeg;
    jpeg_errors errors;
    unsigned char *bytes; /* libjpeg's */
    unsigned long size;
} jpeg_write;

static ktg_status encode(ktg_context *context, jpeg_write *w, const uint8_t *rgb, uint32_t width,
                         uint32_t height) {
    struct jpeg_compress_struct *jpeg = &w->jpeg;
    if (setjmp(w->errors.back))
        return ktg_fail(context, KTG_MEMORY, "the picture cannot be packed: %s", w->errors.text);
    jpeg_create_compress(jpeg);
    jpeg_mem_dest(jpeg, &w->bytes, &w->size);
    jpeg->image_width = width;
    jpeg->image_height = height;
    jpeg->input_components = 3;
    jpeg->in_color_space = JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, QUALITY, TRUE);
    jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(jpeg, TRUE);
    while (jpeg->next_scanline < height) {
        JSAMPROW row = (JSAMPROW)(rgb + 3 * (size_t)width * jpeg->next_scanline);
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
    return KTG_OK;
}

ktg_status ktg_paint_jpeg(ktg_context *context, const uint8_t *rgb, uint32_t width, uint32_t height,
                          unsigned char **bytes, size_t *size) {
    *bytes = NULL;
    *size = 0;
    if (width == 0 || height == 0 || width > JPEG_MAX_DIMENSION || height > JPEG_MAX_DIMENSION)
        return ktg_fail(context, KTG_ARGUMENT, "a JPEG of %u x %u dots cannot be made", width,
                        height);
    jpeg_write *w = ktg_new(context, 1, jpeg_write);
    if (!w)
        return KTG_MEMORY;
    w->jpeg.err = quiet(&w->errors);
    ktg_status status = encode(context, w, rgb, width, height);
    jpeg_destroy_compress(&w->jpeg);
    if (status == KTG_OK) {
        *bytes = ktg_copy_array(context, w->bytes, w->size, 1);
        *size = w->size;
        status = *bytes ? KTG_OK : KTG_MEMORY;
    }
    free(w->bytes);
    ktg_free(w);
    return status;
}
