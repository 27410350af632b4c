/* pipeline/stated.c - with which options a finished pattern was made: it does not say so, but its
 * outlines show it. */
#include "pipeline/stated.h"
#include "core/memory.h"
#include "core/text.h"
#include "core/vec.h"

#include <stdio.h>
#include <stdlib.h>

/* So many edges of each kind are measured. */
enum { most_samples = 200 };

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* To a hundredth of a millimetre; `otherwise` where there is none. */
static double median(double *values, size_t count, double otherwise) {
    if (count == 0)
        return otherwise;
    qsort(values, count, sizeof *values, by_value);
    return round(100 * values[count / 2]) / 100;
}

static double distance_to_segment(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 ab = ktg_sub2(b, a), ap = ktg_sub2(p, a);
    double square = ktg_dot2(ab, ab);
    double along = square > 0 ? fmax(0, fmin(1, ktg_dot2(ap, ab) / square)) : 0;
    return ktg_length2(ktg_madd2(ap, -along, ab));
}

static double distance_to_outline(const ktg_pattern_piece *piece, ktg_vec2 p) {
    double nearest = INFINITY;
    for (size_t i = 0; i < piece->outline_count; i++)
        nearest =
            fmin(nearest, distance_to_segment(p, piece->outline[i],
                                              piece->outline[(i + 1) % piece->outline_count]));
    return nearest;
}

/* The middle of an edge's side. False for one that has no face there. */
static bool middle_of(const ktg_pattern_piece *piece, const ktg_pattern_side *side, ktg_vec2 *p) {
    for (size_t f = 0; f < piece->face_count; f++)
        if (piece->faces[f] == side->face) {
            const uint32_t *corners = piece->corners + 3 * f;
            *p = ktg_mul2(ktg_add2(piece->vertices[corners[side->corner]],
                                   piece->vertices[corners[(side->corner + 1) % 3]]),
                          0.5);
            return true;
        }
    return false;
}

/* How far the cut lies from edges of a kind: the median. */
static double find_allowance(const ktg_pattern *pattern, ktg_edge_kind kind, double otherwise) {
    double values[most_samples];
    size_t count = 0, all = 0, seen = 0;
    for (size_t e = 0; e < pattern->edge_count; e++)
        all += pattern->edges[e].kind == kind;
    for (size_t e = 0; e < pattern->edge_count && count < most_samples; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        if (edge->kind != kind || seen++ % (all / most_samples + 1) != 0)
            continue;
        const ktg_pattern_piece *piece = &pattern->pieces[edge->sides[0].piece];
        bool dart = edge->seam != KTG_NONE && pattern->seams[edge->seam].dart;
        ktg_vec2 p;
        if (dart || piece->on_fold || piece->outline_count == 0 ||
            !middle_of(piece, &edge->sides[0], &p))
            continue;
        values[count++] = distance_to_outline(piece, p);
    }
    return median(values, count, otherwise);
}

static double find_notch(const ktg_pattern *pattern, double otherwise) {
    double values[most_samples];
    size_t count = 0;
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t i = 0; i < pattern->pieces[p].line_count && count < most_samples; i++) {
            const ktg_pattern_line *line = &pattern->pieces[p].lines[i];
            if (line->kind == KTG_LINE_NOTCH && line->point_count == 2)
                values[count++] = ktg_length2(ktg_sub2(line->points[1], line->points[0]));
        }
    return median(values, count, pattern->seam_count > 0 ? 0 : otherwise);
}

static ktg_status find_folds(ktg_context *context, const ktg_pattern *pattern,
                             ktg_finish_options *finish, const char ***names) {
    *names = ktg_new(context, pattern->piece_count, const char *);
    if (!*names)
        return KTG_MEMORY;
    finish->on_fold = *names;
    finish->on_fold_count = 0;
    for (size_t p = 0; p < pattern->piece_count; p++)
        if (pattern->pieces[p].on_fold && pattern->pieces[p].name)
            (*names)[finish->on_fold_count++] = pattern->pieces[p].name;
    return KTG_OK;
}

ktg_status ktg_stated_finish(ktg_context *context, const ktg_pattern *pattern,
                             const ktg_warp_job *job, ktg_finish_options *finish,
                             const char ***names) {
    if (!job->allowance_given)
        finish->allowance_mm = find_allowance(pattern, KTG_EDGE_CUT, finish->allowance_mm);
    if (!job->hem_given)
        finish->hem_mm = find_allowance(pattern, KTG_EDGE_BORDER, finish->hem_mm);
    if (!job->notch_given)
        finish->notch_mm = find_notch(pattern, finish->notch_mm);
    finish->twins = false;
    for (size_t p = 0; p < pattern->piece_count; p++)
        finish->twins = finish->twins || pattern->pieces[p].cut_count == 0;
    return find_folds(context, pattern, finish, names);
}

void ktg_stated_sheet(const ktg_pattern *pattern, ktg_layout_options *layout) {
    if (pattern->sheet_count == 0)
        return;
    const ktg_pattern_sheet *sheet = &pattern->sheets[0];
    ktg_sheet_format *format = &layout->sheet;
    layout->roll = sheet->kind == KTG_ROLL;
    format->width_mm = sheet->width_mm;
    format->height_mm = layout->roll ? KTG_LAYOUT_PAGE_MM : sheet->height_mm;
    format->margin_mm = fmax(0, sheet->printable[0]);
    ktg_format(format->name, sizeof format->name, "%.5gx%.5g", sheet->width_mm, sheet->height_mm);
}
