/* flatten/surface.c - from a surface with seams to panels that lie flat, and what became of them.
 */
#include "flatten/surface.h"

#include "core/clock.h"
#include "core/memory.h"
#include "flatten/seams.h"

#include <string.h>

/* What was given and decided stays. */
void ktg_flat_surface_drop(ktg_flat_surface *s) {
    for (uint32_t p = 0; s->flats && p < s->apart.count; p++) {
        ktg_panel_free(&s->flats[p].panel);
        ktg_free(s->flats[p].flat);
    }
    ktg_free(s->flats);
    ktg_free(s->face_strain);
    ktg_names_free(&s->names);
    ktg_cut_surface_free(&s->apart);
    ktg_free(s->cut);
    ktg_mesh_free(&s->slid);
    ktg_adjacency_free(&s->adjacency);
    s->flats = NULL;
    s->face_strain = NULL;
    s->cut = NULL;
}

/* ---- seams -------------------------------------------------------------------------------- */

static uint32_t count_cuts(const ktg_flat_surface *s) {
    uint32_t count = 0;
    for (uint32_t e = 0; e < s->adjacency->edge_count; e++)
        count += s->cut[e];
    return count;
}

/* Seams are chosen on a copy of the surface, whose vertices may slide along it. */
static ktg_status choose_seams(ktg_context *context, ktg_flat_surface *s) {
    size_t count = s->adjacency->edge_count;
    bool *given = ktg_copy_array(context, s->cut, count, sizeof *given);
    ktg_seams_auto_options options;
    ktg_seams_report chosen;
    ktg_seams_auto_defaults(&options);
    options.max_strain = s->options->strain_limit;
    options.area_part = s->area_part;
    options.effort = s->options->effort;
    options.fabric = s->options->fabric;
    options.up = s->options->up;
    ktg_status status = given ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_seams_auto(context, s->mesh, s->adjacency, &options, s->cut, &chosen);
    if (status == KTG_OK && chosen.slide > 0)
        status = ktg_mesh_copy(context, s->mesh, &s->slid);
    if (status == KTG_OK && chosen.slide > 0) {
        s->mesh = s->slid;
        status = ktg_seams_slide(context, s->slid, s->adjacency, s->cut, given, chosen.slide, NULL);
    }
    ktg_free(given);
    return status;
}

/* What the model says, what is chosen, and what opens panels to disks. Where nobody said anything
 * and there is something to open, a good choice is better than a short one. */
static ktg_status find_seams(ktg_context *context, ktg_flat_surface *s) {
    const unsigned usual =
        KTG_SEAMS_OBJECTS | KTG_SEAMS_GROUPS | KTG_SEAMS_MATERIALS | KTG_SEAMS_MARKED;
    unsigned seams = s->options->seams;
    KTG_TRY(ktg_seams_given(context, s->mesh, s->adjacency, seams > 0 ? seams : usual,
                            s->options->crease, s->cut));
    uint32_t given = count_cuts(s);
    bool *before = ktg_copy_array(context, s->cut, s->adjacency->edge_count, sizeof *before);
    if (!before)
        return KTG_MEMORY;
    ktg_status status = ktg_seams_open(context, s->mesh, s->adjacency, s->cut);
    uint32_t opened = count_cuts(s) - given;
    bool choose = s->choose || (seams & KTG_SEAMS_AUTO) || (seams == 0 && given == 0 && opened > 0);
    if (status == KTG_OK && choose) {
        memcpy(s->cut, before, s->adjacency->edge_count * sizeof *before);
        status = choose_seams(context, s);
    }
    ktg_free(before);
    s->report->seam_edges = count_cuts(s);
    s->report->opened_edges = choose ? 0 : opened;
    s->chosen = choose;
    s->report->auto_edges = choose ? s->report->seam_edges - given : 0;
    return status;
}

/* ---- panels ------------------------------------------------------------------------------- */

