/* render/joints.c - the marks of butt joints: cut edges that have a tab on neither side.
 *
 * Each copy bears half a diamond just inside its face, at the same place: glued edge to edge the
 * halves make one whole, so that they say how the edges meet too. */
#include "render/draw.h"

#include "core/memory.h"

#include <string.h>

/* Shorter edges go without a tab as a matter of course, and without a mark. */
#define LEAST_EDGE_MM 4.0

/* A half diamond is this high and this wide for its height; where there is no room it shrinks. */
#define MARK_MM      1.0
#define WIDE_PER_MM  1.7
#define AWAY_MM      0.2 /* from other lines and labels */
#define DIGIT_WIDTH  0.9 /* of a label's letter, for its height */
#define MARK_CORNERS 3

/* One side of a butt joint: the edge from a to b, its face inside. */
typedef struct joint_side {
    const ktg_pattern_piece *piece;
    uint32_t piece_index;
    ktg_vec2 a, b, apex, along, in;
    double length;
} joint_side;

static bool find_side(const ktg_drawing *drawing, const uint32_t *place,
                      const ktg_pattern_side *side, joint_side *found) {
    ktg_vec2 corners[3];
    if (!ktg_drawing_side(drawing, place, side, corners))
        return false;
    ktg_vec2 d = ktg_sub2(corners[1], corners[0]);
    double length = ktg_length2(d);
    if (!(length >= LEAST_EDGE_MM))
        return false;
    ktg_vec2 along = ktg_mul2(d, 1 / length);
    *found = (joint_side){&drawing->pattern->pieces[side->piece],
                          side->piece,
                          corners[0],
                          corners[1],
                          corners[2],
                          along,
                          ktg_perp2(along),
                          length};
    return true;
}

/* The half diamond of the given height at `t` of the edge. */
static void mark_at(const joint_side *s, double t, double height, ktg_vec2 corners[MARK_CORNERS]) {
    ktg_vec2 foot = ktg_madd2(s->a, t * s->length, s->along);
    corners[0] = ktg_madd2(foot, -height * WIDE_PER_MM / 2, s->along);
    corners[1] = ktg_madd2(foot, height, s->in);
    corners[2] = ktg_madd2(foot, height * WIDE_PER_MM / 2, s->along);
}

/* The distance from p to the line from a to b, + on its left. */
static double depth(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a);
    double length = ktg_length2(d);
    return length > 0 ? ktg_cross2(d, ktg_sub2(p, a)) / length : 0;
}

/* Inside the face, and so far from its other sides that a mark on one of them has room too. */
static bool is_in_face(const joint_side *s, const ktg_vec2 mark[MARK_CORNERS], double height) {
    double away = height + AWAY_MM;
    for (int k = 0; k < MARK_CORNERS; k++)
        if (depth(mark[k], s->b, s->apex) < (k == 1 ? away : AWAY_MM) ||
            depth(mark[k], s->apex, s->a) < (k == 1 ? away : AWAY_MM))
            return false;
    return true;
}

/* True when the mark comes near the label's box: both are within a circle and a box that grew by
 * AWAY_MM; corners and middles of the mark's sides are looked at. */
static bool meets_label(const ktg_vec2 mark[MARK_CORNERS], const ktg_pattern_label *label) {
    double half = label->height_mm * (double)strlen(label->text) * DIGIT_WIDTH / 2 + AWAY_MM;
    double c = cos(label->rotation), s = sin(label->rotation);
    for (int k = 0; k < 2 * MARK_CORNERS; k++) {
        ktg_vec2 from = mark[k / 2], to = mark[(k / 2 + k % 2) % MARK_CORNERS];
        ktg_vec2 v = ktg_sub2(ktg_mul2(ktg_add2(from, to), 0.5), label->at);
        if (fabs(c * v.x + s * v.y) < half &&
            fabs(c * v.y - s * v.x) < label->height_mm / 2 + AWAY_MM)
            return true;
    }
    return false;
}

