/* flatten/handle_at.c - the handle at a point of the rest shape: section 5's barycentric parts. */
#include "flatten/shape.h"

/* A point outside by no more than this, by the shape's size, lies on the border. */
static const double border_width = 1e-6;

/* The parts of a point in a triangle, which add up to 1. */
static void find_parts(const ktg_vec2 corners[3], ktg_vec2 p, double parts[3]) {
    ktg_vec2 a = corners[0], b = corners[1], c = corners[2];
    double area = ktg_cross2(ktg_sub2(b, a), ktg_sub2(c, a));
    parts[1] = ktg_cross2(ktg_sub2(p, a), ktg_sub2(c, a)) / area;
    parts[2] = ktg_cross2(ktg_sub2(b, a), ktg_sub2(p, a)) / area;
    parts[0] = 1 - parts[1] - parts[2];
}

/* How far p is from the triangle, 0 inside. */
static double distance_to(const ktg_vec2 corners[3], ktg_vec2 p) {
    double nearest = INFINITY;
    bool inside = true;
    for (int k = 0; k < 3; k++) {
        ktg_vec2 a = corners[k], ab = ktg_sub2(corners[(k + 1) % 3], a), ap = ktg_sub2(p, a);
        inside = inside && ktg_cross2(ab, ap) >= 0;
        double along = fmax(0, fmin(1, ktg_dot2(ab, ap) / ktg_dot2(ab, ab)));
        nearest = fmin(nearest, ktg_length2(ktg_madd2(ap, -along, ab)));
    }
    return inside ? 0 : nearest;
}

static void corners_of(const ktg_shape *s, uint32_t f, ktg_vec2 corners[3]) {
    for (int k = 0; k < 3; k++)
        corners[k] = s->rest[s->mesh->faces[3 * (size_t)f + (size_t)k]];
}

ktg_status ktg_shape_handle_at(ktg_context *context, const ktg_shape *shape, ktg_vec2 point,
                               ktg_handle *handle) {
    ktg_vec2 p = ktg_shape_inward(shape, point), corners[3];
    double nearest = INFINITY;
    uint32_t best = 0;
    for (uint32_t f = 0; f < shape->mesh->face_count && nearest > 0; f++) {
        corners_of(shape, f, corners);
        double distance = distance_to(corners, p);
        if (distance < nearest) {
            nearest = distance;
            best = f;
        }
    }
    if (!(nearest <= border_width))
        return ktg_fail(context, KTG_GEOMETRY, "(%g, %g) is outside the shape%s", point.x, point.y,
                        nearest < INFINITY ? "" : " and no finite point");
    corners_of(shape, best, corners);
    *handle = (ktg_handle){0};
    find_parts(corners, p, handle->parts);
    for (int k = 0; k < 3; k++)
        handle->vertices[k] = shape->mesh->faces[3 * (size_t)best + (size_t)k];
    return KTG_OK;
}
