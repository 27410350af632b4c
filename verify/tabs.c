/* verify/tabs.c - faces and tabs of a piece apart from each other; tabs on their edges, and where
 * they go: under the mate's flat region, clear of each other. */
#include "core/memory.h"
#include "verify/check.h"

#include <stdlib.h>
#include <string.h>

/* ---- faces and tabs of one piece ---------------------------------------------------------- */

static void report_pair(ktg_check *check, const ktg_check_shape *a, const ktg_check_shape *b,
                        double depth, void *user) {
    uint32_t id = *(const uint32_t *)user + 1;
    if (a->tab && b->tab)
        ktg_check_problem(check, "The tabs on edges %u and %u of piece %u overlap by %.3g mm.",
                          a->number + 1, b->number + 1, id, depth);
    else if (b->tab)
        ktg_check_problem(check, "The tab on edge %u overlaps face %u in piece %u by %.3g mm.",
                          b->number + 1, a->number, id, depth);
    else
        ktg_check_problem(check, "Faces %u and %u overlap in piece %u by %.3g mm.", a->number,
                          b->number, id, depth);
}

static ktg_status add_piece(ktg_check *check, ktg_check_shapes *shapes, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    for (size_t i = 0; i < piece->face_count; i++) {
        ktg_vec2 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = piece->vertices[piece->corners[3 * i + (size_t)k]];
        KTG_TRY(
            ktg_check_add_shape(check->context, shapes, corners, 3, id, piece->faces[i], false));
    }
    for (size_t i = 0; i < piece->tab_count; i++)
        KTG_TRY(ktg_check_add_shape(check->context, shapes, piece->tabs[i].corners,
                                    piece->tabs[i].corner_count, id, piece->tabs[i].edge, true));
    return KTG_OK;
}

ktg_status ktg_check_pieces_apart(ktg_check *check) {
    ktg_check_shapes shapes = {0};
    ktg_status status = KTG_OK;
    for (uint32_t i = 0; status == KTG_OK && i < check->pattern->piece_count; i++) {
        ktg_check_clear_shapes(&shapes);
        status = add_piece(check, &shapes, i);
        if (status == KTG_OK)
            status = ktg_check_overlaps(check, &shapes, report_pair, &i);
    }
    ktg_check_free_shapes(&shapes);
    return status;
}

/* ---- one tab ------------------------------------------------------------------------------ */

/* A tab where it is glued: in the coordinates of its mate's piece. */
typedef struct glued {
    uint32_t piece, edge, count;
    ktg_vec2 corners[KTG_TAB_CORNERS];
} glued;

/* How far p is to the left of the line from a to b. */
static double left_of(ktg_vec2 a, ktg_vec2 b, ktg_vec2 p) {
    return ktg_cross2(ktg_unit2(ktg_sub2(b, a)), ktg_sub2(p, a));
}

/* Sides shorter than `near` have no direction worth asking. */
static bool is_convex(const ktg_pattern_tab *tab, double near) {
    for (uint32_t i = 0; i < tab->corner_count; i++) {
        ktg_vec2 a = tab->corners[i], b = tab->corners[(i + 1) % tab->corner_count];
        for (uint32_t k = 0; ktg_check_distance2(a, b) > near && k < tab->corner_count; k++)
            if (!(left_of(a, b, tab->corners[k]) >= -near))
                return false;
    }
    return ktg_check_area2(tab->corners, tab->corner_count) > 0;
}

static bool is_on(ktg_vec2 a, ktg_vec2 b, ktg_vec2 p, double near) {
    double along = ktg_dot2(ktg_unit2(ktg_sub2(b, a)), ktg_sub2(p, a));
    return fabs(left_of(a, b, p)) <= near && along >= -near &&
           along <= ktg_check_distance2(a, b) + near;
}

