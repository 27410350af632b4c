/* pattern/pattern.h - the pattern: what unfolding and flattening produce, what layout places and
 * render draws, and its JSON form.
 *
 * A pattern is a surface in 3D and flat pieces that fold into it. It is plain data; lengths are
 * millimetres once a scale is set (before that, the model's unit: ktg_pattern_scale), angles
 * radians, piece coordinates have y up, and the side one sees is the outside of the model. The life
 * of a pattern:
 *
 *     ktg_unfold or ktg_flatten            pieces and edges, in the model's unit
 *     ktg_pattern_fit or a wish            how many millimetres a unit is
 *     ktg_pattern_scale                    everything in millimetres
 *     ktg_pattern_finish                   seams, tabs or allowance, outlines, labels
 *     ktg_layout_place                     sheets and placements
 *     render, ktg_pattern_write_json
 */
#ifndef KTG_PATTERN_PATTERN_H
#define KTG_PATTERN_PATTERN_H

#include "core/core.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ktg_pattern_mode { KTG_PAPER, KTG_CLOTH } ktg_pattern_mode;

typedef enum ktg_edge_kind {
    KTG_EDGE_CUT,      /* two sides, joined by glue or thread */
    KTG_EDGE_MOUNTAIN, /* fold away from the person who sees the printed side */
    KTG_EDGE_VALLEY,
    KTG_EDGE_FLAT,  /* a fold of less than 1e-6 rad: nothing to fold */
    KTG_EDGE_BORDER /* one side only */
} ktg_edge_kind;

/* The edge of the surface that runs from `corner` of `face` to the next corner, lying in `piece`.
 */
typedef struct ktg_pattern_side {
    uint32_t piece;  /* index into pieces */
    uint32_t face;   /* index into the surface's faces */
    uint32_t corner; /* 0, 1, 2 */
} ktg_pattern_side;

typedef struct ktg_pattern_edge {
    uint32_t vertices[2]; /* surface vertices, as sides[0] runs */
    ktg_edge_kind kind;
    double
        angle; /* signed turn between the outward normals in radians, + = mountain; 0 on a border */
    uint32_t side_count; /* 2, or 1 on a border */
    ktg_pattern_side sides[2];
    int tab_on;    /* index into sides of the side that carries the tab; -1: none */
    uint32_t seam; /* index into seams of a cut edge once seams are found, else KTG_NONE */
    bool forced;   /* somebody wants this cut: it stays one even where it closes by itself */
} ktg_pattern_edge;

/* The most corners a tab's polygon can have. */
#define KTG_TAB_CORNERS 8

typedef enum ktg_tab_size { KTG_TAB_NONE, KTG_TAB_REDUCED, KTG_TAB_FULL } ktg_tab_size;

/* A convex glue tab, counter-clockwise; its first and last corner lie on the edge, so that the way
 * from first to last through the others is its cut. It goes under the mate's face. */
typedef struct ktg_pattern_tab {
    uint32_t edge; /* index into edges */
    uint32_t corner_count;
    ktg_vec2 corners[KTG_TAB_CORNERS];
    ktg_tab_size size;
} ktg_pattern_tab;

typedef enum ktg_line_kind {
    KTG_LINE_SEW,
    KTG_LINE_GRAIN,
    KTG_LINE_FOLD,
    KTG_LINE_DART,
    KTG_LINE_NOTCH,
    KTG_LINE_INTERNAL
} ktg_line_kind;

typedef struct ktg_pattern_line {
    ktg_line_kind kind;
    size_t point_count;
    ktg_vec2 *points;
} ktg_pattern_line;

/* A short text on a piece, centred at (x, y). */
typedef struct ktg_pattern_label {
    char text[32];    /* UTF-8, ends with 0 */
    ktg_vec2 at;      /* centre of the text */
    double rotation;  /* radians, counter-clockwise; 0 reads upright when the piece is not turned */
    double height_mm; /* of a digit */
    uint32_t edge;    /* the edge it belongs to, or KTG_NONE (a piece's name) */
    bool leader;      /* a line leads from it to ... */
    ktg_vec2 foot;    /* ... this point, at its edge */
} ktg_pattern_label;

