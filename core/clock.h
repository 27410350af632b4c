/* core/clock.h - a clock for reports and time limits (shared between folders, not installed). */
#ifndef KTG_CORE_CLOCK_H
#define KTG_CORE_CLOCK_H

#include <time.h>

/* Seconds of the monotonic clock; only differences mean anything. */
static inline double ktg_clock_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
