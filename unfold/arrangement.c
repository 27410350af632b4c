/* unfold/arrangement.c - a forest laid flat, and hanging a branch elsewhere. */
#include "unfold/arrangement.h"
#include "core/memory.h"
#include "unfold/lay.h"
#include "unfold/overlap.h"

#include <string.h>

void ktg_arrangement_free(ktg_arrangement **arrangement) {
    if (!arrangement || !*arrangement)
        return;
    ktg_arrangement *a = *arrangement;
    ktg_free(a->folded);
    ktg_free(a->parent_edge);
    ktg_free(a->order);
    ktg_free(a->place);
    ktg_free(a->size);
    ktg_free(a->piece);
    ktg_free(a->corners);
    ktg_free(a->turn);
    ktg_free(a->scratch);
    ktg_cells_free(&a->cells);
    ktg_free(a);
    *arrangement = NULL;
}

/* ---- laying flat ---------------------------------------------------------------------------- */

static uint32_t next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

static void lay_against(ktg_arrangement *a, uint32_t other, uint32_t own) {
    const ktg_vec2 *flat = a->dual->flat;
    uint32_t face = own / 3;
    a->turn[face] = ktg_lay_turn(a->dual, a->turn[other / 3], other, own);
    ktg_motion2 m = ktg_lay_motion(a->turn[face], flat[own], flat[next_corner(own)],
                                   a->corners[next_corner(other)], a->corners[other]);
    for (uint32_t c = 3 * face; c < 3 * face + 3; c++)
        a->corners[c] = ktg_move2(m, flat[c]);
}

static uint32_t half_in(const ktg_arrangement *a, uint32_t edge, uint32_t face) {
    const uint32_t *pair = a->dual->edges[edge].halfedge;
    return pair[0] / 3 == face ? pair[0] : pair[1];
}

static ktg_status put_in_cells(ktg_context *context, ktg_arrangement *a, uint32_t face) {
    ktg_flat_box box = ktg_flat_box_of(a->corners + 3 * (size_t)face);
    return ktg_cells_put(context, &a->cells, face, a->piece[face], &box);
}

static double double_area(const ktg_vec2 *p) {
    return ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
}

ktg_vec2 ktg_arrangement_middle(const ktg_arrangement *a, uint32_t piece) {
    ktg_vec2 sum = {0, 0};
    double all = 0;
    for (uint32_t f = 0; f < a->dual->face_count; f++) {
        if (a->piece[f] != piece)
            continue;
        const ktg_vec2 *p = a->corners + 3 * (size_t)f;
        double area = double_area(p);
        sum = ktg_madd2(sum, area / 3, ktg_add2(p[0], ktg_add2(p[1], p[2])));
        all += area;
    }
    return ktg_mul2(sum, 1 / all);
}

ktg_status ktg_arrangement_settle(ktg_context *context, ktg_arrangement *a) {
    for (uint32_t i = 0; i < a->dual->face_count; i++) {
        uint32_t face = a->order[i], e = a->parent_edge[face];
        if (e != KTG_NONE) {
            uint32_t own = half_in(a, e, face);
            lay_against(a, ktg_arrangement_across(a, e, own), own);
        }
        KTG_TRY(put_in_cells(context, a, face));
    }
    return KTG_OK;
}

ktg_status ktg_arrangement_move(ktg_context *context, ktg_arrangement *a, uint32_t piece,
                                ktg_motion2 motion) {
    for (uint32_t f = 0; f < a->dual->face_count; f++) {
        if (a->piece[f] != piece)
            continue;
        ktg_vec2 turn = a->turn[f];
        a->turn[f] = ktg_unit2((ktg_vec2){motion.c * turn.x - motion.s * turn.y,
                                          motion.s * turn.x + motion.c * turn.y});
        for (uint32_t c = 3 * f; c < 3 * f + 3; c++)
            a->corners[c] = ktg_move2(motion, a->corners[c]);
        KTG_TRY(put_in_cells(context, a, f));
    }
    return KTG_OK;
}

/* ---- making one ----------------------------------------------------------------------------- */

static ktg_status allocate(ktg_context *context, ktg_arrangement *a) {
    size_t n = a->dual->face_count;
    a->parent_edge = ktg_new(context, n, uint32_t);
    a->order = ktg_new(context, n, uint32_t);
    a->place = ktg_new(context, n, uint32_t);
    a->size = ktg_new(context, n, uint32_t);
    a->piece = ktg_new(context, n, uint32_t);
    a->corners = ktg_new(context, 3 * n, ktg_vec2);
    a->turn = ktg_new(context, n, ktg_vec2);
    a->scratch = ktg_new(context, 3 * n, uint32_t);
    return a->parent_edge && a->order && a->place && a->size && a->piece && a->corners && a->turn &&
                   a->scratch
               ? KTG_OK
               : KTG_MEMORY;
}

