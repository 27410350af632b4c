/* flatten/strain.c - how much the flat shape strains each face: singular values, ARAP energy,
 * strain, length of the border.
 *
 * The energy is that of Liu et al. 2008: sum A ((s1 - 1)^2 + (s2 - 1)^2) / sum A, with signed
 * singular values. */
#include "core/memory.h"
#include "core/predicate.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>
#include <stdlib.h>

/* With the map as J = conformal + anticonformal part, z -> p z + q conj(z): s1, s2 = |p| +- |q|. */
static void set_singular_values(ktg_face_map *map) {
    ktg_vec2 a = map->columns[0], b = map->columns[1];
    double conformal = hypot(a.x + b.y, a.y - b.x) / 2;
    double anticonformal = hypot(a.x - b.y, a.y + b.x) / 2;
    map->s1 = conformal + anticonformal;
    map->s2 = conformal - anticonformal;
}

ktg_face_map ktg_face_map_of(const ktg_panel *panel, uint32_t face, const ktg_vec2 *flat) {
    const uint32_t *v = panel->faces + 3 * (size_t)face;
    const ktg_vec3 *p = panel->positions;
    ktg_vec3 along = ktg_sub3(p[v[1]], p[v[0]]), third = ktg_sub3(p[v[2]], p[v[0]]);
    ktg_vec3 normal = ktg_cross3(along, third);
    double length = ktg_length3(along), height = ktg_length3(normal) / length;
    ktg_face_map map = {.area = length * height / 2};
    map.frame[0] = ktg_mul3(along, 1 / length);
    map.frame[1] = ktg_unit3(ktg_cross3(normal, along));
    map.columns[0] = ktg_mul2(ktg_sub2(flat[v[1]], flat[v[0]]), 1 / length);
    ktg_vec2 above =
        ktg_madd2(ktg_sub2(flat[v[2]], flat[v[0]]), -ktg_dot3(third, map.frame[0]), map.columns[0]);
    map.columns[1] = ktg_mul2(above, 1 / height);
    set_singular_values(&map);
    return map;
}

ktg_vec2 ktg_face_map_direction(const ktg_face_map *map, ktg_vec3 direction) {
    ktg_vec2 image = ktg_mul2(map->columns[0], ktg_dot3(direction, map->frame[0]));
    return ktg_madd2(image, ktg_dot3(direction, map->frame[1]), map->columns[1]);
}

/* The relative change of the border's length. */
static double border_error(const ktg_panel *panel, const ktg_vec2 *flat) {
    double length_2d = 0, length_3d = 0;
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++) {
        if (panel->adjacency->twin[h] != KTG_NONE)
            continue;
        uint32_t a = panel->faces[h], b = panel->faces[ktg_halfedge_next(h)];
        length_2d += ktg_length2(ktg_sub2(flat[b], flat[a]));
        length_3d += ktg_length3(ktg_sub3(panel->positions[b], panel->positions[a]));
    }
    return (length_2d - length_3d) / length_3d;
}

typedef struct strained_area {
    double strain, area;
} strained_area;

static int by_strain(const void *a, const void *b) {
    double x = ((const strained_area *)a)->strain, y = ((const strained_area *)b)->strain;
    return (x > y) - (x < y);
}

/* The strain that `part` of the area does not exceed; sorts. */
static double percentile(strained_area *areas, uint32_t count, double part, double total) {
    qsort(areas, count, sizeof *areas, by_strain);
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        sum += areas[i].area;
        if (sum >= part * total)
            return areas[i].strain;
    }
    return areas[count - 1].strain;
}

/* Below this part of its area a face of the finished shape counts as flipped: later roundings might
 * turn it over. */
static const double least_area = 1e-6;

static bool is_flipped(const ktg_panel *panel, uint32_t face, double part_of_area, double least,
                       const ktg_vec2 *flat) {
    const uint32_t *v = panel->faces + 3 * (size_t)face;
    return !(part_of_area > least && part_of_area < INFINITY) ||
           ktg_orientation2(flat[v[0]], flat[v[1]], flat[v[2]]) <= 0;
}

