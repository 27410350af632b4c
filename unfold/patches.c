/* unfold/patches.c - joining rigid patches along dual edges. */
#include "unfold/patches.h"
#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

void ktg_patches_free(ktg_patches **patches) {
    if (!patches || !*patches)
        return;
    ktg_patches *p = *patches;
    ktg_free(p->patches);
    ktg_free(p->face_patch);
    ktg_free(p->face_slot);
    ktg_free(p->slot_face);
    ktg_free(p->slot_corners);
    ktg_free(p->slot_box);
    ktg_cut_table_free(&p->table);
    ktg_free(p->moved);
    ktg_free(p->moved_box);
    ktg_free(p->near);
    ktg_free(p);
    *patches = NULL;
}

static ktg_status reserve_slots(ktg_context *context, ktg_patches *p, size_t count) {
    KTG_TRY(ktg_reserve(context, &p->slot_face, &p->face_slots, count));
    KTG_TRY(ktg_reserve(context, &p->slot_corners, &p->corner_slots, 3 * count));
    return ktg_reserve(context, &p->slot_box, &p->box_slots, count);
}

static ktg_status allocate(ktg_context *context, ktg_patches *p) {
    uint32_t n = p->dual->face_count;
    p->patches = ktg_new(context, n, ktg_patch);
    p->face_patch = ktg_new(context, n, uint32_t);
    p->face_slot = ktg_new(context, n, uint32_t);
    p->moved = ktg_new(context, 3 * (size_t)n, ktg_vec2);
    p->moved_box = ktg_new(context, n, ktg_flat_box);
    p->near = ktg_new(context, n, uint32_t);
    if (!p->patches || !p->face_patch || !p->face_slot || !p->moved || !p->moved_box || !p->near)
        return KTG_MEMORY;
    return reserve_slots(context, p, 4 * (size_t)n);
}

static void single_faces(ktg_patches *p) {
    uint32_t n = p->dual->face_count;
    for (uint32_t f = 0; f < n; f++) {
        memcpy(p->slot_corners + 3 * (size_t)f, p->dual->flat + 3 * (size_t)f,
               3 * sizeof(ktg_vec2));
        p->slot_face[f] = p->face_patch[f] = p->face_slot[f] = f;
        p->slot_box[f] = ktg_flat_box_of(p->slot_corners + 3 * (size_t)f);
        p->patches[f] = (ktg_patch){.first = f, .count = 1, .capacity = 1, .box = p->slot_box[f]};
    }
    p->patch_count = n;
    p->slot_count = n;
    p->largest = 1;
}

ktg_status ktg_patches_new(ktg_context *context, const ktg_dual *dual, ktg_patches **patches) {
    *patches = ktg_new(context, 1, ktg_patches);
    bool *joined = ktg_new(context, dual->edge_count, bool);
    ktg_status status = *patches && joined ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        (*patches)->dual = dual;
        status = allocate(context, *patches);
    }
    if (status == KTG_OK)
        status = ktg_cut_table_new(context, dual, joined, &(*patches)->table);
    if (status == KTG_OK)
        single_faces(*patches);
    else
        ktg_patches_free(patches);
    ktg_free(joined);
    return status;
}

ktg_status ktg_patches_assign(ktg_context *context, ktg_patches *to, const ktg_patches *from) {
    uint32_t n = from->dual->face_count;
    KTG_TRY(reserve_slots(context, to, from->slot_count));
    to->patch_count = from->patch_count;
    to->largest = from->largest;
    to->slot_count = from->slot_count;
    memcpy(to->patches, from->patches, n * sizeof *to->patches);
    memcpy(to->face_patch, from->face_patch, n * sizeof *to->face_patch);
    memcpy(to->face_slot, from->face_slot, n * sizeof *to->face_slot);
    memcpy(to->slot_face, from->slot_face, from->slot_count * sizeof *to->slot_face);
    memcpy(to->slot_corners, from->slot_corners, 3 * from->slot_count * sizeof *to->slot_corners);
    memcpy(to->slot_box, from->slot_box, from->slot_count * sizeof *to->slot_box);
    memcpy(to->table.sectors, from->table.sectors,
           from->table.vertex_count * sizeof *to->table.sectors);
    memcpy(to->table.needed, from->table.needed,
           from->table.vertex_count * sizeof *to->table.needed);
    return KTG_OK;
}

static void half_edge_ends(const ktg_patches *p, uint32_t halfedge, ktg_vec2 *from, ktg_vec2 *to) {
    const ktg_vec2 *corners = p->slot_corners + 3 * (size_t)p->face_slot[halfedge / 3];
    *from = corners[halfedge % 3];
    *to = corners[(halfedge % 3 + 1) % 3];
}

/* Moves `patch` so that its half-edge `own` comes to lie on `other` of the standing patch, into the
 * scratch arrays. */