static double mean_diameter(const ktg_dual *dual) {
    double sum = 0;
    for (size_t f = 0; f < dual->face_count; f++) {
        const double *l = dual->lengths + 3 * f;
        sum += fmax(l[0], fmax(l[1], l[2]));
    }
    return sum / dual->face_count;
}

ktg_status ktg_arrangement_cells(ktg_context *context, const ktg_arrangement *a,
                                 uint32_t item_count, ktg_cells *cells) {
    return ktg_cells_new(context, item_count, a->piece_count, a->half, mean_diameter(a->dual),
                         cells);
}

static ktg_status lay_pieces(ktg_context *context, ktg_arrangement *a) {
    for (uint32_t f = 0; f < a->dual->face_count; f++) {
        if (a->parent_edge[f] != KTG_NONE)
            continue;
        a->turn[f] = (ktg_vec2){1, 0};
        memcpy(a->corners + 3 * (size_t)f, a->dual->flat + 3 * (size_t)f, 3 * sizeof(ktg_vec2));
    }
    KTG_TRY(ktg_arrangement_settle(context, a));
    for (uint32_t p = 0; p < a->piece_count; p++) {
        ktg_vec2 middle = ktg_arrangement_middle(a, p);
        KTG_TRY(ktg_arrangement_move(context, a, p, (ktg_motion2){1, 0, ktg_mul2(middle, -1)}));
    }
    return KTG_OK;
}

static ktg_status fill(ktg_context *context, ktg_arrangement *a, ktg_vec2 half) {
    KTG_TRY(allocate(context, a));
    ktg_arrangement_order(a);
    ktg_arrangement_number(a);
    a->half = half;
    KTG_TRY(ktg_arrangement_cells(context, a, a->dual->face_count, &a->cells));
    return lay_pieces(context, a);
}

ktg_status ktg_arrangement_new(ktg_context *context, const ktg_dual *dual, const bool *folded,
                               ktg_vec2 half, ktg_arrangement **arrangement) {
    ktg_arrangement *a = *arrangement = ktg_new(context, 1, ktg_arrangement);
    if (!a)
        return KTG_MEMORY;
    a->dual = dual;
    a->folded = ktg_copy_array(context, folded, dual->edge_count, sizeof *folded);
    ktg_status status = a->folded ? fill(context, a, half) : KTG_MEMORY;
    if (status != KTG_OK)
        ktg_arrangement_free(arrangement);
    return status;
}

/* ---- grafts --------------------------------------------------------------------------------- */

void ktg_graft_motion(const ktg_arrangement *a, ktg_graft *graft) {
    uint32_t own = graft->own, other = graft->other;
    ktg_vec2 now = a->turn[own / 3], then = ktg_lay_turn(a->dual, a->turn[other / 3], other, own);
    ktg_vec2 turn = ktg_unit2((ktg_vec2){ktg_dot2(now, then), ktg_cross2(now, then)});
    graft->motion = ktg_lay_motion(turn, a->corners[own], a->corners[next_corner(own)],
                                   a->corners[next_corner(other)], a->corners[other]);
}

/* True for the first cell of a walk that an item lies in: where it counts. */
static bool is_first(const ktg_arrangement *a, uint32_t item, const ktg_cell_walk *w) {
    ktg_cell_range own = a->cells.ranges[item];
    return w->x == (own.x0 > w->range.x0 ? own.x0 : w->range.x0) &&
           w->y == (own.y0 > w->range.y0 ? own.y0 : w->range.y0);
}

static bool share_vertex(const ktg_dual *dual, uint32_t f, uint32_t g) {
    const uint32_t *p = dual->faces + 3 * (size_t)f, *q = dual->faces + 3 * (size_t)g;
    for (int i = 0; i < 3; i++)
        if (p[i] == q[0] || p[i] == q[1] || p[i] == q[2])
            return true;
    return false;
}

