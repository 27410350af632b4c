/* pipeline/defaults.c - the options a caller starts from. */
#include "pipeline/pipeline.h"

void ktg_pipeline_defaults(ktg_pipeline_options *options) {
    *options = (ktg_pipeline_options){.mode = KTG_PAPER,
                                      .faces = 500,
                                      .size_rule = KTG_SIZE_FIT,
                                      .sheets = 1,
                                      .large = KTG_LARGE_SPLIT,
                                      .overlap_mm = 10};
    ktg_unfold_defaults(&options->unfold);
    ktg_flatten_defaults(&options->flatten);
    ktg_finish_defaults(&options->finish);
    ktg_layout_defaults(&options->layout);
    ktg_render_defaults(&options->render);
}
