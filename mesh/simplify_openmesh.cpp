/* mesh/simplify_openmesh.cpp - neighbours, legality and collapse through OpenMesh's decimater. */
#include "mesh/simplify.h"

#include "core/guard.hpp"

/* GCC takes OpenMesh's points, which are made before they are set, for a mistake. */
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/BaseDecimaterT.hh>

#include <memory>
#include <vector>

namespace {

struct Traits : public OpenMesh::DefaultTraitsDouble {
    VertexAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};

using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Collapse = OpenMesh::Decimater::CollapseInfoT<Mesh>;

/* OpenMesh's decimater without its queue: its test of legality is what is wanted. */
class Decimater : public OpenMesh::Decimater::BaseDecimaterT<Mesh> {
  public:
    explicit Decimater(Mesh &mesh) : BaseDecimaterT(mesh) {}
    bool is_legal(const Collapse &collapse) { return is_collapse_legal(collapse); }
};

Mesh::VertexHandle handle(uint32_t vertex) {
    return Mesh::VertexHandle(static_cast<int>(vertex));
}

} // namespace

struct ktg_halfedges {
    Mesh mesh;
    std::unique_ptr<Decimater> decimater;
    std::vector<uint32_t> faces, vertices;
};

extern "C" ktg_status ktg_halfedges_new(ktg_context *context, const ktg_mesh *mesh,
                                        ktg_halfedges **halfedges) {
    *halfedges = nullptr;
    return ktg_guard(context, "half-edges", [&]() -> ktg_status {
        auto made = std::make_unique<ktg_halfedges>();
        made->mesh.reserve(mesh->vertex_count, mesh->vertex_count + mesh->face_count,
                           mesh->face_count);
        for (uint32_t v = 0; v < mesh->vertex_count; v++)
            made->mesh.add_vertex(Mesh::Point(0, 0, 0)); /* where they are is the caller's */
        for (uint32_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *c = mesh->faces + 3 * static_cast<size_t>(f);
            Mesh::FaceHandle face = made->mesh.add_face(handle(c[0]), handle(c[1]), handle(c[2]));
            if (face.idx() != static_cast<int>(f))
                return ktg_fail(context, KTG_ARGUMENT,
                                "face %u does not fit a manifold: repair the mesh first", f + 1);
        }
        made->decimater = std::make_unique<Decimater>(made->mesh);
        made->faces.reserve(mesh->face_count); /* whose filling cannot fail, then */
        made->vertices.reserve(mesh->vertex_count);
        *halfedges = made.release();
        return KTG_OK;
    });
}

extern "C" void ktg_halfedges_free(ktg_halfedges **halfedges) {
    if (halfedges) {
        delete *halfedges;
        *halfedges = nullptr;
    }
}

extern "C" uint32_t ktg_halfedges_faces(ktg_halfedges *h, uint32_t vertex, const uint32_t **faces) {
    h->faces.clear();
    for (auto it = h->mesh.cvf_iter(handle(vertex)); it.is_valid(); ++it)
        h->faces.push_back(static_cast<uint32_t>(it->idx()));
    *faces = h->faces.data();
    return static_cast<uint32_t>(h->faces.size());
}

extern "C" uint32_t ktg_halfedges_neighbours(ktg_halfedges *h, uint32_t vertex,
                                             const uint32_t **vertices) {
    h->vertices.clear();
    for (auto it = h->mesh.cvv_iter(handle(vertex)); it.is_valid(); ++it)
        h->vertices.push_back(static_cast<uint32_t>(it->idx()));
    *vertices = h->vertices.data();
    return static_cast<uint32_t>(h->vertices.size());
}

extern "C" bool ktg_halfedges_is_border(const ktg_halfedges *h, uint32_t vertex) {
    return h->mesh.is_boundary(handle(vertex));
}

/* Beyond OpenMesh's own test: an inner vertex across from the edge keeps three neighbours, so that
 * a tetrahedron does not fold flat. */
static bool may_lose_a_neighbour(const Mesh &mesh, Mesh::VertexHandle vertex) {
    return !vertex.is_valid() || mesh.is_boundary(vertex) || mesh.valence(vertex) > 3;
}

static bool may_collapse(ktg_halfedges *h, Mesh::HalfedgeHandle edge) {
    if (!edge.is_valid())
        return false;
    Collapse collapse(h->mesh, edge);
    return may_lose_a_neighbour(h->mesh, collapse.vl) &&
           may_lose_a_neighbour(h->mesh, collapse.vr) && h->decimater->is_legal(collapse);
}

/* OpenMesh takes memory for its test, and for a collapse. */
extern "C" ktg_status ktg_halfedges_may_collapse(ktg_context *context, ktg_halfedges *h,
                                                 uint32_t from, uint32_t to, bool *may) {
    return ktg_guard(context, "half-edges", [&]() -> ktg_status {
        *may = may_collapse(h, h->mesh.find_halfedge(handle(from), handle(to)));
        return KTG_OK;
    });
}

extern "C" ktg_status ktg_halfedges_collapse(ktg_context *context, ktg_halfedges *h, uint32_t from,
                                             uint32_t to) {
    return ktg_guard(context, "half-edges", [&]() -> ktg_status {
        h->mesh.collapse(h->mesh.find_halfedge(handle(from), handle(to)));
        return KTG_OK;
    });
}
