/* mesh/edge_index.h - half-edges found by their two vertices (mesh only). */
#ifndef KTG_MESH_EDGE_INDEX_H
#define KTG_MESH_EDGE_INDEX_H

#include "mesh/mesh.h"

typedef struct ktg_edge_entry {
    uint64_t ends; /* the two vertices, the lower one in the upper half */
    uint32_t halfedge;
} ktg_edge_entry;

/* All half-edges, sorted by ends, then by number. */
typedef struct ktg_edge_index {
    ktg_edge_entry *entries;
    size_t count;
} ktg_edge_index;

/* Over 3 face_count corners; with `rename` vertex v counts as rename[v]. Half-edges at a corner
 * KTG_NONE are left out. */
KTG_NODISCARD ktg_status ktg_edge_index_new(ktg_context *context, const uint32_t *corners,
                                            uint32_t face_count, const uint32_t *rename,
                                            ktg_edge_index *index);
void ktg_edge_index_free(ktg_edge_index *index);

/* How many half-edges lie between a and b, either way round; *first is the first one's entry. */
size_t ktg_edge_index_find(const ktg_edge_index *index, uint32_t a, uint32_t b,
                           const ktg_edge_entry **first);

#endif
