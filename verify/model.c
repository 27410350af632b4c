/* verify/model.c - the pattern's surface against the model it was made from.
 *
 * Not simplified: equal up to one similarity without reflection. Where faces and vertices stand in
 * the same order (as this program writes them) it is found in closed form (Horn 1987, with unit
 * quaternions); where they do not, vertices are matched by their places, in the model's own frame.
 * Simplified: the Hausdorff distance is measured, not judged. */
#include "core/memory.h"
#include "verify/check.h"

#include <stdlib.h>
#include <string.h>

/* ---- Horn's similarity -------------------------------------------------------------------- */

typedef struct similarity {
    double scale, turn[3][3];
    ktg_vec3 from, to; /* p -> to + scale turn (p - from) */
} similarity;

static ktg_vec3 apply(const similarity *s, ktg_vec3 p) {
    ktg_vec3 d = ktg_sub3(p, s->from);
    const double(*r)[3] = s->turn;
    ktg_vec3 turned = {r[0][0] * d.x + r[0][1] * d.y + r[0][2] * d.z,
                       r[1][0] * d.x + r[1][1] * d.y + r[1][2] * d.z,
                       r[2][0] * d.x + r[2][1] * d.y + r[2][2] * d.z};
    return ktg_madd3(s->to, s->scale, turned);
}

/* One Jacobi rotation that clears a[p][q] of a symmetric matrix; v collects them. */
static void rotate(double a[4][4], double v[4][4], int p, int q) {
    double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 4; k++) {
        double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 4; k++) {
        double pk = a[p][k], qk = a[q][k], vp = v[k][p], vq = v[k][q];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        v[k][p] = c * vp - s * vq;
        v[k][q] = s * vp + c * vq;
    }
}

/* The eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix. */
static void largest_eigenvector(double a[4][4], double w[4]) {
    double v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    int best = 0;
    for (int sweep = 0; sweep < 30; sweep++)
        for (int p = 0; p < 4; p++)
            for (int q = p + 1; q < 4; q++)
                if (a[p][q] != 0)
                    rotate(a, v, p, q);
    for (int k = 1; k < 4; k++)
        best = a[k][k] > a[best][best] ? k : best;
    for (int k = 0; k < 4; k++)
        w[k] = v[k][best];
}

/* From the sums m[i][j] of (model coordinate i) x (surface coordinate j) about the centroids. */
static void turn_of(double m[3][3], double r[3][3]) {
    double n[4][4] = {
        {m[0][0] + m[1][1] + m[2][2], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]},
        {m[1][2] - m[2][1], m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[2][0] + m[0][2]},
        {m[2][0] - m[0][2], m[0][1] + m[1][0], m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]},
        {m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], m[2][2] - m[0][0] - m[1][1]}};
    double w[4];
    largest_eigenvector(n, w);
    double a = w[0], b = w[1], c = w[2], d = w[3];
    double rows[3][3] = {{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
                         {2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)},
                         {2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d}};
    memcpy(r, rows, sizeof rows);
}

/* Over the corners of all faces, so that vertices no face uses have no say. */
static similarity fit(const ktg_check *check, const ktg_mesh *model) {
    const ktg_pattern *p = check->pattern;
    similarity s = {0};
    size_t count = 3 * (size_t)p->face_count;
    double sums[3][3] = {{0}}, of_model = 0, of_surface = 0;
    for (size_t i = 0; i < count; i++) {
        s.from = ktg_madd3(s.from, 1.0 / (double)count, model->positions[model->faces[i]]);
        s.to = ktg_madd3(s.to, 1.0 / (double)count, p->vertices[model->faces[i]]);
    }
    for (size_t i = 0; i < count; i++) {
        ktg_vec3 a = ktg_sub3(model->positions[model->faces[i]], s.from);
        ktg_vec3 b = ktg_sub3(p->vertices[model->faces[i]], s.to);
        double from[3] = {a.x, a.y, a.z}, to[3] = {b.x, b.y, b.z};
        for (int k = 0; k < 9; k++)
            sums[k / 3][k % 3] += from[k / 3] * to[k % 3];
        of_model += ktg_dot3(a, a);
        of_surface += ktg_dot3(b, b);
    }
    double scale = of_model > 0 ? sqrt(of_surface / of_model) : 1;
    s.scale = p->mm_per_unit > 0 ? p->mm_per_unit : scale;
    turn_of(sums, s.turn);
    return s;
}

