/* pipeline/outputs.h - which files to write, and writing them all or none (pipeline only). */
#ifndef KTG_PIPELINE_OUTPUTS_H
#define KTG_PIPELINE_OUTPUTS_H

#include "pipeline/pipeline.h"

/* KTG_ARGUMENT when an ending is not known, a path comes twice, or an output is the model itself;
 * KTG_FILE when a path cannot be written. Asked before any work is done. */
KTG_NODISCARD ktg_status ktg_outputs_check(ktg_context *context,
                                           const ktg_pipeline_options *options);

/* Files written beside their places. Starts as {0}. */
typedef struct ktg_outputs {
    ktg_output **items;
    size_t count, capacity;
} ktg_outputs;

/* Writes the pattern to every output. */
KTG_NODISCARD ktg_status ktg_outputs_write(ktg_context *context,
                                           const ktg_pipeline_options *options,
                                           const ktg_pattern *pattern, ktg_outputs *outputs);

/* Writes the figures, where they are wanted. */
KTG_NODISCARD ktg_status ktg_outputs_write_report(ktg_context *context,
                                                  const ktg_pipeline_options *options,
                                                  const ktg_pipeline_report *report,
                                                  const ktg_pattern *pattern, ktg_outputs *outputs);

/* All files reach the disk, beside their places; then all of them appear. */
KTG_NODISCARD ktg_status ktg_outputs_finish(ktg_context *context, ktg_outputs *outputs);
KTG_NODISCARD ktg_status ktg_outputs_commit(ktg_context *context, ktg_outputs *outputs);

/* Drops what is not committed and frees. */
void ktg_outputs_discard(ktg_outputs *outputs);

#endif
