/* cli/options_search.c - options of how nets and panels are found. */
#include "cli/option_lines.h"
#include "cli/words.h"

#include <string.h>

bool cli_set_method_unfold(settings *s, const char *text) {
    static const char *const methods[] = {"auto", "genetic", NULL};
    int method = cli_word_index(text, methods);
    s->pipeline.unfold.method = method == 1 ? KTG_METHOD_GENETIC : KTG_METHOD_AUTO;
    return method >= 0;
}

bool cli_set_method_flatten(settings *s, const char *text) {
    static const char *const methods[] = {"arap", "injective", "two-step", NULL};
    int method = cli_word_index(text, methods);
    s->pipeline.flatten.method = method >= 0 ? (ktg_flatten_method)method : KTG_FLATTEN_ARAP;
    return method >= 0;
}

bool cli_set_weight(settings *s, const char *text) {
    static const char *const weights[] = {"cotangent", "unit", NULL};
    int weight = cli_word_index(text, weights);
    s->pipeline.flatten.weight = weight == 1 ? KTG_WEIGHT_UNIT : KTG_WEIGHT_COTANGENT;
    return weight >= 0;
}

bool cli_set_warp_weight(settings *s, const char *text) {
    static const char *const weights[] = {"cotangent", "unit", NULL};
    int weight = cli_word_index(text, weights);
    s->warp.weight = weight == 1 ? KTG_WEIGHT_UNIT : KTG_WEIGHT_COTANGENT;
    return weight >= 0;
}

bool cli_set_refine(settings *s, const char *text) {
    s->warp.refine = KTG_NONE;
    return strcmp(text, "auto") == 0 ||
           (cli_parse_count32(text, 0, &s->warp.refine) && s->warp.refine <= 100000);
}

bool cli_set_effort(settings *s, const char *text) {
    static const char *const efforts[] = {"quick", "normal", "best", NULL};
    int effort = cli_word_index(text, efforts);
    s->pipeline.unfold.effort = effort >= 0 ? (ktg_effort)effort : KTG_EFFORT_NORMAL;
    s->pipeline.layout.effort = s->pipeline.flatten.effort = s->pipeline.unfold.effort;
    return effort >= 0;
}

bool cli_set_ease(settings *s, const char *text) {
    return cli_parse_number(text, 0, 10, &s->pipeline.unfold.ease);
}

bool cli_set_population(settings *s, const char *text) {
    return cli_parse_count32(text, 4, &s->pipeline.unfold.population) &&
           s->pipeline.unfold.population <= 10000;
}

bool cli_set_generations(settings *s, const char *text) {
    return cli_parse_count32(text, 0, &s->pipeline.unfold.generations);
}

bool cli_set_patience(settings *s, const char *text) {
    return cli_parse_count32(text, 1, &s->pipeline.unfold.patience);
}

bool cli_set_restarts(settings *s, const char *text) {
    return cli_parse_count32(text, 0, &s->pipeline.unfold.restarts);
}

bool cli_set_crossover(settings *s, const char *text) {
    return cli_parse_number(text, 0, 1, &s->pipeline.unfold.crossover_rate);
}

bool cli_set_mutation(settings *s, const char *text) {
    return cli_parse_number(text, 0, 1, &s->pipeline.unfold.mutation_rate);
}

bool cli_set_seed(settings *s, const char *text) {
    return cli_parse_count(text, 0, UINT64_MAX, &s->seed);
}

bool cli_set_threads(settings *s, const char *text) {
    uint64_t threads;
    if (!cli_parse_count(text, 1, 256, &threads))
        return false;
    s->threads = (uint32_t)threads;
    return true;
}

bool cli_set_time(settings *s, const char *text) {
    return cli_parse_number(text, 1e-3, 1e9, &s->pipeline.unfold.seconds);
}
