/* flatten/sheet.h - the parts of the search for seams and what they hand each other (this room
 * only).
 *
 *     ktg_sheet_new       a surface, or a panel of it, as paths see it
 *     ktg_path_find       the path from some vertices to others that is short and bends little
 *     ktg_sheet_open      cuts that make a sheet a disk
 *     ktg_seams_smooth    seams led anew, near where they were
 *     ktg_fit_measure     how well a disk can be laid flat
 *     ktg_split_make      ways to cut a panel that does not fit
 *     ktg_mirror_find     the plane in which a surface mirrors itself
 *     ktg_trial_run       a panel cut and laid flat in one of the ways
 *     ktg_seams_merge     seams that are not needed, taken away
 */
#ifndef KTG_FLATTEN_SHEET_H
#define KTG_FLATTEN_SHEET_H

#include "flatten/cut.h"
#include "flatten/kernel.h"
#include "flatten/seams.h"

/* ---- sheet.c ------------------------------------------------------------------------------ */

/* A mesh and its edges, by their ends and around each vertex. Borrows the mesh. */
typedef struct ktg_sheet {
    const ktg_mesh *mesh;
    const ktg_adjacency *adjacency;
    ktg_adjacency *own; /* the same, where the sheet made it */
    uint32_t edge_count;
    uint32_t *ends;         /* 2 edge_count */
    uint32_t *first;        /* vertex_count + 1: where a vertex's edges start in `around` */
    uint32_t *around;       /* 2 edge_count */
    double *length;         /* edge_count */
    double *cost;           /* edge_count: length, less along a crease */
    bool *border;           /* vertex_count */
    bool *outer;            /* vertex_count: border where a dart may begin */
    double mean_edge, area; /* of the whole sheet */
} ktg_sheet;

/* adjacency: NULL to have it made. */
KTG_NODISCARD ktg_status ktg_sheet_new(ktg_context *context, const ktg_mesh *mesh,
                                       const ktg_adjacency *adjacency, ktg_sheet **sheet);
void ktg_sheet_free(ktg_sheet **sheet);

/* The sheet is panel `index` of what a surface was cut into: darts do not begin at a slit, which is
 * a seam with the same panel on both sides. */
KTG_NODISCARD ktg_status ktg_sheet_find_slits(ktg_context *context, const ktg_cut_surface *parts,
                                              uint32_t index, const ktg_adjacency *surface,
                                              ktg_sheet *sheet);

static inline bool ktg_sheet_is_border(const ktg_sheet *sheet, uint32_t edge) {
    return sheet->adjacency
               ->twin[sheet->adjacency->edge_halfedges[sheet->adjacency->edge_first[edge]]] ==
           KTG_NONE;
}
static inline uint32_t ktg_sheet_other_end(const ktg_sheet *sheet, uint32_t edge, uint32_t v) {
    return sheet->ends[2 * (size_t)edge] ^ sheet->ends[2 * (size_t)edge + 1] ^ v;
}
/* Does the edge cost so much less than its length that it is one of a crease? Seams stay there. */
static inline bool ktg_sheet_is_crease(const ktg_sheet *sheet, uint32_t edge) {
    return sheet->cost[edge] < 0.75 * sheet->length[edge];
}

/* V - E + F is 1, as that of a disk. */
static inline bool ktg_sheet_is_disk(const ktg_sheet *sheet) {
    return (int64_t)sheet->mesh->vertex_count - sheet->edge_count + sheet->mesh->face_count == 1;
}

/* Area vector of a face: normal times area. */
ktg_vec3 ktg_sheet_area(const ktg_mesh *mesh, uint32_t face);

/* ---- path.c ------------------------------------------------------------------------------- */

