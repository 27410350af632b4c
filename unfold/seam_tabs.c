/* unfold/seam_tabs.c - tabs on the cut edges of an arrangement. */
#include "unfold/seam_tabs.h"
#include "core/memory.h"
#include "unfold/seam_tab_room.h"

#include <string.h>

/* Copies of a vertex nearer than this are one. */
#define CLOSED 1e-9

void ktg_seam_tabs_free(ktg_seam_tabs **tabs) {
    if (!tabs || !*tabs)
        return;
    ktg_seam_tabs *t = *tabs;
    ktg_flats_free(&t->flats);
    ktg_cells_free(&t->cells);
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
    ktg_seam_frame outer = ktg_seam_outer_frame(t->a, t->a->dual->edges[e].halfedge[tab->side]);
    ktg_flat_box box = ktg_flat_box_empty();
    tab->corner_count = ktg_trapezoid_corners(&tab->shape, tab->corners);
    for (uint32_t i = 0; i < tab->corner_count; i++)
        tab->corners[i] = ktg_seam_from_frame(&outer, tab->corners[i]);
    ktg_flat_box first = ktg_flat_box_of(tab->corners),
                 second = ktg_flat_box_of(tab->corners + tab->corner_count - 3);
    ktg_flat_box_add(&box, &first);
    ktg_flat_box_add(&box, &second);
    return ktg_cells_put(context, &t->cells, e, t->a->piece[ktg_seam_carrier(t, e)], &box);
}

static ktg_status set_tab(ktg_context *context, ktg_seam_tabs *t, uint32_t e, int side,
                          const ktg_trapezoid *shape, double price) {
    KTG_TRY(remember(context, t, e));
    note_price(t, e, price);
    ktg_cells_take_out(&t->cells, e);
    t->tabs[e].side = side;
    if (side < 0)
        return KTG_OK;
    t->tabs[e].shape = *shape;
    return lay_tab(context, t, e);
}

