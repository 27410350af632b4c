/* tests/unfold/help.h - the dual of a whole mesh of one component. */
#ifndef KTG_TESTS_UNFOLD_HELP_H
#define KTG_TESTS_UNFOLD_HELP_H

#include "core/memory.h"
#include "tests/unfold/shapes.h"
#include "unfold/dual.h"

static inline ktg_dual *scaled_dual_of(ktg_context *context, const ktg_mesh *mesh, double scale) {
    ktg_adjacency *adjacency;
    ktg_dual *dual;
    uint32_t *faces = ktg_new(context, mesh->face_count, uint32_t);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        faces[f] = f;
    assert_int_equal(ktg_adjacency_new(context, mesh, &adjacency), KTG_OK);
    assert_int_equal(ktg_dual_new(context, mesh, adjacency, faces, mesh->face_count, scale, &dual),
                     KTG_OK);
    ktg_free(faces);
    ktg_adjacency_free(&adjacency);
    return dual;
}

static inline ktg_dual *dual_of(ktg_context *context, const ktg_mesh *mesh) {
    return scaled_dual_of(context, mesh, 1);
}

#endif
