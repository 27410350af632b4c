/* unfold/seam_tabs.c - tabs on the cut edges of an arrangement. */
#include "unfold/seam_tabs.h"
#include "core/memory.h"

#include <string.h>

/* Copies of a vertex nearer than this are one. */
#define CLOSED 1e-9

/* Price of a tab that stands out of the sheet by its half, and the most it can be. */
#define STANDING_OUT      10.0
#define STANDING_OUT_MOST 0.5

void ktg_seam_tabs_free(ktg_seam_tabs **tabs) {
    if (!tabs || !*tabs)
        return;
    ktg_seam_tabs *t = *tabs;
    ktg_free(t->edge_of);
    ktg_free(t->slots);
    ktg_free(t->tabs);
    ktg_free(t->unhappy);
    ktg_free(t->unhappy_place);
    ktg_free(t->before);
    ktg_free(t->stamp);
    ktg_free(t->damaged);
    ktg_free(t);
    *tabs = NULL;
}

static uint32_t next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

/* ---- frames --------------------------------------------------------------------------------- */

/* p = origin + x along + y perp(along) */
typedef struct frame {
    ktg_vec2 origin, along;
} frame;

static ktg_vec2 from_frame(const frame *f, ktg_vec2 p) {
    return ktg_madd2(ktg_madd2(f->origin, p.x, f->along), p.y, ktg_perp2(f->along));
}

static ktg_vec2 to_frame(const frame *f, ktg_vec2 p) {
    ktg_vec2 v = ktg_sub2(p, f->origin);
    return (ktg_vec2){ktg_dot2(v, f->along), ktg_cross2(f->along, v)};
}

/* Beside the face that carries the tab: against its half-edge. */
static frame outer_frame(const ktg_arrangement *a, uint32_t h) {
    ktg_vec2 from = a->corners[next_corner(h)], to = a->corners[h];
    return (frame){from, ktg_mul2(ktg_sub2(to, from), 1 / a->dual->lengths[h])};
}

/* Under the mate, laid flat as in the dual graph: along its half-edge. */
static frame under_frame(const ktg_dual *dual, uint32_t mate) {
    return (frame){dual->flat[mate], ktg_mul2(dual->flat_vectors[mate], 1 / dual->lengths[mate])};
}

/* ---- slots ---------------------------------------------------------------------------------- */

/* The wished tab, cut back to what fits under the mate's face. */
static void shape_slot(ktg_seam_tabs *t, uint32_t own, uint32_t mate) {
    const ktg_dual *dual = t->a->dual;
    const ktg_seam_tab_wish *w = &t->wish;
    ktg_tab_slot_shape *slot = &t->slots[own];
    frame under = under_frame(dual, mate);
    *slot = (ktg_tab_slot_shape){.wish = {dual->lengths[own], w->height, w->least}};
    slot->under = ktg_trapezoid_wished(dual->lengths[own], w->height, w->cot, w->inset);
    for (uint32_t side = next_corner(mate); side != mate; side = next_corner(side)) {
        ktg_vec2 ends[2] = {to_frame(&under, dual->flat[side]),
                            to_frame(&under, dual->flat[next_corner(side)])};
        ktg_trapezoid_cut(&slot->under, &slot->wish, ends, 2, w->inset);
    }
    if (dual->lengths[own] < w->edge || !ktg_trapezoid_is_tab(&slot->under, &slot->wish))
        return;
    slot->wish.height = slot->under.height;
    slot->usable = true;
}

static void shape_slots(ktg_seam_tabs *t) {
    const ktg_dual *dual = t->a->dual;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const uint32_t *pair = dual->edges[e].halfedge;
        shape_slot(t, pair[0], pair[1]);
        shape_slot(t, pair[1], pair[0]);
    }
}

/* ---- the book of tabs ----------------------------------------------------------------------- */

static void note_price(ktg_seam_tabs *t, uint32_t e, double price) {
    t->price += price - t->tabs[e].price;
    t->tabs[e].price = price;
    uint32_t *place = &t->unhappy_place[e];
    if (price > 0 && *place == KTG_NONE) {
        *place = t->unhappy_count;
        t->unhappy[t->unhappy_count++] = e;
    } else if (price <= 0 && *place != KTG_NONE) {
        uint32_t last = t->unhappy[--t->unhappy_count];
        t->unhappy[*place] = last;
        t->unhappy_place[last] = *place;
        *place = KTG_NONE;
    }
}

