/* layout/too_large.c - what to say when a piece is larger than the sheet. */
#include "layout/turn.h"

#include "core/memory.h"
#include "core/text.h"
#include "core/vec.h"

#include <stdio.h>

/* How far the outline reaches beyond the faces (tabs, allowance), in any direction: the largest
 * difference of the two support functions. This part does not shrink with the scale. */
static double rim_mm(const ktg_pattern_piece *piece) {
    enum { DIRECTIONS = 32 };
    double rim = 0;
    for (int k = 0; k < DIRECTIONS; k++) {
        double angle = 2 * KTG_PI * k / DIRECTIONS, outer = -INFINITY, inner = -INFINITY;
        ktg_vec2 direction = {cos(angle), sin(angle)};
        for (size_t i = 0; i < piece->outline_count; i++)
            outer = fmax(outer, ktg_dot2(direction, piece->outline[i]));
        for (size_t i = 0; i < piece->vertex_count; i++)
            inner = fmax(inner, ktg_dot2(direction, piece->vertices[i]));
        if (isfinite(inner))
            rim = fmax(rim, outer - inner);
    }
    return rim;
}

/* The factor (below 1 where the piece is too large) that makes the piece fit, its rim staying as it
 * is; 0 when the rim alone fills the sheet. */
static ktg_status fitting_factor(ktg_context *context, const ktg_pattern_piece *piece,
                                 ktg_vec2 room, bool keep_grain, double *factor) {
    double rim = rim_mm(piece), rotation;
    ktg_vec2 left = {room.x - 2 * rim, room.y - 2 * rim}, low;
    *factor = 0;
    if (left.x <= 0 || left.y <= 0 || piece->vertex_count == 0)
        return KTG_OK;
    if (!keep_grain)
        return ktg_best_fit(context, piece->vertices, piece->vertex_count, left.x, left.y,
                            &rotation, &low, factor);
    ktg_turn turn = ktg_turn_points(piece->vertices, piece->vertex_count, 0);
    *factor = fmin(left.x / turn.size.x, left.y / turn.size.y);
    return KTG_OK;
}

/* `value` rounded down to three digits, so that what is promised to fit does. */
static double rounded_down(double value) {
    if (!(value > 0) || !isfinite(value))
        return 0;
    double unit = pow(10, floor(log10(value)) - 2);
    return floor(value / unit) * unit;
}

/* "at most about 8.1 mm per unit fits (finished 120 x 143 x 60 mm): ...". */
static void advise(const ktg_pattern *pattern, double factor, char *text, size_t size) {
    ktg_vec3 low = {0, 0, 0}, high = {0, 0, 0};
    for (uint32_t v = 0; v < pattern->vertex_count; v++) {
        ktg_vec3 p = pattern->vertices[v];
        if (v == 0)
            low = high = p;
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    double scale = pattern->mm_per_unit > 0 ? pattern->mm_per_unit : 1;
    double most = rounded_down(scale * factor), shrink = most / scale;
    ktg_format(text, size,
               "at most about %.6g mm per unit fits, that is a finished size (x, y, z) of "
               "%.4g x %.4g x %.4g mm: choose a smaller size or a larger sheet",
               most, shrink * (high.x - low.x), shrink * (high.y - low.y),
               shrink * (high.z - low.z));
}

ktg_status ktg_layout_too_large(ktg_context *context, const ktg_pattern *pattern,
                                const ktg_layout_options *options, size_t piece,
                                const ktg_turn *turn) {
    ktg_vec2 room = ktg_layout_room(&options->sheet);
    double least = 0.99; /* the piece at hand does not fit as it is, whatever rounding says */
    char advice[256] = "choose a larger sheet or smaller margins";
    for (size_t i = 0; i < pattern->piece_count; i++) {
        double factor;
        KTG_TRY(fitting_factor(context, &pattern->pieces[i], room, options->keep_grain, &factor));
        least = fmin(least, factor);
    }
    if (least > 0)
        advise(pattern, least, advice, sizeof advice);
    const char *name = pattern->pieces[piece].name;
    return ktg_fail(
        context, KTG_GEOMETRY,
        "piece %zu%s%s%s needs %.1f x %.1f mm%s at %.6g mm per unit, but %s has "
        "%.1f x %.1f mm inside its margins; %s",
        piece + 1, name && *name ? " (" : "", name ? name : "", name && *name ? ")" : "",
        turn->size.x, turn->size.y, options->keep_grain ? " along its grain" : "",
        pattern->mm_per_unit > 0 ? pattern->mm_per_unit : 1,
        *options->sheet.name ? options->sheet.name : "the sheet", room.x, room.y, advice);
}
