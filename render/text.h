/* render/text.h - letters: what fonts have, what fits, and columns of lines (render only). */
#ifndef KTG_RENDER_TEXT_H
#define KTG_RENDER_TEXT_H

#include "render/draw.h"

/* ---- font.c, text.c, number.c, bidi.c ------------------------------------------------------- */

/* The characters of a clean text in the order in which they stand from left to right: `text`
 * itself, or `ordered` where some are written the other way. */
const char *ktg_text_order(const char *text, char ordered[KTG_TITLE_SIZE]);

#define KTG_FONT_FAMILY "DejaVu Sans"
/* Its height of a digit as a fraction of the font size. */
#define KTG_DIGIT_PER_SIZE 0.729

/* Chooses another typeface where the chosen one lacks letters of `text`, and goes back to the usual
 * one. */
cairo_font_face_t *ktg_font_begin(cairo_t *cairo, const char *text);
void ktg_font_end(cairo_t *cairo, cairo_font_face_t *usual);

typedef enum ktg_face { KTG_FACE_PLAIN, KTG_FACE_BOLD } ktg_face;

/* Copies what is valid UTF-8 of `text` (up to `length` bytes or its end) into `clean` (`size`
 * bytes): what is not becomes U+FFFD, control characters become spaces; marks of direction, and
 * what has no room, are left out, whole characters at a time. */
void ktg_text_clean(const char *text, size_t length, char *clean, size_t size);

/* Chooses face and size; `digit_mm` is the height of a digit. */
void ktg_text_set(cairo_t *cairo, ktg_face face, double digit_mm);
/* The width of `text` in the chosen face, in mm. */
double ktg_text_width(cairo_t *cairo, const char *text);
/* `text` starting at (x, baseline). */
void ktg_text_draw(cairo_t *cairo, double x, double baseline, const char *text);
/* A short text with its middle at the origin, which is turned by `angle` counter-clockwise against
 * the page. */
void ktg_number_draw(cairo_t *cairo, double angle, double digit_mm, const char *text);
/* The ground of that text: a stroke of the given width around its letters; white, or in the colour
 * that is set. */
void ktg_text_ground(cairo_t *cairo, double x, double baseline, const char *text, double width);
void ktg_text_halo(cairo_t *cairo, double x, double baseline, const char *text, double width);
/* `text` shortened with an ellipsis until it is at most `width` wide; "" when not even that fits.
 * `text` is clean and is changed in place; `size` is what its array holds. */
void ktg_text_shorten(cairo_t *cairo, double width, char *text, size_t size);

/* ---- column.c ------------------------------------------------------------------------------- */

/* The state of a page that is written from top to bottom. */
typedef struct ktg_column {
    const ktg_drawing *drawing;
    cairo_t *cairo;
    double x, y, width; /* y moves down as lines are written */
    double floor;       /* where the page ends */
    double scale;       /* 1, less on small paper */
} ktg_column;

ktg_column ktg_column_begin(const ktg_drawing *drawing, cairo_t *cairo, double width_mm,
                            double height_mm);
void ktg_column_write(ktg_column *at, ktg_face face, double digit_mm, double indent,
                      const char *text);
void ktg_column_skip(ktg_column *at, double mm);
/* The text in lines no longer than the column is wide; with `dry` it only takes its room. */
void ktg_column_wrap(ktg_column *at, ktg_face face, double digit_mm, const char *text, bool dry);

#endif
