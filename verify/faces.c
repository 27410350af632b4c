/* verify/faces.c - each face of the surface exactly once and the right way round, pieces that hang
 * together, components. */
#include "core/memory.h"
#include "verify/check.h"

#include <string.h>

#define ROUNDING                                                                                   \
    1e-14 /* relative to the largest coordinate: what stored coordinates may be off                \
           */

static void claim_faces(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    memset(check->face_piece, 0xff, p->face_count * sizeof *check->face_piece);
    for (uint32_t i = 0; i < p->piece_count; i++) {
        if (p->pieces[i].face_count == 0)
            ktg_check_problem(check, "Piece %u has no faces.", i + 1);
        for (uint32_t slot = 0; slot < p->pieces[i].face_count; slot++) {
            uint32_t face = p->pieces[i].faces[slot];
            if (check->face_piece[face] != KTG_NONE)
                ktg_check_problem(check, "Face %u is in piece %u and again in piece %u.", face,
                                  check->face_piece[face] + 1, i + 1);
            else
                check->face_slot[face] = slot;
            check->face_piece[face] = i;
        }
    }
    for (uint32_t face = 0; face < p->face_count; face++)
        if (check->face_piece[face] == KTG_NONE)
            ktg_check_problem(check, "Face %u is in no piece.", face);
}

/* Each vertex of a piece is a copy of one vertex of the surface. `copy_of`: room for it. */
static void check_corners(ktg_check *check, uint32_t id, uint32_t *copy_of) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    memset(copy_of, 0xff, piece->vertex_count * sizeof *copy_of);
    for (size_t slot = 0; slot < piece->face_count; slot++) {
        const uint32_t *c = piece->corners + 3 * slot;
        uint32_t face = piece->faces[slot];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
            ktg_check_problem(check, "Face %u in piece %u uses one vertex of the piece twice.",
                              face, id + 1);
        for (int k = 0; k < 3; k++) {
            uint32_t vertex = check->pattern->faces[3 * face + (uint32_t)k];
            if (copy_of[c[k]] == KTG_NONE)
                copy_of[c[k]] = vertex;
            else if (copy_of[c[k]] != vertex)
                ktg_check_problem(check,
                                  "Vertex %u of piece %u stands for vertex %u and, in face "
                                  "%u, for vertex %u of the surface.",
                                  c[k], id + 1, copy_of[c[k]], face, vertex);
        }
    }
}

/* True for a face that runs clockwise. A face whose area is below what rounding of its coordinates
 * can do has no direction; `turned` counts those that surely have the wrong one. */
static bool is_turned(const ktg_check *check, uint32_t face) {
    ktg_vec2 corners[3];
    double longest = 0;
    for (uint32_t k = 0; k < 3; k++) {
        corners[k] = ktg_check_start2(check, 3 * face + k);
        longest =
            fmax(longest, ktg_check_distance2(corners[k], ktg_check_end2(check, 3 * face + k)));
    }
    double area = ktg_cross2(ktg_sub2(corners[1], corners[0]), ktg_sub2(corners[2], corners[0]));
    double slack = ROUNDING * check->reach2[check->face_piece[face]] * longest;
    bool needle = check->width[face] <= ROUNDING * check->reach3 && fabs(area) <= slack;
    return !(area > 0) && !needle;
}

static void check_turns(ktg_check *check, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    size_t turned = 0;
    for (size_t slot = 0; slot < piece->face_count; slot++)
        turned += is_turned(check, piece->faces[slot]);
    if (turned == piece->face_count && turned > 1) {
        ktg_check_problem(check, "Piece %u is mirrored: all its faces run clockwise.", id + 1);
        return;
    }
    for (size_t slot = 0; turned > 0 && slot < piece->face_count; slot++)
        if (is_turned(check, piece->faces[slot]))
            ktg_check_problem(check, "Face %u in piece %u is turned over: it runs clockwise.",
                              piece->faces[slot], id + 1);
}

static void measure_piece(ktg_check *check, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    check->reach2[id] = check->diagonal;
    for (size_t i = 0; i < piece->vertex_count; i++)
        check->reach2[id] =
            fmax(check->reach2[id], fmax(fabs(piece->vertices[i].x), fabs(piece->vertices[i].y)));
}

