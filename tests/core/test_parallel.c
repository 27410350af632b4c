/* Work on several threads: everything is done once, wishes reach all, the first failure is told. */
#include "core/memory.h"
#include "core/parallel.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#define COUNT 200

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

typedef struct tally {
    atomic_uint done[COUNT];
    pthread_t caller;
    atomic_uint asked, told, elsewhere; /* callbacks, and those from another thread */
    atomic_uint ended;
} tally;

static ktg_status count_it(ktg_context *context, uint32_t index, void *user) {
    ((tally *)user)->done[index]++;
    ktg_progress(context, "count", index / (double)COUNT, NULL);
    return ktg_check_cancel(context);
}

static ktg_wish ask(void *user) {
    tally *t = user;
    t->asked++;
    t->elsewhere += !pthread_equal(pthread_self(), t->caller);
    return KTG_GO_ON;
}

static void tell(void *user, const char *stage, double fraction, const char *detail) {
    tally *t = user;
    (void)stage, (void)fraction, (void)detail;
    t->told++;
    t->elsewhere += !pthread_equal(pthread_self(), t->caller);
}

static void all_is_done_once_by_any_number_of_threads(void **state) {
    for (uint32_t threads = 0; threads < 6; threads++) {
        tally t = {.caller = pthread_self()};
        ktg_context_set_threads(*state, threads);
        ktg_context_set_cancel(*state, ask, &t);
        ktg_context_set_progress(*state, tell, &t);
        assert_int_equal(ktg_parallel_run(*state, COUNT, count_it, &t), KTG_OK);
        for (uint32_t i = 0; i < COUNT; i++)
            assert_int_equal(t.done[i], 1);
        assert_int_equal(t.elsewhere, 0);
        assert_int_equal(ktg_parallel_run(*state, 0, count_it, &t), KTG_OK);
    }
}

static ktg_status fail_some(ktg_context *context, uint32_t index, void *user) {
    (void)user;
    return index == 20 || index > 24 ? ktg_fail(context, KTG_LIMIT, "number %u is too much", index)
                                     : KTG_OK;
}

static void the_lowest_failure_is_told(void **state) {
    for (uint32_t threads = 1; threads < 6; threads++) {
        ktg_context_set_threads(*state, threads);
        assert_int_equal(ktg_parallel_run(*state, COUNT, fail_some, NULL), KTG_LIMIT);
        assert_string_equal(ktg_context_message(*state), "number 20 is too much");
    }
}

static ktg_wish stop_after_some(void *user) {
    return ++((tally *)user)->asked > 50 ? KTG_STOP : KTG_GO_ON;
}

/* Goes on until it is told to stop, on whatever thread. */
static ktg_status work_until_stopped(ktg_context *context, uint32_t index, void *user) {
    (void)index;
    ktg_status status;
    while ((status = ktg_check_cancel(context)) == KTG_OK)
        ;
    ((tally *)user)->ended++;
    return status;
}

static void a_wish_to_stop_reaches_all(void **state) {
    tally t = {.caller = pthread_self()};
    ktg_context_set_threads(*state, 4);
    ktg_context_set_cancel(*state, stop_after_some, &t);
    assert_int_equal(ktg_parallel_run(*state, 4, work_until_stopped, &t), KTG_CANCELLED);
    assert_in_range(t.ended, 1, 4);
}

/* Ends when as many as there are threads have begun, or, in vain, after ten seconds. */
static ktg_status wait_for_others(ktg_context *context, uint32_t index, void *user) {
    tally *t = user;
    (void)context, (void)index;
    t->told++;
    for (int waits = 0; t->told < 3 && waits < 10000; waits++)
        nanosleep(&(struct timespec){0, 1000000}, NULL);
    return t->told == 3 ? KTG_OK : KTG_INTERNAL;
}

static void three_threads_work_at_the_same_time(void **state) {
    tally t = {.caller = pthread_self()};
    ktg_context_set_threads(*state, 3);
    assert_int_equal(ktg_parallel_run(*state, 3, wait_for_others, &t), KTG_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(all_is_done_once_by_any_number_of_threads, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(three_threads_work_at_the_same_time, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(the_lowest_failure_is_told, make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_wish_to_stop_reaches_all, make_context, drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
