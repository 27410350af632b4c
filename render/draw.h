/* render/draw.h - what the files of render share (render only).
 *
 * Drawing is done in millimetres from the paper's upper left corner, y down; each surface scales
 * that to its own unit. A sheet has y up, so points are turned over here, once, and text never is.
 */
#ifndef KTG_RENDER_DRAW_H
#define KTG_RENDER_DRAW_H

#include "core/vec.h"
#include "render/render.h"

#include <cairo.h>

/* Printers leave this much of the paper white. */
#define KTG_PAPER_EDGE_MM 6.35
/* The strip beside the printable area that holds title, legend and rulers. */
#define KTG_STRIP_MM 3.65

#define KTG_CUT_MM  0.25
#define KTG_FOLD_MM 0.15

/* The kinds of strokes and areas a reader must be able to tell apart; bits of ktg_drawing.kinds. */
typedef enum ktg_stroke {
    KTG_STROKE_CUT,
    KTG_STROKE_MOUNTAIN,
    KTG_STROKE_VALLEY,
    KTG_STROKE_TAB,
    KTG_STROKE_JOINT, /* a cut edge without a tab */
    KTG_STROKE_SEW,
    KTG_STROKE_GRAIN,
    KTG_STROKE_PLACE_FOLD, /* cloth laid double */
    KTG_STROKE_DART,
    KTG_STROKE_NOTCH,
    KTG_STROKE_INTERNAL,
    KTG_STROKE_TRIM, /* of a poster's sheet: cut here ... */
    KTG_STROKE_JOIN, /* ... and lay the neighbour up to here */
    KTG_STROKE_COUNT
} ktg_stroke;

typedef struct ktg_fold_segment {
    ktg_vec2 from, to; /* in the piece */
    ktg_stroke stroke; /* KTG_STROKE_MOUNTAIN or KTG_STROKE_VALLEY */
    bool is_foot;      /* of a tab */
} ktg_fold_segment;

/* Half a diamond on an edge that is glued to its mate without a tab: two corners on the edge, one
 * inside the face between them. */
typedef struct ktg_joint_mark {
    uint32_t piece;
    ktg_vec2 corners[3];
} ktg_joint_mark;

#define KTG_TITLE_SIZE 512

/* What is the same on all sheets, found once. */
typedef struct ktg_drawing {
    ktg_context *context;
    const ktg_pattern *pattern;
    ktg_render_options options;
    char title[KTG_TITLE_SIZE]; /* valid UTF-8 without control characters */
    size_t *first_fold;         /* piece_count + 1: where a piece's folds begin */
    ktg_fold_segment *folds;
    size_t joint_count;
    ktg_joint_mark *joints;
    unsigned kinds;        /* which strokes occur, as bits */
    const uint32_t *tints; /* of the surface's faces in pictures of solids, 0xRRGGBB; NULL: ... */
    uint32_t *piece_tints; /* ... those of their pieces; NULL: white */
} ktg_drawing;

/* ---- options.c, folds.c, joints.c, piece_tints.c -------------------------------------------- */

/* Checks that `pattern` can be drawn (finished, laid out, indices in range) and collects what all
 * sheets share. Free with ktg_drawing_free. */
KTG_NODISCARD ktg_status ktg_drawing_new(ktg_context *context, const ktg_pattern *pattern,
                                         const ktg_render_options *options, ktg_drawing **drawing);
/* The same, to draw one sheet (from 0); KTG_ARGUMENT when there is none of that number. */
KTG_NODISCARD ktg_status ktg_drawing_of_sheet(ktg_context *context, const ktg_pattern *pattern,
                                              const ktg_render_options *options, size_t sheet,
                                              ktg_drawing **drawing);
void ktg_drawing_free(ktg_drawing **drawing);

