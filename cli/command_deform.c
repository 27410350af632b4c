/* cli/command_deform.c - katagami deform: a model changed as an edit file says. */
#include "cli/cli.h"
#include "core/memory.h"
#include "core/target.h"

#include <string.h>

static const char usage[] =
    "usage: katagami deform MODEL --edit FILE [-o FILE] [options]\n\n"
    "Moves, turns, bends and resizes parts of a model as an edit file says and writes it as .obj,\n"
    ".stl, .ply or .off; everything else follows smoothly, rigid parts keep their shape, linked\n"
    "parts their distance. What an edit file looks like is told in deform.md, in short:\n\n"
    "  [fixed body]                   # stays\n"
    "  set  = object body\n"
    "  [handle hand]                  # is moved\n"
    "  set  = group hand\n"
    "  turn = 0 0 1  40               # axis, degrees\n"
    "  about = 4 15 0\n\n";

/* What is written, all of it or nothing. */
typedef struct files {
    ktg_output *model, *sets, *preview, *report;
} files;

/* ---- what may be asked for ------------------------------------------------------------------ */

static ktg_status check_path(ktg_context *context, const settings *s, const char *path) {
    if (!path || strcmp(path, "-") == 0)
        return KTG_OK;
    if (ktg_target_same(path, s->arguments[0]))
        return ktg_fail(context, KTG_ARGUMENT, "%s: is the model itself; name another output",
                        path);
    if (ktg_target_same(path, s->pipeline.edit))
        return ktg_fail(context, KTG_ARGUMENT,
                        "%s: is the edit file to be read; name another output", path);
    return ktg_output_check(context, path);
}

static ktg_status check_apart(ktg_context *context, const char *const *paths, int count) {
    for (int i = 0; i < count; i++)
        for (int k = 0; k < i; k++)
            if (paths[i] && paths[k] && ktg_target_same(paths[i], paths[k]))
                return ktg_fail(context, KTG_ARGUMENT,
                                "%s: is to be written twice; name another output", paths[i]);
    return KTG_OK;
}

static ktg_status check(ktg_context *context, const settings *s) {
    const char *paths[] = {s->output_count > 0 ? s->outputs[0] : NULL, s->sets, s->preview,
                           s->pipeline.report};
    if (!s->pipeline.edit)
        return ktg_fail(context, KTG_ARGUMENT, "deform wants to know what to change: --edit FILE");
    if (strcmp(s->pipeline.edit, "-") == 0 && strcmp(s->arguments[0], "-") == 0)
        return ktg_fail(context, KTG_ARGUMENT,
                        "model and edit cannot both come from standard input");
    if (s->output_count > 1 || (!paths[0] && !s->sets && !s->preview && !s->pipeline.report) ||
        (paths[0] && ktg_mesh_format_of(paths[0]) == KTG_MESH_BY_ENDING))
        return ktg_fail(context, KTG_ARGUMENT,
                        "deform wants one -o FILE that ends in .obj, .stl, .ply or .off");
    if (s->sets && ktg_mesh_format_of(s->sets) != KTG_MESH_OBJ)
        return ktg_fail(context, KTG_ARGUMENT, "--sets wants a FILE.obj");
    for (int i = 0; i < 4; i++)
        KTG_TRY(check_path(context, s, paths[i]));
    return check_apart(context, paths, 4);
}

/* ---- writing -------------------------------------------------------------------------------- */

static ktg_status write_model(ktg_context *context, const settings *s, const ktg_mesh *mesh,
                              files *f) {
    if (s->output_count == 0)
        return KTG_OK;
    KTG_TRY(ktg_output_open(context, s->outputs[0], &f->model));
    KTG_TRY(ktg_mesh_write(context, mesh, ktg_mesh_format_of(s->outputs[0]), f->model));
    return ktg_output_finish(context, f->model);
}

static ktg_status write_sets(ktg_context *context, const settings *s, const ktg_edit *edit,
                             const ktg_mesh *mesh, files *f) {
    if (!s->sets)
        return KTG_OK;
    KTG_TRY(ktg_output_open(context, s->sets, &f->sets));
    KTG_TRY(ktg_edit_write_sets(context, edit, mesh, f->sets));
    return ktg_output_finish(context, f->sets);
}

static unsigned up_of(const settings *s) {
    if (s->pipeline.up != KTG_AXIS_AUTO)
        return (unsigned)(s->pipeline.up - KTG_AXIS_X);
    return ktg_mesh_format_of(s->arguments[0]) == KTG_MESH_STL ? 2 : 1;
}

static ktg_render_shape shape_of(const ktg_mesh *mesh, const uint32_t *tints) {
    return (ktg_render_shape){mesh->vertex_count, mesh->face_count, mesh->positions, mesh->faces,
                              tints};
}

/* Faces all of whose corners one section holds: blue fixed, orange handles, green rigid, violet
 * resized; of several the last one in the file. */
