/* core/sets.h - disjoint sets of numbers (shared between folders, not installed). The smallest
 * number stands for its set. */
#ifndef KTG_CORE_SETS_H
#define KTG_CORE_SETS_H

#include <stdint.h>

static inline uint32_t ktg_set_of(uint32_t *parent, uint32_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static inline void ktg_set_join(uint32_t *parent, uint32_t a, uint32_t b) {
    a = ktg_set_of(parent, a);
    b = ktg_set_of(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

#endif