/* Fills first_fold and folds: the folds between faces, and those at the feet of tabs. */
KTG_NODISCARD ktg_status ktg_drawing_find_folds(ktg_drawing *drawing);
/* Fills joints: the edges without a tab, where there are tabs at all. */
KTG_NODISCARD ktg_status ktg_drawing_find_joints(ktg_drawing *drawing);

/* Fills piece_tints: neighbours differ. */
KTG_NODISCARD ktg_status ktg_drawing_find_tints(ktg_drawing *drawing);
/* The colour 0xRRGGBB, or a grey as bright where no colours are wished for. */
uint32_t ktg_drawing_colour(const ktg_drawing *drawing, uint32_t colour);

/* place[f] becomes face f's index within its piece. */
void ktg_drawing_fill_places(const ktg_pattern *pattern, uint32_t *place);
/* Start and end of the side's edge and the corner opposite, in its piece; false when the pattern
 * has no such side. */
bool ktg_drawing_side(const ktg_drawing *drawing, const uint32_t *place,
                      const ktg_pattern_side *side, ktg_vec2 corners[3]);

/* ---- page.c --------------------------------------------------------------------------------- */

/* A rectangle of the page. */
typedef struct ktg_area {
    double x0, y0, x1, y1; /* x0 <= x1, y0 <= y1 */
} ktg_area;

/* One sheet being drawn. */
typedef struct ktg_colours ktg_colours;

typedef struct ktg_page {
    const ktg_drawing *drawing;
    const ktg_pattern_sheet *sheet;
    size_t number; /* from 0 */
    cairo_t *cairo;
    ktg_colours *colours; /* what lies under all else, or NULL */
} ktg_page;

/* The motion from a placed piece to its sheet (y up), and from there to the page. */
ktg_motion2 ktg_page_motion(const ktg_pattern_placement *placement);
ktg_vec2 ktg_page_point(const ktg_page *page, ktg_motion2 motion, ktg_vec2 point);

/* Sets up a fresh cairo context: text of the same shape at every resolution. */
void ktg_page_begin(cairo_t *cairo);

/* The printable area on the page. */
ktg_area ktg_page_printable(const ktg_page *page);

/* Draws a sheet with its furniture. *furnished is false when there was no room for the furniture.
 */
KTG_NODISCARD ktg_status ktg_page_draw(const ktg_drawing *drawing, size_t sheet, cairo_t *cairo,
                                       bool *furnished);

/* ---- colours_draw.c ------------------------------------------------------------------------- */

/* Makes the page's colours, where there are any, and draws them; free page->colours with
 * ktg_colours_free also after a failure. */
KTG_NODISCARD ktg_status ktg_colours_begin(ktg_page *page);
/* The mean colour (0 to 1) along a line of the page; false where it is white paper. */
bool ktg_ground_of(const ktg_page *page, ktg_vec2 from, ktg_vec2 to, double rgb[3]);
bool ktg_ground_is_dark(const double rgb[3]);
/* On colours, a fold is drawn with what is seen there: black or white, the ground showing through.
 */
void ktg_ground_set_fold_ink(const ktg_page *page, ktg_vec2 from, ktg_vec2 to);
/* The colours as a surface of cairo's; `packed`: with a JPEG of them, where they are a picture.
 * Free with cairo_surface_destroy. */
KTG_NODISCARD ktg_status ktg_colours_surface(const ktg_drawing *drawing, const ktg_colours *colours,
                                             bool packed, cairo_surface_t **surface);

/* ---- lines.c, joints.c, labels.c ------------------------------------------------------------ */

/* A straight stroke of the given kind on the page, its dashes fitted to its length. */
void ktg_draw_stroke(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke, ktg_vec2 from,
                     ktg_vec2 to);
/* A dash, a gap, and a dot between two gaps where `dot` is not 0; mm. */
typedef struct ktg_dashes {
    double dash, gap, dot; /* dash 0: solid */
} ktg_dashes;

/* How a kind is dashed, and that stretched so that a line of `length` begins and ends with a dash
 * and has two at least. */
