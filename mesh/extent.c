/* mesh/extent.c - whether a mesh is of a size, and near enough to the origin, to be worked on. */
#include "mesh/mesh.h"

#include <math.h>

/* The largest side of the box around what faces use, and the largest of their coordinates. */
static double extent_of(const ktg_mesh *mesh, double *farthest) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    *farthest = 0;
    for (size_t c = 0; c < 3 * (size_t)mesh->face_count; c++) {
        ktg_vec3 p = mesh->positions[mesh->faces[c]];
        const double at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
            *farthest = fmax(*farthest, fabs(at[k]));
        }
    }
    return fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
}

ktg_status ktg_mesh_check_extent(ktg_context *context, const ktg_mesh *mesh, double *extent) {
    double farthest;
    *extent = extent_of(mesh, &farthest);
    if (!(*extent > 1e-75) || !(*extent < 1e75))
        return ktg_fail(context, KTG_GEOMETRY,
                        "the model is %g units large; nothing can be cut out of that", *extent);
    if (farthest > KTG_MESH_MOST_AWAY * *extent)
        return ktg_fail(context, KTG_GEOMETRY,
                        "the model is %.4g units large and %.4g units away from the origin, where "
                        "too few digits are left for its shape; move it to the origin",
                        *extent, farthest);
    return KTG_OK;
}
