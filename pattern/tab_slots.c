/* pattern/tab_slots.c - the room each side of a cut edge has for a tab, other tabs aside. */
#include "pattern/tabs.h"

#include "core/memory.h"

/* The half-edges that bound faces and flat regions, in a grid. */
typedef struct walls {
    uint32_t *halfedges;
    ktg_box *boxes;
    uint32_t count;
    ktg_grid grid;
    ktg_tab_wall *near; /* scratch: what stands around one slot, in its frame */
} walls;

/* Places the pieces side by side, further apart than two tabs are high. */
static ktg_status set_shifts(ktg_context *context, ktg_tab_plan *plan) {
    const ktg_pattern *pattern = plan->topology->pattern;
    double gap = 4 * (plan->options->tab_height_mm + plan->options->tab_inset_mm + 1), x = 0;
    plan->shifts = ktg_new(context, pattern->piece_count, ktg_vec2);
    if (!plan->shifts)
        return KTG_MEMORY;
    for (size_t p = 0; p < pattern->piece_count; p++) {
        const ktg_pattern_piece *piece = &pattern->pieces[p];
        ktg_box box = ktg_box_of(piece->vertices, piece->vertex_count);
        plan->shifts[p] = (ktg_vec2){x - box.low.x, -box.low.y};
        x += box.high.x - box.low.x + gap;
    }
    return KTG_OK;
}

static ktg_box shifted_box(const ktg_tab_plan *plan, uint32_t piece, const ktg_vec2 *points,
                           size_t count) {
    ktg_box box = ktg_box_of(points, count);
    box.low = ktg_add2(box.low, plan->shifts[piece]);
    box.high = ktg_add2(box.high, plan->shifts[piece]);
    return box;
}

/* True for the borders of pieces and, where a flat region has several faces, the folds around it.
 */
static bool is_wall(const ktg_topology *t, uint32_t h) {
    if (t->piece_of[h / 3] == KTG_NONE)
        return false;
    if (t->place_of[h] != KTG_NONE)
        return true;
    return ktg_edge_at(t, h)->kind != KTG_EDGE_FLAT && t->region_size[t->region_of[h / 3]] > 1;
}

static ktg_status build_walls(ktg_context *context, const ktg_tab_plan *plan, walls *w) {
    const ktg_topology *t = plan->topology;
    uint32_t halfedges = 3 * t->pattern->face_count;
    w->halfedges = ktg_new(context, halfedges, uint32_t);
    w->boxes = ktg_new(context, halfedges, ktg_box);
    w->near = ktg_new(context, 2 * (size_t)halfedges, ktg_tab_wall);
    if (!w->halfedges || !w->boxes || !w->near)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < halfedges; h++) {
        if (!is_wall(t, h))
            continue;
        ktg_vec2 ends[2] = {ktg_start_of(t, h), ktg_end_of(t, h)};
        w->halfedges[w->count] = h;
        w->boxes[w->count++] = shifted_box(plan, t->piece_of[h / 3], ends, 2);
    }
    return ktg_grid_build(context, w->boxes, w->count, &w->grid);
}

static void drop_walls(walls *w) {
    ktg_grid_drop(&w->grid);
    ktg_free(w->halfedges);
    ktg_free(w->boxes);
    ktg_free(w->near);
}

static ktg_tab_frame frame_between(uint32_t piece, ktg_vec2 from, ktg_vec2 to) {
    return (ktg_tab_frame){from, ktg_unit2(ktg_sub2(to, from)), piece};
}

/* Outside, the frame runs against the half-edge that carries the tab; under the mate, along it:
 * the rigid motion between the two copies is the change of frame. */
static void set_frames(const ktg_topology *t, ktg_tab_slot *slot) {
    uint32_t h = slot->halfedge, m = slot->mate;
    slot->frames[KTG_LAYER_OUTSIDE] =
        frame_between(t->piece_of[h / 3], ktg_end_of(t, h), ktg_start_of(t, h));
    slot->frames[KTG_LAYER_UNDER] =
        frame_between(t->piece_of[m / 3], ktg_start_of(t, m), ktg_end_of(t, m));
}

static void cut_by_wall(const ktg_topology *t, ktg_tab_slot *slot, ktg_tab_layer layer,
                        uint32_t wall, double clearance) {
    const ktg_tab_frame *frame = &slot->frames[layer];
    ktg_vec2 ends[2] = {ktg_to_frame(frame, ktg_start_of(t, wall)),
                        ktg_to_frame(frame, ktg_end_of(t, wall))};
    ktg_trapezoid_cut(&slot->room, &slot->wish, ends, 2, clearance);
}

