/* tests/verify/nets.h - sound patterns to damage: a surface and the edges to cut, unfolded the
 * plain way, with tabs, outlines, seams, labels and one sheet for each piece. */
#ifndef KTG_TESTS_VERIFY_NETS_H
#define KTG_TESTS_VERIFY_NETS_H

#include "pattern/pattern.h"

typedef struct net {
    const ktg_vec3 *positions;
    uint32_t vertex_count;
    const uint32_t (*faces)[3];
    uint32_t face_count;
    const uint32_t (*cuts)[2]; /* pairs of vertices; every other edge with two faces is a fold */
    uint32_t cut_count;
    double tab_mm; /* height of the tabs, on side 0 of every cut; 0: none */
    bool bare;     /* faces and edges only, as straight from unfolding */
} net;

/* Aborts when memory is out. */
ktg_pattern *net_make(ktg_context *context, const net *n);

/* The edge between two vertices of the surface. */
ktg_pattern_edge *net_edge(ktg_pattern *pattern, uint32_t a, uint32_t b);
uint32_t net_edge_index(const ktg_pattern *pattern, uint32_t a, uint32_t b);

/* Drops outlines and makes them anew from faces and tabs as they are now. */
void net_outlines(ktg_context *context, ktg_pattern *pattern);

extern const net tetrahedron, cube, box_and_lid, open_box, slit, useless_slit, saddle, two_parts,
    ring, opened_ring;

#endif
