/* cli/read_options.c - reading the command line by the table of options, and showing it. */
#include "cli/option_lines.h"

#include <getopt.h>
#include <string.h>

void cli_print_options(FILE *stream, int command) {
    for (int i = 0; i < cli_option_count; i++) {
        if (!(cli_option_lines[i].commands & command))
            continue;
        char left[64];
        const char *value = cli_option_lines[i].value ? cli_option_lines[i].value : "";
        char letter[8] = "    ";
        if (cli_option_lines[i].letter)
            snprintf(letter, sizeof letter, "-%c, ", cli_option_lines[i].letter);
        snprintf(left, sizeof left, "%s--%s %s", letter, cli_option_lines[i].name, value);
        if (strlen(left) > 30)
            fprintf(stream, "  %s\n  %-30s  %s\n", left, "", cli_option_lines[i].help);
        else
            fprintf(stream, "  %-30s  %s\n", left, cli_option_lines[i].help);
    }
}

/* getopt's tables for one command; code 256 + i stands for line i. */
static void make_tables(int command, struct option *longs, char *shorts) {
    size_t length = 0;
    shorts[length++] = ':';
    for (int i = 0; i < cli_option_count; i++) {
        if (!(cli_option_lines[i].commands & command))
            continue;
        *longs++ = (struct option){cli_option_lines[i].name,
                                   cli_option_lines[i].value ? required_argument : no_argument,
                                   NULL, 256 + i};
        if (cli_option_lines[i].letter) {
            shorts[length++] = cli_option_lines[i].letter;
            if (cli_option_lines[i].value)
                shorts[length++] = ':';
        }
    }
    *longs = (struct option){0};
    shorts[length] = 0;
}

static const option_line *line_of(int code, int command) {
    if (code >= 256)
        return &cli_option_lines[code - 256];
    for (int i = 0; i < cli_option_count; i++)
        if (cli_option_lines[i].letter == code && (cli_option_lines[i].commands & command))
            return &cli_option_lines[i];
    return NULL;
}

static bool refuse(const char *command, const char *what, const char *text) {
    fprintf(stderr, "katagami %s: %s", command, what);
    cli_print_safe(stderr, text);
    fprintf(stderr, "; see katagami %s --help\n", command);
    return false;
}

/* After getopt's '?': a short option it does not know is in optopt, and may stand among others in
 * one word; a long one was the word before optind. */
static bool refuse_option(char **argv) {
    char letter[3] = {'-', (char)optopt, 0};
    if (optopt >= 256)
        return refuse(argv[0], "no value is wanted in ", argv[optind - 1]);
    return refuse(argv[0], "there is no option ", optopt ? letter : argv[optind - 1]);
}

static bool apply_line(const option_line *line, settings *s, const char *command) {
    if (line->apply(s, optarg))
        return true;
    fprintf(stderr, "katagami %s: ", command);
    if (s->complaint[0]) {
        cli_print_safe(stderr, s->complaint);
    } else {
        fprintf(stderr, "--%s wants %s, not '", line->name, line->value);
        cli_print_safe(stderr, optarg);
        fputc('\'', stderr);
    }
    fputc('\n', stderr);
    return false;
}

/* Twice: what is late, and what is not. */
static bool run_options(int argc, char **argv, int command, bool late, settings *s) {
    struct option longs[CLI_MOST_OPTIONS + 1];
    char shorts[2 * CLI_MOST_OPTIONS + 2];
    make_tables(command, longs, shorts);
    optind = 0;
    int code;
    while ((code = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
        if (code == '?')
            return refuse_option(argv);
        if (code == ':')
            return refuse(argv[0], "a value is missing after ", argv[optind - 1]);
        const option_line *line = line_of(code, command);
        if (line->late == late && !apply_line(line, s, argv[0]))
            return false;
    }
    return true;
}

bool cli_read_options(int argc, char **argv, int command, int least_arguments, int most_arguments,
                      settings *s) {
    *s = (settings){.seed = 1};
    ktg_pipeline_defaults(&s->pipeline);
    ktg_warp_defaults(&s->warp);
    if (!run_options(argc, argv, command, false, s) || !run_options(argc, argv, command, true, s))
        return false;
    if (s->help)
        return true;
    s->argument_count = argc - optind;
    if (s->argument_count < least_arguments)
        return refuse(argv[0], "a file is missing", "");
    if (s->argument_count > most_arguments)
        return refuse(argv[0], "one file too many: ", argv[optind + most_arguments]);
    for (int i = 0; i < s->argument_count; i++)
        s->arguments[i] = argv[optind + i];
    return true;
}
