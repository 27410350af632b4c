/* pattern/outline.c - the closed cut around a piece's faces and tabs. */
#include "pattern/finish.h"

#include "core/memory.h"

static bool same_point(ktg_vec2 a, ktg_vec2 b) {
    return a.x == b.x && a.y == b.y;
}

/* Appends a point unless the outline is there already. */
static void append(ktg_pattern_piece *piece, ktg_vec2 point) {
    if (piece->outline_count == 0 || !same_point(piece->outline[piece->outline_count - 1], point))
        piece->outline[piece->outline_count++] = point;
}

/* Walks the border; tabs come in the order of the border, as ktg_tabs_place writes them. */
static ktg_status write_outline(ktg_context *context, const ktg_topology *t, uint32_t p,
                                ktg_pattern_piece *piece) {
    size_t room = t->border_first[p + 1] - t->border_first[p], next_tab = 0;
    ktg_free(piece->outline);
    piece->outline_count = 0;
    piece->outline = ktg_new(context, room + piece->tab_count * KTG_TAB_CORNERS, ktg_vec2);
    if (!piece->outline)
        return KTG_MEMORY;
    for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++) {
        uint32_t h = t->border[k];
        append(piece, ktg_start_of(t, h));
        if (ktg_edge_at(t, h)->tab_on != t->side_of[h] || next_tab == piece->tab_count)
            continue;
        const ktg_pattern_tab *tab = &piece->tabs[next_tab++];
        for (uint32_t i = 0; i < tab->corner_count; i++)
            append(piece, tab->corners[i]);
    }
    while (piece->outline_count > 1 &&
           same_point(piece->outline[0], piece->outline[piece->outline_count - 1]))
        piece->outline_count--;
    return KTG_OK;
}

ktg_status ktg_outlines_with_tabs(ktg_context *context, const ktg_topology *topology,
                                  ktg_pattern *pattern) {
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        KTG_TRY(write_outline(context, topology, p, &pattern->pieces[p]));
    return KTG_OK;
}
