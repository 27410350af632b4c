/* core/context.c - the context: last error, callbacks, seed. */
#include "core/context.h"
#include "core/text.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#ifndef KTG_VERSION
#define KTG_VERSION "0"
#endif

const char *ktg_version(void) {
    return KTG_VERSION;
}

const char *ktg_status_name(ktg_status status) {
    static const char *const names[] = {"ok",    "argument", "file",      "format",  "geometry",
                                        "limit", "memory",   "cancelled", "unsound", "internal"};
    size_t index = (size_t)status;
    return index < sizeof names / sizeof *names ? names[index] : "unknown";
}

ktg_status ktg_context_new(ktg_context **context) {
    *context = calloc(1, sizeof **context);
    if (!*context)
        return KTG_MEMORY;
    (*context)->seed = 1;
    (*context)->threads = 1;
    return KTG_OK;
}

void ktg_context_free(ktg_context **context) {
    if (!context)
        return;
    free(*context);
    *context = NULL;
}

void ktg_context_set_log(ktg_context *context, ktg_log_function *log, void *user) {
    context->log = log;
    context->log_user = user;
}

void ktg_context_set_progress(ktg_context *context, ktg_progress_function *progress, void *user) {
    context->progress = progress;
    context->progress_user = user;
}

void ktg_context_set_cancel(ktg_context *context, ktg_cancel_function *cancel, void *user) {
    context->cancel = cancel;
    context->cancel_user = user;
}

void ktg_context_set_seed(ktg_context *context, uint64_t seed) {
    context->seed = seed;
}

uint64_t ktg_context_seed(const ktg_context *context) {
    return context->seed;
}

void ktg_context_set_threads(ktg_context *context, uint32_t threads) {
    context->threads = threads > 0 ? threads : 1;
}

const char *ktg_context_message(const ktg_context *context) {
    return context->message;
}

void ktg_context_fail_allocation(ktg_context *context, uint64_t nth) {
    context->allocation_to_fail = nth;
}

ktg_status ktg_fail(ktg_context *context, ktg_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    ktg_vformat_elided(context->message, sizeof context->message, format, arguments);
    va_end(arguments);
    return status;
}

ktg_status ktg_about_file(ktg_context *context, const char *path, ktg_status status) {
    if (status != KTG_GEOMETRY && status != KTG_LIMIT)
        return status;
    char text[KTG_MESSAGE_SIZE];
    memcpy(text, context->message, sizeof text);
    return ktg_fail(context, status, "%s: %s", strcmp(path, "-") == 0 ? "standard input" : path,
                    text);
}

void ktg_log(ktg_context *context, ktg_log_level level, const char *format, ...) {
    if (!context->log)
        return;
    char line[KTG_MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    ktg_vformat_elided(line, sizeof line, format, arguments);
    va_end(arguments);
    context->log(context->log_user, level, line);
}

void ktg_progress(ktg_context *context, const char *stage, double fraction, const char *detail) {
    if (context->progress)
        context->progress(context->progress_user, stage, fraction, detail);
}

ktg_status ktg_check_cancel(ktg_context *context) {
    if (context->cancel && context->cancel(context->cancel_user) == KTG_STOP)
        return ktg_fail(context, KTG_CANCELLED, "interrupted");
    return KTG_OK;
}

bool ktg_wants_finish(ktg_context *context) {
    return context->cancel && context->cancel(context->cancel_user) != KTG_GO_ON;
}
