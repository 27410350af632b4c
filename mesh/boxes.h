/* mesh/boxes.h - a tree of bounding boxes over items that may shrink, grow and go (mesh only). */
#ifndef KTG_MESH_BOXES_H
#define KTG_MESH_BOXES_H

#include "mesh/mesh.h"

typedef struct ktg_box {
    ktg_vec3 low, high;
} ktg_box;

typedef struct ktg_boxes ktg_boxes;

/* The smallest box around two. */
static inline ktg_box ktg_box_join(ktg_box a, ktg_box b) {
    a.low.x = a.low.x < b.low.x ? a.low.x : b.low.x;
    a.low.y = a.low.y < b.low.y ? a.low.y : b.low.y;
    a.low.z = a.low.z < b.low.z ? a.low.z : b.low.z;
    a.high.x = a.high.x > b.high.x ? a.high.x : b.high.x;
    a.high.y = a.high.y > b.high.y ? a.high.y : b.high.y;
    a.high.z = a.high.z > b.high.z ? a.high.z : b.high.z;
    return a;
}

/* The box of three points. */
static inline ktg_box ktg_box_of(ktg_vec3 a, ktg_vec3 b, ktg_vec3 c) {
    return ktg_box_join(ktg_box_join((ktg_box){a, a}, (ktg_box){b, b}), (ktg_box){c, c});
}

/* Touching counts. */
static inline bool ktg_box_meets(ktg_box a, ktg_box b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/* A tree over `count` items; items[i] is the number that a query gives for box i (NULL: i itself).
 * Item numbers are below `item_limit`, each given once. */
KTG_NODISCARD ktg_status ktg_boxes_new(ktg_context *context, const ktg_box *boxes,
                                       const uint32_t *items, uint32_t count, uint32_t item_limit,
                                       ktg_boxes **tree);
void ktg_boxes_free(ktg_boxes **tree);

/* An item's box changes. */
void ktg_boxes_set(ktg_boxes *tree, uint32_t item, ktg_box box);
/* An item goes. */
void ktg_boxes_remove(ktg_boxes *tree, uint32_t item);

/* The items whose boxes meet `box`, `most` at most, in *found (grown as needed, *capacity its size,
 * the caller frees it). */
KTG_NODISCARD ktg_status ktg_boxes_query(ktg_context *context, const ktg_boxes *tree, ktg_box box,
                                         size_t most, uint32_t **found, size_t *capacity,
                                         size_t *count);

#endif
