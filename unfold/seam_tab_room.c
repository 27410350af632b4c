/* unfold/seam_tab_room.c - the room that seams of an arrangement have for tabs. */
#include "unfold/seam_tab_room.h"

/* Price of a tab that stands out of the sheet by its half, and the most it can be. */
#define STANDING_OUT      10.0
#define STANDING_OUT_MOST 0.5

/* Sides of a flat region that a low tab is looked for between, at most. */
#define MOST_WALLS 64

/* ---- frames --------------------------------------------------------------------------------- */

ktg_seam_frame ktg_seam_outer_frame(const ktg_arrangement *a, uint32_t h) {
    ktg_vec2 from = a->corners[ktg_seam_next_corner(h)], to = a->corners[h];
    return (ktg_seam_frame){from, ktg_mul2(ktg_sub2(to, from), 1 / a->dual->lengths[h])};
}

ktg_seam_frame ktg_seam_under_frame(const ktg_seam_tabs *t, uint32_t mate) {
    ktg_vec2 from = t->flats.corners[mate], to = t->flats.corners[ktg_seam_next_corner(mate)];
    return (ktg_seam_frame){from, ktg_mul2(ktg_sub2(to, from), 1 / t->a->dual->lengths[mate])};
}

static ktg_seam_obstacle seen_from(const ktg_seam_frame *f, const ktg_vec2 *corners,
                                   uint32_t count) {
    ktg_seam_obstacle o = {.count = count};
    for (uint32_t i = 0; i < count; i++)
        o.corners[i] = ktg_seam_to_frame(f, corners[i]);
    return o;
}

ktg_seam_obstacle ktg_seam_face_at(const ktg_seam_tabs *t, const ktg_seam_frame *f, uint32_t face) {
    return seen_from(f, t->a->corners + 3 * (size_t)face, 3);
}

ktg_seam_obstacle ktg_seam_tab_at(const ktg_seam_tabs *t, const ktg_seam_frame *f, uint32_t edge) {
    return seen_from(f, t->tabs[edge].corners, t->tabs[edge].corner_count);
}

bool ktg_seam_tab_under(const ktg_seam_tabs *t, const ktg_seam_frame *f, uint32_t side,
                        ktg_seam_obstacle *o) {
    uint32_t e = t->edge_of[side];
    if (e == KTG_NONE || t->tabs[e].side < 0 ||
        t->a->dual->edges[e].halfedge[t->tabs[e].side] == side) /* that one is beside the face */
        return false;
    ktg_seam_frame there = ktg_seam_under_frame(t, side);
    o->count = ktg_trapezoid_corners(&t->tabs[e].shape, o->corners);
    for (uint32_t i = 0; i < o->count; i++)
        o->corners[i] = ktg_seam_to_frame(f, ktg_seam_from_frame(&there, o->corners[i]));
    return true;
}

bool ktg_seam_is_hit(const ktg_seam_tabs *t, const ktg_trapezoid *shape,
                     const ktg_seam_obstacle *o) {
    return !ktg_trapezoid_is_clear(shape, o->corners, o->count, t->wish.air);
}

ktg_flat_box ktg_seam_box_around(const ktg_trapezoid *shape, const ktg_seam_frame *outer,
                                 double air) {
    ktg_vec2 c[4];
    uint32_t count = ktg_trapezoid_corners(shape, c);
    for (uint32_t i = 0; i < count; i++)
        c[i] = ktg_seam_from_frame(outer, c[i]);
    ktg_flat_box box = ktg_flat_box_of(c), last = ktg_flat_box_of(c + count - 3);
    ktg_flat_box_add(&box, &last);
    return ktg_flat_box_grown(box, air);
}

/* ---- slots ---------------------------------------------------------------------------------- */

static void cut_by_side(const ktg_seam_tabs *t, const ktg_seam_frame *under, uint32_t side,
                        ktg_tab_slot_shape *slot) {
    const ktg_vec2 *corners = t->flats.corners;
    ktg_vec2 ends[2] = {ktg_seam_to_frame(under, corners[side]),
                        ktg_seam_to_frame(under, corners[ktg_seam_next_corner(side)])};
    ktg_trapezoid_cut(&slot->under, &slot->wish, ends, 2, t->wish.inset);
}

