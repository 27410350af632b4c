/* pattern/json_value.h - looking into a parsed JSON file so that every refusal names the file, the
 * way to the value ("pieces[3].corners") and what is wrong with it (pattern only). */
#ifndef KTG_PATTERN_JSON_VALUE_H
#define KTG_PATTERN_JSON_VALUE_H

#include "core/core.h"

#include <jansson.h>

/* A value and the way to it. Lives on the stack; `parent` must outlive it. */
typedef struct ktg_json {
    ktg_context *context;
    const char *path;              /* of the file */
    const struct ktg_json *parent; /* NULL: the whole file */
    const char *key;               /* within an object; NULL: within an array ... */
    size_t index;                  /* ... at this place */
    const json_t *value;           /* NULL: an optional key that is not there (or null) */
} ktg_json;

typedef enum ktg_json_kind {
    KTG_JSON_OBJECT,
    KTG_JSON_ARRAY,
    KTG_JSON_STRING,
    KTG_JSON_NUMBER,
    KTG_JSON_INTEGER,
    KTG_JSON_BOOLEAN,
    KTG_JSON_TEXT_OR_NULL,
    KTG_JSON_INTEGER_OR_NULL
} ktg_json_kind;

/* KTG_FORMAT: "FILE: WAY: what". */
ktg_status ktg_json_refuse(const ktg_json *at, const char *format, ...) KTG_PRINTF(2, 3);

/* The value at `key`, which must be there and of that kind. */
KTG_NODISCARD ktg_status ktg_json_get(const ktg_json *object, const char *key, ktg_json_kind kind,
                                      ktg_json *child);
/* The same; child->value is NULL where the key is missing or null. */
KTG_NODISCARD ktg_status ktg_json_get_optional(const ktg_json *object, const char *key,
                                               ktg_json_kind kind, ktg_json *child);
/* Item `index` (within the array's length), which must be of that kind. */
KTG_NODISCARD ktg_status ktg_json_item(const ktg_json *array, size_t index, ktg_json_kind kind,
                                       ktg_json *child);

size_t ktg_json_length(const ktg_json *array);
/* The array must have exactly `length` items. */
KTG_NODISCARD ktg_status ktg_json_expect_length(const ktg_json *array, size_t length);

/* A finite number; an integer from 0 to limit - 1; an index of `words` (which ends with NULL). */
KTG_NODISCARD ktg_status ktg_json_number(const ktg_json *object, const char *key, double *number);
KTG_NODISCARD ktg_status ktg_json_below(const ktg_json *at, uint64_t limit, uint32_t *number);
KTG_NODISCARD ktg_status ktg_json_count(const ktg_json *object, const char *key, uint64_t limit,
                                        uint32_t *number);
KTG_NODISCARD ktg_status ktg_json_word(const ktg_json *object, const char *key,
                                       const char *const *words, int *word);

/* An allocated copy of the text; NULL for null. */
KTG_NODISCARD ktg_status ktg_json_text(const ktg_json *object, const char *key, char **text);

/* Arrays of numbers: one array of exactly `length`; a list of arrays of `width` numbers each,
 * allocated into *numbers (ktg_json_length(list) x width). */
KTG_NODISCARD ktg_status ktg_json_numbers(const ktg_json *array, size_t length, double *numbers);
KTG_NODISCARD ktg_status ktg_json_rows(const ktg_json *list, size_t width, double **numbers);
/* An array of exactly `length` integers below `limit`. */
KTG_NODISCARD ktg_status ktg_json_indices(const ktg_json *array, size_t length, uint64_t limit,
                                          uint32_t *indices);

/* ---- ids ---------------------------------------------------------------------------------- */

/* From the ids of a file, whatever they are, to indices. */
typedef struct ktg_json_ids {
    size_t count;
    struct ktg_json_id *sorted;
} ktg_json_ids;

/* Reads "id" of each object of `list`; two alike are refused. Free with ktg_json_ids_free. */
KTG_NODISCARD ktg_status ktg_json_ids_read(const ktg_json *list, ktg_json_ids *ids);
/* The index of the object that the integer `at` names. */
KTG_NODISCARD ktg_status ktg_json_ids_find(const ktg_json_ids *ids, const ktg_json *at,
                                           uint32_t *index);
void ktg_json_ids_free(ktg_json_ids *ids);

#endif