typedef struct ktg_pattern_piece {
    uint32_t component; /* index into components */
    char *name;

    size_t vertex_count;
    ktg_vec2 *vertices; /* each stored once: faces that meet at a fold share them */
    size_t face_count;
    uint32_t *faces;   /* face_count: index of the surface's face */
    uint32_t *corners; /* 3 face_count: this piece's vertex for corner k of that face;
                          counter-clockwise */

    size_t outline_count;
    ktg_vec2 *outline; /* the cut, faces with tabs (or with the allowance): one closed walk,
                          counter-clockwise, weakly simple, the last point joins the first; NULL
                          before ktg_pattern_finish */
    size_t tab_count;
    ktg_pattern_tab *tabs;
    size_t line_count;
    ktg_pattern_line *lines;
    size_t label_count;
    ktg_pattern_label *labels;

    uint32_t cut_count,
        cut_mirrored; /* how often to cut it, and how many mirrored on top; 1 and 0 for paper.
                         Cloth: count 0 marks a piece that is the mirror image, or a copy, of
                         another, twin_of, and is cut with it (whose cut_mirrored or cut_count
                         counts it): sheets of paper leave it out, a marker shows it */
    uint32_t twin_of; /* index into pieces, where cut_count is 0 */
    bool on_fold;     /* cloth: outline and lines show one half; the other is its mirror image
                         across the line of kind KTG_LINE_FOLD */
} ktg_pattern_piece;

/* Marks on both sides of a seam that meet when it is sewn. */
typedef struct ktg_pattern_notch {
    double at;      /* part of the seam's length from where side 0 begins, 0 to 1 */
    uint32_t marks; /* 1, 2 or 3 lines side by side, so that seams can be told apart */
} ktg_pattern_notch;

/* A run of consecutive cut edges of one piece whose mates are consecutive too: one number on paper,
 * one seam to sew. */
typedef struct ktg_pattern_seam {
    uint32_t edge_count;
    uint32_t *edges; /* as they follow each other along side 0, counter-clockwise in its piece */
    uint8_t *first_side;  /* edge_count: which of the edge's sides belongs to the seam's side 0 */
    uint32_t pieces[2];   /* indices into pieces (the same one for a seam of a piece with itself) */
    double lengths_mm[2]; /* measured in 2D */
    bool obvious;     /* paper: its sides meet in a point and lie side by side, so that it needs no
                         number; such seams come last, in the order in which they are glued, too */
    bool dart;        /* cloth: it ends inside its piece, and what lies between its sides is folded
                         away, not cut out */
    uint32_t number;  /* what its label says, from 1; paper: in the order in which seams are glued;
                         cloth: seams that are mirror images of each other have the same */
    uint32_t section; /* paper: the step of the building it belongs to, from 1: some seams that lie
                         together and are glued one after the other, obvious ones among them; each
                         step follows those before. 0: nobody said */
    bool closing;     /* paper: one of the seams a body is closed with at last, all at once */
    size_t notch_count;
    ktg_pattern_notch *notches; /* notch_count; cloth */
} ktg_pattern_seam;

typedef struct ktg_pattern_component {
    char *name;
} ktg_pattern_component;

/* ---- sheets ------------------------------------------------------------------------------- */

typedef enum ktg_sheet_kind { KTG_SHEET, KTG_ROLL, KTG_TILE } ktg_sheet_kind;

/* A paper size with its margins. */
typedef struct ktg_sheet_format {
    char name[32];              /* "A4", "Letter", "300x200" */
    double width_mm, height_mm; /* as it is put into the printer: portrait unless said otherwise;
                                   INFINITY: as large as the pattern needs (ktg_layout_page) */
    double margin_mm;           /* on all four sides; the printable area is what is left */
} ktg_sheet_format;

/* Where a piece lies: turned by `rotation` about its origin, counter-clockwise, then moved. */
typedef struct ktg_pattern_placement {
    uint32_t piece;  /* index into pieces */
    double x, y;     /* mm from the sheet's lower left corner */
    double rotation; /* radians */
} ktg_pattern_placement;

typedef struct ktg_pattern_sheet {
    ktg_sheet_kind kind;
    double width_mm, height_mm;
    double printable[4]; /* x0, y0, x1, y1 */
    size_t placement_count;
    ktg_pattern_placement *placements;
    uint32_t poster; /* KTG_TILE: of which poster, from 1; 0: told of none, and for other kinds */
    uint32_t row,
        column; /* of a poster's tile: where in it, row 0 at the top, column 0 at the left */
} ktg_pattern_sheet;

/* ---- the pattern -------------------------------------------------------------------------- */

