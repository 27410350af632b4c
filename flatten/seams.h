/* flatten/seams.h - where to cut a surface so that its panels can be laid flat (this room only).
 *
 * Seams are a flag for each edge of the surface's adjacency, as in flatten/cut.h. Flags that are
 * set already are somebody's seams: they stay, and further ones are added. The mesh is a manifold
 * as ktg_mesh_repair leaves it, in one part or several. docs/flatten.md says how seams are chosen.
 */
#ifndef KTG_FLATTEN_SEAMS_H
#define KTG_FLATTEN_SEAMS_H

#include "mesh/mesh.h"

typedef struct ktg_seams_auto_options {
    const struct ktg_fabric
        *fabric;       /* what it bears, grain upright, in place of max_strain; NULL */
    unsigned up;       /* the axis of the model that is upright: 0 x, 1 y, 2 z; default 1 */
    double max_strain; /* that a panel may have on ... ; default 0.05 */
    double area_part;  /* ... this part of its area; default 0.95 */
    ktg_effort effort; /* work on the search; quick a tenth of normal (default), best four times */
    bool symmetric;    /* look for a mirror plane, and cut both sides alike; default true */
    bool slide;        /* reckon with ktg_seams_slide being called then; default true */
} ktg_seams_auto_options;

void ktg_seams_auto_defaults(ktg_seams_auto_options *options);

typedef struct ktg_seams_report {
    uint32_t panels, darts;   /* of the whole surface; a dart is a seam that ends inside a panel */
    uint32_t panels_beyond;   /* that could not be brought within the limit */
    double slide;             /* part for ktg_seams_slide with which panels still fit; 0: none */
    bool mirrored;            /* a mirror plane was found and used */
    bool exhausted;           /* work ended at its bound, or the caller wanted to finish */
    double worst_area_beyond; /* of all panels the largest part of the area beyond max_strain */
    double seam_length;       /* given and added; in the model's unit */
    uint64_t work;            /* faces laid flat in trials, each as often as it was */
    double seconds;
} ktg_seams_report;

/* Adds seams until every panel is a disk that is laid flat (by the default method) without a fold
 * and with no more than max_strain on area_part of its area, or until nothing more is gained; what
 * is beyond the limit then is in the report. cut: adjacency->edge_count, in and out. NULL options:
 * the defaults; report may be NULL. KTG_ARGUMENT, KTG_GEOMETRY for a face without area,
 * KTG_CANCELLED, KTG_MEMORY; then `cut` is as it was. When the caller wants to finish, panels are
 * opened to disks and the rest is left as it is. */
KTG_NODISCARD ktg_status ktg_seams_auto(ktg_context *context, const ktg_mesh *mesh,
                                        const ktg_adjacency *adjacency,
                                        const ktg_seams_auto_options *options, bool *cut,
                                        ktg_seams_report *report);

/* Adds the shortest cuts that make every panel a disk: from border to border, around handles, a
 * slit in what is closed. The number of panels stays. On failure `cut` is as it was. */
KTG_NODISCARD ktg_status ktg_seams_open(ktg_context *context, const ktg_mesh *mesh,
                                        const ktg_adjacency *adjacency, bool *cut);

/* Moves vertices along the surface so that seams run smoothly, which edges between vertices as they
 * are cannot. fixed (edge_count, or NULL): seams that stay as they are. Faces and edges stay the
 * same ones; vertices on borders, at creases, where seams meet or end, and far from seams, do not
 * move, and no other one leaves the surface as it was. *largest (or NULL): the furthest that one
 * moved. part: how much of the way they go, 1 all of it. On failure the mesh is as it was. */
KTG_NODISCARD ktg_status ktg_seams_slide(ktg_context *context, ktg_mesh *mesh,
                                         const ktg_adjacency *adjacency, const bool *cut,
                                         const bool *fixed, double part, double *largest);

#endif
