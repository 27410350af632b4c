/* mesh/simplify.c - simplification by quadric error (Garland & Heckbert 1997). */
#include "mesh/simplify.h"
#include "core/memory.h"
#include "mesh/intersect.h"
#include "mesh/repair.h"
#include "mesh/weld.h"

#include <string.h>

/* Planes through border edges, across the face, weigh this much more than faces, so that borders
 * keep their shape; those between faces of different objects or materials a little. */
static const double border_weight = 10, seam_weight = 1;

/* The weight of points beside planes: the variance of the normals, as it were. */
static const double point_weight = 1e-3;

static bool differ(const uint32_t *numbers, uint32_t f, uint32_t g) {
    return numbers && numbers[f] != numbers[g];
}

static bool differ_in_colour(const uint8_t *colours, size_t f, size_t g) {
    return colours && memcmp(colours + 3 * f, colours + 3 * g, 3) != 0;
}

/* The edges at a pole differ only there, and weigh nothing. */
static bool is_uv_seam(const ktg_simplify *s, uint32_t h, uint32_t twin) {
    uint32_t a = s->faces[h], b = s->faces[ktg_halfedge_next(h)];
    return ktg_simplify_bond(s, a) != KTG_OFF_SEAM && ktg_simplify_bond(s, b) != KTG_OFF_SEAM &&
           ktg_uv_seam(s, h / 3, twin / 3, a, b);
}

/* The weight of the plane that stands on a half-edge, 0 for none. */
static double standing_weight(const ktg_simplify *s, const ktg_mesh *mesh,
                              const ktg_adjacency *adjacency, uint32_t h) {
    uint32_t twin = adjacency->twin[h], f = h / 3;
    if (twin == KTG_NONE)
        return border_weight;
    bool seam = differ(mesh->face_object, f, twin / 3) || differ(mesh->face_group, f, twin / 3) ||
                differ(mesh->face_material, f, twin / 3) ||
                differ_in_colour(mesh->face_colours, f, twin / 3) || is_uv_seam(s, h, twin);
    return seam ? seam_weight : 0;
}

/* Area-weighted planes of the faces at their vertices, and those that stand on borders and seams.
 */
static void set_quadrics(ktg_simplify *s, const ktg_mesh *mesh, const ktg_adjacency *adjacency) {
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->faces + 3 * (size_t)f;
        ktg_vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = ktg_mul3(ktg_sub3(mesh->positions[corner[k]], s->centre), s->scale);
        ktg_vec3 cross = ktg_cross3(ktg_sub3(p[1], p[0]), ktg_sub3(p[2], p[0]));
        ktg_vec3 normal = ktg_unit3(cross);
        double area = ktg_length3(cross) / 2;
        for (uint32_t k = 0; k < 3; k++) {
            ktg_quadric_add_plane(&s->quadrics[corner[k]], normal, p[k], area);
            ktg_quadric_add_point(&s->quadrics[corner[k]], p[k], point_weight * area);
        }
        for (uint32_t k = 0; k < 3; k++) {
            double weight = standing_weight(s, mesh, adjacency, 3 * f + k);
            ktg_vec3 edge = ktg_sub3(p[(k + 1) % 3], p[k]);
            ktg_vec3 across = ktg_unit3(ktg_cross3(edge, normal));
            weight *= ktg_dot3(edge, edge);
            if (weight > 0) {
                ktg_quadric_add_plane(&s->quadrics[corner[k]], across, p[k], weight);
                ktg_quadric_add_plane(&s->quadrics[corner[(k + 1) % 3]], across, p[k], weight);
            }
        }
    }
}

/* The frame of the quadrics: the middle of the box, and a power of two, so that a model scaled by
 * one gives the same figures. */
static void set_frame(ktg_simplify *s) {
    ktg_box box = {s->positions[0], s->positions[0]};
    int exponent;
    for (uint32_t v = 1; v < s->vertex_count; v++)
        box = ktg_box_join(box, (ktg_box){s->positions[v], s->positions[v]});
    s->centre = ktg_add3(ktg_mul3(box.low, 0.5), ktg_mul3(box.high, 0.5));
    ktg_vec3 half = ktg_sub3(box.high, s->centre);
    (void)frexp(fmax(half.x, fmax(half.y, half.z)), &exponent);
    s->scale = ldexp(1, -exponent);
}