/* Its own form, and its place at half-edge h of its piece. */
static bool check_shape(ktg_check *check, const ktg_pattern_tab *tab, uint32_t h, uint32_t id) {
    ktg_vec2 a = ktg_check_start2(check, h), b = ktg_check_end2(check, h);
    ktg_vec2 first = tab->corners[0], last = tab->corners[tab->corner_count - 1];
    double near = KTG_VERIFY_TOUCH * check->mm;
    uint32_t before = check->report->problem_count;
    if (!is_convex(tab, near))
        ktg_check_problem(check,
                          "The tab on edge %u of piece %u is not convex and "
                          "counter-clockwise.",
                          tab->edge + 1, id + 1);
    if (!is_on(a, b, first, near) || !is_on(a, b, last, near))
        ktg_check_problem(check,
                          "The tab on edge %u of piece %u does not start and end on that "
                          "edge.",
                          tab->edge + 1, id + 1);
    for (uint32_t i = 0; i < tab->corner_count; i++)
        if (!(left_of(a, b, tab->corners[i]) <= near)) {
            ktg_check_problem(check, "The tab on edge %u of piece %u is not outside its own face.",
                              tab->edge + 1, id + 1);
            break;
        }
    return check->report->problem_count == before;
}

/* The half-edge that carries the tab, or KTG_NONE with the problem. */
static uint32_t carrier(ktg_check *check, const ktg_pattern_tab *tab, uint32_t id) {
    const ktg_pattern_edge *edge = &check->pattern->edges[tab->edge];
    if (edge->kind != KTG_EDGE_CUT || edge->side_count < 2) {
        ktg_check_problem(check, "Piece %u has a tab on edge %u, which is not a cut.", id + 1,
                          tab->edge + 1);
        return KTG_NONE;
    }
    if (edge->tab_on < 0 || edge->sides[edge->tab_on].piece != id) {
        ktg_check_problem(check,
                          "Piece %u has a tab on edge %u, but the edge says that the tab is "
                          "%s.",
                          id + 1, tab->edge + 1,
                          edge->tab_on < 0 ? "on no side" : "in another piece");
        return KTG_NONE;
    }
    return ktg_check_halfedge(&edge->sides[edge->tab_on]);
}

/* True when more than a point of the segment lies inside the polygon shrunk by `near`. */
static bool enters(const glued *tab, double near, ktg_vec2 from, ktg_vec2 to) {
    double low = 0, high = 1;
    for (uint32_t i = 0; i < tab->count; i++) {
        ktg_vec2 a = tab->corners[i], b = tab->corners[(i + 1) % tab->count];
        if (ktg_check_distance2(a, b) <= near)
            continue;
        double p = left_of(a, b, from) - near, q = left_of(a, b, to) - near;
        if (p <= 0 && q <= 0)
            return false;
        if (p < 0)
            low = fmax(low, p / (p - q));
        else if (q < 0)
            high = fmin(high, p / (p - q));
    }
    return low < high;
}

static bool is_flat(const ktg_check *check, uint32_t h) {
    uint32_t edge = check->edge_at[h];
    return check->fold[h] && edge != KTG_NONE && check->pattern->edges[edge].kind == KTG_EDGE_FLAT;
}

/* Floods from the mate's face over the faces that the tab covers; where it would leave the flat
 * region, the tab sticks out. `stack` and `stamp`: an item for each face; `mark` is new. */
static void check_room(ktg_check *check, const glued *tab, uint32_t mate, uint32_t *stack,
                       uint32_t *stamp, uint32_t mark) {
    double near = KTG_VERIFY_TOUCH * check->mm;
    size_t depth = 0;
    stack[depth++] = mate / 3;
    stamp[mate / 3] = mark;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            if (h == mate ||
                !enters(tab, near, ktg_check_start2(check, h), ktg_check_end2(check, h)))
                continue;
            if (!is_flat(check, h)) {
                ktg_check_problem(check,
                                  "The tab on edge %u does not fit under face %u of piece "
                                  "%u: it crosses the edge at corner %u of face %u.",
                                  tab->edge + 1, mate / 3, tab->piece + 1, h % 3, face);
                return;
            }
            uint32_t other = check->twin[h] / 3;
            if (stamp[other] == mark)
                continue;
            stamp[other] = mark;
            stack[depth++] = other;
        }
    }
}

/* ---- all tabs ----------------------------------------------------------------------------- */

