/* mesh/read_scan.c - a scanner over a file in memory: lines, words, numbers, errors with a place.
 *
 * Numbers are read the same way in every locale. Most of them have so few digits that one exact
 * multiplication or division by a power of ten gives the nearest double (Clinger 1990, "How to read
 * floating point numbers accurately", the fast case); the rest goes to strtod in the C locale. */
#include "core/file.h"
#include "core/memory.h"
#include "core/text.h"
#include "mesh/read.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Beyond this, products of a few lengths overflow. */
#define LARGEST_NUMBER 1e75

#define LARGEST_FILE ((size_t)2 << 30)

ktg_status ktg_scan_open(ktg_context *context, const char *path, ktg_scan_file *file,
                         ktg_scan *scan) {
    const char *shown = strcmp(path, "-") == 0 ? "standard input" : path;
    *file = (ktg_scan_file){0};
    *scan = (ktg_scan){.context = context, .line = 1};
    KTG_TRY(ktg_file_read(context, path, LARGEST_FILE, &file->bytes, &file->size));
    file->name = ktg_name_clean(context, (ktg_word){shown, strlen(shown)});
    if (!file->name)
        return KTG_MEMORY;
    scan->plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (scan->plain == (locale_t)0)
        return ktg_fail(context, KTG_MEMORY, "out of memory (locale)");
    scan->name = file->name;
    scan->start = scan->at = file->bytes;
    scan->end = file->bytes + file->size;
    if (file->size >= 3 && memcmp(file->bytes, "\xef\xbb\xbf", 3) == 0)
        scan->at += 3; /* a byte order mark */
    return KTG_OK;
}

void ktg_scan_close(ktg_scan_file *file, ktg_scan *scan) {
    if (scan->plain != (locale_t)0)
        freelocale(scan->plain);
    ktg_free(file->name);
    ktg_free(file->bytes);
}

