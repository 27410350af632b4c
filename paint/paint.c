/* paint/paint.c - the look of a model, and laying it onto the surface that becomes a pattern. */
#include "paint/look.h"

#include "core/memory.h"
#include "mesh/closest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Small images with large dots are drawn dot by dot, and are to be seen so. */
#define CRISP_WIDTH 128
#define CRISP_MM    0.5

/* ---- is there anything to print? ------------------------------------------------------------ */

/* Whether `count` bytes in threes are of one colour. */
static bool all_alike(const uint8_t *rgb, size_t count) {
    for (size_t i = 1; i < count; i++)
        if (memcmp(rgb, rgb + 3 * i, 3) != 0)
            return false;
    return true;
}

static int by_value(const void *left, const void *right) {
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/* Different ones among them; they are sorted. */
static uint32_t count_different(uint32_t *colours, size_t count) {
    uint32_t found = count > 0;
    qsort(colours, count, sizeof *colours, by_value);
    for (size_t i = 1; i < count; i++)
        found += colours[i] != colours[i - 1];
    return found;
}

/* The plain colours that faces have, white among them where some have none. */
static ktg_status count_plain(ktg_context *context, const ktg_paint *paint, uint32_t *colours) {
    const ktg_mesh *model = paint->model;
    uint32_t none = paint->source_count - 1;
    size_t count = 0;
    uint32_t *found = ktg_new(context, paint->source_count, uint32_t);
    bool *used = ktg_new(context, paint->source_count, bool);
    for (uint32_t f = 0; found && used && f < model->face_count; f++) {
        uint32_t material = model->face_material ? model->face_material[f] : none;
        used[material < none && paint->sources[material].is_plain ? material : none] = true;
    }
    for (uint32_t k = 0; found && used && k <= none; k++) {
        const uint8_t *rgb = paint->sources[k].rgb;
        if (used[k])
            found[count++] = (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
    }
    *colours = found && used ? count_different(found, count) : 0;
    ktg_status status = found && used ? KTG_OK : KTG_MEMORY;
    ktg_free(found);
    ktg_free(used);
    return status;
}

static bool has_any_plain(const ktg_paint *paint) {
    for (uint32_t k = 0; k < paint->source_count; k++)
        if (paint->sources[k].is_plain)
            return true;
    return false;
}

/* What has one colour all over is made of paper of that colour. */
static ktg_status is_worth(ktg_context *context, const ktg_paint *paint, bool plain,
                           ktg_paint_report *report, bool *worth) {
    const ktg_mesh *model = paint->model;
    bool own = ktg_paint_has_own_colours(model), many;
    KTG_TRY(count_plain(context, paint, &report->colours));
    report->own_colours = own;
    if (own)
        many = model->face_colours ? !all_alike(model->face_colours, model->face_count)
                                   : !all_alike(model->vertex_colours, model->vertex_count);
    else
        many = report->colours > 1;
    *worth = paint->image_count > 0 || many || (plain && (own || has_any_plain(paint)));
    return KTG_OK;
}

/* ---- making it ----------------------------------------------------------------------------- */

static ktg_status fill(ktg_context *context, const ktg_mesh *mesh, const char *model,
                       const ktg_paint_options *options, ktg_paint *paint, ktg_paint_report *report,
                       bool *worth) {
    KTG_TRY(ktg_mesh_copy(context, mesh, &paint->model));
    KTG_TRY(ktg_paint_read_sources(context, paint, model, options->anywhere, report));
    return is_worth(context, paint, options->plain, report, worth);
}

ktg_status ktg_paint_new(ktg_context *context, const ktg_mesh *mesh, const char *model,
                         const ktg_paint_options *options, ktg_paint **paint,
                         ktg_paint_report *report) {
    static const ktg_paint_options defaults = {false, false};
    ktg_paint_report own = {0};
    bool worth = false;
    *paint = NULL;
    bool materials = mesh->face_material && mesh->material_library;
    if (!ktg_paint_has_own_colours(mesh) && !materials && !mesh->texture_file)
        return KTG_OK;
    ktg_paint *made = ktg_new(context, 1, ktg_paint);
    if (!made)
        return KTG_MEMORY;
    ktg_status status =
        fill(context, mesh, model, options ? options : &defaults, made, &own, &worth);
    if (report)
        *report = own;
    if (status != KTG_OK || !worth)
        ktg_paint_free(&made);
    *paint = made;
    return status;
}

static void drop_surface(ktg_paint *paint) {
    ktg_free(paint->looks);
    ktg_free(paint->corners);
    paint->looks = NULL;
    paint->corners = NULL;
    paint->face_count = 0;
}

void ktg_paint_free(ktg_paint **paint) {
    if (!paint || !*paint)
        return;
    ktg_paint *p = *paint;
    drop_surface(p);
    for (size_t i = 0; i < p->image_count; i++) {
        ktg_image_free(&p->images[i]);
        ktg_free(p->image_paths[i]);
    }
    ktg_free(p->images);
    ktg_free(p->image_paths);
    ktg_free(p->sources);
    ktg_free(p->model_looks);
    ktg_closest_free(&p->closest);
    ktg_mesh_free(&p->model);
    ktg_free(p);
    *paint = NULL;
}

/* ---- laying it on -------------------------------------------------------------------------- */

static bool is_the_model(const ktg_mesh *model, const ktg_mesh *surface) {
    return model->face_count == surface->face_count &&
           model->vertex_count == surface->vertex_count &&
           memcmp(model->faces, surface->faces, 3 * sizeof *model->faces * model->face_count) == 0;
}

/* A surface that says nothing of materials where the model does can only be asked point by point.
 */
static bool says_materials(const ktg_mesh *model, const ktg_mesh *surface) {
    return !model->face_material ||
           (surface->face_material && surface->materials.count == model->materials.count);
}

static ktg_status take_corners(ktg_context *context, ktg_paint *paint, const ktg_mesh *surface) {
    size_t count = 3 * (size_t)surface->face_count;
    paint->corners = ktg_new(context, count, ktg_vec3);
    if (!paint->corners)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++)
        paint->corners[i] = surface->positions[surface->faces[i]];
    return KTG_OK;
}

/* The tree is asked once here, so that nothing is left to be made by the first of many threads. */
static ktg_status prepare_closest(ktg_context *context, ktg_paint *paint) {
    ktg_vec3 point;
    if (!paint->model_looks)
        KTG_TRY(ktg_paint_find_looks(context, paint, paint->model, true, &paint->model_looks));
    if (!paint->closest)
        KTG_TRY(ktg_closest_new(context, paint->model, &paint->closest));
    return ktg_closest_point(context, paint->closest, paint->model->positions[0], &point, NULL);
}

/* The mean size of an image's dots on the faces that show it. */
static void find_crisp(ktg_paint *paint, const ktg_look *looks, const ktg_vec3 *corners,
                       const uint32_t *faces, uint32_t count, double mm_per_unit) {
    for (uint32_t k = 0; k < paint->source_count; k++) {
        ktg_source *source = &paint->sources[k];
        double dots = 0, area = 0;
        if (!source->image || source->image->width > CRISP_WIDTH ||
            source->image->height > CRISP_WIDTH)
            continue;
        for (uint32_t f = 0; f < count; f++) {
            const ktg_look *look = &looks[f];
            ktg_vec3 c[3];
            if (look->kind != KTG_LOOK_IMAGE || look->source != k)
                continue;
            for (size_t i = 0; i < 3; i++)
                c[i] = corners[faces ? faces[3 * (size_t)f + i] : 3 * (size_t)f + i];
            dots += fabs(ktg_cross2(ktg_sub2(look->dots[1], look->dots[0]),
                                    ktg_sub2(look->dots[2], look->dots[0])));
            area += ktg_length3(ktg_cross3(ktg_sub3(c[1], c[0]), ktg_sub3(c[2], c[0])));
        }
        source->crisp = sqrt(area) * mm_per_unit > CRISP_MM * sqrt(dots);
    }
}

static ktg_status find_looks(ktg_context *context, ktg_paint *paint, const ktg_mesh *surface,
                             uint32_t *sampled) {
    bool whole = is_the_model(paint->model, surface);
    *sampled = 0;
    if (whole || says_materials(paint->model, surface)) {
        KTG_TRY(ktg_paint_find_looks(context, paint, whole ? paint->model : surface, whole,
                                     &paint->looks));
    } else {
        paint->looks = ktg_new(context, surface->face_count, ktg_look);
        for (uint32_t f = 0; paint->looks && f < surface->face_count; f++)
            paint->looks[f].kind = KTG_LOOK_CLOSEST;
    }
    if (!paint->looks)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < surface->face_count; f++)
        *sampled += paint->looks[f].kind == KTG_LOOK_CLOSEST;
    return *sampled > 0 ? prepare_closest(context, paint) : KTG_OK;
}

ktg_status ktg_paint_lay(ktg_context *context, ktg_paint *paint, const ktg_mesh *surface,
                         double mm_per_unit, ktg_paint_report *report) {
    uint32_t sampled;
    drop_surface(paint);
    ktg_status status = take_corners(context, paint, surface);
    if (status == KTG_OK)
        status = find_looks(context, paint, surface, &sampled);
    if (status != KTG_OK) {
        drop_surface(paint);
        return status;
    }
    paint->face_count = surface->face_count;
    if (paint->model_looks)
        find_crisp(paint, paint->model_looks, paint->model->positions, paint->model->faces,
                   paint->model->face_count, mm_per_unit);
    else
        find_crisp(paint, paint->looks, paint->corners, NULL, paint->face_count, mm_per_unit);
    if (report)
        report->faces_sampled = sampled;
    return KTG_OK;
}

uint32_t ktg_paint_face_count(const ktg_paint *paint) {
    return paint ? paint->face_count : 0;
}

bool ktg_paint_is_picture(const ktg_paint *paint) {
    return paint->image_count > 0 || paint->model->vertex_colours != NULL;
}