typedef struct tabs {
    glued *under; /* those that could be put under their mates */
    size_t count;
    uint32_t *on_edge; /* edge_count: how many tabs */
    uint32_t *stack, *stamp;
} tabs;

static void check_tab(ktg_check *check, tabs *t, const ktg_pattern_tab *tab, uint32_t id) {
    if (t->on_edge[tab->edge]++ > 0) {
        ktg_check_problem(check, "Edge %u has more than one tab.", tab->edge + 1);
        return;
    }
    uint32_t h = carrier(check, tab, id), m = h == KTG_NONE ? KTG_NONE : check->twin[h];
    if (m == KTG_NONE || !check_shape(check, tab, h, id))
        return;
    ktg_motion2 motion = ktg_motion2_between(ktg_check_start2(check, h), ktg_check_end2(check, h),
                                             ktg_check_end2(check, m), ktg_check_start2(check, m));
    glued *under = &t->under[t->count++];
    *under = (glued){check->face_piece[m / 3], tab->edge, tab->corner_count, {{0}}};
    for (uint32_t i = 0; i < tab->corner_count; i++)
        under->corners[i] = ktg_move2(motion, tab->corners[i]);
    check_room(check, under, m, t->stack, t->stamp, (uint32_t)t->count);
}

static int by_piece(const void *a, const void *b) {
    const glued *p = a, *q = b;
    if (p->piece != q->piece)
        return p->piece < q->piece ? -1 : 1;
    return p->edge < q->edge ? -1 : p->edge > q->edge;
}

static void report_glued(ktg_check *check, const ktg_check_shape *a, const ktg_check_shape *b,
                         double depth, void *user) {
    ktg_check_problem(check,
                      "The tabs on edges %u and %u collide where they are glued, under piece "
                      "%u, by %.3g mm.",
                      a->number + 1, b->number + 1, *(const uint32_t *)user + 1, depth);
}

static ktg_status check_glued(ktg_check *check, tabs *t) {
    ktg_check_shapes shapes = {0};
    ktg_status status = KTG_OK;
    qsort(t->under, t->count, sizeof *t->under, by_piece);
    for (size_t i = 0; status == KTG_OK && i < t->count; i++) {
        const glued *g = &t->under[i];
        status =
            ktg_check_add_shape(check->context, &shapes, g->corners, g->count, 0, g->edge, true);
        if (status == KTG_OK && (i + 1 == t->count || t->under[i + 1].piece != g->piece)) {
            uint32_t piece = g->piece;
            status = ktg_check_overlaps(check, &shapes, report_glued, &piece);
            ktg_check_clear_shapes(&shapes);
        }
    }
    ktg_check_free_shapes(&shapes);
    return status;
}

static ktg_status check_each(ktg_check *check, tabs *t) {
    const ktg_pattern *p = check->pattern;
    for (uint32_t i = 0; i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].tab_count; k++) {
            check_tab(check, t, &p->pieces[i].tabs[k], i);
            if (t->count % 256 == 255)
                KTG_TRY(ktg_check_cancel(check->context));
        }
    for (size_t i = 0; i < p->edge_count; i++)
        if (p->edges[i].tab_on >= 0 && t->on_edge[i] == 0)
            ktg_check_problem(check,
                              "Edge %zu is said to carry a tab, but piece %u has none for "
                              "it.",
                              i + 1, p->edges[i].sides[p->edges[i].tab_on].piece + 1);
    return check_glued(check, t);
}

ktg_status ktg_check_tabs(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    size_t count = 0;
    for (size_t i = 0; i < p->piece_count; i++)
        count += p->pieces[i].tab_count;
    tabs t = {.under = ktg_new(check->context, count, glued),
              .on_edge = ktg_new(check->context, p->edge_count, uint32_t),
              .stack = ktg_new(check->context, p->face_count, uint32_t),
              .stamp = ktg_new(check->context, p->face_count, uint32_t)};
    ktg_status status =
        t.under && t.on_edge && t.stack && t.stamp ? check_each(check, &t) : KTG_MEMORY;
    ktg_free(t.under);
    ktg_free(t.on_edge);
    ktg_free(t.stack);
    ktg_free(t.stamp);
    return status;
}
