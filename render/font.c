/* render/font.c - another typeface for texts that DejaVu Sans has not all letters of (Japanese and
 * many more): the one of the system's that has them, as fontconfig finds it. */
#include "render/draw.h"
#include "render/text.h"

#include <fontconfig/fontconfig.h>
#include <string.h>

/* True when the chosen face has a glyph for every character of `text`. */
static bool has_all(cairo_t *cairo, const char *text) {
    cairo_glyph_t *glyphs = NULL;
    int count = 0;
    bool all = true;
    cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(cairo), 0, 0, text, -1, &glyphs, &count,
                                     NULL, NULL, NULL);
    for (int i = 0; i < count; i++)
        all = all && glyphs[i].index != 0;
    cairo_glyph_free(glyphs);
    return all;
}

static FcCharSet *letters_of(const char *text) {
    FcCharSet *letters = FcCharSetCreate();
    const FcChar8 *at = (const FcChar8 *)text;
    int left = (int)strlen(text), bytes;
    FcChar32 code;
    for (; letters && left > 0 && (bytes = FcUtf8ToUcs4(at, &code, left)) > 0; left -= bytes) {
        FcCharSetAddChar(letters, code);
        at += bytes;
    }
    return letters;
}

/* What fontconfig thinks of for these letters; free with FcPatternDestroy. */
static FcPattern *match_letters(FcCharSet *letters, bool bold) {
    FcPattern *wish = FcPatternCreate(), *match = NULL;
    FcResult result;
    if (!wish)
        return NULL;
    FcPatternAddString(wish, FC_FAMILY, (const FcChar8 *)KTG_FONT_FAMILY);
    FcPatternAddInteger(wish, FC_WEIGHT, bold ? FC_WEIGHT_BOLD : FC_WEIGHT_NORMAL);
    FcPatternAddCharSet(wish, FC_CHARSET, letters);
    if (FcConfigSubstitute(NULL, wish, FcMatchPattern)) {
        FcDefaultSubstitute(wish);
        match = FcFontMatch(NULL, wish, &result);
    }
    FcPatternDestroy(wish);
    return match;
}

/* The family that has the letters (to fontconfig they matter more than the family's name). */
static bool find_family(const char *text, bool bold, char *family, size_t size) {
    FcCharSet *letters = letters_of(text);
    if (!letters)
        return false;
    FcPattern *match = match_letters(letters, bold);
    FcChar8 *name = NULL;
    bool found = match && FcPatternGetString(match, FC_FAMILY, 0, &name) == FcResultMatch &&
                 strlen((const char *)name) < size;
    if (found)
        memcpy(family, name, strlen((const char *)name) + 1);
    if (match)
        FcPatternDestroy(match);
    FcCharSetDestroy(letters);
    return found;
}

cairo_font_face_t *ktg_font_begin(cairo_t *cairo, const char *text) {
    cairo_font_face_t *usual = cairo_font_face_reference(cairo_get_font_face(cairo));
    char family[128];
    if (has_all(cairo, text))
        return usual;
    cairo_font_weight_t weight = cairo_toy_font_face_get_weight(usual);
    if (find_family(text, weight == CAIRO_FONT_WEIGHT_BOLD, family, sizeof family))
        cairo_select_font_face(cairo, family, CAIRO_FONT_SLANT_NORMAL, weight);
    return usual;
}

void ktg_font_end(cairo_t *cairo, cairo_font_face_t *usual) {
    cairo_set_font_face(cairo, usual);
    cairo_font_face_destroy(usual);
}
