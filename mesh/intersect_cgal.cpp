/* mesh/intersect_cgal.cpp - exact tests of triangles through CGAL's filtered kernel. */
#include "mesh/intersect.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point(ktg_vec3 p) {
    return Point(p.x, p.y, p.z);
}

Kernel::Triangle_3 triangle(const ktg_vec3 p[3]) {
    return Kernel::Triangle_3(point(p[0]), point(p[1]), point(p[2]));
}

/* There is no context here to fail in: when memory runs out in an exact evaluation the answer is
 * the careful one. */
template <typename Test> bool careful(Test test) noexcept {
    try {
        return test();
    } catch (...) {
        return true;
    }
}

} // namespace

extern "C" bool ktg_exact_triangles_meet(const ktg_vec3 p[3], const ktg_vec3 q[3]) {
    return careful([&] { return CGAL::do_intersect(triangle(p), triangle(q)); });
}

extern "C" bool ktg_exact_segment_meets(ktg_vec3 a, ktg_vec3 b, const ktg_vec3 q[3]) {
    return careful(
        [&] { return CGAL::do_intersect(Kernel::Segment_3(point(a), point(b)), triangle(q)); });
}

extern "C" bool ktg_exact_folded(ktg_vec3 a, ktg_vec3 b, ktg_vec3 c, ktg_vec3 d) {
    return careful([&] {
        return CGAL::coplanar(point(a), point(b), point(c), point(d)) &&
               CGAL::coplanar_orientation(point(a), point(b), point(c), point(d)) == CGAL::POSITIVE;
    });
}