static uint32_t item_of(const ktg_seam_tabs *t, uint32_t e) {
    return t->a->dual->face_count + e;
}

static uint32_t carrier_of(const ktg_seam_tabs *t, uint32_t e) {
    return t->a->dual->edges[e].halfedge[t->tabs[e].side] / 3;
}

static ktg_status remember(ktg_context *context, ktg_seam_tabs *t, uint32_t e) {
    if (t->stamp[e] == t->attempt)
        return KTG_OK;
    KTG_TRY(ktg_reserve(context, &t->before, &t->before_capacity, t->before_count + 1));
    t->before[t->before_count].edge = e;
    t->before[t->before_count++].tab = t->tabs[e];
    t->stamp[e] = t->attempt;
    return KTG_OK;
}

/* Corners on the sheet, box, cells: of a tab that stands where its face lies now. */
static ktg_status lay_tab(ktg_context *context, ktg_seam_tabs *t, uint32_t e) {
    ktg_seam_tab *tab = &t->tabs[e];
    if (tab->side < 0)
        return KTG_OK;
    frame outer = outer_frame(t->a, t->a->dual->edges[e].halfedge[tab->side]);
    ktg_flat_box box = ktg_flat_box_empty();
    tab->corner_count = ktg_trapezoid_corners(&tab->shape, tab->corners);
    for (uint32_t i = 0; i < tab->corner_count; i++)
        tab->corners[i] = from_frame(&outer, tab->corners[i]);
    ktg_flat_box first = ktg_flat_box_of(tab->corners),
                 second = ktg_flat_box_of(tab->corners + tab->corner_count - 3);
    ktg_flat_box_add(&box, &first);
    ktg_flat_box_add(&box, &second);
    return ktg_cells_put(context, &t->a->cells, item_of(t, e), t->a->piece[carrier_of(t, e)], &box);
}

static ktg_status set_tab(ktg_context *context, ktg_seam_tabs *t, uint32_t e, int side,
                          const ktg_trapezoid *shape, double price) {
    KTG_TRY(remember(context, t, e));
    note_price(t, e, price);
    ktg_cells_take_out(&t->a->cells, item_of(t, e));
    t->tabs[e].side = side;
    if (side < 0)
        return KTG_OK;
    t->tabs[e].shape = *shape;
    return lay_tab(context, t, e);
}

static double price_of(const ktg_trapezoid *shape, const ktg_tab_wish *wish) {
    if (!ktg_trapezoid_is_tab(shape, wish))
        return 1;
    if (ktg_trapezoid_is_full(shape, wish))
        return 0;
    double part = 2 * (ktg_trapezoid_value(shape, wish) - 1); /* 0 .. 1 */
    return KTG_PRICE_REDUCED_MOST - (KTG_PRICE_REDUCED_MOST - KTG_PRICE_REDUCED_LEAST) * part;
}

/* True when both sides of a cut lie on each other: it becomes a fold in the end. */
static bool closes(const ktg_arrangement *a, uint32_t e) {
    const uint32_t *pair = a->dual->edges[e].halfedge;
    ktg_vec2 first = ktg_sub2(a->corners[pair[0]], a->corners[next_corner(pair[1])]);
    ktg_vec2 second = ktg_sub2(a->corners[next_corner(pair[0])], a->corners[pair[1]]);
    return fmax(ktg_dot2(first, first), ktg_dot2(second, second)) < CLOSED * CLOSED &&
           a->piece[pair[0] / 3] == a->piece[pair[1] / 3];
}

/* An edge without a tab: what that costs. */
static double price_of_none(const ktg_seam_tabs *t, uint32_t e) {
    const ktg_dual *dual = t->a->dual;
    if (dual->edges[e].length < t->wish.edge)
        return 0;
    return e >= dual->edge_count || !(t->a->folded[e] || closes(t->a, e));
}

static ktg_status damage(ktg_context *context, ktg_seam_tabs *t, uint32_t e) {
    KTG_TRY(ktg_reserve(context, &t->damaged, &t->damaged_capacity, t->damaged_count + 1));
    t->damaged[t->damaged_count++] = e;
    return set_tab(context, t, e, -1, NULL, price_of_none(t, e));
}

/* ---- room ----------------------------------------------------------------------------------- */

/* A shape in the way of a tab, in its frame. */
typedef struct obstacle {
    ktg_vec2 corners[4];
    uint32_t count;
} obstacle;

