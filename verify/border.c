/* verify/border.c - the border of a piece, walked half-edge by half-edge, and its outline against
 * that walk with the tabs put in; labels. */
#include "core/memory.h"
#include "verify/check.h"

#include <string.h>

#define MOST_STARTS 1000 /* places of the outline that may be the walk's first point */

/* Around the end of h, from face to face across folds. */
uint32_t ktg_check_next_border(const ktg_check *check, uint32_t h) {
    uint32_t next = ktg_check_next(h);
    while (check->fold[next])
        next = ktg_check_next(check->twin[next]);
    return next;
}

double ktg_check_area2(const ktg_vec2 *points, size_t count) {
    double area = 0;
    for (size_t i = 1; i + 1 < count; i++)
        area += ktg_cross2(ktg_sub2(points[i], points[0]), ktg_sub2(points[i + 1], points[0]));
    return area;
}

/* ---- the walk ----------------------------------------------------------------------------- */

typedef struct walk {
    ktg_vec2 *points;
    size_t count, capacity;
    const ktg_pattern_tab **tab_of; /* edge_count: its tab, or NULL */
} walk;

static ktg_status add(ktg_check *check, walk *w, ktg_vec2 point) {
    KTG_TRY(ktg_reserve(check->context, &w->points, &w->capacity, w->count + 1));
    w->points[w->count++] = point;
    return KTG_OK;
}

static const ktg_pattern_tab *tab_on(const ktg_check *check, const walk *w, uint32_t h) {
    uint32_t edge = check->edge_at[h];
    if (edge == KTG_NONE || check->pattern->edges[edge].tab_on < 0)
        return NULL;
    const ktg_pattern_side *side =
        &check->pattern->edges[edge].sides[check->pattern->edges[edge].tab_on];
    return ktg_check_halfedge(side) == h ? w->tab_of[edge] : NULL;
}

/* Walks the border from h on; *length: the half-edges passed. */
static ktg_status walk_border(ktg_check *check, walk *w, uint32_t start, size_t *length) {
    uint32_t h = start;
    w->count = 0;
    *length = 0;
    do {
        const ktg_pattern_tab *tab = tab_on(check, w, h);
        KTG_TRY(add(check, w, ktg_check_start2(check, h)));
        for (uint32_t i = 0; tab && i < tab->corner_count; i++)
            KTG_TRY(add(check, w, tab->corners[i]));
        h = ktg_check_next_border(check, h);
        ++*length;
    } while (h != start);
    return KTG_OK;
}

static bool same(const ktg_check *check, ktg_vec2 a, ktg_vec2 b) {
    return ktg_check_distance2(a, b) <= KTG_VERIFY_TOUCH * check->mm;
}

/* Both walks point by point from outline point `start`; a point may stand in one of them twice in a
 * row (a tab as wide as its edge). *missed: the first point of the walk that has no partner. */
static bool walks_agree(const ktg_check *check, const walk *w, const ktg_vec2 *outline,
                        size_t count, size_t start, ktg_vec2 *missed) {
    size_t i = 0, j = 0;
    while (i < w->count || j < count) {
        ktg_vec2 here = w->points[i % w->count], there = outline[(start + j) % count];
        ktg_vec2 next = w->points[(i + 1) % w->count], then = outline[(start + j + 1) % count];
        if (i < w->count && j < count && same(check, next, then)) {
            i++;
            j++;
        } else if (i < w->count && same(check, next, there)) {
            i++;
        } else if (j < count && same(check, here, then)) {
            j++;
        } else {
            *missed = next;
            return false;
        }
    }
    return true;
}

static void compare_outline(ktg_check *check, const walk *w, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    ktg_vec2 missed = w->points[0];
    size_t tried = 0;
    for (size_t j = 0; j < piece->outline_count && tried < MOST_STARTS; j++) {
        if (!same(check, w->points[0], piece->outline[j]))
            continue;
        tried++;
        if (walks_agree(check, w, piece->outline, piece->outline_count, j, &missed))
            return;
    }
    ktg_check_problem(check,
                      "The outline of piece %u leaves the border of its faces and tabs near "
                      "(%.6g, %.6g).",
                      id + 1, missed.x, missed.y);
}

