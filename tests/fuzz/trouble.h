/* tests/fuzz/trouble.h - somebody interrupts a call, or memory runs short, at some moment. */
#ifndef KTG_TESTS_FUZZ_TROUBLE_H
#define KTG_TESTS_FUZZ_TROUBLE_H

#include "tests/fuzz/fuzz.h"

typedef struct fuzz_trouble {
    ktg_wish wish;         /* what somebody wants ... */
    uint32_t after, asked; /* ... from that question on */
    bool memory_is_short;
} fuzz_trouble;

/* By the bytes: mostly none. *trouble stays where it is until the end. Picks a seed and the number
 * of threads, too. */
void fuzz_trouble_begin(fuzz_bytes *bytes, ktg_context *context, fuzz_trouble *trouble);

/* Takes the trouble away, and looks at how a call has answered it; true where it succeeded. */
bool fuzz_trouble_end(ktg_context *context, fuzz_trouble *trouble, ktg_status status);

/* For calls that read a file: lets an allocation fail that the bytes decide, with one in four
 * inputs; false with the others. */
bool fuzz_trouble_memory(ktg_context *context, const uint8_t *data, size_t size);

/* Lets no allocation fail any more, and looks at the answer; true where the call succeeded. */
bool fuzz_trouble_over(ktg_context *context, ktg_status status);

#endif
