/* pattern/sheet.c - paper sizes by name or by measure. */
#include "pattern/pattern.h"

#include "core/memory.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What a custom sheet may measure: from a calling card to a roll of ten metres. */
#define LEAST_MM 20
#define MOST_MM  10000

static const struct {
    const char *name;
    double width_mm, height_mm;
} known[] = {
    {"A4", 210, 297},
    {"A0", 841, 1189},
    {"A1", 594, 841},
    {"A2", 420, 594},
    {"A3", 297, 420},
    {"A3+", 329, 483},
    {"A5", 148, 210},
    {"A6", 105, 148},
    {"B3", 353, 500},
    {"B4", 250, 353},
    {"B5", 176, 250},
    {"JIS-B3", 364, 515},
    {"JIS-B4", 257, 364},
    {"JIS-B5", 182, 257},
    {"Letter", 215.9, 279.4},
    {"Legal", 215.9, 355.6},
    {"Tabloid", 279.4, 431.8},
    {"Ledger", 279.4, 431.8},
    {"Statement", 139.7, 215.9},
    {"ANSI-C", 431.8, 558.8},
    {"ANSI-D", 558.8, 863.6},
    {"ANSI-E", 863.6, 1117.6},
};

void ktg_sheet_defaults(ktg_sheet_format *format) {
    *format = (ktg_sheet_format){"A4", 210, 297, 10};
}

/* Reads digits with at most one point (never the locale's comma, nor "inf" or "0x"). */
static bool read_number(const char **text, double *number) {
    const char *p = *text;
    double value = 0, unit = 1;
    int digits = 0;
    for (; isdigit((unsigned char)*p) && digits < 15; p++, digits++)
        value = 10 * value + (*p - '0');
    if (*p == '.')
        for (p++; isdigit((unsigned char)*p) && digits < 15; p++, digits++) {
            value = 10 * value + (*p - '0');
            unit *= 10;
        }
    if (digits == 0)
        return false;
    *number = value / unit;
    *text = p;
    return true;
}

/* Millimetres per unit; *text moves behind the unit. 0: there is none here. */
static double read_unit(const char **text) {
    static const struct {
        const char *name;
        double mm;
    } units[] = {{"mm", 1}, {"cm", 10}, {"in", 25.4}};
    for (int k = 0; k < 3; k++)
        if (strncasecmp(*text, units[k].name, 2) == 0) {
            *text += 2;
            return units[k].mm;
        }
    return 0;
}

/* "8.5x11in", "210 x 297", "21cmx297mm": one unit behind the height holds for both. */
static bool read_measures(const char *text, double *width_mm, double *height_mm) {
    while (*text == ' ')
        text++;
    if (!read_number(&text, width_mm))
        return false;
    double width_unit = read_unit(&text);
    while (*text == ' ')
        text++;
    if (*text != 'x' && *text != 'X')
        return false;
    for (text++; *text == ' ';)
        text++;
    if (!read_number(&text, height_mm))
        return false;
    while (*text == ' ')
        text++;
    double height_unit = read_unit(&text);
    if (*text != '\0' || (width_unit > 0 && height_unit == 0))
        return false;
    height_unit = height_unit > 0 ? height_unit : 1;
    *height_mm *= height_unit;
    *width_mm *= width_unit > 0 ? width_unit : height_unit;
    return true;
}

/* "%g" would follow the locale; a paper's name has whole tenths of a millimetre. */
static void name_measures(ktg_sheet_format *format) {
    long tenths[2] = {lround(10 * format->width_mm), lround(10 * format->height_mm)};
    char parts[2][12];
    for (int k = 0; k < 2; k++) {
        int length = snprintf(parts[k], sizeof parts[k], "%ld", tenths[k] / 10);
        if (tenths[k] % 10)
            snprintf(parts[k] + length, sizeof parts[k] - (size_t)length, ".%ld", tenths[k] % 10);
    }
    snprintf(format->name, sizeof format->name, "%sx%s", parts[0], parts[1]);
}

static ktg_status unknown_sheet(ktg_context *context, const char *text) {
    return ktg_fail(context, KTG_ARGUMENT,
                    "\"%.40s\" is not a paper size: use a0 to a6, a3+, b3 to b5, jis-b3 to jis-b5, "
                    "letter, legal, "
                    "tabloid, ledger, statement, ansi-c to ansi-e, "
                    "width x height such as 210x297, 21x29.7cm or 8.5x11in, or fit",
                    text);
}

ktg_status ktg_sheet_parse(ktg_context *context, const char *text, ktg_sheet_format *format) {
    if (!text)
        return unknown_sheet(context, "");
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
        if (strcasecmp(text, known[k].name) == 0) {
            snprintf(format->name, sizeof format->name, "%s", known[k].name);
            format->width_mm = known[k].width_mm;
            format->height_mm = known[k].height_mm;
            return KTG_OK;
        }
    double width, height;
    if (strcasecmp(text, "fit") == 0) {
        *format = (ktg_sheet_format){"fit", INFINITY, INFINITY, format->margin_mm};
        return KTG_OK;
    }
    if (!read_measures(text, &width, &height))
        return unknown_sheet(context, text);
    if (!(width >= LEAST_MM) || !(width <= MOST_MM) || !(height >= LEAST_MM) ||
        !(height <= MOST_MM))
        return ktg_fail(context, KTG_ARGUMENT,
                        "a sheet of %.6g x %.6g mm: each side must be %d to %d mm", width, height,
                        LEAST_MM, MOST_MM);
    format->width_mm = width;
    format->height_mm = height;
    name_measures(format);
    return KTG_OK;
}
