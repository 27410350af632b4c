/* tests/fuzz/job.h - the whole job on a tiny model: whatever comes out is proved. */
#ifndef KTG_TESTS_FUZZ_JOB_H
#define KTG_TESTS_FUZZ_JOB_H

#include "pipeline/pipeline.h"
#include "tests/fuzz/fuzz.h"

/* Options that any mode has, by the bytes: size, sheets, oversize, drawing. */
void fuzz_options(fuzz_bytes *bytes, ktg_pipeline_options *options);

/* Runs the job on the model, writing every kind of output. Where it succeeds, the pattern is read
 * back, proved against the model (without edit or omission) and written again to the same bytes;
 * where it is refused, no file is there. What is left of the bytes may make trouble (trouble.h). */
void fuzz_job(ktg_context *context, ktg_pipeline_options *options, const char *model,
              fuzz_bytes *bytes);

/* Reads a pattern and proves it; `model` may be NULL. Its copy, written again, is the same. */
void fuzz_prove(ktg_context *context, const char *json, const char *model);

#endif