/* The walls near the room, as it lies in a layer, are left in the grid's `found`. */
static uint32_t walls_near(const ktg_tab_plan *plan, const ktg_tab_slot *slot, ktg_tab_layer layer,
                           double clearance, walls *w) {
    ktg_vec2 corners[4];
    uint32_t count = ktg_trapezoid_corners(&slot->room, corners);
    const ktg_tab_frame *frame = &slot->frames[layer];
    for (uint32_t i = 0; i < count; i++)
        corners[i] = ktg_from_frame(frame, corners[i]);
    ktg_box box = shifted_box(plan, frame->piece, corners, count);
    return ktg_grid_query(&w->grid, ktg_box_grown(box, clearance));
}

/* The border of the mate's flat region, the sides next to the edge first: they shape the tab. */
static void cut_by_region(const ktg_tab_plan *plan, ktg_tab_slot *slot, walls *w) {
    const ktg_topology *t = plan->topology;
    uint32_t m = slot->mate, region = t->region_of[m / 3];
    uint32_t own[2] = {ktg_next_corner(m), ktg_next_corner(ktg_next_corner(m))};
    for (int k = 0; k < 2; k++)
        if (ktg_edge_at(t, own[k])->kind != KTG_EDGE_FLAT)
            cut_by_wall(t, slot, KTG_LAYER_UNDER, own[k], plan->options->tab_inset_mm);
    if (t->region_size[region] == 1)
        return;
    uint32_t found = walls_near(plan, slot, KTG_LAYER_UNDER, plan->options->tab_inset_mm, w);
    for (uint32_t i = 0; i < found; i++) {
        uint32_t wall = w->halfedges[w->grid.found[i]];
        if (wall != m && t->region_of[wall / 3] == region)
            cut_by_wall(t, slot, KTG_LAYER_UNDER, wall, plan->options->tab_inset_mm);
    }
}

/* The border of the carrying piece, the neighbours first. */
static void cut_by_piece(const ktg_tab_plan *plan, ktg_tab_slot *slot, double air, walls *w) {
    const ktg_topology *t = plan->topology;
    uint32_t h = slot->halfedge;
    cut_by_wall(t, slot, KTG_LAYER_OUTSIDE, ktg_border_previous(t, h), air);
    cut_by_wall(t, slot, KTG_LAYER_OUTSIDE, ktg_border_next(t, h), air);
    uint32_t found = walls_near(plan, slot, KTG_LAYER_OUTSIDE, air, w);
    for (uint32_t i = 0; i < found; i++) {
        uint32_t wall = w->halfedges[w->grid.found[i]];
        if (wall != h && t->place_of[wall] != KTG_NONE)
            cut_by_wall(t, slot, KTG_LAYER_OUTSIDE, wall, air);
    }
}

/* Appends to w->near what stands around the room in a layer (under: the region's border). */
static uint32_t gather(const ktg_tab_plan *plan, const ktg_tab_slot *slot, ktg_tab_layer layer,
                       double clearance, uint32_t count, walls *w) {
    const ktg_topology *t = plan->topology;
    const ktg_tab_frame *frame = &slot->frames[layer];
    uint32_t own = layer == KTG_LAYER_UNDER ? slot->mate : slot->halfedge;
    uint32_t region = t->region_of[slot->mate / 3];
    uint32_t found = walls_near(plan, slot, layer, clearance, w);
    for (uint32_t i = 0; i < found; i++) {
        uint32_t wall = w->halfedges[w->grid.found[i]];
        bool counts = layer == KTG_LAYER_UNDER ? t->region_of[wall / 3] == region
                                               : t->place_of[wall] != KTG_NONE;
        if (wall == own || !counts)
            continue;
        w->near[count++] = (ktg_tab_wall){
            {ktg_to_frame(frame, ktg_start_of(t, wall)), ktg_to_frame(frame, ktg_end_of(t, wall))},
            clearance};
    }
    return count;
}

/* The sides of a region of one face are no walls of the grid. */
static uint32_t gather_sides(const ktg_tab_plan *plan, const ktg_tab_slot *slot, uint32_t count,
                             walls *w) {
    const ktg_topology *t = plan->topology;
    const ktg_tab_frame *frame = &slot->frames[KTG_LAYER_UNDER];
    uint32_t side = slot->mate;
    for (int k = 0; k < 2; k++) {
        side = ktg_next_corner(side);
        w->near[count++] = (ktg_tab_wall){
            {ktg_to_frame(frame, ktg_start_of(t, side)), ktg_to_frame(frame, ktg_end_of(t, side))},
            plan->options->tab_inset_mm};
    }
    return count;
}

