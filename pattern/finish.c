/* pattern/finish.c - seams, tabs or allowance, outlines, labels: everything a scaled pattern still
 * needs before it is laid on sheets. */
#include "pattern/finish.h"

#include "core/memory.h"
#include "pattern/build_order.h"
#include "pattern/tabs.h"

void ktg_finish_defaults(ktg_finish_options *options) {
    *options = (ktg_finish_options){.tab_height_mm = 5,
                                    .tab_flank = 50 * KTG_PI / 180,
                                    .tab_inset_mm = 0.3,
                                    .tab_least_mm = 2,
                                    .tab_edge_mm = 4,
                                    .tab_side = KTG_TAB_ALTERNATE,
                                    .numbers = KTG_NUMBER_SEAM,
                                    .number_mm = 2.4,
                                    .up = 1,
                                    .allowance_mm = 10,
                                    .hem_mm = 20,
                                    .notch_mm = 5,
                                    .notch_every_mm = 250,
                                    .twins = true};
}

/* A length of the options: neither negative nor beyond any paper. */
static ktg_status check_length(ktg_context *context, const char *what, double mm) {
    if (mm >= 0 && mm <= 1000)
        return KTG_OK;
    return ktg_fail(context, KTG_ARGUMENT, "%s of %g mm makes no sense: it must be 0 to 1000 mm",
                    what, mm);
}

ktg_status ktg_finish_check(ktg_context *context, const ktg_finish_options *options) {
    KTG_TRY(check_length(context, "a tab height", options->tab_height_mm));
    KTG_TRY(check_length(context, "a tab inset", options->tab_inset_mm));
    KTG_TRY(check_length(context, "a least tab height", options->tab_least_mm));
    KTG_TRY(check_length(context, "a least edge for tabs", options->tab_edge_mm));
    KTG_TRY(check_length(context, "a seam allowance", options->allowance_mm));
    KTG_TRY(check_length(context, "a hem", options->hem_mm));
    KTG_TRY(check_length(context, "a notch", options->notch_mm));
    if (!(options->notch_every_mm > 0))
        return ktg_fail(context, KTG_ARGUMENT, "notches need a distance above 0 mm");
    KTG_TRY(check_length(context, "a digit height", options->number_mm));
    if (!(options->tab_flank >= 10 * KTG_PI / 180) || !(options->tab_flank <= KTG_PI / 2))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a tab's flank angle must be 10 to 90 degrees, not %g",
                        options->tab_flank * 180 / KTG_PI);
    return KTG_OK;
}

ktg_status ktg_finish_shapes(ktg_context *context, const ktg_topology *topology,
                             const ktg_finish_options *options, ktg_pattern *pattern,
                             ktg_finish_report *report) {
    if (pattern->mode == KTG_CLOTH)
        return ktg_finish_cloth(context, topology, options, pattern, report);
    KTG_TRY(ktg_tabs_place(context, topology, options, pattern, report));
    return ktg_outlines_with_tabs(context, topology, pattern);
}

static ktg_vec2 middle_of(const ktg_topology *t, uint32_t h) {
    return ktg_mul2(ktg_add2(ktg_start_of(t, h), ktg_end_of(t, h)), 0.5);
}

static double mate_distance(const ktg_topology *t) {
    double sum = 0, count = 0;
    for (size_t e = 0; e < t->pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &t->pattern->edges[e];
        if (edge->kind != KTG_EDGE_CUT)
            continue;
        uint32_t h = ktg_side_halfedge(&edge->sides[0]), g = ktg_side_halfedge(&edge->sides[1]);
        if (t->piece_of[h / 3] != t->piece_of[g / 3])
            continue;
        sum += ktg_length2(ktg_sub2(middle_of(t, h), middle_of(t, g)));
        count++;
    }
    return count > 0 ? sum / count : 0;
}

static ktg_status finish(ktg_context *context, const ktg_topology *topology,
                         const ktg_finish_options *options, ktg_pattern *pattern,
                         ktg_finish_report *report) {
    KTG_TRY(ktg_seams_find(context, topology, pattern));
    if (pattern->mode == KTG_PAPER && pattern->vertex_count > 0) /* a trial has no surface */
        KTG_TRY(ktg_build_order(context, topology, options->up, pattern));
    KTG_TRY(ktg_finish_shapes(context, topology, options, pattern, report));
    report->seams = (uint32_t)pattern->seam_count;
    for (size_t e = 0; e < pattern->edge_count; e++)
        report->seam_edges += pattern->edges[e].kind == KTG_EDGE_CUT;
    report->mate_distance_mm = mate_distance(topology);
    return ktg_labels_write(context, topology, options, pattern);
}

ktg_status ktg_pattern_finish(ktg_context *context, ktg_pattern *pattern,
                              const ktg_finish_options *options, ktg_finish_report *report) {
    ktg_finish_options defaults;
    ktg_finish_report own;
    ktg_finish_defaults(&defaults);
    if (!options)
        options = &defaults;
    if (!report)
        report = &own;
    *report = (ktg_finish_report){0};
    KTG_TRY(ktg_finish_check(context, options));
    if (!(pattern->mm_per_unit > 0))
        return ktg_fail(context, KTG_ARGUMENT,
                        "the pattern has no scale yet: tabs and allowances are in millimetres");
    ktg_topology topology;
    KTG_TRY(ktg_topology_build(context, pattern, &topology));
    ktg_status status = finish(context, &topology, options, pattern, report);
    ktg_topology_drop(&topology);
    return status;
}
