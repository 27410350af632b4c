/* unfold/search.h - what one run of the search shares over all components: limits and counters
 * (unfold only). */
#ifndef KTG_UNFOLD_SEARCH_H
#define KTG_UNFOLD_SEARCH_H

#include "core/random.h"
#include "unfold/unfold.h"

typedef struct ktg_search {
    ktg_random random;
    double deadline;                /* monotonic seconds; 0: none */
    uint32_t faces_done, faces_all; /* for progress: of finished components, of all */
    double mm, area_all;         /* millimetres in a normalised unit, and the area of all faces */
    uint32_t generations_before; /* spent on those components */
    double seconds;              /* spent by transplants until there was one piece */
    double told;                 /* the progress told last */
    bool careful;                /* pieces must fit their sheets whatever tabs they get */
    ktg_unfold_report report;
} ktg_search;

/* False, with the reason in search->report.stopped_by, when time is up or the caller wants to stop.
 */
bool ktg_search_goes_on(ktg_context *context, ktg_search *search);

/* Tells the progress: `own` faces of the present component count as done. It never runs backwards.
 */
void ktg_search_progress(ktg_context *context, ktg_search *search, double own, const char *detail);

#endif
