/* Shared by the fuzz targets. A target passes any bytes to the library, and aborts if a result breaks a promise;
 * sanitizers detect the rest. SPDX-License-Identifier: MIT */
#ifndef KNURL_FUZZ_H
#define KNURL_FUZZ_H

#include <knurl/hip.h>
#include <knurl/query.h>

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
#ifdef __cplusplus
}
#endif

#define EXPECT(condition)                                                                                              \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            (void)fprintf(stderr, "%s:%d: expected %s; %s\n", __FILE__, __LINE__, #condition, knurl_error_message());  \
            abort();                                                                                                   \
        }                                                                                                              \
    } while (0)

/* The input as a supply of numbers; zeros at its end. */
typedef struct supply {
    const uint8_t *at;
    size_t left;
} supply;

static inline uint8_t take_byte(supply *s) {
    if (s->left == 0) {
        return 0;
    }
    s->left--;
    return *s->at++;
}

static inline uint32_t take_word(supply *s) {
    uint32_t word = 0;
    for (int i = 0; i < 4; i++) {
        word = word << 8 | take_byte(s);
    }
    return word;
}

/* A place of about 0.1 m, on a lattice of 1/256 as a rule, so that corners meet; one time in 16 any number at all. */
static inline double take_number(supply *s) {
    const uint8_t kind = take_byte(s);
    if (kind >= 16) {
        return ((double)take_byte(s) - 128.0) / 256.0 * 0.2;
    }
    const uint32_t bits = take_word(s);
    float any;
    memcpy(&any, &bits, sizeof any);
    return (double)any;
}

/* Ticks a few times along a path through the middle, and checks the results against the header's promises. */
static inline void expect_good_ticks(knurl_scene *scene, supply *s, int ticks) {
    for (int i = 0; i < ticks; i++) {
        knurl_tick_input in;
        knurl_tick_output out;
        memset(&in, 0, sizeof in);
        for (int axis = 0; axis < 3; axis++) {
            in.position[axis] = take_number(s);
        }
        (void)knurl_scene_tick(scene, 0, &in, &out);
        double square = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            EXPECT(isfinite(out.device_force[axis]));
            square += out.device_force[axis] * out.device_force[axis];
        }
        EXPECT(sqrt(square) <= 3.3 * (1.0 + 1e-9)); /* a HIP's default max_force */
    }
}

#endif
