/* core/predicate_cgal.cpp - exact predicates through CGAL's filtered kernel. */
#include "core/predicate.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

extern "C" int ktg_orientation2(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Point = Kernel::Point_2;
    return static_cast<int>(CGAL::orientation(Point(a.x, a.y), Point(b.x, b.y), Point(c.x, c.y)));
}