ktg_dashes ktg_stroke_dashes(const ktg_drawing *drawing, ktg_stroke stroke);
ktg_dashes ktg_dashes_fit(ktg_dashes wished, double length);
double ktg_stroke_width_mm(ktg_stroke stroke);
/* Sets colour and width of a kind, no dashes. */
void ktg_draw_set_stroke(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke);
/* What a pattern's line is drawn as. */
ktg_stroke ktg_stroke_of_line(ktg_line_kind kind);
/* A filled arrow head at `tip` of a line that comes from `from`, `length` mm long. */
void ktg_draw_arrow_head(cairo_t *cairo, ktg_vec2 tip, ktg_vec2 from, double length);
/* The mark of a butt joint. */
void ktg_draw_joint(const ktg_drawing *drawing, cairo_t *cairo, const ktg_vec2 corners[3]);
/* The tint of glue tabs. */
void ktg_draw_set_tint(cairo_t *cairo);

/* The layers of a placed piece, from the lowest to the highest. */
void ktg_draw_tabs(const ktg_page *page, const ktg_pattern_placement *placement);
void ktg_draw_folds(const ktg_page *page, const ktg_pattern_placement *placement);
void ktg_draw_lines(const ktg_page *page, const ktg_pattern_placement *placement);
void ktg_draw_grounds(const ktg_page *page, const ktg_pattern_placement *placement);
void ktg_draw_outline(const ktg_page *page, const ktg_pattern_placement *placement);
void ktg_draw_joints(const ktg_page *page, const ktg_pattern_placement *placement);
void ktg_draw_labels(const ktg_page *page, const ktg_pattern_placement *placement);

/* A label where it is read. */
typedef struct ktg_placed_label {
    char text[128];      /* each byte of a label may become the three of U+FFFD */
    ktg_vec2 at;         /* its middle, on the page */
    double angle, width; /* counter-clockwise; in mm */
} ktg_placed_label;

/* Where a label is read; false when it is empty. A number keeps its turn, and has a dot where it
 * could be misread; a name is turned so that it can be read. Sets cairo's typeface. */
bool ktg_label_place(const ktg_page *page, const ktg_pattern_placement *placement,
                     const ktg_pattern_label *label, ktg_placed_label *placed);

/* ---- names.c -------------------------------------------------------------------------------- */

#define KTG_NAME_SIZE 128

/* What a piece is called: "body", or, of paper, "body 2 of 3" where its part of the model has
 * several. */
void ktg_drawing_piece_name(const ktg_drawing *drawing, uint32_t piece, char name[KTG_NAME_SIZE]);

/* Only "2 of 3"; "" where its part of the model has no other piece. */
void ktg_drawing_piece_part(const ktg_drawing *drawing, uint32_t piece, char part[KTG_NAME_SIZE]);

/* ---- surface.c ------------------------------------------------------------------------------ */

/* Carries what cairo writes into an output, and the first failure out of it. */
typedef struct ktg_sink {
    ktg_context *context;
    ktg_output *output;
    ktg_status status;
} ktg_sink;

/* The write function for cairo's streams; `closure` is a ktg_sink. */
cairo_status_t ktg_sink_write(void *closure, const unsigned char *bytes, unsigned int size);

/* ---- png.c ---------------------------------------------------------------------------------- */

typedef ktg_status ktg_png_draw(const ktg_drawing *drawing, cairo_t *cairo, const void *what);

/* A PNG of that many pixels on white; `draw` is handed `what`. */
KTG_NODISCARD ktg_status ktg_png_make(const ktg_drawing *drawing, int width, int height,
                                      ktg_png_draw *draw, const void *what, ktg_output *output);

/* What cairo says as a status of ours with a message about `what` ("the PDF"). A failure of the
 * sink is the reason for all that came after it. */
KTG_NODISCARD ktg_status ktg_cairo_status(ktg_context *context, const ktg_sink *sink,
                                          cairo_status_t status, const char *what);

#endif
