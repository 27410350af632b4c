/* paint/sources.c - from a model's materials to colours and images. */
#include "paint/look.h"
#include "paint/material.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define SMALL_IMAGE ((uint64_t)1 << 20)

/* What reading takes along. */
typedef struct reading {
    ktg_context *context;
    ktg_paint *paint;
    ktg_paint_root place;
    ktg_materials materials;
    const ktg_material **sorted; /* materials.count, by name */
    size_t *first; /* materials.count: the library each begins in, as index into `libraries` */
    size_t first_capacity;
    char **libraries; /* paths */
    size_t library_count, library_capacity;
    uint64_t dots; /* of all images */
    ktg_paint_report *report;
} reading;

/* ---- libraries ----------------------------------------------------------------------------- */

static ktg_status take_library(reading *r, char *path) {
    size_t before = r->materials.count;
    ktg_status status =
        ktg_reserve(r->context, &r->libraries, &r->library_capacity, r->library_count + 1);
    if (status != KTG_OK) {
        ktg_free(path);
        return status;
    }
    r->libraries[r->library_count++] = path;
    KTG_TRY(ktg_materials_read(r->context, path, &r->materials));
    KTG_TRY(ktg_reserve(r->context, &r->first, &r->first_capacity, r->materials.count));
    for (size_t i = before; i < r->materials.count; i++)
        r->first[i] = r->library_count - 1;
    return KTG_OK;
}

/* Reads the library `name` when it is there; *why is NULL then. */
static ktg_status try_library(reading *r, const char *name, const char **why) {
    char *path;
    KTG_TRY(ktg_paint_find_file(r->context, &r->place, r->place.model, name, &path, why));
    if (!path)
        return KTG_OK;
    *why = NULL;
    return take_library(r, path);
}

/* The next name of a list, which ends in ".mtl" and may have blanks; *at moves on. */
static char *next_name(reading *r, const char **at) {
    const char *begin = *at + strspn(*at, " "), *end = begin;
    while (*end) {
        end += strcspn(end, " ");
        if (end - begin >= 4 && strncasecmp(end - 4, ".mtl", 4) == 0)
            break;
        end += strspn(end, " ");
    }
    *at = end;
    return ktg_copy_text(r->context, begin, (size_t)(end - begin));
}

static void tell_missing(const reading *r, const char *name, const char *why) {
    ktg_log(r->context, KTG_LOG_WARNING, "%s: the material file %s %s; its colours are left out",
            r->place.model, name, why);
}

/* What one mtllib line says: one file whose name has blanks, or several names. */
static ktg_status read_line(reading *r, const char *names) {
    const char *why = NULL;
    KTG_TRY(try_library(r, names, &why));
    const char *at = names;
    while (why && *at) {
        char *name = next_name(r, &at);
        if (!name)
            return KTG_MEMORY;
        const char *reason = NULL;
        ktg_status status = *name ? try_library(r, name, &reason) : KTG_OK;
        if (reason)
            tell_missing(r, name, reason);
        ktg_free(name);
        KTG_TRY(status);
    }
    return KTG_OK;
}

/* Calls `take` for each line of a text. */
static ktg_status for_each_line(reading *r, const char *text,
                                ktg_status (*take)(reading *, const char *)) {
    while (*text) {
        size_t length = strcspn(text, "\n");
        char *line = ktg_copy_text(r->context, text, length);
        if (!line)
            return KTG_MEMORY;
        ktg_status status = *line ? take(r, line) : KTG_OK;
        ktg_free(line);
        KTG_TRY(status);
        text += length + (text[length] == '\n');
    }
    return KTG_OK;
}

/* ---- images -------------------------------------------------------------------------------- */

/* Together, images take no more room than the largest one may; small ones stay as they are. */
static void make_room(reading *r, ktg_image *image) {
    for (;;) {
        uint64_t dots = (uint64_t)image->levels[0].width * image->levels[0].height;
        if (dots <= SMALL_IMAGE || r->dots + dots <= KTG_IMAGE_MOST) {
            r->dots += dots;
            return;
        }
        ktg_image_shrink(image);
    }
}

/* The image at `path` (taken over), read once however many materials share it. */
static ktg_status share_image(reading *r, char *path, const ktg_image **image) {
    ktg_paint *paint = r->paint;
    ktg_image *made = NULL;
    for (size_t i = 0; i < paint->image_count; i++)
        if (strcmp(paint->image_paths[i], path) == 0) {
            *image = paint->images[i];
            ktg_free(path);
            return KTG_OK;
        }
    ktg_status status =
        ktg_reserve(r->context, &paint->images, &paint->image_capacity, paint->image_count + 1);
    if (status == KTG_OK)
        status = ktg_reserve(r->context, &paint->image_paths, &paint->path_capacity,
                             paint->image_count + 1);
    if (status == KTG_OK)
        status = ktg_image_read(r->context, path, &made);
    if (status != KTG_OK) {
        ktg_free(path);
        return status;
    }
    make_room(r, made);
    paint->images[paint->image_count] = made;
    paint->image_paths[paint->image_count++] = path;
    *image = made;
    return KTG_OK;
}

