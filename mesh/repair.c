/* mesh/repair.c - makes an oriented manifold of any faces, step by step on a copy. */
#include "mesh/repair.h"
#include "core/memory.h"

#include <string.h>

static bool same_mesh(const ktg_mesh *a, const ktg_mesh *b) {
    return a->vertex_count == b->vertex_count && a->face_count == b->face_count &&
           memcmp(a->faces, b->faces, 3 * (size_t)a->face_count * sizeof *a->faces) == 0 &&
           memcmp(a->positions, b->positions, a->vertex_count * sizeof *a->positions) == 0;
}

/* Where a seam is opened, a side that was left over at the same edge may find a partner after all;
 * where an edge is cut in the middle, the new vertex may meet another. So often this is tried. */
enum { MOST_ROUNDS = 8 };

static ktg_status run_once(ktg_repair *repair) {
    KTG_TRY(ktg_repair_clean(repair));
    KTG_TRY(ktg_repair_join(repair));
    KTG_TRY(ktg_repair_orient(repair));
    return ktg_repair_fans(repair);
}

static ktg_status run(ktg_repair *repair) {
    repair->unsettled = true;
    for (int round = 0; repair->unsettled && round < MOST_ROUNDS; round++) {
        repair->unsettled = false;
        KTG_TRY(run_once(repair));
    }
    return KTG_OK;
}

ktg_status ktg_mesh_repair(ktg_context *context, ktg_mesh *mesh, ktg_repair_report *report) {
    ktg_repair repair = {.context = context};
    ktg_status status = ktg_mesh_copy(context, mesh, &repair.mesh);
    if (status == KTG_OK)
        status = run(&repair);
    if (status == KTG_OK) {
        repair.report.changed = !same_mesh(mesh, repair.mesh);
        if (repair.report.changed) {
            ktg_mesh before = *mesh;
            *mesh = *repair.mesh;
            *repair.mesh = before;
        }
    }
    if (report)
        *report = repair.report;
    ktg_mesh_free(&repair.mesh);
    ktg_free(repair.weld);
    ktg_free(repair.mate);
    return status;
}
