/* cli/command_unfold.c - katagami unfold and katagami flatten: the whole job. */
#include "cli/cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char unfold_usage[] =
    "usage: katagami unfold MODEL [-o FILE]... [options]\n\n"
    "Unfolds a model (OBJ, STL, PLY, OFF) into paper pieces with glue tabs, on sheets to be\n"
    "printed at 100 %. Without -o it writes NAME.pdf beside the model; .pdf, .svg, .dxf, .png and\n"
    ".json can be written, '-' is PDF on standard output. A model of more than 500 faces is\n"
    "simplified to 500 unless --faces says otherwise. Without a size the model becomes as large\n"
    "as one sheet allows. Lengths take mm, cm, m, in; bare numbers are millimetres.\n"
    "Ctrl-C ends the search and writes the best so far; a second one stops at once.\n\n";

static const char flatten_usage[] =
    "usage: katagami flatten MODEL --unit mm|cm|m|in [-o FILE]... [options]\n\n"
    "Takes a garment apart along its seams, lays each panel flat as rigidly as it can, and adds\n"
    "seam allowances, notches, numbers and names. Seams are the borders of objects, groups and\n"
    "materials, and marked edges (OBJ l elements); where there are none, they are chosen. Without\n"
    "-o it writes NAME.pdf beside the model; .pdf, .svg, .dxf, .png and .json can be written.\n"
    "Cloth needs a size: the model's unit, or the height, width or length of the finished "
    "thing.\n\n";

/* NAME.pdf beside the model. Free with free(). */
static char *default_output(const char *model) {
    const char *slash = strrchr(model, '/'), *dot = strrchr(model, '.');
    size_t length =
        dot && (!slash || dot > slash + 1) && dot > model ? (size_t)(dot - model) : strlen(model);
    if (strcmp(model, "-") == 0) {
        model = "model";
        length = 5;
    }
    char *path = malloc(length + 5);
    if (path) {
        memcpy(path, model, length);
        memcpy(path + length, ".pdf", 5);
    }
    return path;
}

static const char *plural(uint32_t count) {
    return count == 1 ? "" : "s";
}

static void tell_method(const ktg_panel_report *whole) {
    if (whole->flipped_by_arap > 0)
        fprintf(stderr,
                "as rigid as possible, %u face%s would fold over: flattened without folds "
                "(injective)\n",
                whole->flipped_by_arap, plural(whole->flipped_by_arap));
    if (whole->crossed_by_arap)
        fputs("as rigid as possible, the panel would lie on itself: flattened otherwise "
              "(injective)\n",
              stderr);
}

static void tell_strain(const ktg_flatten_report *f, const settings *s) {
    const ktg_panel_report *whole = &f->whole;
    tell_method(whole);
    fprintf(stderr, "strain: mean %.2f %%, 95 %% of the area below %.2f %%, largest %.2f %%\n",
            100 * whole->strain_mean, 100 * whole->strain_p95, 100 * whole->strain_max);
    if (s->pipeline.flatten.fabric)
        fprintf(stderr, "%.1f %% of the area is strained more than the fabric bears",
                100 * whole->area_beyond_limit);
    else
        fprintf(stderr, "%.1f %% of the area is strained more than %.4g %%",
                100 * whole->area_beyond_limit, 100 * f->strain_limit);
    fprintf(stderr, "; the border is %.2f %% %s\n", 100 * fabs(whole->border_error),
            whole->border_error < 0 ? "too short" : "too long");
}

static void tell_cloth(const ktg_pipeline_report *r, const settings *s) {
    tell_strain(&r->flatten, s);
    if (r->flatten.panels_beyond > 0 && r->flatten.panel_count > 1)
        fprintf(stderr, "%u panel%s strain%s more than that on more than 5 %% of the area\n",
                r->flatten.panels_beyond, plural(r->flatten.panels_beyond),
                r->flatten.panels_beyond == 1 ? "s" : "");
    if (r->finish.seams > 0)
        fprintf(stderr,
                "%u seam%s, %u of them dart%s; their sides differ by %.2f mm at most (%.2f %%)\n",
                r->finish.seams, plural(r->finish.seams), r->finish.darts, plural(r->finish.darts),
                r->finish.seam_error_mm, 100 * r->finish.seam_error);
    if (r->finish.twins > 0)
        fprintf(stderr, "%u panel%s cut with %s twin\n", r->finish.twins,
                r->finish.twins == 1 ? " is" : "s are", r->finish.twins == 1 ? "its" : "their");
}

