/* Loudness of a texture. The force also changes as the hand presses, so a change counts only if the height changes in
 * the same tick; an edge may take two ticks. SPDX-License-Identifier: MIT */
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
    l->forces[2] = l->forces[1];
    l->forces[1] = l->forces[0];
    l->forces[0] = force;
    if (l->contact_ticks > 0 && height != l->heights[0]) {
        most = fabs(force - l->forces[1]);
    }
    if (l->contact_ticks > 1 && (height != l->heights[0] || l->heights[0] != l->heights[1])) {
        most = fmax(most, fabs(force - l->forces[2]));
    }
    l->heights[1] = l->heights[0];
    l->heights[0] = height;
    l->contact_ticks += l->contact_ticks < 2;
    return most;
}

double knurl_loudness_update(knurl_loudness *l, const knurl_tick_output *tick) {
    const double *f = tick->force;
    const double force = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    if (!(tick->flags & KNURL_TICK_CONTACT) || !knurl_is_finite(force) || !knurl_is_finite(tick->height)) {
        l->contact_ticks = 0;
        l->buckets[0] = l->buckets[1] = 0.0;
        return 0.0;
    }
    if (++l->ticks > l->bucket_ticks) {
        l->ticks = 1;
        l->buckets[1] = l->buckets[0];
        l->buckets[0] = 0.0;
    }
    l->buckets[0] = fmax(l->buckets[0], change(l, tick->height, force));
    return 0.5 * fmax(l->buckets[0], l->buckets[1]);
}
