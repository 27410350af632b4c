/* paint/material.h - MTL files, and where the files they name are (paint only). */
#ifndef KTG_PAINT_MATERIAL_H
#define KTG_PAINT_MATERIAL_H

#include "core/vec.h"
#include "paint/image.h"

/* What an MTL file says of a material, as far as it can be printed. */
typedef struct ktg_material {
    char *name;
    bool has_colour;
    uint8_t rgb[3]; /* Kd */
    char *image;    /* map_Kd as written, or NULL */
    ktg_image_wrap wrap;
    ktg_vec2 scale, offset; /* -s, -o: texture coordinates are multiplied, then moved */
} ktg_material;

typedef struct ktg_materials {
    size_t count, capacity;
    ktg_material *items;
} ktg_materials;

/* Adds the materials of an MTL file. Lines that make no sense are passed over, as all programs do.
 * KTG_FILE, KTG_LIMIT. */
KTG_NODISCARD ktg_status ktg_materials_read(ktg_context *context, const char *path,
                                            ktg_materials *materials);
void ktg_materials_free(ktg_materials *materials);

/* ---- find.c -------------------------------------------------------------------------------- */

/* Where a model's files may be. */
typedef struct ktg_paint_root {
    const char *model; /* the model's path */
    bool anywhere;
} ktg_paint_root;

/* Finds the file `name` that the file `from` (a path) refers to: from its folder, with \ for / too,
 * else by its bare name in that folder. *path, without links, is freed with ktg_free; NULL when
 * there is none that may be read, and *why says why ("is not there"). */
KTG_NODISCARD ktg_status ktg_paint_find_file(ktg_context *context, const ktg_paint_root *place,
                                             const char *from, const char *name, char **path,
                                             const char **why);

#endif