/* Whether a face that lies at `moved` and another one are in conflict. */
static bool in_conflict(const ktg_arrangement *a, uint32_t face, const ktg_vec2 moved[3],
                        uint32_t other) {
    const double *lengths = a->dual->lengths;
    const ktg_vec2 *corners = a->corners + 3 * (size_t)other;
    double depth = KTG_ARRANGEMENT_DEPTH;
    if (a->gap > 0 && !share_vertex(a->dual, face, other))
        depth = -a->gap;
    return ktg_triangles_overlap(moved, lengths + 3 * (size_t)face, corners,
                                 lengths + 3 * (size_t)other, depth);
}

/* How many faces outside the branch its face would overlap, at most `most` + 1. */
static uint32_t face_conflicts(const ktg_arrangement *a, const ktg_branch *branch, uint32_t face,
                               uint32_t sheet, const ktg_motion2 *motion, uint32_t most) {
    uint32_t count = 0;
    ktg_vec2 moved[3];
    for (int k = 0; k < 3; k++)
        moved[k] = ktg_move2(*motion, a->corners[3 * (size_t)face + k]);
    ktg_flat_box box = ktg_flat_box_grown(ktg_flat_box_of(moved), a->gap);
    ktg_cell_walk walk = ktg_cells_walk(&a->cells, sheet, &box);
    for (uint32_t g; (g = ktg_cells_next(&walk)) != KTG_NONE;) {
        if (ktg_branch_holds(a, branch, g) || (most > 0 && !is_first(a, g, &walk)))
            continue;
        count += in_conflict(a, face, moved, g);
        if (count > most)
            break;
    }
    return count;
}

uint32_t ktg_graft_conflicts(const ktg_arrangement *a, const ktg_branch *branch,
                             const ktg_graft *graft, uint32_t most) {
    static const ktg_motion2 still = {1, 0, {0, 0}};
    uint32_t sheet = graft ? a->piece[graft->other / 3] : a->piece[branch->top],
             last = branch->first + branch->count;
    uint32_t start = graft ? a->place[graft->own / 3] : branch->first, count = 0;
    const ktg_motion2 *motion = graft ? &graft->motion : &still;
    for (uint32_t i = start; i < last && count <= most; i++)
        count += face_conflicts(a, branch, a->order[i], sheet, motion, most - count);
    for (uint32_t i = start; i-- > branch->first && count <= most;)
        count += face_conflicts(a, branch, a->order[i], sheet, motion, most - count);
    return count;
}

ktg_status ktg_arrangement_graft(ktg_context *context, ktg_arrangement *a, ktg_branch *branch,
                                 const ktg_graft *graft) {
    ktg_motion2 m = graft->motion;
    ktg_arrangement_rehang(a, branch, graft->edge, graft->own / 3, graft->other / 3);
    for (uint32_t i = 0; i < branch->count; i++) {
        uint32_t face = a->order[branch->first + i];
        ktg_vec2 turn = a->turn[face];
        a->turn[face] =
            ktg_unit2((ktg_vec2){m.c * turn.x - m.s * turn.y, m.s * turn.x + m.c * turn.y});
        for (uint32_t c = 3 * face; c < 3 * face + 3; c++)
            a->corners[c] = ktg_move2(m, a->corners[c]);
        KTG_TRY(put_in_cells(context, a, face));
    }
    return KTG_OK;
}

void ktg_branch_save(const ktg_arrangement *a, const ktg_branch *branch, ktg_saved *saved) {
    saved->fold = a->parent_edge[branch->top];
    saved->own = half_in(a, saved->fold, branch->top);
    saved->other = ktg_arrangement_across(a, saved->fold, saved->own);
    for (uint32_t i = 0; i < branch->count; i++) {
        uint32_t face = a->order[branch->first + i];
        saved->faces[i] = face;
        saved->turns[i] = a->turn[face];
        memcpy(saved->corners + 3 * (size_t)i, a->corners + 3 * (size_t)face, 3 * sizeof(ktg_vec2));
    }
}

ktg_status ktg_arrangement_ungraft(ktg_context *context, ktg_arrangement *a, ktg_branch *branch,
                                   const ktg_saved *saved) {
    ktg_arrangement_rehang(a, branch, saved->fold, saved->own / 3, saved->other / 3);
    for (uint32_t i = 0; i < branch->count; i++) {
        uint32_t face = saved->faces[i];
        a->turn[face] = saved->turns[i];
        memcpy(a->corners + 3 * (size_t)face, saved->corners + 3 * (size_t)i, 3 * sizeof(ktg_vec2));
        KTG_TRY(put_in_cells(context, a, face));
    }
    return KTG_OK;
}
