/* Loudness of a texture. The force also changes as the hand presses, so a change counts only if the height changes in
 * the same tick; an edge may take two ticks. If a method plays the fundamental alone, its changes
 * are larger than those of the square wave, so they are scaled by the fourth root of the mean fourth power of the
 * height, which is A for a square wave of A and 0.997 A for its fundamental (4/pi (3/8)^(1/4)).
 * SPDX-License-Identifier: MIT */
#include "audio/loudness.h"

#include "base/finite.h"

#include <math.h>
#include <string.h>

/* s. A stroke over 16 or more ridges per second has an edge in each bucket, so that its loudness is even. */
#define BUCKET_S 0.032

void knurl_loudness_init(knurl_loudness *loudness, double update_rate_hz) {
    memset(loudness, 0, sizeof *loudness);
    loudness->bucket_ticks = (uint32_t)(BUCKET_S * update_rate_hz + 0.5);
}

/* N: the change of the force that came with a change of height in this tick. */
static double change(knurl_loudness *l, double height, double force) {
    double most = 0.0;
    double rise = 0.0;
    l->forces[2] = l->forces[1];
    l->forces[1] = l->forces[0];
    l->forces[0] = force;
    if (l->contact_ticks > 0 && height != l->heights[0]) {
        most = fabs(force - l->forces[1]);
        rise = fabs(height - l->heights[0]);
    }
    if (l->contact_ticks > 1 && (height != l->heights[0] || l->heights[0] != l->heights[1])) {
        most = fmax(most, fabs(force - l->forces[2]));
        rise = fmax(rise, fabs(height - l->heights[1]));
    }
    l->heights[1] = l->heights[0];
    l->heights[0] = height;
    l->contact_ticks += l->contact_ticks < 2;
    l->rises[0] = fmax(l->rises[0], rise);
    l->powers[0] += height * height * (height * height);
    l->counts[0] += height != 0.0;
    return most;
}

static void clear(knurl_loudness *l, int bucket) {
    l->buckets[bucket] = l->rises[bucket] = l->powers[bucket] = l->counts[bucket] = 0.0;
}

/* The level of the height over half of its largest change, at most 1. */
static double level(const knurl_loudness *l) {
    const double count = l->counts[0] + l->counts[1];
    const double rise = fmax(l->rises[0], l->rises[1]);
    return count > 0.0 && rise > 0.0 ? fmin(1.0, 2.0 * sqrt(sqrt((l->powers[0] + l->powers[1]) / count)) / rise) : 0.0;
}

double knurl_loudness_update(knurl_loudness *l, const knurl_tick_output *tick) {
    const double *f = tick->force;
    const double force = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    if (!(tick->flags & KNURL_TICK_CONTACT) || !knurl_is_finite(force) || !knurl_is_finite(tick->height)) {
        l->contact_ticks = 0;
        clear(l, 0);
        clear(l, 1);
        return 0.0;
    }
    if (++l->ticks > l->bucket_ticks) {
        l->ticks = 1;
        l->buckets[1] = l->buckets[0];
        l->rises[1] = l->rises[0];
        l->powers[1] = l->powers[0];
        l->counts[1] = l->counts[0];
        clear(l, 0);
    }
    l->buckets[0] = fmax(l->buckets[0], change(l, tick->height, force));
    return 0.5 * fmax(l->buckets[0], l->buckets[1]) * level(l);
}
