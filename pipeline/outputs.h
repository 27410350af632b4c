/* pipeline/outputs.h - which files to write, and writing them all or none (pipeline only). */
#ifndef KTG_PIPELINE_OUTPUTS_H
#define KTG_PIPELINE_OUTPUTS_H

#include "pipeline/pipeline.h"

/* KTG_ARGUMENT when an ending is not known, a path comes twice, or an output is the model itself.
 */
KTG_NODISCARD ktg_status ktg_outputs_check(ktg_context *context,
                                           const ktg_pipeline_options *options);

/* Writes the pattern to every output; no file appears before all of them are complete. */
KTG_NODISCARD ktg_status ktg_outputs_write(ktg_context *context,
                                           const ktg_pipeline_options *options,
                                           const ktg_pattern *pattern);

#endif
