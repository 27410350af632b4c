/* layout/pieces.h - how pieces come to lie on sheets (layout only). */
#ifndef KTG_LAYOUT_PIECES_H
#define KTG_LAYOUT_PIECES_H

#include "layout/turn.h"

/* Where a piece lies. */
typedef struct ktg_laid {
    uint32_t sheet;
    ktg_pattern_placement at;
} ktg_laid;

/* The area of a piece's faces as they lie flat, in square millimetres. */
double ktg_layout_face_area(const ktg_pattern_piece *piece);

/* Frees sheets and their placements; NULL is fine. */
void ktg_layout_free_sheets(ktg_pattern_sheet *sheets, size_t count);

/* A simple polygon around everything nearer to the piece than half the gap, with a moderate number
 * of corners; allocated. Hollows that are nearly closed are filled. */
KTG_NODISCARD ktg_status ktg_layout_cover(ktg_context *context, const ktg_pattern_piece *piece,
                                          double gap_mm, ktg_vec2 **cover, size_t *count);

/* Nests the pieces, from where they lie in rows: laid[i] of piece i. Adds to the report what the
 * search did. */
KTG_NODISCARD ktg_status ktg_layout_nest(ktg_context *context, const ktg_pattern *pattern,
                                         const ktg_layout_options *options, ktg_laid *laid,
                                         ktg_layout_report *report);

#endif
