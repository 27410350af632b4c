/* cli/terminal.c - words on standard error, a progress line on a terminal, interrupts. */
#include "cli/cli.h"

#include "core/clock.h"

#include <signal.h>
#include <unistd.h>

/* A process has one terminal and one set of signal handlers: this is the program's only changing
 * state. */
static volatile sig_atomic_t interrupts;
static struct {
    bool line_shown;
    double last_seconds;
} progress;

static void on_interrupt(int signal_number) {
    interrupts = signal_number == SIGINT ? interrupts + 1 : 2;
}

static ktg_wish wish(void *user) {
    (void)user;
    return interrupts == 0 ? KTG_GO_ON : interrupts == 1 ? KTG_FINISH : KTG_STOP;
}

void cli_print_safe(FILE *stream, const char *text) {
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        putc(c < 32 || c == 127 ? '?' : c, stream);
    }
}

void cli_end_progress(void) {
    if (progress.line_shown)
        fputs("\r\033[K", stderr);
    progress.line_shown = false;
}

static void show_progress(void *user, const char *stage, double fraction, const char *detail) {
    (void)user;
    double now = ktg_clock_seconds();
    if (now - progress.last_seconds < 0.1)
        return;
    progress.last_seconds = now;
    cli_end_progress();
    fprintf(stderr, "%s %3.0f %%", stage, 100 * fraction);
    if (detail) {
        fputs("  ", stderr);
        cli_print_safe(stderr, detail);
    }
    fflush(stderr);
    progress.line_shown = true;
}

static void show_note(void *user, ktg_log_level level, const char *text) {
    (void)user;
    cli_end_progress();
    fputs(level == KTG_LOG_WARNING ? "warning: " : "", stderr);
    cli_print_safe(stderr, text);
    fputc('\n', stderr);
}

static void catch_signals(void) {
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = SA_RESTART};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    signal(SIGPIPE, SIG_IGN); /* a closed pipe is a failed write, told like any other */
}

ktg_context *cli_context(const settings *s) {
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK) {
        fputs("katagami: out of memory\n", stderr);
        return NULL;
    }
    ktg_context_set_seed(context, s->seed);
    ktg_context_set_cancel(context, wish, NULL);
    if (!s->quiet)
        ktg_context_set_log(context, show_note, NULL);
    if (!s->quiet && isatty(STDERR_FILENO))
        ktg_context_set_progress(context, show_progress, NULL);
    catch_signals();
    return context;
}

exit_code cli_fail(ktg_context *context, ktg_status status) {
    cli_end_progress();
    fputs("katagami: ", stderr);
    cli_print_safe(stderr, ktg_context_message(context));
    fputc('\n', stderr);
    switch (status) {
    case KTG_CANCELLED:
        return EXIT_INTERRUPTED;
    case KTG_ARGUMENT:
        return EXIT_USAGE;
    case KTG_UNSOUND:
        return EXIT_UNSOUND;
    default:
        return EXIT_FAILED;
    }
}