static void compare_in_order(ktg_check *check, const ktg_mesh *model) {
    const ktg_pattern *p = check->pattern;
    similarity s = fit(check, model);
    double most = 0;
    uint32_t worst = 0;
    for (size_t i = 0; i < 3 * (size_t)p->face_count; i++) {
        double distance = ktg_check_distance3(apply(&s, model->positions[model->faces[i]]),
                                              p->vertices[model->faces[i]]);
        if (!(distance <= most)) {
            most = distance;
            worst = model->faces[i];
        }
    }
    check->report->model_error = most / check->diagonal;
    if (!(check->report->model_error <= KTG_VERIFY_REFOLD))
        ktg_check_problem(check,
                          "The surface is not the model: at %.9g mm per unit vertex %u is "
                          "%.3g of the diagonal off.",
                          s.scale, worst, check->report->model_error);
}

/* ---- another order ------------------------------------------------------------------------ */

/* A vertex of the model in the surface's scale and frame, and its place along one direction. */
typedef struct placed {
    double along;
    uint32_t vertex;
    ktg_vec3 at;
} placed;

static double along_direction(ktg_vec3 p) {
    return 0.6173 * p.x + 0.3711 * p.y + 0.6937 * p.z; /* no model is flat across this */
}

static int by_place(const void *a, const void *b) {
    const placed *p = a, *q = b;
    if (p->along != q->along)
        return p->along < q->along ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* The first of the model's vertices that is at p; KTG_NONE if none is. */
static uint32_t vertex_at(const placed *sorted, size_t count, ktg_vec3 p, double near) {
    size_t low = 0, high = count;
    double along = along_direction(p);
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (sorted[middle].along < along - 2 * near)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < count && sorted[low].along <= along + 2 * near; low++)
        if (ktg_check_distance3(sorted[low].at, p) <= near)
            return (uint32_t)low;
    return KTG_NONE;
}

/* Three places in the sorted list, the smallest first, in the face's direction. */
typedef struct corners {
    uint32_t c[3], face;
} corners;

static corners corners_of(const uint32_t *places, uint32_t face) {
    int k = places[0] <= places[1] && places[0] <= places[2] ? 0 : places[1] <= places[2] ? 1 : 2;
    return (corners){{places[k], places[(k + 1) % 3], places[(k + 2) % 3]}, face};
}

static int by_corners(const void *a, const void *b) {
    const corners *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->c[k] != q->c[k])
            return p->c[k] < q->c[k] ? -1 : 1;
    return 0;
}

static void compare_faces(ktg_check *check, corners *surface, corners *model) {
    size_t count = check->pattern->face_count;
    qsort(surface, count, sizeof *surface, by_corners);
    qsort(model, count, sizeof *model, by_corners);
    for (size_t i = 0; i < count; i++)
        if (by_corners(&surface[i], &model[i]) != 0) {
            ktg_check_problem(check,
                              "The surface is not the model: face %u of the surface has no "
                              "partner there.",
                              surface[i].face);
            return;
        }
}

static ktg_status place_model(ktg_check *check, const ktg_mesh *model, placed **list) {
    const ktg_pattern *p = check->pattern;
    ktg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    ktg_vec3 target = low;
    *list = ktg_new(check->context, model->vertex_count, placed);
    if (!*list)
        return KTG_MEMORY;
    for (size_t i = 0; i < 3 * (size_t)p->face_count; i++) {
        ktg_vec3 v = p->vertices[p->faces[i]], m = model->positions[model->faces[i]];
        target = (ktg_vec3){fmin(target.x, v.x), fmin(target.y, v.y), fmin(target.z, v.z)};
        low = (ktg_vec3){fmin(low.x, m.x), fmin(low.y, m.y), fmin(low.z, m.z)};
        high = (ktg_vec3){fmax(high.x, m.x), fmax(high.y, m.y), fmax(high.z, m.z)};
    }
    double size = ktg_check_distance3(low, high);
    double scale = p->mm_per_unit > 0 ? p->mm_per_unit : size > 0 ? check->diagonal / size : 1;
    for (uint32_t i = 0; i < model->vertex_count; i++) {
        ktg_vec3 at = ktg_madd3(target, scale, ktg_sub3(model->positions[i], low));
        (*list)[i] = (placed){along_direction(at), i, at};
    }
    qsort(*list, model->vertex_count, sizeof **list, by_place);
    return KTG_OK;
}

