/* render/dxf.c - the words of a DXF file, Release 12: what the most programs read. */
#include "render/dxf.h"

#include "core/memory.h"

#include <stdio.h>
#include <string.h>

#define MOST_TEXT 256 /* characters in a value, Release 12 */

ktg_status ktg_dxf_word(const ktg_dxf *dxf, int code, const char *word) {
    return ktg_output_print(dxf->context, dxf->output, "%3d\r\n%s\r\n", code, word);
}

ktg_status ktg_dxf_integer(const ktg_dxf *dxf, int code, int value) {
    return ktg_output_print(dxf->context, dxf->output, "%3d\r\n%d\r\n", code, value);
}

/* With a point in it: some readers want that. */
ktg_status ktg_dxf_real(const ktg_dxf *dxf, int code, double value) {
    char number[KTG_NUMBER_SIZE + 2];
    ktg_plot_number(value, number);
    if (!strchr(number, '.'))
        strcat(number, ".0");
    return ktg_dxf_word(dxf, code, number);
}

ktg_status ktg_dxf_point(const ktg_dxf *dxf, int which, ktg_vec2 point) {
    KTG_TRY(ktg_dxf_real(dxf, 10 + which, point.x));
    return ktg_dxf_real(dxf, 20 + which, point.y);
}

/* The code of the character at *at, which moves on; the text is valid. */
static uint32_t next_character(const unsigned char **at) {
    uint32_t lead = *(*at)++;
    int more = lead < 0xc0 ? 0 : lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
    uint32_t code = more ? lead & (0x3fu >> more) : lead;
    for (; more > 0 && **at; more--)
        code = code << 6 | (*(*at)++ & 0x3f);
    return code;
}

/* A caret begins a control character and two percent signs a mark, so that these are spelled. */
static void spell(const ktg_dxf *dxf, uint32_t code, const unsigned char *after, char *word) {
    if (code == '^')
        strcpy(word, "^ ");
    else if (code == '%' && *after == '%')
        strcpy(word, "%%%");
    else if (code < 0x80)
        snprintf(word, 8, "%c", (char)code);
    else if (code == 0xb7 || code == 0xd7) /* the dot and the cross of a sheet's name */
        strcpy(word, code == 0xb7 ? "-" : "x");
    else if (dxf->ascii_only || code > 0xffff)
        strcpy(word, "?");
    else
        snprintf(word, 8, "\\U+%04X", (unsigned)code);
}

ktg_status ktg_dxf_text(const ktg_dxf *dxf, int code, const char *text) {
    char value[MOST_TEXT], word[8];
    size_t used = 0;
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        uint32_t character = next_character(&at);
        spell(dxf, character, at, word);
        if (used + strlen(word) + 1 > sizeof value)
            break;
        memcpy(value + used, word, strlen(word));
        used += strlen(word);
    }
    value[used] = 0;
    return ktg_dxf_word(dxf, code, value);
}

ktg_status ktg_dxf_section(const ktg_dxf *dxf, const char *name) {
    KTG_TRY(ktg_dxf_word(dxf, 0, "SECTION"));
    return ktg_dxf_word(dxf, 2, name);
}

ktg_status ktg_dxf_entity(const ktg_dxf *dxf, const char *kind, const char *layer) {
    KTG_TRY(ktg_dxf_word(dxf, 0, kind));
    return ktg_dxf_word(dxf, 8, layer);
}

static ktg_status begin_way(const ktg_dxf *dxf, const char *kind, const char *layer,
                            const char *pattern) {
    KTG_TRY(ktg_dxf_entity(dxf, kind, layer));
    return pattern ? ktg_dxf_word(dxf, 6, pattern) : KTG_OK;
}

ktg_status ktg_dxf_way(const ktg_dxf *dxf, const char *layer, const char *pattern,
                       const ktg_vec2 *points, size_t count, bool closed) {
    if (count == 2 && !closed) {
        KTG_TRY(begin_way(dxf, "LINE", layer, pattern));
        KTG_TRY(ktg_dxf_point(dxf, 0, points[0]));
        return ktg_dxf_point(dxf, 1, points[1]);
    }
    KTG_TRY(begin_way(dxf, "POLYLINE", layer, pattern));
    KTG_TRY(ktg_dxf_integer(dxf, 66, 1));
    KTG_TRY(ktg_dxf_point(dxf, 0, (ktg_vec2){0, 0}));
    KTG_TRY(ktg_dxf_real(dxf, 30, 0));
    KTG_TRY(ktg_dxf_integer(dxf, 70, closed ? 1 : 0));
    for (size_t i = 0; i < count; i++) {
        KTG_TRY(ktg_dxf_entity(dxf, "VERTEX", layer));
        KTG_TRY(ktg_dxf_point(dxf, 0, points[i]));
    }
    return ktg_dxf_entity(dxf, "SEQEND", layer);
}

ktg_status ktg_dxf_line(const ktg_dxf *dxf, const char *layer, ktg_vec2 at, double height,
                        const char *text) {
    KTG_TRY(ktg_dxf_entity(dxf, "TEXT", layer));
    KTG_TRY(ktg_dxf_point(dxf, 0, at));
    KTG_TRY(ktg_dxf_real(dxf, 40, height));
    KTG_TRY(ktg_dxf_text(dxf, 1, text));
    return ktg_dxf_word(dxf, 7, "STANDARD");
}

ktg_status ktg_dxf_label(const ktg_dxf *dxf, const char *layer, ktg_vec2 at, double width,
                         double height, double angle, const char *text) {
    ktg_vec2 along = {cos(angle), sin(angle)};
    ktg_vec2 begin = ktg_madd2(ktg_madd2(at, -width / 2, along), -height / 2, ktg_perp2(along));
    KTG_TRY(ktg_dxf_line(dxf, layer, begin, height, text));
    KTG_TRY(ktg_dxf_real(dxf, 50, remainder(angle, 2 * KTG_PI) * 180 / KTG_PI));
    KTG_TRY(ktg_dxf_integer(dxf, 72, 1));
    KTG_TRY(ktg_dxf_integer(dxf, 73, 2));
    return ktg_dxf_point(dxf, 1, at);
}
