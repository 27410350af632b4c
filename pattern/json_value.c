/* pattern/json_value.c - looking into a parsed JSON file with the way to each value at hand. */
#include "pattern/json_value.h"
#include "core/memory.h"
#include "core/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_WAY 256

/* Appends ".key" and "[3]" from the outside in. */
static void write_way(const ktg_json *at, char *way, size_t size) {
    if (!at->parent)
        return;
    write_way(at->parent, way, size);
    size_t length = strlen(way);
    if (at->key)
        snprintf(way + length, size - length, "%s%s", length ? "." : "", at->key);
    else
        snprintf(way + length, size - length, "[%zu]", at->index);
}

ktg_status ktg_json_refuse(const ktg_json *at, const char *format, ...) {
    char way[MOST_WAY] = "", what[MOST_WAY];
    va_list arguments;
    va_start(arguments, format);
    ktg_vformat(what, sizeof what, format, arguments);
    va_end(arguments);
    write_way(at, way, sizeof way);
    return ktg_fail(at->context, KTG_FORMAT, "%s: %s%s%s", at->path, way, *way ? ": " : "", what);
}

static bool is_kind(const json_t *value, ktg_json_kind kind) {
    switch (kind) {
    case KTG_JSON_OBJECT:
        return json_is_object(value);
    case KTG_JSON_ARRAY:
        return json_is_array(value);
    case KTG_JSON_STRING:
        return json_is_string(value);
    case KTG_JSON_NUMBER:
        return json_is_number(value);
    case KTG_JSON_INTEGER:
        return json_is_integer(value);
    case KTG_JSON_BOOLEAN:
        return json_is_boolean(value);
    case KTG_JSON_TEXT_OR_NULL:
        return json_is_string(value) || json_is_null(value);
    case KTG_JSON_INTEGER_OR_NULL:
        return json_is_integer(value) || json_is_null(value);
    }
    return false;
}

static ktg_status expect_kind(const ktg_json *at, ktg_json_kind kind) {
    static const char *const names[] = {"an object",        "an array",          "a string",
                                        "a number",         "an integer",        "true or false",
                                        "a string or null", "an integer or null"};
    static const char *const is[] = {"an object",     "an array", "a string", "an integer",
                                     "a real number", "true",     "false",    "null"};
    if (is_kind(at->value, kind))
        return KTG_OK;
    return ktg_json_refuse(at, "must be %s, but it is %s", names[kind], is[json_typeof(at->value)]);
}

static ktg_json child_of(const ktg_json *parent, const char *key, size_t index,
                         const json_t *value) {
    return (ktg_json){parent->context, parent->path, parent, key, index, value};
}

ktg_status ktg_json_get(const ktg_json *object, const char *key, ktg_json_kind kind,
                        ktg_json *child) {
    *child = child_of(object, key, 0, json_object_get(object->value, key));
    if (!child->value)
        return ktg_json_refuse(child, "is missing");
    return expect_kind(child, kind);
}

ktg_status ktg_json_get_optional(const ktg_json *object, const char *key, ktg_json_kind kind,
                                 ktg_json *child) {
    const json_t *value = json_object_get(object->value, key);
    *child = child_of(object, key, 0, json_is_null(value) ? NULL : value);
    return child->value ? expect_kind(child, kind) : KTG_OK;
}

ktg_status ktg_json_item(const ktg_json *array, size_t index, ktg_json_kind kind, ktg_json *child) {
    *child = child_of(array, NULL, index, json_array_get(array->value, index));
    return expect_kind(child, kind);
}

size_t ktg_json_length(const ktg_json *array) {
    return json_array_size(array->value);
}

ktg_status ktg_json_expect_length(const ktg_json *array, size_t length) {
    if (ktg_json_length(array) == length)
        return KTG_OK;
    return ktg_json_refuse(array, "must have %zu items, but it has %zu", length,
                           ktg_json_length(array));
}

/* jansson refuses NaN and overflow itself; an integer is always finite. */
ktg_status ktg_json_number(const ktg_json *object, const char *key, double *number) {
    ktg_json at;
    KTG_TRY(ktg_json_get(object, key, KTG_JSON_NUMBER, &at));
    *number = json_number_value(at.value);
    return isfinite(*number) ? KTG_OK : ktg_json_refuse(&at, "must be finite");
}

ktg_status ktg_json_below(const ktg_json *at, uint64_t limit, uint32_t *number) {
    json_int_t value = json_integer_value(at->value);
    if (limit == 0)
        return ktg_json_refuse(at, "is %" JSON_INTEGER_FORMAT ", but there is nothing to count",
                               value);
    if (value < 0 || (uint64_t)value >= limit)
        return ktg_json_refuse(at, "is %" JSON_INTEGER_FORMAT ", which is not between 0 and %llu",
                               value, (unsigned long long)(limit - 1));
    *number = (uint32_t)value;
    return KTG_OK;
}

ktg_status ktg_json_count(const ktg_json *object, const char *key, uint64_t limit,
                          uint32_t *number) {
    ktg_json at;
    KTG_TRY(ktg_json_get(object, key, KTG_JSON_INTEGER, &at));
    return ktg_json_below(&at, limit, number);
}

