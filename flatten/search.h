/* flatten/search.h - the search for seams: what it knows, and its parts (this room only).
 *
 *     ktg_search_cut_panel  one panel that does not fit, cut in the best of many ways
 *     ktg_search_refine     every panel, until it fits
 *     ktg_search_judge      what came of it
 *
 * flatten/seams_auto.c runs them. */
#ifndef KTG_FLATTEN_SEARCH_H
#define KTG_FLATTEN_SEARCH_H

#include "flatten/sheet.h"

typedef struct ktg_search {
    const ktg_seams_auto_options *options;
    ktg_mesh mesh; /* positions normalised; borrowed */
    const ktg_adjacency *adjacency;
    ktg_sheet *sheet; /* of the whole */
    ktg_mirror mirror;
    bool *given, *plane, *cut; /* edge_count: as it was; along the mirror plane; as it is */
    bool *done;                /* face_count: its panel fits, or cannot be helped */
    ktg_fit_limit limit;
    double budget;       /* work there is, in parts of what is usual */
    bool exhausted;      /* work ran out, or the caller wants to finish */
    uint32_t first_rank; /* which way is taken at the first cut: the best, the second best, ... */
    bool lines_last;     /* darts and the like only where nothing else helps */
    bool begun;          /* the first cut is made */
} ktg_search;

static inline bool ktg_any(const bool *flags, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (flags[i])
            return true;
    return false;
}

/* ---- ways.c ------------------------------------------------------------------------------- */

/* Tries all ways of cutting a panel (`sheet` is its mesh, `before` how it fits uncut) and sets in
 * `cut` (the sheet's edges) the one that gains most; none where nothing helps. */
KTG_NODISCARD ktg_status ktg_search_cut_panel(ktg_context *context, ktg_search *search,
                                              const ktg_sheet *sheet, const ktg_trial *before,
                                              bool *cut);

/* Measures a panel even where it is far beyond the limit; one that is no disk is not flat. */
KTG_NODISCARD ktg_status ktg_search_measure(ktg_context *context, ktg_search *search,
                                            const ktg_sheet *sheet, ktg_fit *fit);

/* ---- refine.c ----------------------------------------------------------------------------- */

/* Cuts panels that are not done until none is left, or the caller wants to finish; with `half` only
 * those on the positive side of the mirror. */
KTG_NODISCARD ktg_status ktg_search_refine(ktg_context *context, ktg_search *search, bool half);

/* ---- judge.c ------------------------------------------------------------------------------ */

typedef struct ktg_outcome {
    double slid;     /* judged as ktg_seams_slide leaves the surface by this part; 0: as it is */
    bool exhausted;  /* the search was when it ended */
    uint32_t beyond; /* panels that do not fit */
    double failing;  /* area that is beyond the limit and should not be */
    double worst;    /* of all panels the largest part of the area beyond */
    double awkward;  /* shapes of panels, darts, and length of seams */
} ktg_outcome;

/* By the limit that was asked for. */
KTG_NODISCARD ktg_status ktg_search_judge(ktg_context *context, ktg_search *search,
                                          ktg_outcome *outcome);

/* First what fails the limit, if that differs clearly, then what is awkward to sew. */
bool ktg_outcome_is_better(const ktg_outcome *a, const ktg_outcome *b);

#endif
