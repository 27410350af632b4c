/* cli/command_verify.c - katagami verify: proves a pattern, or says why it is not sound. */
#include "cli/cli.h"
#include "verify/verify.h"

static const char usage[] =
    "usage: katagami verify PATTERN.json [MODEL]\n\n"
    "Checks that a pattern is what it says: every face once and the right way round, mates, "
    "lengths,\n"
    "folds that lead back to the surface, no overlaps, tabs with room, everything on the sheets.\n"
    "With the model it also compares the two. Exit status 3 when the pattern is not sound.\n\n";

static void print_report(const ktg_verify_report *r) {
    printf("sound: %u piece%s of %u component%s on %u sheet%s\n", r->pieces,
           r->pieces == 1 ? "" : "s", r->components, r->components == 1 ? "" : "s", r->sheets,
           r->sheets == 1 ? "" : "s");
    printf("largest error of a length %.2g, of the refolded surface %.2g\n", r->length_error,
           r->refold_error);
    if (r->model_compared && r->hausdorff_mm > 0)
        printf("at most %.3g mm away from the model, in print\n", r->hausdorff_mm);
    else if (r->model_compared)
        printf("equals the model up to %.2g of its size\n", r->model_error);
}

static ktg_status run(ktg_context *context, const settings *s) {
    ktg_pattern *pattern = NULL;
    ktg_mesh *model = NULL;
    ktg_repair_report repair;
    ktg_verify_report report = {0};
    ktg_status status = ktg_pattern_read_json(context, s->arguments[0], &pattern);
    if (status == KTG_OK && s->argument_count > 1)
        status = ktg_mesh_read(context, s->arguments[1], KTG_MESH_BY_ENDING, &model);
    if (status == KTG_OK && model)
        status = ktg_about_file(context, s->arguments[1],
                                ktg_mesh_omit(context, model, (const char *const *)pattern->omitted,
                                              pattern->omitted_count));
    if (status == KTG_OK && model)
        status = ktg_about_file(context, s->arguments[1], ktg_mesh_repair(context, model, &repair));
    if (status == KTG_OK)
        status = ktg_verify(context, pattern, model, &report);
    cli_end_progress();
    if (status == KTG_OK && !s->quiet)
        print_report(&report);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&model);
    return status;
}

static exit_code tell_unsound(ktg_context *context, const char *path) {
    fputs("katagami: ", stderr);
    cli_print_safe(stderr, path);
    fputs(": this pattern is not sound\n", stderr);
    cli_print_lines(stderr, ktg_context_message(context));
    return EXIT_UNSOUND;
}

exit_code command_verify(int argc, char **argv) {
    settings s;
    if (!cli_read_options(argc, argv, CMD_VERIFY, 1, 2, &s))
        return EXIT_USAGE;
    if (s.help) {
        fputs(usage, stdout);
        cli_print_options(stdout, CMD_VERIFY);
        return EXIT_DONE;
    }
    ktg_context *context = cli_context(&s);
    if (!context)
        return EXIT_FAILED;
    ktg_status status = run(context, &s);
    exit_code code = EXIT_DONE;
    if (status == KTG_UNSOUND)
        code = tell_unsound(context, s.arguments[0]);
    else if (status != KTG_OK)
        code = cli_fail(context, status);
    ktg_context_free(&context);
    return code;
}
