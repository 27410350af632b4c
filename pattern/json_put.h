/* pattern/json_put.h - the text of a JSON file, put together item by item (this room only). It
 * needs one buffer for a pattern of any size, and a locale in which numbers have points. */
#ifndef KTG_PATTERN_JSON_PUT_H
#define KTG_PATTERN_JSON_PUT_H

#include "core/core.h"

#define KTG_JSON_BUFFER 65536

/* The first failure stays in `status`; after it nothing more is written. */
typedef struct ktg_json_writer {
    ktg_context *context;
    ktg_output *output;
    ktg_status status;
    size_t length;
    char text[KTG_JSON_BUFFER];
} ktg_json_writer;

/* Words and marks as they are. */
void ktg_json_put(ktg_json_writer *w, const char *text);

/* Between items: the separator, except before the first. */
void ktg_json_between(ktg_json_writer *w, size_t index, const char *separator);

void ktg_json_put_count(ktg_json_writer *w, size_t value);

/* The shorter of two exact forms. A number that is not finite is a failure. */
void ktg_json_put_number(ktg_json_writer *w, double value);
void ktg_json_put_degrees(ktg_json_writer *w, double radians);

/* [x,y], and a list of such. */
void ktg_json_put_point(ktg_json_writer *w, ktg_vec2 p);
void ktg_json_put_points(ktg_json_writer *w, const ktg_vec2 *list, size_t list_count);

/* Three indices as [a,b,c]. */
void ktg_json_put_triple(ktg_json_writer *w, const uint32_t *values);

/* A string; bytes that are no UTF-8 (old file names) become question marks. NULL: null. */
void ktg_json_put_text(ktg_json_writer *w, const char *text);

/* What is left in the buffer. */
void ktg_json_flush(ktg_json_writer *w);

#endif
