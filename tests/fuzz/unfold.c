/* tests/fuzz/unfold.c - tiny models to paper: whatever net comes out is sound. */
#include "tests/fuzz/job.h"
#include "tests/fuzz/model.h"

static void pick_search(fuzz_bytes *bytes, ktg_unfold_options *unfold) {
    unsigned how = fuzz_byte(bytes);
    unfold->effort = KTG_EFFORT_QUICK;
    unfold->method = how % 4 == 3 ? KTG_METHOD_GENETIC : KTG_METHOD_AUTO;
    unfold->population = 4;
    unfold->generations = 8;
    unfold->patience = 4;
    unfold->restarts = how / 4 % 2;
    unfold->ease = FUZZ_PICK(bytes, double, 0, 0, 3, 10);
    unfold->pieces = FUZZ_PICK(bytes, uint32_t, 0, 0, 0, 2, 5);
    unfold->piece_faces = FUZZ_PICK(bytes, uint32_t, 0, 0, 0, 1, 4);
}

static void pick_tabs(fuzz_bytes *bytes, ktg_finish_options *finish) {
    finish->tab_height_mm = FUZZ_PICK(bytes, double, 5, 0, 20, 2.5);
    finish->tab_flank = FUZZ_PICK(bytes, double, 0.8727, 0.3, 1.5);
    finish->tab_inset_mm = FUZZ_PICK(bytes, double, 0.3, 0, 2);
    finish->tab_least_mm = FUZZ_PICK(bytes, double, 2, 0.5);
    finish->tab_edge_mm = FUZZ_PICK(bytes, double, 4, 0, 30);
    finish->tab_side = (ktg_tab_side)fuzz_below(bytes, 3);
    finish->numbers = (ktg_number_style)fuzz_below(bytes, 3);
    finish->number_mm = FUZZ_PICK(bytes, double, 2.4, 1, 8);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    ktg_context *context = fuzz_context();
    ktg_pipeline_options options;
    fuzz_options(&bytes, &options);
    pick_search(&bytes, &options.unfold);
    pick_tabs(&bytes, &options.finish);
    const char *edges = NULL, *omit = "a";
    if (fuzz_below(&bytes, 4) == 3) {
        char pair[2] = {(char)('1' + fuzz_below(&bytes, 9)), (char)('1' + fuzz_below(&bytes, 9))};
        edges = fuzz_file("/edges.txt", (char[]){pair[0], ' ', pair[1], '\n'}, 4);
    }
    unsigned hand = fuzz_below(&bytes, 8);
    options.keep = options.cut = &edges;
    options.keep_count = edges && hand % 2 == 0;
    options.cut_count = edges && hand % 2;
    options.omit = &omit;
    options.omit_count = hand == 7;
    const char *model = fuzz_model(&bytes);
    fuzz_job(context, &options, model, &bytes);
    ktg_context_free(&context);
    return 0;
}
