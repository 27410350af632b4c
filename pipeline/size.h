/* pipeline/size.h - how large the finished model becomes (pipeline only). */
#ifndef KTG_PIPELINE_SIZE_H
#define KTG_PIPELINE_SIZE_H

#include "pipeline/pipeline.h"

/* The axis that is height: as asked, else z for STL files and y for all others. */
ktg_axis ktg_size_up(const ktg_pipeline_options *options);

/* Width, height (along up) and length of what the vertices span, in their unit. */
ktg_vec3 ktg_size_of(const ktg_vec3 *vertices, uint32_t vertex_count, ktg_axis up);

/* KTG_ARGUMENT when the wished size makes no sense. */
KTG_NODISCARD ktg_status ktg_size_check(ktg_context *context, const ktg_pipeline_options *options);

/* Millimetres per unit of the model, known before anything is unfolded; 0 where it is to become as
 * large as a sheet allows. */
KTG_NODISCARD ktg_status ktg_size_known(ktg_context *context, const ktg_pipeline_options *options,
                                        const ktg_mesh *mesh, double *mm_per_unit);

/* The same for a pattern without scale, whatever decides. */
KTG_NODISCARD ktg_status ktg_size_scale(ktg_context *context, const ktg_pipeline_options *options,
                                        const ktg_pattern *pattern, double *mm_per_unit);

/* Makes *mm_per_unit smaller until every piece, finished at that scale, fits a sheet; leaves it as
 * it is where all do. KTG_GEOMETRY when no scale is small enough. */
KTG_NODISCARD ktg_status ktg_size_shrink(ktg_context *context, const ktg_pipeline_options *options,
                                         const ktg_pattern *pattern, double *mm_per_unit);

#endif
