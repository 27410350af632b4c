/* flatten/method.c - the three ways to lay a panel flat, and which one takes over from which. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/iterate.h"

#include <string.h>

/* ---- two-step ----------------------------------------------------------------------------- */

/* One edge in the middle is pinned where its neighbourhood was laid, from the origin along x: both
 * ends while the size is free, one when only the place is. */
static ktg_status two_steps(ktg_context *context, const ktg_panel *panel,
                            const ktg_neighbourhood *neighbourhoods, ktg_vec2 *flat) {
    uint32_t middle;
    KTG_TRY(ktg_panel_middle(context, panel, &middle));
    ktg_edges edges = {panel->vertex_count, panel->adjacency->edge_count, neighbourhoods};
    ktg_pins pins = {2, neighbourhoods[middle].vertices, neighbourhoods[middle].flat};
    KTG_TRY(ktg_similarity_step(context, &edges, &pins, flat));
    ktg_progress(context, "flatten", 0.6, "similarity");
    KTG_TRY(ktg_check_cancel(context));
    pins.count = 1;
    return ktg_scale_step(context, &edges, &pins, flat);
}

static ktg_status lay_flat_two_step(ktg_context *context, const ktg_panel *panel,
                                    ktg_edge_weight weight, ktg_vec2 *flat) {
    ktg_neighbourhood *neighbourhoods = NULL;
    ktg_status status = ktg_neighbourhoods_new(context, panel, weight, &neighbourhoods);
    if (status == KTG_OK)
        status = two_steps(context, panel, neighbourhoods, flat);
    ktg_free(neighbourhoods);
    return status;
}

/* ---- iterative ---------------------------------------------------------------------------- */

/* Where both iterative methods begin. */
typedef struct start {
    ktg_rest *rests;
    ktg_vec2 *flat;
    uint32_t flipped;
} start;

static void free_start(start *s) {
    ktg_free(s->rests);
    ktg_free(s->flat);
}

/* The map to a disk where there is no conformal one. */
static ktg_status make_start(ktg_context *context, const ktg_panel *panel, start *s) {
    s->flat = ktg_new(context, panel->vertex_count, ktg_vec2);
    if (!s->flat)
        return KTG_MEMORY;
    KTG_TRY(ktg_rests_new(context, panel, &s->rests));
    ktg_status status = ktg_conformal_start(context, panel, s->rests, s->flat);
    if (status != KTG_OK && status != KTG_GEOMETRY)
        return status;
    s->flipped = status == KTG_OK ? ktg_panel_count_turned_over(panel, s->flat) : panel->face_count;
    if (s->flipped < panel->face_count)
        return KTG_OK;
    KTG_TRY(ktg_convex_start(context, panel, s->rests, s->flat));
    s->flipped = ktg_panel_count_turned_over(panel, s->flat);
    return KTG_OK;
}

static ktg_status lay_flat_arap(ktg_context *context, const ktg_panel *panel, const start *s,
                                ktg_vec2 *flat, ktg_panel_report *report) {
    memcpy(flat, s->flat, panel->vertex_count * sizeof *flat);
    KTG_TRY(
        ktg_descend(context, panel, s->rests, KTG_ENERGY_ARAP, NULL, flat, &report->iterations));
    ktg_panel_set_upright(panel, flat, 1, 0);
    return KTG_OK;
}

static ktg_status lay_flat_injective(ktg_context *context, const ktg_panel *panel, const start *s,
                                     ktg_vec2 *flat, ktg_panel_report *report) {
    report->method = KTG_FLATTEN_INJECTIVE;
    report->iterations = 0;
    if (s->flipped == 0)
        memcpy(flat, s->flat, panel->vertex_count * sizeof *flat);
    else
        KTG_TRY(ktg_convex_start(context, panel, s->rests, flat));
    if (ktg_panel_count_turned_over(panel, flat) > 0)
        return KTG_OK; /* for the caller to refuse */
    ktg_dirichlet_set_size(panel, s->rests, flat);
    KTG_TRY(ktg_descend(context, panel, s->rests, KTG_ENERGY_DIRICHLET, NULL, flat,
                        &report->iterations));
    ktg_panel_set_upright(panel, flat, 1, 0);
    return KTG_OK;
}

/* What is wrong with the map that is as rigid as possible. */
static ktg_status judge_arap(ktg_context *context, const ktg_panel *panel, const ktg_vec2 *flat,
                             ktg_panel_report *report) {
    uint32_t vertices[2];
    report->flipped_by_arap = ktg_panel_count_flipped(panel, flat);
    if (report->flipped_by_arap > 0)
        return KTG_OK;
    return ktg_panel_find_crossing(context, panel, flat, &report->crossed_by_arap, vertices);
}

static ktg_status iterate(ktg_context *context, const ktg_panel *panel,
                          const ktg_flatten_options *options, start *s, ktg_vec2 *flat,
                          ktg_panel_report *report) {
    KTG_TRY(make_start(context, panel, s));
    if (options->method == KTG_FLATTEN_INJECTIVE)
        return lay_flat_injective(context, panel, s, flat, report);
    KTG_TRY(lay_flat_arap(context, panel, s, flat, report));
    KTG_TRY(judge_arap(context, panel, flat, report));
    if (report->flipped_by_arap == 0 && !report->crossed_by_arap)
        return KTG_OK;
    return lay_flat_injective(context, panel, s, flat, report);
}

/* ---- any ---------------------------------------------------------------------------------- */

static ktg_status lay_flat(ktg_context *context, const ktg_panel *panel,
                           const ktg_flatten_options *options, ktg_vec2 *flat,
                           ktg_panel_report *report) {
    if (options->method == KTG_FLATTEN_TWO_STEP) {
        KTG_TRY(lay_flat_two_step(context, panel, options->weight, flat));
        ktg_panel_set_upright(panel, flat, 1, 0);
        return KTG_OK;
    }
    start s = {0};
    ktg_status status = iterate(context, panel, options, &s, flat, report);
    free_start(&s);
    return status;
}

ktg_status ktg_lay_flat(ktg_context *context, const ktg_panel *panel,
                        const ktg_flatten_options *options, ktg_vec2 *flat,
                        ktg_panel_report *report) {
    report->method = options->method;
    ktg_status status = lay_flat(context, panel, options, flat, report);
    if (status == KTG_GEOMETRY)
        return ktg_fail(context, status,
                        "the panel is too long and thin, or its faces are too uneven, to be laid "
                        "flat with the digits of a double; cut it into shorter panels or remesh "
                        "it");
    return status;
}
