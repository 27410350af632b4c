/* pattern/tab_conflicts.c - which tabs could get into each other's way. */
#include "pattern/tabs.h"

#include "core/memory.h"

/* Pairs of slots, each found once. */
typedef struct pair_list {
    struct pair {
        uint32_t a, b;
        ktg_tab_layer layer;
    } * pairs;
    size_t count, capacity;
} pair_list;

static uint32_t corners_in(const ktg_tab_slot *slot, ktg_tab_layer layer, ktg_vec2 corners[4]) {
    uint32_t count = ktg_trapezoid_corners(&slot->room, corners);
    for (uint32_t i = 0; i < count; i++)
        corners[i] = ktg_from_frame(&slot->frames[layer], corners[i]);
    return count;
}

/* The boxes around the rooms in one layer, pieces moved apart; empty for unusable slots. */
static void set_boxes(const ktg_tab_plan *plan, ktg_tab_layer layer, ktg_box *boxes) {
    for (uint32_t i = 0; i < 2 * plan->cut_count; i++) {
        const ktg_tab_slot *slot = &plan->slots[i];
        ktg_vec2 corners[4];
        boxes[i] = ktg_box_of(corners, 0);
        if (!slot->usable)
            continue;
        boxes[i] = ktg_box_of(corners, corners_in(slot, layer, corners));
        ktg_vec2 shift = plan->shifts[slot->frames[layer].piece];
        boxes[i].low = ktg_add2(boxes[i].low, shift);
        boxes[i].high = ktg_add2(boxes[i].high, shift);
    }
}

/* Two usable slots of different edges whose rooms come near each other in a layer. */
static bool are_near(const ktg_tab_plan *plan, uint32_t a, uint32_t b, ktg_tab_layer layer) {
    const ktg_tab_slot *first = &plan->slots[a], *second = &plan->slots[b];
    const ktg_topology *t = plan->topology;
    if (a / 2 == b / 2 || first->frames[layer].piece != second->frames[layer].piece)
        return false;
    if (layer == KTG_LAYER_UNDER && t->region_of[first->mate / 3] != t->region_of[second->mate / 3])
        return false;
    ktg_vec2 corners[4];
    uint32_t count = corners_in(second, layer, corners);
    for (uint32_t i = 0; i < count; i++)
        corners[i] = ktg_to_frame(&first->frames[layer], corners[i]);
    return ktg_trapezoid_meets(&first->room, corners, count, KTG_TAB_AIR_MM);
}

static ktg_status find_pairs(ktg_context *context, const ktg_tab_plan *plan, ktg_tab_layer layer,
                             ktg_grid *grid, pair_list *list) {
    for (uint32_t a = 0; a < 2 * plan->cut_count; a++) {
        if (!plan->slots[a].usable)
            continue;
        uint32_t found = ktg_grid_query(grid, ktg_box_grown(grid->boxes[a], KTG_TAB_AIR_MM));
        for (uint32_t k = 0; k < found; k++) {
            uint32_t b = grid->found[k];
            if (b <= a || !are_near(plan, a, b, layer))
                continue;
            KTG_TRY(ktg_reserve(context, &list->pairs, &list->capacity, list->count + 1));
            list->pairs[list->count++] = (struct pair){a, b, layer};
        }
    }
    return KTG_OK;
}

static ktg_status find_in_layer(ktg_context *context, const ktg_tab_plan *plan, ktg_tab_layer layer,
                                ktg_box *boxes, pair_list *list) {
    ktg_grid grid;
    set_boxes(plan, layer, boxes);
    KTG_TRY(ktg_grid_build(context, boxes, 2 * plan->cut_count, &grid));
    ktg_status status = find_pairs(context, plan, layer, &grid, list);
    ktg_grid_drop(&grid);
    return status;
}

/* Each pair is entered for both of its slots. */
static ktg_status enter(ktg_context *context, ktg_tab_plan *plan, const pair_list *list) {
    uint32_t slot_count = 2 * plan->cut_count;
    if (list->count > KTG_NONE / 2)
        return ktg_fail(context, KTG_LIMIT, "too many tabs in each other's way");
    plan->conflicts = ktg_new(context, 2 * list->count, ktg_tab_conflict);
    if (!plan->conflicts)
        return KTG_MEMORY;
    for (size_t k = 0; k < list->count; k++) {
        plan->slots[list->pairs[k].a].conflict_first++;
        plan->slots[list->pairs[k].b].conflict_first++;
    }
    uint32_t end = 0;
    for (uint32_t i = 0; i <= slot_count; i++) {
        end += plan->slots[i].conflict_first;
        plan->slots[i].conflict_first = end;
    }
    for (size_t k = list->count; k-- > 0;) { /* from the back: starts move down to their place */
        const struct pair *pair = &list->pairs[k];
        plan->conflicts[--plan->slots[pair->a].conflict_first] =
            (ktg_tab_conflict){pair->b, pair->layer};
        plan->conflicts[--plan->slots[pair->b].conflict_first] =
            (ktg_tab_conflict){pair->a, pair->layer};
    }
    return KTG_OK;
}

ktg_status ktg_tab_plan_conflicts(ktg_context *context, ktg_tab_plan *plan) {
    pair_list list = {0};
    ktg_box *boxes = ktg_new(context, 2 * (size_t)plan->cut_count, ktg_box);
    ktg_status status = boxes ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = find_in_layer(context, plan, KTG_LAYER_OUTSIDE, boxes, &list);
    if (status == KTG_OK)
        status = find_in_layer(context, plan, KTG_LAYER_UNDER, boxes, &list);
    if (status == KTG_OK)
        status = enter(context, plan, &list);
    ktg_free(boxes);
    ktg_free(list.pairs);
    return status;
}
