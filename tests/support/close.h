/* Shared by unit tests: cmocka's headers, comparisons, refusals, random numbers.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_CLOSE_H
#define KNURL_TEST_CLOSE_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <knurl/base.h>

#include "support/handles.h"
#include "support/suite.h"

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/** |actual - expected| <= tolerance; a NaN is never close. */
#define CHECK_CLOSE(actual, expected, tolerance) check_close(actual, expected, tolerance, __FILE__, __LINE__)

/** The very same number. */
#define CHECK_SAME(actual, expected) check_close(actual, expected, 0.0L, __FILE__, __LINE__)

static inline void check_close(long double actual, long double expected, long double tolerance, const char *file,
                               int line) {
    if (!(fabsl(actual - expected) <= tolerance)) {
        print_error("%.17g is not %.17g to within %.3g\n", (double)actual, (double)expected, (double)tolerance);
        _fail(file, line);
    }
}

/** `call` gives `code` and a fresh, non-empty sentence, and leaves every byte of `object` as it was. */
#define CHECK_REFUSED(call, code, object)                                                                              \
    do {                                                                                                               \
        unsigned char before_[sizeof(object)];                                                                         \
        memcpy(before_, &(object), sizeof(object));                                                                    \
        (void)knurl_fail(KNURL_ERROR_STATE, "stale message");                                                          \
        check_refusal(call, code, __FILE__, __LINE__);                                                                 \
        assert_memory_equal(before_, &(object), sizeof(object));                                                       \
    } while (0)

static inline void check_refusal(knurl_result result, knurl_result expected, const char *file, int line) {
    const char *message = knurl_error_message();
    if (result != expected || message[0] == '\0' || strcmp(message, "stale message") == 0) {
        print_error("result %d instead of %d, message \"%s\"\n", (int)result, (int)expected, message);
        _fail(file, line);
    }
}

/** Checks that the last error message contains each of `words`, which are apart by '|'. */
static inline void check_message(const char *words) {
    for (const char *next = words; next; words = next) {
        char word[512];
        const size_t length = strcspn(words, "|");
        (void)snprintf(word, sizeof word, "%.*s", (int)length, words);
        if (!strstr(knurl_error_message(), word)) {
            print_error("\"%s\" lacks \"%s\"\n", knurl_error_message(), word);
            fail();
        }
        next = words[length] ? words + length + 1 : NULL;
    }
}

/** Reproducible random numbers (xorshift64); `state` is never 0. */
static inline uint64_t random_bits(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/** Evenly in [low, high). */
static inline double random_between(uint64_t *state, double low, double high) {
    return low + (high - low) * ((double)(random_bits(state) >> 11) / 9007199254740992.0);
}

/** Each component evenly in [low, high). */
static inline void random_vector(uint64_t *state, double low, double high, double v[3]) {
    for (int axis = 0; axis < 3; axis++) {
        v[axis] = random_between(state, low, high);
    }
}

/** Evenly among low, low + 1, ... high. */
static inline int64_t random_integer(uint64_t *state, int64_t low, int64_t high) {
    return low + (int64_t)(random_bits(state) % (uint64_t)(high - low + 1));
}

#endif