/* Called before the files are in place: the last words are their names. */
static void tell_result(void *user, const ktg_pipeline_report *r) {
    const settings *s = user;
    cli_end_progress();
    if (r->unfold.stopped_by == KTG_STOPPED_INTERRUPT || r->flatten.interrupted)
        fputs("interrupted: this is the best pattern so far\n", stderr);
    if (r->unfold.stopped_by == KTG_STOPPED_TIME)
        fputs("the time is over: this is the best pattern so far\n", stderr);
    char page[64];
    const ktg_sheet_format *sheet = &s->pipeline.layout.sheet;
    snprintf(page, sizeof page, "%.0f x %.0f mm", r->sheet_mm.x, r->sheet_mm.y);
    fprintf(stderr, "%u face%s in %u piece%s on %u sheet%s of %s, %.0f %% filled\n", r->faces,
            plural(r->faces), r->pieces, plural(r->pieces), r->layout.sheets,
            plural(r->layout.sheets), ktg_layout_is_page(sheet) ? page : sheet->name,
            100 * r->layout.fill);
    if (s->pipeline.layout.roll && !s->pipeline.marker)
        fprintf(stderr, "the %s %.0f mm long\n",
                r->layout.sheets == 1 ? "sheet is" : "last sheet is",
                r->layout.last_mm + 2 * s->pipeline.layout.sheet.margin_mm);
    fprintf(stderr,
            "finished size %.0f x %.0f x %.0f mm (width x height x length), %.4g mm per unit\n",
            r->size_mm.x, r->size_mm.y, r->size_mm.z, r->mm_per_unit);
    if (s->pipeline.mode == KTG_CLOTH)
        tell_cloth(r, s);
    if (s->pipeline.mode == KTG_PAPER && s->pipeline.finish.tab_height_mm > 0)
        fprintf(stderr, "%u seam%s; tabs: %u full, %u reduced, %u without room (butt joints)\n",
                r->finish.seams, plural(r->finish.seams), r->finish.tabs_full,
                r->finish.tabs_reduced, r->finish.tabs_none);
}

static exit_code run_pattern(int argc, char **argv, int command, const char *usage) {
    settings s;
    if (!cli_read_options(argc, argv, command, 1, 1, &s))
        return EXIT_USAGE;
    if (s.help) {
        fputs(usage, stdout);
        cli_print_options(stdout, command);
        return EXIT_DONE;
    }
    char *path = default_output(s.arguments[0]);
    ktg_context *context = path ? cli_context(&s) : NULL;
    if (!context) {
        if (!path)
            fputs("katagami: out of memory\n", stderr);
        free(path);
        return EXIT_FAILED;
    }
    if (s.output_count == 0)
        s.outputs[s.output_count++] = path;
    s.pipeline.mode = command == CMD_FLATTEN ? KTG_CLOTH : KTG_PAPER;
    if (command == CMD_FLATTEN && !s.faces_given)
        s.pipeline.faces = KTG_ALL_FACES;
    if (command == CMD_FLATTEN && !s.oversize_given)
        s.pipeline.large = KTG_LARGE_TILE;
    s.pipeline.layout.keep_grain = command == CMD_FLATTEN;
    s.pipeline.model = s.arguments[0];
    s.pipeline.outputs = s.outputs;
    s.pipeline.output_count = s.output_count;
    s.pipeline.keep = s.keep.words;
    s.pipeline.keep_count = s.keep.count;
    s.pipeline.cut = s.cut.words;
    s.pipeline.cut_count = s.cut.count;
    s.pipeline.omit = s.omit.words;
    s.pipeline.omit_count = s.omit.count;
    s.pipeline.made = s.quiet ? NULL : tell_result;
    s.pipeline.user = &s;
    ktg_status status = cli_take_fabric(context, &s);
    if (status == KTG_OK)
        status = ktg_pipeline_run(context, &s.pipeline, NULL);
    cli_end_progress();
    exit_code code = status == KTG_OK ? EXIT_DONE : cli_fail(context, status);
    ktg_context_free(&context);
    free(path);
    return code;
}

exit_code command_unfold(int argc, char **argv) {
    return run_pattern(argc, argv, CMD_UNFOLD, unfold_usage);
}

exit_code command_flatten(int argc, char **argv) {
    return run_pattern(argc, argv, CMD_FLATTEN, flatten_usage);
}
