/* layout/poster.h - one piece over several sheets (layout only). */
#ifndef KTG_LAYOUT_POSTER_H
#define KTG_LAYOUT_POSTER_H

#include "layout/turn.h"

/* The most sheets of one poster. */
#define KTG_POSTER_TILES 4096

/* A grid of sheets, each showing `room` of the piece, `step` from its neighbours; row 0 is at the
 * top, and the lower left corner of the lowest left tile's printable area is the origin. */
typedef struct ktg_poster {
    uint32_t piece;
    ktg_turn turn;
    ktg_vec2 at; /* the piece's origin */
    ktg_vec2 room, step;
    uint32_t rows, columns;
    uint32_t tiles; /* that are not empty */
    bool *used;     /* rows x columns: those */
} ktg_poster;

/* Lays piece `index` at the turn and place that take the fewest sheets; with keep_grain upright or
 * on its side: paper has no grain, and a line shows the cloth's. Free with ktg_poster_drop, also
 * after a failure. KTG_LIMIT when it would be more than KTG_POSTER_TILES. */
KTG_NODISCARD ktg_status ktg_poster_lay(ktg_context *context, const ktg_pattern *pattern,
                                        const ktg_layout_options *options, double overlap_mm,
                                        uint32_t index, ktg_poster *poster);
void ktg_poster_drop(ktg_poster *poster);

/* Fills `poster->tiles` sheets, row by row; `number` of the poster, from 1. */
KTG_NODISCARD ktg_status ktg_poster_write(ktg_context *context, const ktg_poster *poster,
                                          const ktg_sheet_format *format, uint32_t number,
                                          ktg_pattern_sheet *sheets);

#endif