static obstacle obstacle_of(const ktg_seam_tabs *t, const frame *f, uint32_t item) {
    uint32_t faces = t->a->dual->face_count;
    obstacle o = {.count = item < faces ? 3 : t->tabs[item - faces].corner_count};
    const ktg_vec2 *corners =
        item < faces ? t->a->corners + 3 * (size_t)item : t->tabs[item - faces].corners;
    for (uint32_t i = 0; i < o.count; i++)
        o.corners[i] = to_frame(f, corners[i]);
    return o;
}

static ktg_flat_box box_around(const ktg_trapezoid *shape, const frame *outer, double air) {
    ktg_vec2 c[4];
    uint32_t count = ktg_trapezoid_corners(shape, c);
    for (uint32_t i = 0; i < count; i++)
        c[i] = from_frame(outer, c[i]);
    ktg_flat_box box = ktg_flat_box_of(c), last = ktg_flat_box_of(c + count - 3);
    ktg_flat_box_add(&box, &last);
    return ktg_flat_box_grown(box, air);
}

/* The tab glued under the mate's face at its half-edge `side`, in the frame of `under`; false when
 * there is none. */
static bool neighbour_under(const ktg_seam_tabs *t, const frame *under, uint32_t side,
                            obstacle *o) {
    const ktg_dual *dual = t->a->dual;
    uint32_t e = t->edge_of[side];
    if (e == KTG_NONE || t->tabs[e].side < 0 ||
        dual->edges[e].halfedge[t->tabs[e].side] == side) /* that one is beside the mate */
        return false;
    frame there = under_frame(dual, side);
    o->count = ktg_trapezoid_corners(&t->tabs[e].shape, o->corners);
    for (uint32_t i = 0; i < o->count; i++)
        o->corners[i] = to_frame(under, from_frame(&there, o->corners[i]));
    return true;
}

/* Cuts the shape back by the tabs that are glued under the same face. */
static void cut_under(const ktg_seam_tabs *t, uint32_t mate, const ktg_tab_wish *wish,
                      ktg_trapezoid *shape) {
    frame under = under_frame(t->a->dual, mate);
    obstacle o;
    for (uint32_t side = next_corner(mate); side != mate; side = next_corner(side))
        if (neighbour_under(t, &under, side, &o))
            ktg_trapezoid_cut(shape, wish, o.corners, o.count, t->wish.air);
}

/* Cuts the shape back by what lies beside the face that carries it: faces, and tabs on request. */
static bool cut_beside(const ktg_seam_tabs *t, uint32_t own, bool by_tabs, const ktg_tab_wish *wish,
                       ktg_trapezoid *shape) {
    const ktg_arrangement *a = t->a;
    frame outer = outer_frame(a, own);
    uint32_t sheet = a->piece[own / 3], faces = a->dual->face_count;
    uint32_t skip = item_of(t, t->edge_of[own]);
    ktg_flat_box box = box_around(shape, &outer, t->wish.air);
    ktg_cell_range r = ktg_cells_range(&a->cells, &box);
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            const ktg_cell *cell = ktg_cells_at(&a->cells, sheet, x, y);
            for (size_t i = 0; i < cell->count; i++) {
                uint32_t item = cell->items[i];
                if (item == own / 3 || item == skip || (item >= faces && !by_tabs) ||
                    !ktg_flat_boxes_meet(&box, &a->cells.boxes[item]))
                    continue;
                obstacle o = obstacle_of(t, &outer, item);
                ktg_trapezoid_cut(shape, wish, o.corners, o.count, t->wish.air);
                if (!ktg_trapezoid_is_tab(shape, wish))
                    return false;
            }
        }
    return true;
}

/* A tab beyond the edge of its sheet makes the model smaller. */
static double price_of_standing_out(const ktg_seam_tabs *t, uint32_t own,
                                    const ktg_trapezoid *shape) {
    frame outer = outer_frame(t->a, own);
    ktg_flat_box box = box_around(shape, &outer, 0);
    double x = fmax(-(double)box.x0, box.x1) / t->wish.half.x;
    double y = fmax(-(double)box.y0, box.y1) / t->wish.half.y, out = fmax(x, y) - 1;
    return out > 0 ? fmin(STANDING_OUT_MOST, STANDING_OUT * out) : 0;
}

