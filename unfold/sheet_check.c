/* unfold/sheet_check.c - do pieces with their tabs fit the sheet? */
#include "unfold/sheet_check.h"
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/crease.h"
#include "unfold/pieces.h"
#include "unfold/sheets.h"

#include <string.h>

void ktg_sheet_check_free(ktg_sheet_check *check) {
    ktg_free(check->piece);
    ktg_free(check->magnification);
    *check = (ktg_sheet_check){0};
}

static ktg_pattern_side side_at(const ktg_sheet_check *check, uint32_t halfedge) {
    return (ktg_pattern_side){check->piece[halfedge / 3], halfedge / 3, halfedge % 3};
}

static ktg_pattern_edge *add_edge(const ktg_dual *dual, uint32_t halfedge, ktg_pattern *pattern) {
    ktg_pattern_edge *edge = &pattern->edges[pattern->edge_count++];
    uint32_t next = halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1;
    *edge = (ktg_pattern_edge){.vertices = {dual->faces[halfedge], dual->faces[next]},
                               .kind = KTG_EDGE_BORDER,
                               .side_count = 1,
                               .tab_on = -1,
                               .seam = KTG_NONE};
    return edge;
}

/* Inner edges and forced cuts with two sides, then everything else as borders. */
static void add_edges(const ktg_dual *dual, const bool *joined, const ktg_sheet_check *check,
                      bool *seen, ktg_pattern *pattern) {
    for (uint32_t e = 0; e < dual->edge_count + dual->forced_count; e++) {
        const ktg_dual_edge *from = &dual->edges[e];
        ktg_pattern_edge *edge = add_edge(dual, from->halfedge[0], pattern);
        edge->side_count = 2;
        edge->angle = ktg_dual_angle(dual, from);
        edge->kind = e >= dual->edge_count || !joined[e] ? KTG_EDGE_CUT
                     : fabs(edge->angle) < KTG_FLAT_FOLD ? KTG_EDGE_FLAT
                     : edge->angle > 0                   ? KTG_EDGE_MOUNTAIN
                                                         : KTG_EDGE_VALLEY;
        for (int s = 0; s < 2; s++) {
            edge->sides[s] = side_at(check, from->halfedge[s]);
            seen[from->halfedge[s]] = true;
        }
    }
    for (uint32_t h = 0; h < 3 * dual->face_count; h++)
        if (!seen[h])
            add_edge(dual, h, pattern)->sides[0] = side_at(check, h);
}

/* Pieces name faces of the mesh; here they are those of the dual. */
static void number_faces(const ktg_dual *dual, ktg_pattern *pattern, uint32_t *piece_of) {
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t i = 0; i < pattern->pieces[p].face_count; i++) {
            uint32_t *face = &pattern->pieces[p].faces[i];
            *face = ktg_dual_face(dual, *face);
            piece_of[*face] = (uint32_t)p;
        }
}

static ktg_status make_pattern(ktg_context *context, const ktg_dual *dual, double mm,
                               const bool *joined, ktg_sheet_check *check, ktg_pattern *pattern) {
    size_t capacity = 0;
    bool *closed = ktg_copy_array(context, joined, dual->edge_count, sizeof *joined);
    bool *seen = ktg_new(context, 3 * (size_t)dual->face_count, bool);
    pattern->edges = ktg_new(context, 3 * (size_t)dual->face_count + 1, ktg_pattern_edge);
    pattern->faces =
        ktg_copy_array(context, dual->faces, 3 * (size_t)dual->face_count, sizeof *dual->faces);
    pattern->face_count = dual->face_count;
    pattern->mm_per_unit = 1;
    pattern->components = ktg_new(context, 1, ktg_pattern_component); /* without a name */
    pattern->component_count = 1;
    ktg_status status = closed && seen && pattern->edges && pattern->faces && pattern->components
                            ? KTG_OK
                            : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_pieces_append(context, dual, 1 / mm, closed, 0, pattern, &capacity);
    if (status == KTG_OK) {
        number_faces(dual, pattern, check->piece);
        check->piece_count = (uint32_t)pattern->piece_count;
        add_edges(dual, closed, check, seen, pattern);
    }
    ktg_free(closed);
    ktg_free(seen);
    return status;
}

