/* pattern/allowance.c - cloth: the seam allowance around a piece, the line to sew, the grain. */
#include "pattern/finish.h"

#include "core/memory.h"
#include "pattern/offset.h"

static void forget_shapes(ktg_pattern_piece *piece) {
    for (size_t i = 0; i < piece->line_count; i++)
        ktg_free(piece->lines[i].points);
    ktg_free(piece->lines);
    ktg_free(piece->tabs);
    ktg_free(piece->outline);
    piece->lines = NULL;
    piece->tabs = NULL;
    piece->outline = NULL;
    piece->line_count = piece->tab_count = piece->outline_count = 0;
}

/* The line takes over `points`. */
static void add_line(ktg_pattern_piece *piece, ktg_line_kind kind, ktg_vec2 *points,
                     size_t point_count) {
    piece->lines[piece->line_count++] = (ktg_pattern_line){kind, point_count, points};
}

/* The border, closed: its first point comes again at the end. */
static ktg_status add_sewing_line(ktg_context *context, const ktg_topology *t, uint32_t p,
                                  ktg_pattern_piece *piece) {
    size_t count = t->border_first[p + 1] - t->border_first[p];
    ktg_vec2 *points = ktg_new(context, count + 1, ktg_vec2);
    if (!points)
        return KTG_MEMORY;
    for (size_t i = 0; i <= count; i++)
        points[i] = ktg_start_of(t, t->border[t->border_first[p] + i % count]);
    add_line(piece, KTG_LINE_SEW, points, count + 1);
    return KTG_OK;
}

/* Upright through the middle of the piece's box, two thirds of its height. */
static ktg_status add_grain_line(ktg_context *context, ktg_pattern_piece *piece) {
    const ktg_pattern_line *border = &piece->lines[0];
    ktg_vec2 *points = ktg_new(context, 2, ktg_vec2);
    if (!points)
        return KTG_MEMORY;
    double low = INFINITY, high = -INFINITY, left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < border->point_count; i++) {
        low = fmin(low, border->points[i].y);
        high = fmax(high, border->points[i].y);
        left = fmin(left, border->points[i].x);
        right = fmax(right, border->points[i].x);
    }
    double x = (left + right) / 2, sixth = (high - low) / 6;
    points[0] = (ktg_vec2){x, low + sixth};
    points[1] = (ktg_vec2){x, high - sixth};
    add_line(piece, KTG_LINE_GRAIN, points, 2);
    return KTG_OK;
}

static ktg_status shape_piece(ktg_context *context, const ktg_topology *t, uint32_t p,
                              double allowance_mm, ktg_pattern_piece *piece) {
    forget_shapes(piece);
    if (!(piece->lines = ktg_new(context, 2, ktg_pattern_line)))
        return KTG_MEMORY;
    KTG_TRY(add_sewing_line(context, t, p, piece));
    KTG_TRY(add_grain_line(context, piece));
    const ktg_pattern_line *border = &piece->lines[0];
    ktg_status status = ktg_offset_outward(context, border->points, border->point_count - 1,
                                           allowance_mm, &piece->outline, &piece->outline_count);
    if (status == KTG_GEOMETRY)
        return ktg_fail(context, KTG_GEOMETRY,
                        "the seam allowance of %g mm around piece %u (%s) crosses itself: choose "
                        "a smaller allowance",
                        allowance_mm, p + 1, piece->name ? piece->name : "no name");
    return status;
}

ktg_status ktg_outlines_with_allowance(ktg_context *context, const ktg_topology *topology,
                                       double allowance_mm, ktg_pattern *pattern) {
    for (size_t e = 0; e < pattern->edge_count; e++)
        pattern->edges[e].tab_on = -1;
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        KTG_TRY(shape_piece(context, topology, p, allowance_mm, &pattern->pieces[p]));
    return KTG_OK;
}
