/* pipeline/paint.h - the model's colours on their way to the sheets (pipeline only). */
#ifndef KTG_PIPELINE_PAINT_H
#define KTG_PIPELINE_PAINT_H

#include "pipeline/pipeline.h"

/* The look of the repaired model, where it is wanted; else *paint is NULL. */
KTG_NODISCARD ktg_status ktg_paint_of_model(ktg_context *context,
                                            const ktg_pipeline_options *options,
                                            const ktg_mesh *mesh, ktg_paint **paint,
                                            ktg_paint_report *report);

/* Lays it onto the faces of the pattern, which was made of `mesh`. */
KTG_NODISCARD ktg_status ktg_paint_onto_pattern(ktg_context *context, const ktg_mesh *mesh,
                                                const ktg_pattern *pattern, ktg_paint *paint,
                                                ktg_paint_report *report);

#endif
