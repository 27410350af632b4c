/* cli/command_warp.c - katagami warp: a flat shape, or a piece of a pattern, follows its handles.
 */
#include "cli/cli.h"
#include "core/target.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char usage[] =
    "usage: katagami warp SHAPE --handles FILE -o FILE [options]\n\n"
    "Moves a few points of a flat shape; the rest follows as rigidly as it can (Igarashi &\n"
    "Igarashi 2009). SHAPE is a mesh with z = 0 (.obj, .off, .ply, .stl) and another one is\n"
    "written; or it is a piece of a pattern, PATTERN.json#piece3 or PATTERN.json#NAME, and the\n"
    "whole pattern is written (.json, .pdf, .svg, .dxf, .png), finished and laid out again with\n"
    "its seams measured again. A file of handles has lines like these (docs/warp.md):\n\n"
    "  vertex 17 -> 120 40      vertex 17, numbered from 1, goes to (120, 40)\n"
    "  at 30 55 by 5 -2         the point (30, 55) goes 5 to the right and 2 down\n"
    "  hold vertex 3            stays where it is; # begins a comment\n\n";

static const char *plural(uint32_t count) {
    return count == 1 ? "" : "s";
}

/* What was done against folds, or because somebody asked for it. */
static void tell_refinement(const ktg_warp_report *r) {
    if (r->folded_before > 0)
        fprintf(stderr, "%u face%s folded over at first; ", r->folded_before,
                plural(r->folded_before));
    if (r->led)
        fputs("the handles were led on a way without folds\n", stderr);
    else if (r->rounds > 0)
        fprintf(stderr, "refined in %u round%s\n", r->rounds, plural(r->rounds));
    else if (r->folded_before > 0)
        fputs("refinement did not help\n", stderr);
}

static void tell_warp(const ktg_warp_report *r) {
    tell_refinement(r);
    fprintf(stderr, "%u handle%s, %u faces stretched by %.3g to %.3g\n", r->handles,
            plural(r->handles), r->shape.faces, r->shape.stretch_least, r->shape.stretch_most);
    if (r->shape.folded_faces > 0)
        fprintf(stderr, "warning: %u face%s fold%s over, face %u first\n", r->shape.folded_faces,
                plural(r->shape.folded_faces), r->shape.folded_faces == 1 ? "s" : "",
                r->shape.first_folded + 1);
    if (r->crossed)
        fputs("warning: the border crosses itself\n", stderr);
}

/* ---- a mesh ------------------------------------------------------------------------------- */

static ktg_status check_mesh_output(ktg_context *context, const settings *s) {
    if (s->output_count != 1 || ktg_mesh_format_of(s->outputs[0]) == KTG_MESH_BY_ENDING)
        return ktg_fail(context, KTG_ARGUMENT,
                        "a mesh that is warped wants one -o FILE that ends in .obj, .stl, .ply or "
                        ".off");
    if (ktg_target_same(s->outputs[0], s->arguments[0]))
        return ktg_fail(context, KTG_ARGUMENT, "%s: is the shape itself; name another output",
                        s->outputs[0]);
    if (ktg_target_same(s->outputs[0], s->handles))
        return ktg_fail(context, KTG_ARGUMENT, "%s: is a file to be read; name another output",
                        s->outputs[0]);
    return ktg_output_check(context, s->outputs[0]);
}

static ktg_status warp_mesh(ktg_context *context, const settings *s) {
    ktg_mesh *mesh = NULL;
    ktg_output *output = NULL;
    ktg_warp_report report;
    const char *path = s->outputs[0];
    ktg_status status = check_mesh_output(context, s);
    if (status == KTG_OK)
        status = ktg_mesh_read(context, s->arguments[0], KTG_MESH_BY_ENDING, &mesh);
    if (status == KTG_OK)
        status = ktg_about_file(context, s->arguments[0],
                                ktg_warp(context, mesh, s->handles, &s->warp, &report));
    if (status == KTG_OK)
        status = ktg_output_open(context, path, &output);
    if (status == KTG_OK)
        status = ktg_mesh_write(context, mesh, ktg_mesh_format_of(path), output);
    if (status == KTG_OK)
        status = ktg_output_commit(context, &output);
    cli_end_progress();
    if (status == KTG_OK && !s->quiet) {
        tell_warp(&report);
        fputs("wrote ", stderr);
        cli_print_safe(stderr, path);
        fputc('\n', stderr);
    }
    ktg_output_discard(&output);
    ktg_mesh_free(&mesh);
    return status;
}

/* ---- a piece of a pattern ----------------------------------------------------------------- */

static void tell_piece(const ktg_warp_result *r) {
    tell_warp(&r->warp);
    fprintf(stderr, "its seams differ by %.2f mm at most (before: %.2f mm)", r->seam_error_mm,
            r->seam_error_before_mm);
    fprintf(stderr, "; allowance %.4g mm, hem %.4g mm, %u sheet%s\n", r->allowance_mm, r->hem_mm,
            r->layout.sheets, plural(r->layout.sheets));
}

static ktg_status warp_piece(ktg_context *context, settings *s, const char *pattern,
                             const char *piece) {
    ktg_warp_job job = {.pattern = pattern,
                        .piece = piece,
                        .handles = s->handles,
                        .warp = s->warp,
                        .sheet_given = s->sheet_given,
                        .allowance_given = s->allowance_given,
                        .hem_given = s->hem_given,
                        .notch_given = s->notch_given};
    ktg_warp_result result;
    s->pipeline.outputs = s->outputs;
    s->pipeline.output_count = s->output_count;
    s->pipeline.large = KTG_LARGE_TILE;
    ktg_status status = ktg_pipeline_warp(context, &s->pipeline, &job, &result);
    cli_end_progress();
    if (status == KTG_OK && !s->quiet)
        tell_piece(&result);
    return status;
}

/* PATTERN.json#PIECE is cut in two; *piece is NULL where none is named. False for another file.
 * Free *pattern with free(). */
static bool is_pattern(const char *shape, char **pattern, const char **piece) {
    const char *hash = strrchr(shape, '#');
    size_t length = hash ? (size_t)(hash - shape) : strlen(shape);
    *piece = hash ? hash + 1 : NULL;
    *pattern = NULL;
    if (length < 5 || strncasecmp(shape + length - 5, ".json", 5) != 0)
        return false;
    *pattern = strndup(shape, length);
    return true;
}

static ktg_status run(ktg_context *context, settings *s) {
    char *pattern;
    const char *piece;
    if (!s->handles)
        return ktg_fail(context, KTG_ARGUMENT, "warp wants --handles FILE");
    if (s->output_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "warp wants -o FILE");
    if (!is_pattern(s->arguments[0], &pattern, &piece))
        return warp_mesh(context, s);
    ktg_status status = pattern ? warp_piece(context, s, pattern, piece)
                                : ktg_fail(context, KTG_MEMORY, "out of memory");
    free(pattern);
    return status;
}

exit_code command_warp(int argc, char **argv) {
    return cli_run(argc, argv, CMD_WARP, 1, usage, run);
}
