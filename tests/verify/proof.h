/* tests/verify/proof.h - patterns accepted, and refused for a reason. */
#ifndef KTG_TESTS_VERIFY_PROOF_H
#define KTG_TESTS_VERIFY_PROOF_H

#include "verify/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

static inline int setup(void **state) {
    return ktg_context_new((ktg_context **)state) != KTG_OK;
}

static inline int teardown(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

static inline void accept(ktg_context *context, const ktg_pattern *p, const ktg_mesh *model,
                          ktg_verify_report *report) {
    if (ktg_verify(context, p, model, report) != KTG_OK)
        fail_msg("%s", ktg_context_message(context));
}

static inline void refuse(ktg_context *context, const ktg_pattern *p, const ktg_mesh *model,
                          const char *reason) {
    ktg_verify_report report;
    ktg_status status = ktg_verify(context, p, model, &report);
    if (status != KTG_UNSOUND || !strstr(ktg_context_message(context), reason))
        fail_msg("status %s, \"%s\" instead of \"%s\"", ktg_status_name(status),
                 ktg_context_message(context), reason);
}

#endif
