/* cli/command_simplify.c - katagami simplify: a model with fewer faces. */
#include "cli/cli.h"
#include "core/target.h"

static const char usage[] = "usage: katagami simplify MODEL [--faces N] -o FILE\n\n"
                            "Repairs a model, simplifies it by quadric error to N faces (500) and "
                            "writes it as\n.obj, .stl, .ply or .off.\n\n";

static ktg_status check_output(ktg_context *context, const settings *s) {
    if (s->output_count != 1 || ktg_mesh_format_of(s->outputs[0]) == KTG_MESH_BY_ENDING)
        return ktg_fail(context, KTG_ARGUMENT,
                        "simplify wants one -o FILE that ends in .obj, .stl, .ply or .off");
    if (ktg_target_same(s->arguments[0], s->outputs[0])) /* not replaced by a poorer one */
        return ktg_fail(context, KTG_ARGUMENT, "%s: is the model itself; name another output",
                        s->outputs[0]);
    return ktg_output_check(context, s->outputs[0]);
}

static ktg_status run(ktg_context *context, settings *s) {
    ktg_mesh *mesh = NULL;
    ktg_output *output = NULL;
    ktg_repair_report repair;
    ktg_simplify_report simplify = {0};
    ktg_status status = check_output(context, s);
    if (status == KTG_OK)
        status = ktg_mesh_read(context, s->arguments[0], KTG_MESH_BY_ENDING, &mesh);
    if (status == KTG_OK)
        status = ktg_about_file(context, s->arguments[0], ktg_mesh_repair(context, mesh, &repair));
    if (status == KTG_OK && s->pipeline.faces != KTG_ALL_FACES)
        status = ktg_about_file(context, s->arguments[0],
                                ktg_mesh_simplify(context, mesh, s->pipeline.faces, &simplify));
    if (status == KTG_OK)
        status = ktg_output_open(context, s->outputs[0], &output);
    if (status == KTG_OK)
        status = ktg_mesh_write(context, mesh, ktg_mesh_format_of(s->outputs[0]), output);
    if (status == KTG_OK)
        status = ktg_output_commit(context, &output);
    cli_end_progress();
    if (status == KTG_OK && !s->quiet) {
        fprintf(stderr, "%u faces; wrote ", mesh->face_count);
        cli_print_safe(stderr, s->outputs[0]);
        fputc('\n', stderr);
        if (s->pipeline.faces != KTG_ALL_FACES && !simplify.target_reached)
            fprintf(stderr,
                    "warning: fewer faces would change the model's topology or fold it over%s\n",
                    mesh->marked_count > 0 ? ", or an edge that is marked (l)" : "");
        if (simplify.faces_without_uv > 0)
            fprintf(
                stderr,
                "warning: %u face%s over a seam of the texture and lost %s texture coordinates\n",
                simplify.faces_without_uv, simplify.faces_without_uv == 1 ? " lies" : "s lie",
                simplify.faces_without_uv == 1 ? "its" : "their");
    }
    ktg_output_discard(&output);
    ktg_mesh_free(&mesh);
    return status;
}

exit_code command_simplify(int argc, char **argv) {
    return cli_run(argc, argv, CMD_SIMPLIFY, 1, usage, run);
}
