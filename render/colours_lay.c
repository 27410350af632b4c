/* render/colours_lay.c - which face a dot of the sheet belongs to: the one it lies in, or, beside
 * the pieces, the one whose edge is nearest. */
#include "render/colours.h"

#include "core/memory.h"

#include <string.h>

ktg_vec2 ktg_colours_dot(const ktg_colour_plan *plan, ktg_motion2 motion, ktg_vec2 point) {
    ktg_vec2 on_sheet = ktg_move2(motion, point);
    ktg_vec2 on_page = {on_sheet.x, plan->sheet->height_mm - on_sheet.y};
    return ktg_mul2(ktg_sub2(on_page, plan->colours->corner), plan->colours->dots_per_mm);
}

/* ---- faces --------------------------------------------------------------------------------- */

/* The weights of corner k grow from 0 at the opposite edge to 1. */
static bool weigh(ktg_laid_face *laid) {
    const ktg_vec2 *c = laid->corners;
    double twice = ktg_cross2(ktg_sub2(c[1], c[0]), ktg_sub2(c[2], c[0]));
    if (!(fabs(twice) > 0) || !isfinite(1 / twice))
        return false;
    for (size_t k = 0; k < 3; k++) {
        ktg_vec2 a = c[(k + 1) % 3], b = c[(k + 2) % 3];
        laid->right[k] = (a.y - b.y) / twice;
        laid->down[k] = (b.x - a.x) / twice;
        laid->at[k] = ktg_cross2(a, b) / twice;
    }
    return true;
}

static double clamp(double at, double most) {
    return ktg_max(0, ktg_min(most, at));
}

/* The dots whose middles lie in a rectangle that reaches `beyond` further than the points. */
static void range_of(const ktg_colours *colours, const ktg_vec2 *points, size_t count,
                     double beyond, uint32_t from[2], uint32_t to[2]) {
    ktg_vec2 low = points[0], high = points[0];
    for (size_t i = 1; i < count; i++) {
        low = (ktg_vec2){ktg_min(low.x, points[i].x), ktg_min(low.y, points[i].y)};
        high = (ktg_vec2){ktg_max(high.x, points[i].x), ktg_max(high.y, points[i].y)};
    }
    from[0] = (uint32_t)clamp(floor(low.x - beyond), colours->width);
    from[1] = (uint32_t)clamp(floor(low.y - beyond), colours->height);
    to[0] = (uint32_t)clamp(ceil(high.x + beyond), colours->width);
    to[1] = (uint32_t)clamp(ceil(high.y + beyond), colours->height);
}

/* A dot on the line between two faces goes to the first. */
static void fill_face(ktg_colour_plan *plan, uint32_t index) {
    const ktg_laid_face *laid = &plan->faces[index];
    uint32_t from[2], to[2];
    range_of(plan->colours, laid->corners, 3, 0, from, to);
    for (uint32_t y = from[1]; y < to[1]; y++) {
        uint32_t *row = plan->owners + (size_t)y * plan->colours->width;
        for (uint32_t x = from[0]; x < to[0]; x++) {
            bool inside = row[x] == KTG_NONE;
            for (size_t k = 0; inside && k < 3; k++)
                inside =
                    laid->at[k] + (x + 0.5) * laid->right[k] + (y + 0.5) * laid->down[k] >= -1e-9;
            if (inside)
                row[x] = index;
        }
    }
}

static void lay_piece(ktg_colour_plan *plan, const ktg_pattern_placement *placement,
                      uint32_t *laid_as) {
    const ktg_pattern_piece *piece = &plan->drawing->pattern->pieces[placement->piece];
    ktg_motion2 motion = ktg_page_motion(placement);
    for (size_t f = 0; f < piece->face_count; f++) {
        ktg_laid_face *laid = &plan->faces[plan->face_count];
        laid->face = piece->faces[f];
        for (size_t k = 0; k < 3; k++)
            laid->corners[k] =
                ktg_colours_dot(plan, motion, piece->vertices[piece->corners[3 * f + k]]);
        if (!weigh(laid))
            continue;
        laid_as[laid->face] = (uint32_t)plan->face_count;
        fill_face(plan, (uint32_t)plan->face_count++);
    }
}