/* The best shape on one side of the edge, and its price. */
static double find_shape(const ktg_seam_tabs *t, uint32_t e, int side, bool by_tabs, double part,
                         ktg_trapezoid *shape) {
    const uint32_t *pair = t->a->dual->edges[e].halfedge;
    uint32_t own = pair[side], mate = pair[1 - side];
    const ktg_tab_slot_shape *slot = &t->slots[own];
    if (!slot->usable)
        return 1;
    *shape = slot->under;
    shape->height = fmin(shape->height, fmax(slot->wish.least, part * slot->wish.height));
    if (by_tabs)
        cut_under(t, mate, &slot->wish, shape);
    if (!ktg_trapezoid_is_tab(shape, &slot->wish) ||
        !cut_beside(t, own, by_tabs, &slot->wish, shape))
        return 1;
    return price_of(shape, &slot->wish) + price_of_standing_out(t, own, shape);
}

ktg_status ktg_seam_tabs_choose(ktg_context *context, ktg_seam_tabs *t, uint32_t e) {
    ktg_trapezoid shapes[2];
    double prices[2];
    if (price_of_none(t, e) <= 0)
        return set_tab(context, t, e, -1, NULL, 0);
    prices[0] = find_shape(t, e, 0, true, 1, &shapes[0]);
    prices[1] = prices[0] > 0 ? find_shape(t, e, 1, true, 1, &shapes[1]) : 1;
    int side = prices[1] < prices[0];
    if (prices[side] >= 1)
        return set_tab(context, t, e, -1, NULL, 1);
    return set_tab(context, t, e, side, &shapes[side], prices[side]);
}

static ktg_status choose_damaged(ktg_context *context, ktg_seam_tabs *t) {
    for (size_t i = 0; i < t->damaged_count; i++)
        KTG_TRY(ktg_seam_tabs_choose(context, t, t->damaged[i]));
    t->damaged_count = 0;
    return KTG_OK;
}

/* ---- making ones ---------------------------------------------------------------------------- */

/* Gives the edge a tab on the side where it had one, if it can be as good there as any. */
static ktg_status choose_again(ktg_context *context, ktg_seam_tabs *t, uint32_t e, int side) {
    ktg_trapezoid shape;
    double price = side < 0 ? 1 : find_shape(t, e, side, true, 1, &shape);
    return price < 1 ? set_tab(context, t, e, side, &shape, price) : KTG_OK;
}

ktg_status ktg_seam_tabs_renew(ktg_context *context, ktg_seam_tabs *t,
                               const ktg_seam_tab_wish *wish) {
    uint32_t count = t->edge_count;
    t->wish = *wish;
    shape_slots(t);
    int8_t *sides = ktg_new(context, count, int8_t);
    ktg_status status = sides ? KTG_OK : KTG_MEMORY;
    ktg_seam_tabs_begin(t);
    for (uint32_t e = 0; status == KTG_OK && e < count; e++) {
        sides[e] = (int8_t)t->tabs[e].side;
        status = set_tab(context, t, e, -1, NULL, price_of_none(t, e));
    }
    for (uint32_t e = 0; status == KTG_OK && e < count; e++)
        status = choose_again(context, t, e, sides[e]);
    for (uint32_t e = 0; status == KTG_OK && e < count; e++)
        if (t->tabs[e].price > 0)
            status = ktg_seam_tabs_choose(context, t, e);
    ktg_seam_tabs_begin(t);
    ktg_free(sides);
    return status;
}

/* The edges of half-edges, forced cuts among them. */
static void list_edges(ktg_seam_tabs *t) {
    const ktg_dual *dual = t->a->dual;
    memset(t->edge_of, 0xff, 3 * (size_t)dual->face_count * sizeof *t->edge_of);
    for (uint32_t e = 0; e < t->edge_count; e++) {
        t->edge_of[dual->edges[e].halfedge[0]] = t->edge_of[dual->edges[e].halfedge[1]] = e;
        t->unhappy_place[e] = KTG_NONE;
        t->tabs[e].side = -1;
    }
}

