/* verify/verify.h - proving a pattern, by code that shares nothing with what made it.
 *
 * docs/verify.md lists every check and its tolerance. */
#ifndef KTG_VERIFY_VERIFY_H
#define KTG_VERIFY_VERIFY_H

#include "core/core.h"
#include "mesh/mesh.h"
#include "pattern/pattern.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ktg_verify_report {
    uint32_t pieces, components, sheets;
    uint32_t most_pieces; /* of one component */
    double length_error;  /* largest relative error of an edge's length in 2D against 3D (paper) */
    double refold_error;  /* largest distance of a refolded vertex to its place, over the surface's
                             diagonal */
    double deepest_overlap_mm; /* of two faces or tabs; 0: nothing touches */
    bool model_compared;
    double model_error; /* against the model: of the similarity, over the diagonal (not simplified),
                           or ... */
    double hausdorff_mm;    /* ... the Hausdorff distance in print (simplified) */
    uint32_t problem_count; /* all problems found; the first ones are in the message */
} ktg_verify_report;

/* Checks that the pattern is what it says: each face of the surface exactly once and the right way
 * round, edge kinds, sides and mates as the surface's own adjacency has them, lengths (1e-9
 * relative), folds (refolded by its angles every piece lands on the surface, 1e-6), no faces and no
 * tabs overlapping (deeper than 1 micrometre), tabs on their edges and inside the mate's flat
 * region, outlines, seams, labels in place, sheets and placements, one sheet place per piece and
 * inside the printable area. With `model` (the file's mesh, after ktg_mesh_repair): the surface
 * equals it up to one similarity when it was not simplified, else the distance is measured.
 * KTG_UNSOUND with the first problems in the message, one on a line, and all counted in the report
 * (which may be NULL). KTG_CANCELLED, KTG_MEMORY. */
KTG_API KTG_NODISCARD ktg_status ktg_verify(ktg_context *context, const ktg_pattern *pattern,
                                            const ktg_mesh *model, ktg_verify_report *report);

#ifdef __cplusplus
}
#endif
#endif
