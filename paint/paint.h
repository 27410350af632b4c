/* paint/paint.h - what a model's surface looks like: its images, its materials' colours, the
 * colours of its vertices, and where each point of a pattern's surface takes its own from.
 *
 *     ktg_paint_new       once, from the repaired model: reads MTL files and images
 *     ktg_paint_lay       onto the faces that were unfolded or flattened
 *     ktg_render_...      prints it (ktg_render_options.paint)
 */
#ifndef KTG_PAINT_PAINT_H
#define KTG_PAINT_PAINT_H

#include "core/core.h"
#include "mesh/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The look of one model. After ktg_paint_lay it is only read, by any number of threads. */
typedef struct ktg_paint ktg_paint;

typedef struct ktg_paint_options {
    bool anywhere; /* MTL files and images outside the model's folder are read, too; false */
    bool plain;    /* one colour all over is paint, too, not just the paper's; false */
} ktg_paint_options;

typedef struct ktg_paint_report {
    uint32_t images;         /* that were read */
    uint32_t images_missing; /* not there, refused, damaged or too large: each is a warning */
    uint32_t colours;        /* different plain colours of faces */
    bool own_colours;        /* vertices, or faces, have colours of their own */
    uint32_t faces_sampled;  /* by ktg_paint_lay: faces whose colours are those of the closest
                                points of the model */
} ktg_paint_report;

/* The look of `mesh`, which is copied: colours of vertices or faces, the image of a PLY
 * (texture_file), or the materials of its MTL files: Kd, or the image map_Kd (PNG or JPEG; -s, -o
 * and -clamp count; Kd does not tint it; what is transparent is white). `model` is the path of the
 * model's file: MTL files are looked for from its folder, images from that of their MTL file; where
 * a file is not at its place (an absolute path of another machine), one of its name beside the MTL
 * file is taken. Devices are refused, and so is what lies outside the model's folder, unless
 * `anywhere`. What cannot be read is told as a warning, and its faces are printed in Kd, or stay
 * white. *paint is NULL when the model has no look but that of its paper. Free with ktg_paint_free.
 * `options` NULL: the defaults; `report` may be NULL. KTG_MEMORY is all that fails. */
KTG_API KTG_NODISCARD ktg_status ktg_paint_new(ktg_context *context, const ktg_mesh *mesh,
                                               const char *model, const ktg_paint_options *options,
                                               ktg_paint **paint, ktg_paint_report *report);
KTG_API void ktg_paint_free(ktg_paint **paint);

/* Lays the look onto the faces of `surface`, in the model's unit: a simplified, deformed or cut
 * version of the model, or the model itself. Where a face still has what its colour comes from (a
 * material without an image, or texture coordinates) that is taken, elsewhere the colour of the
 * model's closest point, of those that face the same way where there are such. `mm_per_unit` tells
 * how large a dot of an image will be. The surface is copied; a look may be laid anew. KTG_MEMORY:
 * then it is laid on nothing. */
KTG_API KTG_NODISCARD ktg_status ktg_paint_lay(ktg_context *context, ktg_paint *paint,
                                               const ktg_mesh *surface, double mm_per_unit,
                                               ktg_paint_report *report);

/* A dot of a picture: where it lies on a face, as weights of the corners (they sum to 1; beyond an
 * edge one is negative: it counts as 0, the others sum to 1), and how the weights change from
 * dot to dot. */
typedef struct ktg_paint_dot {
    uint32_t face; /* of the surface */
    double weights[3], right[3], down[3];
    uint32_t near; /* a face of the model that may be near, as the last call left it, or KTG_NONE:
                      it only saves time */
} ktg_paint_dot;

/* The colour of a dot, as sRGB bytes: a mean over what lies under it. KTG_ARGUMENT for a face that
 * is not there. */
KTG_API KTG_NODISCARD ktg_status ktg_paint_colour(ktg_context *context, const ktg_paint *paint,
                                                  ktg_paint_dot *dot, uint8_t rgb[3]);

/* The number of faces it is laid on; 0 before ktg_paint_lay. */
KTG_API uint32_t ktg_paint_face_count(const ktg_paint *paint);
/* True when there are images or colours of vertices: colours that change within a face. */
KTG_API bool ktg_paint_is_picture(const ktg_paint *paint);

/* A picture of width x height dots, 3 bytes each, rows from the top, as JPEG (quality 92, colours
 * at full resolution). *bytes has *size bytes and is freed with ktg_free. KTG_ARGUMENT below 1 or
 * above 65,500 dots a side, KTG_MEMORY. */
KTG_API KTG_NODISCARD ktg_status ktg_paint_jpeg(ktg_context *context, const uint8_t *rgb,
                                                uint32_t width, uint32_t height,
                                                unsigned char **bytes, size_t *size);

#ifdef __cplusplus
}
#endif
#endif
