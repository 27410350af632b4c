/* mesh/triangulate.c - cutting polygons into triangles. */
#include "mesh/triangulate.h"
#include "core/memory.h"
#include "core/vec.h"

/* Two measures that differ by less than this part are a tie (decided by the order of the corners),
 * so that a grid of rectangles is not cut at the mercy of rounding. */
#define TIE 1e-9

/* Scales by a power of two and moves the corners so that they lie in [-1, 1]: no product of them
 * overflows, and a model scaled by a power of two is cut the same way. */
static void normalise(const ktg_vec3 *corners, uint32_t count, ktg_vec3 *local) {
    double largest = 0;
    for (uint32_t i = 0; i < count; i++) {
        local[i] = ktg_sub3(corners[i], corners[0]);
        largest = fmax(largest, fmax(fabs(local[i].x), fmax(fabs(local[i].y), fabs(local[i].z))));
    }
    int exponent;
    frexp(largest, &exponent);
    for (uint32_t i = 0; i < count; i++) {
        local[i].x = ldexp(local[i].x, -exponent);
        local[i].y = ldexp(local[i].y, -exponent);
        local[i].z = ldexp(local[i].z, -exponent);
    }
}

/* Twice the area vector of a polygon (Newell; corners relative to corner 0). */
static ktg_vec3 area_vector(const ktg_vec3 *corners, uint32_t count) {
    ktg_vec3 sum = {0, 0, 0};
    for (uint32_t i = 1; i + 1 < count; i++)
        sum = ktg_add3(sum, ktg_cross3(corners[i], corners[i + 1]));
    return sum;
}

/* Corners in their plane, counter-clockwise. False when they enclose no area. */
static bool project(const ktg_vec3 *local, uint32_t count, ktg_vec2 *flat) {
    ktg_vec3 normal = ktg_unit3(area_vector(local, count));
    if (ktg_dot3(normal, normal) == 0)
        return false;
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    ktg_vec3 axis = {x <= y && x <= z, y < x && y <= z, z < x && z < y};
    ktg_vec3 u = ktg_unit3(ktg_cross3(axis, normal)), v = ktg_cross3(normal, u);
    for (uint32_t i = 0; i < count; i++)
        flat[i] = (ktg_vec2){ktg_dot3(u, local[i]), ktg_dot3(v, local[i])};
    return true;
}

static double signed_area(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c) {
    return ktg_cross2(ktg_sub2(b, a), ktg_sub2(c, a));
}

/* How far a quadrangle's angles at b and d, which a cut from a to c leaves whole, are from adding
 * up to 180 degrees, as a sine: positive where that cut is the Delaunay one. */
static double delaunay_measure(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d) {
    ktg_vec2 ba = ktg_unit2(ktg_sub2(a, b)), bc = ktg_unit2(ktg_sub2(c, b));
    ktg_vec2 da = ktg_unit2(ktg_sub2(a, d)), dc = ktg_unit2(ktg_sub2(c, d));
    return ktg_cross2(bc, ba) * ktg_dot2(da, dc) + ktg_dot2(bc, ba) * ktg_cross2(da, dc);
}

/* True when the cut from corner 1 to 3 is better than the one from 0 to 2. */
static bool second_diagonal(const ktg_vec2 p[4], const ktg_vec3 local[4]) {
    double first = fmin(signed_area(p[0], p[1], p[2]), signed_area(p[0], p[2], p[3]));
    double second = fmin(signed_area(p[1], p[2], p[3]), signed_area(p[1], p[3], p[0]));
    double whole = ktg_cross2(ktg_sub2(p[2], p[0]), ktg_sub2(p[3], p[1]));
    bool first_fits = first > TIE * whole, second_fits = second > TIE * whole;
    if (first_fits != second_fits)
        return second_fits;
    if (!first_fits)
        return second > first + TIE * fabs(whole);
    double delaunay = delaunay_measure(p[0], p[1], p[2], p[3]);
    if (fabs(delaunay) > TIE)
        return delaunay < 0;
    double one = ktg_length3(ktg_sub3(local[2], local[0]));
    double two = ktg_length3(ktg_sub3(local[3], local[1]));
    return two < one * (1 - TIE);
}

static void cut_quadrangle(const ktg_vec3 *corners, uint32_t *triangles) {
    static const uint32_t cuts[2][6] = {{0, 1, 2, 0, 2, 3}, {1, 2, 3, 1, 3, 0}};
    ktg_vec3 local[4];
    ktg_vec2 flat[4];
    normalise(corners, 4, local);
    bool second = project(local, 4, flat) && second_diagonal(flat, local);
    for (int i = 0; i < 6; i++)
        triangles[i] = cuts[second][i];
}

static void cut_fan(uint32_t count, uint32_t *triangles) {
    for (uint32_t i = 0; i + 2 < count; i++) {
        triangles[3 * (size_t)i] = 0;
        triangles[3 * (size_t)i + 1] = i + 1;
        triangles[3 * (size_t)i + 2] = i + 2;
    }
}

static ktg_status cut_polygon(ktg_context *context, const ktg_vec3 *corners, uint32_t count,
                              uint32_t *triangles) {
    ktg_vec3 *local = ktg_new(context, count, ktg_vec3);
    ktg_vec2 *flat = ktg_new(context, count, ktg_vec2);
    ktg_status status = local && flat ? KTG_OK : KTG_MEMORY;
    bool simple = false;
    if (status == KTG_OK) {
        normalise(corners, count, local);
        if (project(local, count, flat))
            status = ktg_triangulate_plane(context, flat, count, triangles, &simple);
    }
    if (status == KTG_OK && !simple)
        cut_fan(count, triangles);
    ktg_free(local);
    ktg_free(flat);
    return status;
}

ktg_status ktg_triangulate(ktg_context *context, const ktg_vec3 *corners, uint32_t count,
                           uint32_t *triangles) {
    if (count > 4)
        return cut_polygon(context, corners, count, triangles);
    if (count == 4)
        cut_quadrangle(corners, triangles);
    else
        cut_fan(count, triangles);
    return KTG_OK;
}
