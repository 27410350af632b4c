/* pattern/build_groups.c - numbers under keys. */
#include "pattern/build_order.h"

#include "core/memory.h"

ktg_status ktg_groups_fill(ktg_context *context, const uint32_t *keys, uint32_t item_count,
                           uint32_t key_count, ktg_groups *groups) {
    groups->first = ktg_new(context, (size_t)key_count + 2, uint32_t);
    groups->items = ktg_new(context, item_count, uint32_t);
    if (!groups->first || !groups->items)
        return KTG_MEMORY;
    uint32_t *next = groups->first + 1;
    for (uint32_t i = 0; i < item_count; i++)
        if (keys[i] != KTG_NONE)
            next[keys[i] + 1]++;
    for (uint32_t k = 0; k < key_count; k++)
        next[k + 1] += next[k];
    for (uint32_t i = 0; i < item_count; i++) /* next[k] ends as the first of k + 1 */
        if (keys[i] != KTG_NONE)
            groups->items[next[keys[i]]++] = i;
    return KTG_OK;
}

void ktg_groups_drop(ktg_groups *groups) {
    ktg_free(groups->first);
    ktg_free(groups->items);
    *groups = (ktg_groups){NULL, NULL};
}
