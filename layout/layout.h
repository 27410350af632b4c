/* layout/layout.h - pieces onto sheets, into each other's bays. Places, never changes a size. */
#ifndef KTG_LAYOUT_LAYOUT_H
#define KTG_LAYOUT_LAYOUT_H

#include "core/core.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ktg_layout_options {
    ktg_sheet_format sheet; /* A4 */
    bool roll;         /* the sheet is cut from a roll: it is as wide as it says, and each one is
                          cut off where it ends, height_mm at most; false */
    double gap_mm;     /* between pieces; 2 mm */
    bool keep_grain;   /* only turns of 0 and 180 degrees (cloth); false */
    bool nap;          /* with keep_grain: no turn at all, for cloth with a nap; false */
    ktg_effort effort; /* normal: work spent on nesting several pieces; at most about 1, 3 and 25
                          seconds, less for few pieces */
    uint32_t enough_sheets; /* nesting stops once so few are reached; 0: it goes on */
    double seconds;         /* an upper bound on the nesting's time; 0: none */
} ktg_layout_options;

KTG_API void ktg_layout_defaults(ktg_layout_options *options);

typedef struct ktg_layout_report {
    uint32_t sheets;
    double fill;      /* area of faces over printable area of the sheets used, 0..1 */
    double last_mm;   /* how far down the last sheet's printable area pieces reach */
    uint64_t work;    /* what nesting spent, of options->effort */
    uint32_t records; /* how often nesting found something better; 0: the rows it started from */
} ktg_layout_report;

/* Fills pattern->sheets (replacing what was there) so that every piece lies on exactly one sheet,
 * inside its printable area, at least the gap away from every other piece; proven for the outlines
 * with exact predicates. A single piece lies at the turn with the most room around it. Several are
 * nested by their shapes: on as few sheets as are found, and as far up on the last as can be (more
 * than 3000 stay in rows by their boxes).
 * Random choices follow the context's seed; a cancel callback that says KTG_FINISH keeps the best
 * so far. The pattern must be finished. KTG_GEOMETRY when a piece is larger than the sheet: the
 * message names the piece, its size, and the scale and finished height at which it would fit. */
KTG_API KTG_NODISCARD ktg_status ktg_layout_place(ktg_context *context, ktg_pattern *pattern,
                                                  const ktg_layout_options *options,
                                                  ktg_layout_report *report);

/* Whether piece `piece` (an index) can lie on a sheet. */
KTG_API KTG_NODISCARD ktg_status ktg_layout_fits(ktg_context *context, const ktg_pattern *pattern,
                                                 const ktg_layout_options *options, size_t piece,
                                                 bool *fits);

/* Places like ktg_layout_place what fits a sheet; every larger piece becomes a poster: it is spread
 * over sheets of kind KTG_TILE that overlap by `overlap_mm` (at most half of the printable area),
 * at the turn that takes the fewest of them. Sheets on which nothing of the piece would lie are
 * left out. What reaches over a tile's printable area is not to be drawn. Posters come last, each
 * row by row. KTG_ARGUMENT for an overlap that is too large, KTG_LIMIT for a poster of thousands of
 * sheets. */
KTG_API KTG_NODISCARD ktg_status ktg_layout_tile(ktg_context *context, ktg_pattern *pattern,
                                                 const ktg_layout_options *options,
                                                 double overlap_mm, ktg_layout_report *report);

/* The longest side of a page, in mm: what PDF readers take. */
#define KTG_LAYOUT_PAGE_MM 5080.0

/* True when the sheet is infinite: it is as large as the pattern needs. */
KTG_API bool ktg_layout_is_page(const ktg_sheet_format *sheet);

/* Places everything on one page of sides up to KTG_LAYOUT_PAGE_MM, as small as some tries make it;
 * with a format that is not infinite like ktg_layout_place. KTG_LIMIT when the page would be too
 * long, KTG_GEOMETRY when a piece is too large for any. */
KTG_API KTG_NODISCARD ktg_status ktg_layout_page(ktg_context *context, ktg_pattern *pattern,
                                                 const ktg_layout_options *options,
                                                 ktg_layout_report *report);

#ifdef __cplusplus
}
#endif
#endif
