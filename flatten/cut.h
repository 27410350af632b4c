/* flatten/cut.h - a surface taken apart along its seams (this room only).
 *
 * Seams are a flag for each edge of the surface's adjacency. Faces connected across edges without
 * it are a panel; a seam that ends inside one is a dart. */
#ifndef KTG_FLATTEN_CUT_H
#define KTG_FLATTEN_CUT_H

#include "mesh/mesh.h"

/* One panel as a mesh of its own, in which the two sides of a seam have vertices of their own. */
typedef struct ktg_cut_panel {
    ktg_mesh *mesh;   /* positions and faces only; vertices in the surface's order */
    uint32_t *vertex; /* mesh->vertex_count: the surface's vertex */
    uint32_t *face;   /* mesh->face_count: the surface's face, ascending */
} ktg_cut_panel;

typedef struct ktg_cut_surface {
    uint32_t count;
    ktg_cut_panel *panels; /* by their first faces */
    uint32_t *face_panel;  /* face_count of the surface: index into panels */
    uint32_t *face_index;  /* face_count of the surface: index into that panel's faces */
} ktg_cut_surface;

/* cut: adjacency->edge_count. The mesh is a manifold as ktg_mesh_repair leaves it; edges without
 * two sides are borders, cut or not. */
KTG_NODISCARD ktg_status ktg_cut_apart(ktg_context *context, const ktg_mesh *mesh,
                                       const ktg_adjacency *adjacency, const bool *cut,
                                       ktg_cut_surface *surface);
void ktg_cut_surface_free(ktg_cut_surface *surface);

#endif