static ktg_flat_box move_patch(ktg_patches *p, const ktg_patch *patch, uint32_t own,
                               uint32_t other) {
    ktg_vec2 a, b, A, B;
    half_edge_ends(p, own, &a, &b);
    half_edge_ends(p, other, &A, &B);
    ktg_motion2 motion = ktg_motion2_between(a, b, B, A);
    ktg_flat_box box = ktg_flat_box_empty();
    const ktg_vec2 *corners = p->slot_corners + 3 * (size_t)patch->first;
    for (uint32_t i = 0; i < patch->count; i++) {
        for (int k = 0; k < 3; k++)
            p->moved[3 * i + k] = ktg_move2(motion, corners[3 * i + k]);
        p->moved_box[i] = ktg_flat_box_of(p->moved + 3 * i);
        ktg_flat_box_add(&box, &p->moved_box[i]);
    }
    return box;
}

static bool overlaps(ktg_patches *p, const ktg_patch *standing, const ktg_patch *moving,
                     const ktg_flat_box *moved_box) {
    if (!ktg_flat_boxes_meet(&standing->box, moved_box))
        return false;
    uint32_t near_count = 0;
    for (uint32_t s = standing->first; s < standing->first + standing->count; s++) {
        p->near[near_count] = s;
        near_count += ktg_flat_boxes_meet(&p->slot_box[s], moved_box);
    }
    for (uint32_t i = 0; i < moving->count; i++) {
        if (!ktg_flat_boxes_meet(&p->moved_box[i], &standing->box))
            continue;
        const double *lengths = p->dual->lengths + 3 * (size_t)p->slot_face[moving->first + i];
        for (uint32_t j = 0; j < near_count; j++) {
            uint32_t s = p->near[j];
            if (ktg_flat_boxes_meet(&p->slot_box[s], &p->moved_box[i]) &&
                ktg_triangles_overlap(p->slot_corners + 3 * (size_t)s,
                                      p->dual->lengths + 3 * (size_t)p->slot_face[s],
                                      p->moved + 3 * (size_t)i, lengths, KTG_OVERLAP_DEPTH))
                return true;
        }
    }
    return false;
}

/* Gives the patch room for `more` faces: behind all others where it has none. */
static ktg_status make_room(ktg_context *context, ktg_patches *p, ktg_patch *patch, uint32_t more) {
    uint32_t needed = patch->count + more;
    if (needed <= patch->capacity)
        return KTG_OK;
    uint32_t capacity = 2 * needed, first = (uint32_t)p->slot_count;
    KTG_TRY(reserve_slots(context, p, p->slot_count + capacity));
    memcpy(p->slot_face + first, p->slot_face + patch->first, patch->count * sizeof(uint32_t));
    memcpy(p->slot_corners + 3 * (size_t)first, p->slot_corners + 3 * (size_t)patch->first,
           3 * (size_t)patch->count * sizeof(ktg_vec2));
    memcpy(p->slot_box + first, p->slot_box + patch->first, patch->count * sizeof(ktg_flat_box));
    for (uint32_t i = 0; i < patch->count; i++)
        p->face_slot[p->slot_face[first + i]] = first + i;
    p->slot_count += capacity;
    patch->first = first;
    patch->capacity = capacity;
    return KTG_OK;
}

/* Appends the moved faces to the standing patch. */
static ktg_status take_over(ktg_context *context, ktg_patches *p, uint32_t standing,
                            uint32_t moving, const ktg_flat_box *moved_box) {
    ktg_patch *to = &p->patches[standing], *from = &p->patches[moving];
    KTG_TRY(make_room(context, p, to, from->count));
    for (uint32_t i = 0; i < from->count; i++) {
        uint32_t slot = to->first + to->count + i, face = p->slot_face[from->first + i];
        p->slot_face[slot] = face;
        p->face_slot[face] = slot;
        p->face_patch[face] = standing;
        memcpy(p->slot_corners + 3 * (size_t)slot, p->moved + 3 * (size_t)i, 3 * sizeof(ktg_vec2));
        p->slot_box[slot] = p->moved_box[i];
    }
    to->count += from->count;
    ktg_flat_box_add(&to->box, moved_box);
    from->count = 0;
    p->patch_count--;
    p->largest = to->count > p->largest ? to->count : p->largest;
    return KTG_OK;
}

ktg_status ktg_patches_join(ktg_context *context, ktg_patches *p, uint32_t edge, ktg_join *result) {
    const ktg_dual_edge *e = &p->dual->edges[edge];
    uint32_t own = e->halfedge[0], other = e->halfedge[1];
    uint32_t moving = p->face_patch[own / 3], standing = p->face_patch[other / 3];
    *result = KTG_SAME_PATCH;
    if (moving == standing)
        return KTG_OK;
    *result = KTG_NOT_MERGEABLE;
    if (!ktg_cut_table_allows(&p->table, e))
        return KTG_OK;
    if (p->patches[moving].count > p->patches[standing].count) {
        uint32_t patch = moving, halfedge = own;
        moving = standing;
        standing = patch;
        own = other;
        other = halfedge;
    }
    ktg_flat_box box = move_patch(p, &p->patches[moving], own, other);
    *result = KTG_OVERLAPS;
    if (overlaps(p, &p->patches[standing], &p->patches[moving], &box))
        return KTG_OK;
    *result = KTG_JOINED;
    ktg_cut_table_join(&p->table, e);
    return take_over(context, p, standing, moving, &box);
}
