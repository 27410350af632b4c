/* tests/verify/damage.h - a pattern to damage, and what is said of it then. */
#ifndef KTG_TESTS_VERIFY_DAMAGE_H
#define KTG_TESTS_VERIFY_DAMAGE_H

#include "nets.h"
#include "verify/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A fresh pattern for each test, and the context. */
typedef struct fixture {
    ktg_context *context;
    ktg_pattern *p;
    ktg_verify_report report;
} fixture;

static inline int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return !f || ktg_context_new(&f->context) != KTG_OK;
}

static inline int teardown(void **state) {
    fixture *f = *state;
    ktg_pattern_free(&f->p);
    ktg_context_free(&f->context);
    free(f);
    return 0;
}

static inline ktg_pattern *take(void **state, const net *n) {
    fixture *f = *state;
    ktg_pattern_free(&f->p);
    f->p = net_make(f->context, n);
    return f->p;
}

static inline void accept(void **state) {
    fixture *f = *state;
    if (ktg_verify(f->context, f->p, NULL, &f->report) != KTG_OK)
        fail_msg("%s", ktg_context_message(f->context));
    assert_int_equal(f->report.problem_count, 0);
}

static inline void refuse(void **state, const char *reason) {
    fixture *f = *state;
    ktg_status status = ktg_verify(f->context, f->p, NULL, &f->report);
    const char *message = ktg_context_message(f->context);
    if (status != KTG_UNSOUND || !strstr(message, reason))
        fail_msg("status %s, \"%s\" instead of \"%s\"", ktg_status_name(status), message, reason);
    assert_true(f->report.problem_count > 0);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
