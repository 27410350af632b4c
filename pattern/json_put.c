/* pattern/json_put.c - the text of a JSON file, item by item; jansson writes the strings. */
#include "pattern/json_put.h"
#include "core/memory.h"
#include "pattern/json_words.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_NUMBER 64 /* bytes of one formatted number */

void ktg_json_flush(ktg_json_writer *w) {
    if (w->status == KTG_OK)
        w->status = ktg_output_write(w->context, w->output, w->text, w->length);
    w->length = 0;
}

static void put_bytes(ktg_json_writer *w, const char *text, size_t length) {
    while (length > 0) {
        if (w->length == KTG_JSON_BUFFER)
            ktg_json_flush(w);
        size_t part = KTG_JSON_BUFFER - w->length < length ? KTG_JSON_BUFFER - w->length : length;
        memcpy(w->text + w->length, text, part);
        w->length += part;
        text += part;
        length -= part;
    }
}

void ktg_json_put(ktg_json_writer *w, const char *text) {
    put_bytes(w, text, strlen(text));
}

void ktg_json_between(ktg_json_writer *w, size_t index, const char *separator) {
    if (index > 0)
        ktg_json_put(w, separator);
}

void ktg_json_put_count(ktg_json_writer *w, size_t value) {
    char text[MOST_NUMBER];
    put_bytes(w, text, (size_t)snprintf(text, sizeof text, "%zu", value));
}

/* Fifteen digits where they read back to the same double, else seventeen, which always do. */
void ktg_json_put_number(ktg_json_writer *w, double value) {
    char text[MOST_NUMBER];
    if (!isfinite(value)) {
        if (w->status == KTG_OK)
            w->status = ktg_fail(w->context, KTG_ARGUMENT,
                                 "the pattern holds a number that is not finite; it has no JSON "
                                 "form");
        return;
    }
    if (value == 0) {
        ktg_json_put(w, signbit(value) ? "-0.0" : "0");
        return;
    }
    int length = snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) != value)
        length = snprintf(text, sizeof text, "%.17g", value);
    put_bytes(w, text, (size_t)length);
}

/* An angle in degrees: of the doubles around it one that reads back to the same radians, a short
 * one (60, not 59.99999999999999) if there is one, so that a pattern read and written again does
 * not drift. */
void ktg_json_put_degrees(ktg_json_writer *w, double radians) {
    char text[MOST_NUMBER];
    double near = ktg_json_degrees(radians), best = near;
    snprintf(text, sizeof text, "%.15g", near);
    double tries[4] = {strtod(text, NULL), near, nextafter(near, -INFINITY),
                       nextafter(near, INFINITY)};
    for (int i = 3; i >= 0; i--)
        if (ktg_json_radians(tries[i]) == radians)
            best = tries[i];
    ktg_json_put_number(w, best);
}

void ktg_json_put_point(ktg_json_writer *w, ktg_vec2 p) {
    ktg_json_put(w, "[");
    ktg_json_put_number(w, p.x);
    ktg_json_put(w, ",");
    ktg_json_put_number(w, p.y);
    ktg_json_put(w, "]");
}

void ktg_json_put_points(ktg_json_writer *w, const ktg_vec2 *list, size_t list_count) {
    ktg_json_put(w, "[");
    for (size_t i = 0; i < list_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put_point(w, list[i]);
    }
    ktg_json_put(w, "]");
}

void ktg_json_put_triple(ktg_json_writer *w, const uint32_t *values) {
    for (int k = 0; k < 3; k++) {
        ktg_json_put(w, k ? "," : "[");
        ktg_json_put_count(w, values[k]);
    }
    ktg_json_put(w, "]");
}

void ktg_json_put_text(ktg_json_writer *w, const char *text) {
    if (!text) {
        ktg_json_put(w, "null");
        return;
    }
    json_t *value = json_string(text);
    char *plain = value ? NULL : ktg_copy_text(w->context, text, SIZE_MAX);
    for (char *c = plain; c && *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    if (plain)
        value = json_string(plain);
    char *written = value ? json_dumps(value, JSON_ENCODE_ANY) : NULL;
    if (written)
        ktg_json_put(w, written);
    else if (w->status == KTG_OK)
        w->status = ktg_fail(w->context, KTG_MEMORY, "out of memory (a name of the pattern)");
    free(written); /* jansson's own */
    json_decref(value);
    ktg_free(plain);
}