typedef struct ktg_pattern {
    ktg_pattern_mode mode;

    char *model_file;     /* the name of the model without its folder, or NULL */
    uint32_t model_faces; /* triangles of the model as read */
    double mm_per_unit;   /* 0 before a scale is set */
    bool simplified;      /* the surface has other faces than the model */
    char **omitted;       /* omitted_count: groups, objects and materials of the model whose faces
                             were left out */
    size_t omitted_count;

    uint32_t vertex_count, face_count;
    ktg_vec3 *vertices;  /* the surface the pattern folds into */
    uint32_t *faces;     /* 3 face_count, counter-clockwise from outside */
    double *face_strain; /* face_count, cloth only, or NULL: larger of |s1 - 1|, |s2 - 1| of the map
                            3D -> 2D */

    size_t component_count;
    ktg_pattern_component *components;
    size_t piece_count;
    ktg_pattern_piece *pieces;
    size_t edge_count;
    ktg_pattern_edge *edges;
    size_t seam_count;
    ktg_pattern_seam *seams;
    size_t sheet_count;
    ktg_pattern_sheet *sheets;
} ktg_pattern;

KTG_API void ktg_pattern_free(ktg_pattern **pattern);
KTG_API KTG_NODISCARD ktg_status ktg_pattern_copy(ktg_context *context, const ktg_pattern *pattern,
                                                  ktg_pattern **copy);

/* Says which groups, objects or materials of the model were left out (names copied); to be called
 * once. */
KTG_API KTG_NODISCARD ktg_status ktg_pattern_set_omitted(ktg_context *context, ktg_pattern *pattern,
                                                         const char *const *names, size_t count);

/* Multiplies every length of the surface and the pieces by `factor` (> 0, finite) and mm_per_unit
 * likewise (an unscaled pattern counts as 1). Tabs, outlines, labels, lines, seams and sheets,
 * which have sizes of their own, are dropped. */
KTG_API KTG_NODISCARD ktg_status ktg_pattern_scale(ktg_context *context, ktg_pattern *pattern,
                                                   double factor);

/* "a0" to "a6", "a3+", "b3" to "b5", "jis-b3" to "jis-b5", "letter", "legal", "tabloid", "ledger",
 * "statement", "ansi-c" to "ansi-e", "210x297" (mm) or "8.5x11in"; "fit" for a page as large as the
 * pattern needs (both sides are INFINITY). The margin is left as it is in *format. KTG_ARGUMENT
 * names what is known. */
KTG_API KTG_NODISCARD ktg_status ktg_sheet_parse(ktg_context *context, const char *text,
                                                 ktg_sheet_format *format);
/* A4 with margins of 10 mm. */
KTG_API void ktg_sheet_defaults(ktg_sheet_format *format);

/* ---- tabs, seams, labels ------------------------------------------------------------------ */

typedef enum ktg_tab_side {
    KTG_TAB_ALTERNATE, /* sides take turns along a seam: strong */
    KTG_TAB_SMALLER,   /* on the smaller face */
    KTG_TAB_RUN        /* one side of a whole seam: easy to cut */
} ktg_tab_side;

typedef enum ktg_number_style {
    KTG_NUMBER_SEAM,
    KTG_NUMBER_EDGE,
    KTG_NUMBER_NONE
} ktg_number_style;

/* How a pattern is finished. ktg_finish_defaults gives: tabs of 5 mm, flanks of 50 degrees,
 * alternate sides, inset 0.3 mm, at least 2 mm high, edges from 4 mm; numbers per seam, 2.4 mm
 * high; y is up; allowance 10 mm, hem 20 mm, notches of 5 mm every 250 mm, twins. */
typedef struct ktg_finish_options {
    double tab_height_mm; /* 0: no tabs */
    double tab_flank;     /* radians, the steepest flank angle */
    double tab_inset_mm;  /* how far a tab keeps from the borders of the face it is glued under */
    double tab_least_mm;  /* lower ones are left out */
    double tab_edge_mm;   /* shorter edges may go without */
    ktg_tab_side tab_side;
    ktg_number_style numbers;
    double number_mm; /* height of a digit, where there is room */
    unsigned up; /* which axis is height (0, 1, 2): the seam that closes the model had better be
                    low */

    /* cloth */
    double allowance_mm;   /* along seams */
    double hem_mm;         /* along borders that nothing is sewn to */
    double notch_mm;       /* length of a notch, where the allowance is not less; 0: none */
    double notch_every_mm; /* a seam has about one for each such length */
    bool twins;            /* pieces that are mirror images (or copies) of others within 0.5 mm are
                              cut with them */
    const char *const *on_fold; /* on_fold_count names, borrowed, of pieces to be cut on the fold of
                                   the cloth: those that are symmetric are */
    size_t on_fold_count;
} ktg_finish_options;

KTG_API void ktg_finish_defaults(ktg_finish_options *options);

