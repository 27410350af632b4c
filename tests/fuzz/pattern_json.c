/* tests/fuzz/pattern_json.c - any bytes as a pattern: what reads can be judged, copied, written and
 * drawn, and reads back the same. */
#include "layout/layout.h"
#include "pattern/pattern.h"
#include "render/render.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/trouble.h"
#include "verify/verify.h"

static const char *write_json(ktg_context *context, const ktg_pattern *pattern, const char *name) {
    const char *path = fuzz_path(name);
    ktg_output *output;
    fuzz_must(context, ktg_output_open(context, path, &output));
    fuzz_must(context, ktg_pattern_write_json(context, pattern, output));
    fuzz_must(context, ktg_output_commit(context, &output));
    return path;
}

static void check_round_trip(ktg_context *context, const ktg_pattern *pattern) {
    ktg_pattern *copy, *again;
    fuzz_must(context, ktg_pattern_copy(context, pattern, &copy));
    const char *once = write_json(context, copy, "/once.json");
    fuzz_must(context, ktg_pattern_read_json(context, once, &again));
    fuzz_expect(fuzz_same(once, write_json(context, again, "/twice.json")),
                "a pattern that is written, read and written again has changed");
    ktg_pattern_free(&copy);
    ktg_pattern_free(&again);
}

/* A sound pattern can be finished and laid out anew, and stays sound. */
static void finish_again(ktg_context *context, ktg_pattern *pattern) {
    ktg_finish_options options;
    ktg_finish_report report;
    ktg_layout_options layout;
    ktg_layout_report placed;
    ktg_finish_defaults(&options);
    ktg_layout_defaults(&layout);
    layout.effort = KTG_EFFORT_QUICK;
    layout.seconds = 0.2;
    if (pattern->mm_per_unit == 0 ||
        !fuzz_succeeded(context, ktg_pattern_finish(context, pattern, &options, &report)) ||
        !fuzz_succeeded(context, ktg_layout_place(context, pattern, &layout, &placed)))
        return;
    ktg_verify_report proof;
    fuzz_must(context, ktg_verify(context, pattern, NULL, &proof));
}

static void read_with_little_memory(ktg_context *context, const char *path) {
    ktg_pattern *pattern;
    if (!fuzz_trouble_over(context, ktg_pattern_read_json(context, path, &pattern)))
        fuzz_expect(!pattern, "a pattern comes with a failure");
    ktg_pattern_free(&pattern);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ktg_context *context = fuzz_context();
    ktg_pattern *pattern;
    ktg_verify_report report;
    const char *path = fuzz_file("/some.json", data, size);
    if (fuzz_trouble_memory(context, data, size))
        read_with_little_memory(context, path);
    if (fuzz_succeeded(context, ktg_pattern_read_json(context, path, &pattern))) {
        check_round_trip(context, pattern);
        ktg_status status = ktg_verify(context, pattern, NULL, &report);
        fuzz_expect(status == KTG_OK || status == KTG_UNSOUND, "a pattern cannot be judged");
        fuzz_expect((status == KTG_OK) == (report.problem_count == 0),
                    "the verdict and the number of problems contradict each other");
        if (status == KTG_OK)
            finish_again(context, pattern);
    } else {
        fuzz_expect(!pattern, "a pattern comes with a failure");
    }
    ktg_pattern_free(&pattern);
    ktg_context_free(&context);
    return 0;
}