/* Where cutting back left nothing: any tab at all. */
static bool find_low_room(const ktg_tab_plan *plan, ktg_tab_slot *slot, walls *w) {
    const ktg_finish_options *options = plan->options;
    const ktg_topology *t = plan->topology;
    slot->room = (ktg_trapezoid){0, slot->wish.length, 0, 0, options->tab_height_mm};
    uint32_t count = gather(plan, slot, KTG_LAYER_OUTSIDE, KTG_TAB_AIR_LEAST_MM, 0, w);
    if (t->region_size[t->region_of[slot->mate / 3]] == 1)
        count = gather_sides(plan, slot, count, w);
    else
        count = gather(plan, slot, KTG_LAYER_UNDER, options->tab_inset_mm, count, w);
    return ktg_trapezoid_search(&slot->room, &slot->wish, options->tab_inset_mm, w->near, count);
}

/* What is left when everything in the way has cut the wished tab back. */
static bool find_cut_room(const ktg_tab_plan *plan, ktg_tab_slot *slot, walls *w) {
    cut_by_region(plan, slot, w);
    if (!ktg_trapezoid_is_tab(&slot->room, &slot->wish))
        return false;
    slot->wish.height = slot->room.height;
    ktg_trapezoid under = slot->room;
    cut_by_piece(plan, slot, KTG_TAB_AIR_MM, w);
    if (!ktg_trapezoid_is_full(&slot->room, &slot->wish)) {
        ktg_trapezoid airy = slot->room;
        slot->room = under;
        cut_by_piece(plan, slot, KTG_TAB_AIR_LEAST_MM, w);
        if (ktg_trapezoid_value(&airy, &slot->wish) >=
            ktg_trapezoid_value(&slot->room, &slot->wish))
            slot->room = airy;
    }
    return ktg_trapezoid_is_tab(&slot->room, &slot->wish);
}

static void find_room(const ktg_tab_plan *plan, ktg_tab_slot *slot, walls *w) {
    const ktg_finish_options *options = plan->options;
    double length = ktg_length2(ktg_sub2(ktg_end_of(plan->topology, slot->halfedge),
                                         ktg_start_of(plan->topology, slot->halfedge)));
    slot->room = ktg_trapezoid_wished(length, options->tab_height_mm, 1 / tan(options->tab_flank),
                                      options->tab_inset_mm);
    slot->wish = (ktg_tab_wish){length, options->tab_height_mm, options->tab_least_mm};
    if (!(options->tab_height_mm > 0) || !ktg_trapezoid_is_tab(&slot->room, &slot->wish))
        return;
    set_frames(plan->topology, slot);
    slot->usable = find_cut_room(plan, slot, w) ||
                   (length >= options->tab_edge_mm && find_low_room(plan, slot, w));
}

static ktg_status list_cuts(ktg_context *context, ktg_tab_plan *plan) {
    const ktg_pattern *pattern = plan->topology->pattern;
    plan->cuts = ktg_new(context, pattern->edge_count, uint32_t);
    if (!plan->cuts)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < pattern->edge_count; e++)
        if (pattern->edges[e].kind == KTG_EDGE_CUT)
            plan->cuts[plan->cut_count++] = e;
    plan->slots = ktg_new(context, 2 * (size_t)plan->cut_count + 1, ktg_tab_slot);
    return plan->slots ? KTG_OK : KTG_MEMORY;
}

ktg_status ktg_tab_plan_slots(ktg_context *context, ktg_tab_plan *plan) {
    walls w = {0};
    KTG_TRY(set_shifts(context, plan));
    KTG_TRY(list_cuts(context, plan));
    ktg_status status = build_walls(context, plan, &w);
    for (uint32_t i = 0; status == KTG_OK && i < 2 * plan->cut_count; i++) {
        const ktg_pattern_edge *edge = &plan->topology->pattern->edges[plan->cuts[i / 2]];
        plan->slots[i].halfedge = ktg_side_halfedge(&edge->sides[i % 2]);
        plan->slots[i].mate = ktg_side_halfedge(&edge->sides[1 - i % 2]);
        find_room(plan, &plan->slots[i], &w);
    }
    drop_walls(&w);
    return status;
}
