/* unfold/patches.h - rigid patches of flat faces that are joined one by one (section 5; unfold
 * only).
 *
 * A patch lies in a frame of its own. Joining moves the patch with fewer faces to the other one
 * along their common edge, unless faces would overlap. A state can be copied over another one, so
 * that many orders of joining start from the same strips. */
#ifndef KTG_UNFOLD_PATCHES_H
#define KTG_UNFOLD_PATCHES_H

#include "unfold/cut_table.h"
#include "unfold/dual.h"
#include "unfold/overlap.h"

typedef struct ktg_patch {
    uint32_t first, count, capacity; /* its slots */
    ktg_flat_box box;
} ktg_patch;

typedef struct ktg_patches {
    const ktg_dual *dual;
    uint32_t patch_count; /* alive: those with faces */
    uint32_t largest;     /* faces in the largest patch */
    ktg_patch *patches;   /* face_count; patch number = a face's first number */
    uint32_t *face_patch; /* face_count */
    uint32_t *face_slot;  /* face_count */
    size_t slot_count;    /* used so far; a patch that outgrows its slots moves to new ones */
    size_t face_slots, corner_slots, box_slots; /* capacities of the three arrays */
    uint32_t *slot_face;
    ktg_vec2 *slot_corners; /* three a slot */
    ktg_flat_box *slot_box;
    ktg_cut_table table;
    ktg_vec2 *moved;         /* scratch: the moved patch's corners, 3 face_count */
    ktg_flat_box *moved_box; /* scratch: face_count */
    uint32_t *near;          /* scratch: face_count slots of the standing patch */
} ktg_patches;

typedef enum ktg_join { KTG_JOINED, KTG_SAME_PATCH, KTG_NOT_MERGEABLE, KTG_OVERLAPS } ktg_join;

/* Every face a patch of its own; the cut table counts every dual edge as cut. */
KTG_NODISCARD ktg_status ktg_patches_new(ktg_context *context, const ktg_dual *dual,
                                         ktg_patches **patches);
void ktg_patches_free(ktg_patches **patches);

/* *to becomes what *from is; both of the same dual. */
KTG_NODISCARD ktg_status ktg_patches_assign(ktg_context *context, ktg_patches *to,
                                            const ktg_patches *from);

/* Tries to join the two sides of a dual edge. KTG_MEMORY only. */
KTG_NODISCARD ktg_status ktg_patches_join(ktg_context *context, ktg_patches *patches, uint32_t edge,
                                          ktg_join *result);

#endif
