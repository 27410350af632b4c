/* cli/main.c - the program: finds the command. */
#include "cli/cli.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

static const char usage[] =
    "usage: katagami COMMAND ...\n\n"
    "  unfold MODEL          a paper net with glue tabs, on sheets to be printed\n"
    "  flatten MODEL         a cloth pattern with seams, allowances and notches\n"
    "  deform MODEL          the model with parts moved, resized, bent, as an edit file says\n"
    "  simplify MODEL        the model with fewer faces\n"
    "  warp SHAPE            a flat shape or a piece of a pattern, moved by a few points\n"
    "  info MODEL            what is in a model, and what is wrong with it\n"
    "  verify PATTERN.json   proves a pattern, or says why it is not sound\n\n"
    "katagami COMMAND --help tells more; katagami --version.\n";

static const struct {
    const char *name;
    exit_code (*run)(int argc, char **argv);
} commands[] = {{"unfold", command_unfold}, {"flatten", command_flatten},
                {"deform", command_deform}, {"simplify", command_simplify},
                {"warp", command_warp},     {"info", command_info},
                {"verify", command_verify}};

/* Words on standard output count only when they got there. */
static exit_code flushed(exit_code code) {
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    if (code != EXIT_DONE)
        return code; /* which was told already */
    fputs("katagami: standard output: cannot be written\n", stderr);
    return EXIT_FAILED;
}

/* Where one of the three standard streams is closed, the next file that is opened would take its
 * place, and words meant for people would end up in it. Something that refuses takes it instead. */
static void hold_standard_streams(void) {
    for (int stream = 0; stream <= 2; stream++)
        if (fcntl(stream, F_GETFD) < 0)
            (void)!open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int main(int argc, char **argv) {
    hold_standard_streams();
    if (argc < 2) {
        fputs(usage, stderr);
        return EXIT_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        fputs(usage, stdout);
        return flushed(EXIT_DONE);
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("katagami %s\n", ktg_version());
        return flushed(EXIT_DONE);
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (strcmp(argv[1], commands[i].name) == 0)
            return flushed(commands[i].run(argc - 1, argv + 1));
    fputs("katagami: there is no command '", stderr);
    cli_print_safe(stderr, argv[1]);
    fputs("'; see katagami --help\n", stderr);
    return EXIT_USAGE;
}
