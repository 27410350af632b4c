/* core/core.h - what every other folder stands on: status, context, small plain types, output
 * files.
 *
 * Every function of the library that can fail takes a ktg_context first and returns a ktg_status.
 * The text of the last failure is in the context. The library never prints and never exits. */
#ifndef KTG_CORE_CORE_H
#define KTG_CORE_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define KTG_API            __attribute__((visibility("default")))
#define KTG_NODISCARD      __attribute__((warn_unused_result))
#define KTG_PRINTF(at, va) __attribute__((format(printf, at, va)))
#else
#define KTG_API
#define KTG_NODISCARD
#define KTG_PRINTF(at, va)
#endif

/* "No such index" in any array of indices. */
#define KTG_NONE UINT32_MAX

typedef enum ktg_status {
    KTG_OK = 0,
    KTG_ARGUMENT,  /* a value the caller passed makes no sense */
    KTG_FILE,      /* a file cannot be opened, read or written */
    KTG_FORMAT,    /* a file's content is not what its format demands */
    KTG_GEOMETRY,  /* the shape cannot be worked on (nothing left of it, does not fit, ...) */
    KTG_LIMIT,     /* larger than what is supported */
    KTG_MEMORY,    /* out of memory */
    KTG_CANCELLED, /* the caller's cancel function said so */
    KTG_UNSOUND,   /* a pattern that does not hold what it promises */
    KTG_INTERNAL   /* a defect of this library */
} ktg_status;

/* How much work a search spends; counted, so that results do not depend on the machine. */
typedef enum ktg_effort { KTG_EFFORT_QUICK, KTG_EFFORT_NORMAL, KTG_EFFORT_BEST } ktg_effort;

/* Points and vectors; plain, so that arrays of them are arrays of doubles. */
typedef struct ktg_vec2 {
    double x, y;
} ktg_vec2;

typedef struct ktg_vec3 {
    double x, y, z;
} ktg_vec3;

/* "1.2.3". */
KTG_API const char *ktg_version(void);

/* A short English name of a status ("format"), for logs and reports. Never NULL. */
KTG_API const char *ktg_status_name(ktg_status status);

/* ---- context ------------------------------------------------------------------------------ */

/* Carries the last error's text, the callbacks, the seed and the number of threads. One context is
 * used by one thread at a time; several contexts are independent of each other. */
typedef struct ktg_context ktg_context;

typedef enum ktg_log_level { KTG_LOG_NOTE, KTG_LOG_WARNING } ktg_log_level;

/* `text` is one line without a newline, valid during the call. */
typedef void ktg_log_function(void *user, ktg_log_level level, const char *text);
/* `stage` is one word or two ("simplify", "unfold"); `fraction` runs from 0 to 1 within it;
 * `detail` is a short text for people, or NULL. */
typedef void ktg_progress_function(void *user, const char *stage, double fraction,
                                   const char *detail);
/* What the caller wants a running job to do; asked often. An answer other than KTG_GO_ON must be
 * kept up. */
typedef enum ktg_wish {
    KTG_GO_ON,
    KTG_FINISH, /* end searches with the best found so far, then do the rest of the job */
    KTG_STOP    /* give up: the call fails with KTG_CANCELLED */
} ktg_wish;
typedef ktg_wish ktg_cancel_function(void *user);

/* Makes a context with no callbacks and seed 1. On KTG_MEMORY *context is NULL. */
KTG_API KTG_NODISCARD ktg_status ktg_context_new(ktg_context **context);

/* Frees and clears; NULL and pointers to NULL are fine. */
KTG_API void ktg_context_free(ktg_context **context);

/* Callbacks; NULL takes one away. `user` is handed back at each call. */
KTG_API void ktg_context_set_log(ktg_context *context, ktg_log_function *log, void *user);
KTG_API void ktg_context_set_progress(ktg_context *context, ktg_progress_function *progress,
                                      void *user);
KTG_API void ktg_context_set_cancel(ktg_context *context, ktg_cancel_function *cancel, void *user);

/* The seed of every random choice. The same input, options and seed give the same bytes. */
KTG_API void ktg_context_set_seed(ktg_context *context, uint64_t seed);

