/* mesh/intersect.c - triangles that cut each other: shared corners, a quick filter, all pairs. */
#include "mesh/intersect.h"
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/boxes.h"
#include "mesh/weld.h"

static double largest(ktg_vec3 v) {
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

/* The side of the plane of q on which point p certainly lies: +1, -1, or 0 for "not sure". The
 * determinant has six products of three differences; its rounding error stays well below 1e-14
 * times the largest of them. */
static int certain_side(const ktg_vec3 q[3], ktg_vec3 p) {
    ktg_vec3 u = ktg_sub3(q[1], q[0]), v = ktg_sub3(q[2], q[0]), w = ktg_sub3(p, q[0]);
    double det = ktg_dot3(ktg_cross3(u, v), w);
    double bound = 1e-14 * largest(u) * largest(v) * largest(w);
    return det > bound ? 1 : det < -bound ? -1 : 0;
}

/* All `count` points lie on one side of the plane of q, certainly. */
static bool apart(const ktg_vec3 q[3], const ktg_vec3 *points, int count) {
    int side = certain_side(q, points[0]);
    for (int i = 1; i < count && side != 0; i++)
        if (certain_side(q, points[i]) != side)
            return false;
    return side != 0;
}

/* Puts the corners that p and q share first, in the same order in both; returns how many. */
static int shared_first(const ktg_vec3 p[3], const ktg_vec3 q[3], ktg_vec3 a[3], ktg_vec3 b[3]) {
    bool used_p[3] = {false, false, false}, used_q[3] = {false, false, false};
    int shared = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3 && !used_p[i]; j++)
            if (!used_q[j] && p[i].x == q[j].x && p[i].y == q[j].y && p[i].z == q[j].z) {
                a[shared] = p[i];
                b[shared++] = q[j];
                used_p[i] = used_q[j] = true;
            }
    for (int i = 0, at_a = shared, at_b = shared; i < 3; i++) {
        if (!used_p[i])
            a[at_a++] = p[i];
        if (!used_q[i])
            b[at_b++] = q[i];
    }
    return shared;
}

bool ktg_triangles_intersect(const ktg_vec3 p[3], const ktg_vec3 q[3]) {
    ktg_vec3 a[3], b[3];
    int shared = shared_first(p, q, a, b);
    if (shared == 3)
        return true;
    if (apart(b, a + shared, 3 - shared) || apart(a, b + shared, 3 - shared))
        return false;
    if (shared == 2)
        return ktg_exact_folded(a[0], a[1], a[2], b[2]);
    if (shared == 1) /* the edge across from the corner has to reach the other triangle */
        return ktg_exact_segment_meets(a[1], a[2], b) || ktg_exact_segment_meets(b[1], b[2], a);
    return ktg_exact_triangles_meet(a, b);
}

typedef struct pairs_work {
    uint32_t count, *faces, *first, *found;
    size_t capacity;
    ktg_box *boxes;
    ktg_boxes *tree;
} pairs_work;

static void face_corners(const ktg_mesh *mesh, uint32_t face, ktg_vec3 corners[3]) {
    for (int k = 0; k < 3; k++)
        corners[k] = mesh->positions[mesh->faces[3 * (size_t)face + k]];
}

static ktg_status collect(ktg_context *context, const ktg_mesh *mesh, pairs_work *w) {
    w->faces = ktg_new(context, mesh->face_count, uint32_t);
    w->boxes = ktg_new(context, mesh->face_count, ktg_box);
    if (!w->faces || !w->boxes)
        return KTG_MEMORY;
    KTG_TRY(ktg_mesh_weld(context, mesh->positions, mesh->vertex_count, &w->first));
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        if (ktg_mesh_is_degenerate(mesh, f, w->first))
            continue;
        ktg_vec3 c[3];
        face_corners(mesh, f, c);
        w->boxes[w->count] = ktg_box_of(c[0], c[1], c[2]);
        w->faces[w->count++] = f;
    }
    return ktg_boxes_new(context, w->boxes, NULL, w->count, w->count, &w->tree);
}

static ktg_status count_pairs(ktg_context *context, const ktg_mesh *mesh, pairs_work *w,
                              uint32_t *pairs) {
    for (uint32_t i = 0; i < w->count; i++) {
        size_t count;
        ktg_vec3 p[3], q[3];
        if (i % 1024 == 0)
            KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(ktg_boxes_query(context, w->tree, w->boxes[i], SIZE_MAX, &w->found, &w->capacity,
                                &count));
        face_corners(mesh, w->faces[i], p);
        for (size_t k = 0; k < count; k++) {
            if (w->found[k] <= i)
                continue;
            face_corners(mesh, w->faces[w->found[k]], q);
            *pairs += ktg_triangles_intersect(p, q);
            if (*pairs == KTG_MESH_MOST_INTERSECTIONS)
                return KTG_OK;
        }
    }
    return KTG_OK;
}

ktg_status ktg_mesh_intersections(ktg_context *context, const ktg_mesh *mesh, uint32_t *pairs) {
    pairs_work work = {0};
    *pairs = 0;
    ktg_status status = collect(context, mesh, &work);
    if (status == KTG_OK)
        status = count_pairs(context, mesh, &work, pairs);
    ktg_free(work.faces);
    ktg_free(work.first);
    ktg_free(work.found);
    ktg_free(work.boxes);
    ktg_boxes_free(&work.tree);
    return status;
}
