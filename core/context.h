/* core/context.h - what a context holds (core only). */
#ifndef KTG_CORE_CONTEXT_H
#define KTG_CORE_CONTEXT_H

#include "core/core.h"

#define KTG_MESSAGE_SIZE 8192

struct ktg_context {
    char message[KTG_MESSAGE_SIZE];
    ktg_log_function *log;
    void *log_user;
    ktg_progress_function *progress;
    void *progress_user;
    ktg_cancel_function *cancel;
    void *cancel_user;
    uint64_t seed;
    uint32_t threads;            /* at least 1 */
    uint64_t allocation_to_fail; /* counts down; the allocation that reaches 0 fails */
};

#endif
