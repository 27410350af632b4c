/* cli/options_model.c - options that say what is read, how large it becomes and what is written. */
#include "cli/option_lines.h"
#include "cli/words.h"

#include <string.h>

#define LEAST_SIZE_MM 1e-6 /* of a finished model */

bool cli_set_output(settings *s, const char *text) {
    if (s->output_count == CLI_MOST_OUTPUTS) {
        snprintf(s->complaint, sizeof s->complaint, "not more than %d files can be written",
                 CLI_MOST_OUTPUTS);
        return false;
    }
    s->outputs[s->output_count++] = text;
    return true;
}

/* Several files or names for one option. */
static bool add_word(settings *s, word_list *list, const char *text) {
    if (list->count == CLI_MOST_OUTPUTS) {
        snprintf(s->complaint, sizeof s->complaint, "not more than %d can be given",
                 CLI_MOST_OUTPUTS);
        return false;
    }
    list->words[list->count++] = text;
    return true;
}

bool cli_set_keep(settings *s, const char *text) {
    return add_word(s, &s->keep, text);
}

bool cli_set_cut(settings *s, const char *text) {
    return add_word(s, &s->cut, text);
}

bool cli_set_omit(settings *s, const char *text) {
    return *text && add_word(s, &s->omit, text);
}

bool cli_set_edit(settings *s, const char *text) {
    s->pipeline.edit = text;
    return *text != 0;
}

bool cli_set_sets(settings *s, const char *text) {
    s->sets = text;
    return *text != 0;
}

bool cli_set_preview(settings *s, const char *text) {
    s->preview = text;
    return *text != 0;
}

bool cli_set_handles(settings *s, const char *text) {
    s->handles = text;
    return *text != 0;
}

bool cli_set_faces(settings *s, const char *text) {
    s->faces_given = true;
    s->pipeline.faces = KTG_ALL_FACES;
    return strcmp(text, "all") == 0 || cli_parse_count32(text, 4, &s->pipeline.faces);
}

/* One size decides about all others. */
static bool note_size(settings *s, ktg_size_rule rule, const char *option) {
    if (s->size_given && strcmp(s->size_given, option) != 0) {
        snprintf(s->complaint, sizeof s->complaint, "give one size only, not both %s and %s",
                 s->size_given, option);
        return false;
    }
    s->size_given = option;
    s->pipeline.size_rule = rule;
    return true;
}

static bool set_size(settings *s, ktg_size_rule rule, const char *option, const char *text) {
    return note_size(s, rule, option) && cli_parse_length(text, &s->pipeline.size_mm) &&
           s->pipeline.size_mm >= LEAST_SIZE_MM;
}

bool cli_set_height(settings *s, const char *text) {
    return set_size(s, KTG_SIZE_HEIGHT, "--height", text);
}

bool cli_set_width(settings *s, const char *text) {
    return set_size(s, KTG_SIZE_WIDTH, "--width", text);
}

bool cli_set_length(settings *s, const char *text) {
    return set_size(s, KTG_SIZE_LENGTH, "--length", text);
}

bool cli_set_scale(settings *s, const char *text) {
    return note_size(s, KTG_SIZE_FACTOR, "--scale") &&
           cli_parse_number(text, 1e-12, 1e12, &s->pipeline.size_mm);
}

bool cli_set_sheets(settings *s, const char *text) {
    return note_size(s, KTG_SIZE_FIT, "--sheets") &&
           cli_parse_count32(text, 1, &s->pipeline.sheets) && s->pipeline.sheets <= 1000;
}

bool cli_set_unit(settings *s, const char *text) {
    static const char *const units[] = {"mm", "cm", "m", "in", NULL};
    static const double mm[] = {1, 10, 1000, 25.4};
    int unit = cli_word_index(text, units);
    s->pipeline.size_mm = unit >= 0 ? mm[unit] : 0;
    return note_size(s, KTG_SIZE_FACTOR, "--unit") && unit >= 0;
}

bool cli_set_up(settings *s, const char *text) {
    static const char *const axes[] = {"x", "y", "z", NULL};
    int axis = cli_word_index(text, axes);
    s->pipeline.up = axis >= 0 ? (ktg_axis)(KTG_AXIS_X + axis) : KTG_AXIS_AUTO;
    return axis >= 0;
}

bool cli_set_report(settings *s, const char *text) {
    s->pipeline.report = text;
    return true;
}

bool cli_set_quiet(settings *s, const char *text) {
    (void)text;
    return s->quiet = true;
}

bool cli_set_help(settings *s, const char *text) {
    (void)text;
    return s->help = true;
}