/* What a path may and should do. Vertex flags are vertex_count. */
typedef struct ktg_path_query {
    const ktg_sheet *sheet;
    const double *cost;     /* edge_count */
    const bool *from, *to;  /* where it starts and ends */
    const bool *forbidden;  /* where it may not pass (NULL: nowhere); ends are exempt */
    const bool *edges_only; /* edges it may take (edge_count; NULL: all inner ones) */
    uint32_t straight_on;   /* an edge it carries on from at its start, or KTG_NONE */
} ktg_path_query;

/* Edges in order from start to end; count 0 where there is no way. edges: room for vertex_count.
 * The sum of cost and, for each turn by an angle a, of a^2 times half the mean edge, is least
 * (Dijkstra over directed edges). */
KTG_NODISCARD ktg_status ktg_path_find(ktg_context *context, const ktg_path_query *query,
                                       uint32_t *edges, uint32_t *count);

/* Distance from each vertex to the nearest one that is marked, along edges by `cost`; INFINITY
 * where there is no way; via: the edge towards it (KTG_NONE), or NULL. */
KTG_NODISCARD ktg_status ktg_path_distances(ktg_context *context, const ktg_sheet *sheet,
                                            const double *cost, const bool *from, double *distance,
                                            uint32_t *via);

/* ---- open.c ------------------------------------------------------------------------------- */

/* As ktg_seams_open, for the edges of a sheet. */
KTG_NODISCARD ktg_status ktg_sheet_open(ktg_context *context, const ktg_mesh *mesh,
                                        const ktg_adjacency *adjacency, bool *cut);

/* ---- chain.c ------------------------------------------------------------------------------ */

/* A run of seam edges between two places where seams meet or end, or all around. */
typedef struct ktg_chain {
    uint32_t first, count; /* in ktg_chains.edges, in order */
    uint32_t ends[2];      /* vertices; the same twice for a loop */
    double length;
} ktg_chain;

typedef struct ktg_chains {
    uint32_t count;
    ktg_chain *chains;
    uint32_t *edges;
} ktg_chains;

/* The runs of inner edges with `cut` set and `fixed` (or NULL) not set, by their first edges. */
KTG_NODISCARD ktg_status ktg_chains_find(ktg_context *context, const ktg_sheet *sheet,
                                         const bool *cut, const bool *fixed, ktg_chains *chains);
void ktg_chains_free(ktg_chains *chains);

/* Ends of runs in the middle of a panel. The chains are those of all seams. */
uint32_t ktg_chains_darts(const ktg_sheet *sheet, const ktg_chains *chains);
/* Ends of runs where they meet others, inside. */
uint32_t ktg_chains_corners(const ktg_sheet *sheet, const ktg_chains *chains);

/* ---- smooth.c ----------------------------------------------------------------------------- */

/* Takes short wiggles out of a line; its ends stay. */
void ktg_line_smooth(ktg_vec3 *points, uint32_t count);

/* Leads a run of seams anew, so that it is short by `cost` (edge_count) and bends little, without
 * leaving its neighbourhood or touching another seam; an end on the border may move along it. */
KTG_NODISCARD ktg_status ktg_chain_smooth(ktg_context *context, const ktg_sheet *sheet,
                                          const double *cost, const ktg_chains *chains,
                                          uint32_t chain, bool *cut);

/* All of them, twice. The number of panels may change where seams are tangled: the caller looks. */
KTG_NODISCARD ktg_status ktg_seams_smooth(ktg_context *context, const ktg_sheet *sheet,
                                          const double *cost, const bool *fixed, bool *cut);

/* ---- fit.c -------------------------------------------------------------------------------- */

typedef struct ktg_fit {
    double area;
    double excess; /* integral over the area of log2(strain / (0.8 limit)), where positive */
    double beyond; /* part of the area beyond the limit, or folded */
    double waste;  /* part of its convex hull that the flat shape leaves empty */
    bool known;    /* is it known whether it comes out without fold and overlap ... */
    bool flat;     /* ... and does it */
    bool good;     /* flat, and within the limit */
} ktg_fit;

