/* verify/form.c - the data itself: arrays that are there, indices in range, finite numbers. After
 * this the pattern can be walked safely, wherever it came from. */
#include "core/memory.h"
#include "verify/check.h"

#include <string.h>

#define MOST_COORDINATE 1e100 /* products of three stay finite */

static bool fits(double value) {
    return fabs(value) <= MOST_COORDINATE; /* false for NaN */
}

static bool fit2(const ktg_vec2 *points, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!fits(points[i].x) || !fits(points[i].y))
            return false;
    return true;
}

/* `count` items behind a pointer, few enough to be indexed by 32 bits. */
static bool array_there(const void *items, size_t count) {
    return (items || count == 0) && count < UINT32_MAX / 3;
}

static void check_surface_form(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    if (!array_there(p->vertices, p->vertex_count) || !array_there(p->faces, p->face_count)) {
        ktg_check_problem(check, "The surface has too many or no arrays of vertices and faces.");
        return;
    }
    if (p->face_count == 0)
        ktg_check_problem(check, "The surface has no faces.");
    for (size_t i = 0; i < p->vertex_count; i++)
        if (!fits(p->vertices[i].x) || !fits(p->vertices[i].y) || !fits(p->vertices[i].z))
            ktg_check_problem(check, "Vertex %zu of the surface is not finite.", i);
    for (size_t i = 0; i < 3 * (size_t)p->face_count; i++)
        if (p->faces[i] >= p->vertex_count)
            ktg_check_problem(check, "Face %zu refers to vertex %u, but there are %u.", i / 3,
                              p->faces[i], p->vertex_count);
    for (size_t i = 0; p->face_strain && i < p->face_count; i++)
        if (!(p->face_strain[i] >= 0) || !fits(p->face_strain[i]))
            ktg_check_problem(check, "The strain of face %zu is no number.", i);
    if (!fits(p->mm_per_unit) || p->mm_per_unit < 0)
        ktg_check_problem(check, "The scale is no number.");
    if (p->mode != KTG_PAPER && p->mode != KTG_CLOTH)
        ktg_check_problem(check, "The mode is neither paper nor cloth.");
}

static void check_marks_form(ktg_check *check, const ktg_pattern_piece *piece, size_t id) {
    size_t edges = check->pattern->edge_count;
    for (size_t i = 0; i < piece->tab_count; i++) {
        const ktg_pattern_tab *tab = &piece->tabs[i];
        if (tab->edge >= edges)
            ktg_check_problem(check, "Tab %zu of piece %zu is on an edge that does not exist.", i,
                              id);
        else if (tab->corner_count < 3 || tab->corner_count > KTG_TAB_CORNERS)
            ktg_check_problem(check, "The tab of piece %zu on edge %u has %u corners.", id,
                              tab->edge + 1, tab->corner_count);
        else if (!fit2(tab->corners, tab->corner_count))
            ktg_check_problem(check,
                              "The tab of piece %zu on edge %u has a corner that is not "
                              "finite.",
                              id, tab->edge + 1);
    }
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        if (!memchr(label->text, 0, sizeof label->text))
            ktg_check_problem(check, "Label %zu of piece %zu does not end.", i, id);
        else if (!fit2(&label->at, 1) || !fits(label->rotation) || !fits(label->height_mm))
            ktg_check_problem(check, "Label \"%s\" of piece %zu is not at a finite place.",
                              label->text, id);
        if (label->edge != KTG_NONE && label->edge >= edges)
            ktg_check_problem(check,
                              "Label %zu of piece %zu belongs to an edge that does not "
                              "exist.",
                              i, id);
    }
    for (size_t i = 0; i < piece->line_count; i++)
        if (!array_there(piece->lines[i].points, piece->lines[i].point_count) ||
            !fit2(piece->lines[i].points, piece->lines[i].point_count))
            ktg_check_problem(check, "Line %zu of piece %zu has a point that is not finite.", i,
                              id);
}

static void check_piece_form(ktg_check *check, const ktg_pattern_piece *piece, size_t id) {
    if (!array_there(piece->vertices, piece->vertex_count) ||
        !array_there(piece->faces, piece->face_count) ||
        !array_there(piece->corners, piece->face_count) ||
        !array_there(piece->outline, piece->outline_count) ||
        !array_there(piece->tabs, piece->tab_count) ||
        !array_there(piece->lines, piece->line_count) ||
        !array_there(piece->labels, piece->label_count)) {
        ktg_check_problem(check, "Piece %zu lacks an array.", id);
        return;
    }
    if (piece->component >= check->pattern->component_count)
        ktg_check_problem(check, "Piece %zu is of a component that does not exist.", id);
    if (!fit2(piece->vertices, piece->vertex_count))
        ktg_check_problem(check, "Piece %zu has a vertex that is not finite.", id);
    if (!fit2(piece->outline, piece->outline_count))
        ktg_check_problem(check, "The outline of piece %zu has a point that is not finite.", id);
    for (size_t i = 0; i < piece->face_count; i++)
        if (piece->faces[i] >= check->pattern->face_count)
            ktg_check_problem(check, "Piece %zu holds face %u, but the surface has %u.", id,
                              piece->faces[i], check->pattern->face_count);
    for (size_t i = 0; i < 3 * piece->face_count; i++)
        if (piece->corners[i] >= piece->vertex_count)
            ktg_check_problem(check,
                              "Face %u in piece %zu refers to vertex %u, but the piece has "
                              "%zu.",
                              piece->faces[i / 3], id, piece->corners[i], piece->vertex_count);
    check_marks_form(check, piece, id);
}