ktg_status ktg_seam_tabs_new(ktg_context *context, ktg_arrangement *a,
                             const ktg_seam_tab_wish *wish, ktg_seam_tabs **tabs) {
    ktg_seam_tabs *t = *tabs = ktg_new(context, 1, ktg_seam_tabs);
    if (!t)
        return KTG_MEMORY;
    size_t halfedges = 3 * (size_t)a->dual->face_count;
    size_t edges = t->edge_count = a->dual->edge_count + a->dual->forced_count;
    t->a = a;
    t->wish = *wish;
    t->edge_of = ktg_new(context, halfedges, uint32_t);
    t->slots = ktg_new(context, halfedges, ktg_tab_slot_shape);
    t->tabs = ktg_new(context, edges, ktg_seam_tab);
    t->unhappy = ktg_new(context, edges, uint32_t);
    t->unhappy_place = ktg_new(context, edges, uint32_t);
    t->stamp = ktg_new(context, edges, uint32_t);
    if (!t->edge_of || !t->slots || !t->tabs || !t->unhappy || !t->unhappy_place || !t->stamp) {
        ktg_seam_tabs_free(tabs);
        return KTG_MEMORY;
    }
    list_edges(t);
    shape_slots(t);
    return KTG_OK;
}

/* ---- attempts ------------------------------------------------------------------------------- */

void ktg_seam_tabs_begin(ktg_seam_tabs *t) {
    t->before_count = t->damaged_count = 0;
    if (++t->attempt == 0) {
        memset(t->stamp, 0, t->edge_count * sizeof *t->stamp);
        t->attempt = 1;
    }
}

/* True when the tab, in its own frame, comes near the obstacle. */
static bool is_hit(const ktg_seam_tabs *t, const ktg_trapezoid *shape, const obstacle *o) {
    return !ktg_trapezoid_is_clear(shape, o->corners, o->count, t->wish.air);
}

/* One moved face of the branch against the tabs near its new place. */
static ktg_status damage_by_face(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch,
                                 uint32_t face, const ktg_graft *graft) {
    const ktg_arrangement *a = t->a;
    uint32_t sheet = a->piece[graft->other / 3], faces = a->dual->face_count;
    ktg_vec2 moved[3];
    for (int k = 0; k < 3; k++)
        moved[k] = ktg_move2(graft->motion, a->corners[3 * (size_t)face + k]);
    ktg_flat_box box = ktg_flat_box_grown(ktg_flat_box_of(moved), t->wish.air);
    ktg_cell_range r = ktg_cells_range(&a->cells, &box);
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            const ktg_cell *cell = ktg_cells_at(&a->cells, sheet, x, y);
            for (size_t i = 0; i < cell->count; i++) {
                uint32_t item = cell->items[i], e = item - faces;
                if (item < faces || !ktg_flat_boxes_meet(&box, &a->cells.boxes[item]) ||
                    e == graft->edge || ktg_branch_holds(a, branch, carrier_of(t, e)))
                    continue;
                frame outer = outer_frame(a, a->dual->edges[e].halfedge[t->tabs[e].side]);
                obstacle o = {.count = 3};
                for (int k = 0; k < 3; k++)
                    o.corners[k] = to_frame(&outer, moved[k]);
                if (!is_hit(t, &t->tabs[e].shape, &o))
                    continue;
                KTG_TRY(damage(context, t, e));
                i = (size_t)-1; /* the cell has changed */
            }
        }
    return KTG_OK;
}

ktg_status ktg_seam_tabs_damage(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch,
                                const ktg_graft *graft) {
    for (uint32_t i = 0; i < branch->count; i++)
        KTG_TRY(damage_by_face(context, t, branch, t->a->order[branch->first + i], graft));
    return KTG_OK;
}

/* A tab of the branch that lies on something outside of it where it is now. */
static bool lies_badly(const ktg_seam_tabs *t, const ktg_branch *branch, uint32_t e) {
    const ktg_arrangement *a = t->a;
    uint32_t own = a->dual->edges[e].halfedge[t->tabs[e].side], sheet = a->piece[own / 3];
    uint32_t faces = a->dual->face_count;
    frame outer = outer_frame(a, own);
    ktg_flat_box box = box_around(&t->tabs[e].shape, &outer, t->wish.air);
    ktg_cell_range r = ktg_cells_range(&a->cells, &box);
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            const ktg_cell *cell = ktg_cells_at(&a->cells, sheet, x, y);
            for (size_t i = 0; i < cell->count; i++) {
                uint32_t item = cell->items[i];
                if (!ktg_flat_boxes_meet(&box, &a->cells.boxes[item]) ||
                    ktg_branch_holds(a, branch, item < faces ? item : carrier_of(t, item - faces)))
                    continue;
                obstacle o = obstacle_of(t, &outer, item);
                if (is_hit(t, &t->tabs[e].shape, &o))
                    return true;
            }
        }
    return false;
}