/* The image `name` that the file `from` speaks of. A damaged one is no reason to print nothing. */
static ktg_status take_image(reading *r, const char *from, const char *name, ktg_source *source) {
    char *path;
    const char *why;
    KTG_TRY(ktg_paint_find_file(r->context, &r->place, from, name, &path, &why));
    ktg_status status = path ? share_image(r, path, &source->image) : KTG_FILE;
    if (status == KTG_OK || status == KTG_MEMORY || status == KTG_CANCELLED)
        return status;
    r->report->images_missing++;
    const char *instead = source->is_plain ? "in the material's colour" : "white";
    if (path)
        ktg_log(r->context, KTG_LOG_WARNING, "%s; its faces are printed %s",
                ktg_context_message(r->context), instead);
    else
        ktg_log(r->context, KTG_LOG_WARNING, "%s: the image %s %s; its faces are printed %s", from,
                name, why, instead);
    return KTG_OK;
}

/* ---- the whole ----------------------------------------------------------------------------- */

static int by_name(const void *left, const void *right) {
    const ktg_material *const *a = left, *const *b = right;
    int order = strcmp((*a)->name, (*b)->name);
    return order ? order : (*a > *b) - (*a < *b);
}

static ktg_status sort_materials(reading *r) {
    r->sorted = ktg_new(r->context, r->materials.count, const ktg_material *);
    if (!r->sorted)
        return KTG_MEMORY;
    for (size_t i = 0; i < r->materials.count; i++)
        r->sorted[i] = &r->materials.items[i];
    qsort(r->sorted, r->materials.count, sizeof *r->sorted, by_name);
    return KTG_OK;
}

/* The last material of that name, as programs that read from top to bottom have it; SIZE_MAX. */
static size_t find_material(const reading *r, const char *name) {
    size_t low = 0, high = r->materials.count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (strcmp(r->sorted[middle]->name, name) <= 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low > 0 && strcmp(r->sorted[low - 1]->name, name) == 0
               ? (size_t)(r->sorted[low - 1] - r->materials.items)
               : SIZE_MAX;
}

/* A PLY names images; where there are several, its materials are called like them. */
static bool names_images(const ktg_mesh *model) {
    return model->texture_file && !model->material_library;
}

static uint32_t count_sources(const ktg_mesh *model) {
    return names_images(model) && model->materials.count == 0 ? 1 : model->materials.count;
}

static ktg_status fill_from_names(reading *r) {
    const ktg_mesh *model = r->paint->model;
    for (uint32_t k = 0; model->uvs && k + 1 < r->paint->source_count; k++)
        KTG_TRY(
            take_image(r, r->place.model,
                       model->materials.count > 0 ? model->materials.text[k] : model->texture_file,
                       &r->paint->sources[k]));
    return KTG_OK;
}

/* Only materials that faces have are read. */
static ktg_status fill_source(reading *r, uint32_t number) {
    ktg_source *source = &r->paint->sources[number];
    size_t material = find_material(r, r->paint->model->materials.text[number]);
    if (material == SIZE_MAX)
        return KTG_OK;
    const ktg_material *m = &r->materials.items[material];
    source->is_plain = m->has_colour;
    if (m->has_colour)
        memcpy(source->rgb, m->rgb, 3);
    source->wrap = m->wrap;
    source->scale = m->scale;
    source->offset = m->offset;
    return m->image && r->paint->model->uvs
               ? take_image(r, r->libraries[r->first[material]], m->image, source)
               : KTG_OK;
}

static ktg_status fill_sources(reading *r, const bool *used) {
    const ktg_mesh *model = r->paint->model;
    if (names_images(model)) {
        KTG_TRY(fill_from_names(r));
    } else if (model->material_library && model->face_material) {
        KTG_TRY(for_each_line(r, model->material_library, read_line));
        KTG_TRY(sort_materials(r));
        for (uint32_t k = 0; k < model->materials.count; k++)
            if (used[k])
                KTG_TRY(fill_source(r, k));
    }
    r->report->images = (uint32_t)r->paint->image_count;
    return KTG_OK;
}

static void mark_used(const ktg_mesh *model, bool *used) {
    for (uint32_t f = 0; model->face_material && f < model->face_count; f++)
        if (model->face_material[f] < model->materials.count)
            used[model->face_material[f]] = true;
}

ktg_status ktg_paint_read_sources(ktg_context *context, ktg_paint *paint, const char *model,
                                  bool anywhere, ktg_paint_report *report) {
    size_t count = (size_t)count_sources(paint->model) + 1;
    paint->source_count = (uint32_t)count;
    bool *used = ktg_new(context, count, bool);
    paint->sources = ktg_new(context, count, ktg_source);
    reading r = {.context = context, .paint = paint, .place = {model, anywhere}, .report = report};
    ktg_status status = used && paint->sources ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (size_t k = 0; k < count; k++)
            paint->sources[k] = (ktg_source){.rgb = {255, 255, 255}, .scale = {1, 1}};
        mark_used(paint->model, used);
        status = fill_sources(&r, used);
    }
    for (size_t i = 0; i < r.library_count; i++)
        ktg_free(r.libraries[i]);
    ktg_free(r.libraries);
    ktg_free(r.first);
    ktg_free(r.sorted);
    ktg_free(used);
    ktg_materials_free(&r.materials);
    return status;
}