/* What the limit is, and what has been spent; one for each thread. */
typedef struct ktg_fit_limit {
    double max_strain, area_part;
    bool thorough; /* find out whether it is flat even where it is far beyond the limit */
    uint64_t work; /* faces laid flat, added to */
} ktg_fit_limit;

/* The mesh is a disk. */
KTG_NODISCARD ktg_status ktg_fit_measure(ktg_context *context, const ktg_mesh *mesh,
                                         ktg_fit_limit *limit, ktg_fit *fit);

/* The area that is beyond the limit and should not be; all of it where the panel cannot be laid
 * flat. */
static inline double ktg_fit_failing(const ktg_fit *fit, const ktg_fit_limit *limit) {
    if (fit->known && !fit->flat)
        return fit->area;
    double over = fit->beyond - (1 - limit->area_part);
    return over > 0 ? over * fit->area : 0;
}

/* How awkward a panel of this shape is to cut and to sew, as seam length that one would rather sew,
 * in square roots of the area around: some for being one panel, more for arms and hollows. */
static inline double ktg_fit_shape(const ktg_fit *fit) {
    return 0.5 + 6 * fit->waste * fit->waste;
}

/* A flat shape that is there already. */
KTG_NODISCARD ktg_status ktg_fit_of_flat(ktg_context *context, const ktg_panel *panel,
                                         const ktg_vec2 *flat, const ktg_fit_limit *limit,
                                         ktg_fit *fit);

/* ---- matched.c ---------------------------------------------------------------------------- */

/* All panels, which are disks, with both sides of each seam made equally long. *fits: one for each
 * panel of ktg_cut_apart, allocated, freed with ktg_free. */
KTG_NODISCARD ktg_status ktg_fit_matched(ktg_context *context, const ktg_mesh *mesh,
                                         const bool *cut, ktg_fit_limit *limit, ktg_fit **fits,
                                         uint32_t *count);

/* ---- fit.c, once more --------------------------------------------------------------------- */

/* How much the conformal map with a border that keeps its length would have to scale, as a
 * logarithm: largest where a cut takes most strain away. scale: vertex_count. */
KTG_NODISCARD ktg_status ktg_fit_scales(ktg_context *context, const ktg_mesh *mesh, double *scale);

/* ---- axes.c ------------------------------------------------------------------------------- */

ktg_vec3 ktg_face_centre(const ktg_mesh *mesh, uint32_t face);

/* Mean and principal axes (largest first) of a vector for each face, weighted by area. */
void ktg_axes_of_vectors(const ktg_mesh *mesh, const ktg_vec3 *vectors, ktg_vec3 *mean,
                         ktg_vec3 axes[3]);

/* ---- label.c ------------------------------------------------------------------------------ */

/* Which faces lie above a threshold *at: that below which `part` of the area lies or, where part is
 * 0, the one that separates low from high values best. Cleaned. side: face_count. */
KTG_NODISCARD ktg_status ktg_label_by_value(ktg_context *context, const ktg_sheet *sheet,
                                            const double *value, double part, bool *side,
                                            double *at);
/* Teeth and islands go over to the other side. */
KTG_NODISCARD ktg_status ktg_label_clean(ktg_context *context, const ktg_sheet *sheet, bool *side);
/* Sets the edges between the two sides. */
void ktg_label_edges(const ktg_sheet *sheet, const bool *side, bool *cut);

/* Makes edges cost more the further they lie from the plane normal . p = offset. */
void ktg_plane_cost(const ktg_sheet *sheet, ktg_vec3 normal, double offset, double *cost);

/* ---- trial.c ------------------------------------------------------------------------------ */

/* How a panel fits when it is cut in some way and what is no disk is opened. */
typedef struct ktg_trial {
    uint32_t panels;
    double excess, beyond_area; /* sums over the panels */
    double shape;               /* sum of how awkward the panels are to sew (ktg_fit_shape) */
    double least_area;          /* of a panel */
    double length;              /* of the seams */
    bool good;                  /* every panel is */
} ktg_trial;