static bool side_fits(const ktg_pattern *p, const ktg_pattern_side *side) {
    return side->piece < p->piece_count && side->face < p->face_count && side->corner < 3;
}

static void check_edges_form(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    for (size_t i = 0; i < p->edge_count; i++) {
        const ktg_pattern_edge *edge = &p->edges[i];
        bool good = edge->vertices[0] < p->vertex_count && edge->vertices[1] < p->vertex_count &&
                    (unsigned)edge->kind <= KTG_EDGE_BORDER && fits(edge->angle) &&
                    edge->side_count >= 1 && edge->side_count <= 2 && edge->tab_on >= -1 &&
                    edge->tab_on < (int)edge->side_count &&
                    (edge->seam == KTG_NONE || edge->seam < p->seam_count);
        for (uint32_t s = 0; good && s < edge->side_count; s++)
            good = side_fits(p, &edge->sides[s]);
        if (!good)
            ktg_check_problem(check, "Edge %zu refers to something that does not exist.", i + 1);
    }
}

static void check_seams_form(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    for (size_t i = 0; i < p->seam_count; i++) {
        const ktg_pattern_seam *seam = &p->seams[i];
        bool good = array_there(seam->edges, seam->edge_count) && seam->edge_count > 0 &&
                    array_there(seam->first_side, seam->edge_count) &&
                    seam->pieces[0] < p->piece_count && seam->pieces[1] < p->piece_count &&
                    fits(seam->lengths_mm[0]) && fits(seam->lengths_mm[1]);
        for (uint32_t k = 0; good && k < seam->edge_count; k++)
            good = seam->edges[k] < p->edge_count && seam->first_side[k] < 2;
        if (!good)
            ktg_check_problem(check, "Seam %zu refers to something that does not exist.", i + 1);
    }
}

static void check_sheets_form(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    for (size_t i = 0; i < p->sheet_count; i++) {
        const ktg_pattern_sheet *sheet = &p->sheets[i];
        bool good = array_there(sheet->placements, sheet->placement_count) &&
                    fits(sheet->width_mm) && fits(sheet->height_mm) &&
                    (unsigned)sheet->kind <= KTG_TILE;
        for (int k = 0; k < 4; k++)
            good = good && fits(sheet->printable[k]);
        for (size_t k = 0; good && k < sheet->placement_count; k++) {
            const ktg_pattern_placement *at = &sheet->placements[k];
            good = at->piece < p->piece_count && fits(at->x) && fits(at->y) && fits(at->rotation);
        }
        if (!good)
            ktg_check_problem(check, "Sheet %zu refers to something that does not exist.", i + 1);
    }
}

/* Size of the surface; also how many millimetres the unit of an unscaled pattern counts as: as if
 * the surface were 200 mm across, so that the bounds in millimetres mean something. */
static void measure(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    ktg_vec3 low = p->vertices[p->faces[0]], high = low;
    for (size_t i = 0; i < 3 * (size_t)p->face_count; i++) {
        ktg_vec3 v = p->vertices[p->faces[i]];
        low = (ktg_vec3){fmin(low.x, v.x), fmin(low.y, v.y), fmin(low.z, v.z)};
        high = (ktg_vec3){fmax(high.x, v.x), fmax(high.y, v.y), fmax(high.z, v.z)};
        check->reach3 = fmax(check->reach3, fmax(fmax(fabs(v.x), fabs(v.y)), fabs(v.z)));
    }
    check->diagonal = ktg_check_distance3(low, high);
    check->reach3 = fmax(check->reach3, check->diagonal);
    if (p->mm_per_unit == 0)
        check->mm = check->diagonal / 200;
    if (!(check->diagonal > 0))
        ktg_check_problem(check, "The surface has no size.");
}

ktg_status ktg_check_form(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    check->report->pieces = (uint32_t)p->piece_count;
    check->report->components = (uint32_t)p->component_count;
    check->report->sheets = (uint32_t)p->sheet_count;
    check_surface_form(check);
    if (!array_there(p->pieces, p->piece_count) ||
        !array_there(p->components, p->component_count) || !array_there(p->edges, p->edge_count) ||
        !array_there(p->seams, p->seam_count) || !array_there(p->sheets, p->sheet_count)) {
        ktg_check_problem(check, "The pattern lacks an array.");
        return KTG_OK;
    }
    for (size_t i = 0; i < p->piece_count; i++)
        check_piece_form(check, &p->pieces[i], i + 1);
    check_edges_form(check);
    check_seams_form(check);
    check_sheets_form(check);
    if (check->report->problem_count == 0)
        measure(check);
    return KTG_OK;
}
