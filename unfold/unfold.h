/* unfold/unfold.h - from a surface to flat pieces that fold into it, without any strain.
 *
 * Two methods: subtree transplants (the default: a spanning tree laid flat, whose overlapping parts
 * are moved until nothing overlaps), and that of Takahashi et al., "Curvature-aware optimized
 * unfolding of 3D meshes" (2010; longer: "Optimized topological surgery for unfolding 3D meshes",
 * CGF 30(7), 2011): spanning tree, strips, cut-count table, genetic merging. docs/unfold.md says
 * which file holds what and what was chosen where the paper is silent. */
#ifndef KTG_UNFOLD_UNFOLD_H
#define KTG_UNFOLD_UNFOLD_H

#include "core/core.h"
#include "mesh/mesh.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ktg_unfold_method {
    KTG_METHOD_AUTO,   /* conflict-driven subtree transplant: one piece in milliseconds */
    KTG_METHOD_GENETIC /* the method of the paper, with fresh starts */
} ktg_unfold_method;

/* What is done when one piece does not fit the sheet at the scale that is asked for. */
typedef enum ktg_oversize {
    KTG_OVERSIZE_SPLIT, /* the fewest pieces such that each fits with its tabs */
    KTG_OVERSIZE_ERROR  /* one piece all the same; laying it out says which size would fit */
} ktg_oversize;

/* What somebody wants of one edge: that it stays a fold, or that it is cut. */
typedef struct ktg_edge_rule {
    uint32_t vertices[2]; /* of the mesh, in either order */
    bool cut;             /* false: it stays a fold, whatever that costs */
    uint32_t numbers[2];  /* what messages call the two vertices, ... */
    const char *file;     /* ... and where the rule stands; or NULL */
    uint64_t line;
} ktg_edge_rule;

/* Section 5 of the paper, where nothing else is said. ktg_unfold_defaults gives its values. */
typedef struct ktg_unfold_options {
    ktg_unfold_method method; /* auto */
    ktg_effort effort;      /* normal: work spent on making a piece compact, so that it fits a sheet
                               at a larger scale, and on cuts whose tabs have room (auto only); at
                               500 faces about 0.1, 0.6 and 10 seconds in all */
    ktg_sheet_format sheet; /* what a piece should fill; A4 */
    ktg_finish_options finish; /* the tabs it should have room for; those of ktg_finish_defaults */
    double ease; /* 0..10: how much it counts that a net is easy to glue, against size and tabs: the
                    two copies of a cut edge lie near each other, seams are few and long, nothing
                    hangs by a short edge; 0 (not at all) */
    double mm_per_unit; /* the scale; 0: as large as the sheet allows, which is found out later */
    ktg_oversize oversize; /* with a scale: split */
    uint32_t pieces;       /* each part becomes so many; 0: as few as possible */
    uint32_t piece_faces;  /* a piece has at most so many faces; 0: any number */
    uint32_t population;   /* chromosomes in a generation, at least 4; 32 */
    uint32_t generations;  /* at most this many; 2000 */
    uint32_t patience;     /* stop after so many generations without gain; 30 */
    double crossover_rate; /* 0..1; 0.8 */
    double mutation_rate;  /* 0..1; 0.1 */
    uint32_t restarts;     /* fresh starts from other strips while a component is in several pieces;
                              20 (0: the paper) */
    double seconds;        /* an upper bound on the search's time; 0: none */
    const ktg_edge_rule *rules; /* rule_count, borrowed; NULL where there is none */
    uint32_t rule_count;
} ktg_unfold_options;

KTG_API void ktg_unfold_defaults(ktg_unfold_options *options);

typedef enum ktg_stopped_by {
    KTG_STOPPED_DONE, /* one piece per part, or converged */
    KTG_STOPPED_WORK, /* the generations were used up */
    KTG_STOPPED_TIME,
    KTG_STOPPED_INTERRUPT
} ktg_stopped_by;

typedef struct ktg_unfold_report {
    uint32_t pieces, components;
    uint32_t parts;              /* what is left connected by the cuts that rules ask for; at least
                                    the components, and the fewest pieces there can be */
    uint32_t strips;             /* initial patches of all components, in the first run */
    uint32_t restarts;           /* of all components together */
    uint32_t generations;        /* of all components together */
    uint64_t evaluations;        /* chromosomes decoded, or steps of the transplant search */
    double seconds_to_one_piece; /* of all parts together; 0 where a part has more pieces
                                    (auto only) */
    ktg_stopped_by stopped_by;
} ktg_unfold_report;

/* Unfolds every component of an oriented manifold (as ktg_mesh_repair leaves it; KTG_ARGUMENT
 * otherwise). The pattern holds the surface and the pieces in the model's unit, edges with kind and
 * angle, no tabs; each face lies in exactly one piece and no two faces of a piece overlap by more
 * than 1e-7 of the model's size. What cannot be merged stays a further piece, so there is always an
 * answer. `name`: what a single component is called. Inner edges of coplanar input polygons
 * (mesh->face_polygon) stay folds unless a piece has to be split. options->rules are obeyed or the
 * call fails: KTG_ARGUMENT where a rule names no inner edge or two rules contradict each other,
 * KTG_GEOMETRY, with the edge or vertex, where folds that are to be kept cannot be laid flat, or
 * not without overlaps. A cut that a rule asks for stays one even where it closes by itself. With a
 * scale and KTG_OVERSIZE_SPLIT, KTG_GEOMETRY names a face that is larger than the sheet, and the
 * size at which it fits. A
 * cancel callback that says KTG_FINISH ends the search early with the best pieces so far
 * (stopped_by says so); KTG_STOP fails with KTG_CANCELLED. */
KTG_API KTG_NODISCARD ktg_status ktg_unfold(ktg_context *context, const ktg_mesh *mesh,
                                            const char *name, const ktg_unfold_options *options,
                                            ktg_pattern **pattern, ktg_unfold_report *report);

/* "done", "work", "time", "interrupt". */
KTG_API const char *ktg_stopped_by_name(ktg_stopped_by stopped_by);

#ifdef __cplusplus
}
#endif
#endif
