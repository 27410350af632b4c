/* deform/edit_text.c - an edit file as sections, lines and words. */
#include "deform/edit_text.h"
#include "core/file.h"
#include "core/memory.h"
#include "core/text.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LARGEST_FILE   ((size_t)16 << 20)
#define LARGEST_NUMBER 1e30
#define MOST_SECTIONS  2000
#define SHOWN          60 /* of a word in a message */

ktg_status ktg_edit_text_fail(const ktg_edit_text *text, uint64_t line, const char *format, ...) {
    char said[1024];
    va_list arguments;
    va_start(arguments, format);
    ktg_vformat(said, sizeof said, format, arguments);
    va_end(arguments);
    return ktg_fail(text->context, KTG_FORMAT, "%s:%llu: %s", text->file, (unsigned long long)line,
                    said);
}

/* ---- words ---------------------------------------------------------------------------------- */

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static char *skip_blanks(char *at) {
    while (is_blank(*at))
        at++;
    return at;
}

/* Ends the word at *at with a 0 byte, in its place, and goes behind it. `stops` end a word that is
 * not in quotes; they are overwritten, too, and *stop says which one it was (0: a blank or the
 * line's end). */
static ktg_status take_word(const ktg_edit_text *text, uint64_t line, char **at, const char *stops,
                            ktg_edit_word *word, char *stop) {
    char *end;
    word->quoted = **at == '"';
    *stop = 0;
    if (word->quoted) {
        word->text = *at + 1;
        end = strchr(*at + 1, '"');
        if (!end)
            return ktg_edit_text_fail(text, line, "a quote (\") is opened and not closed");
        *end++ = 0;
        if (*end && !is_blank(*end) && *end != '#' && !strchr(stops, *end))
            return ktg_edit_text_fail(text, line, "a blank is missing behind a quote (\")");
    } else {
        word->text = *at;
        for (end = *at; *end && !is_blank(*end) && *end != '#' && !strchr(stops, *end);)
            end++;
    }
    *at = end;
    if (*end == '#') {
        *end = 0; /* a comment: nothing is behind the word */
    } else if (*end) {
        *stop = is_blank(*end) ? 0 : *end;
        *end = 0;
        *at = end + 1;
    }
    return KTG_OK;
}

static bool line_ends(const char *at) {
    return *at == 0 || *at == '#';
}

/* ---- lines ---------------------------------------------------------------------------------- */

static ktg_status add_section(ktg_edit_text *text, uint64_t line, const char *kind,
                              const char *name) {
    if (text->section_count == MOST_SECTIONS)
        return ktg_edit_text_fail(text, line, "an edit has at most %d sections", MOST_SECTIONS);
    KTG_TRY(ktg_reserve(text->context, &text->sections, &text->section_capacity,
                        text->section_count + 1));
    text->sections[text->section_count++] =
        (ktg_edit_section){line, kind, name, text->line_count, 0};
    return KTG_OK;
}

/* "[kind name]" */
static ktg_status take_section(ktg_edit_text *text, uint64_t line, char *at) {
    ktg_edit_word words[2] = {{"", false}, {"", false}};
    size_t count = 0;
    char stop = 0;
    at = skip_blanks(at + 1);
    while (!stop && !line_ends(at) && *at != ']') {
        if (count == 2)
            return ktg_edit_text_fail(text, line,
                                      "a section is [kind name]; put a name with blanks in "
                                      "quotes (\")");
        KTG_TRY(take_word(text, line, &at, "]", &words[count++], &stop));
        at = skip_blanks(at);
    }
    if (!stop && *at == ']') {
        stop = ']';
        at++;
    }
    if (stop != ']' || count == 0 || words[0].quoted)
        return ktg_edit_text_fail(text, line, "a section is written [kind name]");
    if (!line_ends(skip_blanks(at)))
        return ktg_edit_text_fail(text, line, "nothing may stand behind a section's ]");
    return add_section(text, line, words[0].text, words[1].text);
}

/* "key = word word ..." */
static ktg_status take_line(ktg_edit_text *text, uint64_t line, char *at) {
    ktg_edit_word key;
    char stop;
    KTG_TRY(take_word(text, line, &at, "=", &key, &stop));
    at = skip_blanks(at);
    if (stop != '=' && *at++ != '=')
        return ktg_edit_text_fail(text, line, "here a line is \"key = value\", not \"%.*s ...\"",
                                  SHOWN, key.text);
    if (text->section_count == 0)
        return ktg_edit_text_fail(text, line, "\"%.*s\" stands before the first [section]", SHOWN,
                                  key.text);
    KTG_TRY(ktg_reserve(text->context, &text->lines, &text->line_capacity, text->line_count + 1));
    ktg_edit_line *made = &text->lines[text->line_count++];
    *made = (ktg_edit_line){line, key.text, text->word_count, 0};
    text->sections[text->section_count - 1].line_count++;
    for (at = skip_blanks(at); !line_ends(at); at = skip_blanks(at)) {
        KTG_TRY(
            ktg_reserve(text->context, &text->words, &text->word_capacity, text->word_count + 1));
        KTG_TRY(take_word(text, line, &at, "", &text->words[text->word_count++], &stop));
        made->word_count++;
    }
    if (made->word_count == 0)
        return ktg_edit_text_fail(text, line, "\"%.*s\" has no value", SHOWN, key.text);
    return KTG_OK;
}

