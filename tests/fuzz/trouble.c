/* tests/fuzz/trouble.c - somebody interrupts a call, or memory runs short, at some moment. */
#include "tests/fuzz/trouble.h"

#include <string.h>

static ktg_wish answer(void *user) {
    fuzz_trouble *trouble = user;
    return trouble->asked++ >= trouble->after ? trouble->wish : KTG_GO_ON;
}

void fuzz_trouble_begin(fuzz_bytes *bytes, ktg_context *context, fuzz_trouble *trouble) {
    unsigned kind = fuzz_byte(bytes);
    uint32_t moment = fuzz_byte(bytes);
    moment = moment * moment / 4 + fuzz_byte(bytes); /* early ones are more frequent */
    *trouble = (fuzz_trouble){.after = moment};
    if (kind % 8 == 5)
        trouble->wish = KTG_STOP;
    if (kind % 8 == 6)
        trouble->wish = KTG_FINISH;
    trouble->memory_is_short = kind % 8 == 7;
    ktg_context_set_cancel(context, answer, trouble);
    ktg_context_set_threads(context, 1 + kind / 8 % 2);
    ktg_context_set_seed(context, kind / 16);
    if (trouble->memory_is_short)
        ktg_context_fail_allocation(context, 1 + moment);
}

bool fuzz_trouble_end(ktg_context *context, fuzz_trouble *trouble, ktg_status status) {
    bool stopped = trouble->wish == KTG_STOP && trouble->asked > trouble->after;
    ktg_context_set_cancel(context, NULL, NULL);
    ktg_context_fail_allocation(context, 0);
    fuzz_expect(stopped ? status != KTG_OK : status != KTG_CANCELLED,
                "a wish to stop is not heard, or one that nobody had");
    return trouble->memory_is_short ? fuzz_trouble_over(context, status)
                                    : fuzz_succeeded(context, status);
}

bool fuzz_trouble_memory(ktg_context *context, const uint8_t *data, size_t size) {
    uint32_t sum = 2166136261u; /* Fowler, Noll and Vo */
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ data[i]) * 16777619u;
    if (sum % 4 != 0)
        return false;
    uint32_t moment = sum / 4 % 64;
    ktg_context_fail_allocation(context, 1 + moment * moment / 4);
    return true;
}

bool fuzz_trouble_over(ktg_context *context, ktg_status status) {
    ktg_context_fail_allocation(context, 0);
    if (status != KTG_MEMORY)
        return fuzz_succeeded(context, status);
    fuzz_expect(strlen(ktg_context_message(context)) > 0, "short memory is not told");
    return false;
}
