/* tests/pattern/cloth.h - small patterns of cloth, piece by piece, for the tests. */
#ifndef KTG_TESTS_PATTERN_CLOTH_H
#define KTG_TESTS_PATTERN_CLOTH_H

#include "core/memory.h"
#include "core/vec.h"
#include "pattern/pattern.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CLOTH_MOST 16

/* A piece as a polygon, counter-clockwise, cut into triangles from its corner 0, which sees all the
 * others. surface: the surface's vertex at each corner; where two corners have the same, and two
 * neighbours as well, a seam joins them. */
typedef struct cloth_piece {
    const char *name;
    uint32_t count;
    ktg_vec2 points[CLOTH_MOST];
    uint32_t surface[CLOTH_MOST];
} cloth_piece;

static inline void cloth_fill_piece(ktg_context *context, const cloth_piece *from, uint32_t first,
                                    ktg_pattern *p, ktg_pattern_piece *piece) {
    piece->name = ktg_copy_text(context, from->name, SIZE_MAX);
    piece->cut_count = 1;
    piece->vertex_count = from->count;
    piece->vertices = ktg_copy_array(context, from->points, from->count, sizeof(ktg_vec2));
    piece->face_count = from->count - 2;
    piece->faces = ktg_new(context, piece->face_count, uint32_t);
    piece->corners = ktg_new(context, 3 * piece->face_count, uint32_t);
    for (uint32_t f = 0; f < piece->face_count; f++) {
        const uint32_t corners[3] = {0, f + 1, f + 2};
        piece->faces[f] = first + f;
        for (uint32_t k = 0; k < 3; k++) {
            piece->corners[3 * f + k] = corners[k];
            p->faces[3 * (first + f) + k] = from->surface[corners[k]];
        }
    }
}

/* The other side of half-edge h, whatever joins them, or KTG_NONE. */
static inline uint32_t cloth_twin(const ktg_pattern *p, uint32_t h) {
    uint32_t a = p->faces[h], b = p->faces[h % 3 == 2 ? h - 2 : h + 1];
    for (uint32_t g = 0; g < 3 * p->face_count; g++)
        if (p->faces[g] == b && p->faces[g % 3 == 2 ? g - 2 : g + 1] == a)
            return g;
    return KTG_NONE;
}

/* Where half-edge h starts, as a vertex of its piece. */
static inline uint32_t cloth_corner(const ktg_pattern *p, const uint32_t *piece_of, uint32_t h) {
    const ktg_pattern_piece *piece = &p->pieces[piece_of[h / 3]];
    return piece->corners[h - 3 * piece->faces[0]];
}

static inline void cloth_add_edge(ktg_pattern *p, const uint32_t *piece_of, uint32_t h) {
    uint32_t g = cloth_twin(p, h);
    if (g != KTG_NONE && g < h)
        return;
    ktg_pattern_edge *e = &p->edges[p->edge_count++];
    uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
    *e = (ktg_pattern_edge){{p->faces[h], p->faces[next]},
                            KTG_EDGE_BORDER,
                            0,
                            1,
                            {{piece_of[h / 3], h / 3, h % 3}},
                            -1,
                            KTG_NONE};
    if (g == KTG_NONE)
        return;
    bool fold = piece_of[h / 3] == piece_of[g / 3] &&
                cloth_corner(p, piece_of, next) == cloth_corner(p, piece_of, g);
    e->kind = fold ? KTG_EDGE_FLAT : KTG_EDGE_CUT;
    e->forced = !fold;
    e->side_count = 2;
    e->sides[1] = (ktg_pattern_side){piece_of[g / 3], g / 3, g % 3};
}