/* A line's end becomes a 0 byte; NULL behind the last line. */
static char *cut_line(char *at, char *end, char **next) {
    if (at >= end)
        return NULL;
    char *stop = memchr(at, '\n', (size_t)(end - at));
    *next = stop ? stop + 1 : end;
    if (!stop)
        stop = end;
    *stop = 0;
    if (stop > at && stop[-1] == '\r')
        stop[-1] = 0;
    return at;
}

static ktg_status check_bytes(const ktg_edit_text *text, uint64_t line, const char *at,
                              const char *next) {
    size_t length = strlen(at);
    bool cut = at + length + 2 < next; /* a line end is two bytes at most */
    for (size_t i = 0; i < length; i++)
        cut |= (unsigned char)at[i] < ' ' && at[i] != '\t';
    return cut ? ktg_edit_text_fail(text, line, "a byte that is no text stands here") : KTG_OK;
}

static ktg_status take_lines(ktg_edit_text *text, char *at, char *end) {
    char *next;
    if (end - at >= 3 && memcmp(at, "\xef\xbb\xbf", 3) == 0)
        at += 3; /* a byte order mark */
    for (uint64_t line = 1; (at = cut_line(at, end, &next)); line++, at = next) {
        KTG_TRY(check_bytes(text, line, at, next));
        at = skip_blanks(at);
        if (*at == '[')
            KTG_TRY(take_section(text, line, at));
        else if (!line_ends(at))
            KTG_TRY(take_line(text, line, at));
    }
    return KTG_OK;
}

ktg_status ktg_edit_text_read(ktg_context *context, const char *path, ktg_edit_text *text) {
    size_t size;
    *text = (ktg_edit_text){.context = context};
    KTG_TRY(ktg_file_read(context, path, LARGEST_FILE, &text->bytes, &size));
    text->file = ktg_copy_text(context, strcmp(path, "-") == 0 ? "standard input" : path, SIZE_MAX);
    if (!text->file)
        return KTG_MEMORY;
    text->plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (text->plain == (locale_t)0)
        return ktg_fail(context, KTG_MEMORY, "out of memory (locale)");
    return take_lines(text, text->bytes, text->bytes + size);
}

void ktg_edit_text_free(ktg_edit_text *text) {
    if (text->plain != (locale_t)0)
        freelocale(text->plain);
    ktg_free(text->file);
    ktg_free(text->bytes);
    ktg_free(text->sections);
    ktg_free(text->lines);
    ktg_free(text->words);
    *text = (ktg_edit_text){0};
}

/* ---- values --------------------------------------------------------------------------------- */

const ktg_edit_word *ktg_edit_words(const ktg_edit_text *text, const ktg_edit_line *line) {
    return text->words + line->first_word;
}

ktg_status ktg_edit_want_words(const ktg_edit_text *text, const ktg_edit_line *line, size_t count,
                               const char *form) {
    if (line->word_count == count)
        return KTG_OK;
    return ktg_edit_text_fail(text, line->line, "here stands \"%s\"", form);
}

/* Decimal only: strtod would take nan, inf and 0x10, too. */
static bool looks_decimal(const char *text) {
    return *text && text[strspn(text, "0123456789.+-eE")] == 0;
}

ktg_status ktg_edit_numbers(const ktg_edit_text *text, const ktg_edit_line *line, size_t at,
                            size_t count, double *numbers) {
    const ktg_edit_word *words = ktg_edit_words(text, line) + at;
    if (line->word_count != at + count)
        return ktg_edit_text_fail(text, line->line, "%zu number%s wanted%s, and %zu stand here",
                                  count, count == 1 ? " is" : "s are", at > 0 ? " behind it" : "",
                                  line->word_count > at ? line->word_count - at : 0);
    for (size_t i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtod_l(words[i].text, &end, text->plain);
        if (!looks_decimal(words[i].text) || *end || end == words[i].text)
            return ktg_edit_text_fail(text, line->line, "\"%.*s\" is not a number", SHOWN,
                                      words[i].text);
        if (!(fabs(numbers[i]) <= LARGEST_NUMBER))
            return ktg_edit_text_fail(text, line->line, "%.*s is too large a number", SHOWN,
                                      words[i].text);
    }
    return KTG_OK;
}

ktg_status ktg_edit_whole(const ktg_edit_text *text, const ktg_edit_line *line, size_t at,
                          uint32_t least, uint32_t most, uint32_t *number) {
    const char *word = ktg_edit_words(text, line)[at].text;
    size_t length = strlen(word);
    unsigned long long value = length > 0 && length < 12 ? strtoull(word, NULL, 10) : 0;
    if (length == 0 || word[strspn(word, "0123456789")] || length >= 12 || value < least ||
        value > most)
        return ktg_edit_text_fail(text, line->line, "\"%.*s\" is not a whole number from %u to %u",
                                  SHOWN, word, least, most);
    *number = (uint32_t)value;
    return KTG_OK;
}
