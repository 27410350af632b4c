/* unfold/parts.c - what hangs together through edges that may be joined: a component, or what
 * forced cuts leave of it. */
#include "core/memory.h"
#include "unfold/rules.h"

/* Numbers the parts component by component: first[p] becomes the new number of part p. */
static void order_parts(const uint32_t *of_part, uint32_t count, uint32_t component_count,
                        uint32_t *next, uint32_t *renamed) {
    for (uint32_t p = 0; p < count; p++)
        next[of_part[p] + 1]++;
    for (uint32_t c = 1; c <= component_count; c++)
        next[c] += next[c - 1];
    for (uint32_t p = 0; p < count; p++)
        renamed[p] = next[of_part[p]]++;
}

/* Sorts the faces by part, keeping their order within one. */
static void group_faces(const uint32_t *face_part, uint32_t face_count, ktg_parts *parts) {
    uint32_t *next = parts->first + 1;
    for (uint32_t f = 0; f < face_count; f++)
        if (face_part[f] + 1 < parts->count)
            next[face_part[f] + 1]++;
    for (uint32_t p = 1; p < parts->count; p++)
        next[p] += next[p - 1];
    for (uint32_t f = 0; f < face_count; f++)
        parts->faces[next[face_part[f]]++] = f;
}

static ktg_status fill(ktg_context *context, uint32_t *face_part, uint32_t face_count,
                       const uint32_t *face_component, uint32_t component_count, ktg_parts *parts) {
    uint32_t *of_part = ktg_new(context, parts->count, uint32_t);
    uint32_t *renamed = ktg_new(context, parts->count, uint32_t);
    uint32_t *next = ktg_new(context, (size_t)component_count + 1, uint32_t);
    ktg_status status = of_part && renamed && next ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t f = 0; f < face_count; f++)
            of_part[face_part[f]] = face_component[f];
        order_parts(of_part, parts->count, component_count, next, renamed);
        for (uint32_t p = 0; p < parts->count; p++)
            parts->component[renamed[p]] = of_part[p];
        for (uint32_t f = 0; f < face_count; f++)
            face_part[f] = renamed[face_part[f]];
        group_faces(face_part, face_count, parts);
    }
    ktg_free(of_part);
    ktg_free(renamed);
    ktg_free(next);
    return status;
}

ktg_status ktg_parts_new(ktg_context *context, const ktg_mesh *mesh, const ktg_rules *rules,
                         const uint32_t *face_component, uint32_t component_count,
                         ktg_parts *parts) {
    uint32_t *face_part = NULL;
    *parts = (ktg_parts){0};
    KTG_TRY(ktg_mesh_components(context, mesh, &rules->adjacency, &face_part, &parts->count));
    parts->component = ktg_new(context, parts->count, uint32_t);
    parts->first = ktg_new(context, (size_t)parts->count + 2, uint32_t);
    parts->faces = ktg_new(context, mesh->face_count, uint32_t);
    ktg_status status = KTG_MEMORY;
    if (parts->component && parts->first && parts->faces)
        status = fill(context, face_part, mesh->face_count, face_component, component_count, parts);
    ktg_free(face_part);
    return status;
}

void ktg_parts_free(ktg_parts *parts) {
    ktg_free(parts->component);
    ktg_free(parts->first);
    ktg_free(parts->faces);
    *parts = (ktg_parts){0};
}
