/* pipeline/stages.h - from a repaired surface to a pattern on sheets (pipeline only). */
#ifndef KTG_PIPELINE_STAGES_H
#define KTG_PIPELINE_STAGES_H

#include "pipeline/hand.h"
#include "pipeline/pipeline.h"

/* What the stages work on; all borrowed. */
typedef struct ktg_stage {
    const ktg_pipeline_options *options;
    const ktg_mesh *mesh;
    const ktg_hand *hand;
    const char *title;
    ktg_pipeline_report *report; /* is filled on the way */
} ktg_stage;

/* Unfolds or flattens, chooses the scale, finishes, lays out. */
KTG_NODISCARD ktg_status ktg_stage_pattern(ktg_context *context, const ktg_stage *stage,
                                           ktg_pattern **pattern);

/* The two halves of that: pieces without a scale; then their scale, tabs, labels and sheets. */
KTG_NODISCARD ktg_status ktg_stage_pieces(ktg_context *context, const ktg_stage *stage,
                                          ktg_pattern **pattern);
KTG_NODISCARD ktg_status ktg_stage_sheets(ktg_context *context, const ktg_stage *stage,
                                          ktg_pattern **pattern);

/* The whole for options->sheets > 1: the largest pattern that takes no more sheets (fill.c). */
KTG_NODISCARD ktg_status ktg_stage_fill(ktg_context *context, const ktg_stage *stage,
                                        ktg_pattern **pattern);

/* The figures of a deformation as keys of an open JSON object, `before` before each; with "" they
 * are its first. */
KTG_NODISCARD ktg_status ktg_pipeline_put_deform(ktg_context *context, ktg_output *output,
                                                 const ktg_deform_report *report,
                                                 const char *before);

/* The last part of a path. */
const char *ktg_base_name(const char *path);

#endif