/* cut: of the sheet's edges. */
KTG_NODISCARD ktg_status ktg_trial_run(ktg_context *context, const ktg_sheet *sheet,
                                       const bool *cut, ktg_fit_limit *limit, ktg_trial *trial);

/* ---- split.c ------------------------------------------------------------------------------ */

/* Number of ways that ktg_split_make knows. */
enum { ktg_split_ways = 19 };

/* Is the way a dart or a cut through a point, and not a line between two regions? */
static inline bool ktg_split_is_line(uint32_t way) {
    return way < 6 || way == 18;
}

/* What the ways are made from. */
typedef struct ktg_split ktg_split;

KTG_NODISCARD ktg_status ktg_split_new(ktg_context *context, const ktg_sheet *sheet,
                                       ktg_split **split);
void ktg_split_free(ktg_split **split);

/* Sets in `cut` (edge_count, all false) the edges of one way; none where that way does not apply.
 * cost (edge_count; the sheet's at first): for smoothing it, lower near where the seam should run.
 */
KTG_NODISCARD ktg_status ktg_split_make(ktg_context *context, const ktg_split *split, uint32_t way,
                                        bool *cut, double *cost);

/* The edges across the middle of a sheet's longest extent; of another one where that gives none. */
KTG_NODISCARD ktg_status ktg_split_halve(ktg_context *context, const ktg_sheet *sheet, bool *cut);

/* ---- mirror.c ----------------------------------------------------------------------------- */

typedef struct ktg_mirror {
    bool found;
    ktg_vec3 normal; /* unit; the plane: normal . p = offset */
    double offset;
} ktg_mirror;

KTG_NODISCARD ktg_status ktg_mirror_find(ktg_context *context, const ktg_sheet *sheet,
                                         ktg_mirror *mirror);

static inline double ktg_mirror_side(const ktg_mirror *m, ktg_vec3 p) {
    return m->normal.x * p.x + m->normal.y * p.y + m->normal.z * p.z - m->offset;
}

/* Sets in `plane` (edge_count, all false) the edges along the plane. */
KTG_NODISCARD ktg_status ktg_mirror_cut(ktg_context *context, const ktg_sheet *sheet,
                                        const ktg_mirror *mirror, bool *plane);

/* Sets, on the side where ktg_mirror_side is negative, the mirror images of the seams of the other
 * side; plane: what ktg_mirror_cut set. */
KTG_NODISCARD ktg_status ktg_mirror_seams(ktg_context *context, const ktg_sheet *sheet,
                                          const ktg_mirror *mirror, const bool *plane, bool *cut);

/* The run that is the mirror image of another, or that one itself where there is none. */
uint32_t ktg_mirror_partner(const ktg_sheet *sheet, const ktg_mirror *mirror,
                            const ktg_chains *chains, uint32_t chain);

/* ---- revise.c ----------------------------------------------------------------------------- */

/* What may be done to the seams of a surface when all is cut. */
typedef struct ktg_revision {
    const ktg_sheet *sheet;
    const bool *fixed; /* edge_count: seams that stay */
    const bool *plane; /* edge_count: seams along the mirror plane, or NULL */
    const ktg_mirror *mirror;
    bool small_only; /* small panels only, and not each change on both sides of the mirror */
    ktg_fit_limit *limit;
    uint64_t most_work; /* limit->work may rise to that */
} ktg_revision;

/* Takes away the seams without which panels still fit and are not more awkward to sew. */
KTG_NODISCARD ktg_status ktg_seams_merge(ktg_context *context, const ktg_revision *revision,
                                         bool *cut);

/* Smooths every run of seams where panels fit as before. */
KTG_NODISCARD ktg_status ktg_seams_polish(ktg_context *context, const ktg_revision *revision,
                                          bool *cut);

#endif
