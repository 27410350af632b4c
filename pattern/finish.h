/* pattern/finish.h - the steps of ktg_pattern_finish (pattern only). Each replaces what an earlier
 * run of it left in the pattern. */
#ifndef KTG_PATTERN_FINISH_H
#define KTG_PATTERN_FINISH_H

#include "pattern/topology.h"

/* Seams and the edges' seam numbers (seams.c). */
KTG_NODISCARD ktg_status ktg_seams_find(ktg_context *context, const ktg_topology *topology,
                                        ktg_pattern *pattern);

/* Outlines of faces and tabs (outline.c). */
KTG_NODISCARD ktg_status ktg_outlines_with_tabs(ktg_context *context, const ktg_topology *topology,
                                                ktg_pattern *pattern);

/* Outlines with allowances, sewing lines, darts, notches, twins, halves, grain; takes tabs away
 * (allowance.c and pattern/cloth.h). */
KTG_NODISCARD ktg_status ktg_finish_cloth(ktg_context *context, const ktg_topology *topology,
                                          const ktg_finish_options *options, ktg_pattern *pattern,
                                          ktg_finish_report *report);

/* Numbers of seams or edges, and names of pieces (labels.c). */
KTG_NODISCARD ktg_status ktg_labels_write(ktg_context *context, const ktg_topology *topology,
                                          const ktg_finish_options *options, ktg_pattern *pattern);

/* The shape a pattern needs on paper: tabs or allowance, then outlines. */
KTG_NODISCARD ktg_status ktg_finish_shapes(ktg_context *context, const ktg_topology *topology,
                                           const ktg_finish_options *options, ktg_pattern *pattern,
                                           ktg_finish_report *report);

/* KTG_ARGUMENT for options that make no sense. */
KTG_NODISCARD ktg_status ktg_finish_check(ktg_context *context, const ktg_finish_options *options);

#endif
