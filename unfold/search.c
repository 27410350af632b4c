/* unfold/search.c - limits of a search. */
#include "unfold/search.h"
#include "core/clock.h"

bool ktg_search_goes_on(ktg_context *context, ktg_search *search) {
    ktg_stopped_by *why = &search->report.stopped_by;
    if (*why == KTG_STOPPED_TIME || *why == KTG_STOPPED_INTERRUPT)
        return false;
    if (ktg_wants_finish(context))
        *why = KTG_STOPPED_INTERRUPT;
    else if (search->deadline > 0 && ktg_clock_seconds() > search->deadline)
        *why = KTG_STOPPED_TIME;
    else
        return true;
    return false;
}

void ktg_search_progress(ktg_context *context, ktg_search *search, double own, const char *detail) {
    double fraction = (search->faces_done + own) / search->faces_all;
    search->told = fraction > search->told ? fraction : search->told;
    ktg_progress(context, "unfold", search->told, detail);
}

const char *ktg_stopped_by_name(ktg_stopped_by stopped_by) {
    static const char *const names[] = {"done", "work", "time", "interrupt"};
    return names[stopped_by];
}