/* OpenMesh says on standard error what it does not like, so it never gets to see it. */
static ktg_status require_manifold(ktg_context *context, const ktg_mesh *mesh) {
    ktg_mesh_report report;
    KTG_TRY(ktg_mesh_check(context, mesh, false, &report));
    if (report.manifold && report.oriented && report.degenerate_faces == 0)
        return KTG_OK;
    return ktg_fail(context, KTG_ARGUMENT,
                    "only an oriented manifold can be simplified, and this mesh has %u edges and "
                    "%u vertices that are not manifold, %u edges between faces turned differently "
                    "and %u degenerate faces: repair it first",
                    report.nonmanifold_edges, report.nonmanifold_vertices, report.misoriented_edges,
                    report.degenerate_faces);
}

static ktg_status prepare(ktg_simplify *s, const ktg_mesh *mesh, uint32_t target_faces) {
    ktg_adjacency *adjacency = NULL;
    s->vertex_count = mesh->vertex_count;
    s->face_count = s->live_faces = mesh->face_count;
    s->positions =
        ktg_copy_array(s->context, mesh->positions, mesh->vertex_count, sizeof *s->positions);
    s->faces =
        ktg_copy_array(s->context, mesh->faces, 3 * (size_t)mesh->face_count, sizeof *s->faces);
    s->alive = ktg_new(s->context, mesh->face_count, bool);
    s->quadrics = ktg_new(s->context, mesh->vertex_count, ktg_quadric);
    s->stamps = ktg_new(s->context, mesh->vertex_count, uint32_t);
    s->border = ktg_new(s->context, mesh->vertex_count, bool);
    s->locked = ktg_new(s->context, mesh->vertex_count, bool);
    if (!s->positions || !s->faces || !s->alive || !s->quadrics || !s->stamps || !s->border ||
        !s->locked)
        return KTG_MEMORY;
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++)
        s->locked[mesh->marked_edges[i]] = true;
    memset(s->alive, true, mesh->face_count);
    KTG_TRY(ktg_simplify_take_colours(s, mesh));
    set_frame(s);
    KTG_TRY(ktg_adjacency_new(s->context, mesh, &adjacency));
    ktg_status status = ktg_halfedges_new(s->context, mesh, &s->halfedges);
    for (uint32_t v = 0; status == KTG_OK && v < mesh->vertex_count; v++)
        s->border[v] = ktg_halfedges_is_border(s->halfedges, v);
    if (status == KTG_OK)
        status = ktg_simplify_take_uvs(s, mesh, adjacency, target_faces);
    set_quadrics(s, mesh, adjacency);
    ktg_adjacency_free(&adjacency);
    return status == KTG_OK ? ktg_simplify_box_faces(s) : status;
}

static void keep_numbers(uint32_t *numbers, uint32_t at, uint32_t from) {
    if (numbers)
        numbers[at] = numbers[from];
}

