/* tests/fuzz/flatten.c - tiny models to cloth: whatever pattern comes out is sound. */
#include "tests/fuzz/job.h"
#include "tests/fuzz/model.h"

/* Seams are matched: where they are not, sides that differ are what was asked for. */
static void pick_flattening(fuzz_bytes *bytes, ktg_flatten_options *flatten,
                            const ktg_fabric *fabric) {
    unsigned how = fuzz_byte(bytes);
    flatten->method = (ktg_flatten_method)(how % 3);
    flatten->weight = how / 3 % 4 == 3 ? KTG_WEIGHT_UNIT : KTG_WEIGHT_COTANGENT;
    flatten->seams = FUZZ_PICK(bytes, unsigned, 0, KTG_SEAMS_AUTO, KTG_SEAMS_GROUPS,
                               KTG_SEAMS_MARKED | KTG_SEAMS_UV, KTG_SEAMS_CREASE,
                               KTG_SEAMS_CREASE | KTG_SEAMS_AUTO, KTG_SEAMS_MATERIALS);
    flatten->crease = FUZZ_PICK(bytes, double, 0.7, 0.1, 1.6);
    flatten->strain_limit = FUZZ_PICK(bytes, double, 0.05, 0.001, 0.5);
    if (how % 5 == 4)
        flatten->fabric = fabric;
}

static void pick_sewing(fuzz_bytes *bytes, ktg_pipeline_options *options) {
    ktg_finish_options *finish = &options->finish;
    finish->allowance_mm = FUZZ_PICK(bytes, double, 10, 0, 1, 30);
    finish->hem_mm = FUZZ_PICK(bytes, double, 20, 0, 5, 60);
    finish->notch_mm = FUZZ_PICK(bytes, double, 5, 0, 12);
    finish->notch_every_mm = FUZZ_PICK(bytes, double, 250, 20, 5000);
    finish->twins = fuzz_below(bytes, 4) != 3;
    options->part_groups = fuzz_below(bytes, 8) == 7;
    options->marker = fuzz_below(bytes, 8) == 7;
    options->layout.roll = options->layout.roll || options->marker;
    options->layout.keep_grain = fuzz_below(bytes, 4) != 3;
    options->layout.nap = fuzz_below(bytes, 8) == 7;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    ktg_context *context = fuzz_context();
    ktg_pipeline_options options;
    ktg_fabric woven;
    static const char *const on_fold[] = {"a", "b", "model"};
    fuzz_must(context, ktg_fabric_named(context, "woven", &woven));
    fuzz_options(&bytes, &options);
    options.mode = KTG_CLOTH;
    pick_flattening(&bytes, &options.flatten, &woven);
    pick_sewing(&bytes, &options);
    const ktg_panel_grain grain = {"a", 0.4};
    unsigned named = fuzz_byte(&bytes);
    options.finish.on_fold = on_fold;
    options.finish.on_fold_count = named % 8 == 7 ? 3 : 0;
    options.flatten.grains = &grain;
    options.flatten.grain_count = named / 8 % 8 == 7;
    const char *model = fuzz_model(&bytes);
    fuzz_job(context, &options, model, &bytes);
    ktg_context_free(&context);
    return 0;
}
