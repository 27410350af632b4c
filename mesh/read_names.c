/* mesh/read_names.c - names of a model file: found again by a hash table, made clean UTF-8. */
#include "core/memory.h"
#include "mesh/read.h"

#include <string.h>

/* The length of the UTF-8 character at `at`, 0 where there is none (Unicode 15, table 3-7). */
static size_t utf8_length(const unsigned char *at, size_t left) {
    if (at[0] < 0x80)
        return 1;
    size_t length = at[0] < 0xc2 ? 0 : at[0] < 0xe0 ? 2 : at[0] < 0xf0 ? 3 : at[0] < 0xf5 ? 4 : 0;
    if (length == 0 || length > left)
        return 0;
    unsigned char low = at[0] == 0xe0 ? 0xa0 : at[0] == 0xf0 ? 0x90 : 0x80;
    unsigned char high = at[0] == 0xed ? 0x9f : at[0] == 0xf4 ? 0x8f : 0xbf;
    if (at[1] < low || at[1] > high)
        return 0;
    for (size_t i = 2; i < length; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    return length;
}

char *ktg_name_clean(ktg_context *context, ktg_word text) {
    unsigned char *clean = ktg_alloc(context, 2 * text.length + 1, 1);
    if (!clean)
        return NULL;
    size_t count = 0;
    for (size_t i = 0; i < text.length;) {
        const unsigned char *at = (const unsigned char *)text.text + i;
        size_t length = utf8_length(at, text.length - i);
        bool control = *at < 0x20 || *at == 0x7f || (length == 0 && *at < 0xa0) ||
                       (length == 2 && at[0] == 0xc2 && at[1] < 0xa0);
        if (control) {
            clean[count++] = '_';
        } else if (length == 0) {
            clean[count++] = (unsigned char)(0xc0 | *at >> 6);
            clean[count++] = (unsigned char)(0x80 | (*at & 0x3f));
        } else {
            memcpy(clean + count, at, length);
            count += length;
        }
        i += length ? length : 1;
    }
    return (char *)clean;
}

char *ktg_mesh_clean_name(ktg_context *context, const char *name) {
    return ktg_name_clean(context, (ktg_word){name, strlen(name)});
}

/* FNV-1a with a final mix. */
static size_t hash_text(const char *text) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return (size_t)(hash ^ hash >> 29);
}

/* The slot that holds `text`, or the free one it belongs into. */
static size_t find_slot(const ktg_name_table *table, const char *text) {
    size_t slot = hash_text(text) & (table->slot_count - 1);
    while (table->slots[slot] != KTG_NONE &&
           strcmp(table->names.text[table->slots[slot]], text) != 0)
        slot = (slot + 1) & (table->slot_count - 1);
    return slot;
}

/* Keeps at least half of the slots free. */
static ktg_status grow_slots(ktg_context *context, ktg_name_table *table) {
    if (2 * ((size_t)table->names.count + 1) <= table->slot_count)
        return KTG_OK;
    size_t grown = table->slot_count ? 2 * table->slot_count : 16;
    uint32_t *slots = ktg_new(context, grown, uint32_t);
    if (!slots)
        return KTG_MEMORY;
    memset(slots, 0xff, grown * sizeof *slots);
    ktg_free(table->slots);
    table->slots = slots;
    table->slot_count = grown;
    for (uint32_t i = 0; i < table->names.count; i++)
        slots[find_slot(table, table->names.text[i])] = i;
    return KTG_OK;
}

ktg_status ktg_name_number(ktg_context *context, ktg_name_table *table, ktg_word text,
                           uint32_t *number) {
    *number = KTG_NONE;
    if (text.length == 0)
        return KTG_OK;
    KTG_TRY(grow_slots(context, table));
    KTG_TRY(
        ktg_reserve(context, &table->names.text, &table->capacity, (size_t)table->names.count + 1));
    char *clean = ktg_name_clean(context, text);
    if (!clean)
        return KTG_MEMORY;
    size_t slot = find_slot(table, clean);
    if (table->slots[slot] == KTG_NONE) {
        table->slots[slot] = table->names.count;
        table->names.text[table->names.count++] = clean;
    } else {
        ktg_free(clean);
    }
    *number = table->slots[slot];
    return KTG_OK;
}

ktg_status ktg_name_line(ktg_context *context, char **text, ktg_word name) {
    char *clean = ktg_name_clean(context, name);
    if (!clean)
        return KTG_MEMORY;
    size_t before = *text ? strlen(*text) + 1 : 0, length = strlen(clean), capacity = before;
    ktg_status status = ktg_reserve(context, text, &capacity, before + length + 1);
    if (status == KTG_OK && before > 0)
        (*text)[before - 1] = '\n';
    if (status == KTG_OK)
        memcpy(*text + before, clean, length + 1);
    ktg_free(clean);
    return status;
}

void ktg_name_table_free(ktg_name_table *table) {
    for (uint32_t i = 0; i < table->names.count; i++)
        ktg_free(table->names.text[i]);
    ktg_free(table->names.text);
    ktg_free(table->slots);
    *table = (ktg_name_table){0};
}
