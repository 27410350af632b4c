/* core/parallel.h - independent pieces of work on several threads (shared between folders, not
 * installed). */
#ifndef KTG_CORE_PARALLEL_H
#define KTG_CORE_PARALLEL_H

#include "core/core.h"

/* Does the work number `index`. The context is for this call alone; its cancel callback tells what
 * the caller's wants. */
typedef ktg_status ktg_parallel_function(ktg_context *context, uint32_t index, void *user);

/* Calls work(…, 0, user) … work(…, count - 1, user), begun in this order, on as many threads as
 * the context allows (ktg_context_set_threads). With one thread all are done with `context` itself.
 * With several, its callbacks are still called from the calling thread only: progress is told of
 * what that thread works on, a wish to stop reaches all. The first failure keeps work that has not
 * begun from beginning; the status and message of the lowest index that failed are returned. What
 * the calls write must not overlap; then the result is the same for any number of threads. */
KTG_NODISCARD ktg_status ktg_parallel_run(ktg_context *context, uint32_t count,
                                          ktg_parallel_function *work, void *user);

#endif