/* A pattern of one component, in mm; positions: of the surface, vertex_count. */
static inline ktg_pattern *cloth_make(ktg_context *context, const cloth_piece *pieces,
                                      uint32_t count, const ktg_vec3 *positions,
                                      uint32_t vertex_count) {
    ktg_pattern *p = ktg_new(context, 1, ktg_pattern);
    uint32_t piece_of[8 * CLOTH_MOST];
    p->mode = KTG_CLOTH;
    p->mm_per_unit = 1;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t f = 0; f + 2 < pieces[i].count; f++)
            piece_of[p->face_count++] = i;
    p->model_faces = p->face_count;
    p->vertex_count = vertex_count;
    p->vertices = ktg_copy_array(context, positions, vertex_count, sizeof *positions);
    p->faces = ktg_new(context, 3 * (size_t)p->face_count, uint32_t);
    p->edges = ktg_new(context, 3 * (size_t)p->face_count, ktg_pattern_edge);
    p->pieces = ktg_new(context, count, ktg_pattern_piece);
    p->piece_count = count;
    p->components = ktg_new(context, 1, ktg_pattern_component);
    p->component_count = 1;
    p->components[0].name = ktg_copy_text(context, "garment", SIZE_MAX);
    for (uint32_t i = 0, first = 0; i < count; first += pieces[i++].count - 2)
        cloth_fill_piece(context, &pieces[i], first, p, &p->pieces[i]);
    for (uint32_t h = 0; h < 3 * p->face_count; h++)
        cloth_add_edge(p, piece_of, h);
    return p;
}

/* Two oblongs of 100 x 600 side by side, sewn along their long sides in the middle: mirror images.
 */
static inline ktg_pattern *cloth_oblongs(ktg_context *context) {
    static const cloth_piece pieces[] = {
        {"left", 4, {{0, 0}, {100, 0}, {100, 600}, {0, 600}}, {0, 1, 2, 3}},
        {"right", 4, {{0, 0}, {100, 0}, {100, 600}, {0, 600}}, {1, 4, 5, 2}}};
    static const ktg_vec3 positions[] = {{0, 0, 0},   {100, 0, 0}, {100, 600, 0},
                                         {0, 600, 0}, {200, 0, 0}, {200, 600, 0}};
    return cloth_make(context, pieces, 2, positions, 6);
}

/* An oblong of 200 x 300 with a dart of 20 x 80 in the middle of its lower side, whose point sees
 * all. */
static inline ktg_pattern *cloth_with_dart(ktg_context *context) {
    static const cloth_piece piece = {
        "skirt",
        7,
        {{100, 80}, {110, 0}, {200, 0}, {200, 300}, {0, 300}, {0, 0}, {90, 0}},
        {0, 1, 2, 3, 4, 5, 1}};
    static const ktg_vec3 positions[] = {{100, 80, 0},  {100, 0, 0}, {200, 0, 0},
                                         {200, 300, 0}, {0, 300, 0}, {0, 0, 0}};
    return cloth_make(context, &piece, 1, positions, 6);
}

static inline size_t cloth_count_lines(const ktg_pattern_piece *piece, ktg_line_kind kind) {
    size_t count = 0;
    for (size_t i = 0; i < piece->line_count; i++)
        count += piece->lines[i].kind == kind;
    return count;
}

static inline ktg_finish_report cloth_finish(ktg_context *context, ktg_pattern *p,
                                             const ktg_finish_options *options) {
    ktg_finish_report report;
    assert_int_equal(ktg_pattern_finish(context, p, options, &report), KTG_OK);
    return report;
}

/* Of what is cut out, in mm^2. */
static inline double cloth_area(const ktg_pattern_piece *piece) {
    double twice = 0;
    for (size_t i = 0; i < piece->outline_count; i++)
        twice += ktg_cross2(piece->outline[i], piece->outline[(i + 1) % piece->outline_count]);
    return twice / 2;
}

static inline bool cloth_has_label(const ktg_pattern_piece *piece, const char *text) {
    for (size_t i = 0; i < piece->label_count; i++)
        if (strcmp(piece->labels[i].text, text) == 0)
            return true;
    return false;
}

#endif
