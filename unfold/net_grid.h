/* unfold/net_grid.h - finding the faces near a box, whatever their sizes (unfold only).
 *
 * A hashed grid with a few levels, each with cells twice, four times, ... as large as those of the
 * one below: a face lies in one cell, of a level whose cells are at least as large as the face,
 * found by the centre of its box. So moving a face costs the same wherever it goes. */
#ifndef KTG_UNFOLD_NET_GRID_H
#define KTG_UNFOLD_NET_GRID_H

#include "core/core.h"

/* Some faces of one cell and their boxes. A box is four numbers of 15 bits in one word, in parts of
 * the cell, so that one subtraction tells whether two boxes meet. */
#define KTG_NET_BLOCK 12
typedef struct ktg_net_block {
    uint64_t boxes[KTG_NET_BLOCK];
    uint32_t faces[KTG_NET_BLOCK];
    uint64_t cell; /* level, column and row */
    uint32_t next; /* block of the same bucket, of this cell or another; KTG_NONE at the end */
    uint32_t count;
} ktg_net_block;

typedef struct ktg_net_grid {
    uint32_t face_count;
    size_t mask;           /* buckets - 1 */
    uint32_t *head;        /* mask + 1: first block of each bucket, KTG_NONE: none */
    ktg_net_block *blocks; /* face_count; those in no bucket are chained through next */
    uint32_t free_block;
    uint32_t *block_of; /* face_count: KTG_NONE when not in the grid */
    uint8_t *level;     /* face_count: fixed by the face's size */
    int lowest;         /* exponent of level 0: its cells are 2^lowest large */
    int level_count;
    double *cells_per_unit; /* level_count: 1 / the size of a cell */
    uint32_t *level_first;  /* level_count + 1: where a level begins in by_level */
    uint32_t *by_level;     /* face_count: all faces, level by level */
} ktg_net_grid;

/* sizes: face_count, an upper bound of each face's diameter (> 0 or 0). */
KTG_NODISCARD ktg_status ktg_net_grid_new(ktg_context *context, const double *sizes,
                                          uint32_t face_count, ktg_net_grid *grid);
void ktg_net_grid_free(ktg_net_grid *grid);

/* Puts a face where its corners are; it may be in the grid already. All faces must be in it before
 * a walk. */
void ktg_net_grid_put_face(ktg_net_grid *grid, uint32_t face, const ktg_vec2 corners[3]);
/* The same where only the centre of its box is known; walks then do not look at its box. */
void ktg_net_grid_put(ktg_net_grid *grid, uint32_t face, ktg_vec2 centre);

typedef struct ktg_net_box {
    ktg_vec2 low, high;
} ktg_net_box;

ktg_net_box ktg_net_box_of(const ktg_vec2 corners[3]);

/* The cells of one level that a box's neighbours may lie in. */
typedef struct ktg_net_range {
    int32_t x0, y0, x1, y1;
} ktg_net_range;

/* A box in parts of a level's cells. */
typedef struct ktg_net_parts {
    int64_t x0, y0, x1, y1;
} ktg_net_parts;

/* Walks the faces near a triangle's box: all whose boxes meet it, and few others. */
typedef struct ktg_net_walk {
    const ktg_net_grid *grid;
    ktg_net_box box;
    ktg_net_parts parts; /* of the present level */
    ktg_net_range range;
    int level;
    int32_t x, y;
    uint64_t cell, meets;        /* the present cell, and the box as a word for it */
    uint32_t listed, listed_end; /* in by_level: a level whose faces are fewer than the cells is
                                    walked as a list */
    uint32_t block, slot;        /* in the present bucket */
} ktg_net_walk;

/* False when the grid is empty. */
bool ktg_net_walk_start(ktg_net_walk *walk, const ktg_net_grid *grid, const ktg_vec2 corners[3]);
/* The next face, KTG_NONE at the end. */
uint32_t ktg_net_walk_next(ktg_net_walk *walk);

#endif
