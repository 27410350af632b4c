/* pattern/halve.c - symmetric pieces cut on the fold of the cloth: half of the outline, up to the
 * line in the middle that is laid on the fold. */
#include "core/memory.h"
#include "pattern/cloth.h"

#include <math.h>
#include <string.h>

/* What lies so near to the fold lies on it: a mark in the middle of a seam that is its own mirror
 * image is drawn. */
#define ON_FOLD_MM 1e-6

static bool is_right(ktg_vec2 p, double middle) {
    return p.x >= middle - ON_FOLD_MM;
}

/* Where x = middle crosses from a to b, one of which is on its right. */
static ktg_vec2 crossing(ktg_vec2 a, ktg_vec2 b, double middle) {
    double t = fmax(0, fmin((middle - a.x) / (b.x - a.x), 1));
    return (ktg_vec2){middle, a.y + t * (b.y - a.y)};
}

/* The part of a closed outline right of x = middle, with the ends of its stretch along that line;
 * false where there are several parts. */
static ktg_status right_half(ktg_context *context, const ktg_pattern_piece *piece, double middle,
                             ktg_vec2 **half, size_t *count, ktg_vec2 fold[2], bool *whole) {
    size_t n = piece->outline_count, crossings = 0;
    *count = 0;
    *half = ktg_new(context, 2 * n, ktg_vec2);
    if (!*half)
        return KTG_MEMORY;
    for (size_t i = 0; i < n; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % n];
        if (is_right(a, middle))
            (*half)[(*count)++] = a;
        if (is_right(a, middle) == is_right(b, middle))
            continue;
        ktg_vec2 at = crossing(a, b, middle);
        (*half)[(*count)++] = at;
        if (crossings < 2)
            fold[crossings] = at;
        crossings++;
    }
    *whole = crossings == 2;
    return KTG_OK;
}

/* ---- lines -------------------------------------------------------------------------------- */

/* Appends the parts of a line right of x = middle as lines of their own. */
static ktg_status keep_right(ktg_context *context, const ktg_pattern_line *line, double middle,
                             ktg_pattern_piece *piece) {
    for (size_t i = 0; i < line->point_count; i++) {
        bool starts =
            is_right(line->points[i], middle) && (i == 0 || !is_right(line->points[i - 1], middle));
        if (!starts)
            continue;
        size_t end = i;
        while (end + 1 < line->point_count && is_right(line->points[end + 1], middle))
            end++;
        ktg_vec2 *points = ktg_new(context, end - i + 3, ktg_vec2);
        if (!points)
            return KTG_MEMORY;
        size_t count = 0;
        if (i > 0)
            points[count++] = crossing(line->points[i - 1], line->points[i], middle);
        for (size_t k = i; k <= end; k++)
            points[count++] = line->points[k];
        if (end + 1 < line->point_count)
            points[count++] = crossing(line->points[end], line->points[end + 1], middle);
        KTG_TRY(ktg_piece_add_line(context, piece, line->kind, points, count));
    }
    return KTG_OK;
}

static ktg_status halve_lines(ktg_context *context, ktg_pattern_piece *piece, double middle) {
    ktg_pattern_piece whole = {.line_count = piece->line_count, .lines = piece->lines};
    ktg_status status = KTG_OK;
    piece->lines = NULL;
    piece->line_count = 0;
    for (size_t i = 0; i < whole.line_count; i++) {
        if (status == KTG_OK)
            status = keep_right(context, &whole.lines[i], middle, piece);
        ktg_free(whole.lines[i].points);
    }
    ktg_free(whole.lines);
    return status;
}

/* ---- pieces ------------------------------------------------------------------------------- */

static ktg_status halve(ktg_context *context, ktg_pattern_piece *piece, double middle,
                        bool *halved) {
    ktg_vec2 *half = NULL, fold[2];
    size_t count;
    KTG_TRY(right_half(context, piece, middle, &half, &count, fold, halved));
    if (!*halved) {
        ktg_free(half);
        return KTG_OK;
    }
    ktg_free(piece->outline);
    piece->outline = half;
    piece->outline_count = count;
    piece->on_fold = true;
    KTG_TRY(halve_lines(context, piece, middle));
    bool upwards = fold[0].y < fold[1].y;
    return ktg_piece_add_segment(context, piece, KTG_LINE_FOLD, fold[upwards ? 0 : 1],
                                 fold[upwards ? 1 : 0]);
}

static bool is_wanted(const ktg_cloth *cloth, uint32_t p) {
    const ktg_pattern_piece *piece = &cloth->pattern->pieces[p];
    for (size_t i = 0; piece->name && i < cloth->options->on_fold_count; i++)
        if (strcmp(cloth->options->on_fold[i], piece->name) == 0)
            return true;
    return false;
}

ktg_status ktg_pieces_halve(ktg_context *context, ktg_cloth *cloth) {
    for (uint32_t p = 0; p < cloth->pattern->piece_count; p++) {
        ktg_pattern_piece *piece = &cloth->pattern->pieces[p];
        const ktg_likeness *self = &cloth->selves[p];
        bool halved = false;
        piece->on_fold = false;
        if (!is_wanted(cloth, p))
            continue;
        if (self->piece != KTG_NONE)
            KTG_TRY(halve(context, piece, self->moved.x / 2, &halved));
        if (!halved)
            ktg_log(
                context, KTG_LOG_WARNING,
                "piece \"%s\" cannot be cut on the fold: it is not symmetric across one upright "
                "line",
                piece->name);
    }
    return KTG_OK;
}
