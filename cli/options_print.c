/* cli/options_print.c - options of what is drawn on the pieces. */
#include "cli/option_lines.h"
#include "cli/words.h"

#include <string.h>

#define PI 3.14159265358979323846

bool cli_set_tabs(settings *s, const char *text) {
    s->pipeline.finish.tab_height_mm = 0;
    return strcmp(text, "none") == 0 ||
           (cli_parse_length(text, &s->pipeline.finish.tab_height_mm) &&
            s->pipeline.finish.tab_height_mm <= 100);
}

bool cli_set_tab_side(settings *s, const char *text) {
    static const char *const sides[] = {"alternate", "smaller", "run", NULL};
    int side = cli_word_index(text, sides);
    s->pipeline.finish.tab_side = side >= 0 ? (ktg_tab_side)side : KTG_TAB_ALTERNATE;
    return side >= 0;
}

bool cli_set_number(settings *s, const char *text) {
    static const char *const styles[] = {"seam", "edge", "none", NULL};
    int style = cli_word_index(text, styles);
    s->pipeline.finish.numbers = style >= 0 ? (ktg_number_style)style : KTG_NUMBER_SEAM;
    return style >= 0;
}

bool cli_set_folds(settings *s, const char *text) {
    static const char *const styles[] = {"dashed", "solid", NULL};
    int style = cli_word_index(text, styles);
    s->pipeline.render.folds = style >= 0 ? (ktg_fold_style)style : KTG_FOLDS_DASHED;
    return style >= 0;
}

bool cli_set_flat(settings *s, const char *text) {
    double degrees;
    if (!cli_parse_number(text, 0, 180, &degrees))
        return false;
    s->pipeline.render.flat_below = degrees * PI / 180;
    return true;
}

bool cli_set_dpi(settings *s, const char *text) {
    return cli_parse_number(text, 10, 2400, &s->pipeline.render.dots_per_inch);
}

bool cli_set_no_guide(settings *s, const char *text) {
    (void)text;
    s->pipeline.render.guide = false;
    return true;
}

bool cli_set_black(settings *s, const char *text) {
    (void)text;
    s->pipeline.render.colour = false;
    return true;
}

bool cli_set_svg_unit(settings *s, const char *text) {
    static const char *const units[] = {"mm", "px72", "px96", NULL};
    int unit = cli_word_index(text, units);
    s->pipeline.render.svg_unit = unit >= 0 ? (ktg_svg_unit)unit : KTG_SVG_MM;
    return unit >= 0;
}

bool cli_set_real_dashes(settings *s, const char *text) {
    (void)text;
    return s->pipeline.render.real_dashes = true;
}

bool cli_set_plain_dxf(settings *s, const char *text) {
    (void)text;
    return s->pipeline.render.plain_dxf = true;
}

bool cli_set_texture(settings *s, const char *text) {
    (void)text;
    s->pipeline.colours = KTG_COLOURS_ON;
    return true;
}

bool cli_set_no_texture(settings *s, const char *text) {
    (void)text;
    s->pipeline.colours = KTG_COLOURS_OFF;
    return true;
}

bool cli_set_textures_anywhere(settings *s, const char *text) {
    (void)text;
    return s->pipeline.textures_anywhere = true;
}

bool cli_set_registration(settings *s, const char *text) {
    (void)text;
    return s->pipeline.render.registration = true;
}
