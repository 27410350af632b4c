/* deform/edit_text.h - an edit file as sections, lines and words, before anything is made of them
 * (deform only). */
#ifndef KTG_DEFORM_EDIT_TEXT_H
#define KTG_DEFORM_EDIT_TEXT_H

#include "deform/deform.h"

#include <locale.h>

/* A word, in quotes or not; one in quotes is a name, whatever it says. */
typedef struct ktg_edit_word {
    const char *text;
    bool quoted;
} ktg_edit_word;

/* "key = word word ...". */
typedef struct ktg_edit_line {
    uint64_t line;
    const char *key;
    size_t first_word, word_count;
} ktg_edit_line;

/* "[kind name]"; the name is "" where there is none. */
typedef struct ktg_edit_section {
    uint64_t line;
    const char *kind, *name;
    size_t first_line, line_count;
} ktg_edit_section;

/* All texts point into `bytes`. */
typedef struct ktg_edit_text {
    ktg_context *context;
    char *file, *bytes;
    locale_t plain; /* numbers have a point everywhere */
    size_t section_count, section_capacity, line_count, line_capacity, word_count, word_capacity;
    ktg_edit_section *sections;
    ktg_edit_line *lines;
    ktg_edit_word *words;
} ktg_edit_text;

/* Reads the file; *text is to be freed also after a failure. */
KTG_NODISCARD ktg_status ktg_edit_text_read(ktg_context *context, const char *path,
                                            ktg_edit_text *text);
void ktg_edit_text_free(ktg_edit_text *text);

/* Fails with the file's name and that line. */
ktg_status ktg_edit_text_fail(const ktg_edit_text *text, uint64_t line, const char *format, ...)
    KTG_PRINTF(3, 4);

/* The words behind the key. */
const ktg_edit_word *ktg_edit_words(const ktg_edit_text *text, const ktg_edit_line *line);

/* Exactly `count` numbers, from word `at` of the line on: finite, at most 1e30 either way. */
KTG_NODISCARD ktg_status ktg_edit_numbers(const ktg_edit_text *text, const ktg_edit_line *line,
                                          size_t at, size_t count, double *numbers);
/* One whole number, the line's word `at`. */
KTG_NODISCARD ktg_status ktg_edit_whole(const ktg_edit_text *text, const ktg_edit_line *line,
                                        size_t at, uint32_t least, uint32_t most, uint32_t *number);
/* Fails unless the line has `count` words behind its key; `form` says which. */
KTG_NODISCARD ktg_status ktg_edit_want_words(const ktg_edit_text *text, const ktg_edit_line *line,
                                             size_t count, const char *form);

#endif