/* How many threads a call may use, 1 at first (and for 0). The result is the same for any number;
 * callbacks are called from the calling thread only. */
KTG_API void ktg_context_set_threads(ktg_context *context, uint32_t threads);
KTG_API uint64_t ktg_context_seed(const ktg_context *context);

/* What the last failure said: one sentence; "" when nothing failed. Owned by the context, valid
 * until the next failure. */
KTG_API const char *ktg_context_message(const ktg_context *context);

/* For tests: the `nth` allocation from now (1 = the next) fails, as if memory were short; 0 =
 * never. */
KTG_API void ktg_context_fail_allocation(ktg_context *context, uint64_t nth);

/* The one place where errors are made: stores the message (printf form) and returns `status`.
 * A message says what is wrong, where (file:line, face) and what to do about it. */
KTG_API ktg_status ktg_fail(ktg_context *context, ktg_status status, const char *format, ...)
    KTG_PRINTF(3, 4);

/* For callers of stages that do not know where a shape came from: puts the file's name before the
 * text of a failure with KTG_GEOMETRY or KTG_LIMIT. Returns `status`, whatever it is. */
KTG_API ktg_status ktg_about_file(ktg_context *context, const char *path, ktg_status status);

/* For stages: hand a line to the log, a fraction to the progress callback; ask whether to give up
 * (KTG_CANCELLED with a message, or KTG_OK), and whether a search should end with what it has. */
KTG_API void ktg_log(ktg_context *context, ktg_log_level level, const char *format, ...)
    KTG_PRINTF(3, 4);
KTG_API void ktg_progress(ktg_context *context, const char *stage, double fraction,
                          const char *detail);
KTG_API KTG_NODISCARD ktg_status ktg_check_cancel(ktg_context *context);
KTG_API bool ktg_wants_finish(ktg_context *context);

/* Frees what the library allocated as a plain array (where a header says "free with ktg_free"). */
KTG_API void ktg_free(void *memory);

/* ---- output files ------------------------------------------------------------------------- */

/* A file that appears whole or not at all: it is written beside its place and put there by commit.
 * Until then it has no name, where the system knows such files (Linux), so that nothing is left
 * behind whatever ends the program. A symbolic link stays, and what it leads to is written; a file
 * that was there hands on its permissions, and its owner where that is allowed; another hard link
 * to it keeps the old content. What is not a regular file (a device, a FIFO) is written directly;
 * "-" is standard output. */
typedef struct ktg_output ktg_output;

/* Whether a file could be written there: KTG_FILE with the path and the reason when not. For
 * before long work; nothing is made. */
KTG_API KTG_NODISCARD ktg_status ktg_output_check(ktg_context *context, const char *path);
/* KTG_FILE with the path and the reason when it cannot be written. */
KTG_API KTG_NODISCARD ktg_status ktg_output_open(ktg_context *context, const char *path,
                                                 ktg_output **output);
/* Appends `size` bytes. KTG_FILE when the disk is full and the like. */
KTG_API KTG_NODISCARD ktg_status ktg_output_write(ktg_context *context, ktg_output *output,
                                                  const void *bytes, size_t size);
/* Appends text in printf form; numbers are written with a point whatever the locale. */
KTG_API KTG_NODISCARD ktg_status ktg_output_print(ktg_context *context, ktg_output *output,
                                                  const char *format, ...) KTG_PRINTF(3, 4);
/* Flushes and closes, so that a full disk is known now and commit only has to rename: where several
 * files are to appear together, all are finished before one is committed. Nothing can be appended
 * any more. KTG_FILE as above; the output is still to be discarded then. */
KTG_API KTG_NODISCARD ktg_status ktg_output_finish(ktg_context *context, ktg_output *output);
/* Finishes, where that is not done, and renames into place; frees and clears also on failure, after
 * which the old file, if there was one, is still there. */
KTG_API KTG_NODISCARD ktg_status ktg_output_commit(ktg_context *context, ktg_output **output);
/* Drops what was written; NULL and pointers to NULL are fine. */
KTG_API void ktg_output_discard(ktg_output **output);
/* The path it was opened with; owned by the output. */
KTG_API const char *ktg_output_path(const ktg_output *output);

#ifdef __cplusplus
}
#endif
#endif
