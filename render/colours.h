/* render/colours.h - the colours of a sheet's pieces as dots: faces with what their model looks
 * like, and a strip around them, so that no white shows where one cuts or glues beside the line
 * (render only). */
#ifndef KTG_RENDER_COLOURS_H
#define KTG_RENDER_COLOURS_H

#include "render/draw.h"

/* Of what is printed; printers have no more to show. */
#define KTG_COLOUR_DOTS_PER_MM (300 / 25.4)

struct ktg_colours {
    uint32_t width, height;
    double dots_per_mm;
    ktg_vec2 corner; /* mm on the page: the upper left corner of the first dot */
    uint32_t *dots;  /* width x height, 0x00RRGGBB; white where nothing is */
};

/* The colours of a sheet at about that resolution, lower where there would be too many dots.
 * *colours is NULL where the sheet has none. */
KTG_NODISCARD ktg_status ktg_colours_make(const ktg_drawing *drawing, size_t sheet,
                                          double dots_per_mm, ktg_colours **colours);
void ktg_colours_free(ktg_colours **colours);

/* ---- colours_lay.c ------------------------------------------------------------------------- */

/* A face where it lies on the sheet, in dots: the weights of its corners are `at` + x `right` + y
 * `down`. */
typedef struct ktg_laid_face {
    uint32_t face; /* of the surface */
    ktg_vec2 corners[3];
    double at[3], right[3], down[3];
} ktg_laid_face;

/* Which face colours which dot. */
typedef struct ktg_colour_plan {
    const ktg_drawing *drawing;
    const ktg_pattern_sheet *sheet;
    ktg_colours *colours;
    size_t face_count;
    ktg_laid_face *faces;
    uint32_t *owners; /* width x height: index into faces, KTG_NONE: nothing */
} ktg_colour_plan;

/* Fills faces and owners; those who ask after colours->dots find them white. */
KTG_NODISCARD ktg_status ktg_colours_lay(ktg_colour_plan *plan);
/* The sheet's point on the page, in dots. */
ktg_vec2 ktg_colours_dot(const ktg_colour_plan *plan, ktg_motion2 motion, ktg_vec2 point);

#endif