/* Writes the surviving faces and their vertices into the mesh, both in their old order. */
static ktg_status write_back(const ktg_simplify *s, ktg_mesh *mesh, uint32_t *lost) {
    uint32_t *renamed = ktg_new(s->context, s->vertex_count, uint32_t), faces = 0, vertices = 0;
    ktg_status status = renamed ? ktg_simplify_give_uvs(s, mesh, lost) : KTG_MEMORY;
    if (status != KTG_OK) {
        ktg_free(renamed);
        return status;
    }
    for (uint32_t f = 0; f < s->face_count; f++)
        for (size_t k = 0; k < 3 && s->alive[f]; k++)
            renamed[s->faces[3 * (size_t)f + k]] = 1;
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++)
        renamed[mesh->marked_edges[i]] = 1;
    for (uint32_t v = 0; v < s->vertex_count; v++)
        if (renamed[v]) {
            mesh->positions[vertices] = s->positions[v];
            ktg_simplify_give_colour(s, v, mesh, vertices);
            renamed[v] = vertices++;
        }
    for (uint32_t f = 0; f < s->face_count; f++) {
        if (!s->alive[f])
            continue;
        for (size_t k = 0; k < 3; k++)
            mesh->faces[3 * (size_t)faces + k] = renamed[s->faces[3 * (size_t)f + k]];
        keep_numbers(mesh->face_object, faces, f);
        keep_numbers(mesh->face_group, faces, f);
        keep_numbers(mesh->face_material, faces, f);
        if (mesh->face_colours)
            memmove(mesh->face_colours + 3 * (size_t)faces, mesh->face_colours + 3 * (size_t)f, 3);
        faces++;
    }
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++)
        mesh->marked_edges[i] = renamed[mesh->marked_edges[i]];
    mesh->face_count = faces;
    mesh->vertex_count = vertices;
    ktg_free(renamed);
    return KTG_OK;
}

/* What does not survive a change of the surface. */
static void drop_fine_print(ktg_mesh *mesh) {
    ktg_free(mesh->face_polygon);
    mesh->face_polygon = NULL;
}

/* The rules let no intersection in; this says so by other means, before anything is changed. */
static ktg_status prove(const ktg_simplify *s, const ktg_mesh *before) {
    ktg_mesh after = {.vertex_count = s->vertex_count, .positions = s->positions};
    uint32_t pairs_after = 0, pairs_before = 0;
    after.faces = ktg_new(s->context, 3 * (size_t)s->live_faces, uint32_t);
    if (!after.faces)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < s->face_count; f++)
        if (s->alive[f])
            memcpy(after.faces + 3 * (size_t)after.face_count++, s->faces + 3 * (size_t)f,
                   3 * sizeof *s->faces);
    ktg_status status = ktg_mesh_intersections(s->context, &after, &pairs_after);
    if (status == KTG_OK && pairs_after > 0)
        status = ktg_mesh_intersections(s->context, before, &pairs_before);
    if (status == KTG_OK && pairs_after > pairs_before)
        status = ktg_fail(s->context, KTG_INTERNAL,
                          "simplification made %u pairs of faces intersect, %u did before",
                          pairs_after, pairs_before);
    ktg_free(after.faces);
    return status;
}

static void free_state(ktg_simplify *s) {
    ktg_halfedges_free(&s->halfedges);
    ktg_boxes_free(&s->boxes);
    ktg_free(s->positions);
    ktg_free(s->faces);
    ktg_free(s->alive);
    ktg_free(s->quadrics);
    ktg_free(s->stamps);
    ktg_free(s->border);
    ktg_free(s->locked);
    ktg_free(s->colours);
    ktg_simplify_free_uvs(s);
    ktg_free(s->heap);
    ktg_free(s->changed);
    ktg_free(s->found);
    ktg_free(s->shapes);
    ktg_free(s->outlines);
}

ktg_status ktg_mesh_simplify(ktg_context *context, ktg_mesh *mesh, uint32_t target_faces,
                             ktg_simplify_report *report) {
    ktg_simplify s = {.context = context};
    uint32_t before = mesh->face_count, lost = 0;
    ktg_status status = KTG_OK;
    if (before > target_faces) {
        status = require_manifold(context, mesh);
        if (status == KTG_OK)
            status = prepare(&s, mesh, target_faces);
        if (status == KTG_OK)
            status = ktg_simplify_run(&s, target_faces);
        if (status == KTG_OK && s.live_faces < before)
            status = prove(&s, mesh);
        if (status == KTG_OK && s.live_faces < before)
            status = ktg_simplify_refine_uvs(&s);
        if (status == KTG_OK && s.live_faces < before)
            status = write_back(&s, mesh, &lost);
        if (status == KTG_OK && s.live_faces < before)
            drop_fine_print(mesh);
    }
    if (report)
        *report = (ktg_simplify_report){before, mesh->face_count,
                                        status == KTG_OK && mesh->face_count <= target_faces, lost};
    free_state(&s);
    return status;
}
