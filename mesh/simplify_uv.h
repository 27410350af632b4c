/* mesh/simplify_uv.h - texture coordinates under simplification (mesh only).
 *
 * A seam is an edge whose two faces differ in a texture coordinate at one of its ends, or in
 * material, or of which only one has texture coordinates, or that lie the other way round in the
 * texture (where a half of a model shows the other half's, mirrored). What seams enclose is a
 * chart. A chart smaller than a face will be is spare: it has no seams, and faces that take the
 * place of its own lose their texture coordinates, and are spare, too. As long as seams are kept, a
 * collapse that would tear a chart, take a vertex off its seam or turn a face over in the texture
 * is refused; afterwards such faces lose their texture coordinates. */
#ifndef KTG_MESH_SIMPLIFY_UV_H
#define KTG_MESH_SIMPLIFY_UV_H

#include "mesh/mesh.h"

#include <math.h>

struct ktg_simplify;
struct ktg_candidate;

/* How a vertex is bound to seams: not at all; it lies on one and may move along it; seams meet or
 * end there, and it stays. */
typedef enum ktg_seam_bond { KTG_OFF_SEAM, KTG_ON_SEAM, KTG_SEAM_JUNCTION } ktg_seam_bond;

typedef struct ktg_simplify_uv {
    const ktg_mesh *mesh; /* the input */
    ktg_vec2 *corners;    /* 3 face_count, current; x is NaN at all corners of a face that has none.
                             NULL when the input has no texture coordinates; so are the others */
    int8_t *turn;         /* face_count: 1, or -1 where the face is mirrored in the texture, or 0 */
    bool *spare;          /* face_count */
    uint8_t *bonds;       /* vertex_count ktg_seam_bond; a vertex that stays keeps its own */
    uint32_t *chart;      /* face_count: equal numbers are of one chart of the input */
    bool kept;            /* seams are kept */

    /* scratch for one collapse: the part of the ring, 1 or 2, that each listed face joins beside
     * the edge (0: neither), and the new coordinate of each changed face's moving corner (x NaN: it
     * loses its texture coordinates) */
    uint8_t *parts;
    ktg_vec2 *moved;
    uint32_t *stack;
    size_t part_capacity, moved_capacity, stack_capacity;
} ktg_simplify_uv;

/* simplify_seams.c: whether faces f and g, which both have vertices a and b, are of one chart
 * there. */
bool ktg_uv_joined(const struct ktg_simplify *s, uint32_t f, uint32_t g, uint32_t a, uint32_t b);
/* simplify_seams.c: whether a seam is between them. */
bool ktg_uv_seam(const struct ktg_simplify *s, uint32_t f, uint32_t g, uint32_t a, uint32_t b);

/* simplify_seams.c: takes the texture coordinates of the mesh, if it has any, finds seams, and
 * decides whether they can be kept. */
KTG_NODISCARD ktg_status ktg_simplify_take_uvs(struct ktg_simplify *s, const ktg_mesh *mesh,
                                               const ktg_adjacency *adjacency,
                                               uint32_t target_faces);
void ktg_simplify_free_uvs(struct ktg_simplify *s);

/* simplify_uv.c: finds what the collapse, whose faces are listed, does to texture coordinates;
 * whether it may, as long as seams are kept. */
KTG_NODISCARD ktg_status ktg_simplify_uv_allowed(struct ktg_simplify *s,
                                                 const struct ktg_candidate *candidate,
                                                 ktg_vec3 position, bool *allowed);
/* simplify_uv.c: does it, before the faces change. */
void ktg_simplify_move_uvs(struct ktg_simplify *s, const struct ktg_candidate *candidate);

/* simplify_uv_back.c: takes the coordinates of vertices that moved inside a chart from the closest
 * point of the input, where that is of the same chart. */
KTG_NODISCARD ktg_status ktg_simplify_refine_uvs(struct ktg_simplify *s);
/* simplify_uv_back.c: puts the texture coordinates of the surviving faces, in their order, into the
 * mesh; *lost is how many of them have none any more. */
KTG_NODISCARD ktg_status ktg_simplify_give_uvs(const struct ktg_simplify *s, ktg_mesh *mesh,
                                               uint32_t *lost);

static inline bool ktg_uv_is_none(ktg_vec2 uv) {
    return isnan(uv.x);
}

#endif
