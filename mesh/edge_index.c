/* mesh/edge_index.c - half-edges found by their two vertices: a sorted list. */
#include "mesh/edge_index.h"
#include "core/memory.h"

#include <stdlib.h>

static uint64_t ends_of(uint32_t a, uint32_t b) {
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare(const void *a, const void *b) {
    const ktg_edge_entry *x = a, *y = b;
    if (x->ends != y->ends)
        return x->ends < y->ends ? -1 : 1;
    return (x->halfedge > y->halfedge) - (x->halfedge < y->halfedge);
}

ktg_status ktg_edge_index_new(ktg_context *context, const uint32_t *corners, uint32_t face_count,
                              const uint32_t *rename, ktg_edge_index *index) {
    *index = (ktg_edge_index){.entries = ktg_new(context, 3 * (size_t)face_count, ktg_edge_entry)};
    if (!index->entries)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < 3 * face_count; h++) {
        uint32_t a = corners[h], b = corners[h % 3 == 2 ? h - 2 : h + 1];
        if (a == KTG_NONE || b == KTG_NONE)
            continue;
        index->entries[index->count++] =
            (ktg_edge_entry){rename ? ends_of(rename[a], rename[b]) : ends_of(a, b), h};
    }
    qsort(index->entries, index->count, sizeof *index->entries, compare);
    return KTG_OK;
}

void ktg_edge_index_free(ktg_edge_index *index) {
    ktg_free(index->entries);
    *index = (ktg_edge_index){0};
}

/* The place of the first entry whose ends are not below `ends`. */
static size_t lower_bound(const ktg_edge_index *index, uint64_t ends) {
    size_t low = 0, high = index->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (index->entries[middle].ends < ends)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

size_t ktg_edge_index_find(const ktg_edge_index *index, uint32_t a, uint32_t b,
                           const ktg_edge_entry **first) {
    uint64_t ends = ends_of(a, b);
    size_t at = lower_bound(index, ends), count = 0;
    *first = index->entries + at;
    while (at + count < index->count && index->entries[at + count].ends == ends)
        count++;
    return count;
}
