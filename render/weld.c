/* render/weld.c - points that lie together become one: a hash table of small cells. */
#include "render/weld.h"

#include "core/memory.h"
#include "core/vec.h"

static uint64_t hash_cell(int64_t x, int64_t y) {
    uint64_t h =
        (uint64_t)x * UINT64_C(0x9e3779b97f4a7c15) ^ (uint64_t)y * UINT64_C(0xc2b2ae3d27d4eb4f);
    h ^= h >> 29;
    h *= UINT64_C(0xbf58476d1ce4e5b9);
    return h ^ h >> 32;
}

/* A cell is as wide as the tolerance, so that what is near lies in one of nine. */
static int64_t cell_of(const ktg_weld *weld, double value) {
    return (int64_t)floor(value / weld->tolerance);
}

static void enter(ktg_weld *weld, uint32_t index) {
    ktg_vec2 p = weld->points[index];
    size_t at = hash_cell(cell_of(weld, p.x), cell_of(weld, p.y)) & (weld->slot_count - 1);
    while (weld->slots[at])
        at = (at + 1) & (weld->slot_count - 1);
    weld->slots[at] = index + 1;
}

static ktg_status grow(ktg_weld *weld) {
    size_t wanted = weld->slot_count ? 2 * weld->slot_count : 64;
    uint32_t *slots = ktg_new(weld->context, wanted, uint32_t);
    if (!slots)
        return KTG_MEMORY;
    ktg_free(weld->slots);
    weld->slots = slots;
    weld->slot_count = wanted;
    for (size_t i = 0; i < weld->count; i++)
        enter(weld, (uint32_t)i);
    return KTG_OK;
}

/* The first point met of those in reach, or KTG_NONE. */
static uint32_t find(const ktg_weld *weld, ktg_vec2 point) {
    int64_t x = cell_of(weld, point.x), y = cell_of(weld, point.y);
    uint32_t found = KTG_NONE;
    for (int k = 0; k < 9; k++) {
        size_t at = hash_cell(x + k % 3 - 1, y + k / 3 - 1) & (weld->slot_count - 1);
        for (; weld->slots[at]; at = (at + 1) & (weld->slot_count - 1)) {
            uint32_t index = weld->slots[at] - 1;
            if (index < found &&
                ktg_length2(ktg_sub2(weld->points[index], point)) <= weld->tolerance)
                found = index;
        }
    }
    return found;
}

ktg_status ktg_weld_point(ktg_weld *weld, ktg_vec2 point, uint32_t *index) {
    if (2 * (weld->count + 1) > weld->slot_count)
        KTG_TRY(grow(weld));
    *index = find(weld, point);
    if (*index != KTG_NONE)
        return KTG_OK;
    KTG_TRY(ktg_reserve(weld->context, &weld->points, &weld->capacity, weld->count + 1));
    *index = (uint32_t)weld->count;
    weld->points[weld->count++] = point;
    enter(weld, *index);
    return KTG_OK;
}

void ktg_weld_drop(ktg_weld *weld) {
    ktg_free(weld->points);
    ktg_free(weld->slots);
    *weld = (ktg_weld){0};
}