static bool is_free(const joint_side *s, double t, double height) {
    ktg_vec2 mark[MARK_CORNERS];
    mark_at(s, t, height, mark);
    if (!is_in_face(s, mark, height))
        return false;
    for (size_t i = 0; i < s->piece->label_count; i++)
        if (meets_label(mark, &s->piece->labels[i]))
            return false;
    return true;
}

/* Where both copies (`other` runs the other way) have room, the middle first; false when nowhere.
 */
static bool find_place(const joint_side *s, const joint_side *other, double *t, double *height) {
    static const double parts[] = {0.5, 0.4, 0.6, 0.3, 0.7, 0.22, 0.78, 0.14, 0.86};
    for (*height = MARK_MM; *height > 0.45 * MARK_MM; *height *= 0.8)
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
            *t = parts[k];
            if (is_free(s, *t, *height) && (!other || is_free(other, 1 - *t, *height)))
                return true;
        }
    return false;
}

static void add(ktg_drawing *drawing, const joint_side *s, double t, double height) {
    ktg_joint_mark *mark = &drawing->joints[drawing->joint_count++];
    mark->piece = s->piece_index;
    mark_at(s, t, height, mark->corners);
}

/* The same place on both copies, else one for each; a copy too narrow for any goes without. */
static void mark_edge(ktg_drawing *drawing, const joint_side sides[2]) {
    double t, height;
    if (find_place(&sides[0], &sides[1], &t, &height)) {
        add(drawing, &sides[0], t, height);
        add(drawing, &sides[1], 1 - t, height);
        return;
    }
    for (int k = 0; k < 2; k++)
        if (find_place(&sides[k], NULL, &t, &height))
            add(drawing, &sides[k], t, height);
}

static bool has_tabs(const ktg_pattern *pattern) {
    for (size_t p = 0; p < pattern->piece_count; p++)
        if (pattern->pieces[p].tab_count > 0)
            return true;
    return false;
}

ktg_status ktg_drawing_find_joints(ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    if (pattern->mode != KTG_PAPER || !has_tabs(pattern))
        return KTG_OK; /* without tabs all edges are butt joints */
    uint32_t *place = ktg_new(drawing->context, pattern->face_count, uint32_t);
    drawing->joints = ktg_new(drawing->context, 2 * pattern->edge_count, ktg_joint_mark);
    ktg_status status = place && drawing->joints ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        ktg_drawing_fill_places(pattern, place);
    for (size_t e = 0; status == KTG_OK && e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        joint_side sides[2];
        if (edge->kind == KTG_EDGE_CUT && edge->side_count == 2 && edge->tab_on < 0 &&
            find_side(drawing, place, &edge->sides[0], &sides[0]) &&
            find_side(drawing, place, &edge->sides[1], &sides[1]))
            mark_edge(drawing, sides);
    }
    ktg_free(place);
    return status;
}

void ktg_draw_joints(const ktg_page *page, const ktg_pattern_placement *placement) {
    const ktg_drawing *drawing = page->drawing;
    ktg_motion2 motion = ktg_page_motion(placement);
    for (size_t i = 0; i < drawing->joint_count; i++) {
        const ktg_joint_mark *mark = &drawing->joints[i];
        if (mark->piece != placement->piece)
            continue;
        ktg_vec2 corners[MARK_CORNERS];
        for (int k = 0; k < MARK_CORNERS; k++)
            corners[k] = ktg_page_point(page, motion, mark->corners[k]);
        ktg_draw_joint(drawing, page->cairo, corners);
    }
}

void ktg_draw_joint(const ktg_drawing *drawing, cairo_t *cairo,
                    const ktg_vec2 corners[MARK_CORNERS]) {
    ktg_draw_set_stroke(drawing, cairo, KTG_STROKE_JOINT);
    for (int k = 0; k < MARK_CORNERS; k++)
        cairo_line_to(cairo, corners[k].x, corners[k].y);
    cairo_stroke(cairo);
}
