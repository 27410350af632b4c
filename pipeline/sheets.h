/* pipeline/sheets.h - from pieces without a size to pieces on sheets (pipeline only). */
#ifndef KTG_PIPELINE_SHEETS_H
#define KTG_PIPELINE_SHEETS_H

#include "pipeline/pipeline.h"

/* Scales the pattern, finishes it and lays it out; *pattern may be replaced. Several pieces that
 * are to become as large as one sheet allows grow beyond what fits in rows as long as nesting
 * succeeds. Fills the report's finish and layout. */
KTG_NODISCARD ktg_status ktg_sheets_put(ktg_context *context, const ktg_pipeline_options *options,
                                        ktg_pattern **pattern, ktg_pipeline_report *report);

#endif
