/* render/callouts.h - short texts at points of a picture, or beside it, none over another (render
 * only). */
#ifndef KTG_RENDER_CALLOUTS_H
#define KTG_RENDER_CALLOUTS_H

#include "render/text.h"

typedef struct ktg_callout {
    char text[KTG_NAME_SIZE];
    ktg_vec2 at; /* what it tells of, on the page */
    bool is_placed;
    ktg_area box; /* where it stands, once it is placed */
} ktg_callout;

/* Finds places for the texts, in their order, in digits of that height: at their points, else near
 * by, with room for a leader; never over what is taken, nor out of `within`. */
void ktg_callouts_place(cairo_t *cairo, ktg_callout *callouts, size_t count, double digit_mm,
                        ktg_area within, const ktg_area *taken, size_t taken_count);
/* Where more than a quarter of them found no place at their points, or they hide more than a
 * tenth of the picture: puts all in two columns beside it, with leaders that do not cross, if
 * there is room `within`. Else, and on KTG_MEMORY, they stay as they are. All in mm of the
 * page. */
KTG_NODISCARD ktg_status ktg_callouts_spread(ktg_context *context, cairo_t *cairo,
                                             ktg_callout *callouts, size_t count, double digit_mm,
                                             ktg_area within, ktg_area picture);
/* The room that takes on each side of the picture, in mm: a width and a height. */
ktg_vec2 ktg_callouts_room(size_t count, double widest, double digit_mm);
/* What a text of that width takes, in mm2, ... */
double ktg_callouts_area(double width, double digit_mm);
/* ... and whether texts of so much area are too much to stand on a picture of that area. */
bool ktg_callouts_hide(double texts_mm2, double picture_mm2);
/* Draws those that have a place, on white, with a line to the point where that is beside them. */
void ktg_callouts_draw(cairo_t *cairo, const ktg_callout *callouts, size_t count, double digit_mm,
                       ktg_face face);

#endif
