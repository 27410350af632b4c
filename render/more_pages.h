/* render/more_pages.h - pages and pictures that explain the sheets (render only). */
#ifndef KTG_RENDER_MORE_PAGES_H
#define KTG_RENDER_MORE_PAGES_H

#include "render/draw.h"

/* ---- solid.c -------------------------------------------------------------------------------- */

/* Whether a picture of the finished model helps: of paper, in several pieces. */
bool ktg_solid_is_wanted(const ktg_drawing *drawing);
/* The model in a square, seen from the front, or from behind, a little from the right and above. */
KTG_NODISCARD ktg_status ktg_solid_draw(const ktg_drawing *drawing, cairo_t *cairo, ktg_area area,
                                        bool from_behind);
/* Unit vectors of the model that point right and up in such a picture. */
void ktg_solid_eye(unsigned up, bool from_behind, ktg_vec3 *right, ktg_vec3 *above);

/* ---- strain.c, guide.c ---------------------------------------------------------------------- */

/* Cloth: a page that shows where it strains, with a square to check the printer by. */
bool ktg_strain_is_wanted(const ktg_drawing *drawing);
KTG_NODISCARD ktg_status ktg_strain_draw(const ktg_drawing *drawing, cairo_t *cairo,
                                         double width_mm, double height_mm);
/* A square of 50 mm with its upper left corner at (x, y). */
void ktg_test_square_draw(cairo_t *cairo, double x, double y);

/* A page of its own that tells how to read the pattern. */
void ktg_guide_draw(const ktg_drawing *drawing, cairo_t *cairo, double width_mm, double height_mm);

/* ---- build_page.c --------------------------------------------------------------------------- */

/* "How to build it": the finished model, then step by step which seams are glued. */
typedef struct ktg_build_guide ktg_build_guide;

bool ktg_build_guide_is_wanted(const ktg_drawing *drawing);
KTG_NODISCARD ktg_status ktg_build_guide_new(const ktg_drawing *drawing, ktg_build_guide **guide);
void ktg_build_guide_free(ktg_build_guide **guide);
/* The size of its pages: that of the sheets, A4 where those are very small or large. */
void ktg_build_guide_size(const ktg_drawing *drawing, double *width_mm, double *height_mm);
/* Draws the next page; there is always a first one. */
KTG_NODISCARD ktg_status ktg_build_guide_draw(ktg_build_guide *guide, cairo_t *cairo,
                                              double width_mm, double height_mm);
/* Whether all pages are drawn. */
bool ktg_build_guide_is_done(const ktg_build_guide *guide);

#endif
