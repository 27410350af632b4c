/* core/text.c - text in printf form, the same in every locale. */
#include "core/text.h"

#include <errno.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The thread's locale while numbers are written, and the one before. */
typedef struct plain_numbers {
    locale_t plain, before;
} plain_numbers;

static plain_numbers begin_plain(void) {
    plain_numbers p = {newlocale(LC_NUMERIC_MASK, "C", (locale_t)0), (locale_t)0};
    if (p.plain != (locale_t)0)
        p.before = uselocale(p.plain);
    return p;
}

static void end_plain(plain_numbers p) {
    int error = errno;
    if (p.plain != (locale_t)0) {
        uselocale(p.before);
        freelocale(p.plain);
    }
    errno = error;
}

int ktg_vformat(char *text, size_t size, const char *format, va_list arguments) {
    plain_numbers p = begin_plain();
    int length = vsnprintf(text, size, format, arguments);
    end_plain(p);
    return length;
}

int ktg_vprint(FILE *stream, const char *format, va_list arguments) {
    plain_numbers p = begin_plain();
    int length = vfprintf(stream, format, arguments);
    end_plain(p);
    return length;
}

int ktg_format(char *text, size_t size, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int length = ktg_vformat(text, size, format, arguments);
    va_end(arguments);
    return length;
}

static bool continues_character(char c) {
    return ((unsigned char)c & 0xc0) == 0x80;
}

/* The first and the last part of `whole`, cut between characters of UTF-8. */
static void elide(char *text, size_t size, const char *whole, size_t length) {
    static const char dots[] = "...";
    size_t head = (size - sizeof dots) / 2, tail = length - (size - sizeof dots - head);
    while (head > 0 && continues_character(whole[head]))
        head--;
    while (tail < length && continues_character(whole[tail]))
        tail++;
    memcpy(text, whole, head);
    memcpy(text + head, dots, sizeof dots - 1);
    memcpy(text + head + sizeof dots - 1, whole + tail, length - tail + 1);
}

void ktg_vformat_elided(char *text, size_t size, const char *format, va_list arguments) {
    va_list again;
    va_copy(again, arguments);
    int length = ktg_vformat(text, size, format, arguments);
    char *whole = length >= 0 && (size_t)length >= size ? malloc((size_t)length + 1) : NULL;
    if (whole) { /* else what fits must do */
        ktg_vformat(whole, (size_t)length + 1, format, again);
        elide(text, size, whole, (size_t)length);
    }
    va_end(again);
    free(whole);
}
