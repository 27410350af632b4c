/* render/poster.h - the sheets of a poster, its map and its cover (render only). */
#ifndef KTG_RENDER_POSTER_H
#define KTG_RENDER_POSTER_H

#include "render/draw.h"

/* ---- names.c, tile.c ------------------------------------------------------------------------ */

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

/* ---- cover.c -------------------------------------------------------------------------------- */

/* How many pages with the maps of posters come first in a PDF, and one of them (from 0). */
size_t ktg_cover_count(const ktg_drawing *drawing);
void ktg_cover_draw(const ktg_drawing *drawing, cairo_t *cairo, size_t number);

#endif
