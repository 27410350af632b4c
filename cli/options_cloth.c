/* cli/options_cloth.c - the options that only cloth has. */
#include "cli/option_lines.h"
#include "cli/words.h"

#include <string.h>

#define PI 3.14159265358979323846

static const struct {
    const char *word;
    unsigned flag;
} seam_words[] = {{"objects", KTG_SEAMS_OBJECTS},
                  {"groups", KTG_SEAMS_GROUPS},
                  {"materials", KTG_SEAMS_MATERIALS},
                  {"marked", KTG_SEAMS_MARKED},
                  {"uv", KTG_SEAMS_UV},
                  {"crease", KTG_SEAMS_CREASE},
                  {"components", KTG_SEAMS_GROUPS},
                  {"auto", KTG_SEAMS_AUTO}};

/* One word of the list, `length` bytes. */
static bool add_seams(settings *s, const char *word, size_t length) {
    for (size_t k = 0; k < sizeof seam_words / sizeof *seam_words; k++)
        if (strlen(seam_words[k].word) == length && memcmp(seam_words[k].word, word, length) == 0) {
            s->pipeline.flatten.seams |= seam_words[k].flag;
            s->pipeline.part_groups |= strcmp(seam_words[k].word, "components") == 0;
            return true;
        }
    return false;
}

bool cli_set_seams(settings *s, const char *text) {
    s->pipeline.flatten.seams = 0;
    for (const char *word = text;; word++) {
        size_t length = strcspn(word, ",");
        if (!add_seams(s, word, length))
            return false;
        word += length;
        if (!*word)
            return true;
    }
}

bool cli_set_crease(settings *s, const char *text) {
    double degrees;
    if (!cli_parse_amount(text, "deg", 0, 180, &degrees))
        return false;
    s->pipeline.flatten.crease = degrees * PI / 180;
    return true;
}

bool cli_set_max_strain(settings *s, const char *text) {
    double percent;
    if (!cli_parse_amount(text, "%", 0, 1000, &percent))
        return false;
    s->pipeline.flatten.strain_limit = percent / 100;
    return true;
}

bool cli_set_fabric(settings *s, const char *text) {
    s->fabric_text = text;
    return *text != 0;
}

ktg_status cli_take_fabric(ktg_context *context, settings *s) {
    if (!s->fabric_text)
        return KTG_OK;
    bool file = strchr(s->fabric_text, '.') || strchr(s->fabric_text, '/');
    s->pipeline.flatten.fabric = &s->fabric;
    return file ? ktg_fabric_read(context, s->fabric_text, &s->fabric)
                : ktg_fabric_named(context, s->fabric_text, &s->fabric);
}

/* "sleeve=45": the panel's name may have a '=' in it. */
bool cli_set_grain(settings *s, const char *text) {
    ktg_flatten_options *flatten = &s->pipeline.flatten;
    const char *equals = strrchr(text, '=');
    size_t k = flatten->grain_count, length = equals ? (size_t)(equals - text) : 0;
    double degrees;
    if (length == 0 || length >= sizeof s->grain_panels[0] || k == CLI_MOST_OUTPUTS ||
        !cli_parse_amount(equals + 1, "deg", -360, 360, &degrees))
        return false;
    memcpy(s->grain_panels[k], text, length);
    s->grain_panels[k][length] = 0;
    s->grains[k] = (ktg_panel_grain){s->grain_panels[k], degrees * PI / 180};
    flatten->grains = s->grains;
    flatten->grain_count = k + 1;
    return true;
}

bool cli_set_on_fold(settings *s, const char *text) {
    if (!*text || s->on_fold.count == CLI_MOST_OUTPUTS)
        return false;
    s->on_fold.words[s->on_fold.count++] = text;
    s->pipeline.finish.on_fold = s->on_fold.words;
    s->pipeline.finish.on_fold_count = s->on_fold.count;
    return true;
}

bool cli_set_no_twins(settings *s, const char *text) {
    (void)text;
    s->pipeline.finish.twins = false;
    return true;
}

bool cli_set_no_strain_map(settings *s, const char *text) {
    (void)text;
    s->pipeline.render.strain_map = false;
    return true;
}

static bool set_length(const char *text, double *mm) {
    return cli_parse_length(text, mm) && *mm <= 1000;
}

bool cli_set_allowance(settings *s, const char *text) {
    s->allowance_given = true;
    return set_length(text, &s->pipeline.finish.allowance_mm);
}

bool cli_set_hem(settings *s, const char *text) {
    s->hem_given = true;
    return set_length(text, &s->pipeline.finish.hem_mm);
}

bool cli_set_notch(settings *s, const char *text) {
    s->notch_given = true;
    if (strcmp(text, "none") != 0)
        return set_length(text, &s->pipeline.finish.notch_mm);
    s->pipeline.finish.notch_mm = 0;
    return true;
}

bool cli_set_notch_every(settings *s, const char *text) {
    return cli_parse_length(text, &s->pipeline.finish.notch_every_mm) &&
           s->pipeline.finish.notch_every_mm > 0;
}
