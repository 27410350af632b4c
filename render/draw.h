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

/* ---- options.c, folds.c, joints.c, piece_tints.c
 * --------------------------------------------------------- */

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

/* ---- page.c ------------------------------------------------------------------------------- */

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

/* ---- colours_draw.c ----------------------------------------------------------------------- */

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

/* ---- lines.c, joints.c, labels.c ---------------------------------------------------------- */

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

/* ---- font.c, text.c
 * ------------------------------------------------------------------------------- */

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

/* ---- furniture.c, block.c, pocket.c, legend.c, ruler.c, guide.c
 * ------------------------------------- */

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

/* ---- marker.c ----------------------------------------------------------------------------- */

/* True when the sheet is fabric. */
bool ktg_is_marker(const ktg_page *page);
/* "fabric 1400 mm wide, 2350 mm long". */
void ktg_marker_tell(const ktg_pattern_sheet *sheet, char text[KTG_DETAIL_SIZE]);
/* Draws the edges of the fabric, its width and its length, where the sheet is fabric. */
void ktg_marker_draw(const ktg_page *page);

/* ---- registration.c ----------------------------------------------------------------------- */

#define KTG_REGISTRATION_MARKS 3

/* Marks by which a cutter finds the print: crosses in circles in three corners of the margins (not
 * the lower right one), in mm from the sheet's lower left corner. False when the margins are too
 * narrow. */
bool ktg_registration_find(const ktg_pattern_sheet *sheet, ktg_vec2 marks[KTG_REGISTRATION_MARKS],
                           double *reach);
/* Draws them, where they are wanted. */
void ktg_registration_draw(const ktg_page *page);

/* ---- column.c ----------------------------------------------------------------------------- */

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

/* ---- tile.c, map.c, solid.c, cover.c, names.c
 * ------------------------------------------------------ */

#define KTG_NAME_SIZE 128

/* What a piece is called: "body", or, of paper, "body 2 of 3" where its part of the model has
 * several. */
void ktg_drawing_piece_name(const ktg_drawing *drawing, uint32_t piece, char name[KTG_NAME_SIZE]);

/* Only "2 of 3"; "" where its part of the model has no other piece. */
void ktg_drawing_piece_part(const ktg_drawing *drawing, uint32_t piece, char part[KTG_NAME_SIZE]);

/* True when the sheet is part of a poster whose other sheets are known. */
bool ktg_is_tile(const ktg_pattern_sheet *sheet);
/* How many posters there are. */
uint32_t ktg_poster_count(const ktg_pattern *pattern);
/* "B3": row B, column 3; "2-B3" of the second of several posters. */
void ktg_tile_name(const ktg_drawing *drawing, const ktg_pattern_sheet *sheet,
                   char name[KTG_NAME_SIZE]);
/* The tile `down` rows below and `right` columns to the right of this one, or NULL. */
const ktg_pattern_sheet *ktg_tile_neighbour(const ktg_drawing *drawing,
                                            const ktg_pattern_sheet *sheet, int down, int right);

/* What lies under a tile's drawing, its name; and what lies over it: where neighbours join. */
void ktg_tile_draw_ground(const ktg_page *page);
void ktg_tile_draw_joins(const ktg_page *page);

/* Where a neighbour joins: a line along one side of the tile, on the page. */
typedef struct ktg_tile_join {
    ktg_vec2 from, to;
    ktg_vec2 out; /* a unit vector towards the neighbour */
    bool trim;    /* this sheet is cut here; else the neighbour comes up to it */
    const ktg_pattern_sheet *neighbour;
} ktg_tile_join;

/* Side 0 left, 1 above, 2 right, 3 below; false where no tile is. */
bool ktg_tile_join_find(const ktg_page *page, int side, ktg_tile_join *found);

/* The extent of a poster, and its map in `area` at `scale` (millimetres of paper for one of the
 * poster): the tiles with their names, and the piece. */
ktg_vec2 ktg_map_size(const ktg_drawing *drawing, uint32_t poster);
void ktg_map_draw(const ktg_drawing *drawing, cairo_t *cairo, uint32_t poster, ktg_vec2 corner,
                  double scale);

/* Whether a picture of the finished model helps: of paper, in several pieces. */
bool ktg_solid_is_wanted(const ktg_drawing *drawing);
/* The model in a square, seen from the front, or from behind, a little from the right and above. */
KTG_NODISCARD ktg_status ktg_solid_draw(const ktg_drawing *drawing, cairo_t *cairo, ktg_area area,
                                        bool from_behind);
/* Unit vectors of the model that point right and up in such a picture. */
void ktg_solid_eye(unsigned up, bool from_behind, ktg_vec3 *right, ktg_vec3 *above);

/* How many pages with the maps of posters come first in a PDF, and one of them (from 0). */
size_t ktg_cover_count(const ktg_drawing *drawing);
void ktg_cover_draw(const ktg_drawing *drawing, cairo_t *cairo, size_t number);

/* Cloth: a page that shows where it strains, with a square to check the printer by. */
bool ktg_strain_is_wanted(const ktg_drawing *drawing);
KTG_NODISCARD ktg_status ktg_strain_draw(const ktg_drawing *drawing, cairo_t *cairo,
                                         double width_mm, double height_mm);
/* A square of 50 mm with its upper left corner at (x, y). */
void ktg_test_square_draw(cairo_t *cairo, double x, double y);

/* A page of its own that tells how to read the pattern. */
void ktg_guide_draw(const ktg_drawing *drawing, cairo_t *cairo, double width_mm, double height_mm);

/* ---- build_page.c ------------------------------------------------------------------------- */

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

/* ---- surface.c ---------------------------------------------------------------------------- */

/* Carries what cairo writes into an output, and the first failure out of it. */
typedef struct ktg_sink {
    ktg_context *context;
    ktg_output *output;
    ktg_status status;
} ktg_sink;

/* The write function for cairo's streams; `closure` is a ktg_sink. */
cairo_status_t ktg_sink_write(void *closure, const unsigned char *bytes, unsigned int size);

/* ---- png.c -------------------------------------------------------------------------------- */

typedef ktg_status ktg_png_draw(const ktg_drawing *drawing, cairo_t *cairo, const void *what);

/* A PNG of that many pixels on white; `draw` is handed `what`. */
KTG_NODISCARD ktg_status ktg_png_make(const ktg_drawing *drawing, int width, int height,
                                      ktg_png_draw *draw, const void *what, ktg_output *output);

/* What cairo says as a status of ours with a message about `what` ("the PDF"). A failure of the
 * sink is the reason for all that came after it. */
KTG_NODISCARD ktg_status ktg_cairo_status(ktg_context *context, const ktg_sink *sink,
                                          cairo_status_t status, const char *what);

#endif
