/* render/bidi.c - letters that are written from right to left, put into the order in which they
 * stand. Of the bidirectional algorithm (Unicode Standard Annex 9) the part that short names need:
 * a text from left to right, stretches of it the other way, numbers in them as they are. */
#include "render/draw.h"
#include "render/text.h"

#include <string.h>

typedef enum kind { KIND_LEFT, KIND_RIGHT, KIND_NUMBER, KIND_NEUTRAL } kind;

static bool within(uint32_t code, uint32_t low, uint32_t high) {
    return code >= low && code <= high;
}

static kind kind_of(uint32_t code) {
    if (within(code, '0', '9') || within(code, 0x660, 0x669) || within(code, 0x6f0, 0x6f9))
        return KIND_NUMBER;
    if (within(code, 0x590, 0x8ff) || within(code, 0xfb1d, 0xfdff) ||
        within(code, 0xfe70, 0xfefe) || within(code, 0x10800, 0x10fff) ||
        within(code, 0x1e800, 0x1efff))
        return KIND_RIGHT;
    bool letter = within(code | 0x20, 'a', 'z') || code >= 0xc0;
    return letter ? KIND_LEFT : KIND_NEUTRAL;
}

/* The text is valid UTF-8. */
static size_t unpack(const char *text, uint32_t *codes) {
    size_t count = 0;
    for (const unsigned char *c = (const unsigned char *)text; *c; count++) {
        int more = *c < 0x80 ? 0 : *c < 0xe0 ? 1 : *c < 0xf0 ? 2 : 3;
        uint32_t code = more ? *c & (0x3fu >> more) : *c;
        for (c++; more > 0 && *c; more--, c++)
            code = code << 6 | (*c & 0x3f);
        codes[count] = code;
    }
    return count;
}

static void pack(const uint32_t *codes, size_t count, char *text) {
    static const uint32_t lead[] = {0, 0xc0, 0xe0, 0xf0};
    for (size_t i = 0; i < count; i++) {
        uint32_t c = codes[i];
        int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
        *text++ = (char)(lead[more] | c >> 6 * more);
        while (more-- > 0)
            *text++ = (char)(0x80 | (c >> 6 * more & 0x3f));
    }
    *text = 0;
}

static void reverse(uint32_t *codes, size_t from, size_t to) {
    for (; from + 1 < to; from++, to--) {
        uint32_t code = codes[from];
        codes[from] = codes[to - 1];
        codes[to - 1] = code;
    }
}

/* A bracket that opened at the right opens at the left now. */
static uint32_t mirrored(uint32_t code) {
    static const char pairs[] = "()[]{}<>";
    const char *at = code < 0x80 && code ? strchr(pairs, (int)code) : NULL;
    return at ? (uint32_t)pairs[(at - pairs) ^ 1] : code;
}

static void turn_stretch(uint32_t *codes, size_t from, size_t to) {
    reverse(codes, from, to);
    for (size_t i = from; i < to; i++) {
        size_t end = i;
        codes[i] = mirrored(codes[i]);
        while (end < to && kind_of(codes[end]) == KIND_NUMBER)
            end++;
        if (end > i) {
            reverse(codes, i, end);
            i = end - 1;
        }
    }
}

const char *ktg_text_order(const char *text, char ordered[KTG_TITLE_SIZE]) {
    uint32_t codes[KTG_TITLE_SIZE];
    if (strlen(text) >= KTG_TITLE_SIZE)
        return text;
    size_t count = unpack(text, codes), turned = 0;
    for (size_t i = 0; i < count; i++) {
        if (kind_of(codes[i]) != KIND_RIGHT)
            continue;
        size_t end = i + 1;
        for (size_t k = end; k < count && kind_of(codes[k]) != KIND_LEFT; k++)
            if (kind_of(codes[k]) == KIND_RIGHT)
                end = k + 1;
        turn_stretch(codes, i, end);
        i = end - 1;
        turned++;
    }
    if (turned == 0)
        return text;
    pack(codes, count, ordered);
    return ordered;
}