/* Where cutting back leaves nothing: a low, pointed tab. */
static bool find_low_shape(const ktg_seam_tabs *t, const ktg_seam_frame *under, uint32_t mate,
                           ktg_tab_slot_shape *slot) {
    const ktg_flats *f = &t->flats;
    ktg_tab_wall walls[MOST_WALLS];
    uint32_t region = f->region[mate / 3], first = f->first[region], count = 0;
    if (f->first[region + 1] - first > MOST_WALLS)
        return false;
    for (uint32_t i = first; i < f->first[region + 1]; i++) {
        uint32_t side = f->sides[i];
        ktg_vec2 from = f->corners[side], to = f->corners[ktg_seam_next_corner(side)];
        if (side != mate)
            walls[count++] = (ktg_tab_wall){
                {ktg_seam_to_frame(under, from), ktg_seam_to_frame(under, to)}, t->wish.inset};
    }
    return ktg_trapezoid_search(&slot->under, &slot->wish, t->wish.inset, walls, count);
}

/* The wished tab, cut back to what fits under the mate's region: its own face's sides first, since
 * they shape it. */
static void shape_slot(const ktg_seam_tabs *t, uint32_t own, uint32_t mate) {
    const ktg_flats *f = &t->flats;
    const ktg_seam_tab_wish *w = &t->wish;
    double length = t->a->dual->lengths[own];
    ktg_tab_slot_shape *slot = &t->slots[own];
    ktg_seam_frame under = ktg_seam_under_frame(t, mate);
    uint32_t region = f->region[mate / 3];
    *slot = (ktg_tab_slot_shape){.wish = {length, w->height, w->least}};
    if (length < w->edge)
        return;
    slot->under = ktg_trapezoid_wished(length, w->height, w->cot, w->inset);
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = f->first[region]; i < f->first[region + 1]; i++)
            if (f->sides[i] != mate && (f->sides[i] / 3 == mate / 3) == (pass == 0))
                cut_by_side(t, &under, f->sides[i], slot);
    slot->usable =
        ktg_trapezoid_is_tab(&slot->under, &slot->wish) || find_low_shape(t, &under, mate, slot);
    slot->wish.height = slot->under.height;
}

void ktg_seam_shape_slots(ktg_seam_tabs *t) {
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const uint32_t *pair = t->a->dual->edges[e].halfedge;
        shape_slot(t, pair[0], pair[1]);
        shape_slot(t, pair[1], pair[0]);
    }
}

/* ---- room ----------------------------------------------------------------------------------- */

/* Cuts the shape back by the tabs that are glued under the same region. */
static void cut_under(const ktg_seam_tabs *t, uint32_t mate, const ktg_tab_wish *wish,
                      ktg_trapezoid *shape) {
    const ktg_flats *f = &t->flats;
    uint32_t region = f->region[mate / 3];
    ktg_seam_frame under = ktg_seam_under_frame(t, mate);
    ktg_seam_obstacle o;
    for (uint32_t i = f->first[region]; i < f->first[region + 1]; i++)
        if (f->sides[i] != mate && ktg_seam_tab_under(t, &under, f->sides[i], &o))
            ktg_trapezoid_cut(shape, wish, o.corners, o.count, t->wish.air);
}