ktg_status ktg_scan_fail(const ktg_scan *scan, ktg_status status, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    ktg_vformat(text, sizeof text, format, arguments);
    va_end(arguments);
    if (scan->line == 0)
        return ktg_fail(scan->context, status, "%s: %s", scan->name, text);
    return ktg_fail(scan->context, status, "%s:%llu: %s", scan->name,
                    (unsigned long long)scan->line, text);
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* Also true for the 0 byte behind the file. */
static bool is_line_end(const ktg_scan *scan, const char *at) {
    return *at == '\n' || *at == '\r' || at >= scan->end;
}

/* The length of the line end at `at`: \n, \r\n or \r. */
static size_t line_end_length(const char *at) {
    return at[0] == '\r' && at[1] == '\n' ? 2 : 1;
}

static bool is_continuation(const ktg_scan *scan, const char *at) {
    return scan->continued && *at == '\\' && (at[1] == '\n' || at[1] == '\r');
}

static void skip_blanks(ktg_scan *scan) {
    for (;;) {
        while (is_blank(*scan->at))
            scan->at++;
        if (!is_continuation(scan, scan->at))
            return;
        scan->at += 1 + line_end_length(scan->at + 1);
        scan->line++;
    }
}

bool ktg_scan_line_ends(ktg_scan *scan) {
    skip_blanks(scan);
    return is_line_end(scan, scan->at) || *scan->at == '#';
}

void ktg_scan_next_line(ktg_scan *scan) {
    bool comment = *scan->at == '#';
    while (!is_line_end(scan, scan->at)) {
        /* A comment is not continued: a path in it may end with a backslash. */
        if (*scan->at == '\\' && !comment && is_continuation(scan, scan->at)) {
            scan->at += line_end_length(scan->at + 1);
            scan->line++;
        }
        scan->at++;
    }
    if (scan->at < scan->end) {
        scan->at += line_end_length(scan->at);
        scan->line++;
    }
}

bool ktg_scan_content(ktg_scan *scan) {
    while (ktg_scan_line_ends(scan)) {
        if (scan->at >= scan->end)
            return false;
        ktg_scan_next_line(scan);
    }
    return true;
}

ktg_word ktg_scan_word(ktg_scan *scan) {
    skip_blanks(scan);
    ktg_word word = {scan->at, 0};
    while (!is_blank(*scan->at) && !is_line_end(scan, scan->at) && !is_continuation(scan, scan->at))
        scan->at++;
    word.length = (size_t)(scan->at - word.text);
    return word;
}

size_t ktg_scan_words_left(ktg_scan scan) {
    size_t count = 0;
    for (; !ktg_scan_line_ends(&scan); count++)
        (void)ktg_scan_word(&scan);
    return count;
}

bool ktg_word_is(ktg_word word, const char *text) {
    return strlen(text) == word.length && memcmp(text, word.text, word.length) == 0;
}

bool ktg_word_means(ktg_word word, const char *text) {
    return strlen(text) == word.length && strncasecmp(text, word.text, word.length) == 0;
}

const char *ktg_word_show(ktg_word word, char text[KTG_SHOWN_SIZE]) {
    size_t length = word.length < 40 ? word.length : 40;
    for (size_t i = 0; i < length; i++)
        text[i] = word.text[i] >= ' ' && word.text[i] < 127 ? word.text[i] : '?';
    strcpy(text + length, word.length > 40 ? "..." : "");
    return text;
}

ktg_word ktg_scan_rest(ktg_scan *scan) {
    skip_blanks(scan);
    ktg_word rest = {scan->at, 0};
    while (!is_line_end(scan, scan->at) && !is_continuation(scan, scan->at))
        scan->at++;
    const char *end = scan->at;
    while (end > rest.text && is_blank(end[-1]))
        end--;
    rest.length = (size_t)(end - rest.text);
    return rest;
}

/* ---- numbers ------------------------------------------------------------------------------ */

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static bool ends_number(const ktg_scan *scan, const char *at) {
    return is_blank(*at) || is_line_end(scan, at) || *at == '#' || is_continuation(scan, at);
}

static ktg_status fail_number(ktg_scan *scan, const char *what, const char *wanted) {
    char shown[KTG_SHOWN_SIZE];
    if (ktg_scan_line_ends(scan))
        return ktg_scan_fail(scan, KTG_FORMAT, "%s is missing here; %s", what,
                             scan->at >= scan->end ? "the file is truncated" : "the line ends");
    ktg_word word = ktg_scan_word(scan);
    return ktg_scan_fail(scan, KTG_FORMAT, "\"%s\" is not %s, but %s is wanted here",
                         ktg_word_show(word, shown), wanted, what);
}

/* A decimal number taken apart: mantissa * 10^exponent; exact when no digit was left out. */
typedef struct decimal {
    uint64_t mantissa;
    int digits; /* significant ones in the mantissa, at most 19 */
    bool exact, any;
    long exponent;
} decimal;

static const char *take_digits(const char *at, decimal *number, bool fraction) {
    for (; is_digit(*at); at++) {
        number->any = true;
        if (number->digits < 19) {
            number->mantissa = number->mantissa * 10 + (uint64_t)(*at - '0');
            number->digits += number->mantissa != 0;
            number->exponent -= fraction;
        } else {
            number->exact = false;
            number->exponent += !fraction;
        }
    }
    return at;
}

static const char *take_exponent(const char *at, decimal *number) {
    const char *from = at + 1;
    bool negative = *from == '-';
    if (*from == '-' || *from == '+')
        from++;
    if ((*at != 'e' && *at != 'E') || !is_digit(*from))
        return at;
    long exponent = 0;
    for (; is_digit(*from); from++)
        if (exponent < 100000)
            exponent = exponent * 10 + (*from - '0');
    number->exponent += negative ? -exponent : exponent;
    return from;
}

/* The double of a decimal where one rounding gives it. */
static bool convert_exactly(const decimal *number, double *value) {
    static const double ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (!number->exact || number->mantissa > (UINT64_C(1) << 53) || number->exponent < -22 ||
        number->exponent > 22)
        return false;
    *value = (double)number->mantissa;
    if (number->exponent < 0)
        *value /= ten[-number->exponent];
    else
        *value *= ten[number->exponent];
    return true;
}

ktg_status ktg_scan_number(ktg_scan *scan, const char *what, double *value) {
    if (ktg_scan_line_ends(scan))
        return fail_number(scan, what, "a number");
    const char *at = scan->at;
    bool negative = *at == '-';
    if (*at == '-' || *at == '+')
        at++;
    decimal number = {0, 0, true, false, 0};
    at = take_digits(at, &number, false);
    if (*at == '.')
        at = take_digits(at + 1, &number, true);
    if (!number.any)
        return fail_number(scan, what, "a finite number");
    at = take_exponent(at, &number);
    if (!ends_number(scan, at))
        return fail_number(scan, what, "a number");
    if (!convert_exactly(&number, value))
        *value = strtod_l(scan->at, NULL, scan->plain);
    else if (negative)
        *value = -*value;
    if (isinf(*value))
        return fail_number(scan, what, "a number that fits a double");
    KTG_TRY(ktg_scan_check_number(scan, what, *value));
    scan->at = at;
    return KTG_OK;
}

ktg_status ktg_scan_check_number(const ktg_scan *scan, const char *what, double value) {
    if (isnan(value) || isinf(value))
        return ktg_scan_fail(scan, KTG_FORMAT, "%s is not a finite number", what);
    if (fabs(value) > LARGEST_NUMBER)
        return ktg_scan_fail(scan, KTG_LIMIT, "%s is %g; nothing above %g can be worked on", what,
                             value, LARGEST_NUMBER);
    return KTG_OK;
}

ktg_status ktg_scan_integer(ktg_scan *scan, const char *what, int64_t *value) {
    if (ktg_scan_line_ends(scan))
        return fail_number(scan, what, "a whole number");
    const char *at = scan->at;
    bool negative = *at == '-';
    if (*at == '-' || *at == '+')
        at++;
    const char *digits = at;
    int64_t number = 0;
    for (; is_digit(*at); at++) {
        if (number >= INT64_C(100000000000000000))
            return fail_number(scan, what, "a number of a size that makes sense");
        number = number * 10 + (*at - '0');
    }
    if (at == digits || !(ends_number(scan, at) || (scan->continued && *at == '/')))
        return fail_number(scan, what, "a whole number");
    *value = negative ? -number : number;
    scan->at = at;
    return KTG_OK;
}

ktg_status ktg_scan_row(ktg_scan *scan) {
    if (scan->rows_to_cancel_check-- > 0)
        return KTG_OK;
    scan->rows_to_cancel_check = 65536;
    ktg_progress(scan->context, "read",
                 (double)(scan->at - scan->start) / (double)(scan->end - scan->start), NULL);
    return ktg_check_cancel(scan->context);
}