/* places[3 count]: where each corner's position is in the sorted list. */
static bool find_places(ktg_check *check, const placed *list, size_t list_count,
                        const ktg_vec3 *positions, const uint32_t *faces, uint32_t *places) {
    double near = KTG_VERIFY_REFOLD * check->diagonal;
    for (size_t i = 0; i < 3 * (size_t)check->pattern->face_count; i++) {
        places[i] = vertex_at(list, list_count, positions[faces[i]], near);
        if (places[i] == KTG_NONE) {
            ktg_check_problem(check,
                              "The surface is not the model: no vertex of the model is "
                              "where vertex %u of the surface is.",
                              faces[i]);
            return false;
        }
        check->report->model_error =
            fmax(check->report->model_error,
                 ktg_check_distance3(list[places[i]].at, positions[faces[i]]) / check->diagonal);
    }
    return true;
}

/* The model's own corners go through the same search, so that coincident vertices are one. */
static ktg_status compare_by_place(ktg_check *check, const ktg_mesh *model) {
    const ktg_pattern *p = check->pattern;
    size_t count = 3 * (size_t)p->face_count;
    placed *list = NULL;
    uint32_t *places = ktg_new(check->context, count, uint32_t);
    corners *surface = ktg_new(check->context, p->face_count, corners);
    corners *other = ktg_new(check->context, p->face_count, corners);
    ktg_vec3 *moved = ktg_new(check->context, model->vertex_count, ktg_vec3);
    ktg_status status = places && surface && other && moved ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = place_model(check, model, &list);
    for (uint32_t i = 0; status == KTG_OK && i < model->vertex_count; i++)
        moved[list[i].vertex] = list[i].at;
    bool found = status == KTG_OK &&
                 find_places(check, list, model->vertex_count, p->vertices, p->faces, places);
    for (uint32_t f = 0; found && f < p->face_count; f++)
        surface[f] = corners_of(places + 3 * (size_t)f, f);
    found = found && find_places(check, list, model->vertex_count, moved, model->faces, places);
    for (uint32_t f = 0; found && f < p->face_count; f++)
        other[f] = corners_of(places + 3 * (size_t)f, f);
    if (found)
        compare_faces(check, surface, other);
    ktg_free(list);
    ktg_free(places);
    ktg_free(surface);
    ktg_free(other);
    ktg_free(moved);
    return status;
}

/* ---- the choice --------------------------------------------------------------------------- */

static bool same_order(const ktg_pattern *p, const ktg_mesh *model) {
    return p->vertex_count == model->vertex_count &&
           memcmp(p->faces, model->faces, 3 * (size_t)p->face_count * sizeof *p->faces) == 0;
}

static ktg_status measure_distance(ktg_check *check, const ktg_mesh *model) {
    const ktg_pattern *p = check->pattern;
    double scale = p->mm_per_unit > 0 ? p->mm_per_unit : 1;
    ktg_vec3 *positions = ktg_new(check->context, model->vertex_count, ktg_vec3);
    if (!positions)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < model->vertex_count; i++)
        positions[i] = ktg_mul3(model->positions[i], scale);
    ktg_mesh scaled = {.vertex_count = model->vertex_count,
                       .face_count = model->face_count,
                       .positions = positions,
                       .faces = model->faces};
    ktg_mesh surface = {.vertex_count = p->vertex_count,
                        .face_count = p->face_count,
                        .positions = p->vertices,
                        .faces = p->faces};
    ktg_status status =
        ktg_mesh_hausdorff(check->context, &surface, &scaled, 0, &check->report->hausdorff_mm);
    ktg_free(positions);
    return status;
}

ktg_status ktg_check_model(ktg_check *check, const ktg_mesh *model) {
    const ktg_pattern *p = check->pattern;
    check->report->model_compared = true;
    if (p->simplified)
        return measure_distance(check, model);
    if (p->face_count != model->face_count)
        ktg_check_problem(check, "The surface is not the model: it has %u faces, the model has %u.",
                          p->face_count, model->face_count);
    else if (same_order(p, model))
        compare_in_order(check, model);
    else
        return compare_by_place(check, model);
    return KTG_OK;
}
