/* flatten/flatten.c - the whole way from a mesh to a flat pattern, by the two-step method.
 *
 * Igarashi & Igarashi 2009, section 7. */
#include "flatten/flatten.h"
#include "core/clock.h"
#include "core/memory.h"
#include "flatten/kernel.h"

void ktg_flatten_defaults(ktg_flatten_options *options) {
    *options = (ktg_flatten_options){.weight = KTG_WEIGHT_COTANGENT};
}

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

static ktg_status lay_flat(ktg_context *context, const ktg_panel *panel,
                           const ktg_flatten_options *options, ktg_vec2 *flat) {
    ktg_neighbourhood *neighbourhoods = NULL;
    ktg_status status = ktg_neighbourhoods_new(context, panel, options->weight, &neighbourhoods);
    if (status == KTG_OK)
        status = two_steps(context, panel, neighbourhoods, flat);
    ktg_free(neighbourhoods);
    if (status == KTG_GEOMETRY)
        return ktg_fail(context, status,
                        "the panel is too long and thin, or its faces are too uneven, to be laid "
                        "flat with the digits of a double; cut it into shorter panels or remesh "
                        "it");
    return status;
}

static ktg_status refuse_flipped(ktg_context *context, const ktg_flatten_report *report,
                                 uint32_t first_flipped) {
    if (report->flipped_faces == 0)
        return KTG_OK;
    return ktg_fail(context, KTG_GEOMETRY,
                    "%u of %u faces (the first is face %u) fold over when the panel is laid flat: "
                    "it is too curved for one piece, or has needle-thin faces; cut it into flatter "
                    "panels by seams, or remesh it, first",
                    report->flipped_faces, report->faces, first_flipped + 1);
}

/* What the parts of ktg_flatten share; freed together. */
typedef struct flatten_work {
    ktg_panel *panel;
    ktg_vec2 *flat;
    double *face_strain;
} flatten_work;

static ktg_status flatten(ktg_context *context, const ktg_mesh *mesh, const char *name,
                          const ktg_flatten_options *options, flatten_work *work,
                          ktg_pattern **pattern, ktg_flatten_report *report) {
    uint32_t first_flipped;
    ktg_progress(context, "flatten", 0, NULL);
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_panel_new(context, mesh, &work->panel));
    KTG_TRY(ktg_panel_check_disk(context, mesh, work->panel));
    work->flat = ktg_new(context, mesh->vertex_count, ktg_vec2);
    work->face_strain = ktg_new(context, mesh->face_count, double);
    if (!work->flat || !work->face_strain)
        return KTG_MEMORY;
    KTG_TRY(lay_flat(context, work->panel, options, work->flat));
    ktg_progress(context, "flatten", 0.9, "strain");
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_strain_measure(context, work->panel, work->flat, work->face_strain, report,
                               &first_flipped));
    KTG_TRY(refuse_flipped(context, report, first_flipped));
    KTG_TRY(ktg_panel_check_overlap(context, work->panel, work->flat));
    KTG_TRY(
        ktg_flat_pattern(context, mesh, work->panel, name, work->flat, work->face_strain, pattern));
    ktg_progress(context, "flatten", 1, NULL);
    return KTG_OK;
}

ktg_status ktg_flatten(ktg_context *context, const ktg_mesh *mesh, const char *name,
                       const ktg_flatten_options *options, ktg_pattern **pattern,
                       ktg_flatten_report *report) {
    double start = ktg_clock_seconds();
    ktg_flatten_options defaults;
    ktg_flatten_report measured = {0};
    flatten_work work = {0};
    ktg_flatten_defaults(&defaults);
    *pattern = NULL;
    ktg_status status =
        flatten(context, mesh, name, options ? options : &defaults, &work, pattern, &measured);
    ktg_panel_free(&work.panel);
    ktg_free(work.flat);
    ktg_free(work.face_strain);
    measured.seconds = ktg_clock_seconds() - start;
    if (report)
        *report = measured;
    return status;
}