ktg_status ktg_seam_tabs_lay(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch) {
    const ktg_arrangement *a = t->a;
    for (uint32_t i = 0; i < branch->count; i++)
        for (uint32_t h = 3 * a->order[branch->first + i], last = h + 3; h < last; h++) {
            uint32_t e = t->edge_of[h];
            if (e != KTG_NONE && t->tabs[e].side >= 0 &&
                a->dual->edges[e].halfedge[t->tabs[e].side] == h)
                KTG_TRY(lay_tab(context, t, e));
        }
    return KTG_OK;
}

ktg_status ktg_seam_tabs_follow(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch,
                                uint32_t joined, uint32_t cut) {
    const ktg_arrangement *a = t->a;
    KTG_TRY(set_tab(context, t, joined, -1, NULL, 0));
    KTG_TRY(ktg_seam_tabs_lay(context, t, branch));
    for (uint32_t i = 0; i < branch->count; i++)
        for (uint32_t h = 3 * a->order[branch->first + i], last = h + 3; h < last; h++) {
            uint32_t e = t->edge_of[h];
            if (e != KTG_NONE && t->tabs[e].side >= 0 &&
                a->dual->edges[e].halfedge[t->tabs[e].side] == h && lies_badly(t, branch, e))
                KTG_TRY(damage(context, t, e));
        }
    KTG_TRY(damage(context, t, cut));
    return choose_damaged(context, t);
}

ktg_status ktg_seam_tabs_undo(ktg_context *context, ktg_seam_tabs *t) {
    for (size_t i = 0; i < t->before_count; i++) {
        uint32_t e = t->before[i].edge;
        note_price(t, e, t->before[i].tab.price);
        ktg_cells_take_out(&t->a->cells, item_of(t, e));
        t->tabs[e] = t->before[i].tab;
        KTG_TRY(lay_tab(context, t, e));
    }
    return KTG_OK;
}

/* ---- pushing -------------------------------------------------------------------------------- */

/* Damages the tabs beside the same piece that the shape lies on. */
static ktg_status damage_beside(ktg_context *context, ktg_seam_tabs *t, uint32_t own,
                                const ktg_trapezoid *shape) {
    const ktg_arrangement *a = t->a;
    uint32_t faces = a->dual->face_count, e = t->edge_of[own];
    frame outer = outer_frame(a, own);
    ktg_flat_box box = box_around(shape, &outer, t->wish.air);
    ktg_cell_range r = ktg_cells_range(&a->cells, &box);
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            const ktg_cell *cell = ktg_cells_at(&a->cells, a->piece[own / 3], x, y);
            for (size_t i = 0; i < cell->count; i++) {
                uint32_t item = cell->items[i];
                if (item < faces || item - faces == e ||
                    !ktg_flat_boxes_meet(&box, &a->cells.boxes[item]))
                    continue;
                obstacle o = obstacle_of(t, &outer, item);
                if (!is_hit(t, shape, &o))
                    continue;
                KTG_TRY(damage(context, t, item - faces));
                i = (size_t)-1;
            }
        }
    return KTG_OK;
}

static ktg_status damage_under(ktg_context *context, ktg_seam_tabs *t, uint32_t mate,
                               const ktg_trapezoid *shape) {
    frame under = under_frame(t->a->dual, mate);
    obstacle o;
    for (uint32_t side = next_corner(mate); side != mate; side = next_corner(side))
        if (neighbour_under(t, &under, side, &o) && is_hit(t, shape, &o))
            KTG_TRY(damage(context, t, t->edge_of[side]));
    return KTG_OK;
}

ktg_status ktg_seam_tabs_push(ktg_context *context, ktg_seam_tabs *t, uint32_t e, int side,
                              double part) {
    const uint32_t *pair = t->a->dual->edges[e].halfedge;
    ktg_trapezoid shape;
    double price = find_shape(t, e, side, false, part, &shape);
    if (price >= 1)
        return KTG_OK;
    KTG_TRY(set_tab(context, t, e, -1, NULL, 1));
    KTG_TRY(damage_beside(context, t, pair[side], &shape));
    KTG_TRY(damage_under(context, t, pair[1 - side], &shape));
    KTG_TRY(set_tab(context, t, e, side, &shape, price));
    return choose_damaged(context, t);
}