ktg_status ktg_json_word(const ktg_json *object, const char *key, const char *const *words,
                         int *word) {
    ktg_json at;
    char known[MOST_WAY] = "";
    KTG_TRY(ktg_json_get(object, key, KTG_JSON_STRING, &at));
    for (*word = 0; words[*word]; (*word)++) {
        if (strcmp(words[*word], json_string_value(at.value)) == 0)
            return KTG_OK;
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", *word ? ", " : "", words[*word]);
    }
    return ktg_json_refuse(&at, "is \"%.40s\", which is none of %s", json_string_value(at.value),
                           known);
}

ktg_status ktg_json_text(const ktg_json *object, const char *key, char **text) {
    ktg_json at;
    KTG_TRY(ktg_json_get(object, key, KTG_JSON_TEXT_OR_NULL, &at));
    if (json_is_null(at.value))
        return KTG_OK;
    *text = ktg_copy_text(at.context, json_string_value(at.value), SIZE_MAX);
    return *text ? KTG_OK : KTG_MEMORY;
}

ktg_status ktg_json_numbers(const ktg_json *array, size_t length, double *numbers) {
    KTG_TRY(ktg_json_expect_length(array, length));
    for (size_t i = 0; i < length; i++) {
        ktg_json at;
        KTG_TRY(ktg_json_item(array, i, KTG_JSON_NUMBER, &at));
        numbers[i] = json_number_value(at.value);
        if (!isfinite(numbers[i]))
            return ktg_json_refuse(&at, "must be finite");
    }
    return KTG_OK;
}

ktg_status ktg_json_rows(const ktg_json *list, size_t width, double **numbers) {
    size_t length = ktg_json_length(list);
    *numbers = ktg_new(list->context, length * width, double);
    if (!*numbers)
        return KTG_MEMORY;
    for (size_t i = 0; i < length; i++) {
        ktg_json row;
        KTG_TRY(ktg_json_item(list, i, KTG_JSON_ARRAY, &row));
        KTG_TRY(ktg_json_numbers(&row, width, *numbers + i * width));
    }
    return KTG_OK;
}

ktg_status ktg_json_indices(const ktg_json *array, size_t length, uint64_t limit,
                            uint32_t *indices) {
    KTG_TRY(ktg_json_expect_length(array, length));
    for (size_t i = 0; i < length; i++) {
        ktg_json at;
        KTG_TRY(ktg_json_item(array, i, KTG_JSON_INTEGER, &at));
        KTG_TRY(ktg_json_below(&at, limit, &indices[i]));
    }
    return KTG_OK;
}

/* ---- ids ---------------------------------------------------------------------------------- */

struct ktg_json_id {
    json_int_t id;
    uint32_t index;
};

static int by_id(const void *a, const void *b) {
    const struct ktg_json_id *p = a, *q = b;
    if (p->id != q->id)
        return p->id < q->id ? -1 : 1;
    return p->index < q->index ? -1 : p->index > q->index;
}

ktg_status ktg_json_ids_read(const ktg_json *list, ktg_json_ids *ids) {
    ids->count = ktg_json_length(list);
    ids->sorted = ktg_new(list->context, ids->count, struct ktg_json_id);
    if (!ids->sorted)
        return KTG_MEMORY;
    for (size_t i = 0; i < ids->count; i++) {
        ktg_json object, id;
        KTG_TRY(ktg_json_item(list, i, KTG_JSON_OBJECT, &object));
        KTG_TRY(ktg_json_get(&object, "id", KTG_JSON_INTEGER, &id));
        ids->sorted[i] = (struct ktg_json_id){json_integer_value(id.value), (uint32_t)i};
    }
    qsort(ids->sorted, ids->count, sizeof *ids->sorted, by_id);
    for (size_t i = 1; i < ids->count; i++)
        if (ids->sorted[i].id == ids->sorted[i - 1].id) {
            ktg_json object = child_of(list, NULL, ids->sorted[i].index, NULL);
            ktg_json id = child_of(&object, "id", 0, NULL);
            return ktg_json_refuse(&id, "is %" JSON_INTEGER_FORMAT ", which item %u has already",
                                   ids->sorted[i].id, ids->sorted[i - 1].index);
        }
    return KTG_OK;
}

ktg_status ktg_json_ids_find(const ktg_json_ids *ids, const ktg_json *at, uint32_t *index) {
    json_int_t wanted = json_integer_value(at->value);
    size_t low = 0, high = ids->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (ids->sorted[middle].id < wanted)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == ids->count || ids->sorted[low].id != wanted)
        return ktg_json_refuse(at, "is %" JSON_INTEGER_FORMAT ", an id that nothing has", wanted);
    *index = ids->sorted[low].index;
    return KTG_OK;
}

void ktg_json_ids_free(ktg_json_ids *ids) {
    ktg_free(ids->sorted);
    ids->sorted = NULL;
    ids->count = 0;
}
