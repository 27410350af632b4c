/* core/memory.h - checked allocation and growable arrays (shared between folders, not installed).
 *
 * All memory of the library is taken here, so that overflow is checked in one place and a test can
 * make the k-th allocation fail. Free with ktg_free. */
#ifndef KTG_CORE_MEMORY_H
#define KTG_CORE_MEMORY_H

#include "core/core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* `count` zeroed items of `size` bytes. On failure NULL, with KTG_MEMORY's text in the context.
 * A count of 0 gives a pointer that may be freed. */
void *ktg_alloc(ktg_context *context, size_t count, size_t size);

/* Makes room for at least `needed` items: *items may move, *capacity grows by at least half. New
 * items are zeroed. On failure nothing changed. */
KTG_NODISCARD ktg_status ktg_reserve_bytes(ktg_context *context, void **items, size_t *capacity,
                                           size_t needed, size_t size);

/* A copy of `text` up to its end or `length` bytes; NULL on failure. */
char *ktg_copy_text(ktg_context *context, const char *text, size_t length);

/* A copy of `count` items of `size` bytes; NULL on failure. */
void *ktg_copy_array(ktg_context *context, const void *items, size_t count, size_t size);

/* ktg_new(ctx, n, double): an array of n zeroed doubles, or NULL. */
#define ktg_new(context, count, type) ((type *)ktg_alloc(context, count, sizeof(type)))

/* ktg_reserve(ctx, &items, &capacity, needed) for a pointer `items` of any type. */
#define ktg_reserve(context, items, capacity, needed)                                              \
    ktg_reserve_bytes(context, (void **)(items), capacity, needed, sizeof(**(items)))

/* Returns the status of a failed call from the current function (where there is nothing to free).
 */
#define KTG_TRY(call)                                                                              \
    do {                                                                                           \
        ktg_status ktg_try_status = (call);                                                        \
        if (ktg_try_status != KTG_OK)                                                              \
            return ktg_try_status;                                                                 \
    } while (0)

#ifdef __cplusplus
}
#endif
#endif