/* Cuts the shape back by faces beside the one that carries it, and on request by tabs. */
static bool cut_beside(const ktg_seam_tabs *t, uint32_t own, bool by_tabs, const ktg_tab_wish *wish,
                       ktg_trapezoid *shape) {
    const ktg_arrangement *a = t->a;
    ktg_seam_frame outer = ktg_seam_outer_frame(a, own);
    ktg_flat_box box = ktg_seam_box_around(shape, &outer, t->wish.air);
    for (int k = 0; k < 1 + by_tabs; k++) {
        const ktg_cells *cells = k == 0 ? &a->cells : &t->cells;
        uint32_t self = k == 0 ? own / 3 : t->edge_of[own];
        ktg_cell_walk walk = ktg_cells_walk(cells, a->piece[own / 3], &box);
        for (uint32_t item; (item = ktg_cells_next(&walk)) != KTG_NONE;) {
            if (item == self)
                continue;
            ktg_seam_obstacle o =
                k == 0 ? ktg_seam_face_at(t, &outer, item) : ktg_seam_tab_at(t, &outer, item);
            ktg_trapezoid_cut(shape, wish, o.corners, o.count, t->wish.air);
            if (!ktg_trapezoid_is_tab(shape, wish))
                return false;
        }
    }
    return true;
}

static double price_of(const ktg_trapezoid *shape, const ktg_tab_wish *wish) {
    if (ktg_trapezoid_is_full(shape, wish))
        return 0;
    double part = 2 * (ktg_trapezoid_value(shape, wish) - 1); /* 0 .. 1 */
    return KTG_PRICE_REDUCED_MOST - (KTG_PRICE_REDUCED_MOST - KTG_PRICE_REDUCED_LEAST) * part;
}

/* A tab beyond the edge of its sheet makes the model smaller. */
static double price_of_standing_out(const ktg_seam_tabs *t, uint32_t own,
                                    const ktg_trapezoid *shape) {
    ktg_seam_frame outer = ktg_seam_outer_frame(t->a, own);
    ktg_flat_box box = ktg_seam_box_around(shape, &outer, 0);
    double x = ktg_max(-(double)box.x0, box.x1) / t->wish.half.x;
    double y = ktg_max(-(double)box.y0, box.y1) / t->wish.half.y, out = ktg_max(x, y) - 1;
    return out > 0 ? ktg_min(STANDING_OUT_MOST, STANDING_OUT * out) : 0;
}

double ktg_seam_find_shape(const ktg_seam_tabs *t, uint32_t e, int side, bool by_tabs, double part,
                           ktg_trapezoid *shape) {
    const uint32_t *pair = t->a->dual->edges[e].halfedge;
    uint32_t own = pair[side], mate = pair[1 - side];
    const ktg_tab_slot_shape *slot = &t->slots[own];
    if (!slot->usable)
        return 1;
    *shape = slot->under;
    double most = ktg_max(slot->wish.least, part * slot->wish.height);
    shape->height = ktg_min(shape->height, most);
    if (by_tabs)
        cut_under(t, mate, &slot->wish, shape);
    if (!ktg_trapezoid_is_tab(shape, &slot->wish) ||
        !cut_beside(t, own, by_tabs, &slot->wish, shape))
        return 1;
    return price_of(shape, &slot->wish) + price_of_standing_out(t, own, shape);
}

bool ktg_seam_lies_badly(const ktg_seam_tabs *t, const ktg_branch *branch, uint32_t e) {
    const ktg_arrangement *a = t->a;
    const ktg_seam_tab *tab = &t->tabs[e];
    uint32_t own = a->dual->edges[e].halfedge[tab->side], sheet = a->piece[own / 3];
    ktg_seam_frame outer = ktg_seam_outer_frame(a, own);
    ktg_flat_box box = ktg_seam_box_around(&tab->shape, &outer, t->wish.air);
    for (int k = 0; k < 2; k++) {
        ktg_cell_walk walk = ktg_cells_walk(k == 0 ? &a->cells : &t->cells, sheet, &box);
        for (uint32_t item; (item = ktg_cells_next(&walk)) != KTG_NONE;) {
            if (ktg_branch_holds(a, branch, k == 0 ? item : ktg_seam_carrier(t, item)))
                continue;
            ktg_seam_obstacle o =
                k == 0 ? ktg_seam_face_at(t, &outer, item) : ktg_seam_tab_at(t, &outer, item);
            if (ktg_seam_is_hit(t, &tab->shape, &o))
                return true;
        }
    }
    return false;
}
