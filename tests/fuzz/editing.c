/* tests/fuzz/editing.c - what must hold of an edit file. */
#include "tests/fuzz/editing.h"
#include "deform/deform.h"

#include <math.h>
#include <string.h>

static void write_sets(ktg_context *context, const ktg_edit *edit, const ktg_mesh *model) {
    ktg_output *output;
    fuzz_must(context, ktg_output_open(context, fuzz_path("/sets.obj"), &output));
    fuzz_must(context, ktg_edit_write_sets(context, edit, model, output));
    fuzz_must(context, ktg_output_commit(context, &output));
}

void fuzz_editing(ktg_context *context, const ktg_mesh *model, const char *edit_path) {
    ktg_edit *edit;
    ktg_mesh *mesh;
    ktg_deform_report report;
    if (!fuzz_succeeded(context, ktg_edit_read(context, edit_path, model, &edit))) {
        fuzz_expect(!edit, "an edit comes with a failure");
        return;
    }
    write_sets(context, edit, model);
    fuzz_must(context, ktg_mesh_copy(context, model, &mesh));
    if (fuzz_succeeded(context, ktg_deform_mesh(context, mesh, edit, &report))) {
        fuzz_check_mesh(mesh);
        fuzz_expect(isfinite(report.stretch_max) && isfinite(report.feature_error) &&
                        isfinite(report.link_error) && isfinite(report.moved),
                    "a figure of the deformation is not finite");
    } else {
        fuzz_expect(memcmp(mesh->positions, model->positions,
                           mesh->vertex_count * sizeof *mesh->positions) == 0,
                    "a deformation that failed moved something");
    }
    ktg_mesh_free(&mesh);
    ktg_edit_free(&edit);
}
