/* cli/cli.h - what the commands share: options, words for the terminal, exit codes (cli only). */
#ifndef KTG_CLI_CLI_H
#define KTG_CLI_CLI_H

#include "core/core.h"
#include "pipeline/pipeline.h"

#include <stdio.h>

typedef enum exit_code {
    EXIT_DONE = 0,
    EXIT_FAILED = 1,
    EXIT_USAGE = 2,
    EXIT_UNSOUND = 3,
    EXIT_INTERRUPTED = 130
} exit_code;

/* ---- options (cli/options.c) -------------------------------------------------------------- */

#define CLI_MOST_OUTPUTS 64

/* What an option collects that may be given several times. */
typedef struct word_list {
    const char *words[CLI_MOST_OUTPUTS];
    size_t count;
} word_list;

/* Everything the command line of any command can say. */
typedef struct settings {
    ktg_pipeline_options pipeline;
    const char *outputs[CLI_MOST_OUTPUTS];
    size_t output_count;
    word_list keep, cut, omit, on_fold;
    ktg_panel_grain grains[CLI_MOST_OUTPUTS];
    char grain_panels[CLI_MOST_OUTPUTS][64]; /* what their names are */
    const char *fabric_text;                 /* woven, knit, or a file */
    ktg_fabric fabric;
    const char *sets, *preview; /* what deform writes beside the model, or NULL */
    const char *arguments[2];   /* what is not an option */
    int argument_count;
    bool faces_given, oversize_given;
    const char *handles; /* of warp: a file */
    ktg_warp_options warp;
    bool sheet_given, allowance_given, hem_given, notch_given;
    const char *size_given; /* the option that said how large it becomes */
    char complaint[256];    /* why a value was refused, where its option knows more than its form */
    uint64_t seed;
    uint32_t threads; /* 0: as many as the machine has */
    bool quiet, help;
} settings;

/* Which commands know an option. */
enum {
    CMD_UNFOLD = 1,
    CMD_FLATTEN = 2,
    CMD_SIMPLIFY = 4,
    CMD_INFO = 8,
    CMD_VERIFY = 16,
    CMD_DEFORM = 32,
    CMD_WARP = 64
};

/* Reads the command line of one command (argv[0] is its name). False, with a sentence on standard
 * error, when it is not right: the exit code is EXIT_USAGE then. */
bool cli_read_options(int argc, char **argv, int command, int least_arguments, int most_arguments,
                      settings *s);

/* The options of a command, as its --help shows them. */
void cli_print_options(FILE *stream, int command);

/* Finds or reads the fabric that was named, if one was. */
KTG_NODISCARD ktg_status cli_take_fabric(ktg_context *context, settings *s);

/* ---- terminal (cli/terminal.c) ------------------------------------------------------------ */

/* A context whose notes, progress (on a terminal, unless quiet) and interrupts are ours. NULL, with
 * a sentence on standard error, when memory is short. */
ktg_context *cli_context(const settings *s);

/* Ends a progress line, if one is shown. */
void cli_end_progress(void);

/* Tells the context's failure on standard error; the exit code that goes with it. */
exit_code cli_fail(ktg_context *context, ktg_status status);

/* Prints text that came from a file or the command line: control characters, marks that turn the
 * direction of text, and what is not UTF-8 become '?'. */
void cli_print_safe(FILE *stream, const char *text);

/* The same for a text of several lines; each is indented. */
void cli_print_lines(FILE *stream, const char *text);

/* ---- commands (cli/command_*.c) ----------------------------------------------------------- */

/* What every command does around its work: reads the options, shows the help (`usage`, then the
 * options), makes a context, calls `run`, tells a failure. */
exit_code cli_run(int argc, char **argv, int command, int most_arguments, const char *usage,
                  ktg_status (*run)(ktg_context *context, settings *s));

exit_code command_unfold(int argc, char **argv);
exit_code command_flatten(int argc, char **argv);
exit_code command_deform(int argc, char **argv);
exit_code command_simplify(int argc, char **argv);
exit_code command_info(int argc, char **argv);
exit_code command_verify(int argc, char **argv);
exit_code command_warp(int argc, char **argv);

#endif
