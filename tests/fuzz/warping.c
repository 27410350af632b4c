/* tests/fuzz/warping.c - what must hold of a file of handles. */
#include "tests/fuzz/warping.h"

#include <math.h>
#include <string.h>

void fuzz_warping(ktg_context *context, const ktg_mesh *model, const char *handles,
                  const ktg_warp_options *options) {
    ktg_mesh *mesh;
    ktg_warp_report report;
    fuzz_must(context, ktg_mesh_copy(context, model, &mesh));
    if (fuzz_succeeded(context, ktg_warp(context, mesh, handles, options, &report))) {
        fuzz_check_mesh(mesh);
        fuzz_expect(isfinite(report.shape.energy) && isfinite(report.shape.stretch_most) &&
                        isfinite(report.shape.handle_error),
                    "a figure of the warp is not finite");
        fuzz_expect(report.shape.folded_faces <= report.shape.faces && report.handles > 0,
                    "the figures of a warp contradict each other");
    } else {
        fuzz_expect(memcmp(mesh->positions, model->positions,
                           mesh->vertex_count * sizeof *mesh->positions) == 0,
                    "a warp that failed moved something");
    }
    ktg_mesh_free(&mesh);
}
