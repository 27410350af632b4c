/* flatten/warp.c - a flat mesh warped by a file of handles: the whole way. */
#include "core/memory.h"
#include "flatten/shape.h"

#include <string.h>

enum { most_rounds = 200 };

void ktg_warp_defaults(ktg_warp_options *options) {
    *options = (ktg_warp_options){.weight = KTG_WEIGHT_COTANGENT, .refine = KTG_NONE};
}

/* What one warp takes and frees. */
typedef struct warp {
    const ktg_warp_options *options;
    ktg_shape *shape;
    ktg_handle_list list;
    ktg_vec2 *positions, *other;
} warp;

/* Takes w->other's positions, which have been measured. */
static void take_other(warp *w, const ktg_shape_report *after, ktg_warp_report *r) {
    memcpy(w->positions, w->other, w->shape->mesh->vertex_count * sizeof *w->other);
    r->shape = *after;
}

static void measure_other(const warp *w, ktg_shape_report *after) {
    ktg_shape_measure(w->shape, w->list.targets, w->other, NULL, after);
}

/* Unless somebody asks for refinement, its result is taken only where it folds no more faces. */
static ktg_status refine(ktg_context *context, warp *w, ktg_warp_report *r) {
    bool asked = w->options->refine != KTG_NONE;
    uint32_t rounds = asked ? w->options->refine : r->folded_before > 0 ? most_rounds : 0;
    ktg_shape_report after;
    if (rounds == 0)
        return KTG_OK;
    memcpy(w->other, w->positions, w->shape->mesh->vertex_count * sizeof *w->other);
    KTG_TRY(ktg_shape_refine(context, w->shape, w->list.targets, rounds, w->other, &r->rounds));
    measure_other(w, &after);
    if (asked || after.folded_faces <= r->folded_before)
        take_other(w, &after, r);
    return KTG_OK;
}

/* Where folds remain, and nobody said how much work is to be done. */
static ktg_status lead(ktg_context *context, warp *w, ktg_warp_report *r) {
    ktg_shape_report after;
    if (r->shape.folded_faces == 0 || w->options->refine != KTG_NONE)
        return KTG_OK;
    KTG_TRY(ktg_shape_lead(context, w->shape, w->list.targets, w->other, &r->led));
    if (!r->led)
        return KTG_OK;
    measure_other(w, &after);
    take_other(w, &after, r);
    return KTG_OK;
}

/* Only a shape without folds is looked at: the border of another one tells nothing. */
static ktg_status look_for_crossing(ktg_context *context, warp *w, ktg_warp_report *r) {
    uint32_t vertices[2];
    if (r->shape.folded_faces > 0)
        return KTG_OK;
    for (uint32_t v = 0; v < w->shape->mesh->vertex_count; v++)
        w->other[v] = ktg_shape_inward(w->shape, w->positions[v]);
    return ktg_panel_find_crossing(context, w->shape->panel, w->other, &r->crossed, vertices);
}

static ktg_status run(ktg_context *context, const ktg_mesh *mesh, const char *handles, warp *w,
                      ktg_warp_report *r) {
    KTG_TRY(ktg_shape_register(context, mesh, w->options->weight, &w->shape));
    KTG_TRY(ktg_handles_read(context, handles, w->shape, &w->list));
    KTG_TRY(ktg_shape_compile(context, w->shape, w->list.handles, w->list.count));
    w->positions = ktg_new(context, mesh->vertex_count, ktg_vec2);
    w->other = ktg_new(context, mesh->vertex_count, ktg_vec2);
    if (!w->positions || !w->other)
        return KTG_MEMORY;
    KTG_TRY(ktg_shape_update(context, w->shape, w->list.targets, w->positions));
    ktg_shape_measure(w->shape, w->list.targets, w->positions, NULL, &r->shape);
    r->handles = w->list.count;
    r->folded_before = r->shape.folded_faces;
    KTG_TRY(refine(context, w, r));
    KTG_TRY(lead(context, w, r));
    return look_for_crossing(context, w, r);
}

ktg_status ktg_warp(ktg_context *context, ktg_mesh *mesh, const char *handles,
                    const ktg_warp_options *options, ktg_warp_report *report) {
    ktg_warp_options defaults;
    ktg_warp_report own;
    ktg_warp_defaults(&defaults);
    warp w = {.options = options ? options : &defaults};
    if (!report)
        report = &own;
    *report = (ktg_warp_report){0};
    ktg_status status = run(context, mesh, handles, &w, report);
    for (uint32_t v = 0; status == KTG_OK && v < mesh->vertex_count; v++) {
        mesh->positions[v].x = w.positions[v].x;
        mesh->positions[v].y = w.positions[v].y;
    }
    ktg_shape_free(&w.shape);
    ktg_handle_list_free(&w.list);
    ktg_free(w.positions);
    ktg_free(w.other);
    return status;
}
