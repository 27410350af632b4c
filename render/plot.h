/* render/plot.h - what a machine does on one sheet, operation by operation: the paths and texts
 * that SVG and DXF hold (render only).
 *
 * Coordinates are millimetres from the sheet's lower left corner, y up. */
#ifndef KTG_RENDER_PLOT_H
#define KTG_RENDER_PLOT_H

#include "render/draw.h"

/* The operations, in the order in which they are written: what is cut comes last. */
typedef enum ktg_layer {
    KTG_LAYER_SHEET, /* what the sheet is called */
    KTG_LAYER_CALIBRATION,
    KTG_LAYER_REGISTRATION,
    KTG_LAYER_POSTER, /* where the sheets of a poster join */
    KTG_LAYER_TEXT,
    KTG_LAYER_JOINT,
    KTG_LAYER_MOUNTAIN,
    KTG_LAYER_VALLEY,
    KTG_LAYER_TAB_FOLD,
    KTG_LAYER_INTERNAL,
    KTG_LAYER_SEW,
    KTG_LAYER_GRAIN,
    KTG_LAYER_PLACE_FOLD,
    KTG_LAYER_DART,
    KTG_LAYER_NOTCH,
    KTG_LAYER_CUT,
    KTG_LAYER_COUNT
} ktg_layer;

typedef struct ktg_layer_look {
    const char *id, *label; /* in an SVG */
    const char *name;       /* in a DXF */
    unsigned colour;        /* 0xrrggbb, another one for each */
    int index;              /* the colour's number in a DXF */
} ktg_layer_look;

const ktg_layer_look *ktg_layer_look_of(ktg_layer layer);

typedef struct ktg_plot_path {
    ktg_layer layer;
    ktg_stroke stroke;   /* its width and dashes */
    size_t first, count; /* of the plot's points */
    bool closed;         /* the last point joins the first, which does not come again */
} ktg_plot_path;

typedef struct ktg_plot_text {
    ktg_layer layer;
    char *text;  /* clean UTF-8 */
    ktg_vec2 at; /* its middle, or, where it begins there, the foot of its first letter */
    bool begins;
    double angle, height_mm; /* counter-clockwise; of a digit */
    double width;            /* in mm, as far as one knows; set by ktg_plot_write */
} ktg_plot_text;

typedef struct ktg_plot {
    ktg_page page;
    size_t point_count, point_capacity;
    ktg_vec2 *points;
    size_t path_count, path_capacity;
    ktg_plot_path *paths;
    size_t text_count, text_capacity;
    ktg_plot_text *texts;
} ktg_plot;

/* Collects a sheet. Free with ktg_plot_drop, also after a failure. */
KTG_NODISCARD ktg_status ktg_plot_make(const ktg_drawing *drawing, size_t sheet, ktg_plot *plot);
void ktg_plot_drop(ktg_plot *plot);

/* Which operations occur, as bits. */
unsigned ktg_plot_layers(const ktg_plot *plot);

/* Adds a path; of a tile only what lies in its printable area. */
KTG_NODISCARD ktg_status ktg_plot_add(ktg_plot *plot, ktg_layer layer, ktg_stroke stroke,
                                      const ktg_vec2 *points, size_t count, bool closed);
/* Adds a text (see ktg_plot_text), cleaned. */
KTG_NODISCARD ktg_status ktg_plot_write(ktg_plot *plot, const ktg_plot_text *text);

/* A point of a placed piece on the sheet. */
static inline ktg_vec2 ktg_plot_point(const ktg_pattern_placement *placement, ktg_vec2 point) {
    return ktg_move2(ktg_page_motion(placement), point);
}

/* ---- plot_cuts.c, plot_folds.c, plot_marks.c ---------------------------------------------- */

/* The cuts of all pieces: what is walked twice is cut once; slits and holes come before outlines,
 * and small pieces before large ones. */
KTG_NODISCARD ktg_status ktg_plot_cuts(ktg_plot *plot);
/* The folds, joined to long paths. */
KTG_NODISCARD ktg_status ktg_plot_folds(ktg_plot *plot);
/* What stands around the pieces: the sheet's name, what to measure, marks to align by, joins. */
KTG_NODISCARD ktg_status ktg_plot_marks(ktg_plot *plot);

/* ---- plot_dash.c -------------------------------------------------------------------------- */

typedef ktg_status ktg_dash_draw(void *user, const ktg_vec2 *points, size_t count);

/* Hands the dashes of a path, each a short path, to `draw`; they are fitted to what lies between
 * the path's corners. A solid path is handed over whole (closed: its first point comes again). */
KTG_NODISCARD ktg_status ktg_plot_dash(const ktg_plot *plot, const ktg_plot_path *path,
                                       ktg_dash_draw *draw, void *user);

/* ---- numbers ------------------------------------------------------------------------------ */

#define KTG_NUMBER_SIZE 32

/* A number with at most 4 digits behind the point, whatever the locale. */
void ktg_plot_number(double value, char text[KTG_NUMBER_SIZE]);

#endif