/* The outline's area is that of the faces and tabs; at least that, where there is an allowance. */
static void check_area(ktg_check *check, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    double expected = 0, length = 0;
    for (size_t i = 0; i < piece->face_count; i++) {
        ktg_vec2 corners[4];
        expected += ktg_check_area2(corners, ktg_check_drawn_face(piece, i, corners));
    }
    for (size_t i = 0; i < piece->tab_count; i++)
        expected += ktg_check_area2(piece->tabs[i].corners, piece->tabs[i].corner_count);
    for (size_t i = 0; i < piece->outline_count; i++)
        length +=
            ktg_check_distance2(piece->outline[i], piece->outline[(i + 1) % piece->outline_count]);
    double area = ktg_check_area2(piece->outline, piece->outline_count);
    double slack = KTG_VERIFY_LENGTH * fabs(expected) + KTG_VERIFY_TOUCH * check->mm * length;
    bool good = check->pattern->mode == KTG_PAPER ? fabs(area - expected) <= slack
                                                  : area >= expected - slack;
    if (!good)
        ktg_check_problem(check,
                          "The outline of piece %u encloses %.9g square mm, but its faces "
                          "and tabs have %.9g.",
                          id + 1, area / 2, expected / 2);
}

static ktg_status check_outline(ktg_check *check, walk *w, uint32_t id) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[id];
    size_t border = 0, walked = 0;
    uint32_t start = KTG_NONE;
    for (size_t i = 0; i < piece->face_count; i++)
        for (uint32_t h = 3 * piece->faces[i]; h < 3 * piece->faces[i] + 3; h++)
            if (!check->fold[h]) {
                border++;
                start = start == KTG_NONE ? h : start;
            }
    if (start == KTG_NONE || piece->outline_count < 3) {
        ktg_check_problem(
            check, start == KTG_NONE ? "Piece %u has no border." : "Piece %u has no outline.",
            id + 1);
        return KTG_OK;
    }
    KTG_TRY(walk_border(check, w, start, &walked));
    if (walked < border)
        ktg_check_problem(check, "Piece %u has a hole: its border is not one closed walk.", id + 1);
    else if (check->pattern->mode == KTG_PAPER)
        compare_outline(check, w, id);
    check_area(check, id);
    return KTG_OK;
}

ktg_status ktg_check_outlines(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    walk w = {0};
    w.tab_of = ktg_new(check->context, p->edge_count, const ktg_pattern_tab *);
    ktg_status status = w.tab_of ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].tab_count; k++)
            w.tab_of[p->pieces[i].tabs[k].edge] = &p->pieces[i].tabs[k];
    for (uint32_t i = 0; status == KTG_OK && i < p->piece_count; i++)
        status = check_outline(check, &w, i);
    ktg_free(w.points);
    ktg_free(w.tab_of);
    return status;
}

/* ---- labels ------------------------------------------------------------------------------- */

/* Loosely: a label may stand beside a piece, at the end of a leader line. */
static void check_label(ktg_check *check, const ktg_pattern_label *label, ktg_vec2 low,
                        ktg_vec2 high, uint32_t id) {
    double room = 10 * check->mm + 4 * label->height_mm;
    if (!label->text[0])
        ktg_check_problem(check, "A label of piece %u is empty.", id + 1);
    if (!(label->height_mm > 0))
        ktg_check_problem(check, "Label \"%s\" of piece %u has no height.", label->text, id + 1);
    else if (label->at.x < low.x - room || label->at.y < low.y - room ||
             label->at.x > high.x + room || label->at.y > high.y + room)
        ktg_check_problem(check, "Label \"%s\" of piece %u is far from the piece.", label->text,
                          id + 1);
}

static void extend(const ktg_vec2 *points, size_t count, ktg_vec2 *low, ktg_vec2 *high) {
    for (size_t k = 0; k < count; k++) {
        *low = (ktg_vec2){fmin(low->x, points[k].x), fmin(low->y, points[k].y)};
        *high = (ktg_vec2){fmax(high->x, points[k].x), fmax(high->y, points[k].y)};
    }
}

/* The name of a tiny piece of cloth may stand in its allowance, which is much larger. */
void ktg_check_labels(ktg_check *check) {
    for (uint32_t i = 0; i < check->pattern->piece_count; i++) {
        const ktg_pattern_piece *piece = &check->pattern->pieces[i];
        ktg_vec2 low = piece->vertices[0], high = low;
        extend(piece->vertices, piece->vertex_count, &low, &high);
        extend(piece->outline, piece->outline_count, &low, &high);
        for (size_t k = 0; k < piece->label_count; k++)
            check_label(check, &piece->labels[k], low, high, i);
    }
}
