/* flatten/surface.h - a whole surface on its way from seams to a pattern (this room only).
 *
 *     ktg_seams_given         edges that are seams by what the model says
 *     ktg_flat_surface_lay    every panel laid flat
 *     ktg_seams_match         both sides of each seam equally long
 *     ktg_flat_surface_judge  strain, faces that fold, panels that lie on themselves
 *     ktg_flat_pattern        the result as a pattern
 */
#ifndef KTG_FLATTEN_SURFACE_H
#define KTG_FLATTEN_SURFACE_H

#include "flatten/cut.h"
#include "flatten/iterate.h"

/* One panel: how it lies flat, in the panel's normalised unit. */
typedef struct ktg_flat_panel {
    ktg_panel *panel;
    ktg_vec2 *flat; /* panel->vertex_count */
    double grain;   /* radians from upright */
    double area;    /* in space, normalised */
    ktg_panel_report report;
} ktg_flat_panel;

typedef struct ktg_flat_surface {
    const ktg_mesh *model; /* the caller's */
    const ktg_mesh *mesh;  /* the same, or `slid` */
    ktg_mesh *slid;        /* with vertices moved along the surface, so that seams are smooth, or
                              NULL */
    const ktg_flatten_options *options;
    const char *name;
    double area_part; /* chosen seams: the part of a panel's area that keeps to the limit before
                         both sides of its seams are made equally long */
    bool choose;      /* seams are to be chosen, whatever the options say */
    bool chosen;      /* they were */
    ktg_adjacency *adjacency;
    bool *cut; /* adjacency->edge_count: the seams */
    ktg_cut_surface apart;
    ktg_names names;       /* of the panels */
    ktg_flat_panel *flats; /* apart.count */
    double *face_strain;   /* mesh->face_count */
    ktg_flatten_report *report;
} ktg_flat_surface;

void ktg_flat_surface_drop(ktg_flat_surface *surface);

/* ---- given.c ------------------------------------------------------------------------------ */

/* Sets cut where the model itself says that seams are, by the KTG_SEAMS_ flags. */
KTG_NODISCARD ktg_status ktg_seams_given(ktg_context *context, const ktg_mesh *mesh,
                                         const ktg_adjacency *adjacency, unsigned seams,
                                         double crease, bool *cut);

/* Names for the panels, after what tells most of them apart. */
KTG_NODISCARD ktg_status ktg_panel_names(ktg_context *context, const ktg_mesh *mesh,
                                         const ktg_cut_surface *apart, const char *fallback,
                                         ktg_names *names);

/* ---- surface.c ---------------------------------------------------------------------------- */

/* Decides on the seams, takes the surface apart and makes every panel ready. */
KTG_NODISCARD ktg_status ktg_flat_surface_open(ktg_context *context, ktg_flat_surface *surface);

KTG_NODISCARD ktg_status ktg_flat_surface_lay(ktg_context *context, ktg_flat_surface *surface);

/* Fills report and face_strain. KTG_GEOMETRY for a panel that folds over or lies on itself. */
KTG_NODISCARD ktg_status ktg_flat_surface_judge(ktg_context *context, ktg_flat_surface *surface);

/* ---- match.c ------------------------------------------------------------------------------ */

KTG_NODISCARD ktg_status ktg_seams_match(ktg_context *context, ktg_flat_surface *surface);

/* KTG_GEOMETRY where that came out so badly that the seam cannot be sewn, which happens among
 * needles only. */
KTG_NODISCARD ktg_status ktg_seams_check(ktg_context *context, const ktg_flat_surface *surface);

/* ---- pattern.c ---------------------------------------------------------------------------- */

KTG_NODISCARD ktg_status ktg_flat_pattern(ktg_context *context, const ktg_flat_surface *surface,
                                          ktg_pattern **pattern);

#endif
