/* Atomic loads and stores with compiler builtins, which C99 lacks. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_ATOMIC_H
#define KNURL_SRC_ATOMIC_H

#include "base/finite.h"

#define knurl_load_relaxed(p)     __atomic_load_n((p), __ATOMIC_RELAXED)
#define knurl_load_acquire(p)     __atomic_load_n((p), __ATOMIC_ACQUIRE)
#define knurl_store_relaxed(p, v) __atomic_store_n((p), (v), __ATOMIC_RELAXED)
#define knurl_store_release(p, v) __atomic_store_n((p), (v), __ATOMIC_RELEASE)

/* Relaxed store and load of a floating-point number. (Clang's __atomic_store needs a source that is not const; the
 * copies compile to nothing.) */
static inline void knurl_store_double(double *to, double value) {
    double copy = value;
    __atomic_store(to, &copy, __ATOMIC_RELAXED);
}

static inline double knurl_load_double(const double *from) {
    double copy;
    __atomic_load(from, &copy, __ATOMIC_RELAXED);
    return copy;
}

static inline void knurl_store_float(float *to, float value) {
    float copy = value;
    __atomic_store(to, &copy, __ATOMIC_RELAXED);
}

/* For counters with one writer and any number of readers. */
#define knurl_count_up(p) knurl_store_relaxed((p), knurl_load_relaxed(p) + 1)

#endif