/* Counted over the cut edges of options->tab_edge_mm and more; for the terms see docs/print.md. */
typedef struct ktg_finish_report {
    uint32_t seams;                              /* runs */
    uint32_t seam_edges;                         /* cut edges, short ones included */
    uint32_t tabs_full, tabs_reduced, tabs_none; /* of edges long enough to want one */
    uint32_t darts, twins, notches, on_fold;     /* cloth: seams that are darts, pieces cut with
                                                    others, notches (both sides of a seam count as one),
                                                    pieces cut on the fold */
    double seam_error_mm, seam_error; /* cloth: the largest difference of the two sides of a seam,
                                         and the largest by the seam's length */
    double mate_distance_mm; /* mean distance of the two copies of a cut edge, where both are in one
                                piece: small ones are easy to glue */
} ktg_finish_report;

/* Seams, then tabs (paper) or the allowance and sewing lines (cloth), then outlines, then labels;
 * in place, of a pattern that has a scale. A tab overlaps no face and no tab of its piece, lies
 * inside the flat region of the mate it is glued under, and collides with no other tab there; where
 * the wished one has no room: the other side, flatter flanks, lower, part of the edge, else none (a
 * butt joint). */
KTG_API KTG_NODISCARD ktg_status ktg_pattern_finish(ktg_context *context, ktg_pattern *pattern,
                                                    const ktg_finish_options *options,
                                                    ktg_finish_report *report);

/* The largest number of millimetres per present length unit at which the whole pattern, finished
 * with `options`, fits the printable area of ONE sheet: a single piece at its best rotation,
 * several pieces in rows (more fits when they are nested, which layout does). `gap_mm` is kept
 * between pieces. KTG_GEOMETRY when nothing fits (margins eat the sheet). */
KTG_API KTG_NODISCARD ktg_status ktg_pattern_fit(ktg_context *context, const ktg_pattern *pattern,
                                                 const ktg_sheet_format *sheet, double gap_mm,
                                                 const ktg_finish_options *options,
                                                 double *mm_per_unit);

/* ---- rows --------------------------------------------------------------------------------- */

/* A box to be laid into rows, and where it went. */
typedef struct ktg_row_box {
    double width, height; /* in */
    double x, y;          /* out: lower left corner */
    uint32_t sheet;       /* out */
} ktg_row_box;

/* Rows by height (Igarashi & Cosgrove 2001): boxes by decreasing height from left to right, a new
 * row above when one is full, a new sheet when a row does not fit. `width`, `height` of a sheet's
 * printable area (height may be infinite), `gap` between boxes. Boxes keep their places in the
 * array. KTG_GEOMETRY when a box is larger than the sheet. */
KTG_API KTG_NODISCARD ktg_status ktg_rows_pack(ktg_context *context, double width, double height,
                                               double gap, ktg_row_box *boxes, size_t box_count,
                                               uint32_t *sheet_count);

/* The rotation, 0 to pi/2, at which the convex hull of the points needs the smallest rectangle (one
 * of its sides is flush with it; ties by the smaller angle), and the lower left corner and size of
 * that rectangle after the turn. point_count at least 1. KTG_ARGUMENT for a point that is not
 * finite, or beyond 1e150. */
KTG_API KTG_NODISCARD ktg_status ktg_smallest_box(ktg_context *context, const ktg_vec2 *points,
                                                  size_t point_count, double *rotation,
                                                  ktg_vec2 *low, ktg_vec2 *size);

/* The rotation at which the points fit a width x height rectangle with the largest magnification
 * (angles with a hull edge flush to a side, and those where both ratios are equal). Refuses the
 * same points, and a rectangle without a size. */
KTG_API KTG_NODISCARD ktg_status ktg_best_fit(ktg_context *context, const ktg_vec2 *points,
                                              size_t point_count, double width, double height,
                                              double *rotation, ktg_vec2 *low,
                                              double *magnification);

/* ---- JSON --------------------------------------------------------------------------------- */

/* Appends the pattern in the form of docs/pattern-json.md; numbers read back to the same double. */
KTG_API KTG_NODISCARD ktg_status ktg_pattern_write_json(ktg_context *context,
                                                        const ktg_pattern *pattern,
                                                        ktg_output *output);

/* Reads what ktg_pattern_write_json (or another program) wrote. Only the form is checked here: keys
 * and kinds, indices in range, finite numbers, so that the pattern can be walked safely; whether it
 * is true is ktg_verify's business. KTG_FILE, KTG_FORMAT (file and key), KTG_LIMIT. */
KTG_API KTG_NODISCARD ktg_status ktg_pattern_read_json(ktg_context *context, const char *path,
                                                       ktg_pattern **pattern);

#ifdef __cplusplus
}
#endif
#endif