/* True when both sides of a cut lie on each other: it becomes a fold in the end. */
static bool closes(const ktg_arrangement *a, uint32_t e) {
    const uint32_t *pair = a->dual->edges[e].halfedge;
    ktg_vec2 first = ktg_sub2(a->corners[pair[0]], a->corners[ktg_seam_next_corner(pair[1])]);
    ktg_vec2 second = ktg_sub2(a->corners[ktg_seam_next_corner(pair[0])], a->corners[pair[1]]);
    return ktg_max(ktg_dot2(first, first), ktg_dot2(second, second)) < CLOSED * CLOSED &&
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

ktg_status ktg_seam_tabs_choose(ktg_context *context, ktg_seam_tabs *t, uint32_t e) {
    ktg_trapezoid shapes[2];
    double prices[2];
    if (price_of_none(t, e) <= 0)
        return set_tab(context, t, e, -1, NULL, 0);
    prices[0] = ktg_seam_find_shape(t, e, 0, true, 1, &shapes[0]);
    prices[1] = prices[0] > 0 ? ktg_seam_find_shape(t, e, 1, true, 1, &shapes[1]) : 1;
    int side = prices[1] < prices[0];
    if (prices[side] >= 1)
        return set_tab(context, t, e, -1, NULL, 1);
    return set_tab(context, t, e, side, &shapes[side], prices[side]);
}

/* The last one first: it is new, and the most likely to find no room. */
static ktg_status choose_damaged(ktg_context *context, ktg_seam_tabs *t, double most) {
    while (t->damaged_count > 0 && t->price - t->damaged_count <= most)
        KTG_TRY(ktg_seam_tabs_choose(context, t, t->damaged[--t->damaged_count]));
    t->damaged_count = 0;
    return KTG_OK;
}

/* ---- making ones ---------------------------------------------------------------------------- */

/* Gives the edge a tab on the side where it had one, if it can be as good there as any. */
static ktg_status choose_again(ktg_context *context, ktg_seam_tabs *t, uint32_t e, int side) {
    ktg_trapezoid shape;
    double price = side < 0 ? 1 : ktg_seam_find_shape(t, e, side, true, 1, &shape);
    return price < 1 ? set_tab(context, t, e, side, &shape, price) : KTG_OK;
}

ktg_status ktg_seam_tabs_renew(ktg_context *context, ktg_seam_tabs *t,
                               const ktg_seam_tab_wish *wish) {
    uint32_t count = t->edge_count;
    t->wish = *wish;
    ktg_seam_shape_slots(t);
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

static ktg_status fill(ktg_context *context, ktg_seam_tabs *t) {
    size_t halfedges = 3 * (size_t)t->a->dual->face_count, edges = t->edge_count;
    t->edge_of = ktg_new(context, halfedges, uint32_t);
    t->slots = ktg_new(context, halfedges, ktg_tab_slot_shape);
    t->tabs = ktg_new(context, edges, ktg_seam_tab);
    t->unhappy = ktg_new(context, edges, uint32_t);
    t->unhappy_place = ktg_new(context, edges, uint32_t);
    t->stamp = ktg_new(context, edges, uint32_t);
    if (!t->edge_of || !t->slots || !t->tabs || !t->unhappy || !t->unhappy_place || !t->stamp)
        return KTG_MEMORY;
    KTG_TRY(ktg_arrangement_cells(context, t->a, t->edge_count, &t->cells));
    KTG_TRY(ktg_flats_new(context, t->a->dual, &t->flats));
    list_edges(t);
    ktg_seam_shape_slots(t);
    return KTG_OK;
}

ktg_status ktg_seam_tabs_new(ktg_context *context, ktg_arrangement *a,
                             const ktg_seam_tab_wish *wish, ktg_seam_tabs **tabs) {
    ktg_seam_tabs *t = *tabs = ktg_new(context, 1, ktg_seam_tabs);
    if (!t)
        return KTG_MEMORY;
    t->a = a;
    t->wish = *wish;
    t->edge_count = a->dual->edge_count + a->dual->forced_count;
    ktg_status status = fill(context, t);
    if (status != KTG_OK)
        ktg_seam_tabs_free(tabs);
    return status;
}

/* ---- attempts ------------------------------------------------------------------------------- */

void ktg_seam_tabs_begin(ktg_seam_tabs *t) {
    t->before_count = t->damaged_count = 0;
    if (++t->attempt == 0) {
        memset(t->stamp, 0, t->edge_count * sizeof *t->stamp);
        t->attempt = 1;
    }
}

/* One moved face of the branch against the tabs near its new place. */
static ktg_status damage_by_face(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch,
                                 uint32_t face, const ktg_graft *graft) {
    const ktg_arrangement *a = t->a;
    ktg_vec2 moved[3];
    for (int k = 0; k < 3; k++)
        moved[k] = ktg_move2(graft->motion, a->corners[3 * (size_t)face + k]);
    ktg_flat_box box = ktg_flat_box_grown(ktg_flat_box_of(moved), t->wish.air);
    ktg_cell_walk walk = ktg_cells_walk(&t->cells, a->piece[graft->other / 3], &box);
    for (uint32_t e; (e = ktg_cells_next(&walk)) != KTG_NONE;) {
        if (e == graft->edge || ktg_branch_holds(a, branch, ktg_seam_carrier(t, e)))
            continue;
        ktg_seam_frame outer = ktg_seam_outer_frame(a, a->dual->edges[e].halfedge[t->tabs[e].side]);
        ktg_seam_obstacle o = {.count = 3};
        for (int k = 0; k < 3; k++)
            o.corners[k] = ktg_seam_to_frame(&outer, moved[k]);
        if (ktg_seam_is_hit(t, &t->tabs[e].shape, &o))
            KTG_TRY(damage(context, t, e));
    }
    return KTG_OK;
}

ktg_status ktg_seam_tabs_damage(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch,
                                const ktg_graft *graft) {
    for (uint32_t i = 0; i < branch->count; i++)
        KTG_TRY(damage_by_face(context, t, branch, t->a->order[branch->first + i], graft));
    return KTG_OK;
}

/* The next half-edge of the branch's faces, from *h on, whose tab its face carries; the edge. */
static uint32_t next_carried(const ktg_seam_tabs *t, const ktg_branch *branch, uint32_t *at) {
    const ktg_arrangement *a = t->a;
    while (*at < 3 * branch->count) {
        uint32_t h = 3 * a->order[branch->first + *at / 3] + *at % 3, e = t->edge_of[h];
        ++*at;
        if (e != KTG_NONE && t->tabs[e].side >= 0 &&
            a->dual->edges[e].halfedge[t->tabs[e].side] == h)
            return e;
    }
    return KTG_NONE;
}

ktg_status ktg_seam_tabs_lay(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch) {
    uint32_t at = 0;
    for (uint32_t e; (e = next_carried(t, branch, &at)) != KTG_NONE;)
        KTG_TRY(lay_tab(context, t, e));
    return KTG_OK;
}

ktg_status ktg_seam_tabs_follow(ktg_context *context, ktg_seam_tabs *t, const ktg_branch *branch,
                                uint32_t joined, uint32_t cut, double most) {
    uint32_t at = 0;
    KTG_TRY(set_tab(context, t, joined, -1, NULL, 0));
    KTG_TRY(ktg_seam_tabs_lay(context, t, branch));
    for (uint32_t e; (e = next_carried(t, branch, &at)) != KTG_NONE;)
        if (ktg_seam_lies_badly(t, branch, e))
            KTG_TRY(damage(context, t, e));
    KTG_TRY(damage(context, t, cut));
    return choose_damaged(context, t, most);
}

ktg_status ktg_seam_tabs_undo(ktg_context *context, ktg_seam_tabs *t) {
    for (size_t i = 0; i < t->before_count; i++) {
        uint32_t e = t->before[i].edge;
        note_price(t, e, t->before[i].tab.price);
        ktg_cells_take_out(&t->cells, e);
        t->tabs[e] = t->before[i].tab;
        KTG_TRY(lay_tab(context, t, e));
    }
    return KTG_OK;
}

/* ---- pushing -------------------------------------------------------------------------------- */

/* Damages the tabs beside the same piece that the shape lies on. */
static ktg_status damage_beside(ktg_context *context, ktg_seam_tabs *t, uint32_t own,
                                const ktg_trapezoid *shape) {
    ktg_seam_frame outer = ktg_seam_outer_frame(t->a, own);
    ktg_flat_box box = ktg_seam_box_around(shape, &outer, t->wish.air);
    ktg_cell_walk walk = ktg_cells_walk(&t->cells, t->a->piece[own / 3], &box);
    for (uint32_t e; (e = ktg_cells_next(&walk)) != KTG_NONE;) {
        ktg_seam_obstacle o = ktg_seam_tab_at(t, &outer, e);
        if (e != t->edge_of[own] && ktg_seam_is_hit(t, shape, &o))
            KTG_TRY(damage(context, t, e));
    }
    return KTG_OK;
}

static ktg_status damage_under(ktg_context *context, ktg_seam_tabs *t, uint32_t mate,
                               const ktg_trapezoid *shape) {
    const ktg_flats *f = &t->flats;
    uint32_t region = f->region[mate / 3];
    ktg_seam_frame under = ktg_seam_under_frame(t, mate);
    ktg_seam_obstacle o;
    for (uint32_t i = f->first[region]; i < f->first[region + 1]; i++)
        if (f->sides[i] != mate && ktg_seam_tab_under(t, &under, f->sides[i], &o) &&
            ktg_seam_is_hit(t, shape, &o))
            KTG_TRY(damage(context, t, t->edge_of[f->sides[i]]));
    return KTG_OK;
}

ktg_status ktg_seam_tabs_push(ktg_context *context, ktg_seam_tabs *t, uint32_t e, int side,
                              double part, double most) {
    const uint32_t *pair = t->a->dual->edges[e].halfedge;
    ktg_trapezoid shape;
    double price = ktg_seam_find_shape(t, e, side, false, part, &shape);
    if (price >= 1)
        return KTG_OK;
    KTG_TRY(set_tab(context, t, e, -1, NULL, 1));
    KTG_TRY(damage_beside(context, t, pair[side], &shape));
    KTG_TRY(damage_under(context, t, pair[1 - side], &shape));
    KTG_TRY(set_tab(context, t, e, side, &shape, price));
    return choose_damaged(context, t, most);
}
