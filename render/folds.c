/* render/folds.c - where each piece is folded: between its faces, and at the feet of its tabs. */
#include "render/draw.h"

#include "core/memory.h"

/* The stroke of a fold by `angle`, or KTG_STROKE_COUNT when it is too flat to be drawn. */
static ktg_stroke stroke_of_angle(const ktg_drawing *drawing, double angle) {
    if (!(fabs(angle) >= drawing->options.flat_below) || angle == 0)
        return KTG_STROKE_COUNT;
    return angle > 0 ? KTG_STROKE_MOUNTAIN : KTG_STROKE_VALLEY;
}

bool ktg_drawing_side(const ktg_drawing *drawing, const uint32_t *place,
                      const ktg_pattern_side *side, ktg_vec2 corners[3]) {
    const ktg_pattern *pattern = drawing->pattern;
    if (side->piece >= pattern->piece_count || side->face >= pattern->face_count ||
        side->corner > 2)
        return false;
    const ktg_pattern_piece *piece = &pattern->pieces[side->piece];
    uint32_t face = place[side->face];
    if (face >= piece->face_count || piece->faces[face] != side->face)
        return false;
    for (uint32_t k = 0; k < 3; k++)
        corners[k] = piece->vertices[piece->corners[3 * (size_t)face + (side->corner + k) % 3]];
    return true;
}

/* The fold between two faces of a piece: false when `edge` is none, or a flat one. */
static bool fold_of_edge(const ktg_drawing *drawing, const uint32_t *place,
                         const ktg_pattern_edge *edge, uint32_t *piece_index,
                         ktg_fold_segment *segment) {
    ktg_vec2 corners[3];
    if ((edge->kind != KTG_EDGE_MOUNTAIN && edge->kind != KTG_EDGE_VALLEY) ||
        edge->side_count < 1 || !ktg_drawing_side(drawing, place, &edge->sides[0], corners))
        return false;
    *piece_index = edge->sides[0].piece;
    *segment =
        (ktg_fold_segment){corners[0], corners[1], stroke_of_angle(drawing, edge->angle), false};
    return segment->stroke != KTG_STROKE_COUNT;
}

/* The foot of a tab: it folds the way its seam does. */
static bool fold_of_tab(const ktg_drawing *drawing, const ktg_pattern_tab *tab,
                        ktg_fold_segment *segment) {
    if (tab->edge >= drawing->pattern->edge_count || tab->corner_count < 3)
        return false;
    double angle = drawing->pattern->edges[tab->edge].angle;
    *segment = (ktg_fold_segment){tab->corners[0], tab->corners[tab->corner_count - 1],
                                  stroke_of_angle(drawing, angle), true};
    return segment->stroke != KTG_STROKE_COUNT;
}

/* Walks over all folds: counts them per piece in next[], or, when drawing->folds is there, stores
 * each at next[its piece] and moves that on. */
static void walk(ktg_drawing *drawing, const uint32_t *place, size_t *next) {
    const ktg_pattern *pattern = drawing->pattern;
    ktg_fold_segment segment;
    uint32_t piece;
    for (size_t e = 0; e < pattern->edge_count; e++)
        if (fold_of_edge(drawing, place, &pattern->edges[e], &piece, &segment)) {
            if (drawing->folds)
                drawing->folds[next[piece]] = segment;
            next[piece]++;
        }
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t t = 0; t < pattern->pieces[p].tab_count; t++)
            if (fold_of_tab(drawing, &pattern->pieces[p].tabs[t], &segment)) {
                if (drawing->folds)
                    drawing->folds[next[p]] = segment;
                next[p]++;
            }
}

void ktg_drawing_fill_places(const ktg_pattern *pattern, uint32_t *place) {
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t f = 0; f < pattern->pieces[p].face_count; f++)
            if (pattern->pieces[p].faces[f] < pattern->face_count)
                place[pattern->pieces[p].faces[f]] = (uint32_t)f;
}

ktg_status ktg_drawing_find_folds(ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    ktg_context *context = drawing->context;
    uint32_t *place = ktg_new(context, pattern->face_count, uint32_t);
    size_t *next = ktg_new(context, pattern->piece_count + 1, size_t);
    drawing->first_fold = ktg_new(context, pattern->piece_count + 1, size_t);
    ktg_status status = place && next && drawing->first_fold ? KTG_OK : KTG_MEMORY;
    /* The triangles of cloth are no folds. */
    if (status == KTG_OK && pattern->mode == KTG_PAPER) {
        ktg_drawing_fill_places(pattern, place);
        walk(drawing, place, next);
        for (size_t p = 0; p < pattern->piece_count; p++) {
            drawing->first_fold[p + 1] = drawing->first_fold[p] + next[p];
            next[p] = drawing->first_fold[p];
        }
        drawing->folds =
            ktg_new(context, drawing->first_fold[pattern->piece_count], ktg_fold_segment);
        if (drawing->folds)
            walk(drawing, place, next);
        else
            status = KTG_MEMORY;
    }
    ktg_free(place);
    ktg_free(next);
    return status;
}
