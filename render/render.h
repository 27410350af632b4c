/* render/render.h - drawing sheets: PDF and PNG with Cairo, SVG and DXF for machines. */
#ifndef KTG_RENDER_RENDER_H
#define KTG_RENDER_RENDER_H

#include "core/core.h"
#include "paint/paint.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ktg_fold_style {
    KTG_FOLDS_DASHED, /* mountain dashed, valley dash-dot (Blender, origami) */
    KTG_FOLDS_SOLID   /* mountain solid, valley dashed (Pepakura) */
} ktg_fold_style;

/* What a user unit of an SVG is: some cutters do not know millimetres and read it as a pixel. */
typedef enum ktg_svg_unit {
    KTG_SVG_MM,
    KTG_SVG_PX72, /* 72 in an inch */
    KTG_SVG_PX96  /* 96 in an inch */
} ktg_svg_unit;

typedef struct ktg_render_options {
    const char *title; /* on every sheet and in the metadata; NULL: the model's file name */
    ktg_fold_style folds;
    double flat_below;    /* radians: folds flatter than this are not drawn; default 1 degree */
    double dots_per_inch; /* PNG; 150 */
    unsigned up;          /* which axis of the model is height: 0 x, 1 y, 2 z; 1 */
    bool
        colour; /* mountain red, valley blue; the dashes tell them apart without it; default true */
    bool guide; /* paper: the PDF ends with pages that tell how to build it; true */
    bool strain_map;       /* cloth: the PDF ends with a page that shows where it strains; true */
    double strain_limit;   /* of that page's colours; 0.05 */
    ktg_svg_unit svg_unit; /* millimetres */
    bool real_dashes;      /* SVG, DXF: dashes are short paths of their own; default false */
    bool plain_dxf; /* of cloth too, a DXF is for cutters, not for garment CAD; default false */
    bool marker;    /* a roll is fabric: its edges, width and length are drawn; default false */
    const ktg_paint *paint; /* what the faces look like (ktg_paint_lay, onto the faces of the
                               pattern's surface), borrowed; NULL: they stay white. Folds are
                               black or white then, whatever is seen better */
    double bleed_mm;        /* how far colours reach beyond the edges of faces; 1.5 */
    bool registration; /* marks in the margins by which a cutter finds the print; default false */
} ktg_render_options;

KTG_API void ktg_render_defaults(ktg_render_options *options);

/* Title, legend and rulers stand between the printable area and the paper's edge, from 6.35 mm on;
 * where the margins are narrower than 10 mm, in a free corner. They take no room from the pieces.
 * The title may hold any bytes; what is not UTF-8 is replaced. */

/* All sheets, one page each, as vector PDF with embedded fonts and searchable text; a last page
 * "How to read this pattern" where a sheet had no room for the furniture. The same pattern gives
 * the same bytes. KTG_ARGUMENT when the pattern is not finished or has no sheets, KTG_LIMIT when a
 * sheet is larger than a PDF page can be (5080 mm a side), KTG_FILE when the output cannot take it.
 */
KTG_API KTG_NODISCARD ktg_status ktg_render_pdf(ktg_context *context, const ktg_pattern *pattern,
                                                const ktg_render_options *options,
                                                ktg_output *output);

/* One sheet (0 .. sheet_count - 1) as PNG on white, or as SVG for a cutting machine: a layer for
 * each operation with a colour of its own, what is cut comes last and from the inside out, no line
 * is cut twice. KTG_ARGUMENT when there is no such sheet, KTG_LIMIT for a PNG above 32767 pixels a
 * side. */
KTG_API KTG_NODISCARD ktg_status ktg_render_svg(ktg_context *context, const ktg_pattern *pattern,
                                                size_t sheet, const ktg_render_options *options,
                                                ktg_output *output);
KTG_API KTG_NODISCARD ktg_status ktg_render_png(ktg_context *context, const ktg_pattern *pattern,
                                                size_t sheet, const ktg_render_options *options,
                                                ktg_output *output);

/* One sheet as DXF (Release 12, ASCII, a unit is a millimetre) for a cutting machine: what the SVG
 * holds, in layers. */
KTG_API KTG_NODISCARD ktg_status ktg_render_dxf(ktg_context *context, const ktg_pattern *pattern,
                                                size_t sheet, const ktg_render_options *options,
                                                ktg_output *output);

/* The whole pattern as DXF for garment CAD, after ASTM D6673: a block for each piece, numbered
 * layers; inserted where the pieces lie on the sheets, which lie side by side. */
KTG_API KTG_NODISCARD ktg_status ktg_render_astm(ktg_context *context, const ktg_pattern *pattern,
                                                 const ktg_render_options *options,
                                                 ktg_output *output);

/* All pages in one PNG for a quick look: side by side in rows, no larger than 3000 pixels a side
 * and at most at options->dots_per_inch. */
KTG_API KTG_NODISCARD ktg_status ktg_render_contact(ktg_context *context,
                                                    const ktg_pattern *pattern,
                                                    const ktg_render_options *options,
                                                    ktg_output *output);

/* A surface to be looked at, in any unit; borrowed. */
typedef struct ktg_render_shape {
    uint32_t vertex_count, face_count;
    const ktg_vec3 *vertices;
    const uint32_t *faces; /* 3 face_count vertex indices */
    const uint32_t *tints; /* face_count colours 0xRRGGBB, or NULL: white */
} ktg_render_shape;

/* The shapes as shaded solids side by side, all at one scale, in one PNG: seen from the front, a
 * little from the right and above, with the edges of their faces where those are few. `up`: as in
 * the options. KTG_ARGUMENT for a vertex that is not there or not finite; KTG_LIMIT for more than
 * 2^31 corners. */
KTG_API KTG_NODISCARD ktg_status ktg_render_shapes(ktg_context *context,
                                                   const ktg_render_shape *shapes, size_t count,
                                                   unsigned up, ktg_output *output);

#ifdef __cplusplus
}
#endif
#endif
