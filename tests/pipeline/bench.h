/* tests/pipeline/bench.h - a workbench for runs of the whole job: a new folder, options, outputs.
 */
#ifndef KTG_TESTS_PIPELINE_BENCH_H
#define KTG_TESTS_PIPELINE_BENCH_H

#include "pipeline/pipeline.h"

#define BENCH_OUTPUTS 10

typedef struct bench {
    ktg_context *context;
    ktg_pipeline_options options; /* defaults, and what a test changes */
    char folder[64];
    char paths[BENCH_OUTPUTS][128];
    const char *outputs[BENCH_OUTPUTS];
    char model[256], report[128];
} bench;

/* For cmocka: *state is a bench with an empty folder; the teardown removes all that is in it. */
int bench_setup(void **state);
int bench_teardown(void **state);

/* One of the project's samples becomes the model; it is not simplified. */
void bench_sample(bench *b, const char *name);

/* A file in the bench's folder; valid until the next call. */
const char *bench_path(bench *b, const char *name);

/* One more output, in the bench's folder. Returns its whole path. */
const char *bench_output(bench *b, const char *name);

/* Forgets all outputs. */
void bench_no_outputs(bench *b);

/* A file in the bench's folder that holds `text`. */
void bench_write(bench *b, const char *name, const char *text);

/* The whole file, with a 0 behind; free with free(). NULL when there is none. */
char *bench_read(bench *b, const char *name, size_t *size);

bool bench_exists(bench *b, const char *name);

/* How many files there are in the folder. */
size_t bench_count(bench *b);

/* Runs, and fails the test with the context's message when that does not succeed. */
void bench_run(bench *b, ktg_pipeline_report *report);

/* Runs, and fails the test unless it ends with this status and words in the message. */
void bench_refused(bench *b, ktg_status status, const char *words);

/* The pattern in a JSON output; free with ktg_pattern_free. */
ktg_pattern *bench_pattern(bench *b, const char *name);

/* Fails the test unless verify accepts the pattern, together with the model as it is repaired. */
void bench_sound(bench *b, const ktg_pattern *pattern);

#endif
