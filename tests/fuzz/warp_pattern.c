/* tests/fuzz/warp_pattern.c - any bytes as a pattern of cloth whose first piece is to be warped. */
#include "pipeline/pipeline.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/trouble.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char handles[] = "hold vertex 1\nvertex 2 by 1 0.5\n";
    ktg_context *context = fuzz_context();
    ktg_pipeline_options options;
    ktg_pipeline_defaults(&options);
    options.layout.effort = KTG_EFFORT_QUICK;
    options.large = KTG_LARGE_TILE;
    ktg_warp_job job = {.pattern = fuzz_file("/some.json", data, size),
                        .piece = "1",
                        .handles = fuzz_file("/some.handles", handles, strlen(handles))};
    ktg_warp_defaults(&job.warp);
    const char *outputs[] = {fuzz_path("/out.pdf"), fuzz_path("/out.dxf"), fuzz_path("/out.json")};
    options.outputs = outputs;
    options.output_count = sizeof outputs / sizeof *outputs;
    ktg_warp_result result;
    ktg_pattern *pattern;
    if (fuzz_trouble_memory(context, data, size))
        fuzz_trouble_over(context, ktg_pipeline_warp(context, &options, &job, &result));
    if (fuzz_succeeded(context, ktg_pipeline_warp(context, &options, &job, &result))) {
        fuzz_must(context, ktg_pattern_read_json(context, outputs[2], &pattern));
        ktg_pattern_free(&pattern);
    }
    ktg_context_free(&context);
    return 0;
}
