/* pattern/allowance.c - cloth: what is cut and what is sewn of each piece, its grain, and the steps
 * that belong to pieces of cloth. */
#include "core/memory.h"
#include "pattern/cloth.h"
#include "pattern/finish.h"

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

/* Lines are added one by one: the array grows at powers of two. */
ktg_status ktg_piece_add_line(ktg_context *context, ktg_pattern_piece *piece, ktg_line_kind kind,
                              ktg_vec2 *points, size_t point_count) {
    size_t count = piece->line_count;
    if ((count & (count - 1)) == 0) {
        ktg_pattern_line *grown = ktg_new(context, count > 0 ? 2 * count : 1, ktg_pattern_line);
        if (!grown) {
            ktg_free(points);
            return KTG_MEMORY;
        }
        for (size_t i = 0; i < count; i++)
            grown[i] = piece->lines[i];
        ktg_free(piece->lines);
        piece->lines = grown;
    }
    piece->lines[piece->line_count++] = (ktg_pattern_line){kind, point_count, points};
    return KTG_OK;
}

ktg_status ktg_piece_add_segment(ktg_context *context, ktg_pattern_piece *piece, ktg_line_kind kind,
                                 ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 *points = ktg_new(context, 2, ktg_vec2);
    if (!points)
        return KTG_MEMORY;
    points[0] = a;
    points[1] = b;
    return ktg_piece_add_line(context, piece, kind, points, 2);
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
    return ktg_piece_add_line(context, piece, KTG_LINE_SEW, points, count + 1);
}

/* ---- grain -------------------------------------------------------------------------------- */

/* The longest stretch of the upright line at x inside the outline. */
static bool longest_stretch(const ktg_pattern_piece *piece, double x, double *low, double *high) {
    double at[64];
    size_t count = 0;
    for (size_t i = 0; i < piece->outline_count && count < 64; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % piece->outline_count];
        if ((a.x >= x) == (b.x >= x))
            continue;
        double y = a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
        size_t k = count++;
        for (; k > 0 && at[k - 1] > y; k--)
            at[k] = at[k - 1];
        at[k] = y;
    }
    *low = *high = 0;
    for (size_t k = 0; k + 1 < count; k += 2)
        if (at[k + 1] - at[k] > *high - *low) {
            *low = at[k];
            *high = at[k + 1];
        }
    return *high > *low;
}

/* Upright, two thirds of the piece's height where it is high, aside from the middle of half a piece
 * and of its name. */
static ktg_status add_grain_line(ktg_context *context, ktg_pattern_piece *piece) {
    static const double tries[] = {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8};
    double left = INFINITY, right = -INFINITY, best = 0, low, high;
    ktg_vec2 a = {0, 0}, b = {0, 0};
    for (size_t i = 0; i < piece->outline_count; i++) {
        left = fmin(left, piece->outline[i].x);
        right = fmax(right, piece->outline[i].x);
    }
    for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
        double x = left + tries[k] * (right - left);
        if (!longest_stretch(piece, x, &low, &high) || high - low <= 1.2 * best)
            continue;
        best = high - low;
        a = (ktg_vec2){x, low + best / 6};
        b = (ktg_vec2){x, high - best / 6};
    }
    return best > 0 ? ktg_piece_add_segment(context, piece, KTG_LINE_GRAIN, a, b) : KTG_OK;
}

/* ---- all steps ---------------------------------------------------------------------------- */

static ktg_status shape_pieces(ktg_context *context, ktg_cloth *cloth) {
    uint32_t count = (uint32_t)cloth->pattern->piece_count;
    KTG_TRY(ktg_clearances_find(context, cloth));
    for (uint32_t p = 0; p < count; p++) {
        forget_shapes(&cloth->pattern->pieces[p]);
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(add_sewing_line(context, cloth->topology, p, &cloth->pattern->pieces[p]));
        KTG_TRY(ktg_cutting_line(context, cloth, p));
    }
    return KTG_OK;
}

static ktg_status run_steps(ktg_context *context, ktg_cloth *cloth) {
    KTG_TRY(ktg_darts_find(context, cloth->topology, cloth->pattern));
    ktg_darts_keep_foldable(cloth);
    KTG_TRY(ktg_mirrors_find(context, cloth));
    KTG_TRY(shape_pieces(context, cloth));
    KTG_TRY(ktg_notches_choose(context, cloth));
    KTG_TRY(ktg_notches_draw(context, cloth));
    KTG_TRY(ktg_pieces_halve(context, cloth));
    for (size_t p = 0; p < cloth->pattern->piece_count; p++)
        KTG_TRY(add_grain_line(context, &cloth->pattern->pieces[p]));
    return KTG_OK;
}

static void report_cloth(const ktg_pattern *pattern, ktg_finish_report *report) {
    for (size_t p = 0; p < pattern->piece_count; p++) {
        report->twins += pattern->pieces[p].cut_count == 0;
        report->on_fold += pattern->pieces[p].on_fold;
    }
    for (size_t s = 0; s < pattern->seam_count; s++) {
        const ktg_pattern_seam *seam = &pattern->seams[s];
        double off = fabs(seam->lengths_mm[0] - seam->lengths_mm[1]);
        report->darts += seam->dart;
        report->notches += (uint32_t)seam->notch_count;
        report->seam_error_mm = fmax(report->seam_error_mm, off);
        report->seam_error =
            fmax(report->seam_error, off / fmax(seam->lengths_mm[0], seam->lengths_mm[1]));
    }
}

ktg_status ktg_finish_cloth(ktg_context *context, const ktg_topology *topology,
                            const ktg_finish_options *options, ktg_pattern *pattern,
                            ktg_finish_report *report) {
    size_t count = pattern->piece_count;
    ktg_cloth cloth = {.topology = topology,
                       .options = options,
                       .pattern = pattern,
                       .room = ktg_new(context, topology->border_count, double),
                       .twins = ktg_new(context, count, ktg_likeness),
                       .selves = ktg_new(context, count, ktg_likeness)};
    for (size_t e = 0; e < pattern->edge_count; e++)
        pattern->edges[e].tab_on = -1;
    bool all = cloth.room && cloth.twins && cloth.selves;
    ktg_status status = all ? run_steps(context, &cloth) : KTG_MEMORY;
    ktg_free(cloth.room);
    ktg_free(cloth.twins);
    ktg_free(cloth.selves);
    if (status == KTG_OK)
        report_cloth(pattern, report);
    return status;
}
