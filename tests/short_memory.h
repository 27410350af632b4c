/* tests/short_memory.h - whether a call that let an allocation fail has told of it. */
#ifndef KTG_TESTS_SHORT_MEMORY_H
#define KTG_TESTS_SHORT_MEMORY_H

#include "core/context.h"

/* Ends a trial of ktg_context_fail_allocation: a call that says KTG_OK has not come to the
 * allocation that was to fail, or it would have gone on without what it asked for. */
#define end_short_memory(of, status)                                                               \
    do {                                                                                           \
        ktg_context *context_ = (of);                                                              \
        if ((status) == KTG_OK)                                                                    \
            assert_true(context_->allocation_to_fail > 0);                                         \
        ktg_context_fail_allocation(context_, 0);                                                  \
    } while (0)

#endif
