/* deform/measure.c - what came out: stretch, faces turned over, what should have kept its shape. */
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

static const double least_area = 1e-3;   /* of what it was: degenerate */
static const double without_area = 1e-9; /* of its longest side's square: was so before */

/* Both shapes, in the mesh's unit. */
typedef struct shapes {
    const ktg_deform *d;
    const ktg_vec3 *before, *after;
    ktg_deform_report *report;
} shapes;

static double distance(const ktg_vec3 *p, uint32_t a, uint32_t b) {
    return ktg_length3(ktg_sub3(p[a], p[b]));
}

static double scale_of(const shapes *s, uint32_t vertex) {
    return s->d->log_scale ? exp(s->d->log_scale[vertex]) : 1;
}

static void measure_edges(const shapes *s) {
    const ktg_frame *frame = s->d->frame;
    s->report->stretch_min = INFINITY;
    s->report->stretch_max = 0;
    for (uint32_t e = 0; e < frame->adjacency->edge_count; e++) {
        uint32_t ends[2];
        ktg_edge_ends(frame->mesh, frame->adjacency, e, ends);
        double before = distance(s->before, ends[0], ends[1]);
        if (!(before > 0))
            continue;
        double stretch = distance(s->after, ends[0], ends[1]) / before;
        s->report->stretch_min = ktg_min(s->report->stretch_min, stretch);
        s->report->stretch_max = ktg_max(s->report->stretch_max, stretch);
    }
    if (s->report->stretch_max == 0)
        s->report->stretch_min = s->report->stretch_max = 1;
}

static ktg_vec3 area_vector(const ktg_vec3 *p, const uint32_t *c) {
    return ktg_mul3(ktg_cross3(ktg_sub3(p[c[1]], p[c[0]]), ktg_sub3(p[c[2]], p[c[0]])), 0.5);
}

static void measure_face(const shapes *s, const uint32_t *c) {
    ktg_vec3 before = area_vector(s->before, c), after = area_vector(s->after, c);
    double longest = fmax(distance(s->before, c[0], c[1]),
                          fmax(distance(s->before, c[1], c[2]), distance(s->before, c[2], c[0])));
    double area = ktg_length3(before), scale = scale_of(s, c[0]);
    if (!(area > without_area * longest * longest))
        return;
    ktg_vec3 turned = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        turned = ktg_add3(turned, ktg_turn_apply(s->d->turns[c[k]], before));
    if (!(ktg_length3(after) >= least_area * scale * scale * area))
        s->report->degenerate_faces++;
    else if (ktg_dot3(after, turned) < 0)
        s->report->flipped_faces++;
}

/* Distances in each body: from its pivot, and from the member before. */
static ktg_status measure_bodies(ktg_context *context, const shapes *s) {
    const ktg_bodies *b = s->d->bodies;
    double *radius = ktg_new(context, b->vertex_count, double);
    double *error = ktg_new(context, b->vertex_count, double);
    uint32_t *last = ktg_new(context, b->vertex_count, uint32_t);
    ktg_status status = radius && error && last ? KTG_OK : KTG_MEMORY;
    for (uint32_t v = 0; status == KTG_OK && v < b->vertex_count; v++) {
        uint32_t root = ktg_set_of(b->parent, v), pivot = b->pivot[root];
        uint32_t others[2] = {pivot, v == root ? pivot : last[root]};
        for (int k = 0; k < 2; k++) {
            double before = scale_of(s, root) * distance(s->before, v, others[k]);
            double change = fabs(distance(s->after, v, others[k]) - before);
            radius[root] = ktg_max(radius[root], before);
            error[root] = ktg_max(error[root], change);
        }
        last[root] = v;
    }
    for (uint32_t v = 0; status == KTG_OK && v < b->vertex_count; v++)
        if (radius[v] > 0)
            s->report->feature_error = ktg_max(s->report->feature_error, error[v] / radius[v]);
    ktg_free(radius);
    ktg_free(error);
    ktg_free(last);
    return status;
}

static ktg_vec3 gap_of(const ktg_follower *f, const ktg_vec3 *p) {
    ktg_vec3 gap = p[f->vertex];
    for (int k = 0; k < 3 && f->masters[k] != KTG_NONE; k++)
        gap = ktg_madd3(gap, -f->weights[k], p[f->masters[k]]);
    return gap;
}

static void measure_links(const shapes *s) {
    const ktg_bodies *b = s->d->bodies;
    for (uint32_t i = 0; i < b->pair_count; i++) {
        ktg_pair p = b->pairs[i];
        double before = scale_of(s, p.from) * distance(s->before, p.from, p.to);
        s->report->link_error =
            ktg_max(s->report->link_error, fabs(distance(s->after, p.from, p.to) - before));
    }
    for (uint32_t i = 0; i < b->follower_count; i++) {
        const ktg_follower *f = &b->followers[i];
        double before = scale_of(s, f->vertex) * ktg_length3(gap_of(f, s->before));
        double after = ktg_length3(gap_of(f, s->after));
        s->report->link_error = ktg_max(s->report->link_error, fabs(after - before));
    }
}

ktg_status ktg_deform_measure(ktg_context *context, const ktg_deform *d, const ktg_vec3 *positions,
                              ktg_deform_report *report) {
    const ktg_mesh *mesh = d->frame->mesh;
    *report = (ktg_deform_report){.vertices = mesh->vertex_count,
                                  .faces = mesh->face_count,
                                  .components = d->frame->component_count,
                                  .unknowns = ktg_system_unknowns(d->system),
                                  .vertex_links = d->bodies->pair_count,
                                  .follower_links = d->bodies->follower_count,
                                  .links_left_out = d->bodies->left_out,
                                  .steps = d->steps};
    shapes s = {d, mesh->positions, positions, report};
    measure_edges(&s);
    for (size_t f = 0; f < mesh->face_count; f++)
        measure_face(&s, mesh->faces + 3 * f);
    measure_links(&s);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        report->moved = ktg_max(report->moved, ktg_length3(ktg_sub3(positions[v], s.before[v])));
    return measure_bodies(context, &s);
}