static void tint_hold(const ktg_hold *hold, const ktg_mesh *mesh, bool *held, uint32_t *tints) {
    static const uint32_t colours[] = {0x9dbbe3, 0xf2a65a, 0x9bd08f, 0xc9a3e0};
    memset(held, false, mesh->vertex_count * sizeof *held);
    for (uint32_t i = 0; i < hold->vertex_count; i++)
        held[hold->vertices[i]] = true;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->faces + 3 * f;
        if (held[c[0]] && held[c[1]] && held[c[2]])
            tints[f] = colours[hold->kind];
    }
}

static ktg_status draw(ktg_context *context, const settings *s, const ktg_edit *edit,
                       const ktg_mesh *before, const ktg_mesh *after, ktg_output *output) {
    uint32_t *tints = ktg_new(context, before->face_count, uint32_t);
    bool *held = ktg_new(context, before->vertex_count, bool);
    ktg_status status = tints && held ? KTG_OK : KTG_MEMORY;
    for (size_t f = 0; status == KTG_OK && f < before->face_count; f++)
        tints[f] = 0xffffff;
    for (size_t h = 0; status == KTG_OK && h < edit->hold_count; h++)
        tint_hold(&edit->holds[h], before, held, tints);
    if (status == KTG_OK) {
        const ktg_render_shape shapes[2] = {shape_of(before, tints), shape_of(after, tints)};
        status = ktg_render_shapes(context, shapes, 2, up_of(s), output);
    }
    ktg_free(tints);
    ktg_free(held);
    return status;
}

static ktg_status write_preview(ktg_context *context, const settings *s, const ktg_edit *edit,
                                const ktg_mesh *before, const ktg_mesh *after, files *f) {
    if (!s->preview)
        return KTG_OK;
    KTG_TRY(ktg_output_open(context, s->preview, &f->preview));
    KTG_TRY(draw(context, s, edit, before, after, f->preview));
    return ktg_output_finish(context, f->preview);
}

static ktg_status write_report(ktg_context *context, const settings *s,
                               const ktg_deform_report *report, files *f) {
    if (!s->pipeline.report)
        return KTG_OK;
    KTG_TRY(ktg_output_open(context, s->pipeline.report, &f->report));
    KTG_TRY(ktg_pipeline_write_deform(context, report, f->report));
    return ktg_output_finish(context, f->report);
}

static ktg_status commit(ktg_context *context, files *f) {
    ktg_output **outputs[] = {&f->model, &f->sets, &f->preview, &f->report};
    for (int i = 0; i < 4; i++)
        if (*outputs[i])
            KTG_TRY(ktg_output_commit(context, outputs[i]));
    return KTG_OK;
}

static void discard(files *f) {
    ktg_output_discard(&f->model);
    ktg_output_discard(&f->sets);
    ktg_output_discard(&f->preview);
    ktg_output_discard(&f->report);
}

static void tell(const settings *s) {
    const char *paths[] = {s->output_count > 0 ? s->outputs[0] : NULL, s->sets, s->preview,
                           s->pipeline.report};
    cli_end_progress();
    for (int i = 0; !s->quiet && i < 4; i++) {
        if (!paths[i])
            continue;
        fputs("wrote ", stderr);
        cli_print_safe(stderr, paths[i]);
        fputc('\n', stderr);
    }
}

/* ---- the whole ------------------------------------------------------------------------------ */

/* The selections are written first, so that one can look at them where the rest fails. */
static ktg_status change(ktg_context *context, const settings *s, const ktg_edit *edit,
                         const ktg_mesh *before, ktg_mesh *after, files *f) {
    ktg_deform_report report = {0};
    KTG_TRY(write_sets(context, s, edit, before, f));
    if (f->sets)
        KTG_TRY(ktg_output_commit(context, &f->sets));
    if (s->output_count == 0 && !s->preview && !s->pipeline.report)
        return KTG_OK;
    KTG_TRY(
        ktg_about_file(context, s->arguments[0], ktg_deform_mesh(context, after, edit, &report)));
    cli_end_progress();
    ktg_pipeline_tell_deform(context, &report);
    KTG_TRY(write_model(context, s, after, f));
    KTG_TRY(write_preview(context, s, edit, before, after, f));
    KTG_TRY(write_report(context, s, &report, f));
    return commit(context, f);
}

static ktg_status run(ktg_context *context, settings *s) {
    ktg_mesh *before = NULL, *after = NULL;
    ktg_edit *edit = NULL;
    files f = {NULL};
    ktg_status status = check(context, s);
    if (status == KTG_OK)
        status = ktg_mesh_read(context, s->arguments[0], KTG_MESH_BY_ENDING, &before);
    if (status == KTG_OK)
        status = ktg_edit_read(context, s->pipeline.edit, before, &edit);
    if (status == KTG_OK)
        status = ktg_mesh_copy(context, before, &after);
    if (status == KTG_OK)
        status = change(context, s, edit, before, after, &f);
    if (status == KTG_OK)
        tell(s);
    discard(&f);
    ktg_edit_free(&edit);
    ktg_mesh_free(&before);
    ktg_mesh_free(&after);
    return status;
}

exit_code command_deform(int argc, char **argv) {
    return cli_run(argc, argv, CMD_DEFORM, 1, usage, run);
}
