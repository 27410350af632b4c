/* mesh/triangulate_cgal.cpp - the constrained Delaunay triangulation of a polygon, by CGAL. */
#include "core/guard.hpp"
#include "core/random.h"
#include "mesh/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<uint32_t, Kernel>;
struct Mark {
    bool inside = false;
};
using Face =
    CGAL::Triangulation_face_base_with_info_2<Mark, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Data = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, Data, CGAL::No_constraint_intersection_requiring_constructions_tag>;

/* False for an outline that passes the same points again and again: such a point may have as many
 * edges as there are corners, walked round each time, so that coincident corners times corners is
 * the work that may come. */
bool is_little_work(std::vector<Kernel::Point_2> points) {
    std::size_t count = points.size();
    std::sort(points.begin(), points.end());
    auto distinct = std::unique(points.begin(), points.end()) - points.begin();
    return static_cast<double>(count - distinct) * static_cast<double>(count) <= 1e6;
}

/* Inserts the corners in an order that keeps point location short. Corners that coincide share a
 * vertex, which is known by one of them. */
void insert_corners(Cdt &cdt, std::vector<Kernel::Point_2> &points,
                    std::vector<Cdt::Vertex_handle> &handles) {
    using Map = CGAL::Pointer_property_map<Kernel::Point_2>::type;
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    CGAL::spatial_sort(
        order.begin(), order.end(),
        CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>(CGAL::make_property_map(points)));
    Cdt::Face_handle hint;
    for (std::size_t i : order) {
        handles[i] = cdt.insert(points[i], hint);
        handles[i]->info() = static_cast<uint32_t>(i);
        hint = handles[i]->face();
    }
}

/* Makes the outline's edges edges of the triangulation. False when one crosses another or passes
 * through a corner. In random order, since earlier edges then shield later ones from crossing many
 * triangles (Shewchuk & Brown 2015, "Fast segment insertion and incremental construction of
 * constrained Delaunay triangulations"): in sequence a slanted comb takes quadratic time. */
bool insert_outline(Cdt &cdt, const std::vector<Cdt::Vertex_handle> &handles) {
    std::size_t count = handles.size();
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t(0));
    ktg_random random;
    ktg_random_seed(&random, 1);
    for (std::size_t i = count; i > 1; i--)
        std::swap(order[i - 1], order[ktg_random_below(&random, i)]);
    for (std::size_t i = 0; i < count; i++)
        if (handles[i] == handles[(i + 1) % count])
            return false;
    try {
        for (std::size_t i : order)
            cdt.insert_constraint(handles[i], handles[(i + 1) % count]);
    } catch (const Cdt::Intersection_of_constraints_exception &) {
        return false;
    }
    for (std::size_t i = 0; i < count; i++)
        if (!cdt.is_edge(handles[i], handles[(i + 1) % count]))
            return false;
    return true;
}

/* The face left of the outline's edge from `from` to `to`. */
Cdt::Face_handle face_left(const Cdt &cdt, Cdt::Vertex_handle from, Cdt::Vertex_handle to) {
    Cdt::Face_handle face;
    int opposite = 0;
    cdt.is_edge(from, to, face, opposite);
    return face->vertex(Cdt::ccw(opposite)) == from ? face : face->neighbor(opposite);
}

/* Collects the faces inside: all that are reached from a face left of the outline without crossing
 * it. An outline may run along an edge in both directions (the bridge to a hole), and has both of
 * its sides inside then. False unless there are count - 2 faces. */
bool collect_inside(const Cdt &cdt, const std::vector<Cdt::Vertex_handle> &handles,
                    uint32_t *triangles) {
    std::size_t count = handles.size(), wanted = count - 2, found = 0;
    std::vector<Cdt::Face_handle> open;
    auto enter = [&open](Cdt::Face_handle face) {
        if (!face->info().inside)
            open.push_back(face);
        face->info().inside = true;
    };
    for (std::size_t i = 0; i < count; i++)
        enter(face_left(cdt, handles[i], handles[(i + 1) % count]));
    for (; !open.empty(); found++) {
        Cdt::Face_handle face = open.back();
        open.pop_back();
        if (cdt.is_infinite(face) || found == wanted)
            return false;
        for (int k = 0; k < 3; k++) {
            triangles[3 * found + k] = face->vertex(k)->info();
            if (!face->is_constrained(k))
                enter(face->neighbor(k));
        }
    }
    return found == wanted;
}

} // namespace

extern "C" ktg_status ktg_triangulate_plane(ktg_context *context, const ktg_vec2 *corners,
                                            uint32_t count, uint32_t *triangles, bool *simple) {
    return ktg_guard(context, "triangulating a polygon", [&]() -> ktg_status {
        std::vector<Kernel::Point_2> points;
        points.reserve(count);
        for (uint32_t i = 0; i < count; i++)
            points.emplace_back(corners[i].x, corners[i].y);
        *simple = is_little_work(points);
        if (!*simple)
            return KTG_OK;
        Cdt cdt;
        std::vector<Cdt::Vertex_handle> handles(count);
        insert_corners(cdt, points, handles);
        *simple = insert_outline(cdt, handles) && collect_inside(cdt, handles, triangles);
        return KTG_OK;
    });
}
