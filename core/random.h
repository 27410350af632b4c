/* core/random.h - the one random generator (shared between folders, not installed): xoshiro256**
 * (Blackman & Vigna 2018), seeded through splitmix64. The same seed gives the same numbers on every
 * machine. */
#ifndef KTG_CORE_RANDOM_H
#define KTG_CORE_RANDOM_H

#include <stddef.h>
#include <stdint.h>

typedef struct ktg_random {
    uint64_t state[4];
} ktg_random;

static inline void ktg_random_seed(ktg_random *random, uint64_t seed) {
    for (int i = 0; i < 4; i++) {
        seed += 0x9e3779b97f4a7c15u;
        uint64_t z = seed;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        random->state[i] = z ^ (z >> 31);
    }
}

static inline uint64_t ktg_random_rotate(uint64_t x, int k) {
    return (x << k) | (x >> (64 - k));
}

static inline uint64_t ktg_random_next(ktg_random *random) {
    uint64_t *s = random->state;
    uint64_t result = ktg_random_rotate(s[1] * 5, 7) * 9, t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = ktg_random_rotate(s[3], 45);
    return result;
}

/* Uniform in [0, 1). */
static inline double ktg_random_unit(ktg_random *random) {
    return (double)(ktg_random_next(random) >> 11) * 0x1p-53;
}

/* Uniform in 0 .. count - 1; count from 1 to 2^32. (A bias of count / 2^32 at most.) */
static inline size_t ktg_random_below(ktg_random *random, size_t count) {
    return (size_t)(((ktg_random_next(random) >> 32) * (uint64_t)count) >> 32);
}

#endif
