/* A hash of three words with a secret seed, for tables filled from files: no file can be made to collide more than
 * chance.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SEEDED_HASH_H
#define KNURL_SRC_SEEDED_HASH_H

#include "base/finite.h"

#include <stdint.h>

/* Multilinear hashing (Carter and Wegman 1979; Lemire and Kaser 2014): with random factors, two triples agree in the
 * upper half of the sum, or in any of its bits, as seldom as random numbers do. */
typedef struct knurl_seeded_hash {
    uint64_t factors[4];
} knurl_seeded_hash;

/* Factors from splitmix64 (Steele, Lea and Flood 2014). */
static inline void knurl_seeded_hash_init(knurl_seeded_hash *hash, uint64_t seed) {
    for (int i = 0; i < 4; i++) {
        seed += 0x9e3779b97f4a7c15u;
        uint64_t z = seed;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        hash->factors[i] = z ^ z >> 31;
    }
}

/* 32 bits; any of them can index a table. */
static inline uint64_t knurl_seeded_hash_of(const knurl_seeded_hash *hash, uint32_t a, uint32_t b, uint32_t c) {
    const uint64_t *f = hash->factors;
    return (f[0] + f[1] * a + f[2] * b + f[3] * c) >> 32;
}

#endif
