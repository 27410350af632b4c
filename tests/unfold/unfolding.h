/* tests/unfold/unfolding.h - options that take little time, and an unfolding with them. */
#ifndef KTG_TESTS_UNFOLD_UNFOLDING_H
#define KTG_TESTS_UNFOLD_UNFOLDING_H

#include "tests/unfold/reference.h"
#include "unfold/unfold.h"

static inline ktg_unfold_options options_of(ktg_unfold_method method) {
    ktg_unfold_options options;
    ktg_unfold_defaults(&options);
    options.method = method;
    options.effort = KTG_EFFORT_QUICK;
    return options;
}

/* Little work, where something is done often. */
static inline ktg_unfold_options quick(void) {
    ktg_unfold_options options = options_of(KTG_METHOD_GENETIC);
    options.population = 8;
    options.patience = 4;
    options.restarts = 2;
    return options;
}

static inline ktg_pattern *unfold_by(ktg_context *context, ktg_unfold_method method,
                                     const ktg_mesh *mesh, ktg_unfold_report *report) {
    ktg_pattern *pattern;
    ktg_unfold_options options = options_of(method);
    assert_int_equal(ktg_unfold(context, mesh, "model", &options, &pattern, report), KTG_OK);
    return pattern;
}

#endif
