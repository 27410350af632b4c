/* flatten/matched.c - how the panels of a surface fit when both sides of each seam are made equally
 * long, as ktg_flatten does. */
#include "core/memory.h"
#include "flatten/sheet.h"
#include "flatten/surface.h"

static ktg_status open_surface(ktg_context *context, const bool *cut, ktg_flat_surface *s) {
    KTG_TRY(ktg_adjacency_new(context, s->mesh, &s->adjacency));
    s->cut = ktg_copy_array(context, cut, s->adjacency->edge_count, sizeof *cut);
    if (!s->cut)
        return KTG_MEMORY;
    KTG_TRY(ktg_cut_apart(context, s->mesh, s->adjacency, s->cut, &s->apart));
    s->flats = ktg_new(context, s->apart.count, ktg_flat_panel);
    return s->flats ? KTG_OK : KTG_MEMORY;
}

/* *laid: false where one is too long and thin for the digits. */
static ktg_status lay_panels(ktg_context *context, ktg_flat_surface *s, ktg_fit_limit *limit,
                             bool *laid) {
    *laid = true;
    for (uint32_t p = 0; p < s->apart.count; p++) {
        ktg_flat_panel *f = &s->flats[p];
        KTG_TRY(ktg_panel_new(context, s->apart.panels[p].mesh, &f->panel));
        f->flat = ktg_new(context, f->panel->vertex_count, ktg_vec2);
        if (!f->flat)
            return KTG_MEMORY;
        ktg_status status = ktg_lay_flat(context, f->panel, s->options, f->flat, &f->report);
        if (status != KTG_OK && status != KTG_GEOMETRY)
            return status;
        *laid &= status == KTG_OK;
        limit->work += 4 * (uint64_t)f->panel->face_count;
    }
    return KTG_OK;
}

static ktg_status fit_panels(ktg_context *context, ktg_flat_surface *s, ktg_fit_limit *limit,
                             ktg_fit *fits) {
    bool laid;
    KTG_TRY(lay_panels(context, s, limit, &laid));
    ktg_status status = laid ? ktg_seams_match(context, s) : KTG_OK;
    if (status != KTG_OK && status != KTG_GEOMETRY)
        return status;
    for (uint32_t p = 0; p < s->apart.count; p++)
        KTG_TRY(ktg_fit_of_flat(context, s->flats[p].panel, s->flats[p].flat, limit, &fits[p]));
    return KTG_OK;
}

ktg_status ktg_fit_matched(ktg_context *context, const ktg_mesh *mesh, const bool *cut,
                           ktg_fit_limit *limit, ktg_fit **fits, uint32_t *count) {
    ktg_flatten_options options;
    ktg_flatten_report report = {0};
    ktg_flatten_defaults(&options);
    ktg_flat_surface surface = {.mesh = mesh, .options = &options, .report = &report};
    ktg_status status = open_surface(context, cut, &surface);
    *count = surface.apart.count;
    *fits = status == KTG_OK ? ktg_new(context, surface.apart.count, ktg_fit) : NULL;
    if (status == KTG_OK)
        status = *fits ? fit_panels(context, &surface, limit, *fits) : KTG_MEMORY;
    ktg_flat_surface_drop(&surface);
    return status;
}
