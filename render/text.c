/* render/text.c - text that is always valid, in one typeface, measured in millimetres. */
#include "render/text.h"
#include "render/draw.h"

#include <string.h>

static const char replacement[] = "\xef\xbf\xbd", ellipsis[] = "\xe2\x80\xa6";

/* Reads one character: its length in bytes, or 0 when the bytes are no valid UTF-8. Refuses what
 * cairo refuses too: overlong forms, surrogates, noncharacters. */
static size_t decode(const unsigned char *s, size_t left, uint32_t *code) {
    static const uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    size_t length = s[0] < 0x80             ? 1
                    : (s[0] & 0xe0) == 0xc0 ? 2
                    : (s[0] & 0xf0) == 0xe0 ? 3
                    : (s[0] & 0xf8) == 0xf0 ? 4
                                            : 0;
    if (length == 0 || length > left)
        return 0;
    *code = length == 1 ? s[0] : s[0] & (0xffu >> (length + 1));
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80)
            return 0;
        *code = *code << 6 | (s[i] & 0x3f);
    }
    bool surrogate = *code >= 0xd800 && *code < 0xe000;
    bool noncharacter = (*code >= 0xfdd0 && *code <= 0xfdef) || (*code & 0xfffe) == 0xfffe;
    bool valid = *code >= smallest[length] && *code < 0x110000 && !surrogate && !noncharacter;
    return valid ? length : 0;
}

static bool is_control(uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029;
}

/* Marks that turn the direction of what follows them: they would reach beyond the text. */
static bool is_direction(uint32_t code) {
    return code == 0x61c || code == 0x200e || code == 0x200f ||
           (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) ||
           code == 0xfeff;
}

void ktg_text_clean(const char *text, size_t length, char *clean, size_t size) {
    size_t used = 0;
    length = strnlen(text, length);
    for (size_t at = 0; at < length;) {
        uint32_t code = 0;
        size_t bytes = decode((const unsigned char *)text + at, length - at, &code);
        const char *from = bytes ? text + at : replacement;
        size_t count = bytes ? bytes : strlen(replacement);
        if (bytes && is_direction(code))
            count = 0;
        if (bytes && is_control(code)) {
            from = " ";
            count = 1;
        }
        if (used + count + 1 > size)
            break;
        memcpy(clean + used, from, count);
        used += count;
        at += bytes ? bytes : 1;
    }
    clean[used] = 0;
}

void ktg_text_set(cairo_t *cairo, ktg_face face, double digit_mm) {
    cairo_select_font_face(cairo, KTG_FONT_FAMILY, CAIRO_FONT_SLANT_NORMAL,
                           face == KTG_FACE_BOLD ? CAIRO_FONT_WEIGHT_BOLD
                                                 : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, digit_mm / KTG_DIGIT_PER_SIZE);
}

double ktg_text_width(cairo_t *cairo, const char *text) {
    cairo_text_extents_t extents;
    cairo_font_face_t *usual = ktg_font_begin(cairo, text);
    cairo_text_extents(cairo, text, &extents);
    ktg_font_end(cairo, usual);
    return extents.x_advance;
}

void ktg_text_draw(cairo_t *cairo, double x, double baseline, const char *text) {
    char ordered[KTG_TITLE_SIZE];
    cairo_font_face_t *usual = ktg_font_begin(cairo, text);
    cairo_move_to(cairo, x, baseline);
    cairo_show_text(cairo, ktg_text_order(text, ordered));
    cairo_new_path(cairo);
    ktg_font_end(cairo, usual);
}

void ktg_text_halo(cairo_t *cairo, double x, double baseline, const char *text, double width) {
    char ordered[KTG_TITLE_SIZE];
    cairo_font_face_t *usual = ktg_font_begin(cairo, text);
    cairo_move_to(cairo, x, baseline);
    cairo_text_path(cairo, ktg_text_order(text, ordered));
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
    ktg_font_end(cairo, usual);
}

void ktg_text_ground(cairo_t *cairo, double x, double baseline, const char *text, double width) {
    cairo_set_source_rgb(cairo, 1, 1, 1);
    ktg_text_halo(cairo, x, baseline, text, width);
}

void ktg_text_shorten(cairo_t *cairo, double width, char *text, size_t size) {
    size_t length = strlen(text);
    if (ktg_text_width(cairo, text) <= width)
        return;
    while (length > 0) {
        do
            length--;
        while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80);
        while (length > 0 && text[length - 1] == ' ')
            length--;
        if (length + sizeof ellipsis > size)
            continue;
        memcpy(text + length, ellipsis, sizeof ellipsis);
        if (length > 0 && ktg_text_width(cairo, text) <= width)
            return;
    }
    text[0] = 0;
}
