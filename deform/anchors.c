/* deform/anchors.c - is every part held? One that hangs on nothing fixed and no handle, not even by
 * links, has no place: the system would be singular, and the part would fly anywhere. */
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

#include <stdio.h>

static void join_all(const ktg_frame *frame, const ktg_bodies *bodies, uint32_t *parent) {
    const ktg_mesh *mesh = frame->mesh;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        parent[v] = v;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        ktg_set_join(parent, v, ktg_set_of(bodies->parent, v));
    for (size_t h = 0; h < 3 * (size_t)mesh->face_count; h++)
        ktg_set_join(parent, mesh->faces[h], mesh->faces[h % 3 == 2 ? h - 2 : h + 1]);
    for (uint32_t i = 0; i < bodies->follower_count; i++)
        for (int k = 0; k < 3 && bodies->followers[i].masters[k] != KTG_NONE; k++)
            ktg_set_join(parent, bodies->followers[i].vertex, bodies->followers[i].masters[k]);
}

/* held[root]: something in the set is fixed or a handle. */
static void mark_held(const ktg_bodies *bodies, uint32_t *parent, bool *held) {
    for (uint32_t v = 0; v < bodies->vertex_count; v++)
        if (bodies->hold[ktg_set_of(bodies->parent, v)] != KTG_NONE)
            held[ktg_set_of(parent, v)] = true;
}

/* How large a part is, in the model's unit. */
static ktg_vec3 extent_of(const ktg_frame *frame, uint32_t part) {
    ktg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < frame->mesh->vertex_count; v++) {
        ktg_vec3 p = frame->rest[v];
        if (frame->component[v] != part)
            continue;
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    return (ktg_vec3){ldexp(high.x - low.x, frame->exponent),
                      ldexp(high.y - low.y, frame->exponent),
                      ldexp(high.z - low.z, frame->exponent)};
}

static ktg_status name_part(ktg_context *context, const ktg_frame *frame, uint32_t part,
                            uint32_t others) {
    ktg_names names;
    char more[64] = "";
    uint32_t faces = 0;
    KTG_TRY(ktg_name_parts(context, frame->mesh, frame->component, frame->component_count, &names));
    for (size_t f = 0; f < frame->mesh->face_count; f++)
        faces += frame->component[frame->mesh->faces[3 * f]] == part;
    ktg_vec3 size = extent_of(frame, part);
    if (others > 0)
        snprintf(more, sizeof more, ", and %u more component%s,", others, others == 1 ? "" : "s");
    ktg_status status = ktg_edit_fail(
        context, frame->edit->file, 0,
        "component \"%.100s\" (%u face%s, %.4g x %.4g x %.4g)%s is held by nothing: make a part of "
        "it fixed or a handle, or link it to what is held",
        names.text[part], faces, faces == 1 ? "" : "s", size.x, size.y, size.z, more);
    ktg_names_free(&names);
    return status;
}

static ktg_status check(ktg_context *context, const ktg_frame *frame, uint32_t *parent,
                        const bool *held, bool *seen) {
    uint32_t first = KTG_NONE, loose = 0;
    for (uint32_t v = 0; v < frame->mesh->vertex_count; v++) {
        uint32_t part = frame->component[v];
        if (part == KTG_NONE || held[ktg_set_of(parent, v)] || seen[part])
            continue;
        seen[part] = true;
        loose++;
        if (first == KTG_NONE)
            first = part;
    }
    return loose > 0 ? name_part(context, frame, first, loose - 1) : KTG_OK;
}

ktg_status ktg_anchors_check(ktg_context *context, const ktg_frame *frame,
                             const ktg_bodies *bodies) {
    uint32_t *parent = ktg_new(context, bodies->vertex_count, uint32_t);
    bool *held = ktg_new(context, bodies->vertex_count, bool);
    bool *seen = ktg_new(context, frame->component_count, bool);
    ktg_status status = parent && held && seen ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        join_all(frame, bodies, parent);
        mark_held(bodies, parent, held);
        status = check(context, frame, parent, held, seen);
    }
    ktg_free(parent);
    ktg_free(held);
    ktg_free(seen);
    return status;
}
