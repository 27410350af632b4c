/* core/parallel.c - independent pieces of work on several threads. */
#include "core/parallel.h"
#include "core/context.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The calling thread looks for the caller's wish this often while it waits for the others. */
#define LOOK_NANOSECONDS 10000000

typedef struct crew {
    ktg_context *caller;
    ktg_parallel_function *work;
    void *user;
    uint32_t count;
    atomic_uint next, busy; /* the index to begin next; members that are not done */
    atomic_int wish;        /* the caller's, as it was asked last */
    atomic_bool failed;
} crew;

/* One thread's share; the calling thread is member 0. */
typedef struct member {
    crew *crew;
    ktg_context *context;
    pthread_t thread;
    bool runs;
    ktg_status status;
    uint32_t failed_at;
} member;

static void labour(member *m) {
    crew *c = m->crew;
    while (!atomic_load(&c->failed)) {
        uint32_t index = atomic_fetch_add(&c->next, 1);
        if (index >= c->count)
            break;
        m->status = c->work(m->context, index, c->user);
        if (m->status == KTG_OK)
            continue;
        m->failed_at = index;
        atomic_store(&c->failed, true);
        break;
    }
    atomic_fetch_sub(&c->busy, 1);
}

static void *start_labour(void *m) {
    labour(m);
    return NULL;
}

static ktg_wish heard_wish(void *user) {
    return (ktg_wish)atomic_load(&((crew *)user)->wish);
}

static ktg_wish ask_wish(void *user) {
    crew *c = user;
    if (c->caller->cancel)
        atomic_store(&c->wish, (int)c->caller->cancel(c->caller->cancel_user));
    return heard_wish(c);
}

/* A context of its own for each member; NULL leaves the work to the others. */
static ktg_context *context_for(crew *c, bool calling_thread) {
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK)
        return NULL;
    ktg_context_set_seed(context, ktg_context_seed(c->caller));
    ktg_context_set_cancel(context, calling_thread ? ask_wish : heard_wish, c);
    if (calling_thread)
        ktg_context_set_progress(context, c->caller->progress, c->caller->progress_user);
    return context;
}

static void hire(crew *c, member *m, bool calling_thread) {
    *m = (member){.crew = c, .failed_at = UINT32_MAX};
    m->context = context_for(c, calling_thread);
    if (!m->context)
        return;
    atomic_fetch_add(&c->busy, 1);
    m->runs = calling_thread || pthread_create(&m->thread, NULL, start_labour, m) == 0;
    if (!m->runs)
        atomic_fetch_sub(&c->busy, 1);
}

static void wait_for_all(crew *c, member *members, uint32_t count) {
    while (atomic_load(&c->busy) > 0) {
        struct timespec pause = {0, LOOK_NANOSECONDS};
        (void)ask_wish(c);
        nanosleep(&pause, NULL);
    }
    for (uint32_t i = 1; i < count; i++)
        if (members[i].runs)
            pthread_join(members[i].thread, NULL);
}

/* The failure of the lowest index, told in the caller's context. */
static ktg_status gather(ktg_context *context, member *members, uint32_t count) {
    const member *first = NULL;
    for (uint32_t i = 0; i < count; i++)
        if (members[i].context && members[i].status != KTG_OK &&
            (!first || members[i].failed_at < first->failed_at))
            first = &members[i];
    ktg_status status = first ? first->status : KTG_OK;
    if (first)
        memcpy(context->message, first->context->message, sizeof context->message);
    for (uint32_t i = 0; i < count; i++)
        ktg_context_free(&members[i].context);
    return status;
}

static ktg_status run_alone(ktg_context *context, uint32_t count, ktg_parallel_function *work,
                            void *user) {
    for (uint32_t i = 0; i < count; i++) {
        ktg_status status = work(context, i, user);
        if (status != KTG_OK)
            return status;
    }
    return KTG_OK;
}

ktg_status ktg_parallel_run(ktg_context *context, uint32_t count, ktg_parallel_function *work,
                            void *user) {
    uint32_t threads = context->threads < count ? context->threads : count;
    member *members = threads > 1 ? calloc(threads, sizeof *members) : NULL;
    if (!members)
        return run_alone(context, count, work, user);
    crew c = {.caller = context, .work = work, .user = user, .count = count};
    hire(&c, &members[0], true);
    for (uint32_t i = 1; i < threads && members[0].runs; i++)
        hire(&c, &members[i], false);
    ktg_status status;
    if (members[0].runs) {
        labour(&members[0]);
        wait_for_all(&c, members, threads);
        status = gather(context, members, threads);
    } else {
        status = run_alone(context, count, work, user);
    }
    free(members);
    return status;
}