/* ---- the strip beside them ----------------------------------------------------------------- */

static double distance2(ktg_vec2 from, ktg_vec2 to, ktg_vec2 point) {
    ktg_vec2 along = ktg_sub2(to, from), away = ktg_sub2(point, from);
    double square = ktg_dot2(along, along);
    double t = square > 0 ? clamp(ktg_dot2(away, along) / square, 1) : 0;
    ktg_vec2 rest = ktg_sub2(away, ktg_mul2(along, t));
    return ktg_dot2(rest, rest);
}

/* Dots beyond an edge become those of its face where no other edge is nearer. `away`: the square of
 * each dot's distance so far; 0 within faces. */
static void fill_beyond(ktg_colour_plan *plan, uint32_t index, size_t corner, double bleed,
                        float *away) {
    const ktg_laid_face *laid = &plan->faces[index];
    ktg_vec2 ends[2] = {laid->corners[corner], laid->corners[(corner + 1) % 3]};
    uint32_t from[2], to[2];
    range_of(plan->colours, ends, 2, bleed, from, to);
    for (uint32_t y = from[1]; y < to[1]; y++)
        for (uint32_t x = from[0]; x < to[0]; x++) {
            size_t at = (size_t)y * plan->colours->width + x;
            float square = (float)distance2(ends[0], ends[1], (ktg_vec2){x + 0.5, y + 0.5});
            if (square < away[at]) {
                away[at] = square;
                plan->owners[at] = index;
            }
        }
}

static bool is_open(const ktg_pattern_edge *edge) {
    return edge->kind == KTG_EDGE_CUT || edge->kind == KTG_EDGE_BORDER;
}

static ktg_status lay_beyond(ktg_colour_plan *plan, const uint32_t *laid_as) {
    const ktg_pattern *pattern = plan->drawing->pattern;
    size_t count = (size_t)plan->colours->width * plan->colours->height;
    double bleed = plan->drawing->options.bleed_mm * plan->colours->dots_per_mm;
    float *away = ktg_new(plan->drawing->context, count, float);
    if (!away)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++)
        away[i] = plan->owners[i] == KTG_NONE ? (float)(bleed * bleed) : 0;
    for (size_t e = 0; e < pattern->edge_count; e++)
        for (uint32_t k = 0; is_open(&pattern->edges[e]) && k < pattern->edges[e].side_count; k++) {
            const ktg_pattern_side *side = &pattern->edges[e].sides[k];
            if (side->face < pattern->face_count && laid_as[side->face] != KTG_NONE)
                fill_beyond(plan, laid_as[side->face], side->corner % 3, bleed, away);
        }
    ktg_free(away);
    return KTG_OK;
}

/* ---- both ---------------------------------------------------------------------------------- */

/* Cloth that is cut on the fold shows one half of its piece, and is left plain. */
ktg_status ktg_colours_lay(ktg_colour_plan *plan) {
    const ktg_pattern *pattern = plan->drawing->pattern;
    ktg_context *context = plan->drawing->context;
    size_t dots = (size_t)plan->colours->width * plan->colours->height, most = 0;
    for (size_t i = 0; i < plan->sheet->placement_count; i++)
        most += pattern->pieces[plan->sheet->placements[i].piece].face_count;
    plan->faces = ktg_new(context, most, ktg_laid_face);
    plan->owners = ktg_new(context, dots, uint32_t);
    uint32_t *laid_as = ktg_new(context, pattern->face_count, uint32_t);
    ktg_status status = plan->faces && plan->owners && laid_as ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        memset(plan->owners, 0xff, dots * sizeof *plan->owners);
        memset(laid_as, 0xff, pattern->face_count * sizeof *laid_as);
        for (size_t i = 0; i < plan->sheet->placement_count; i++)
            if (!pattern->pieces[plan->sheet->placements[i].piece].on_fold)
                lay_piece(plan, &plan->sheet->placements[i], laid_as);
        status = lay_beyond(plan, laid_as);
    }
    ktg_free(laid_as);
    return status;
}
