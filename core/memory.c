/* core/memory.c - checked allocation and growable arrays. */
#include "core/memory.h"
#include "core/context.h"

#include <stdlib.h>
#include <string.h>

/* True when this allocation is the one a test wants to fail. */
static bool must_fail(ktg_context *context) {
    return context->allocation_to_fail > 0 && --context->allocation_to_fail == 0;
}

static ktg_status out_of_memory(ktg_context *context, size_t count, size_t size) {
    return ktg_fail(context, KTG_MEMORY, "out of memory (%zu items of %zu bytes)", count, size);
}

void *ktg_alloc(ktg_context *context, size_t count, size_t size) {
    void *memory = must_fail(context) ? NULL : calloc(count ? count : 1, size);
    if (!memory)
        (void)out_of_memory(context, count, size);
    return memory;
}

ktg_status ktg_reserve_bytes(ktg_context *context, void **items, size_t *capacity, size_t needed,
                             size_t size) {
    if (needed <= *capacity)
        return KTG_OK;
    size_t grown = *capacity + *capacity / 2 + 8;
    if (grown < needed)
        grown = needed;
    if (must_fail(context) || grown > SIZE_MAX / size)
        return out_of_memory(context, needed, size);
    void *moved = realloc(*items, grown * size);
    if (!moved)
        return out_of_memory(context, needed, size);
    memset((char *)moved + *capacity * size, 0, (grown - *capacity) * size);
    *items = moved;
    *capacity = grown;
    return KTG_OK;
}

char *ktg_copy_text(ktg_context *context, const char *text, size_t length) {
    length = strnlen(text, length);
    char *copy = ktg_alloc(context, length + 1, 1);
    if (copy)
        memcpy(copy, text, length);
    return copy;
}

void *ktg_copy_array(ktg_context *context, const void *items, size_t count, size_t size) {
    void *copy = ktg_alloc(context, count, size);
    if (copy && count)
        memcpy(copy, items, count * size);
    return copy;
}

/* Large tables are mostly NULL, and under sanitizers each call of free() takes long. */
void ktg_free(void *memory) {
    if (memory)
        free(memory);
}
