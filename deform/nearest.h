/* deform/nearest.h - the nearest of many vertices, edges and faces (deform only). */
#ifndef KTG_DEFORM_NEAREST_H
#define KTG_DEFORM_NEAREST_H

#include "core/core.h"

/* A vertex, an edge or a face: KTG_NONE stands behind its last vertex. */
typedef struct ktg_near_item {
    uint32_t vertices[3];
    uint32_t part; /* what it belongs to */
} ktg_near_item;

typedef struct ktg_near_hit {
    uint32_t item;
    double weights[3]; /* of its vertices: the nearest point; they add up to 1 */
    double distance;
} ktg_near_hit;

/* A tree of boxes. */
typedef struct ktg_near ktg_near;

/* Positions and items are borrowed. */
KTG_NODISCARD ktg_status ktg_near_new(ktg_context *context, const ktg_vec3 *positions,
                                      const ktg_near_item *items, uint32_t count, ktg_near **tree);
void ktg_near_free(ktg_near **tree);

/* The nearest item to a vertex's position that is not further than `most`, has not that vertex and
 * is not of the part `skip` (KTG_NONE: of any) unless it touches it; the first of several as near.
 * False: there is none. */
bool ktg_near_find(const ktg_near *tree, uint32_t vertex, double most, uint32_t skip,
                   ktg_near_hit *hit);

#endif
