/* cli/words.c - numbers, lengths and choices in the words of a command line. */
#include "cli/words.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define LARGEST 1e9

/* strtod knows hexadecimal numbers, too, which nobody means: "0x10" is a slip. */
static bool read_decimal(const char *text, double *value, char **end) {
    *value = strtod(text, end);
    size_t length = (size_t)(*end - text);
    return length > 0 && strcspn(text, "xX") >= length;
}

bool cli_parse_amount(const char *text, const char *unit, double least, double most,
                      double *amount) {
    char *end;
    double value;
    if (!read_decimal(text, &value, &end) || (*end && strcmp(end, unit) != 0) ||
        !(value >= least && value <= most))
        return false;
    *amount = value;
    return true;
}

bool cli_parse_number(const char *text, double least, double most, double *number) {
    return cli_parse_amount(text, "", least, most, number);
}

bool cli_parse_count(const char *text, uint64_t least, uint64_t most, uint64_t *count) {
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (!isdigit((unsigned char)*text) || *end || errno || value < least || value > most)
        return false;
    *count = value;
    return true;
}

bool cli_parse_count32(const char *text, uint32_t least, uint32_t *count) {
    uint64_t value;
    if (!cli_parse_count(text, least, UINT32_MAX - 1, &value))
        return false;
    *count = (uint32_t)value;
    return true;
}

bool cli_parse_length(const char *text, double *mm) {
    static const struct {
        const char *unit;
        double mm;
    } units[] = {{"", 1}, {"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"\"", 25.4}};
    char *end;
    double value;
    if (!read_decimal(text, &value, &end) || !(value >= 0 && value <= LARGEST))
        return false;
    while (*end == ' ')
        end++;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(end, units[i].unit) == 0) {
            *mm = value * units[i].mm;
            return true;
        }
    }
    return false;
}

int cli_word_index(const char *text, const char *const *words) {
    for (int i = 0; words[i]; i++)
        if (strcmp(text, words[i]) == 0)
            return i;
    return -1;
}
