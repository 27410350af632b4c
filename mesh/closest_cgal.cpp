/* mesh/closest_cgal.cpp - closest points through CGAL's AABB tree. */
#include "mesh/closest.h"

#include "core/guard.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <memory>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const ktg_vec3 &p) {
    return Kernel::Point_3(p.x, p.y, p.z);
}

Kernel::Point_3 nearest_of(const Kernel::Triangle_3 &triangle, const Kernel::Point_3 &query) {
    return Kernel().construct_projected_point_3_object()(triangle, query);
}

} // namespace

struct ktg_closest {
    Triangles triangles;
    Tree tree;
};

extern "C" ktg_status ktg_closest_new(ktg_context *context, const ktg_mesh *mesh,
                                      ktg_closest **closest) {
    *closest = nullptr;
    return ktg_guard(context, "closest points", [&]() -> ktg_status {
        auto made = std::make_unique<ktg_closest>();
        made->triangles.reserve(mesh->face_count);
        for (uint32_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *c = mesh->faces + 3 * static_cast<size_t>(f);
            made->triangles.emplace_back(point(mesh->positions[c[0]]), point(mesh->positions[c[1]]),
                                         point(mesh->positions[c[2]]));
        }
        made->tree.insert(made->triangles.cbegin(), made->triangles.cend());
        made->tree.build();
        *closest = made.release();
        return KTG_OK;
    });
}

extern "C" void ktg_closest_free(ktg_closest **closest) {
    if (closest) {
        delete *closest;
        *closest = nullptr;
    }
}

extern "C" ktg_status ktg_closest_point(ktg_context *context, const ktg_closest *closest,
                                        ktg_vec3 query, ktg_vec3 *result, uint32_t *face) {
    return ktg_guard(context, "closest point", [&]() -> ktg_status {
        auto near = closest->triangles.cbegin();
        bool known = face && *face < closest->triangles.size();
        if (known)
            near += *face;
        auto found = known ? closest->tree.closest_point_and_primitive(
                                 point(query), {nearest_of(*near, point(query)), near})
                           : closest->tree.closest_point_and_primitive(point(query));
        *result = ktg_vec3{found.first.x(), found.first.y(), found.first.z()};
        if (face)
            *face = static_cast<uint32_t>(found.second - closest->triangles.cbegin());
        return KTG_OK;
    });
}
