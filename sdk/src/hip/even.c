/* Even sensation. SPDX-License-Identifier: MIT */
#include "hip/even.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

/* The gain at `hz`: straight in log hz between two pairs, constant beyond. */
static double gain_at(const knurl_gain *gains, uint32_t count, double hz) {
    uint32_t i = 0;
    while (i < count && gains[i].hz < hz) {
        i++;
    }
    if (i == 0 || i == count) {
        return gains[i == 0 ? 0 : count - 1].gain;
    }
    const double share = log(hz / gains[i - 1].hz) / log(gains[i].hz / gains[i - 1].hz);
    return gains[i - 1].gain + share * (gains[i].gain - gains[i - 1].gain);
}

knurl_result knurl_even_init(const knurl_gain *gains, uint32_t count, knurl_even *even) {
    if (!gains || count == 0) {
        even->on = 0;
        return KNURL_OK;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!knurl_is_within(gains[i].hz, i ? gains[i - 1].hz : 1e-3, 1e5) || (i && gains[i].hz == gains[i - 1].hz)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "gain %u: expected frequencies that rise, from 0.001 to 100000 Hz, found %g Hz",
                              (unsigned)i, gains[i].hz);
        }
        if (!knurl_is_within(gains[i].gain, 0.0, 1.0)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "gain %u: expected 0 to 1, found %g", (unsigned)i, gains[i].gain);
        }
    }
    even->on = 1;
    even->lowest = 1.0;
    even->lowered_hz[0] = even->lowered_hz[1] = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        if (gains[i].gain < 1.0) {
            even->lowered_hz[0] = even->lowered_hz[1] > 0.0 ? even->lowered_hz[0] : gains[i].hz;
            even->lowered_hz[1] = gains[i].hz;
        }
    }
    for (int i = 0; i < KNURL_EVEN_VALUES; i++) {
        const double gain = gain_at(gains, count, ldexp(1.0 + i % 16 / 16.0, KNURL_EVEN_LOWEST + i / 16));
        even->gains[i] = gain;
        even->lowest = gain < even->lowest ? gain : even->lowest;
    }
    return KNURL_OK;
}

double knurl_even_gain(const knurl_even *even, double frequency) {
    const double first = (double)(1 << KNURL_EVEN_LOWEST);
    if (!(frequency > first)) {
        return even->gains[0];
    }
    uint64_t bits;
    memcpy(&bits, &frequency, sizeof bits);
    const uint64_t place = (bits >> 48) - ((uint64_t)(1023 + KNURL_EVEN_LOWEST) << 4);
    if (place >= KNURL_EVEN_VALUES - 1) {
        return even->gains[KNURL_EVEN_VALUES - 1];
    }
    const double share = (double)(bits & 0xffffffffffff) * (1.0 / 281474976710656.0); /* of the sixteenth; 2^48 */
    const double *gain = &even->gains[place];
    return gain[0] + share * (gain[1] - gain[0]);
}
