/* pipeline/stated.h - with which options a finished pattern was made (pipeline only). */
#ifndef KTG_PIPELINE_STATED_H
#define KTG_PIPELINE_STATED_H

#include "pipeline/pipeline.h"

/* Sets in `finish` what the pattern's outlines and lines show and `job` does not say otherwise:
 * allowance, hem, notches, twins, pieces on the fold. *names: the latter, freed with ktg_free;
 * they are the pattern's own. */
KTG_NODISCARD ktg_status ktg_stated_finish(ktg_context *context, const ktg_pattern *pattern,
                                           const ktg_warp_job *job, ktg_finish_options *finish,
                                           const char ***names);

/* The pattern's sheet and its margin; a roll where it was one. */
void ktg_stated_sheet(const ktg_pattern *pattern, ktg_layout_options *layout);

#endif
