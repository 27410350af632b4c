/* paint/look.h - what each face looks like (paint only). */
#ifndef KTG_PAINT_LOOK_H
#define KTG_PAINT_LOOK_H

#include "paint/image.h"
#include "paint/paint.h"

typedef enum ktg_look_kind {
    KTG_LOOK_PLAIN,   /* one colour */
    KTG_LOOK_CORNERS, /* a colour for each corner */
    KTG_LOOK_IMAGE,
    KTG_LOOK_CLOSEST /* as the closest point of the model */
} ktg_look_kind;

typedef struct ktg_look {
    uint8_t kind;
    uint8_t borders;   /* bit k: beyond the edge from corner k to the next the image shows something
                          else; bit 3 + k: at corner k there is such an edge, of this face or another
                        */
    uint32_t source;   /* of an image */
    uint8_t rgb[3][3]; /* of the corners; of a plain face the first */
    ktg_vec2 dots[3];  /* of the corners, in dots of the image's level 0, y down */
} ktg_look;

/* Where faces of one material take their colour from. */
typedef struct ktg_source {
    const ktg_image *image; /* or NULL: plain */
    ktg_image_wrap wrap;
    ktg_vec2 scale, offset;
    bool crisp;     /* its dots are printed as squares */
    bool is_plain;  /* it has a colour */
    uint8_t rgb[3]; /* white where nobody says */
} ktg_source;

typedef struct ktg_closest ktg_closest;

struct ktg_paint {
    ktg_mesh *model;
    uint32_t source_count;
    ktg_source *sources; /* one for each material of the model, and a last one for faces without */
    size_t image_count, image_capacity;
    ktg_image **images;
    char **image_paths; /* image_count: absolute */
    size_t path_capacity;
    ktg_look *model_looks; /* of the model's faces; NULL until they are needed */
    ktg_closest *closest;  /* likewise */

    uint32_t face_count; /* of the surface it is laid on */
    ktg_look *looks;
    ktg_vec3 *corners; /* 3 face_count */
};

/* Colours of vertices, or faces. */
static inline bool ktg_paint_has_own_colours(const ktg_mesh *mesh) {
    return mesh->vertex_colours || mesh->face_colours;
}

/* Fills sources and images from the model's MTL files. */
KTG_NODISCARD ktg_status ktg_paint_read_sources(ktg_context *context, ktg_paint *paint,
                                                const char *model, bool anywhere,
                                                ktg_paint_report *report);

/* The looks of all faces of a mesh with the model's materials; `whole`: it is the model itself, so
 * that colours of vertices hold. *looks is freed with ktg_free. */
KTG_NODISCARD ktg_status ktg_paint_find_looks(ktg_context *context, const ktg_paint *paint,
                                              const ktg_mesh *mesh, bool whole, ktg_look **looks);

#endif