static uint32_t count_flipped(const ktg_panel *panel, const ktg_vec2 *flat, double least) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        ktg_face_map map = ktg_face_map_of(panel, f, flat);
        count += is_flipped(panel, f, map.s1 * map.s2, least, flat);
    }
    return count;
}

uint32_t ktg_panel_count_flipped(const ktg_panel *panel, const ktg_vec2 *flat) {
    return count_flipped(panel, flat, least_area);
}

uint32_t ktg_panel_count_turned_over(const ktg_panel *panel, const ktg_vec2 *flat) {
    return count_flipped(panel, flat, 0);
}

static void clear_figures(const ktg_panel *panel, ktg_panel_report *r) {
    r->faces = panel->face_count;
    r->flipped_faces = 0;
    r->arap_energy = r->symmetric_dirichlet = 0;
    r->strain_mean = r->strain_max = r->area_beyond_limit = 0;
}

static bool is_beyond(const ktg_flatten_options *options, const ktg_face_map *map, double strain) {
    return options->fabric ? !ktg_fabric_bears(options->fabric, map)
                           : strain > options->strain_limit;
}

static void add_face(ktg_face_map map, const ktg_flatten_options *options, ktg_panel_report *report,
                     strained_area *strained) {
    double d1 = map.s1 - 1, d2 = map.s2 - 1;
    double strain = fmax(fabs(d1), fabs(d2)), square = map.s1 * map.s1 + map.s2 * map.s2;
    *strained = (strained_area){strain, map.area};
    report->arap_energy += map.area * (d1 * d1 + d2 * d2);
    report->symmetric_dirichlet +=
        map.area * (square + square / (map.s1 * map.s1 * map.s2 * map.s2));
    report->strain_mean += map.area * strain;
    report->strain_max = fmax(report->strain_max, strain);
    if (is_beyond(options, &map, strain))
        report->area_beyond_limit += map.area;
}

ktg_status ktg_strain_percentile(ktg_context *context, const ktg_mesh *mesh,
                                 const double *face_strain, double part, double *strain) {
    strained_area *areas = ktg_new(context, mesh->face_count, strained_area);
    if (!areas)
        return KTG_MEMORY;
    double total = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *v = mesh->faces + 3 * (size_t)f;
        const ktg_vec3 *p = mesh->positions;
        ktg_vec3 normal = ktg_cross3(ktg_sub3(p[v[1]], p[v[0]]), ktg_sub3(p[v[2]], p[v[0]]));
        areas[f] = (strained_area){face_strain[f], ktg_length3(normal)};
        total += areas[f].area;
    }
    *strain = percentile(areas, mesh->face_count, part, total);
    ktg_free(areas);
    return KTG_OK;
}

ktg_status ktg_strain_measure(ktg_context *context, const ktg_panel *panel, const ktg_vec2 *flat,
                              const ktg_flatten_options *options, double *face_strain,
                              ktg_panel_report *report, uint32_t *first_flipped) {
    strained_area *areas = ktg_new(context, panel->face_count, strained_area);
    if (!areas)
        return KTG_MEMORY;
    double total = 0;
    clear_figures(panel, report);
    *first_flipped = KTG_NONE;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        ktg_face_map map = ktg_face_map_of(panel, f, flat);
        add_face(map, options, report, &areas[f]);
        total += areas[f].area;
        if (face_strain)
            face_strain[f] = areas[f].strain;
        if (is_flipped(panel, f, map.s1 * map.s2, least_area, flat) && report->flipped_faces++ == 0)
            *first_flipped = f;
    }
    report->symmetric_dirichlet =
        report->flipped_faces > 0 ? 0 : report->symmetric_dirichlet / total;
    report->area = total;
    report->area_beyond_limit /= total;
    report->arap_energy /= total;
    report->strain_mean /= total;
    report->strain_p95 = percentile(areas, panel->face_count, 0.95, total);
    report->border_error = border_error(panel, flat);
    ktg_free(areas);
    return KTG_OK;
}
