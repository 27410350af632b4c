/* cli/option_lines.h - the table of options, which read_options.c reads the command line by (cli
 * only). */
#ifndef KTG_CLI_OPTION_LINES_H
#define KTG_CLI_OPTION_LINES_H

#include "cli/cli.h"

typedef struct option_line {
    const char *name;
    char letter;
    const char *value; /* what its value is called; NULL: it has none */
    int commands;
    bool late; /* applied after all that is not */
    bool (*apply)(settings *s, const char *text);
    const char *help;
} option_line;

extern const option_line cli_option_lines[];
extern const int cli_option_count;

/* More lines than there are. */
#define CLI_MOST_OPTIONS 128

#endif
