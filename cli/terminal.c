/* cli/terminal.c - words on standard error, a progress line on a terminal, interrupts. */
#include "cli/cli.h"

#include "core/clock.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

/* A process has one terminal and one set of signal handlers: this is the program's only changing
 * state. */
static volatile sig_atomic_t interrupts;
static struct {
    bool line_shown;
    double first_seconds, last_seconds; /* when it was shown; 0: not yet */
} progress;

/* The first Ctrl-C ends searches, the second one the job, a third one the process: it may be
 * waiting for a file that never comes. */
static void on_interrupt(int signal_number) {
    interrupts = signal_number == SIGINT || interrupts > 1 ? interrupts + 1 : 2;
    if (interrupts > 2)
        _exit(EXIT_INTERRUPTED);
}

static ktg_wish wish(void *user) {
    (void)user;
    return interrupts == 0 ? KTG_GO_ON : interrupts == 1 ? KTG_FINISH : KTG_STOP;
}

/* How many bytes the character at `text` has: UTF-8 without overlong forms (RFC 3629, section 4);
 * 0 when it is none, or a control character that a terminal might obey. */
static int printable_bytes(const unsigned char *text) {
    unsigned char c = text[0];
    if (c < 0x80)
        return c >= 32 && c != 127;
    if (c < 0xc2 || c > 0xf4)
        return 0;
    unsigned char low = c == 0xe0 ? 0xa0 : c == 0xf0 ? 0x90 : 0x80;
    unsigned char high = c == 0xed ? 0x9f : c == 0xf4 ? 0x8f : 0xbf;
    int count = c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;
    if (c == 0xc2)
        low = 0xa0; /* U+0080 to U+009F are control characters */
    if (text[1] < low || text[1] > high)
        return 0;
    for (int i = 2; i < count; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    return count;
}

/* A line's end in Unicode (U+2028, U+2029), or what turns the direction of all that follows (U+202A
 * to U+202E, U+2066 to U+2069): a name could make a sentence say something else. */
static bool is_mark(const unsigned char *text) {
    if (text[0] != 0xe2)
        return false;
    return (text[1] == 0x80 && text[2] >= 0xa8 && text[2] <= 0xae) ||
           (text[1] == 0x81 && text[2] >= 0xa6 && text[2] <= 0xa9);
}

static void print_line(FILE *stream, const char *text, size_t length) {
    for (const char *end = text + length; text < end;) {
        int count = printable_bytes((const unsigned char *)text);
        if (count == 0 || is_mark((const unsigned char *)text))
            putc('?', stream);
        else
            fwrite(text, 1, (size_t)count, stream);
        text += count == 0 ? 1 : count;
    }
}

void cli_print_safe(FILE *stream, const char *text) {
    print_line(stream, text, strlen(text));
}

void cli_print_lines(FILE *stream, const char *text) {
    while (*text) {
        size_t length = strcspn(text, "\n");
        fputs("  ", stream);
        print_line(stream, text, length);
        fputc('\n', stream);
        text += length + (text[length] == '\n');
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
    if (progress.first_seconds <= 0)
        progress.first_seconds = now;
    cli_end_progress();
    fprintf(stderr, "%.0f s  %s %3.0f %%", now - progress.first_seconds, stage, 100 * fraction);
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

/* What the caller wants ignored (nohup, a shell's background) stays ignored. */
static void catch_signals(void) {
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        /* but for the first Ctrl-C, waiting for a file ends, too */
        struct sigaction before, action = {.sa_handler = on_interrupt,
                                           .sa_flags = signals[i] == SIGINT ? SA_RESTART : 0};
        if (sigaction(signals[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(signals[i], &action, NULL);
    }
    signal(SIGPIPE, SIG_IGN); /* a closed pipe is a failed write, told like any other, */
    signal(SIGXFSZ, SIG_IGN); /* and so is a file that may not grow further */
}

static uint32_t processors(void) {
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 && count <= 256 ? (uint32_t)count : 1;
}

ktg_context *cli_context(const settings *s) {
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK) {
        fputs("katagami: out of memory\n", stderr);
        return NULL;
    }
    ktg_context_set_seed(context, s->seed);
    ktg_context_set_threads(context, s->threads > 0 ? s->threads : processors());
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
