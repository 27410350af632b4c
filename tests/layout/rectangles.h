/* tests/layout/rectangles.h - patterns of simple pieces, and what must hold wherever they lie. */
#ifndef KTG_TESTS_LAYOUT_RECTANGLES_H
#define KTG_TESTS_LAYOUT_RECTANGLES_H

#include "core/memory.h"
#include "core/vec.h"
#include "layout/layout.h"
#include "layout/nest.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define SLACK_MM     1.0001e-7
#define MOST_CORNERS 16

/* Gives `piece` the rectangle of `size`, turned by `angle` about a corner that is not the origin:
 * two faces, and an outline that reaches `rim` beyond them. */
static inline void make_rectangle(ktg_context *context, ktg_pattern *pattern, size_t index,
                                  ktg_vec2 size, double rim, double angle) {
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3};
    ktg_pattern_piece *piece = &pattern->pieces[index];
    ktg_motion2 turn = {cos(angle), sin(angle), {13, -7}};
    piece->vertex_count = piece->outline_count = 4;
    piece->vertices = ktg_new(context, 4, ktg_vec2);
    piece->outline = ktg_new(context, 4, ktg_vec2);
    piece->face_count = 2;
    piece->faces = ktg_new(context, 2, uint32_t);
    piece->corners = ktg_copy_array(context, corners, 6, sizeof *corners);
    piece->cut_count = 1;
    for (int k = 0; k < 4; k++) {
        double x = k == 1 || k == 2, y = k >= 2;
        piece->vertices[k] = ktg_move2(turn, (ktg_vec2){x * size.x, y * size.y});
        piece->outline[k] = ktg_move2(
            turn, (ktg_vec2){x * size.x + (2 * x - 1) * rim, y * size.y + (2 * y - 1) * rim});
        pattern->vertices[4 * index + (size_t)k] = (ktg_vec3){x * size.x, y * size.y, 0};
    }
    for (uint32_t f = 0; f < 2; f++) {
        piece->faces[f] = 2 * (uint32_t)index + f;
        for (int k = 0; k < 3; k++)
            pattern->faces[6 * index + 3 * f + (size_t)k] =
                4 * (uint32_t)index + corners[3 * f + (size_t)k];
    }
}

/* A pattern with room for `count` rectangles. */
static inline ktg_pattern *make_pattern(ktg_context *context, size_t count) {
    ktg_pattern *pattern = ktg_new(context, 1, ktg_pattern);
    pattern->mm_per_unit = 12.5;
    pattern->vertex_count = 4 * (uint32_t)count;
    pattern->vertices = ktg_new(context, 4 * count, ktg_vec3);
    pattern->face_count = 2 * (uint32_t)count;
    pattern->faces = ktg_new(context, 6 * count, uint32_t);
    pattern->piece_count = count;
    pattern->pieces = ktg_new(context, count, ktg_pattern_piece);
    return pattern;
}

static inline ktg_pattern *one_rectangle(ktg_context *context, double width, double height,
                                         double rim) {
    ktg_pattern *pattern = make_pattern(context, 1);
    make_rectangle(context, pattern, 0, (ktg_vec2){width, height}, rim, 0.7);
    return pattern;
}

typedef struct box {
    double x0, y0, x1, y1;
} box;

/* The outline as it lies; `points` has room for it. */
static inline void place_outline(const ktg_pattern *pattern, const ktg_pattern_placement *placement,
                                 ktg_vec2 *points) {
    const ktg_pattern_piece *piece = &pattern->pieces[placement->piece];
    ktg_motion2 motion = {
        cos(placement->rotation), sin(placement->rotation), {placement->x, placement->y}};
    for (size_t i = 0; i < piece->outline_count; i++)
        points[i] = ktg_move2(motion, piece->outline[i]);
}

static inline box placed_box(const ktg_pattern *pattern, const ktg_pattern_placement *placement) {
    ktg_vec2 points[MOST_CORNERS];
    box around = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    place_outline(pattern, placement, points);
    for (size_t i = 0; i < pattern->pieces[placement->piece].outline_count; i++)
        around = (box){fmin(around.x0, points[i].x), fmin(around.y0, points[i].y),
                       fmax(around.x1, points[i].x), fmax(around.y1, points[i].y)};
    return around;
}

static inline double point_to_side(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a);
    double t = ktg_dot2(ktg_sub2(p, a), d) / ktg_dot2(d, d);
    return ktg_length2(ktg_sub2(p, ktg_madd2(a, fmin(1, fmax(0, t)), d)));
}

static inline bool is_inside(ktg_vec2 p, const ktg_vec2 *polygon, size_t count) {
    bool inside = false;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 a = polygon[i], b = polygon[(i + 1) % count];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

/* No corner of one inside the other or nearer than the gap. (With a gap, crossing sides have a
 * corner near or inside unless the shapes are larger than these tests have.) */
static inline void assert_corners_apart(const ktg_vec2 *a, size_t a_count, const ktg_vec2 *b,
                                        size_t b_count, double gap) {
    for (size_t i = 0; i < a_count; i++) {
        assert_false(is_inside(a[i], b, b_count));
        for (size_t k = 0; k < b_count; k++)
            assert_true(point_to_side(a[i], b[k], b[(k + 1) % b_count]) >= gap - 1e-6);
    }
}

static inline void assert_apart(const ktg_pattern *pattern, const ktg_pattern_placement *a,
                                const ktg_pattern_placement *b, double gap) {
    ktg_vec2 p[MOST_CORNERS] = {0}, q[MOST_CORNERS] = {0};
    size_t p_count = pattern->pieces[a->piece].outline_count;
    size_t q_count = pattern->pieces[b->piece].outline_count;
    place_outline(pattern, a, p);
    place_outline(pattern, b, q);
    assert_true(ktg_nest_apart(p, p_count, q, q_count, gap - 1e-6));
    assert_corners_apart(p, p_count, q, q_count, gap);
    assert_corners_apart(q, q_count, p, p_count, gap);
}

/* Each piece on one sheet, inside its printable area, `gap` apart. */
static inline void assert_well_laid(const ktg_pattern *pattern, double gap) {
    size_t *seen = calloc(pattern->piece_count, sizeof *seen);
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &pattern->sheets[s];
        assert_true(sheet->placement_count > 0);
        for (size_t i = 0; i < sheet->placement_count; i++) {
            box a = placed_box(pattern, &sheet->placements[i]);
            seen[sheet->placements[i].piece]++;
            assert_true(a.x0 >= sheet->printable[0] - SLACK_MM);
            assert_true(a.y0 >= sheet->printable[1] - SLACK_MM);
            assert_true(a.x1 <= sheet->printable[2] + SLACK_MM);
            assert_true(a.y1 <= sheet->printable[3] + SLACK_MM);
            for (size_t k = 0; k < i; k++)
                assert_apart(pattern, &sheet->placements[i], &sheet->placements[k], gap);
        }
    }
    for (size_t p = 0; p < pattern->piece_count; p++)
        assert_int_equal(seen[p], 1);
    free(seen);
}

/* Quick: the tests are run often. */
static inline ktg_layout_options quick_options(void) {
    ktg_layout_options options;
    ktg_layout_defaults(&options);
    options.effort = KTG_EFFORT_QUICK;
    return options;
}

#endif
