/* mesh/hausdorff.c - the symmetric Hausdorff distance of two surfaces, from samples. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/closest.h"

/* More samples than this take longer than anybody waits. */
static const double most_samples = 2e8;

/* A face is cut along its edges into so many parts that no point is further than `spacing` from a
 * corner of a part: in a triangle of longest edge L that distance is at most L / sqrt(3). */
static double parts_of(const ktg_vec3 corner[3], double spacing) {
    double longest = 0;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, ktg_length3(ktg_sub3(corner[(k + 1) % 3], corner[k])));
    return fmax(1, ceil(longest / (sqrt(3) * spacing)));
}

static void face_corners(const ktg_mesh *mesh, uint32_t face, ktg_vec3 corner[3]) {
    for (uint32_t k = 0; k < 3; k++)
        corner[k] = mesh->positions[mesh->faces[3 * (size_t)face + k]];
}

static ktg_status require_few_samples(ktg_context *context, const ktg_mesh *mesh, double spacing) {
    double samples = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec3 corner[3];
        face_corners(mesh, f, corner);
        double parts = parts_of(corner, spacing);
        samples += parts * parts / 2;
    }
    if (samples <= most_samples)
        return KTG_OK;
    return ktg_fail(context, KTG_LIMIT,
                    "a spacing of %g asks for %.2g samples (at most %g): take a larger one",
                    spacing, samples, most_samples);
}

static ktg_status measure_from(ktg_context *context, const ktg_closest *to, ktg_vec3 sample,
                               double *most) {
    ktg_vec3 nearest;
    KTG_TRY(ktg_closest_point(context, to, sample, &nearest, NULL));
    *most = fmax(*most, ktg_length3(ktg_sub3(nearest, sample)));
    return KTG_OK;
}

/* The lattice of a face, its corners included; `seen` spares corners measured with another face. */
static ktg_status measure_face(ktg_context *context, const ktg_mesh *from, uint32_t face,
                               const ktg_closest *to, double spacing, bool *seen, double *most) {
    ktg_vec3 corner[3];
    face_corners(from, face, corner);
    uint32_t parts = (uint32_t)parts_of(corner, spacing);
    ktg_vec3 u = ktg_sub3(corner[1], corner[0]), v = ktg_sub3(corner[2], corner[0]);
    for (uint32_t i = 0; i <= parts; i++)
        for (uint32_t j = 0; i + j <= parts; j++) {
            uint32_t k = i == parts ? 1 : j == parts ? 2 : 0;
            bool at_corner = i == parts || j == parts || i + j == 0;
            uint32_t vertex = from->faces[3 * (size_t)face + k];
            if (at_corner && seen[vertex])
                continue;
            if (at_corner)
                seen[vertex] = true;
            ktg_vec3 sample =
                ktg_madd3(ktg_madd3(corner[0], (double)i / parts, u), (double)j / parts, v);
            KTG_TRY(measure_from(context, to, at_corner ? corner[k] : sample, most));
        }
    return KTG_OK;
}

static ktg_status one_way(ktg_context *context, const ktg_mesh *from, const ktg_mesh *to,
                          double spacing, double *most) {
    ktg_closest *closest = NULL;
    bool *seen = ktg_new(context, from->vertex_count, bool);
    ktg_status status = seen ? require_few_samples(context, from, spacing) : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_closest_new(context, to, &closest);
    for (uint32_t f = 0; status == KTG_OK && f < from->face_count; f++) {
        if (f % 256 == 0)
            status = ktg_check_cancel(context);
        if (status == KTG_OK)
            status = measure_face(context, from, f, closest, spacing, seen, most);
    }
    ktg_free(seen);
    ktg_closest_free(&closest);
    return status;
}

/* 1/200 of the diagonal of the box around both. */
static double usual_spacing(const ktg_mesh *a, const ktg_mesh *b) {
    ktg_vec3 low = a->positions[a->faces[0]], high = low;
    const ktg_mesh *both[2] = {a, b};
    for (int i = 0; i < 2; i++)
        for (size_t h = 0; h < 3 * (size_t)both[i]->face_count; h++) {
            ktg_vec3 p = both[i]->positions[both[i]->faces[h]];
            low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
            high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
        }
    return ktg_length3(ktg_sub3(high, low)) / 200;
}

ktg_status ktg_mesh_hausdorff(ktg_context *context, const ktg_mesh *a, const ktg_mesh *b,
                              double spacing, double *distance) {
    *distance = 0;
    if (a->face_count == 0 || b->face_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "a mesh without faces has no distance");
    if (!(spacing >= 0))
        return ktg_fail(context, KTG_ARGUMENT, "the spacing of samples must not be negative");
    if (spacing == 0)
        spacing = usual_spacing(a, b);
    if (spacing == 0) /* everything is in one point */
        spacing = 1;
    KTG_TRY(one_way(context, a, b, spacing, distance));
    return one_way(context, b, a, spacing, distance);
}
