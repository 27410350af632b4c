/* cli/command.c - what every command does around its work. */
#include "cli/cli.h"

exit_code cli_run(int argc, char **argv, int command, int most_arguments, const char *usage,
                  ktg_status (*run)(ktg_context *context, settings *s)) {
    settings s;
    if (!cli_read_options(argc, argv, command, 1, most_arguments, &s))
        return EXIT_USAGE;
    if (s.help) {
        fputs(usage, stdout);
        cli_print_options(stdout, command);
        return EXIT_DONE;
    }
    ktg_context *context = cli_context(&s);
    if (!context)
        return EXIT_FAILED;
    ktg_status status = run(context, &s);
    exit_code code = status == KTG_OK ? EXIT_DONE : cli_fail(context, status);
    ktg_context_free(&context);
    return code;
}
