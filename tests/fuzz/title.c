/* tests/fuzz/title.c - any bytes as the title of the sheets and the name of a piece: no drawing
 * fails, and the SVG is well formed where the bytes are. */
#include "layout/layout.h"
#include "pipeline/pipeline.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/model.h"

#include <stdlib.h>
#include <string.h>

/* A pattern of one box, or of two, in two pieces. */
static ktg_pattern *make_pattern(ktg_context *context, bool two) {
    const uint8_t cells[] = {3, 0, 0, 0, two ? 5 : 3};
    fuzz_bytes bytes = {cells, sizeof cells};
    ktg_mesh *mesh = fuzz_read_model(context, fuzz_model(&bytes));
    ktg_repair_report repair;
    ktg_unfold_options unfold;
    ktg_finish_options finish;
    ktg_finish_report finished;
    ktg_layout_options layout;
    ktg_layout_report placed;
    ktg_pattern *pattern;
    ktg_unfold_defaults(&unfold);
    ktg_finish_defaults(&finish);
    ktg_layout_defaults(&layout);
    unfold.effort = layout.effort = KTG_EFFORT_QUICK;
    fuzz_must(context, ktg_mesh_repair(context, mesh, &repair));
    fuzz_must(context, ktg_unfold(context, mesh, "model", &unfold, &pattern, NULL));
    fuzz_must(context, ktg_pattern_scale(context, pattern, 10));
    fuzz_must(context, ktg_pattern_finish(context, pattern, &finish, &finished));
    fuzz_must(context, ktg_layout_place(context, pattern, &layout, &placed));
    ktg_mesh_free(&mesh);
    return pattern;
}

typedef ktg_status draw_sheet(ktg_context *context, const ktg_pattern *pattern, size_t sheet,
                              const ktg_render_options *options, ktg_output *output);
typedef ktg_status draw_all(ktg_context *context, const ktg_pattern *pattern,
                            const ktg_render_options *options, ktg_output *output);

static void draw(ktg_context *context, const ktg_pattern *pattern,
                 const ktg_render_options *options, draw_all *all, draw_sheet *sheet) {
    ktg_output *output;
    fuzz_must(context, ktg_output_open(context, fuzz_path("/drawing"), &output));
    fuzz_must(context, all ? all(context, pattern, options, output)
                           : sheet(context, pattern, 0, options, output));
    fuzz_must(context, ktg_output_commit(context, &output));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static ktg_pattern *made[2];
    ktg_context *context = fuzz_context();
    ktg_pattern *pattern;
    ktg_render_options options;
    bool two = size % 8 == 7; /* several pieces bring pictures of the model, which take long */
    if (!made[two])
        made[two] = make_pattern(context, two);
    char *text = calloc(size + 1, 1);
    memcpy(text, data, size);
    fuzz_must(context, ktg_pattern_copy(context, made[two], &pattern));
    free(pattern->pieces[0].name);
    pattern->pieces[0].name = strdup(text);
    ktg_render_defaults(&options);
    options.title = text;
    options.dots_per_inch = 20;
    options.guide = size % 16 == 15; /* so do its pictures */
    draw(context, pattern, &options, ktg_render_pdf, NULL);
    draw(context, pattern, &options, ktg_render_astm, NULL);
    draw(context, pattern, &options, ktg_render_contact, NULL);
    draw(context, pattern, &options, NULL, ktg_render_svg);
    draw(context, pattern, &options, NULL, ktg_render_dxf);
    draw(context, pattern, &options, NULL, ktg_render_png);
    ktg_pattern_free(&pattern);
    ktg_context_free(&context);
    free(text);
    return 0;
}