static void find_folds(ktg_check *check) {
    for (uint32_t h = 0; h < 3 * check->pattern->face_count; h++) {
        uint32_t m = check->twin[h];
        check->fold[h] = m != KTG_NONE && check->face_piece[h / 3] == check->face_piece[m / 3] &&
                         ktg_check_corner(check, h) == ktg_check_corner(check, ktg_check_next(m)) &&
                         ktg_check_corner(check, ktg_check_next(h)) == ktg_check_corner(check, m);
    }
}

/* Counts the faces reached from a piece's first one through folds. */
static size_t reach(const ktg_check *check, uint32_t id, uint32_t *stack, uint8_t *seen) {
    size_t depth = 0, count = 0;
    stack[depth++] = check->pattern->pieces[id].faces[0];
    seen[stack[0]] = 1;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        count++;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++)
            if (check->fold[h] && !seen[check->twin[h] / 3]) {
                seen[check->twin[h] / 3] = 1;
                stack[depth++] = check->twin[h] / 3;
            }
    }
    return count;
}

static ktg_status check_connected(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    uint32_t *stack = ktg_new(check->context, p->face_count, uint32_t);
    uint8_t *seen = ktg_new(check->context, p->face_count, uint8_t);
    for (uint32_t i = 0; stack && seen && i < p->piece_count; i++) {
        size_t count = reach(check, i, stack, seen);
        if (count < p->pieces[i].face_count)
            ktg_check_problem(check, "Piece %u falls apart: folds join %zu of its %zu faces.",
                              i + 1, count, p->pieces[i].face_count);
    }
    ktg_status status = stack && seen ? KTG_OK : KTG_MEMORY;
    ktg_free(stack);
    ktg_free(seen);
    return status;
}

static ktg_status check_pieces(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    size_t most = 0;
    for (size_t i = 0; i < p->piece_count; i++)
        most = p->pieces[i].vertex_count > most ? p->pieces[i].vertex_count : most;
    uint32_t *copy_of = ktg_new(check->context, most, uint32_t);
    if (!copy_of)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < p->piece_count; i++) {
        measure_piece(check, i);
        check_corners(check, i, copy_of);
        check_turns(check, i);
    }
    ktg_free(copy_of);
    return KTG_OK;
}

ktg_status ktg_check_faces(ktg_check *check) {
    uint32_t before = check->report->problem_count;
    claim_faces(check);
    if (check->report->problem_count > before)
        return KTG_OK;
    KTG_TRY(check_pieces(check));
    find_folds(check);
    return check_connected(check);
}

/* The pattern's components are the surface's connected parts, one for one. */
static void match_components(ktg_check *check, uint32_t *part_of, uint32_t *component_of,
                             uint32_t *pieces) {
    const ktg_pattern *p = check->pattern;
    memset(part_of, 0xff, p->component_count * sizeof *part_of);
    memset(component_of, 0xff, check->component_count * sizeof *component_of);
    for (uint32_t i = 0; i < p->piece_count; i++) {
        uint32_t component = p->pieces[i].component;
        uint32_t part = check->face_component[p->pieces[i].faces[0]];
        pieces[component]++;
        if (pieces[component] > check->report->most_pieces)
            check->report->most_pieces = pieces[component];
        if (part_of[component] == KTG_NONE)
            part_of[component] = part;
        if (component_of[part] == KTG_NONE)
            component_of[part] = component;
        if (part_of[component] != part)
            ktg_check_problem(check,
                              "Piece %u is listed under component %u, but its faces do not "
                              "hang together with that component's.",
                              i + 1, component + 1);
        else if (component_of[part] != component)
            ktg_check_problem(check,
                              "Piece %u is listed under component %u, but its faces belong "
                              "to component %u.",
                              i + 1, component + 1, component_of[part] + 1);
    }
    for (uint32_t c = 0; c < p->component_count; c++)
        if (pieces[c] == 0)
            ktg_check_problem(check, "Component %u has no pieces.", c + 1);
}

ktg_status ktg_check_components(ktg_check *check) {
    size_t count = check->pattern->component_count;
    uint32_t *part_of = ktg_new(check->context, count, uint32_t);
    uint32_t *pieces = ktg_new(check->context, count, uint32_t);
    uint32_t *component_of = ktg_new(check->context, check->component_count, uint32_t);
    ktg_status status = part_of && pieces && component_of ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        match_components(check, part_of, component_of, pieces);
    ktg_free(part_of);
    ktg_free(pieces);
    ktg_free(component_of);
    return status;
}