/* What is wrong with a panel is told with its name, where there are others. */
static ktg_status about_panel(ktg_context *context, const ktg_flat_surface *s, uint32_t p,
                              ktg_status status) {
    if (status != KTG_GEOMETRY || s->apart.count == 1)
        return status;
    char *message = ktg_copy_text(context, ktg_context_message(context), SIZE_MAX);
    if (!message)
        return KTG_MEMORY;
    status = ktg_fail(context, status, "panel \"%s\": %s", s->names.text[p], message);
    ktg_free(message);
    return status;
}

static ktg_status open_panel(ktg_context *context, const ktg_cut_panel *from,
                             ktg_flat_panel *flat) {
    KTG_TRY(ktg_panel_new(context, from->mesh, &flat->panel));
    KTG_TRY(ktg_panel_check_disk(context, from->mesh, flat->panel));
    flat->flat = ktg_new(context, flat->panel->vertex_count, ktg_vec2);
    return flat->flat ? KTG_OK : KTG_MEMORY;
}

static ktg_status check_faces(ktg_context *context, const ktg_mesh *mesh) {
    double extent;
    if (mesh->face_count == 0)
        return ktg_fail(context, KTG_GEOMETRY,
                        "there is nothing to flatten: the model has no faces");
    return ktg_mesh_check_extent(context, mesh, &extent);
}

ktg_status ktg_flat_surface_open(ktg_context *context, ktg_flat_surface *s) {
    s->mesh = s->model;
    KTG_TRY(check_faces(context, s->mesh));
    KTG_TRY(ktg_adjacency_new(context, s->mesh, &s->adjacency));
    KTG_TRY(ktg_check_sheet(context, s->mesh, s->adjacency));
    s->cut = ktg_new(context, s->adjacency->edge_count, bool);
    s->face_strain = ktg_new(context, s->mesh->face_count, double);
    if (!s->cut || !s->face_strain)
        return KTG_MEMORY;
    KTG_TRY(find_seams(context, s));
    KTG_TRY(ktg_cut_apart(context, s->mesh, s->adjacency, s->cut, &s->apart));
    KTG_TRY(ktg_panel_names(context, s->mesh, &s->apart, s->name, &s->names));
    s->flats = ktg_new(context, s->apart.count, ktg_flat_panel);
    s->report->panels = ktg_new(context, s->apart.count, ktg_panel_report);
    if (!s->flats || !s->report->panels)
        return KTG_MEMORY;
    s->report->panel_count = s->apart.count;
    for (uint32_t p = 0; p < s->apart.count; p++)
        KTG_TRY(about_panel(context, s, p, open_panel(context, &s->apart.panels[p], &s->flats[p])));
    return KTG_OK;
}

ktg_status ktg_flat_surface_lay(ktg_context *context, ktg_flat_surface *s) {
    for (uint32_t p = 0; p < s->apart.count; p++) {
        ktg_flat_panel *f = &s->flats[p];
        double start = ktg_clock_seconds();
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(about_panel(context, s, p,
                            ktg_lay_flat(context, f->panel, s->options, f->flat, &f->report)));
        f->report.seconds = ktg_clock_seconds() - start;
        s->report->interrupted = s->report->interrupted || ktg_wants_finish(context);
    }
    return KTG_OK;
}

/* ---- what became of them ------------------------------------------------------------------ */

static ktg_status refuse_flipped(ktg_context *context, const ktg_flat_surface *s, uint32_t p,
                                 uint32_t first_flipped) {
    const ktg_panel_report *report = &s->flats[p].report;
    if (report->flipped_faces == 0)
        return KTG_OK;
    return ktg_fail(context, KTG_GEOMETRY,
                    "%u of %u faces (the first is face %u) fold over when the panel is laid flat: "
                    "it is too curved for one piece%s, or has needle-thin faces; cut it into "
                    "flatter panels by seams, or remesh it, first",
                    report->flipped_faces, report->faces,
                    s->apart.panels[p].face[first_flipped] + 1,
                    report->method == KTG_FLATTEN_TWO_STEP ? " by the two-step method" : "");
}