ktg_status ktg_sheet_magnification(ktg_context *context, const ktg_unfold_options *options,
                                   const ktg_pattern_piece *piece, bool careful,
                                   double *magnification) {
    double lost = 2 * options->sheet.margin_mm + (careful ? 2 * options->finish.tab_height_mm : 0);
    double width = options->sheet.width_mm - lost, height = options->sheet.height_mm - lost;
    double rotation;
    ktg_vec2 low;
    *magnification = 0;
    if (!(width > 0) || !(height > 0))
        return KTG_OK;
    return ktg_best_fit(context, careful ? piece->vertices : piece->outline,
                        careful ? piece->vertex_count : piece->outline_count, width, height,
                        &rotation, &low, magnification);
}

/* Marks the pieces with an edge to another part. */
static void mark_outer(const ktg_dual *dual, const ktg_sheet_check *check, bool *outer) {
    uint32_t first = dual->edge_count + dual->forced_count;
    for (uint32_t e = first; e < first + dual->outer_count; e++)
        outer[check->piece[dual->edges[e].halfedge[0] / 3]] = true;
}

static ktg_status measure(ktg_context *context, const ktg_dual *dual,
                          const ktg_unfold_options *options, const ktg_pattern *pattern,
                          bool careful, ktg_sheet_check *check) {
    bool *outer = ktg_new(context, pattern->piece_count, bool);
    check->magnification = ktg_new(context, pattern->piece_count, double);
    ktg_status status = outer && check->magnification ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        mark_outer(dual, check, outer);
    for (size_t p = 0; status == KTG_OK && p < pattern->piece_count; p++) {
        const ktg_pattern_piece *piece = &pattern->pieces[p];
        status = ktg_sheet_magnification(context, options, piece, careful || outer[p],
                                         &check->magnification[p]);
        check->too_large += check->magnification[p] < 1;
        check->too_many += options->piece_faces > 0 && piece->face_count > options->piece_faces;
    }
    ktg_free(outer);
    return status;
}

static ktg_status check_pattern(ktg_context *context, const ktg_dual *dual,
                                const ktg_unfold_options *options, double mm, const bool *joined,
                                bool careful, ktg_sheet_check *check, ktg_pattern *pattern) {
    ktg_finish_options finish = options->finish;
    ktg_finish_report report;
    finish.numbers = KTG_NUMBER_NONE;
    KTG_TRY(make_pattern(context, dual, mm, joined, check, pattern));
    KTG_TRY(ktg_pattern_finish(context, pattern, &finish, &report));
    check->tabs_none = report.tabs_none;
    check->tabs_wanted = report.tabs_none + report.tabs_reduced + report.tabs_full;
    return measure(context, dual, options, pattern, careful, check);
}

ktg_status ktg_sheet_check_run(ktg_context *context, const ktg_dual *dual,
                               const ktg_unfold_options *options, double mm, const bool *joined,
                               bool careful, ktg_sheet_check *check) {
    *check = (ktg_sheet_check){.piece = ktg_new(context, dual->face_count, uint32_t)};
    ktg_pattern *pattern = ktg_new(context, 1, ktg_pattern);
    ktg_status status = check->piece && pattern ? check_pattern(context, dual, options, mm, joined,
                                                                careful, check, pattern)
                                                : KTG_MEMORY;
    ktg_pattern_free(&pattern);
    if (status != KTG_OK)
        ktg_sheet_check_free(check);
    return status;
}

static ktg_status finish_copy(ktg_context *context, const ktg_unfold_options *options,
                              ktg_pattern *copy, bool *fit) {
    ktg_finish_options finish = options->finish;
    finish.numbers = KTG_NUMBER_NONE;
    KTG_TRY(ktg_pattern_scale(context, copy, options->mm_per_unit));
    KTG_TRY(ktg_pattern_finish(context, copy, &finish, NULL));
    for (size_t p = 0; p < copy->piece_count; p++) {
        double magnification;
        KTG_TRY(ktg_sheet_magnification(context, options, &copy->pieces[p], false, &magnification));
        *fit &= magnification >= 1;
    }
    return KTG_OK;
}

ktg_status ktg_sheets_fit(ktg_context *context, const ktg_unfold_options *options,
                          const ktg_pattern *pattern, bool *fit) {
    ktg_pattern *copy = NULL;
    *fit = true;
    if (!(options->mm_per_unit > 0) || options->oversize != KTG_OVERSIZE_SPLIT)
        return KTG_OK;
    ktg_status status = ktg_pattern_copy(context, pattern, &copy);
    if (status == KTG_OK)
        status = finish_copy(context, options, copy, fit);
    ktg_pattern_free(&copy);
    return status;
}
