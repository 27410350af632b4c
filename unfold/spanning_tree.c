/* unfold/spanning_tree.c - the minimum spanning tree of the dual graph (section 4.1 of the paper),
 * by Kruskal's algorithm. */
#include "core/memory.h"
#include "unfold/dual.h"

#include <math.h>
#include <stdlib.h>

typedef struct weighted_edge {
    double weight;
    uint32_t edge;
} weighted_edge;

static int compare_weights(const void *a, const void *b) {
    const weighted_edge *x = a, *y = b;
    if (x->weight != y->weight)
        return x->weight < y->weight ? -1 : 1;
    return (x->edge > y->edge) - (x->edge < y->edge);
}

static uint32_t root_of(uint32_t *parent, uint32_t face) {
    while (parent[face] != face) {
        parent[face] = parent[parent[face]];
        face = parent[face];
    }
    return face;
}

/* w(e) = (l_max - l) / (l_max - l_min); rigid edges weigh less than any other. */
static void weigh(const ktg_dual *dual, double jitter, ktg_random *random, weighted_edge *order) {
    double least = INFINITY, most = 0;
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        double length = dual->edges[e].length;
        least = length < least ? length : least;
        most = length > most ? length : most;
    }
    double range = most > least ? most - least : 1;
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        const ktg_dual_edge *edge = &dual->edges[e];
        order[e].edge = e;
        order[e].weight = edge->rigid ? -1 : (most - edge->length) / range;
        if (jitter > 0 && !edge->rigid)
            order[e].weight += jitter * ktg_random_unit(random);
    }
}

ktg_status ktg_dual_spanning_tree(ktg_context *context, const ktg_dual *dual, double jitter,
                                  ktg_random *random, bool *in_tree) {
    weighted_edge *order = ktg_new(context, dual->edge_count, weighted_edge);
    uint32_t *parent = ktg_new(context, dual->face_count, uint32_t);
    ktg_status status = order && parent ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t f = 0; f < dual->face_count; f++)
            parent[f] = f;
        weigh(dual, jitter, random, order);
        qsort(order, dual->edge_count, sizeof *order, compare_weights);
        for (uint32_t i = 0; i < dual->edge_count; i++) {
            const ktg_dual_edge *edge = &dual->edges[order[i].edge];
            uint32_t a = root_of(parent, edge->halfedge[0] / 3);
            uint32_t b = root_of(parent, edge->halfedge[1] / 3);
            in_tree[order[i].edge] = a != b;
            parent[a] = b;
        }
    }
    ktg_free(order);
    ktg_free(parent);
    return status;
}
