/* tests/fuzz/job.c - the whole job on a tiny model: whatever comes out is proved. */
#include "tests/fuzz/job.h"
#include "tests/fuzz/model.h"
#include "tests/fuzz/trouble.h"
#include "verify/verify.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

/* Of searching and nesting, which count their work: with sanitizers a second becomes a minute. */
#define MOST_SECONDS 0.1

static void pick_sheet(fuzz_bytes *bytes, ktg_layout_options *layout) {
    static const char *const sheets[] = {"a4", "a5", "60x40", "fit", "letter", "a0", "30x500"};
    ktg_context *context = fuzz_context();
    fuzz_must(context, ktg_sheet_parse(context, sheets[fuzz_below(bytes, 7)], &layout->sheet));
    ktg_context_free(&context);
    layout->sheet.margin_mm = FUZZ_PICK(bytes, double, 10, 5, 0, 19);
    layout->gap_mm = FUZZ_PICK(bytes, double, 2, 0, 10);
    layout->roll = fuzz_below(bytes, 8) == 7;
    layout->effort = KTG_EFFORT_QUICK;
    layout->enough_sheets = FUZZ_PICK(bytes, uint32_t, 100, 100, 100, 0);
}

static void pick_drawing(fuzz_bytes *bytes, ktg_render_options *render) {
    unsigned how = fuzz_byte(bytes);
    render->colour = how & 1;
    render->real_dashes = how & 2;
    render->plain_dxf = how & 4;
    render->registration = how & 8;
    render->folds = how & 16 ? KTG_FOLDS_SOLID : KTG_FOLDS_DASHED;
    render->svg_unit = (ktg_svg_unit)(how / 32 % 3);
    render->guide = how / 32 == 7; /* its pictures take longer than all the rest */
    render->dots_per_inch = 20;
}

/* Thousands of sheets, each of which is drawn four times, are many minutes with sanitizers. */
static void keep_poster_small(ktg_pipeline_options *options) {
    if (options->large != KTG_LARGE_TILE || options->size_mm < 50)
        return;
    options->size_mm = fmin(options->size_mm, 400);
    options->layout.sheet.margin_mm = fmin(options->layout.sheet.margin_mm, 5);
}

void fuzz_options(fuzz_bytes *bytes, ktg_pipeline_options *options) {
    ktg_pipeline_defaults(options);
    options->colours = KTG_COLOURS_OFF;
    options->faces = FUZZ_PICK(bytes, uint32_t, KTG_ALL_FACES, KTG_ALL_FACES, 4, 12);
    options->size_rule = (ktg_size_rule)fuzz_below(bytes, 5);
    options->size_mm = FUZZ_PICK(bytes, double, 30, 1, 100, 400, 7.3, 0.01, 1500);
    options->sheets = FUZZ_PICK(bytes, uint32_t, 1, 1, 1, 1, 1, 1, 1, 2, 3);
    options->large = (ktg_large)fuzz_below(bytes, 4);
    options->up = (ktg_axis)fuzz_below(bytes, 4);
    options->overlap_mm = FUZZ_PICK(bytes, double, 10, 0, 3);
    options->unfold.seconds = MOST_SECONDS;
    pick_sheet(bytes, &options->layout);
    keep_poster_small(options);
    pick_drawing(bytes, &options->render);
    if (fuzz_below(bytes, 8) == 7 && options->size_mm < 50) /* many dots take long */
        options->colours = FUZZ_PICK(bytes, ktg_colour_rule, KTG_COLOURS_AUTO, KTG_COLOURS_ON);
}

static ktg_mesh *read_repaired(ktg_context *context, const char *path) {
    ktg_mesh *model;
    ktg_repair_report repair;
    fuzz_must(context, ktg_mesh_read(context, path, KTG_MESH_BY_ENDING, &model));
    fuzz_must(context, ktg_mesh_repair(context, model, &repair));
    return model;
}

static void write_json(ktg_context *context, const ktg_pattern *pattern, const char *path) {
    ktg_output *output;
    fuzz_must(context, ktg_output_open(context, path, &output));
    fuzz_must(context, ktg_pattern_write_json(context, pattern, output));
    fuzz_must(context, ktg_output_commit(context, &output));
}

/* A simplified surface is only measured against its model, which takes longest. */
static ktg_status verify(ktg_context *context, const ktg_pattern *pattern, const char *model) {
    ktg_mesh *mesh = model && !pattern->simplified ? read_repaired(context, model) : NULL;
    ktg_verify_report report;
    ktg_status status = ktg_verify(context, pattern, mesh, &report);
    ktg_mesh_free(&mesh);
    return status;
}

void fuzz_prove(ktg_context *context, const char *json, const char *model) {
    ktg_pattern *pattern, *copy;
    fuzz_must(context, ktg_pattern_read_json(context, json, &pattern));
    fuzz_must(context, verify(context, pattern, model));
    fuzz_must(context, ktg_pattern_copy(context, pattern, &copy));
    const char *again = fuzz_path("/again.json");
    write_json(context, copy, again);
    fuzz_expect(fuzz_same(json, again), "a pattern that is read and written again has changed");
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&copy);
}

void fuzz_job(ktg_context *context, ktg_pipeline_options *options, const char *model,
              fuzz_bytes *bytes) {
    char model_path[512], json[512];
    snprintf(model_path, sizeof model_path, "%s", model);
    snprintf(json, sizeof json, "%s", fuzz_path("/out.json"));
    const char *outputs[] = {json, fuzz_path("/out%d.svg"), fuzz_path("/out%d.dxf"),
                             fuzz_path("/out.pdf"), fuzz_path("/out.png")};
    unlink(json);
    options->model = model_path;
    options->outputs = outputs;
    options->output_count = sizeof outputs / sizeof *outputs;
    options->report = fuzz_path("/report.json");
    ktg_pipeline_report report;
    fuzz_trouble trouble;
    fuzz_trouble_begin(bytes, context, &trouble);
    ktg_status status = ktg_pipeline_run(context, options, &report);
    bool done = fuzz_trouble_end(context, &trouble, status);
    ktg_pipeline_report_free(&report);
    if (done)
        fuzz_prove(context, json, options->edit || options->omit_count ? NULL : model_path);
    else
        fuzz_expect(access(json, F_OK) != 0, "a run that failed has written a file");
}