/* Sums to which ktg_panel_report's means are brought; divided by the whole area at the end. */
static void add_to_whole(ktg_panel_report *whole, const ktg_panel_report *panel, double weight) {
    if (panel->method == KTG_FLATTEN_INJECTIVE)
        whole->method = KTG_FLATTEN_INJECTIVE;
    whole->iterations += panel->iterations;
    whole->flipped_by_arap += panel->flipped_by_arap;
    whole->crossed_by_arap = whole->crossed_by_arap || panel->crossed_by_arap;
    whole->faces += panel->faces;
    whole->flipped_faces += panel->flipped_faces;
    whole->area += panel->area;
    whole->arap_energy += weight * panel->arap_energy;
    whole->symmetric_dirichlet += weight * panel->symmetric_dirichlet;
    whole->strain_mean += weight * panel->strain_mean;
    whole->strain_max = fmax(whole->strain_max, panel->strain_max);
    whole->area_beyond_limit += weight * panel->area_beyond_limit;
    if (fabs(panel->border_error) > fabs(whole->border_error))
        whole->border_error = panel->border_error;
    whole->seconds += panel->seconds;
}

/* Areas are weighed in the largest panel's unit, so that no square is too large. */
static int largest_exponent(const ktg_flat_surface *s) {
    int largest = s->flats[0].panel->exponent;
    for (uint32_t p = 1; p < s->apart.count; p++)
        if (s->flats[p].panel->exponent > largest)
            largest = s->flats[p].panel->exponent;
    return largest;
}

static ktg_status sum_up(ktg_context *context, ktg_flat_surface *s) {
    ktg_panel_report *whole = &s->report->whole;
    const int largest = largest_exponent(s);
    double total = 0;
    whole->method = s->options->method;
    for (uint32_t p = 0; p < s->apart.count; p++) {
        int exponent = s->flats[p].panel->exponent;
        double weight = ldexp(s->flats[p].area, 2 * (exponent - largest));
        s->report->panels[p] = s->flats[p].report;
        s->report->panels_beyond += s->flats[p].report.area_beyond_limit > 0.05;
        add_to_whole(whole, &s->flats[p].report, weight);
        total += weight;
    }
    if (s->apart.count == 1) {
        *whole = s->flats[0].report;
        return KTG_OK;
    }
    whole->arap_energy /= total;
    whole->symmetric_dirichlet = whole->flipped_faces > 0 ? 0 : whole->symmetric_dirichlet / total;
    whole->strain_mean /= total;
    whole->area_beyond_limit /= total;
    return ktg_strain_percentile(context, s->mesh, s->face_strain, 0.95, &whole->strain_p95);
}

static ktg_status judge_panel(ktg_context *context, ktg_flat_surface *s, uint32_t p,
                              uint32_t *first_flipped) {
    ktg_flat_panel *f = &s->flats[p];
    double *strain = ktg_new(context, f->panel->face_count, double);
    if (!strain)
        return KTG_MEMORY;
    ktg_status status = ktg_strain_measure(context, f->panel, f->flat, s->options, strain,
                                           &f->report, first_flipped);
    f->area = f->report.area;
    f->report.area = ldexp(f->area, 2 * f->panel->exponent);
    for (uint32_t k = 0; k < f->panel->face_count; k++)
        s->face_strain[s->apart.panels[p].face[k]] = strain[k];
    ktg_free(strain);
    return status;
}

/* All are measured before one is refused, so that the report is whole. */
ktg_status ktg_flat_surface_judge(ktg_context *context, ktg_flat_surface *s) {
    uint32_t *first_flipped = ktg_new(context, s->apart.count, uint32_t);
    ktg_status status = first_flipped ? KTG_OK : KTG_MEMORY;
    for (uint32_t p = 0; status == KTG_OK && p < s->apart.count; p++)
        status = judge_panel(context, s, p, &first_flipped[p]);
    if (status == KTG_OK)
        status = sum_up(context, s);
    for (uint32_t p = 0; status == KTG_OK && p < s->apart.count; p++) {
        status = refuse_flipped(context, s, p, first_flipped[p]);
        if (status == KTG_OK)
            status = ktg_panel_check_overlap(context, s->flats[p].panel, s->flats[p].flat,
                                             s->apart.panels[p].vertex);
        status = about_panel(context, s, p, status);
    }
    ktg_free(first_flipped);
    return status;
}
