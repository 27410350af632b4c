/* render/furniture.h - what a sheet holds beside its pieces: title, legend, rulers, edges of
 * fabric, marks for cutters (render only). */
#ifndef KTG_RENDER_FURNITURE_H
#define KTG_RENDER_FURNITURE_H

#include "render/draw.h"

/* ---- furniture.c, block.c, pocket.c, legend.c, ruler.c -------------------------------------- */

/* Draws title, legend and rulers around or between the pieces; *complete is false when there was no
 * room for some of them. */
KTG_NODISCARD ktg_status ktg_furniture_draw(const ktg_page *page, bool *complete);

#define KTG_DETAIL_COUNT 5
#define KTG_DETAIL_SIZE  96

/* What is told beside the title, each a few words: "sheet 1 of 2", "12.5 mm per unit", ...; for the
 * whole pattern when `sheet` is SIZE_MAX. Returns how many there are. */
size_t ktg_furniture_details(const ktg_drawing *drawing, size_t sheet,
                             char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE]);

#define KTG_POCKETS 8

/* What is free of a sheet. Free with ktg_pockets_drop. */
typedef struct ktg_pockets {
    int width, height; /* dots */
    double scale;      /* of them in a millimetre */
    uint32_t *sums;    /* (width + 1) x (height + 1) */
    ktg_area within;   /* nothing is looked for outside */
    size_t taken_count;
    ktg_area taken[KTG_POCKETS];
} ktg_pockets;

/* What the pieces leave free of `within`. */
KTG_NODISCARD ktg_status ktg_pockets_find(const ktg_page *page, ktg_area within,
                                          ktg_pockets *pockets);
void ktg_pockets_drop(ktg_pockets *pockets);
/* A free rectangle of that size, which is taken from now on; false when there is none. */
bool ktg_pockets_take(ktg_pockets *pockets, double width, double height, ktg_area *area);

/* The same furniture, only the legend, or a picture of the model, in pockets. False when there was
 * no room for all of it. */
bool ktg_block_draw(const ktg_page *page, ktg_pockets *pockets);
bool ktg_block_legend(const ktg_page *page, ktg_pockets *pockets);
KTG_NODISCARD ktg_status ktg_block_solid(const ktg_page *page, ktg_pockets *pockets);

/* The word of a stroke for the legend; `brief` leaves out what goes without saying. */
const char *ktg_legend_word(ktg_stroke stroke, bool brief);
/* A sample of a stroke from (x, y), `width` long. */
void ktg_legend_sample(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke, double x,
                       double y, double width);
/* The width of the legend of the page's strokes, in one line. */
double ktg_legend_width(const ktg_page *page, bool brief);
/* Draws it from x on, the samples at height y, wrapped after `width`; returns the number of lines,
 * KTG_LEGEND_LINE_MM apart. With `dry` nothing is drawn. */
size_t ktg_legend_draw(const ktg_page *page, double x, double y, double width, bool brief,
                       bool dry);
#define KTG_LEGEND_LINE_MM 3.6

/* A ruler from (x, y) to the right: millimetres above the line, inches below, no more than
 * KTG_STRIP_MM / 2 each; 100 mm and 4 in when `whole`, else 50 mm and 2 in. With `upright` it runs
 * up the page. */
void ktg_ruler_draw(cairo_t *cairo, double x, double y, bool whole, bool upright);
/* How much room it takes along its line. */
double ktg_ruler_length(bool whole);

/* ---- marker.c ------------------------------------------------------------------------------- */

/* True when the sheet is fabric. */
bool ktg_is_marker(const ktg_page *page);
/* "fabric 1400 mm wide, 2350 mm long". */
void ktg_marker_tell(const ktg_pattern_sheet *sheet, char text[KTG_DETAIL_SIZE]);
/* Draws the edges of the fabric, its width and its length, where the sheet is fabric. */
void ktg_marker_draw(const ktg_page *page);

/* ---- registration.c ------------------------------------------------------------------------- */

#define KTG_REGISTRATION_MARKS 3

/* Marks by which a cutter finds the print: crosses in circles in three corners of the margins (not
 * the lower right one), in mm from the sheet's lower left corner. False when the margins are too
 * narrow. */
bool ktg_registration_find(const ktg_pattern_sheet *sheet, ktg_vec2 marks[KTG_REGISTRATION_MARKS],
                           double *reach);
/* Draws them, where they are wanted. */
void ktg_registration_draw(const ktg_page *page);

#endif
